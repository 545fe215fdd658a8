#include "deflate/block.h"

#include <string.h>

#include "deflate/huffman.h"

enum {
  LITERALS = 288, /* with the end of block and 29 lengths; the last two are never used */
  DISTANCES = CS_BLOCK_DISTANCES,
  END_OF_BLOCK = 256,
  LENGTH_CODES = 19 /* of the code that codes the code lengths */
};

/* ---------------------------------------------------------------- bits */

/* Of what is put between two times that room is made: a token, or the header of a block. */
enum { ROOM = 1024 };

/* The writer's bits while a block is put: no byte that is stored can alias them. */
typedef struct bit_stream {
  uint64_t bits;
  unsigned count; /* below 8 */
  unsigned char *at;
  cs_deflate_block_writer *writer;
} bit_stream;

static bit_stream open_stream(cs_deflate_block_writer *writer) {
  return (bit_stream){writer->bits, writer->bit_count, writer->bytes + writer->size, writer};
}

static void drain(cs_deflate_block_writer *writer, size_t size) {
  if (writer->status == CELSPAN_OK && size > 0)
    writer->status = writer->write(writer->user, writer->context, writer->bytes, size);
  writer->size = 0;
}

/* For ROOM more bytes, and a word beyond. */
static inline void make_room(bit_stream *stream) {
  cs_deflate_block_writer *writer = stream->writer;
  if (stream->at > writer->bytes + CS_BLOCK_BYTES - ROOM) {
    drain(writer, (size_t)(stream->at - writer->bytes));
    stream->at = writer->bytes;
  }
}

/* count <= 56. All is stored every time, because when it must be cannot be foreseen. */
static inline void put_bits(bit_stream *stream, uint64_t bits, unsigned count) {
  stream->bits |= bits << stream->count;
  stream->count += count;
  memcpy(stream->at, &stream->bits, 8);
  stream->at += stream->count / 8;
  stream->bits >>= stream->count & ~7u;
  stream->count &= 7;
}

static void close_stream(bit_stream *stream) {
  stream->writer->bits = stream->bits;
  stream->writer->bit_count = stream->count;
  stream->writer->size = (size_t)(stream->at - stream->writer->bytes);
}

/* ---------------------------------------------------------------- symbols */

static int floor_log2(unsigned x) { return 31 - __builtin_clz(x); }

/* Lengths and distances are coded alike: a symbol for the leading bits (`kept` of them after the
 * first one) and the rest as they are. */
typedef struct parts {
  int symbol, extra_bits;
  unsigned extra;
} parts;

static inline parts split_number(unsigned number, int kept) {
  if (number >> (kept + 1) == 0)
    return (parts){(int)number, 0, 0};
  int extra_bits = floor_log2(number) - kept;
  int symbol = (extra_bits << kept) + (int)(number >> extra_bits);
  return (parts){symbol, extra_bits, number & ((1u << extra_bits) - 1)};
}

static parts split_length(unsigned length_less_3) {
  parts split = length_less_3 == 255 ? (parts){28, 0, 0} : split_number(length_less_3, 2);
  split.symbol += END_OF_BLOCK + 1;
  return split;
}

static inline parts split_distance(unsigned distance_less_1) {
  return split_number(distance_less_1, 1);
}

/* ---------------------------------------------------------------- codes */

typedef struct codes {
  uint8_t literal_lengths[LITERALS], distance_lengths[DISTANCES];
  uint16_t literals[LITERALS], distances[DISTANCES];
} codes;

typedef struct counts {
  uint32_t literals[LITERALS], distances[DISTANCES];
} counts;

/* From what was told to symbols. */
static void count_symbols(counts *count, const cs_deflate_block_counts *told) {
  memset(count->literals, 0, sizeof count->literals);
  memcpy(count->distances, told->distances, sizeof count->distances);
  for (unsigned i = 0; i < 256; i++) {
    count->literals[i] += told->literals[0][i] + told->literals[1][i] + told->literals[2][i];
    count->literals[split_length(i).symbol] += told->lengths[i];
  }
  for (unsigned i = 0; i < CS_BLOCK_NEAR; i++)
    count->distances[split_distance(i).symbol] += told->near_distances[i];
  count->literals[END_OF_BLOCK] = 1;
}

static void assign_codes(codes *code) {
  cs_deflate_huffman_codes(code->literal_lengths, LITERALS, code->literals);
  cs_deflate_huffman_codes(code->distance_lengths, DISTANCES, code->distances);
}

static void fixed_lengths(codes *code) {
  for (int symbol = 0; symbol < LITERALS; symbol++)
    code->literal_lengths[symbol] = symbol < 144 ? 8 : symbol < 256 ? 9 : symbol < 280 ? 7 : 8;
  memset(code->distance_lengths, 5, DISTANCES);
}

static void best_lengths(codes *code, const counts *count) {
  cs_deflate_huffman_lengths(count->literals, LITERALS, CS_HUFFMAN_LIMIT, code->literal_lengths);
  cs_deflate_huffman_lengths(count->distances, DISTANCES, CS_HUFFMAN_LIMIT, code->distance_lengths);
}

