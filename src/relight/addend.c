#include "relight/addend.h"

#include <string.h>

/* Columns from which on a span is worth having, and a gap of zeros: fewer are numbers of an array. */
#define LONG 24
#define GAP 16

celspan_status cs_addend_init(celspan_context *context, int32_t width, int32_t height,
                              cs_addend *out) {
  *out = (cs_addend){.width = width, .height = height};
  out->rows = cs_mem_array(context->memory, (size_t)height + 1, sizeof *out->rows);
  return out->rows ? CELSPAN_OK : cs_fail_memory(context);
}

void cs_addend_finish(cs_addend *addend, cs_memory *memory) {
  cs_mem_free(memory, addend->rows, ((size_t)addend->height + 1) * sizeof *addend->rows);
  cs_mem_free(memory, addend->spans, addend->span_capacity * sizeof *addend->spans);
  cs_mem_free(memory, addend->values, addend->value_capacity * sizeof *addend->values);
  *addend = (cs_addend){0};
}

size_t cs_addend_bytes(const cs_addend *addend) {
  return addend->span_count * sizeof *addend->spans + addend->value_count * sizeof *addend->values;
}

/* ---------------------------------------------------------------- writing */

celspan_status cs_addend_writer_init(celspan_context *context, cs_addend *addend, bool is_through,
                                     cs_addend_writer *out) {
  *out = (cs_addend_writer){.addend = addend, .is_through = is_through};
  out->dense = cs_mem_array(context->memory, (size_t)addend->width, 3 * sizeof *out->dense);
  return out->dense ? CELSPAN_OK : cs_fail_memory(context);
}

/* Gives back the room that was not needed. */
static void trim(void **items, size_t *capacity, size_t count, size_t size, cs_memory *memory) {
  void *fitting = count > 0 ? cs_mem_resize(memory, *items, *capacity * size, count * size) : NULL;
  if (!fitting)
    return;
  *items = fitting;
  *capacity = count;
}

void cs_addend_writer_finish(celspan_context *context, cs_addend_writer *writer) {
  cs_addend *addend = writer->addend;
  if (!addend)
    return;
  cs_mem_free(context->memory, writer->dense, (size_t)addend->width * 3 * sizeof *writer->dense);
  trim((void **)&addend->spans, &addend->span_capacity, addend->span_count, sizeof *addend->spans,
       context->memory);
  trim((void **)&addend->values, &addend->value_capacity, addend->value_count,
       sizeof *addend->values, context->memory);
  writer->addend = NULL;
}

/* Appends a span with room for so many values, which are to be filled. */
static celspan_status append(celspan_context *context, cs_addend *addend, cs_addend_span span,
                             size_t value_count, float **values) {
  CS_TRY(cs_mem_reserve(context, (void **)&addend->spans, &addend->span_capacity,
                        addend->span_count + 1, sizeof *addend->spans));
  CS_TRY(cs_mem_reserve(context, (void **)&addend->values, &addend->value_capacity,
                        addend->value_count + value_count, sizeof *addend->values));
  span.first = addend->value_count;
  *values = addend->values + addend->value_count;
  addend->value_count += value_count;
  addend->spans[addend->span_count++] = span;
  return CELSPAN_OK;
}

/* One column of the dense planes. */
static bool is_zero(const cs_addend_writer *w, int32_t x) {
  size_t width = (size_t)w->addend->width;
  return w->dense[x] == 0 && w->dense[width + (size_t)x] == 0 &&
         w->dense[2 * width + (size_t)x] == 0;
}

static celspan_status put_array(celspan_context *context, cs_addend_writer *w, int32_t x0,
                                int32_t x1) {
  size_t width = (size_t)w->addend->width, count = (size_t)(x1 - x0), bytes = count * sizeof(float);
  const float *planes = w->dense + x0;
  bool is_grey =
      memcmp(planes, planes + width, bytes) == 0 && memcmp(planes, planes + 2 * width, bytes) == 0;
  cs_addend_span span = {x0, x1, 0, is_grey ? CS_ADDEND_GREY : CS_ADDEND_ARRAY, 0};
  size_t plane_count = is_grey ? 1 : 3;
  float *values;
  CS_TRY(append(context, w->addend, span, plane_count * count, &values));
  for (size_t c = 0; c < plane_count; c++)
    memcpy(values + c * count, planes + c * width, bytes);
  return CELSPAN_OK;
}

