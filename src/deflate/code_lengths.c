#include "deflate/code_lengths.h"

#include "deflate/huffman.h"

enum { SYMBOLS = CS_DEFLATE_LENGTH_SYMBOLS, LENGTH_LIMIT = 7 };
enum { REPEAT = 16, FEW_ZEROS = 17, MANY_ZEROS = 18 };

static const uint8_t extra_bits[SYMBOLS] = {[REPEAT] = 2, [FEW_ZEROS] = 3, [MANY_ZEROS] = 7};

/* The order in which the third code's own lengths are stored: those most likely to be 0 last. */
static const uint8_t stored_order[SYMBOLS] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                              11, 4,  12, 3, 13, 2, 14, 1, 15};

static int count_used(const uint8_t *lengths, int count, int least) {
  while (count > least && lengths[count - 1] == 0)
    count--;
  return count;
}

static void add_item(cs_deflate_code_lengths *header, int symbol, int extra) {
  header->symbol[header->item_count] = (uint8_t)symbol;
  header->extra[header->item_count++] = (uint8_t)extra;
}

/* `run` equal lengths. */
static void add_run(cs_deflate_code_lengths *header, int length, int run) {
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

static void add_runs(cs_deflate_code_lengths *header, const uint8_t *lengths, int count) {
  for (int i = 0, run; i < count; i += run) {
    for (run = 1; i + run < count && lengths[i + run] == lengths[i]; run++) {
    }
    add_run(header, lengths[i], run);
  }
}

/* The code of the items, and with it the size of the header. */
static void make_item_code(cs_deflate_code_lengths *header) {
  uint32_t count[SYMBOLS] = {0};
  for (int i = 0; i < header->item_count; i++)
    count[header->symbol[i]]++;
  cs_deflate_huffman_lengths(count, SYMBOLS, LENGTH_LIMIT, header->lengths);
  cs_deflate_huffman_codes(header->lengths, SYMBOLS, header->codes);
  for (header->code_count = SYMBOLS; header->code_count > 4; header->code_count--)
    if (header->lengths[stored_order[header->code_count - 1]] > 0)
      break;
  header->size = 5 + 5 + 4 + 3 * (uint64_t)header->code_count;
  for (int i = 0; i < SYMBOLS; i++)
    header->size += count[i] * (uint64_t)(header->lengths[i] + extra_bits[i]);
}

void cs_deflate_code_lengths_make(cs_deflate_code_lengths *header,
                                  const uint8_t literals[CS_DEFLATE_LITERALS],
                                  const uint8_t distances[CS_DEFLATE_DISTANCES]) {
  header->item_count = 0;
  header->literal_count = count_used(literals, CS_DEFLATE_LITERALS, CS_DEFLATE_END_OF_BLOCK + 1);
  header->distance_count = count_used(distances, CS_DEFLATE_DISTANCES, 1);
  add_runs(header, literals, header->literal_count);
  add_runs(header, distances, header->distance_count);
  make_item_code(header);
}

void cs_deflate_code_lengths_put(const cs_deflate_code_lengths *header,
                                 cs_deflate_bit_stream *stream) {
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
