#include "engine/record/programs.h"

#include <math.h>

#include "base/number.h"
#include "engine/paint/over_row.h"
#include "engine/record/pictures.h"
#include "engine/record/places.h"

#define SAMPLES 64              /* of a table, from one stop to the next */
#define TOLERANCE (1.0 / 16384) /* of a table */

typedef struct program_maker {
  const cs_record_source *source;
  cs_recording *record;
  uint32_t first; /* step of the program */
  uint32_t group; /* the innermost that was entered, or CS_STACK_NONE */
  uint32_t outer[PLANEFILE_DEPTH], depth, deepest;
  size_t light; /* the next back light to be met */
  float keep;   /* what the mattes of back lights leave of transparency */
  bool is_hard; /* it is not only layers over each other */
} program_maker;

/* ---------------------------------------------------------------- colours */

static int32_t channel_of(double value) {
  double channel = floor(value * PLANEFILE_WHITE + 0.5);
  return (int32_t)cs_number_clamp(channel, -PLANEFILE_BRIGHT, PLANEFILE_BRIGHT);
}

static planefile_cell cell_of(cs_v4 light, float alpha) {
  return (planefile_cell){
      {channel_of(light[0]), channel_of(light[1]), channel_of(light[2]), channel_of(alpha)}};
}

static bool is_grey(cs_v4 t) { return t[0] == t[1] && t[1] == t[2]; }

/* ---------------------------------------------------------------- steps */

static celspan_status add_step(program_maker *m, planefile_step step) {
  cs_recording *record = m->record;
  return CS_APPEND(m->source->context, record->steps, record->step_count, record->step_capacity,
                   step);
}

/* Adds a layer of one colour: to the one in front of it, if that is such a layer, too. */
static celspan_status add_flat(program_maker *m, cs_v4 light, float alpha) {
  cs_recording *record = m->record;
  planefile_step *last =
      record->step_count > m->first ? &record->steps[record->step_count - 1] : NULL;
  if (!last || last->kind != PLANEFILE_FLAT)
    return add_step(m, (planefile_step){.kind = PLANEFILE_FLAT, .colour = cell_of(light, alpha)});
  double through = 1 - (double)last->colour.colour[3] / PLANEFILE_WHITE;
  cs_v4 behind = light;
  behind[3] = alpha;
  for (int c = 0; c < 4; c++)
    last->colour.colour[c] =
        channel_of((double)last->colour.colour[c] / PLANEFILE_WHITE + through * (double)behind[c]);
  return CELSPAN_OK;
}

static celspan_status meet_light(program_maker *m) {
  const cs_back_light *light = &m->source->stack->lights[m->light++];
  m->keep *= light->keep;
  return add_flat(m, light->light, 0);
}

