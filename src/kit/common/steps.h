/* Numbers on a decimal grid as texts, which do not depend on a locale. */
#pragma once

#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>

enum { CS_STEPS_SIZE = 32 }; /* bytes of a text, with its zero */

/* Writes `steps` of a grid that has 0 to 9 digits after the point, without zeros at the end;
 * has_zero: with the zero before the point. Returns the length. */
static inline size_t cs_steps_put(char out[CS_STEPS_SIZE], int64_t steps, int digits,
                                  bool has_zero) {
  uint64_t size = steps < 0 ? -(uint64_t)steps : (uint64_t)steps, grid = 1;
  for (int i = 0; i < digits; i++)
    grid *= 10;
  const uint64_t whole = size / grid, part = size % grid;
  int length = snprintf(out, CS_STEPS_SIZE, "%s", steps < 0 ? "-" : "");
  if (has_zero || whole > 0 || part == 0)
    length += snprintf(out + length, CS_STEPS_SIZE - (size_t)length, "%" PRIu64, whole);
  if (part > 0)
    length += snprintf(out + length, CS_STEPS_SIZE - (size_t)length, ".%0*" PRIu64, digits, part);
  while (part > 0 && out[length - 1] == '0')
    length--;
  out[length] = '\0';
  return (size_t)length;
}
