/* Programs to their code and back, and what makes one good. */
#include <math.h>

#include "program.h"

/* ---------------------------------------------------------------- bits */

static void put_double(pf_encoder *encoder, uint16_t trees[8][256], double number) {
  unsigned char bytes[8];
  pf_store_double(bytes, number);
  for (int i = 0; i < 8; i++)
    pf_put_symbol(encoder, trees[i], 8, bytes[i]);
}

static double get_double(pf_decoder *decoder, uint16_t trees[8][256]) {
  unsigned char bytes[8];
  for (int i = 0; i < 8; i++)
    bytes[i] = (unsigned char)pf_get_symbol(decoder, trees[i], 8);
  return pf_load_double(bytes);
}

static void put_plane(pf_encoder *encoder, pf_program_models *models, const double plane[3]) {
  for (int i = 0; i < 3; i++)
    put_double(encoder, models->axis_bytes, plane[i]);
}

static void get_plane(pf_decoder *decoder, pf_program_models *models, double plane[3]) {
  for (int i = 0; i < 3; i++)
    plane[i] = get_double(decoder, models->axis_bytes);
}

/* A colour by its differences from another one. */
static void put_colour(pf_encoder *encoder, const pf_program_coding *coding, pf_number models[4],
                       const planefile_cell *from, const planefile_cell *colour) {
  for (int c = 0; c < 4; c++) {
    int64_t way = (int64_t)colour->colour[c] - from->colour[c];
    pf_put_signed(encoder, &models[c], way / coding->shade);
  }
}

static bool get_colour(pf_decoder *decoder, const pf_program_coding *coding, pf_number models[4],
                       const planefile_cell *from, planefile_cell *out) {
  bool is_good = true;
  for (int c = 0; c < 4; c++) {
    int64_t way = pf_get_signed(decoder, &models[c]) * coding->shade;
    int64_t channel = from->colour[c] + way;
    is_good = is_good && channel >= -PLANEFILE_BRIGHT && channel <= PLANEFILE_BRIGHT;
    out->colour[c] = is_good ? (int32_t)channel : 0;
  }
  return is_good;
}

/* From which the colours of steps differ: a layer from clear, factors from 1. */
static planefile_cell begin_colour(uint8_t kind) {
  int32_t all = kind == PLANEFILE_LEAVE ? PLANEFILE_WHITE : 0;
  return (planefile_cell){{all, all, all, all}};
}

/* ---------------------------------------------------------------- axes */

static void put_axis(pf_encoder *encoder, pf_program_models *models, const planefile_axis *axis) {
  pf_put_symbol(encoder, models->axis_kinds, 2, axis->kind);
  pf_put_symbol(encoder, models->is_wide, 1, !pf_axis_is_affine(axis));
  put_plane(encoder, models, axis->p);
  if (axis->kind != PLANEFILE_LINEAR)
    put_plane(encoder, models, axis->q);
  if (!pf_axis_is_affine(axis))
    put_plane(encoder, models, axis->w);
  if (axis->kind == PLANEFILE_RADIAL)
    put_double(encoder, models->axis_bytes, axis->focus);
  if (axis->kind == PLANEFILE_PICTURE) {
    pf_put_number(encoder, &models->pictures, axis->picture);
    pf_put_symbol(encoder, models->wraps, 2, axis->wrap);
    pf_put_symbol(encoder, models->filters, 2, axis->filter);
  }
}

static planefile_axis get_axis(pf_decoder *decoder, pf_program_models *models) {
  planefile_axis axis = {.kind = (uint8_t)pf_get_symbol(decoder, models->axis_kinds, 2),
                         .w = {0, 0, 1}};
  bool is_wide = pf_get_symbol(decoder, models->is_wide, 1);
  get_plane(decoder, models, axis.p);
  if (axis.kind != PLANEFILE_LINEAR)
    get_plane(decoder, models, axis.q);
  if (is_wide)
    get_plane(decoder, models, axis.w);
  if (axis.kind == PLANEFILE_RADIAL)
    axis.focus = get_double(decoder, models->axis_bytes);
  if (axis.kind == PLANEFILE_PICTURE) {
    axis.picture = pf_get_number(decoder, &models->pictures);
    axis.wrap = (uint8_t)pf_get_symbol(decoder, models->wraps, 2);
    axis.filter = (uint8_t)pf_get_symbol(decoder, models->filters, 2);
  }
  return axis;
}

