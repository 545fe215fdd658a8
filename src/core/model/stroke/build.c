/* Making a stroke from its description: the line, its parts, the box around all, and the hash. */
#include <math.h>

#include "model/stroke/parts.h"

/* A piece lies in the hull of its control points, because the weights are positive. */
static void find_around(cs_stroke *stroke) {
  double left = HUGE_VAL, right = -HUGE_VAL, top = HUGE_VAL, bottom = -HUGE_VAL;
  double extent = cs_stroke_extent(stroke) * stroke->largest;
  for (size_t i = 0; i < stroke->line.point_count; i++) {
    cs_hpoint p = stroke->line.points[i];
    left = fmin(left, p.x / p.w);
    right = fmax(right, p.x / p.w);
    top = fmin(top, p.y / p.w);
    bottom = fmax(bottom, p.y / p.w);
  }
  if (stroke->part_count > 0 && stroke->largest > 0)
    stroke->around = (celspan_box){left - extent, top - extent, right - left + 2 * extent,
                                   bottom - top + 2 * extent};
}

static celspan_status build(celspan_context *context, cs_stroke *stroke,
                            const celspan_stroke_desc *desc, const cs_stroke_raw *raw) {
  cs_outline_closed none = {0};
  bool tapers = desc->dash_count == 0 && (desc->taper[0] > 0 || desc->taper[1] > 0);
  for (size_t i = 0; i < raw->line.contour_count; i++)
    CS_TRY(cs_stroke_append_contour(context, stroke, raw, i));
  CS_TRY(cs_stroke_divide(context, stroke, desc, tapers ? &none : &raw->closed));
  if (tapers)
    CS_TRY(cs_stroke_taper(context, stroke, desc));
  find_around(stroke);
  return CELSPAN_OK;
}

static void hash_part(cs_hash *hash, const cs_stroke_part *part) {
  cs_hash_word(hash, part->first);
  cs_hash_word(hash, part->count);
  cs_hash_number(hash, part->begin);
  cs_hash_number(hash, part->end);
  cs_hash_word(hash, part->is_closed);
}

static void hash_dashes(cs_hash *hash, const cs_dashes *dashes) {
  cs_hash_number(hash, dashes->pattern);
  cs_hash_numbers(hash, dashes->places, dashes->place_count);
  for (size_t i = 0; i < dashes->run_count; i++) {
    const cs_dashes_run *run = &dashes->runs[i];
    cs_hash_word(hash, run->contour);
    cs_hash_word(hash, run->is_closed);
    cs_hash_word(hash, run->is_joined);
    cs_hash_number(hash, run->start);
    cs_hash_number(hash, run->from);
    cs_hash_number(hash, run->to);
  }
}

/* Of what decides how the stroke is drawn. */
static cs_hash hash_of(const cs_stroke *stroke) {
  cs_hash hash = cs_hash_begin(0);
  cs_outline_hash(&hash, &stroke->line);
  cs_hash_word(&hash, stroke->cap);
  cs_hash_word(&hash, stroke->join);
  cs_hash_number(&hash, stroke->miter);
  for (size_t i = 0; i < stroke->line.piece_count; i++)
    cs_hash_word(&hash, stroke->radius_degrees[i]);
  cs_hash_numbers(&hash, stroke->radii, stroke->radius_count);
  cs_hash_word(&hash, stroke->part_count);
  if (stroke->dashes.place_count > 0)
    hash_dashes(&hash, &stroke->dashes);
  else
    for (size_t i = 0; i < stroke->part_count; i++)
      hash_part(&hash, &stroke->parts[i]);
  return cs_hash_end(hash);
}

celspan_status cs_stroke_init(celspan_context *context, cs_stroke *stroke,
                              const celspan_stroke_desc *desc, const cs_outline *outline,
                              const cs_outline_closed *closed) {
  *stroke = (cs_stroke){.cap = desc->cap, .join = desc->join, .miter = desc->miter};
  cs_outline_init(&stroke->line);
  cs_stroke_raw raw;
  celspan_status status = cs_stroke_raw_init(context, &raw, desc, outline, closed);
  if (status == CELSPAN_OK)
    status = build(context, stroke, desc, &raw);
  if (status == CELSPAN_OK)
    stroke->hash = hash_of(stroke);
  cs_stroke_raw_finish(&raw, context->memory);
  return status;
}
