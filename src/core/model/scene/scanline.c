#include "model/scene/scanline.h"

#include <math.h>
#include <string.h>

#include "base/number.h"
#include "model/scene/check.h"

void cs_scanline_init(celspan_scanline_output *output) { memset(output, 0, sizeof *output); }

void cs_scanline_finish(celspan_scanline_output *output, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, output, spans, paints);
  cs_scanline_init(output);
}

static celspan_status refuse_ends(const celspan_scanline_output *output, double x0, double x1) {
  celspan_context *context = output->context;
  size_t number = output->emitted + 1;
  cs_check_text at = cs_check_number_text(output->y), begin = cs_check_number_text(x0),
                end = cs_check_number_text(x1), before = cs_check_number_text(output->last_x1);
  bool is_begin = !cs_number_is_sane(x0);
  if (is_begin || !cs_number_is_sane(x1))
    return cs_fail(context, CELSPAN_CALLBACK,
                   "scanline: the %s of span %zu at y = %s must be a %s, got %s",
                   is_begin ? "beginning" : "end", number, at.text,
                   isfinite(is_begin ? x0 : x1) ? "number between -1e12 and 1e12" : "finite number",
                   is_begin ? begin.text : end.text);
  if (x1 < x0)
    return cs_fail(context, CELSPAN_CALLBACK,
                   "scanline: span %zu at y = %s ends at %s, before it begins at %s", number,
                   at.text, end.text, begin.text);
  return cs_fail(context, CELSPAN_CALLBACK,
                 "scanline: span %zu at y = %s begins at %s, before the one before it ends at %s; "
                 "spans must ascend and not overlap",
                 number, at.text, begin.text, before.text);
}

static celspan_status check_paints(const celspan_scanline_output *output,
                                   const celspan_paint *paints, size_t count) {
  if (count == 0 || !paints)
    return cs_fail(output->context, CELSPAN_CALLBACK, "scanline: span %zu at y = %s has no paint",
                   output->emitted + 1, cs_check_number_text(output->y).text);
  CS_TRY(cs_check_list(output->context, "scanline", "paints", paints, count, CS_CHECK_ITEMS));
  for (size_t i = 0; i < count; i++)
    if (!cs_paint_is_valid(&paints[i]))
      return cs_fail(output->context, CELSPAN_CALLBACK,
                     "scanline: paint %zu of span %zu at y = %s has a value outside 0..1", i + 1,
                     output->emitted + 1, cs_check_number_text(output->y).text);
  return CELSPAN_OK;
}

static celspan_status check_span(const celspan_scanline_output *output, double x0, double x1,
                                 const celspan_paint *paints, size_t paint_count) {
  bool is_ascending = output->emitted == 0 || x0 >= output->last_x1;
  if (!cs_number_is_sane(x0) || !cs_number_is_sane(x1) || x1 < x0 || !is_ascending)
    return refuse_ends(output, x0, x1);
  return check_paints(output, paints, paint_count);
}

static celspan_status append(celspan_scanline_output *output, const cs_scanline_span *span,
                             const celspan_paint *paints) {
  CS_TRY(
      CS_ARRAY_RESERVE(output->context, output->paints, output->paint_count + span->paint_count));
  CS_TRY(CS_ARRAY_APPEND(output->context, output->spans, output->span_count, *span));
  for (size_t i = 0; i < span->paint_count; i++)
    output->paints[output->paint_count++] = cs_paint_from_straight(&paints[i]);
  return CELSPAN_OK;
}

celspan_status celspan_scanline_emit(celspan_scanline_output *output, double x0, double x1,
                                     const celspan_paint *paints, size_t paint_count) {
  if (output->status != CELSPAN_OK)
    return output->status;
  output->status = check_span(output, x0, x1, paints, paint_count);
  if (output->status != CELSPAN_OK)
    return output->status;
  output->emitted++;
  output->last_x1 = x1;
  const celspan_box *bounds = &output->desc->bounds;
  cs_scanline_span span = {
      fmax(x0, bounds->x), fmin(x1, bounds->x + bounds->width), x0, x1, output->paint_count,
      paint_count};
  if (span.x0 < span.x1)
    output->status = append(output, &span, paints);
  return output->status;
}

celspan_status cs_scanline_collect(celspan_context *context, const celspan_scanline_desc *desc,
                                   double y, const celspan_scanline_row *row,
                                   celspan_scanline_output *output) {
  output->context = context;
  output->desc = desc;
  output->y = y;
  output->status = CELSPAN_OK;
  output->emitted = output->span_count = output->paint_count = 0;
  if (!(y >= desc->bounds.y && y < desc->bounds.y + desc->bounds.height))
    return CELSPAN_OK;
  context->error[0] = 0;
  celspan_status status = desc->spans(desc->user, context, y, row, output);
  if (output->status != CELSPAN_OK)
    return output->status;
  if (status != CELSPAN_OK && context->error[0] == 0)
    return cs_fail(context, status, "scanline: its spans function failed at y = %s",
                   cs_check_number_text(y).text);
  return status;
}
