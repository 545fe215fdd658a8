#include "pack.h"

#include "pixels.h"

/* Fewer pixels are not worth the packet of a gradient and the head of the next one. */
enum { GRADIENT_LEAST = 12 };

bool sf_pack_raw(const sf_memory *memory, sf_row *row, size_t pixel_size, const void *pixels,
                 uint32_t count) {
  return count == 0 || (sf_bytes_add(memory, &row->values, pixels, (size_t)count * pixel_size) &&
                        sf_row_add(memory, row, count, SPANFILE_RAW, 0));
}

/* ---------------------------------------------------------------- runs */

/* Room for all runs, whether they become runs or raw pixels. */
static bool make_room(const sf_memory *memory, sf_row *row, size_t pixel_size, size_t run_count) {
  while (row->capacity - row->count < run_count)
    if (!sf_row_grow(memory, row))
      return false;
  return sf_bytes_room(memory, &row->values, run_count * SF_RUN_LEAST * pixel_size);
}

/* In an antialiased picture most runs are short, and a processor cannot predict which. So there are
 * no calls and few branches for a run, and always as many pixels are stored as a short run can
 * have. pixel_size: a constant for the compiler. */
static inline void pack_runs(sf_row *row, size_t pixel_size, const spanfile_run *run,
                             const spanfile_run *end) {
  const uint64_t whole = pixel_size == 4 ? UINT32_MAX : UINT64_MAX;
  uint32_t column = sf_row_end(row);
  spanfile_span *next = row->spans + row->count;
  spanfile_span before = row->count > 0 ? next[-1] : (spanfile_span){.kind = SPANFILE_GRADIENT};
  unsigned char *values = row->values.at + row->values.size;
  while (run < end) {
    uint64_t pixel = run->pixel & whole;
    uint32_t count = run->count;
    for (run++; run < end && (run->pixel & whole) == pixel; run++)
      count += run->count;
    for (int i = 0; i < SF_RUN_LEAST - 1; i++)
      sf_store_pixel(values + i * pixel_size, pixel_size, pixel);
    bool is_continued = (before.kind == SPANFILE_RUN) & (before.pixel == pixel);
    bool is_raw = (count < SF_RUN_LEAST) & !is_continued;
    bool is_joined = is_continued | (is_raw & (before.kind == SPANFILE_RAW));
    values += is_raw ? count * pixel_size : 0;
    column += count;
    before = (spanfile_span){column, is_raw ? SPANFILE_RAW : SPANFILE_RUN, is_raw ? 0 : pixel};
    next -= is_joined;
    *next++ = before;
  }
  row->count = (size_t)(next - row->spans);
  row->values.size = (size_t)(values - row->values.at);
}

bool sf_pack_runs(const sf_memory *memory, sf_row *row, size_t pixel_size, const spanfile_run *runs,
                  size_t run_count) {
  if (run_count == 0)
    return true;
  if (!make_room(memory, row, pixel_size, run_count))
    return false;
  if (pixel_size == 4)
    pack_runs(row, 4, runs, runs + run_count);
  else
    pack_runs(row, 8, runs, runs + run_count);
  return true;
}

static uint32_t run_length(const unsigned char *pixels, uint32_t count, size_t pixel_size) {
  uint64_t first = sf_load_pixel(pixels, pixel_size);
  uint32_t length = 1;
  while (length < count && sf_load_pixel(pixels + length * pixel_size, pixel_size) == first)
    length++;
  return length;
}

/* How many of the first pixels continue the run at the end of the row. */
static uint32_t continued_length(const sf_row *row, const unsigned char *pixels, uint32_t count,
                                 size_t pixel_size) {
  const spanfile_span *last = row->count > 0 ? &row->spans[row->count - 1] : NULL;
  bool is_continued = last && count > 0 && last->kind == SPANFILE_RUN &&
                      last->pixel == sf_load_pixel(pixels, pixel_size);
  return is_continued ? run_length(pixels, count, pixel_size) : 0;
}