/* All that is behind is met: mattes make what is left opaque. */
static celspan_status end_frame(program_maker *m) {
  while (m->light < m->source->stack->light_count)
    CS_TRY(meet_light(m));
  float keep = m->keep;
  m->keep = 1;
  return keep < 1 ? add_flat(m, cs_v4_all(0), 1 - keep) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- groups */

static bool is_hard_group(const cs_group *group) {
  return group->kind != CS_GROUP_PLAIN || group->grade || group->has_light ||
         group->converts == CELSPAN_SPACE_SRGB;
}

static celspan_status open_group(program_maker *m, uint32_t group) {
  m->is_hard |= m->depth == m->deepest || is_hard_group(&m->source->stack->groups[group]);
  if (m->is_hard)
    return CELSPAN_OK;
  m->outer[m->depth++] = m->group;
  m->group = group;
  return add_step(m, (planefile_step){.kind = PLANEFILE_ENTER});
}

/* The recursion is at most CS_STACK_GROUPS groups deep. */
static celspan_status enter_group(program_maker *m, uint32_t group) {
  const cs_stack *stack = m->source->stack;
  uint32_t parent = cs_stack_around(stack, group, m->group);
  if (parent != m->group)
    CS_TRY(enter_group(m, parent));
  return m->is_hard ? CELSPAN_OK : open_group(m, group);
}

/* What leaving a group does to its channels. */
static planefile_step leaving(const cs_group *group) {
  cs_v4 factors = cs_v4_all(1);
  if (group->has_front)
    factors = group->front;
  return (planefile_step){.kind = PLANEFILE_LEAVE,
                          .how = group->converts == CELSPAN_SPACE_LINEAR ? PLANEFILE_DECODED : PLANEFILE_LAYER,
                          .colour = cell_of(group->fade * factors, group->fade)};
}

static bool does_nothing(const planefile_step *leave) {
  bool is_one = leave->how == PLANEFILE_LAYER;
  for (int c = 0; c < 4; c++)
    is_one = is_one && leave->colour.colour[c] == PLANEFILE_WHITE;
  return is_one;
}

/* Removes the step that entered the innermost group. */
static void forget_enter(program_maker *m) {
  cs_recording *record = m->record;
  size_t at = record->step_count, depth = 1;
  while (depth > 0) {
    uint8_t kind = record->steps[--at].kind;
    depth += kind == PLANEFILE_LEAVE;
    depth -= kind == PLANEFILE_ENTER;
  }
  record->step_count--;
  memmove(&record->steps[at], &record->steps[at + 1],
          (record->step_count - at) * sizeof *record->steps);
}

static celspan_status leave_group(program_maker *m) {
  const cs_group *group = &m->source->stack->groups[m->group];
  const planefile_step leave = leaving(group);
  if (group->is_frame) {
    m->is_hard |= m->keep != 1 && group->fade != 1;
    CS_TRY(end_frame(m));
  }
  m->group = m->outer[--m->depth];
  if (!does_nothing(&leave))
    return add_step(m, leave);
  forget_enter(m);
  return CELSPAN_OK;
}

/* As cs_over_move. */
static celspan_status move(program_maker *m, uint32_t layer) {
  const cs_stack *stack = m->source->stack;
  uint32_t group = stack->layers[layer].group;
  while (m->group != CS_STACK_NONE && layer < stack->groups[m->group].first)
    CS_TRY(leave_group(m));
  while (m->light < stack->light_count && layer < stack->lights[m->light].below)
    CS_TRY(meet_light(m));
  if (group != CS_STACK_NONE && group != m->group) {
    uint32_t entered = cs_stack_entered(stack, group, m->group);
    if (entered != m->group)
      CS_TRY(enter_group(m, entered));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- axes */

/* The shares of the second and the third corner. */
static void place_corners(const cs_shade *shade, planefile_axis *out) {
  const celspan_point *p = shade->texture->variation->points;
  double ux = p[1].x - p[0].x, uy = p[1].y - p[0].y;
  double vx = p[2].x - p[0].x, vy = p[2].y - p[0].y, area = ux * vy - uy * vx;
  cs_place_own(&shade->inverse,
               (double[3]){vy / area, -vx / area, (p[0].y * vx - p[0].x * vy) / area}, out->p);
  cs_place_own(&shade->inverse,
               (double[3]){-uy / area, ux / area, (p[0].x * uy - p[0].y * ux) / area}, out->q);
  cs_place_own(&shade->inverse, (double[3]){0, 0, 1}, out->w);
}

static planefile_axis axis_of(const cs_shade *shade) {
  planefile_axis axis = {.kind = PLANEFILE_LINEAR, .w = {0, 0, 1}};
  if (shade->texture->kind == CS_TEXTURE_TRIANGLE) {
    axis.kind = PLANEFILE_TRIANGLE;
    place_corners(shade, &axis);
    return axis;
  }
  cs_place_plane(shade->plane[0], axis.p);
  if (shade->texture->kind == CS_TEXTURE_RADIAL) {
    axis.kind = PLANEFILE_RADIAL;
    axis.focus = shade->eccentricity;
    cs_place_plane(shade->plane[1], axis.q);
  }
  if (!shade->is_affine)
    cs_place_own(&shade->inverse, (double[3]){0, 0, 1}, axis.w);
  return axis;
}

/* Where the axis of a layer is known; *out: the axis, if it is not known yet. */
static celspan_status make_axis(program_maker *m, const cs_layer *layer, uint32_t **known,
                                planefile_axis *out) {
  const cs_stack *stack = m->source->stack;
  celspan_context *context = m->source->context;
  *known = m->source->axes + layer->index;
  if (layer->kind != CS_LAYER_SHADED)
    *known += stack->shade_count;
  if (layer->kind == CS_LAYER_DEFOCUSED)
    *known += stack->image_count;
  if (**known > 0)
    return CELSPAN_OK;
  if (layer->kind == CS_LAYER_PICTURE)
    return cs_record_image(context, &stack->images[layer->index], m->record, out);
  if (layer->kind == CS_LAYER_DEFOCUSED)
    return cs_record_defocused(context, m->source->defocus[layer->index], m->record, out);
  *out = axis_of(&stack->shades[layer->index]);
  return CELSPAN_OK;
}

static celspan_status find_axis(program_maker *m, const cs_layer *layer, uint32_t *out) {
  cs_recording *record = m->record;
  planefile_axis axis;
  uint32_t *known;
  CS_TRY(make_axis(m, layer, &known, &axis));
  if (*known == 0) {
    CS_TRY(CS_APPEND(m->source->context, record->axes, record->axis_count, record->axis_capacity,
                     axis));
    *known = (uint32_t)record->axis_count;
  }
  *out = *known - 1;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- gradients */

static celspan_status add_stop(program_maker *m, double at, planefile_cell colour) {
  cs_recording *record = m->record;
  return CS_APPEND(m->source->context, record->stops, record->stop_count, record->stop_capacity,
                   ((planefile_stop){at, colour}));
}

/* Adds a ramp over the stops that were added from `stop` on. */
static celspan_status add_varied(program_maker *m, const cs_layer *layer, size_t stop) {
  uint32_t axis;
  CS_TRY(find_axis(m, layer, &axis));
  return add_step(m, (planefile_step){.kind = PLANEFILE_RAMP,
                                      .axis = axis,
                                      .stop = (uint32_t)stop,
                                      .stop_count = (uint32_t)(m->record->stop_count - stop)});
}

/* A paint in its layer. Paints that dim the channels in different ways are hard. */
static planefile_cell lit(program_maker *m, const cs_layer *layer, const cs_paint *paint) {
  cs_v4 s = {paint->s[0], paint->s[1], paint->s[2], 0};
  cs_v4 t = {paint->t[0], paint->t[1], paint->t[2], 0};
  m->is_hard |= !is_grey(t) || layer->role == CS_LAYER_FRONT;
  if (layer->role == CS_LAYER_BACK)
    t = cs_v4_all(1);
  cs_over_pair pair = cs_over_lit(layer->front, layer->fade, s, t);
  return cell_of(pair.e, 1 - pair.t[0]);
}

static celspan_status add_gradient(program_maker *m, const cs_layer *layer) {
  const cs_texture_variation *of = m->source->stack->shades[layer->index].texture->variation;
  size_t stop = m->record->stop_count;
  for (size_t i = 0; i < of->stop_count; i++)
    CS_TRY(add_stop(m, of->stops[i].at, lit(m, layer, &of->stops[i].paint)));
  return add_varied(m, layer, stop);
}

/* A triangle is limited before it is lit, so it is a group. */
static celspan_status add_triangle(program_maker *m, const cs_layer *layer) {
  const cs_texture_variation *of = m->source->stack->shades[layer->index].texture->variation;
  size_t stop = m->record->stop_count;
  m->is_hard |= layer->role != CS_LAYER_PAINT || m->depth == m->deepest;
  CS_TRY(add_step(m, (planefile_step){.kind = PLANEFILE_ENTER}));
  for (int i = 0; i < 3; i++) {
    const cs_paint *corner = &of->corners[i];
    const cs_v4 s = {corner->s[0], corner->s[1], corner->s[2], 0};
    for (int c = 0; c < 3; c++)
      m->is_hard |= fabsf(corner->t[c] - (1 - corner->beta)) > 1e-6f;
    CS_TRY(add_stop(m, i, cell_of(s, corner->beta)));
  }
  CS_TRY(add_varied(m, layer, stop));
  return add_step(m, (planefile_step){.kind = PLANEFILE_LEAVE,
                                      .colour = cell_of(layer->fade * layer->front, layer->fade)});
}

/* What hides all behind it says so by a flat layer there. */
static celspan_status add_picture(program_maker *m, const cs_layer *layer) {
  celspan_context *context = m->source->context;
  size_t stop = m->record->stop_count;
  bool hides = false;
  if (layer->kind == CS_LAYER_PICTURE)
    CS_TRY(cs_record_image_hides(context, &m->source->stack->images[layer->index], &hides));
  CS_TRY(add_stop(m, 0, cell_of(layer->fade * layer->front, layer->fade)));
  CS_TRY(add_varied(m, layer, stop));
  return hides && layer->fade == 1 ? add_flat(m, cs_v4_all(0), 1) : CELSPAN_OK;
}

static celspan_status add_layer(program_maker *m, const cs_layer *layer) {
  if (layer->kind == CS_LAYER_PICTURE || layer->kind == CS_LAYER_DEFOCUSED)
    return add_picture(m, layer);
  if (layer->kind == CS_LAYER_FLAT) {
    m->is_hard |= !is_grey(layer->t) || layer->role == CS_LAYER_FRONT;
    return add_flat(m, layer->s, 1 - layer->t[0]);
  }
  const cs_shade *shade = &m->source->stack->shades[layer->index];
  return shade->texture->kind == CS_TEXTURE_TRIANGLE ? add_triangle(m, layer)
                                                     : add_gradient(m, layer);
}

static celspan_status add_layers(program_maker *m, const cs_program *program) {
  const cs_stack *stack = m->source->stack;
  if (stack->has_root)
    CS_TRY(open_group(m, 0));
  for (uint32_t i = 0; i < program->length && !m->is_hard; i++) {
    CS_TRY(move(m, program->items[i].layer));
    if (!m->is_hard)
      CS_TRY(add_layer(m, &stack->layers[program->items[i].layer]));
  }
  while (!m->is_hard && m->group != CS_STACK_NONE)
    CS_TRY(leave_group(m));
  return m->is_hard ? CELSPAN_OK : end_frame(m);
}

/* ---------------------------------------------------------------- tables */

/* What shows from one stop of a gradient to the next. */
typedef struct table {
  float s[CS_OVER_ROW_BATCH][4], t[CS_OVER_ROW_BATCH][4], rgba[CS_OVER_ROW_BATCH][4];
} table;

static void fill_paints(const cs_stop *from, const cs_stop *to, table *out) {
  for (int i = 0; i <= SAMPLES; i++) {
    const cs_paint p = cs_paint_mix(&from->paint, &to->paint, (float)i / SAMPLES);
    cs_v4_store(out->s[i], (cs_v4){p.s[0], p.s[1], p.s[2], 0});
    cs_v4_store(out->t[i], (cs_v4){p.t[0], p.t[1], p.t[2], 0});
  }
}

static celspan_status fold(const program_maker *m, const cs_program *program, cs_arena *arena,
                           table *out) {
  cs_over_row over;
  CS_TRY(cs_over_row_begin(m->source->context, arena, m->source->stack, cs_isa_best(), SAMPLES + 1,
                           &over));
  for (uint32_t i = 0; i < program->length; i++)
    CS_TRY(cs_over_row_layer(&over, program->items[i].layer, (const float(*)[4])out->s,
                             (const float(*)[4])out->t));
  cs_over_row_end(&over, out->rgba);
  return CELSPAN_OK;
}

/* Whether a line from one sample to another passes all between them. */
static bool is_straight(const table *of, int from, int to) {
  bool is_near = true;
  cs_v4 a = cs_v4_load(of->rgba[from]), b = cs_v4_load(of->rgba[to]);
  for (int i = from + 1; i < to && is_near; i++) {
    cs_v4 line = a + (float)(i - from) / (float)(to - from) * (b - a);
    cs_v4 off = line - cs_v4_load(of->rgba[i]);
    for (int c = 0; c < 4; c++)
      is_near = is_near && fabs((double)off[c]) <= TOLERANCE;
  }
  return is_near;
}

static planefile_cell sample_of(const table *of, int i) {
  return cell_of(cs_v4_load(of->rgba[i]), of->rgba[i][3]);
}

/* Adds the stops after sample `from`, up to sample `to`. */
static celspan_status add_samples(program_maker *m, const table *of, const cs_stop *stops, int from,
                                  int to) {
  if (to - from > 1 && !is_straight(of, from, to)) {
    int middle = (from + to) / 2;
    CS_TRY(add_samples(m, of, stops, from, middle));
    return add_samples(m, of, stops, middle, to);
  }
  double share = (double)to / SAMPLES;
  return add_stop(m, stops[0].at + share * (stops[1].at - stops[0].at), sample_of(of, to));
}

static celspan_status add_table(program_maker *m, const cs_program *program, const cs_layer *layer,
                                cs_arena *arena, table *room) {
  const cs_texture_variation *of = m->source->stack->shades[layer->index].texture->variation;
  size_t stop = m->record->stop_count;
  for (size_t i = 0; i + 1 < of->stop_count; i++) {
    cs_arena_reset(arena);
    fill_paints(&of->stops[i], &of->stops[i + 1], room);
    CS_TRY(fold(m, program, arena, room));
    CS_TRY(add_stop(m, of->stops[i].at, sample_of(room, 0)));
    CS_TRY(add_samples(m, room, &of->stops[i], 0, SAMPLES));
  }
  return add_varied(m, layer, stop);
}

/* The layer of a program that varies, which is its only one, and has stops; NULL: there is none. */
static const cs_layer *only_gradient(const cs_stack *stack, const cs_program *program) {
  const cs_layer *found = NULL;
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer *layer = &stack->layers[program->items[i].layer];
    if (layer->kind == CS_LAYER_FLAT)
      continue;
    if (found || layer->kind != CS_LAYER_SHADED || !stack->shades[layer->index].is_affine ||
        stack->shades[layer->index].texture->kind == CS_TEXTURE_TRIANGLE)
      return NULL;
    found = layer;
  }
  return found;
}

static celspan_status tabulate(program_maker *m, const cs_program *program) {
  celspan_context *context = m->source->context;
  const cs_layer *layer = only_gradient(m->source->stack, program);
  table *room;
  cs_arena arena;
  if (!layer)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "plane: gradients or pictures lie under a mode, a matte, a grade, a light or a "
                   "coloured medium; a plane keeps only one gradient there");
  CS_TRY(CS_MAKE(context, room, 1));
  cs_arena_init(&arena);
  celspan_status status = add_table(m, program, layer, &arena, room);
  cs_arena_finish(&arena, context->memory);
  cs_mem_free(context->memory, room, sizeof *room);
  return status;
}

/* ---------------------------------------------------------------- the program */

static celspan_status check_picture(const cs_record_source *source, const cs_layer *layer) {
  const cs_image_layer *image = &source->stack->images[layer->index];
  const char *reason =
      layer->role != CS_LAYER_PAINT ? "is a light"
      : image->texture->variation->use != CELSPAN_PICTURE_PAINT || image->texture->variation->medium
          ? "has a coloured medium"
      : image->space == CELSPAN_SPACE_SRGB ? "is composited in sRGB"
                                           : NULL;
  return reason ? cs_fail(source->context, CELSPAN_BAD_ARGUMENT,
                          "plane: a picture is visible that %s; a plane keeps pictures that are "
                          "opaque or faded paint, in linear light",
                          reason)
                : CELSPAN_OK;
}

static celspan_status check_kinds(const cs_record_source *source, const cs_program *program) {
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer *layer = &source->stack->layers[program->items[i].layer];
    if (layer->kind == CS_LAYER_PICTURE)
      CS_TRY(check_picture(source, layer));
    if (layer->kind == CS_LAYER_DEFOCUSED && layer->role != CS_LAYER_PAINT)
      return cs_fail(source->context, CELSPAN_BAD_ARGUMENT,
                     "plane: a blurred object is a light; a plane keeps no such light");
  }
  return CELSPAN_OK;
}

static celspan_status make_program(const cs_record_source *source, const cs_program *program,
                                   cs_recording *record) {
  program_maker m = {.source = source,
                     .record = record,
                     .first = (uint32_t)record->step_count,
                     .group = CS_STACK_NONE,
                     .deepest = PLANEFILE_DEPTH - (source->weight != 1),
                     .keep = 1};
  CS_TRY(check_kinds(source, program));
  size_t stops = record->stop_count;
  CS_TRY(add_layers(&m, program));
  if (m.is_hard) {
    record->step_count = m.first;
    record->stop_count = stops;
    CS_TRY(tabulate(&m, program));
  }
  return CELSPAN_OK;
}

/* The program as a group whose channels are multiplied by the weight. */
static celspan_status make_weighted(const cs_record_source *source, const cs_program *program,
                                    cs_recording *record) {
  int32_t factor = channel_of((double)source->weight);
  const planefile_step enter = {.kind = PLANEFILE_ENTER};
  const planefile_step leave = {.kind = PLANEFILE_LEAVE,
                                .colour = {{factor, factor, factor, factor}}};
  CS_TRY(
      CS_APPEND(source->context, record->steps, record->step_count, record->step_capacity, enter));
  CS_TRY(make_program(source, program, record));
  return CS_APPEND(source->context, record->steps, record->step_count, record->step_capacity,
                   leave);
}

celspan_status cs_record_program(const cs_record_source *source, const cs_program *program,
                                 cs_recording *record, planefile_program *out) {
  uint32_t first = (uint32_t)record->step_count;
  CS_TRY(source->weight == 1 ? make_program(source, program, record)
                             : make_weighted(source, program, record));
  *out = (planefile_program){first, (uint32_t)record->step_count - first};
  return CELSPAN_OK;
}
