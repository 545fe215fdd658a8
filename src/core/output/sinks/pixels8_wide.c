/* A frame may have 10^9 pixels in rows of this coding, most of them in long runs, while most runs
 * have one pixel. Neither should wait for the other, so a portion of spans at a time goes through
 * three passes (a chunk is 64 bytes, 16 pixels; lines are chunks on cache lines):
 *
 *   spans      |a|b|         c                       |d| e  |
 *   lines                |cccccccc|cccccccc|cccccccc|
 *   heads      |aaaaaaaa|
 *                |bbbbbbbb|
 *                  |cccccccc|
 *                                                    |dddddddd|
 *                                                      |eeeeeeee|
 *   row        |a|b|ccccccccccccccccccccccccccccccccc|d|eeee
 *
 *   1. the colours of all spans are coded, several at once;
 *   2. each line that begins inside a run longer than a chunk is filled with that run's pixel;
 *   3. from left to right, each span writes a head, the first chunk from its start.
 *
 * Where a line or a head covers more than its span, the pixels belong to spans further right, whose
 * heads come later. Only at the end of the row must nothing be written beyond. So there is no
 * branch on the length of a run, which a processor could not predict.
 */
#include "output/sinks/pixels8.h"

#ifdef __SSE2__
#include <immintrin.h>
#endif

enum {
  PORTION = 64, /* spans: as many as a word has bits */
  LINES = 1024, /* the most in a portion; a wider portion is filled run by run */
  LINE_PIXELS = CS_FILL_CHUNK / 4
};

/* A row that is being written. */
typedef struct target {
  unsigned char *pixels;
  size_t size;     /* bytes */
  uintptr_t phase; /* see output/sinks/pixels8.h */
} target;

static inline cs_wide_int all_of(uint32_t pixel) { return (cs_wide_int){0} + (int32_t)pixel; }

/* ---------------------------------------------------------------- colours */

/* codes: of a portion. The entries of spans that are not single have no meaning. */
static inline void code_colours(const celspan_span *spans, size_t count, bool is_coded,
                                uint32_t *codes) {
  size_t k = 0;
  for (; k + CS_WIDE_LANES <= count; k += CS_WIDE_LANES) {
    const cs_srgb8_planes colours =
        cs_srgb8_planes_of(spans[k].colour, sizeof *spans / sizeof *spans->colour);
    const cs_wide_int pixels = cs_srgb8_code_planes(&colours, is_coded);
    memcpy(codes + k, &pixels, sizeof pixels);
  }
  for (; k < count; k += CS_SRGB8_PIXELS) {
    const float *together[CS_SRGB8_PIXELS];
    for (size_t i = 0; i < CS_SRGB8_PIXELS; i++)
      together[i] = spans[k + i < count ? k + i : k].colour;
    cs_srgb8_lanes(cs_wide_pixels(together), is_coded, (unsigned char *)(codes + k));
  }
}

/* ---------------------------------------------------------------- lines of long runs */

typedef int32_t quad __attribute__((vector_size(16)));

static inline quad load_place(const celspan_span *span) {
  quad place; /* x0 and x1, and two fields that are not used */
  memcpy(&place, span, sizeof place);
  return place;
}

static inline bool is_long(const celspan_span *span) { return span->x1 - span->x0 > LINE_PIXELS; }

/* A bit for each of four spans: whether it is longer than its head. */
static inline uint64_t are_long(const celspan_span *spans) {
#ifdef __SSE2__
  quad low = __builtin_shufflevector(load_place(spans), load_place(spans + 1), 0, 4, 1, 5);
  quad high = __builtin_shufflevector(load_place(spans + 2), load_place(spans + 3), 0, 4, 1, 5);
  quad x0 = __builtin_shufflevector(low, high, 0, 1, 4, 5);
  quad x1 = __builtin_shufflevector(low, high, 2, 3, 6, 7);
  return (uint64_t)_mm_movemask_ps((__m128)(x1 - x0 > LINE_PIXELS));
#else
  uint64_t bits = 0;
  for (int k = 0; k < 4; k++)
    bits |= (uint64_t)is_long(&spans[k]) << k;
  return bits;
#endif
}