static bool is_axis(const planefile_axis *axis) {
  bool is_good = axis->kind <= PLANEFILE_PICTURE && isfinite(axis->focus) &&
                 axis->wrap <= PLANEFILE_WRAP_REPEAT && axis->filter <= PLANEFILE_FILTER_CUBIC;
  for (int i = 0; i < 3; i++)
    is_good = is_good && isfinite(axis->p[i]) && isfinite(axis->q[i]) && isfinite(axis->w[i]);
  return is_good;
}

void pf_put_patch(pf_encoder *encoder, pf_program_coding *coding, const planefile_axis *axis) {
  put_double(encoder, coding->models.axis_bytes, axis->p[2]);
  if (axis->kind != PLANEFILE_LINEAR)
    put_double(encoder, coding->models.axis_bytes, axis->q[2]);
  if (!pf_axis_is_affine(axis))
    put_double(encoder, coding->models.axis_bytes, axis->w[2]);
}

bool pf_get_patch(pf_decoder *decoder, pf_program_coding *coding, planefile_axis *axis) {
  bool is_wide = !pf_axis_is_affine(axis);
  axis->p[2] = get_double(decoder, coding->models.axis_bytes);
  if (axis->kind != PLANEFILE_LINEAR)
    axis->q[2] = get_double(decoder, coding->models.axis_bytes);
  if (is_wide)
    axis->w[2] = get_double(decoder, coding->models.axis_bytes);
  return is_axis(axis);
}

/* ---------------------------------------------------------------- ramps */

static void put_ramp(pf_encoder *encoder, pf_program_coding *coding, const planefile_band *plane,
                     const planefile_step *step) {
  pf_program_models *models = &coding->models;
  uint32_t number = coding->axes[step->axis];
  pf_put_number(encoder, &models->axes, number > 0 ? coding->axis_count + 1 - number : 0);
  if (number == 0) {
    coding->axes[step->axis] = ++coding->axis_count;
    put_axis(encoder, models, &plane->axes[step->axis]);
  }
  pf_put_number(encoder, &models->stops, step->stop_count - 1);
  for (uint32_t i = 0; i < step->stop_count; i++) {
    const planefile_stop *stop = &plane->stops[step->stop + i];
    put_double(encoder, models->stop_bytes, stop->at);
    put_colour(encoder, coding, models->stop, &coding->colour, &stop->colour);
    coding->colour = stop->colour;
  }
  coding->stop_count += step->stop_count;
}

static const char *get_stops(pf_decoder *decoder, pf_program_coding *coding,
                             const pf_program_room *room, planefile_step *step) {
  uint32_t more = pf_get_number(decoder, &coding->models.stops);
  if (more >= room->stop_count - coding->stop_count)
    return "it has more than it claims";
  step->stop = coding->stop_count;
  step->stop_count = more + 1;
  for (uint32_t i = 0; i <= more; i++) {
    planefile_stop *stop = &room->stops[coding->stop_count++];
    stop->at = get_double(decoder, coding->models.stop_bytes);
    if (!get_colour(decoder, coding, coding->models.stop, &coding->colour, &stop->colour))
      return "a stop is too bright";
    if (!isfinite(stop->at) || (i > 0 && stop->at < stop[-1].at))
      return "its stops are not in order";
    if (decoder->is_beyond)
      return "its code ends too early";
    coding->colour = stop->colour;
  }
  return NULL;
}

static const char *get_ramp(pf_decoder *decoder, pf_program_coding *coding,
                            const pf_program_room *room, planefile_step *step) {
  uint32_t back = pf_get_number(decoder, &coding->models.axes);
  if (back > coding->axis_count)
    return "there is no such axis";
  step->axis = coding->axis_count - back;
  if (back == 0) {
    if (coding->axis_count == room->axis_count)
      return "it has more than it claims";
    room->axes[coding->axis_count] = get_axis(decoder, &coding->models);
    if (!is_axis(&room->axes[coding->axis_count++]))
      return "an axis is not allowed";
  }
  return get_stops(decoder, coding, room, step);
}

/* ---------------------------------------------------------------- steps */

static void put_step(pf_encoder *encoder, pf_program_coding *coding, const planefile_band *plane,
                     const planefile_step *step) {
  pf_program_models *models = &coding->models;
  const planefile_cell from = begin_colour(step->kind);
  pf_put_symbol(encoder, models->kinds, 2, step->kind);
  if (step->kind == PLANEFILE_RAMP)
    put_ramp(encoder, coding, plane, step);
  if (step->kind == PLANEFILE_LEAVE)
    pf_put_symbol(encoder, models->hows, 4, step->how);
  if (step->kind == PLANEFILE_FLAT || step->kind == PLANEFILE_LEAVE)
    put_colour(encoder, coding, step->kind == PLANEFILE_FLAT ? models->flat : models->factor, &from,
               &step->colour);
}

