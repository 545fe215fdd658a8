#include "tools/relight/addend.h"

#include <math.h>
#include <string.h>

/* The least number of columns for which a span, or a gap of zeros, is worthwhile; fewer are stored
 * as numbers of an array. */
#define LONG 24
#define GAP 16
#define CODE_MOST 65535.0f
/* The allowed sum of errors by omitted numbers and by codes, at lights of 1: it is so small that
 * with lights of 4 the error remains below 1/65535, errors of gradients included. The second number
 * is the part for the numbers that one addend omits. */
#define BUDGET (0.15f / 65535)
#define FAINT (BUDGET / 16)

celspan_status cs_addend_init(celspan_context *context, int32_t width, int32_t height,
                              cs_addend *out) {
  *out = (cs_addend){.width = width, .height = height};
  return CS_ARRAY_MAKE(context, out->rows, (size_t)height + 1);
}

void cs_addend_finish(cs_addend *addend, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, addend, rows, values);
  *addend = (cs_addend){0};
}

size_t cs_addend_bytes(const cs_addend *addend) {
  return addend->span_count * sizeof *addend->spans + addend->value_count * sizeof *addend->values;
}

/* ---------------------------------------------------------------- the budget */

celspan_status cs_addend_budget_init(celspan_context *context, int32_t width, int32_t height,
                                     cs_addend_budget *out) {
  *out = (cs_addend_budget){(width + CS_ADDEND_PIECE - 1) / CS_ADDEND_PIECE, height, NULL};
  return cs_mem_make(context, (void **)&out->spent, (size_t)out->pieces,
                     (size_t)height * sizeof *out->spent);
}

void cs_addend_budget_finish(cs_addend_budget *budget, cs_memory *memory) {
  cs_mem_free(memory, budget->spent,
              (size_t)budget->pieces * (size_t)budget->height * sizeof *budget->spent);
  *budget = (cs_addend_budget){0};
}

/* ---------------------------------------------------------------- writing */

celspan_status cs_addend_writer_init(celspan_context *context, cs_addend *addend,
                                     cs_addend_budget *budget, bool is_through,
                                     cs_addend_writer *out) {
  *out = (cs_addend_writer){.addend = addend, .budget = budget, .isa = cs_isa_best()};
  out->plane_count = is_through ? 1 : 3;
  return CS_MAKE(context, out->dense, (size_t)addend->width * out->plane_count);
}

/* Frees the memory that was not needed. */
static void trim(cs_memory *memory, void **items, cs_room *room, size_t count) {
  size_t size = room->item_size, old = room->capacity * size;
  void *fitting = count > 0 ? cs_mem_resize(memory, *items, old, count * size) : NULL;
  if (!fitting)
    return;
  *items = fitting;
  room->capacity = (uint32_t)count;
}

void cs_addend_writer_finish(celspan_context *context, cs_addend_writer *writer) {
  cs_addend *addend = writer->addend;
  if (!addend)
    return;
  cs_mem_free(context->memory, writer->dense,
              (size_t)addend->width * writer->plane_count * sizeof *writer->dense);
  trim(context->memory, (void **)&addend->spans, &addend->spans_room, addend->span_count);
  trim(context->memory, (void **)&addend->values, &addend->values_room, addend->value_count);
  writer->addend = NULL;
}

/* Appends a span with room for its values, which the caller fills. */
static celspan_status append(celspan_context *context, cs_addend *addend, cs_addend_span span,
                             size_t value_count, float **values) {
  CS_TRY(CS_ARRAY_RESERVE(context, addend->spans, addend->span_count + 1));
  CS_TRY(CS_ARRAY_RESERVE(context, addend->values, addend->value_count + value_count));
  span.first = addend->value_count;
  *values = addend->values + addend->value_count;
  addend->value_count += value_count;
  addend->spans[addend->span_count++] = span;
  return CELSPAN_OK;
}

/* Whether a column of the dense planes is zero. */
static bool is_zero(const cs_addend_writer *w, int32_t x) {
  const float *at = w->dense + x;
  size_t width = (size_t)w->addend->width;
  return at[0] == 0 && (w->plane_count == 1 || (at[width] == 0 && at[2 * width] == 0));
}

