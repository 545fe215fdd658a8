#include "engine/span/row.h"

#include <string.h>

#include "model/colour/space.h"

void cs_row_init(cs_row *row) {
  *row = (cs_row){0};
  cs_arena_init(&row->colours);
}

void cs_row_finish(cs_row *row, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, row, spans, spans);
  cs_arena_finish(&row->colours, memory);
  *row = (cs_row){0};
}

void cs_row_clear(cs_row *row) {
  row->count = 0;
  row->varied = (cs_varied){0};
  row->made_by.maker = NULL;
  cs_arena_reset(&row->colours);
}

celspan_status cs_row_grow(celspan_context *context, cs_row *row) {
  return CS_ARRAY_RESERVE(context, row->spans, row->count + 1);
}

/* Appends a span that is not a single, to be filled in; NULL when there is no memory. It has a
 * colour, although an array needs none, because sinks code the colours of neighbouring spans
 * together. */
static inline celspan_span *append_varied(celspan_context *context, cs_row *row, int32_t x0,
                                          int32_t x1, celspan_span_kind kind) {
  if (row->count == row->spans_room.capacity && cs_row_grow(context, row) != CELSPAN_OK)
    return NULL;
  celspan_span *span = &row->spans[row->count++];
  span->x0 = span->origin = x0;
  span->x1 = x1;
  span->kind = kind;
  cs_v4_store(span->colour, cs_v4_all(0));
  cs_varied_count(&row->varied, kind);
  return span;
}

celspan_status cs_row_gradient(celspan_context *context, cs_row *row, int32_t x0, int32_t x1,
                               cs_v4 colour, cs_v4 slope) {
  if (x1 - x0 < 2 || cs_v4_same(slope, cs_v4_all(0)))
    return cs_row_single(context, row, x0, x1, colour);
  celspan_span *span = append_varied(context, row, x0, x1, CELSPAN_SPAN_GRADIENT);
  if (!span)
    return CELSPAN_NO_MEMORY;
  cs_v4_store(span->colour, colour);
  cs_v4_store(span->slope, slope);
  return CELSPAN_OK;
}

/* Appends an array of items of a size; its memory comes from the row's arena. */
static celspan_status append_array(celspan_context *context, cs_row *row, int32_t x0, int32_t x1,
                                   size_t size, void **room, celspan_span **out) {
  *room = cs_arena_take(context, &row->colours, (size_t)(x1 - x0) * size);
  *out = *room ? append_varied(context, row, x0, x1, CELSPAN_SPAN_ARRAY) : NULL;
  return *out ? CELSPAN_OK : CELSPAN_NO_MEMORY;
}

celspan_status cs_row_array(celspan_context *context, cs_row *row, int32_t x0, int32_t x1,
                            float **colours) {
  celspan_span *span;
  void *room;
  CS_TRY(append_array(context, row, x0, x1, 4 * sizeof(float), &room, &span));
  span->array = *colours = room;
  span->codes = NULL;
  return CELSPAN_OK;
}

celspan_status cs_row_codes(celspan_context *context, cs_row *row, int32_t x0, int32_t x1,
                            unsigned char **codes) {
  celspan_span *span;
  void *room = NULL;
  if (row->pixels && row->varied.arrays == row->count) {
    room = row->pixels + 4 * (size_t)x0;
    span = append_varied(context, row, x0, x1, CELSPAN_SPAN_ARRAY);
    if (!span)
      return CELSPAN_NO_MEMORY;
  } else
    CS_TRY(append_array(context, row, x0, x1, 4, &room, &span));
  span->array = NULL;
  span->codes = *codes = room;
  return CELSPAN_OK;
}

void cs_row_spread_span(const celspan_span *span, int32_t x, int32_t stop, cs_v4 *out) {
  cs_v4 colour = cs_v4_load(span->colour);
  switch (span->kind) {
  case CELSPAN_SPAN_SINGLE:
    for (; x < stop; x++)
      *out++ = colour;
    return;
  case CELSPAN_SPAN_GRADIENT:
    for (cs_v4 slope = cs_v4_load(span->slope); x < stop; x++)
      *out++ = colour + slope * (float)(x - span->origin);
    return;
  case CELSPAN_SPAN_ARRAY:
    memcpy(out, span->array + 4 * (size_t)(x - span->x0), (size_t)(stop - x) * sizeof *out);
  }
}

void cs_row_crop(cs_row *row, int32_t x0, int32_t x1) {
  size_t kept = 0;
  row->varied = (cs_varied){0};
  row->made_by.maker = NULL;
  for (size_t i = 0; i < row->count; i++) {
    celspan_span span = row->spans[i];
    int32_t from = span.x0 < x0 ? x0 : span.x0, to = span.x1 > x1 ? x1 : span.x1;
    if (from >= to)
      continue;
    size_t cut = 4 * (size_t)(from - span.x0);
    if (span.kind == CELSPAN_SPAN_ARRAY && span.codes)
      span.codes += cut;
    else if (span.kind == CELSPAN_SPAN_ARRAY)
      span.array += cut;
    span.x0 = from - x0;
    span.x1 = to - x0;
    span.origin -= x0;
    row->spans[kept++] = span;
    cs_varied_count(&row->varied, span.kind);
  }
  row->count = kept;
}