static const char *get_step(pf_decoder *decoder, pf_program_coding *coding,
                            const pf_program_room *room, planefile_step *out) {
  pf_program_models *models = &coding->models;
  uint8_t kind = (uint8_t)pf_get_symbol(decoder, models->kinds, 2);
  const planefile_cell from = begin_colour(kind);
  *out = (planefile_step){.kind = kind};
  if (kind == PLANEFILE_RAMP)
    return get_ramp(decoder, coding, room, out);
  if (kind == PLANEFILE_ENTER)
    return NULL;
  if (kind == PLANEFILE_LEAVE)
    out->how = (uint8_t)pf_get_symbol(decoder, models->hows, 4);
  return get_colour(decoder, coding, kind == PLANEFILE_FLAT ? models->flat : models->factor, &from,
                    &out->colour)
             ? NULL
             : "a layer is too bright";
}

void pf_put_program(pf_encoder *encoder, pf_program_coding *coding, const planefile_band *plane,
                    planefile_program program) {
  pf_put_number(encoder, &coding->models.steps, program.step_count - 1);
  for (uint32_t i = 0; i < program.step_count; i++)
    put_step(encoder, coding, plane, &plane->steps[program.step + i]);
  coding->step_count += program.step_count;
}

/* Why what was decoded is refused, or NULL. */
static const char *check_program(const pf_program_coding *coding, const pf_program_room *room,
                                 planefile_program program) {
  const planefile_band band = {.steps = room->steps,
                               .axes = room->axes,
                               .stops = room->stops,
                               .step_count = coding->step_count,
                               .axis_count = coding->axis_count,
                               .stop_count = coding->stop_count,
                               .picture_count = room->picture_count};
  return pf_program_is_good(&band, program) ? NULL : "a program is not allowed";
}

const char *pf_get_program(pf_decoder *decoder, pf_program_coding *coding,
                           const pf_program_room *room, planefile_program *out) {
  uint32_t more = pf_get_number(decoder, &coding->models.steps);
  const char *reason = NULL;
  if (more >= room->step_count - coding->step_count)
    return "it has more than it claims";
  *out = (planefile_program){coding->step_count, more + 1};
  for (uint32_t i = 0; i <= more && !reason; i++) {
    reason = get_step(decoder, coding, room, &room->steps[coding->step_count++]);
    if (decoder->is_beyond)
      return "its code ends too early";
  }
  return reason ? reason : check_program(coding, room, *out);
}

/* ---------------------------------------------------------------- other colours */

/* The models of the colours of steps of a kind. */
static pf_number *recoloured_as(pf_program_models *models, uint8_t kind) {
  return models->recoloured[kind == PLANEFILE_FLAT ? 0 : kind == PLANEFILE_RAMP ? 1 : 2];
}

void pf_put_recoloured(pf_encoder *encoder, pf_program_coding *coding, const planefile_band *from,
                       planefile_program of, const planefile_band *plane,
                       planefile_program program) {
  for (uint32_t i = 0; i < program.step_count; i++) {
    const planefile_step *old = &from->steps[of.step + i];
    const planefile_step *step = &plane->steps[program.step + i];
    pf_number *numbers = recoloured_as(&coding->models, step->kind);
    for (uint32_t k = 0; step->kind == PLANEFILE_RAMP && k < step->stop_count; k++)
      put_colour(encoder, coding, numbers, &from->stops[old->stop + k].colour,
                 &plane->stops[step->stop + k].colour);
    if (step->kind == PLANEFILE_FLAT || step->kind == PLANEFILE_LEAVE)
      put_colour(encoder, coding, numbers, &old->colour, &step->colour);
  }
}

static bool get_recoloured_step(pf_decoder *decoder, pf_program_coding *coding,
                                const pf_program_room *room, planefile_step *step) {
  pf_number *numbers = recoloured_as(&coding->models, step->kind);
  bool is_good = true;
  for (uint32_t k = 0; step->kind == PLANEFILE_RAMP && is_good && k < step->stop_count; k++) {
    planefile_cell *colour = &room->stops[step->stop + k].colour;
    is_good = get_colour(decoder, coding, numbers, colour, colour);
  }
  if (step->kind == PLANEFILE_FLAT || step->kind == PLANEFILE_LEAVE)
    is_good = get_colour(decoder, coding, numbers, &step->colour, &step->colour);
  return is_good;
}