/* ---------------------------------------------------------------- gradients */

/* Whether the gradient from the first to the last pixel gives exactly those between. */
static bool is_gradient(spanfile_format format, const unsigned char *pixels, uint32_t count) {
  enum { BATCH = 32 };
  size_t size = spanfile_pixel_size(format);
  unsigned char ends[16], line[BATCH * 8];
  memcpy(ends, pixels, size);
  memcpy(ends + size, pixels + (count - 1) * size, size);
  if (!sf_pixels_are_finite(format, ends))
    return false;
  for (uint32_t i = 1; i < count; i += BATCH) {
    uint32_t batch = count - i < BATCH ? count - i : BATCH;
    /* Most attempts fail at their first pixel. */
    spanfile_gradient_pixels(format, ends, count, i, 1, line);
    if (memcmp(line, pixels + i * size, size) != 0)
      return false;
    spanfile_gradient_pixels(format, ends, count, i, batch, line);
    if (memcmp(line, pixels + i * size, batch * size) != 0)
      return false;
  }
  return true;
}

/* The length of a gradient at the start of the pixels, or 0: the length is doubled as long as there
 * is a gradient, then the end is found by halving. */
static uint32_t gradient_length(spanfile_format format, const unsigned char *pixels,
                                uint32_t count) {
  uint32_t most = count < SF_PACKET_MOST ? count : SF_PACKET_MOST, good = 0;
  uint32_t next = GRADIENT_LEAST;
  while (next <= most && is_gradient(format, pixels, next)) {
    good = next;
    next = next < most && 2 * next > most ? most : 2 * next;
  }
  uint32_t bad = next < most + 1 ? next : most + 1;
  while (good > 0 && bad - good > 1) {
    uint32_t middle = good + (bad - good) / 2;
    if (is_gradient(format, pixels, middle))
      good = middle;
    else
      bad = middle;
  }
  return good;
}

static bool add_gradient(const sf_memory *memory, sf_row *row, size_t pixel_size,
                         const unsigned char *pixels, uint32_t count) {
  return sf_bytes_add(memory, &row->values, pixels, pixel_size) &&
         sf_bytes_add(memory, &row->values, pixels + (count - 1) * pixel_size, pixel_size) &&
         sf_row_add(memory, row, count, SPANFILE_GRADIENT, 0);
}

/* ---------------------------------------------------------------- pixels */

bool sf_pack_pixels(const sf_memory *memory, sf_row *row, spanfile_format format,
                    const void *pixels, uint32_t count) {
  size_t size = spanfile_pixel_size(format);
  const unsigned char *at = pixels;
  uint32_t raw = 0; /* pixels before i that are neither run nor gradient */
  uint32_t continued = continued_length(row, at, count, size);
  if (continued > 0)
    row->spans[row->count - 1].end += continued;
  if (count - continued < SF_RUN_LEAST)
    return sf_pack_raw(memory, row, size, at + continued * size, count - continued);
  for (uint32_t i = continued; i < count;) {
    const unsigned char *here = at + i * size;
    uint32_t run = run_length(here, count - i, size);
    uint32_t gradient = run < SF_RUN_LEAST && count - i >= GRADIENT_LEAST
                            ? gradient_length(format, here, count - i)
                            : 0;
    if (run < SF_RUN_LEAST && gradient == 0) {
      raw++;
      i++;
      continue;
    }
    if (!sf_pack_raw(memory, row, size, here - raw * size, raw))
      return false;
    raw = 0;
    if (gradient > 0 ? !add_gradient(memory, row, size, here, gradient)
                     : !sf_row_add(memory, row, run, SPANFILE_RUN, sf_load_pixel(here, size)))
      return false;
    i += gradient > 0 ? gradient : run;
  }
  return sf_pack_raw(memory, row, size, at + (count - raw) * size, raw);
}
