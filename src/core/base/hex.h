/* Digits of sixteen, as colours and addresses have them. */
#pragma once

/* The value of a hexadecimal digit, 0..15, of either case; -1 for any other character. */
static inline int cs_hex_digit(char c) {
  if (c >= '0' && c <= '9')
    return c - '0';
  if (c >= 'a' && c <= 'f')
    return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}