/* Bits of a block's tokens without their extra bits, which no code changes. */
static uint64_t coded_size(const codes *code, const counts *count) {
  uint64_t bits = 0;
  for (int symbol = 0; symbol < LITERALS; symbol++)
    bits += (uint64_t)count->literals[symbol] * code->literal_lengths[symbol];
  for (int symbol = 0; symbol < DISTANCES; symbol++)
    bits += (uint64_t)count->distances[symbol] * code->distance_lengths[symbol];
  return bits;
}

/* ---------------------------------------------------------------- the header of a block */

/* The code lengths in run lengths, themselves to be coded: symbols 0..15 are lengths, 16 repeats
 * the last, 17 and 18 are runs of zeros. */
typedef struct header {
  int literal_count, distance_count, item_count, code_count;
  uint8_t symbol[LITERALS + DISTANCES], extra[LITERALS + DISTANCES];
  uint8_t lengths[LENGTH_CODES];
  uint16_t codes[LENGTH_CODES];
  uint64_t size; /* in bits, without the block's first three */
} header;

static const uint8_t length_extra_bits[LENGTH_CODES] = {[16] = 2, [17] = 3, [18] = 7};

static int used(const uint8_t *lengths, int count, int least) {
  while (count > least && lengths[count - 1] == 0)
    count--;
  return count;
}

static void add_item(header *head, int symbol, int extra) {
  head->symbol[head->item_count] = (uint8_t)symbol;
  head->extra[head->item_count++] = (uint8_t)extra;
}

/* `run` equal lengths. */
static void add_run(header *head, int length, int run) {
  if (length > 0) {
    add_item(head, length, 0);
    run--;
  }
  while (run >= 3) {
    int most = length > 0 ? 6 : 138, part = run < most ? run : most;
    if (length > 0)
      add_item(head, 16, part - 3);
    else if (part <= 10)
      add_item(head, 17, part - 3);
    else
      add_item(head, 18, part - 11);
    run -= part;
  }
  while (run-- > 0)
    add_item(head, length, 0);
}

static void add_runs(header *head, const uint8_t *lengths, int count) {
  for (int i = 0, run; i < count; i += run) {
    for (run = 1; i + run < count && lengths[i + run] == lengths[i]; run++) {
    }
    add_run(head, lengths[i], run);
  }
}

static const uint8_t length_order[LENGTH_CODES] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                   11, 4,  12, 3, 13, 2, 14, 1, 15};

static void make_header(header *head, const codes *code) {
  uint32_t count[LENGTH_CODES] = {0};
  head->item_count = 0;
  head->literal_count = used(code->literal_lengths, LITERALS, 257);
  head->distance_count = used(code->distance_lengths, DISTANCES, 1);
  add_runs(head, code->literal_lengths, head->literal_count);
  add_runs(head, code->distance_lengths, head->distance_count);
  for (int i = 0; i < head->item_count; i++)
    count[head->symbol[i]]++;
  cs_deflate_huffman_lengths(count, LENGTH_CODES, 7, head->lengths);
  cs_deflate_huffman_codes(head->lengths, LENGTH_CODES, head->codes);
  for (head->code_count = LENGTH_CODES; head->code_count > 4; head->code_count--)
    if (head->lengths[length_order[head->code_count - 1]] > 0)
      break;
  head->size = 5 + 5 + 4 + 3 * (uint64_t)head->code_count;
  for (int i = 0; i < LENGTH_CODES; i++)
    head->size += count[i] * (uint64_t)(head->lengths[i] + length_extra_bits[i]);
}

static void put_header(bit_stream *stream, const header *head) {
  put_bits(stream, (unsigned)(head->literal_count - 257), 5);
  put_bits(stream, (unsigned)(head->distance_count - 1), 5);
  put_bits(stream, (unsigned)(head->code_count - 4), 4);
  for (int i = 0; i < head->code_count; i++)
    put_bits(stream, head->lengths[length_order[i]], 3);
  for (int i = 0; i < head->item_count; i++) {
    int symbol = head->symbol[i];
    put_bits(stream, head->codes[symbol], head->lengths[symbol]);
    put_bits(stream, head->extra[i], length_extra_bits[symbol]);
  }
}

/* ---------------------------------------------------------------- the tokens of a block */

/* A code with its extra bits. */
typedef struct bit_string {
  uint32_t bits;
  unsigned count;
} bit_string;

static bit_string join(uint16_t code, uint8_t code_bits, parts split) {
  return (bit_string){code | split.extra << code_bits, code_bits + (unsigned)split.extra_bits};
}

/* The longest match from a near distance, as often as fits into one word. */
typedef struct repeat {
  uint64_t bits;
  unsigned times, unit; /* bits of one */
} repeat;