/* The numbers of a piece, plane by plane, and the scales of their codes. */
typedef struct piece {
  int32_t x0, x1;
  const float *planes;
  size_t stride, plane_count;
  float scales[3][2];   /* the least number of each plane, and the step */
  float greatest, step; /* the greatest magnitude, and the greatest step, in all planes */
} piece;

static void find_scale(const float *in, size_t count, float scale[2]) {
  float least = in[0], most = in[0];
  for (size_t i = 1; i < count; i++) {
    least = in[i] < least ? in[i] : least;
    most = in[i] > most ? in[i] : most;
  }
  scale[0] = least;
  scale[1] = (most - least) / CODE_MOST;
}

static piece piece_at(const cs_addend_writer *w, int32_t x0, int32_t x1) {
  size_t width = (size_t)w->addend->width, count = (size_t)(x1 - x0), bytes = count * sizeof(float);
  const float *planes = w->dense + x0;
  bool is_grey = w->plane_count == 1 || (memcmp(planes, planes + width, bytes) == 0 &&
                                         memcmp(planes, planes + 2 * width, bytes) == 0);
  piece p = {.x0 = x0, .x1 = x1, .planes = planes, .stride = width, .plane_count = is_grey ? 1 : 3};
  for (size_t c = 0; c < p.plane_count; c++) {
    const float *scale = p.scales[c];
    find_scale(planes + c * width, count, p.scales[c]);
    p.greatest = fmaxf(p.greatest, fmaxf(-scale[0], scale[0] + CODE_MOST * scale[1]));
    p.step = fmaxf(p.step, scale[1]);
  }
  return p;
}

static celspan_status put_floats(celspan_context *context, cs_addend *addend, const piece *p) {
  const cs_addend_span span = {p->x0, p->x1, 0, CS_ADDEND_FLOATS, (uint16_t)p->plane_count, 0};
  size_t count = (size_t)(p->x1 - p->x0);
  float *values;
  CS_TRY(append(context, addend, span, p->plane_count * count, &values));
  for (size_t c = 0; c < p->plane_count; c++)
    memcpy(values + c * count, p->planes + c * p->stride, count * sizeof *values);
  return CELSPAN_OK;
}

static void code_plane(const float *in, size_t count, const float scale[2], uint16_t *codes) {
  float codes_a_unit = scale[1] > 0 ? 1 / scale[1] : 0;
  for (size_t i = 0; i < count; i++) {
    float code = (in[i] - scale[0]) * codes_a_unit + 0.5f;
    codes[i] = (uint16_t)(code < CODE_MOST ? code : CODE_MOST);
  }
}

static celspan_status put_codes(celspan_context *context, cs_addend *addend, const piece *p) {
  const cs_addend_span span = {p->x0, p->x1, 0, CS_ADDEND_CODES, (uint16_t)p->plane_count, 0};
  size_t count = (size_t)(p->x1 - p->x0), scales = 2 * p->plane_count;
  float *values;
  CS_TRY(append(context, addend, span, scales + (p->plane_count * count + 1) / 2, &values));
  memcpy(values, p->scales, scales * sizeof *values);
  uint16_t *codes = (uint16_t *)(void *)(values + scales);
  for (size_t c = 0; c < p->plane_count; c++)
    code_plane(p->planes + c * p->stride, count, p->scales[c], codes + c * count);
  return CELSPAN_OK;
}

/* Whether an error is at most `most` and within the budget; if so, it is subtracted from the
 * budget. */
static bool spend(float *spent, float error, float most) {
  bool may = error <= most && *spent + error <= BUDGET;
  *spent += may ? error : 0;
  return may;
}

static celspan_status put_piece(celspan_context *context, cs_addend_writer *w, int32_t x0,
                                int32_t x1) {
  const piece p = piece_at(w, x0, x1);
  float *spent = &w->spent[x0 / CS_ADDEND_PIECE];
  if (spend(spent, p.greatest, FAINT))
    return CELSPAN_OK;
  return spend(spent, p.step / 2, BUDGET) ? put_codes(context, w->addend, &p)
                                          : put_floats(context, w->addend, &p);
}

