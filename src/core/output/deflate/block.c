#include "output/deflate/block.h"

#include <stdint.h>

#include "output/deflate/huffman.h"

enum {
  LITERALS = CS_DEFLATE_LITERALS,
  DISTANCES = CS_DEFLATE_DISTANCES,
  END_OF_BLOCK = CS_DEFLATE_END_OF_BLOCK
};

/* ---------------------------------------------------------------- the header of a block */

/* The header of a block with codes of its own: the lengths of its codes, from which a reader
 * derives the codes, compressed once more (RFC 1951, 3.2.7).
 *
 *   literal lengths, distance lengths --> items: a length, or a run of equal ones --> bits
 */
enum { LENGTH_SYMBOLS = 19, LENGTH_LIMIT = 7 };
enum { REPEAT = 16, FEW_ZEROS = 17, MANY_ZEROS = 18 };

/* Items have a symbol: 0..15 is that length; 16 repeats the length before it, 17 and 18 are runs of
 * zeros, and their extra bits say how many. They are coded by a third code, `lengths` and `codes`.
 */
typedef struct code_header {
  int literal_count, distance_count; /* without the unused symbols at the end */
  int item_count, code_count;
  uint8_t symbol[LITERALS + DISTANCES];
  uint8_t extra[LITERALS + DISTANCES];
  uint8_t lengths[LENGTH_SYMBOLS];
  uint16_t codes[LENGTH_SYMBOLS];
  uint64_t size; /* the size of the header in bits, without the block's first three */
} code_header;

static const uint8_t extra_bits[LENGTH_SYMBOLS] = {[REPEAT] = 2, [FEW_ZEROS] = 3, [MANY_ZEROS] = 7};

/* The order in which the third code's own lengths are stored: the lengths most likely to be 0 come
 * last. */
static const uint8_t stored_order[LENGTH_SYMBOLS] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                     11, 4,  12, 3, 13, 2, 14, 1, 15};

static int count_used(const uint8_t *lengths, int count, int least) {
  while (count > least && lengths[count - 1] == 0)
    count--;
  return count;
}

static void add_item(code_header *header, int symbol, int extra) {
  header->symbol[header->item_count] = (uint8_t)symbol;
  header->extra[header->item_count++] = (uint8_t)extra;
}

/* Adds `run` equal lengths. */
static void add_run(code_header *header, int length, int run) {
  if (length > 0) {
    add_item(header, length, 0);
    run--;
  }
  while (run >= 3) {
    int most = length > 0 ? 6 : 138, count = run < most ? run : most;
    if (length > 0)
      add_item(header, REPEAT, count - 3);
    else if (count <= 10)
      add_item(header, FEW_ZEROS, count - 3);
    else
      add_item(header, MANY_ZEROS, count - 11);
    run -= count;
  }
  while (run-- > 0)
    add_item(header, length, 0);
}

static void add_runs(code_header *header, const uint8_t *lengths, int count) {
  for (int i = 0, run; i < count; i += run) {
    for (run = 1; i + run < count && lengths[i + run] == lengths[i]; run++) {
    }
    add_run(header, lengths[i], run);
  }
}

/* Makes the code of the items, and with it finds the size of the header. */
static void make_item_code(code_header *header) {
  uint32_t count[LENGTH_SYMBOLS] = {0};
  for (int i = 0; i < header->item_count; i++)
    count[header->symbol[i]]++;
  cs_deflate_huffman_lengths(count, LENGTH_SYMBOLS, LENGTH_LIMIT, header->lengths);
  cs_deflate_huffman_codes(header->lengths, LENGTH_SYMBOLS, header->codes);
  for (header->code_count = LENGTH_SYMBOLS; header->code_count > 4; header->code_count--)
    if (header->lengths[stored_order[header->code_count - 1]] > 0)
      break;
  header->size = 5 + 5 + 4 + 3 * (uint64_t)header->code_count;
  for (int i = 0; i < LENGTH_SYMBOLS; i++)
    header->size += count[i] * (uint64_t)(header->lengths[i] + extra_bits[i]);
}

static void make_header(code_header *header, const uint8_t literals[LITERALS],
                        const uint8_t distances[DISTANCES]) {
  header->item_count = 0;
  header->literal_count = count_used(literals, LITERALS, END_OF_BLOCK + 1);
  header->distance_count = count_used(distances, DISTANCES, 1);
  add_runs(header, literals, header->literal_count);
  add_runs(header, distances, header->distance_count);
  make_item_code(header);
}

/* The caller has made room. */
static void put_header(const code_header *header, cs_deflate_bit_stream *stream) {
  cs_deflate_bits_put(stream, (unsigned)(header->literal_count - 257), 5);
  cs_deflate_bits_put(stream, (unsigned)(header->distance_count - 1), 5);
  cs_deflate_bits_put(stream, (unsigned)(header->code_count - 4), 4);
  for (int i = 0; i < header->code_count; i++)
    cs_deflate_bits_put(stream, header->lengths[stored_order[i]], 3);
  for (int i = 0; i < header->item_count; i++) {
    int symbol = header->symbol[i];
    cs_deflate_bits_put(stream, header->codes[symbol], header->lengths[symbol]);
    cs_deflate_bits_put(stream, header->extra[i], extra_bits[symbol]);
  }
}

