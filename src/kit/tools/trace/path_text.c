#include "tools/trace/path_text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static celspan_status add(celspan_context *context, cs_writing *writing, const char *bytes,
                          size_t size) {
  CS_TRY(CS_RESERVE(context, writing->bytes, writing->capacity, writing->count + size + 1));
  memcpy(writing->bytes + writing->count, bytes, size);
  writing->count += size;
  writing->bytes[writing->count] = '\0';
  return CELSPAN_OK;
}

celspan_status cs_writing_add(celspan_context *context, cs_writing *writing, const char *text) {
  return add(context, writing, text, strlen(text));
}

/* Uses only integers, so that the result does not depend on a locale. Returns the length of the
 * text, without its zero. */
static size_t put_number(char *out, double number) {
  int64_t thousandths = (int64_t)floor(number * 1000 + 0.5);
  size_t size = 0;
  if (thousandths < 0) {
    out[size++] = '-';
    thousandths = -thousandths;
  }
  size += (size_t)snprintf(out + size, 22, "%lld", (long long)(thousandths / 1000));
  int part = (int)(thousandths % 1000);
  if (part > 0) {
    out[size++] = '.';
    for (int digit = 100; part > 0; part %= digit, digit /= 10)
      out[size++] = (char)('0' + part / digit);
  }
  out[size] = '\0';
  return size;
}

cs_decimal cs_decimal_of(double number) {
  cs_decimal decimal;
  put_number(decimal.text, number);
  return decimal;
}

celspan_status cs_writing_draw(celspan_context *context, cs_writing *writing, char letter,
                               const celspan_point *points, int count) {
  char text[8 + 3 * 2 * 32];
  size_t size = 0;
  text[size++] = letter;
  for (int i = 0; i < count; i++) {
    if (i > 0)
      text[size++] = ' ';
    size += put_number(text + size, points[i].x);
    text[size++] = ' ';
    size += put_number(text + size, points[i].y);
  }
  return add(context, writing, text, size);
}

void cs_writing_finish(celspan_context *context, cs_writing *writing) {
  cs_mem_free(context->memory, writing->bytes, writing->capacity);
  *writing = (cs_writing){.bytes = NULL};
}