/* Inserts clear columns before the first span. */
static celspan_status fill_left(celspan_context *context, cs_row *row) {
  celspan_span clear = {.x1 = row->spans[0].x0, .kind = CELSPAN_SPAN_SINGLE};
  CS_TRY(cs_row_reserve(context, row, 1));
  memmove(row->spans + 1, row->spans, row->count++ * sizeof *row->spans);
  row->spans[0] = clear;
  return CELSPAN_OK;
}

celspan_status cs_row_fill(celspan_context *context, cs_row *row, int32_t width) {
  celspan_span *first = row->spans;
  bool is_clear =
      first->kind == CELSPAN_SPAN_SINGLE && cs_v4_same(cs_v4_load(first->colour), cs_v4_all(0));
  if (is_clear)
    first->x0 = first->origin = 0;
  else if (first->x0 > 0)
    CS_TRY(fill_left(context, row));
  return cs_row_single(context, row, row->spans[row->count - 1].x1, width, cs_v4_all(0));
}

/* Appends the part of an array span between two columns. */
static celspan_status append_copy(celspan_context *context, cs_row *out, const celspan_span *span,
                                  int32_t x0, int32_t x1) {
  size_t size = span->codes ? 4 : 4 * sizeof(float), skipped = (size_t)(x0 - span->x0) * size;
  const char *from = span->codes ? (const char *)span->codes : (const char *)span->array;
  celspan_span *copy;
  void *room;
  CS_TRY(append_array(context, out, x0, x1, size, &room, &copy));
  memcpy(room, from + skipped, (size_t)(x1 - x0) * size);
  copy->codes = span->codes ? room : NULL;
  copy->array = span->codes ? NULL : room;
  return CELSPAN_OK;
}

