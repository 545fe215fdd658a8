/* A frame may have a thousand million pixels in rows of this coding, most of them in long runs and
 * most runs a pixel long. Spans are taken a portion at a time:
 *
 *   1. their colours are coded, several at once;
 *   2. lines of the cache are filled that begin inside a long run;
 *   3. from left to right every span's first block is written, its head.
 *
 * What a head or a line covers beyond its span belongs to spans further right, whose heads come
 * later; only at the end of the row is care taken. So nothing branches on the lengths of runs,
 * which a processor cannot foresee.
 */
#include "output/pixels8.h"

#include "colour/srgb8_lanes.h"
#include "output/fill.h"

enum {
  PORTION = 64, /* spans */
  LINES = 1024, /* of a portion whose runs are filled together */
  LINE_PIXELS = CS_FILL_BLOCK / 4
};

/* A row being written. */
typedef struct target {
  unsigned char *pixels;
  size_t size;     /* bytes */
  uintptr_t phase; /* see output/fill.h */
} target;

static inline cs_wide_int all_of(uint32_t pixel) { return (cs_wide_int){0} + (int32_t)pixel; }

/* ---------------------------------------------------------------- colours */

static inline cs_wide load_colours(const celspan_span *const spans[CS_SRGB8_PIXELS]) {
#ifdef __AVX512F__
  __m512 v = _mm512_castps128_ps512(_mm_loadu_ps(spans[0]->colour));
  v = _mm512_insertf32x4(v, _mm_loadu_ps(spans[1]->colour), 1);
  v = _mm512_insertf32x4(v, _mm_loadu_ps(spans[2]->colour), 2);
  return (cs_wide)_mm512_insertf32x4(v, _mm_loadu_ps(spans[3]->colour), 3);
#elif defined(__AVX2__)
  __m256 v = _mm256_castps128_ps256(_mm_loadu_ps(spans[0]->colour));
  return (cs_wide)_mm256_insertf128_ps(v, _mm_loadu_ps(spans[1]->colour), 1);
#else
  return cs_wide_load(spans[0]->colour);
#endif
}

/* codes: room for a portion. Those of spans that are not flat mean nothing. */
static inline void code_colours(const celspan_span *spans, size_t count, uint32_t *codes) {
  for (size_t k = 0; k < count; k += CS_SRGB8_PIXELS) {
    const celspan_span *together[CS_SRGB8_PIXELS];
    for (size_t i = 0; i < CS_SRGB8_PIXELS; i++)
      together[i] = &spans[k + i < count ? k + i : k];
    cs_srgb8_lanes(load_colours(together), (unsigned char *)(codes + k));
  }
}

/* ---------------------------------------------------------------- lines of long runs */

/* The spans that go beyond their heads, by number; returns how many. */
static inline size_t find_long(const celspan_span *spans, size_t count, unsigned char *longs) {
  size_t found = 0;
  for (size_t k = 0; k < count; k++) {
    longs[found] = (unsigned char)k;
    found += spans[k].x1 - spans[k].x0 > LINE_PIXELS;
  }
  return found;
}

/* How many lines begin left of a column, from the one on that begins at column `first`. */
static inline size_t lines_before(int32_t x, int32_t first) {
  return (size_t)(x - first + LINE_PIXELS - 1) / LINE_PIXELS;
}

/* Whose every line is, of those that a long run covers the beginning of; anybody's, the others. */
static inline void mark_lines(const celspan_span *spans, const unsigned char *longs,
                              size_t long_count, int32_t first, unsigned char *owners) {
  for (size_t line = 0; line < LINES; line += CS_FILL_BLOCK)
    cs_fill_store(owners + line, all_of(0));
  for (size_t j = 0; j < long_count; j++) {
    const celspan_span *span = &spans[longs[j]];
    cs_wide_int mark = all_of(longs[j] * 0x01010101u);
    size_t line = lines_before(span->x0, first), end = lines_before(span->x1, first);
    do {
      cs_fill_store(owners + line, mark);
      line += CS_FILL_BLOCK;
    } while (line < end);
  }
}

/* Run by run: where there are few and very long ones. */
static inline void fill_runs(const target *row, const celspan_span *spans,
                             const unsigned char *longs, size_t long_count, const uint32_t *codes) {
  for (size_t j = 0; j < long_count; j++) {
    const celspan_span *span = &spans[longs[j]];
    cs_fill_lines(row->pixels + 4 * (size_t)span->x0, row->pixels + 4 * (size_t)span->x1,
                  all_of(codes[longs[j]]), row->phase);
  }
}

