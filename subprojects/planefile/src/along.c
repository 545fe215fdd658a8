/* Cells that vary along one axis, as functions of the place on it. */
#include "plane.h"

static bool are_same(const planefile_axis *a, const planefile_axis *b) {
  bool same = a->kind == b->kind && a->focus == b->focus;
  for (int i = 0; i < 3; i++)
    same &= a->p[i] == b->p[i] && a->w[i] == b->w[i] &&
            (a->kind == PLANEFILE_LINEAR || a->q[i] == b->q[i]);
  return same;
}

/* A curve is within the hull of its points. */
static bool is_before(const planefile_band *band, const planefile_border *border,
                      const planefile_axis *axis) {
  const planefile_chain *chain = &band->chains[border->chain];
  bool is_so = true;
  for (uint32_t i = 0; i < chain->piece_count; i++) {
    const planefile_piece *piece = &band->pieces[chain->piece + i];
    const planefile_point *points = &band->points[piece->point];
    if (points[piece->degree].y <= border->top || points[0].y >= border->foot)
      continue;
    for (uint32_t k = 0; k <= piece->degree; k++) {
      const planefile_point *at = &points[k];
      double x = (double)at->x / PLANEFILE_SIDE, y = (double)at->y / PLANEFILE_SIDE;
      is_so &= axis->w[0] * x + axis->w[1] * y + axis->w[2] > 0;
    }
  }
  return is_so;
}

bool planefile_faces(const planefile_band *band, const planefile_border *border, uint32_t cell) {
  const planefile_program *program = band->programs ? &band->programs[cell] : NULL;
  bool is_so = true;
  for (uint32_t i = 0; is_so && program && i < program->step_count; i++) {
    const planefile_step *step = &band->steps[program->step + i];
    const planefile_axis *axis = &band->axes[step->axis];
    if (step->kind == PLANEFILE_RAMP && !pf_axis_is_affine(axis))
      is_so = is_before(band, border, axis);
  }
  return is_so;
}

bool planefile_hides(const planefile_band *band, uint32_t cell, bool is_faced) {
  return pf_program_hides(band, band->programs[cell], is_faced);
}

const planefile_axis *planefile_only_axis(const planefile_band *band, uint32_t cell) {
  const planefile_axis *only = NULL;
  const planefile_program *program = band->programs ? &band->programs[cell] : NULL;
  for (uint32_t i = 0; program && i < program->step_count; i++) {
    const planefile_step *step = &band->steps[program->step + i];
    const planefile_axis *axis = &band->axes[step->axis];
    if (step->kind != PLANEFILE_RAMP)
      continue;
    if (axis->kind > PLANEFILE_RADIAL || (only && !are_same(axis, only)))
      return NULL;
    only = axis;
  }
  return only;
}

/* The program with all of its ramps along one axis, which goes across a row of pixels. */
typedef struct straight {
  planefile_axis axis;
  planefile_step *steps;
  planefile_band band;
} straight;

static void lay_out(const planefile_band *band, planefile_program program, double from, double to,
                    straight *out) {
  out->axis = (planefile_axis){.p = {to - from, 0, from}, .w = {0, 0, 1}};
  memcpy(out->steps, band->steps + program.step, program.step_count * sizeof *out->steps);
  for (uint32_t i = 0; i < program.step_count; i++)
    out->steps[i].axis = 0;
  out->band = *band;
  out->band.steps = out->steps;
  out->band.axes = &out->axis;
}

static int32_t in_units(float channel) {
  double value = (double)channel * PLANEFILE_WHITE;
  value = value > PLANEFILE_BRIGHT ? PLANEFILE_BRIGHT : value;
  value = value > -PLANEFILE_BRIGHT ? value : -PLANEFILE_BRIGHT;
  return (int32_t)(value < 0 ? value - 0.5 : value + 0.5);
}

bool planefile_along(const planefile_plane *plane, const planefile_band *band, uint32_t cell,
                     double from, double to, uint32_t count, planefile_cell *out) {
  const planefile_program program = band->programs[cell];
  straight laid = {.steps = pf_make(&plane->memory, sizeof *laid.steps, program.step_count)};
  pf_colours *room = pf_make(&plane->memory, sizeof *room, PF_ROOM);
  bool is_made = laid.steps && room;
  if (is_made)
    lay_out(band, program, from, to, &laid);
  for (uint32_t x = 0; is_made && x < count; x += PF_BATCH) {
    uint32_t some = count - x < PF_BATCH ? count - x : PF_BATCH;
    const pf_pixels pixels = {count, 1, x, 0, some};
    const pf_program_source source = {&laid.band, plane->pictures, &plane->curve};
    pf_program_colours(&source, (planefile_program){0, program.step_count}, &pixels, room);
    for (uint32_t k = 0; k < some; k++)
      for (int c = 0; c < 4; c++)
        out[x + k].colour[c] = in_units(room->channels[c][k]);
  }
  pf_free(&plane->memory, room, sizeof *room, PF_ROOM);
  pf_free(&plane->memory, laid.steps, sizeof *laid.steps, program.step_count);
  return is_made;
}
