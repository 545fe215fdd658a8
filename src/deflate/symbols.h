/* The alphabets of deflate and how lengths and distances become symbols (RFC 1951, 3.2.5).
 *
 * Both are coded alike: a symbol stands for the highest bits of a number, and the lower ones follow
 * as they are, as extra bits. With `kept` bits after the leading one in the symbol:
 *
 *   distance - 1 (kept = 1)      0  1  2  3  4..5  6..7  8..11  12..15  16..23 ...
 *   symbol                       0  1  2  3   4     5     6       7       8
 *   extra bits                   0  0  0  0   1     1     2       2       3
 */
#ifndef CS_DEFLATE_SYMBOLS_H
#define CS_DEFLATE_SYMBOLS_H

enum {
  /* 256 bytes, the end of a block and 29 lengths; the last two are never used. */
  CS_DEFLATE_LITERALS = 288,
  CS_DEFLATE_END_OF_BLOCK = 256,
  CS_DEFLATE_DISTANCES = 30,
  CS_DEFLATE_LONGEST_MATCH = 258,
  CS_DEFLATE_SHORTEST_MATCH = 3
};

typedef struct cs_deflate_symbol {
  int symbol, extra_bits;
  unsigned extra;
} cs_deflate_symbol;

static inline cs_deflate_symbol cs_deflate_symbol_of(unsigned number, int kept) {
  if (number >> (kept + 1) == 0)
    return (cs_deflate_symbol){(int)number, 0, 0};
  int extra_bits = 31 - __builtin_clz(number) - kept;
  int symbol = (extra_bits << kept) + (int)(number >> extra_bits);
  return (cs_deflate_symbol){symbol, extra_bits, number & ((1u << extra_bits) - 1)};
}

/* The greatest length, 258, has a symbol of its own. */
static inline cs_deflate_symbol cs_deflate_symbol_of_length(unsigned length_less_3) {
  cs_deflate_symbol made =
      length_less_3 == 255 ? (cs_deflate_symbol){28, 0, 0} : cs_deflate_symbol_of(length_less_3, 2);
  made.symbol += CS_DEFLATE_END_OF_BLOCK + 1;
  return made;
}

static inline cs_deflate_symbol cs_deflate_symbol_of_distance(unsigned distance_less_1) {
  return cs_deflate_symbol_of(distance_less_1, 1);
}

#endif