static inline void fill_lines(const target *row, const celspan_span *spans, size_t count,
                              const uint32_t *codes) {
  unsigned char longs[PORTION], owners[LINES + 2 * CS_FILL_BLOCK];
  size_t long_count = find_long(spans, count, longs);
  if (long_count == 0)
    return;
  uintptr_t over = ((uintptr_t)row->pixels - row->phase) % CS_FILL_BLOCK;
  int32_t first = over > 0 ? (int32_t)(CS_FILL_BLOCK - over) / 4 : 0;
  first += LINE_PIXELS * (int32_t)lines_before(spans[longs[0]].x0, first);
  size_t lines = lines_before(spans[longs[long_count - 1]].x1, first);
  if (lines > LINES) {
    fill_runs(row, spans, longs, long_count, codes);
    return;
  }
  mark_lines(spans, longs, long_count, first, owners);
  unsigned char *out = row->pixels + 4 * (size_t)first;
  size_t line = 0;
  for (; line + 4 <= lines; line += 4, out += 4 * CS_FILL_BLOCK)
    for (size_t k = 0; k < 4; k++)
      cs_fill_store(out + k * CS_FILL_BLOCK, all_of(codes[owners[line + k]]));
  for (; line < lines; line++, out += CS_FILL_BLOCK)
    cs_fill_store(out, all_of(codes[owners[line]]));
}

/* ---------------------------------------------------------------- gradients and arrays */

static inline cs_wide repeat_pixel(const float rgba[4]) {
  float lanes[CS_WIDE_LANES];
  for (int k = 0; k < CS_SRGB8_PIXELS; k++)
    memcpy(lanes + 4 * k, rgba, 4 * sizeof *rgba);
  return cs_wide_load(lanes);
}

/* 0 for every lane of the first pixel, 1 for those of the second... */
static inline cs_wide pixel_numbers(void) {
  float lanes[CS_WIDE_LANES];
  for (int i = 0; i < CS_WIDE_LANES; i++)
    lanes[i] = (float)(i / 4);
  return cs_wide_load(lanes);
}

/* room: bytes up to the end of the row, which may be written. */
static inline void put_gradient(const celspan_span *span, unsigned char *out, size_t room) {
  const cs_wide colour = repeat_pixel(span->colour), slope = repeat_pixel(span->slope);
  const cs_wide numbers = pixel_numbers();
  unsigned char last[CS_WIDE_LANES];
  for (int32_t x = span->x0; x < span->x1; x += CS_SRGB8_PIXELS) {
    cs_wide rgba = colour + slope * (numbers + (float)(x - span->origin));
    cs_srgb8_lanes(rgba, room >= sizeof last ? out : last);
    if (room < sizeof last) {
      memcpy(out, last, room);
      return;
    }
    out += sizeof last;
    room -= sizeof last;
  }
}

static void put_varied(const target *row, const celspan_span *span) {
  size_t at = 4 * (size_t)span->x0, count = (size_t)(span->x1 - span->x0);
  if (span->kind == CELSPAN_SPAN_GRADIENT)
    put_gradient(span, row->pixels + at, row->size - at);
  else if (span->codes)
    memcpy(row->pixels + at, span->codes, 4 * count);
  else
    CS_WIDE(cs_srgb8_code)(span->array, count, row->pixels + at);
}

/* ---------------------------------------------------------------- rows */

static inline void put_heads(const target *row, const celspan_span *spans, size_t count,
                             const uint32_t *codes) {
  for (size_t k = 0; k < count; k++)
    if (spans[k].kind == CELSPAN_SPAN_SINGLE)
      cs_fill_store(row->pixels + 4 * (size_t)spans[k].x0, all_of(codes[k]));
    else
      put_varied(row, &spans[k]);
}

/* Spans too near the end of the row to write beyond them. */
static inline void put_last(const target *row, const celspan_span *spans, size_t count,
                            const uint32_t *codes) {
  for (size_t k = 0; k < count; k++)
    if (spans[k].kind == CELSPAN_SPAN_SINGLE)
      cs_fill_exactly(row->pixels + 4 * (size_t)spans[k].x0, row->pixels + 4 * (size_t)spans[k].x1,
                      all_of(codes[k]), row->phase);
    else
      put_varied(row, &spans[k]);
}

void CS_WIDE(cs_pixels8_row)(const celspan_span *spans, size_t count, unsigned char *pixels) {
  const target row = {pixels, 4 * (size_t)spans[count - 1].x1, (uintptr_t)pixels % 4};
  uint32_t codes[PORTION];
  for (size_t portion; count > 0; count -= portion, spans += portion) {
    portion = count < PORTION ? count : PORTION;
    code_colours(spans, portion, codes);
    size_t inner = portion;
    while (inner > 0 && 4 * (size_t)spans[inner - 1].x1 + CS_FILL_BLOCK > row.size)
      inner--;
    fill_lines(&row, spans, inner, codes);
    put_heads(&row, spans, inner, codes);
    put_last(&row, spans + inner, portion - inner, codes + inner);
  }
}