/* The first three bits of a block: whether it is the last (never, here), and its kind. */
enum { STORED_BLOCK = 0 << 1, FIXED_BLOCK = 1 << 1, OWN_CODES_BLOCK = 2 << 1 };

/* ---------------------------------------------------------------- codes */

typedef struct codes {
  uint8_t literal_lengths[LITERALS], distance_lengths[DISTANCES];
  uint16_t literals[LITERALS], distances[DISTANCES];
} codes;

/* How often each symbol occurs. */
typedef struct symbol_counts {
  uint32_t literals[LITERALS], distances[DISTANCES];
} symbol_counts;

static void count_symbols(symbol_counts *count, const cs_deflate_block_counts *tokens) {
  memset(count->literals, 0, sizeof count->literals);
  memcpy(count->distances, tokens->distances, sizeof count->distances);
  for (unsigned i = 0; i < 256; i++) {
    count->literals[i] += tokens->literals[0][i] + tokens->literals[1][i] + tokens->literals[2][i];
    count->literals[cs_deflate_symbol_of_length(i).symbol] += tokens->lengths[i];
  }
  for (unsigned i = 0; i < CS_DEFLATE_NEAR; i++)
    count->distances[cs_deflate_symbol_of_distance(i).symbol] += tokens->near_distances[i];
  count->literals[END_OF_BLOCK] = 1;
}

static void assign_codes(codes *code) {
  cs_deflate_huffman_codes(code->literal_lengths, LITERALS, code->literals);
  cs_deflate_huffman_codes(code->distance_lengths, DISTANCES, code->distances);
}

/* The codes that every reader knows (RFC 1951, 3.2.6). */
static void fixed_lengths(codes *code) {
  for (int symbol = 0; symbol < LITERALS; symbol++)
    code->literal_lengths[symbol] = symbol < 144 ? 8 : symbol < 256 ? 9 : symbol < 280 ? 7 : 8;
  memset(code->distance_lengths, 5, DISTANCES);
}

static void best_lengths(codes *code, const symbol_counts *count) {
  cs_deflate_huffman_lengths(count->literals, LITERALS, CS_DEFLATE_HUFFMAN_LIMIT,
                             code->literal_lengths);
  cs_deflate_huffman_lengths(count->distances, DISTANCES, CS_DEFLATE_HUFFMAN_LIMIT,
                             code->distance_lengths);
}

/* The bits of a block's tokens without their extra bits, whose number is the same for every
 * code. */
static uint64_t coded_size(const codes *code, const symbol_counts *count) {
  uint64_t bits = 0;
  for (int symbol = 0; symbol < LITERALS; symbol++)
    bits += (uint64_t)count->literals[symbol] * code->literal_lengths[symbol];
  for (int symbol = 0; symbol < DISTANCES; symbol++)
    bits += (uint64_t)count->distances[symbol] * code->distance_lengths[symbol];
  return bits;
}

/* ---------------------------------------------------------------- the tokens of a block */

/* The bits that are written for each literal, length and near distance: the code and the extra
 * bits, joined once for each block. */
typedef struct bit_string {
  uint32_t bits;
  unsigned count;
} bit_string;

static bit_string join(uint16_t code, uint8_t code_bits, cs_deflate_symbol symbol) {
  return (bit_string){code | symbol.extra << code_bits, code_bits + (unsigned)symbol.extra_bits};
}

/* The bits of a longest match at a near distance, repeated as often as they fit into one word. */
typedef struct repeat {
  uint64_t bits;
  unsigned times, unit; /* unit: how many bits one match has */
} repeat;

typedef struct code_book {
  bit_string literals[256], lengths[256], near_distances[CS_DEFLATE_NEAR];
  repeat longest[CS_DEFLATE_NEAR];
} code_book;

static repeat repeat_longest(bit_string length, bit_string distance) {
  enum { MOST = 56 };
  unsigned unit = length.count + distance.count;
  repeat made = {.times = MOST / (unit ? unit : MOST), .unit = unit};
  for (unsigned i = 0; i < made.times; i++)
    made.bits |= (length.bits | (uint64_t)distance.bits << length.count) << i * unit;
  return made;
}

static void make_book(code_book *book, const codes *code) {
  for (unsigned i = 0; i < 256; i++) {
    cs_deflate_symbol length = cs_deflate_symbol_of_length(i);
    book->literals[i] = (bit_string){code->literals[i], code->literal_lengths[i]};
    book->lengths[i] =
        join(code->literals[length.symbol], code->literal_lengths[length.symbol], length);
  }
  for (unsigned i = 0; i < CS_DEFLATE_NEAR; i++) {
    cs_deflate_symbol distance = cs_deflate_symbol_of_distance(i);
    book->near_distances[i] =
        join(code->distances[distance.symbol], code->distance_lengths[distance.symbol], distance);
    book->longest[i] = repeat_longest(book->lengths[255], book->near_distances[i]);
  }
}