/* The same for up to 64 spans. */
static inline uint64_t find_long(const celspan_span *spans, size_t count) {
  uint64_t longs = 0;
  size_t k = 0;
  for (; k + 4 <= count; k += 4)
    longs |= are_long(spans + k) << k;
  for (; k < count; k++)
    longs |= (uint64_t)is_long(&spans[k]) << k;
  return longs;
}

/* How many lines begin in columns [first, x), where a line begins at `first`. */
static inline size_t lines_before(int32_t x, int32_t first) {
  return (uint32_t)(x - (first - (LINE_PIXELS - 1))) / LINE_PIXELS;
}

/* Sets owners[i] to the span in which line i begins, if that span is a long run; otherwise to any
 * span. (The owner of a line is a byte, so that one store sets 64 of them.) */
static inline void mark_lines(const celspan_span *spans, uint64_t longs, int32_t first,
                              unsigned char *owners) {
  for (size_t line = 0; line < LINES; line += CS_FILL_CHUNK)
    cs_fill_store(owners + line, all_of(0));
  for (; longs != 0; longs &= longs - 1) {
    uint32_t k = (uint32_t)__builtin_ctzll(longs);
    cs_wide_int mark = all_of(k * 0x01010101u);
    size_t line = lines_before(spans[k].x0, first), end = lines_before(spans[k].x1, first);
    do {
      cs_fill_store(owners + line, mark);
      line += CS_FILL_CHUNK;
    } while (line < end);
  }
}

/* Fills the lines run by run; used if runs are few and very long. */
static inline void fill_runs(const target *row, const celspan_span *spans, uint64_t longs,
                             const uint32_t *codes) {
  for (; longs != 0; longs &= longs - 1) {
    size_t k = (size_t)__builtin_ctzll(longs);
    cs_fill_lines(row->pixels + 4 * (size_t)spans[k].x0, row->pixels + 4 * (size_t)spans[k].x1,
                  all_of(codes[k]), row->phase);
  }
}

static inline void fill_lines(const target *row, const celspan_span *spans, size_t count,
                              const uint32_t *codes) {
  unsigned char owners[LINES + 2 * CS_FILL_CHUNK];
  uint64_t longs = find_long(spans, count);
  if (longs == 0)
    return;
  uintptr_t offset = ((uintptr_t)row->pixels - row->phase) % CS_FILL_CHUNK;
  int32_t first = offset > 0 ? (int32_t)(CS_FILL_CHUNK - offset) / 4 : 0;
  first += LINE_PIXELS * (int32_t)lines_before(spans[__builtin_ctzll(longs)].x0, first);
  size_t lines = lines_before(spans[63 - __builtin_clzll(longs)].x1, first);
  if (lines > LINES) {
    fill_runs(row, spans, longs, codes);
    return;
  }
  mark_lines(spans, longs, first, owners);
  unsigned char *out = row->pixels + 4 * (size_t)first;
  size_t line = 0;
  for (; line + 4 <= lines; line += 4, out += 4 * CS_FILL_CHUNK)
    for (size_t k = 0; k < 4; k++)
      cs_fill_store(out + k * CS_FILL_CHUNK, all_of(codes[owners[line + k]]));
  for (; line < lines; line++, out += CS_FILL_CHUNK)
    cs_fill_store(out, all_of(codes[owners[line]]));
}

/* ---------------------------------------------------------------- gradients and arrays */

/* room: the bytes up to the end of the row, which may be overwritten. */
static inline void put_short_gradient(const celspan_span *span, bool is_coded, unsigned char *out,
                                      size_t room) {
  const cs_wide colour = cs_wide_pixel(span->colour), slope = cs_wide_pixel(span->slope);
  const cs_wide numbers = cs_wide_pixel_numbers();
  unsigned char last[CS_WIDE_LANES];
  for (int32_t x = span->x0; x < span->x1; x += CS_SRGB8_PIXELS) {
    cs_wide rgba = colour + slope * (numbers + (float)(x - span->origin));
    cs_srgb8_lanes(rgba, is_coded, room >= sizeof last ? out : last);
    if (room < sizeof last) {
      memcpy(out, last, room);
      return;
    }
    out += sizeof last;
    room -= sizeof last;
  }
}