celspan_status cs_row_append(celspan_context *context, cs_row *out, const cs_row *row, int32_t x0,
                             int32_t x1) {
  out->made_by.maker = NULL;
  for (size_t i = 0; i < row->count; i++) {
    const celspan_span *span = &row->spans[i];
    int32_t from = span->x0 < x0 ? x0 : span->x0, to = span->x1 > x1 ? x1 : span->x1;
    if (from >= to)
      continue;
    if (span->kind == CELSPAN_SPAN_SINGLE) {
      CS_TRY(cs_row_single(context, out, from, to, cs_v4_load(span->colour)));
    } else if (span->kind == CELSPAN_SPAN_ARRAY) {
      CS_TRY(append_copy(context, out, span, from, to));
    } else {
      celspan_span *copy = append_varied(context, out, from, to, span->kind);
      if (!copy)
        return CELSPAN_NO_MEMORY;
      *copy = *span;
      copy->x0 = from;
      copy->x1 = to;
    }
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- exposures */

#define EXPOSED 64 /* columns that are summed together */

static inline cs_v4 colour_at(const celspan_span *span, int32_t x) {
  cs_v4 colour = cs_v4_load(span->colour);
  if (span->kind == CELSPAN_SPAN_GRADIENT)
    return colour + cs_v4_load(span->slope) * (float)(x - span->origin);
  return colour;
}

/* How many of the `count` values first + k * slope, from k = 0 on, lie on the same side of 1 as the
 * first. Rounding does not change their order, so halving finds the last of them. */
static int32_t count_alike(float first, float slope, int32_t count) {
  bool is_above = first > 1;
  int32_t alike = 0, beyond = count; /* the first one known to be on the other side, or count */
  if ((first + slope * (float)(count - 1) > 1) == is_above)
    return count;
  while (beyond - alike > 1) {
    int32_t middle = alike + (beyond - alike) / 2;
    if ((first + slope * (float)middle > 1) == is_above)
      alike = middle;
    else
      beyond = middle;
  }
  return beyond;
}

/* A gradient whose alpha is limited to 1: two gradients that meet where the alpha passes 1. */
static celspan_status expose_gradient(celspan_context *context, cs_row *out, int32_t x0, int32_t x1,
                                      cs_v4 colour, cs_v4 slope) {
  bool is_above = colour[3] > 1;
  int32_t bend = x0 + count_alike(colour[3], slope[3], x1 - x0);
  cs_v4 rest = colour + slope * (float)(bend - x0), rest_slope = slope;
  if (is_above) {
    colour[3] = 1;
    slope[3] = 0;
  } else {
    rest[3] = 1;
    rest_slope[3] = 0;
  }
  CS_TRY(cs_row_gradient(context, out, x0, bend, colour, slope));
  return bend < x1 ? cs_row_gradient(context, out, bend, x1, rest, rest_slope) : CELSPAN_OK;
}

/* One span of each row, and their weights. All of these spans cover [x0, x1). */
typedef struct exposed {
  const celspan_span **spans;
  const float *weights;
  size_t count;
  celspan_space space;
} exposed;

static cs_v4 light_of(cs_v4 codes) {
  float rgba[4];
  cs_v4_store(rgba, codes);
  cs_space_decode(CELSPAN_SPACE_SRGB, rgba);
  return cs_v4_load(rgba);
}

static cs_v4 codes_of(cs_v4 light) {
  float rgba[4];
  cs_v4_store(rgba, light);
  cs_space_encode(CELSPAN_SPACE_SRGB, rgba);
  return cs_v4_load(rgba);
}

/* Adds the light of one span in columns [x0, x1). */
static void add_light(const exposed *e, size_t i, int32_t x0, int32_t x1, float *sums) {
  const float weight = e->weights[i];
  cs_v4 colours[EXPOSED];
  cs_row_spread_span(e->spans[i], x0, x1, colours);
  for (int32_t k = 0; k < x1 - x0 && e->space == CELSPAN_SPACE_SRGB; k++)
    colours[k] = light_of(colours[k]);
  for (int32_t k = 0; k < x1 - x0; k++)
    cs_v4_store(sums + 4 * k, cs_v4_load(sums + 4 * k) + weight * colours[k]);
}

/* The sums of at most EXPOSED columns, span by span: each is what the columns are one by one. */
static void put_sums(const exposed *e, int32_t x0, int32_t x1, float *sums) {
  const size_t count = 4 * (size_t)(x1 - x0);
  memset(sums, 0, count * sizeof *sums);
  for (size_t i = 0; i < e->count; i++)
    add_light(e, i, x0, x1, sums);
  for (float *sum = sums; sum < sums + count; sum += 4) {
    sum[3] = sum[3] > 1 ? 1 : sum[3];
    if (e->space == CELSPAN_SPACE_SRGB)
      cs_space_encode(e->space, sum);
  }
}

static celspan_status expose_array(celspan_context *context, cs_row *out, const exposed *e,
                                   int32_t x0, int32_t x1) {
  float *colours;
  CS_TRY(cs_row_array(context, out, x0, x1, &colours));
  for (int32_t x = x0, stop; x < x1; x = stop) {
    stop = x1 - x < EXPOSED ? x1 : x + EXPOSED;
    put_sums(e, x, stop, colours + 4 * (size_t)(x - x0));
  }
  return CELSPAN_OK;
}

/* Light does not change linearly along a gradient of codes. */
static celspan_status expose_interval(celspan_context *context, cs_row *out, const exposed *e,
                                      int32_t x0, int32_t x1) {
  const bool is_coded = e->space == CELSPAN_SPACE_SRGB;
  cs_v4 first = cs_v4_all(0), slope = cs_v4_all(0);
  bool is_single = true;
  for (size_t i = 0; i < e->count; i++) {
    const celspan_span *span = e->spans[i];
    const bool is_gradient = span->kind == CELSPAN_SPAN_GRADIENT;
    if (span->kind == CELSPAN_SPAN_ARRAY || (is_gradient && is_coded))
      return expose_array(context, out, e, x0, x1);
    const cs_v4 colour = colour_at(span, x0);
    first += e->weights[i] * (is_coded ? light_of(colour) : colour);
    if (is_gradient)
      slope += e->weights[i] * cs_v4_load(span->slope);
    is_single &= !is_gradient;
  }
  if (!is_single)
    return expose_gradient(context, out, x0, x1, first, slope);
  first[3] = first[3] > 1 ? 1 : first[3];
  return cs_row_single(context, out, x0, x1, is_coded ? codes_of(first) : first);
}

celspan_status cs_row_expose(celspan_context *context, cs_row *out, celspan_space space,
                             const cs_row *rows, const float *weights, size_t count) {
  const celspan_span **at = cs_arena_take(context, &out->colours, count * sizeof *at);
  if (!at)
    return CELSPAN_NO_MEMORY;
  for (size_t i = 0; i < count; i++)
    at[i] = rows[i].spans;
  const exposed e = {at, weights, count, space};
  const celspan_span *end = rows[0].spans + rows[0].count;
  for (int32_t x0 = 0; at[0] < end;) {
    int32_t x1 = INT32_MAX;
    for (size_t i = 0; i < count; i++)
      x1 = at[i]->x1 < x1 ? at[i]->x1 : x1;
    CS_TRY(expose_interval(context, out, &e, x0, x1));
    for (size_t i = 0; i < count; i++)
      at[i] += at[i]->x1 == x1;
    x0 = x1;
  }
  return CELSPAN_OK;
}