/* Columns of an array, piece by piece. */
static celspan_status put_array(celspan_context *context, cs_addend_writer *w, int32_t x0,
                                int32_t x1) {
  while (x0 < x1) {
    int32_t end = (x0 / CS_ADDEND_PIECE + 1) * CS_ADDEND_PIECE;
    end = end < x1 ? end : x1;
    CS_TRY(put_piece(context, w, x0, end));
    x0 = end;
  }
  return CELSPAN_OK;
}

/* Turns the dense columns into arrays, without zeros at the ends and in long gaps. */
static celspan_status flush(celspan_context *context, cs_addend_writer *w) {
  int32_t x0 = w->from, last = w->from; /* last: after the last column that is not 0 */
  for (int32_t x = w->from; x < w->end; x++) {
    if (is_zero(w, x))
      continue;
    if (x - last >= GAP || last == x0) {
      if (last > x0)
        CS_TRY(put_array(context, w, x0, last));
      x0 = x;
    }
    last = x + 1;
  }
  if (last > x0)
    CS_TRY(put_array(context, w, x0, last));
  w->from = w->end;
  return CELSPAN_OK;
}

static void add_dense(cs_addend_writer *w, const celspan_span *span) {
  int32_t count = span->x1 - span->x0;
  size_t width = (size_t)w->addend->width;
  float *planes = w->dense + span->x0, colours[4 * LONG];
  const float *rgba = span->array;
  w->end = span->x1;
  if (span->kind != CELSPAN_SPAN_ARRAY) {
    for (int32_t i = 0; i < count; i++)
      celspan_span_colour(span, span->x0 + i, colours + 4 * i);
    rgba = colours;
  }
  if (w->plane_count == 1)
    CS_WIDE_CHOOSE(w->isa, cs_addend_through)(rgba, count, planes);
  else
    CS_WIDE_CHOOSE(w->isa, cs_addend_split)
  (rgba, count, planes, planes + width, planes + 2 * width);
}

static celspan_status add_long(celspan_context *context, cs_addend_writer *w,
                               const celspan_span *span) {
  bool is_gradient = span->kind == CELSPAN_SPAN_GRADIENT;
  float rgb[3], *values;
  int32_t origin = is_gradient ? span->origin : span->x0;
  CS_TRY(flush(context, w));
  w->from = w->end = span->x1;
  for (int c = 0; c < 3; c++)
    rgb[c] = w->plane_count == 1 ? 1 - span->colour[3] : span->colour[c];
  if (!is_gradient && rgb[0] == 0 && rgb[1] == 0 && rgb[2] == 0)
    return CELSPAN_OK;
  cs_addend_span put = {
      span->x0, span->x1, origin, is_gradient ? CS_ADDEND_GRADIENT : CS_ADDEND_SINGLE, 3, 0};
  CS_TRY(append(context, w->addend, put, is_gradient ? 6 : 3, &values));
  memcpy(values, rgb, sizeof rgb);
  for (int c = 0; c < 3 && is_gradient; c++)
    values[3 + c] = w->plane_count == 1 ? -span->slope[3] : span->slope[c];
  return CELSPAN_OK;
}

celspan_status cs_addend_writer_row(celspan_context *context, cs_addend_writer *writer, int32_t y,
                                    const celspan_span *spans, size_t count) {
  writer->from = writer->end = 0;
  writer->spent = writer->budget->spent + (size_t)y * (size_t)writer->budget->pieces;
  for (size_t i = 0; i < count; i++) {
    const celspan_span *span = &spans[i];
    if (span->kind == CELSPAN_SPAN_ARRAY || span->x1 - span->x0 < LONG)
      add_dense(writer, span);
    else
      CS_TRY(add_long(context, writer, span));
  }
  CS_TRY(flush(context, writer));
  writer->addend->rows[y + 1] = writer->addend->span_count;
  return CELSPAN_OK;
}