/* Writes a register of pixels at once, channel by channel. */
static inline void put_gradient(const celspan_span *span, bool is_coded, unsigned char *out,
                                size_t room) {
  if (span->x1 - span->x0 <= CS_WIDE_LANES / 2) {
    put_short_gradient(span, is_coded, out, room);
    return;
  }
  for (int32_t x = span->x0; x < span->x1; x += CS_WIDE_LANES, out += 4 * CS_WIDE_LANES) {
    const cs_srgb8_planes colours = cs_pixels8_columns(span, x);
    const cs_wide_int pixels = cs_srgb8_code_planes(&colours, is_coded);
    const int32_t left = span->x1 - x;
    memcpy(out, &pixels, 4 * (size_t)(left < CS_WIDE_LANES ? left : CS_WIDE_LANES));
  }
}

static inline void put_varied(const target *row, bool is_coded, const celspan_span *span) {
  size_t at = 4 * (size_t)span->x0, count = (size_t)(span->x1 - span->x0);
  if (span->kind == CELSPAN_SPAN_GRADIENT)
    put_gradient(span, is_coded, row->pixels + at, row->size - at);
  /* otherwise they are already in their places */
  else if (span->codes && span->codes != row->pixels + at)
    memcpy(row->pixels + at, span->codes, 4 * count);
  else if (span->codes)
    return;
  else if (is_coded)
    CS_WIDE(cs_srgb8_codes)(span->array, count, row->pixels + at);
  else
    CS_WIDE(cs_srgb8_code)(span->array, count, row->pixels + at);
}

/* ---------------------------------------------------------------- rows */

static inline void put_heads(const target *row, bool is_coded, const celspan_span *spans,
                             size_t count, const uint32_t *codes) {
  for (size_t k = 0; k < count; k++)
    if (spans[k].kind == CELSPAN_SPAN_SINGLE)
      cs_fill_store(row->pixels + 4 * (size_t)spans[k].x0, all_of(codes[k]));
    else
      put_varied(row, is_coded, &spans[k]);
}

/* Spans that are so near to the end of the row that nothing may be written after them. */
static inline void put_last(const target *row, bool is_coded, const celspan_span *spans,
                            size_t count, const uint32_t *codes) {
  for (size_t k = 0; k < count; k++)
    if (spans[k].kind == CELSPAN_SPAN_SINGLE)
      cs_fill_exactly(row->pixels + 4 * (size_t)spans[k].x0, row->pixels + 4 * (size_t)spans[k].x1,
                      all_of(codes[k]), row->phase);
    else
      put_varied(row, is_coded, &spans[k]);
}

static inline void put_row(const celspan_span *spans, size_t count, bool is_coded,
                           unsigned char *pixels) {
  const target row = {pixels, 4 * (size_t)spans[count - 1].x1, (uintptr_t)pixels % 4};
  uint32_t codes[PORTION];
  /* Arrays at the left are written first and separately: their codes may already be in their
   * places. */
  for (; count > 0 && spans->kind == CELSPAN_SPAN_ARRAY; count--, spans++)
    put_varied(&row, is_coded, spans);
  for (size_t portion; count > 0; count -= portion, spans += portion) {
    portion = count < PORTION ? count : PORTION;
    code_colours(spans, portion, is_coded, codes);
    size_t inner = portion;
    while (inner > 0 && 4 * (size_t)spans[inner - 1].x1 + CS_FILL_CHUNK > row.size)
      inner--;
    fill_lines(&row, spans, inner, codes);
    put_heads(&row, is_coded, spans, inner, codes);
    put_last(&row, is_coded, spans + inner, portion - inner, codes + inner);
  }
}

void CS_WIDE(cs_pixels8_row)(const celspan_span *spans, size_t count, unsigned char *row) {
  put_row(spans, count, false, row);
}

void CS_WIDE(cs_pixels8_codes)(const celspan_span *spans, size_t count, unsigned char *row) {
  put_row(spans, count, true, row);
}

void CS_WIDE(cs_fill_run)(unsigned char *out, size_t size, const unsigned char *pixel,
                          size_t pixel_size) {
  unsigned char bytes[sizeof(cs_wide_int)];
  cs_wide_int pattern;
  memcpy(bytes, pixel, pixel_size);
  for (size_t done = pixel_size; done < sizeof bytes; done *= 2)
    memcpy(bytes + done, bytes, done);
  memcpy(&pattern, bytes, sizeof pattern);
  cs_fill_exactly(out, out + size, pattern, (uintptr_t)out % pixel_size);
}
