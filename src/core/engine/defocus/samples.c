#include "engine/defocus/samples.h"

celspan_status cs_defocus_samples_begin(cs_row_maker *maker, int32_t first, int32_t count,
                                        size_t room, cs_defocus_samples *out) {
  *out = (cs_defocus_samples){.count = count};
  CS_TRY(CS_ARRAY_MAKE(maker->context, out->rows, (size_t)count));
  CS_TRY(CS_ARRAY_MAKE(maker->context, out->from, (size_t)count));
  CS_TRY(CS_ARRAY_MAKE(maker->context, out->room, room));
  for (int32_t k = 0; k < count; k++)
    CS_TRY(cs_row_make(maker, first + k, &out->rows[k]));
  return CELSPAN_OK;
}

void cs_defocus_samples_finish(cs_defocus_samples *samples, cs_memory *memory) {
  for (int32_t k = 0; samples->rows && k < samples->count; k++)
    cs_row_finish(&samples->rows[k], memory);
  CS_ARRAYS_FREE(memory, samples, rows, room);
}

/* Moves to the tile over the samples [low, high). */
static void move_to(cs_defocus_samples *samples, int32_t low, int32_t high) {
  samples->low = low;
  samples->high = high;
  for (int32_t k = 0; k < samples->count; k++)
    while (samples->rows[k].spans[samples->from[k]].x1 <= low)
      samples->from[k]++;
}

bool cs_defocus_samples_are_one(const cs_defocus_samples *samples, int32_t k, cs_v4 *out) {
  const celspan_span *span = &samples->rows[k].spans[samples->from[k]];
  *out = cs_v4_load(span->colour);
  return span->kind == CELSPAN_SPAN_SINGLE && span->x1 >= samples->high;
}

/* Whether all rows have the same single colour under the tile; *out: this colour. */
static bool are_plain(const cs_defocus_samples *samples, cs_v4 *out) {
  bool is_plain = cs_defocus_samples_are_one(samples, 0, out);
  for (int32_t k = 1; k < samples->count && is_plain; k++) {
    cs_v4 other;
    is_plain = cs_defocus_samples_are_one(samples, k, &other) && cs_v4_same(other, *out);
  }
  return is_plain;
}

void cs_defocus_samples_spread(const cs_defocus_samples *samples, int32_t k, cs_v4 *out) {
  const cs_row *row = &samples->rows[k];
  for (size_t i = samples->from[k]; i < row->count && row->spans[i].x0 < samples->high; i++) {
    const celspan_span *span = &row->spans[i];
    int32_t x = span->x0 > samples->low ? span->x0 : samples->low;
    int32_t stop = span->x1 < samples->high ? span->x1 : samples->high;
    cs_row_spread_span(span, x, stop, out + (x - samples->low));
  }
}

/* ---------------------------------------------------------------- tiles of nodes */

/* The `count` nodes from x on of every row. */
static void sum_tile(cs_defocus_samples *samples, const cs_defocus_tiles *tiles, int32_t x,
                     int32_t count, float (*nodes)[4]) {
  cs_v4 colour;
  bool is_plain = !tiles->has_function && are_plain(samples, &colour);
  for (int32_t k = 0; k < samples->count && !is_plain; k++)
    tiles->take_row(tiles->user, k);
  for (int32_t y = 0; y < tiles->rows; y++) {
    float(*row)[4] = nodes + (size_t)y * (size_t)tiles->columns + (size_t)x;
    if (!is_plain)
      tiles->sum_nodes(tiles->user, y, count, row);
    for (int32_t k = 0; k < count && is_plain; k++)
      cs_v4_store(row[k], colour);
  }
}

void cs_defocus_samples_sum(cs_defocus_samples *samples, const cs_defocus_tiles *tiles,
                            float (*nodes)[4]) {
  for (int32_t x = 0, count; x < tiles->columns; x += count) {
    int32_t rest = tiles->columns - x;
    count = rest < tiles->width ? rest : tiles->width;
    move_to(samples, x * tiles->factor, (x + count) * tiles->factor + 2 * tiles->extent);
    sum_tile(samples, tiles, x, count, nodes);
  }
}