const char *pf_get_recoloured(pf_decoder *decoder, pf_program_coding *coding,
                              const pf_program_room *room, planefile_program program) {
  for (uint32_t i = 0; i < program.step_count; i++)
    if (!get_recoloured_step(decoder, coding, room, &room->steps[program.step + i]))
      return "a layer is too bright";
  return check_program(coding, room, program);
}

/* ---------------------------------------------------------------- good programs */

static bool is_colour(const planefile_cell *colour, int32_t least) {
  bool is_good = true;
  for (int c = 0; c < 4; c++)
    is_good = is_good && colour->colour[c] >= least && colour->colour[c] <= PLANEFILE_BRIGHT;
  return is_good;
}

static bool is_ramp(const planefile_band *band, const planefile_step *step) {
  if (step->axis >= band->axis_count || step->stop > band->stop_count || step->stop_count == 0 ||
      step->stop_count > band->stop_count - step->stop || !is_axis(&band->axes[step->axis]))
    return false;
  const planefile_axis *axis = &band->axes[step->axis];
  const planefile_stop *stops = &band->stops[step->stop];
  bool is_good = axis->kind != PLANEFILE_TRIANGLE || step->stop_count == 3;
  if (axis->kind == PLANEFILE_PICTURE)
    is_good = step->stop_count == 1 && axis->picture < band->picture_count &&
              is_colour(&stops->colour, 0);
  for (uint32_t i = 0; is_good && i < step->stop_count; i++)
    is_good = isfinite(stops[i].at) && is_colour(&stops[i].colour, -PLANEFILE_BRIGHT) &&
              (i == 0 || stops[i].at >= stops[i - 1].at);
  return is_good;
}

bool pf_program_is_good(const planefile_band *band, planefile_program program) {
  uint32_t depth = 0;
  if (program.step > band->step_count || program.step_count > band->step_count - program.step)
    return false;
  for (uint32_t i = 0; i < program.step_count; i++) {
    const planefile_step *step = &band->steps[program.step + i];
    if (step->kind > PLANEFILE_LEAVE || (step->kind == PLANEFILE_RAMP && !is_ramp(band, step)) ||
        (step->kind == PLANEFILE_FLAT && !is_colour(&step->colour, -PLANEFILE_BRIGHT)) ||
        (step->kind == PLANEFILE_LEAVE &&
         (depth == 0 || step->how > PLANEFILE_INVERTED_LUMA || !is_colour(&step->colour, 0))))
      return false;
    depth += step->kind == PLANEFILE_ENTER;
    depth -= step->kind == PLANEFILE_LEAVE;
    if (depth > PLANEFILE_DEPTH)
      return false;
  }
  return depth == 0;
}

static bool is_opaque(const planefile_cell *colour) { return colour->colour[3] == PLANEFILE_WHITE; }

/* Whether a layer hides all that is behind it. */
static bool hides(const planefile_band *band, const planefile_step *step, bool is_faced) {
  if (step->kind == PLANEFILE_FLAT)
    return is_opaque(&step->colour);
  const planefile_axis *axis = &band->axes[step->axis];
  bool is_solid = step->kind == PLANEFILE_RAMP && axis->kind != PLANEFILE_PICTURE &&
                  (is_faced || pf_axis_is_affine(axis));
  for (uint32_t i = 0; is_solid && i < step->stop_count; i++)
    is_solid = is_opaque(&band->stops[step->stop + i].colour);
  return is_solid;
}

bool pf_program_hides(const planefile_band *band, planefile_program program, bool is_faced) {
  bool is_hidden[PLANEFILE_DEPTH + 1] = {false}; /* nothing more shows, in the groups so far */
  bool is_matted[PLANEFILE_DEPTH + 1] = {false}; /* no layer to come hides anything */
  uint32_t depth = 0;
  for (uint32_t i = 0; i < program.step_count; i++) {
    const planefile_step *step = &band->steps[program.step + i];
    if (step->kind == PLANEFILE_ENTER) {
      depth++;
      is_hidden[depth] = is_matted[depth] = false;
    } else if (step->kind == PLANEFILE_LEAVE) {
      depth--;
      is_matted[depth] |= step->how >= PLANEFILE_MATTE;
      is_hidden[depth] |= step->how <= PLANEFILE_DECODED && !is_matted[depth] &&
                          is_hidden[depth + 1] && is_opaque(&step->colour);
    } else {
      is_hidden[depth] |= !is_matted[depth] && hides(band, step, is_faced);
    }
  }
  return is_hidden[0];
}