typedef struct code_book {
  bit_string literals[256], lengths[256], near_distances[CS_BLOCK_NEAR];
  repeat longest[CS_BLOCK_NEAR];
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
    parts length = split_length(i);
    book->literals[i] = (bit_string){code->literals[i], code->literal_lengths[i]};
    book->lengths[i] =
        join(code->literals[length.symbol], code->literal_lengths[length.symbol], length);
  }
  for (unsigned i = 0; i < CS_BLOCK_NEAR; i++) {
    parts distance = split_distance(i);
    book->near_distances[i] =
        join(code->distances[distance.symbol], code->distance_lengths[distance.symbol], distance);
    book->longest[i] = repeat_longest(book->lengths[255], book->near_distances[i]);
  }
}

static inline void put_longest(bit_stream *stream, const repeat *longest, unsigned times) {
  for (; times > longest->times; times -= longest->times)
    put_bits(stream, longest->bits, longest->times * longest->unit);
  unsigned count = times * longest->unit;
  put_bits(stream, longest->bits & (((uint64_t)1 << count) - 1), count);
}

static inline void put_match(bit_stream *stream, const codes *code, const code_book *book,
                             cs_token token) {
  unsigned less_1 = token & 0x7fff, times = token >> 24 & CS_BLOCK_TIMES;
  bit_string length = book->lengths[token >> 16 & 255], distance;
  if (less_1 < CS_BLOCK_NEAR) {
    distance = book->near_distances[less_1];
  } else {
    parts split = split_distance(less_1);
    distance = join(code->distances[split.symbol], code->distance_lengths[split.symbol], split);
  }
  if (times > 0)
    put_longest(stream, &book->longest[less_1], times);
  put_bits(stream, length.bits | (uint64_t)distance.bits << length.count,
           length.count + distance.count);
}

static inline void put_triple(bit_stream *stream, const code_book *book, cs_token token) {
  bit_string a = book->literals[token & 255], b = book->literals[token >> 8 & 255];
  bit_string c = book->literals[token >> 16 & 255];
  uint64_t bits = a.bits | (uint64_t)b.bits << a.count | (uint64_t)c.bits << (a.count + b.count);
  put_bits(stream, bits, a.count + b.count + c.count);
}

static void put_tokens(bit_stream *stream, const codes *code, const cs_token *tokens,
                       size_t count) {
  code_book book;
  make_book(&book, code);
  for (const cs_token *token = tokens; token < tokens + count; token++) {
    make_room(stream);
    if (*token >> 30 == 1)
      put_triple(stream, &book, *token);
    else if (*token < 256)
      put_bits(stream, book.literals[*token].bits, book.literals[*token].count);
    else
      put_match(stream, code, &book, *token);
  }
  put_bits(stream, code->literals[END_OF_BLOCK], code->literal_lengths[END_OF_BLOCK]);
}

/* ---------------------------------------------------------------- blocks */

static void forget_tokens(cs_deflate_block_writer *writer) {
  writer->token_count = 0;
  memset(&writer->counts, 0, sizeof writer->counts);
}

void cs_deflate_block_begin(cs_deflate_block_writer *writer) {
  writer->status = CELSPAN_OK;
  writer->bits = 0;
  writer->bit_count = 0;
  writer->size = 0;
  forget_tokens(writer);
}

void cs_deflate_block_match(cs_deflate_block_writer *writer, size_t length, size_t distance) {
  unsigned length_less_3 = (unsigned)length - 3, less_1 = (unsigned)distance - 1;
  writer->counts.lengths[length_less_3]++;
  writer->counts.distances[split_distance(less_1).symbol]++;
  cs_deflate_block_add(writer, 0x80000000u | length_less_3 << 16 | less_1);
}

void cs_deflate_block_put(cs_deflate_block_writer *writer) {
  bit_stream stream = open_stream(writer);
  counts frequency;
  codes own, fixed;
  header head;
  count_symbols(&frequency, &writer->counts);
  best_lengths(&own, &frequency);
  fixed_lengths(&fixed);
  make_header(&head, &own);
  bool own_is_shorter = coded_size(&own, &frequency) + head.size < coded_size(&fixed, &frequency);
  make_room(&stream);
  put_bits(&stream, own_is_shorter ? 4 : 2, 3);
  if (own_is_shorter)
    put_header(&stream, &head);
  codes *chosen = own_is_shorter ? &own : &fixed;
  assign_codes(chosen);
  put_tokens(&stream, chosen, writer->tokens, writer->token_count);
  close_stream(&stream);
  forget_tokens(writer);
}

/* Bytes as they are, none of them, with their count and its complement (RFC 1951, 3.2.4). */
static void put_aligning_block(cs_deflate_block_writer *writer) {
  bit_stream stream = open_stream(writer);
  make_room(&stream);
  put_bits(&stream, 0, 3);
  put_bits(&stream, 0, (8 - stream.count) % 8);
  put_bits(&stream, 0xffff0000u, 32);
  close_stream(&stream);
}

void cs_deflate_block_end(cs_deflate_block_writer *writer) {
  if (writer->token_count > 0)
    cs_deflate_block_put(writer);
  put_aligning_block(writer);
  drain(writer, writer->size);
}