/* Puts `times` longest matches. */
static inline void put_longest(cs_deflate_bit_stream *stream, const repeat *longest,
                               unsigned times) {
  for (; times > longest->times; times -= longest->times)
    cs_deflate_bits_put(stream, longest->bits, longest->times * longest->unit);
  unsigned count = times * longest->unit;
  cs_deflate_bits_put(stream, longest->bits & (((uint64_t)1 << count) - 1), count);
}

static inline void put_match(cs_deflate_bit_stream *stream, const codes *code,
                             const code_book *book, cs_deflate_token token) {
  unsigned less_1 = token & 0x7fff, times = token >> 24 & CS_DEFLATE_TIMES;
  bit_string length = book->lengths[token >> 16 & 255], distance;
  if (less_1 < CS_DEFLATE_NEAR) {
    distance = book->near_distances[less_1];
  } else {
    cs_deflate_symbol far = cs_deflate_symbol_of_distance(less_1);
    distance = join(code->distances[far.symbol], code->distance_lengths[far.symbol], far);
  }
  if (times > 0)
    put_longest(stream, &book->longest[less_1], times);
  cs_deflate_bits_put(stream, length.bits | (uint64_t)distance.bits << length.count,
                      length.count + distance.count);
}

static inline void put_triple(cs_deflate_bit_stream *stream, const code_book *book,
                              cs_deflate_token token) {
  bit_string a = book->literals[token & 255], b = book->literals[token >> 8 & 255];
  bit_string c = book->literals[token >> 16 & 255];
  uint64_t bits = a.bits | (uint64_t)b.bits << a.count | (uint64_t)c.bits << (a.count + b.count);
  cs_deflate_bits_put(stream, bits, a.count + b.count + c.count);
}

static void put_tokens(cs_deflate_bit_stream *stream, const codes *code,
                       const cs_deflate_token *tokens, size_t count) {
  code_book book;
  make_book(&book, code);
  for (const cs_deflate_token *token = tokens; token < tokens + count; token++) {
    cs_deflate_bits_make_room(stream);
    if (*token >> 30 == 1)
      put_triple(stream, &book, *token);
    else if (*token < 256)
      cs_deflate_bits_put(stream, book.literals[*token].bits, book.literals[*token].count);
    else
      put_match(stream, code, &book, *token);
  }
  cs_deflate_bits_put(stream, code->literals[END_OF_BLOCK], code->literal_lengths[END_OF_BLOCK]);
}

/* ---------------------------------------------------------------- blocks */

static void drop_tokens(cs_deflate_block *block) {
  block->token_count = 0;
  memset(&block->counts, 0, sizeof block->counts);
}

void cs_deflate_block_begin(cs_deflate_block *block) {
  cs_deflate_bits_begin(&block->output);
  drop_tokens(block);
}

void cs_deflate_block_match(cs_deflate_block *block, size_t length, size_t distance) {
  unsigned length_less_3 = (unsigned)length - 3, less_1 = (unsigned)distance - 1;
  block->counts.lengths[length_less_3]++;
  block->counts.distances[cs_deflate_symbol_of_distance(less_1).symbol]++;
  cs_deflate_block_add(block, 0x80000000u | length_less_3 << 16 | less_1);
}

void cs_deflate_block_put(cs_deflate_block *block) {
  cs_deflate_bit_stream stream = cs_deflate_bits_open(&block->output);
  symbol_counts counts;
  codes own, fixed;
  code_header header;
  count_symbols(&counts, &block->counts);
  best_lengths(&own, &counts);
  fixed_lengths(&fixed);
  make_header(&header, own.literal_lengths, own.distance_lengths);
  bool own_is_shorter = coded_size(&own, &counts) + header.size < coded_size(&fixed, &counts);
  cs_deflate_bits_make_room(&stream);
  cs_deflate_bits_put(&stream, own_is_shorter ? OWN_CODES_BLOCK : FIXED_BLOCK, 3);
  if (own_is_shorter)
    put_header(&header, &stream);
  codes *chosen = own_is_shorter ? &own : &fixed;
  assign_codes(chosen);
  put_tokens(&stream, chosen, block->tokens, block->token_count);
  cs_deflate_bits_close(&stream);
  drop_tokens(block);
}

/* A stored block begins at a whole byte, with the count of its bytes and the complement of this
 * count; here it has no bytes (RFC 1951, 3.2.4). */
static void put_aligning_block(cs_deflate_block *block) {
  cs_deflate_bit_stream stream = cs_deflate_bits_open(&block->output);
  cs_deflate_bits_make_room(&stream);
  cs_deflate_bits_put(&stream, STORED_BLOCK, 3);
  cs_deflate_bits_put(&stream, 0, (8 - stream.count) % 8);
  cs_deflate_bits_put(&stream, 0xffff0000u, 32);
  cs_deflate_bits_close(&stream);
}

void cs_deflate_block_end(cs_deflate_block *block) {
  if (block->token_count > 0)
    cs_deflate_block_put(block);
  put_aligning_block(block);
  cs_deflate_bits_drain(&block->output, block->output.size);
}