/* The dense columns become arrays, without the zeros at their ends and in long gaps. */
static celspan_status flush(celspan_context *context, cs_addend_writer *w) {
  int32_t x0 = w->from, last = w->from; /* after the last column that is not 0 */
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

/* The colour of a column as it is added. */
static void colour_at(const cs_addend_writer *w, const celspan_span *span, int32_t x,
                      float rgb[3]) {
  float rgba[4];
  celspan_span_colour(span, x, rgba);
  for (int c = 0; c < 3; c++)
    rgb[c] = w->is_through ? 1 - rgba[3] : rgba[c];
}

static void add_dense(cs_addend_writer *w, const celspan_span *span) {
  size_t width = (size_t)w->addend->width;
  for (int32_t x = span->x0; x < span->x1; x++) {
    float rgb[3];
    colour_at(w, span, x, rgb);
    for (int c = 0; c < 3; c++)
      w->dense[(size_t)c * width + (size_t)x] = rgb[c];
  }
  w->end = span->x1;
}

static celspan_status add_long(celspan_context *context, cs_addend_writer *w,
                               const celspan_span *span) {
  bool is_gradient = span->kind == CELSPAN_SPAN_GRADIENT;
  float rgb[3], *values;
  int32_t origin = is_gradient ? span->origin : span->x0;
  CS_TRY(flush(context, w));
  w->from = w->end = span->x1;
  for (int c = 0; c < 3; c++)
    rgb[c] = w->is_through ? 1 - span->colour[3] : span->colour[c];
  if (!is_gradient && rgb[0] == 0 && rgb[1] == 0 && rgb[2] == 0)
    return CELSPAN_OK;
  cs_addend_span put = {span->x0, span->x1, origin,
                        is_gradient ? CS_ADDEND_GRADIENT : CS_ADDEND_SINGLE, 0};
  CS_TRY(append(context, w->addend, put, is_gradient ? 6 : 3, &values));
  memcpy(values, rgb, sizeof rgb);
  for (int c = 0; c < 3 && is_gradient; c++)
    values[3 + c] = w->is_through ? -span->slope[3] : span->slope[c];
  return CELSPAN_OK;
}

celspan_status cs_addend_writer_row(celspan_context *context, cs_addend_writer *writer, int32_t y,
                                    const celspan_span *spans, size_t count) {
  writer->from = writer->end = 0;
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

/* ---------------------------------------------------------------- summing */

/* One channel of a span. */
static void add_channel(const cs_addend_span *span, const float *values, cs_isa isa, int c,
                        float weight, float *out) {
  int32_t count = span->x1 - span->x0;
  switch (span->kind) {
  case CS_ADDEND_SINGLE:
    CS_WIDE_CHOOSE(isa, cs_addend_constant)(out, weight * values[c], count);
    return;
  case CS_ADDEND_GRADIENT:
    CS_WIDE_CHOOSE(isa, cs_addend_line)
    (out, weight, values[c], values[3 + c], span->x0 - span->origin, count);
    return;
  case CS_ADDEND_GREY:
    CS_WIDE_CHOOSE(isa, cs_addend_plane)(out, values, weight, count);
    return;
  case CS_ADDEND_ARRAY:
    CS_WIDE_CHOOSE(isa, cs_addend_plane)(out, values + (size_t)c * (size_t)count, weight, count);
    return;
  }
}

void cs_addend_add(const cs_addend *addend, cs_isa isa, int32_t y, const float weights[3],
                   float *planes) {
  for (size_t i = addend->rows[y]; i < addend->rows[y + 1]; i++) {
    const cs_addend_span *span = &addend->spans[i];
    for (int c = 0; c < 3; c++)
      if (weights[c] != 0)
        add_channel(span, addend->values + span->first, isa, c, weights[c],
                    planes + (size_t)c * (size_t)addend->width + span->x0);
  }
}
