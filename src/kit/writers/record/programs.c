/* One file, because a program is one walk through a stack of layers: groups, lights and paints each
 * open or end steps that others have begun. */
#include "writers/record/programs.h"

#include <math.h>

#include "inside/frames.h"
#include "inside/number.h"
#include "writers/record/pictures.h"

#define SAMPLES 64              /* samples of a table, from one stop to the next */
#define TOLERANCE (1.0 / 16384) /* the error that a table may have */

/* A group that was entered. */
typedef struct entered_group {
  uint32_t group;        /* the group around it, entered before, or CS_STACK_NONE */
  uint32_t head, length; /* the steps of its head, which form a layer */
} entered_group;

typedef struct program_maker {
  const cs_record_source *source;
  cs_recording *record;
  uint32_t first; /* step of the program */
  uint32_t group; /* the innermost that was entered, or CS_STACK_NONE */
  entered_group outer[PLANEFILE_DEPTH];
  uint32_t count;          /* how many groups have been entered */
  uint32_t depth, deepest; /* depth: of the nested steps now; deepest: the greatest depth */
  bool has_glass[PLANEFILE_DEPTH + 1]; /* layers behind the level shine through in its colours */
  bool has_veil[PLANEFILE_DEPTH + 1];  /* the following layers are multiplied */
  /* glass is already in a layer, so everything behind it would shine through in grey */
  bool lost_glass;
  size_t light; /* the next back light to be met */
  float keep;   /* the share of transparency that the mattes of back lights leave */
  bool is_hard; /* steps cannot express the program */
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
  m->is_hard |= m->lost_glass && (step.kind == PLANEFILE_FLAT || step.kind == PLANEFILE_RAMP);
  return CS_ARRAY_APPEND(m->source->context, record->steps, record->step_count, step);
}

/* Adds a layer of one colour; if the layer in front of it has one colour too, the two are
 * joined. */
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

/* Everything behind the frame is included: mattes make the rest opaque. */
static celspan_status end_frame(program_maker *m) {
  while (m->light < m->source->stack->light_count)
    CS_TRY(meet_light(m));
  float keep = m->keep;
  m->keep = 1;
  return keep < 1 ? add_flat(m, cs_v4_all(0), 1 - keep) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- groups */

static celspan_status add_enter(program_maker *m) {
  m->is_hard |= m->depth == m->deepest;
  if (m->is_hard)
    return CELSPAN_OK;
  m->depth++;
  m->has_glass[m->depth] = m->has_veil[m->depth] = false;
  return add_step(m, (planefile_step){.kind = PLANEFILE_ENTER});
}

static celspan_status add_leave(program_maker *m, uint8_t how, planefile_cell factors) {
  bool has_glass = m->has_glass[m->depth--], is_layer = how <= PLANEFILE_DECODED;
  m->lost_glass |= has_glass && is_layer;
  m->is_hard |= has_glass && !is_layer;
  m->has_glass[m->depth] |= how == PLANEFILE_GLASS;
  m->has_veil[m->depth] |= !is_layer && how != PLANEFILE_GLASS;
  return add_step(m, (planefile_step){.kind = PLANEFILE_LEAVE, .how = how, .colour = factors});
}

static planefile_cell all_of(float factor) { return cell_of(cs_v4_all(factor), factor); }

/* Whether a group is of a kind that steps cannot express. */
static bool is_hard_group(const cs_group *group) {
  bool is_blend = group->blend == CELSPAN_BLEND_MULTIPLY || group->blend == CELSPAN_BLEND_SCREEN;
  bool is_converted = group->converts != CELSPAN_SPACE_AROUND;
  return group->grade || group->converts == CELSPAN_SPACE_SRGB || group->dissolves ||
         (group->kind == CS_GROUP_GROUND && !is_blend) ||
         (is_converted && (group->has_light || group->kind != CS_GROUP_PLAIN));
}

static celspan_status open_group(program_maker *m, uint32_t group) {
  const cs_group *of = &m->source->stack->groups[group];
  m->is_hard |= m->count == PLANEFILE_DEPTH || is_hard_group(of);
  if (m->is_hard)
    return CELSPAN_OK;
  bool is_source =
      of->kind == CS_GROUP_HEAD && m->source->stack->groups[m->group].kind == CS_GROUP_GROUND;
  m->outer[m->count++] = (entered_group){.group = m->group};
  m->group = group;
  CS_TRY(add_enter(m));
  return of->kind == CS_GROUP_GROUND || is_source ? add_enter(m) : CELSPAN_OK;
}

/* The recursion is at most CS_STACK_GROUPS groups deep. */
static celspan_status enter_group(program_maker *m, uint32_t group) {
  const cs_stack *stack = m->source->stack;
  uint32_t parent = cs_stack_around(stack, group, m->group);
  if (parent != m->group)
    CS_TRY(enter_group(m, parent));
  return m->is_hard ? CELSPAN_OK : open_group(m, group);
}

/* The step by which leaving a group changes the group's channels. */
static planefile_step leaving(const cs_group *group) {
  cs_v4 factors = cs_v4_all(1);
  if (group->has_front)
    factors = group->front;
  return (planefile_step){.how = group->converts == CELSPAN_SPACE_LINEAR ? PLANEFILE_DECODED
                                                                         : PLANEFILE_LAYER,
                          .colour = cell_of(group->fade * factors, group->fade)};
}

static bool does_nothing(const planefile_step *leave) {
  bool is_one = leave->how == PLANEFILE_LAYER;
  for (int c = 0; c < 4; c++)
    is_one = is_one && leave->colour.colour[c] == PLANEFILE_WHITE;
  return is_one;
}

/* The step that entered the innermost group. */
static size_t find_enter(const program_maker *m) {
  const cs_recording *record = m->record;
  size_t at = record->step_count, depth = 1;
  while (depth > 0) {
    uint8_t kind = record->steps[--at].kind;
    depth += kind == PLANEFILE_LEAVE;
    depth -= kind == PLANEFILE_ENTER;
  }
  return at;
}

/* Removes the step that entered the innermost group. */
static void forget_enter(program_maker *m) {
  cs_recording *record = m->record;
  size_t at = find_enter(m);
  record->step_count--;
  memmove(&record->steps[at], &record->steps[at + 1],
          (record->step_count - at) * sizeof *record->steps);
  m->depth--;
  m->has_glass[m->depth] |= m->has_glass[m->depth + 1];
}

/* ---------------------------------------------------------------- heads */

/* Adds the head of a group once more, at a step, for some channels. */
static celspan_status add_head(program_maker *m, const entered_group *of, size_t at,
                               cs_v4 channels) {
  cs_recording *record = m->record;
  for (uint32_t i = 0; i < of->length; i++) {
    size_t place = at + i, from = of->head + i + (at <= of->head ? i : 0);
    const planefile_step step = record->steps[from];
    CS_TRY(add_step(m, step));
    memmove(&record->steps[place + 1], &record->steps[place],
            (record->step_count - 1 - place) * sizeof *record->steps);
    record->steps[place] = step;
  }
  for (int c = 0; of->length > 0 && c < 4; c++)
    record->steps[at + of->length - 1].colour.colour[c] *= (int32_t)channels[c];
  return CELSPAN_OK;
}

/* A source, or the source composited over white, multiplies the rest of its ground. A screen also
 * adds its light to everything behind it. */
static celspan_status leave_source(program_maker *m, const cs_group *ground,
                                   const planefile_step *leave) {
  entered_group *of = &m->outer[m->count - 1];
  bool is_screen = ground->blend == CELSPAN_BLEND_SCREEN;
  size_t enter = find_enter(m);
  CS_TRY(add_leave(m, leave->how, leave->colour));
  m->is_hard |= m->lost_glass;
  of->head = (uint32_t)enter;
  of->length = (uint32_t)(m->record->step_count - enter);
  if (!is_screen)
    CS_TRY(add_flat(m, cs_v4_all(1), 1));
  CS_TRY(add_leave(m, is_screen ? PLANEFILE_SCREEN : PLANEFILE_LIT, all_of(1)));
  if (!is_screen)
    return CELSPAN_OK;
  const cs_v4 light = {1, 1, 1, 0};
  CS_TRY(add_head(m, of, enter - 1, light));
  of->head += of->length;
  return CELSPAN_OK;
}

/* A matte is a veil; the rest of its group behind it is one layer. */
static celspan_status leave_strength(program_maker *m, const cs_group *matte,
                                     const planefile_step *leave) {
  uint8_t how = matte->is_luma ? PLANEFILE_LUMA_MATTE : PLANEFILE_MATTE;
  m->outer[m->count - 1].length = 1; /* a matte has one */
  CS_TRY(add_leave(m, (uint8_t)(how + matte->inverts), leave->colour));
  return m->is_hard ? CELSPAN_OK : add_enter(m);
}

static celspan_status leave_head(program_maker *m, const planefile_step *leave) {
  const cs_group *around = &m->source->stack->groups[m->group];
  return around->kind == CS_GROUP_GROUND ? leave_source(m, around, leave)
                                         : leave_strength(m, around, leave);
}

/* A source is visible where the rest of its ground is not. */
static celspan_status leave_ground(program_maker *m, const cs_group *ground,
                                   const entered_group *of, const planefile_step *leave) {
  const cs_v4 all = {1, 1, 1, 1}, alpha = {0, 0, 0, 1};
  CS_TRY(add_leave(m, PLANEFILE_LAYER, all_of(1)));
  CS_TRY(
      add_head(m, of, m->record->step_count, ground->blend == CELSPAN_BLEND_SCREEN ? alpha : all));
  return add_leave(m, leave->how, leave->colour);
}

static celspan_status leave_matte(program_maker *m, const cs_group *group, const entered_group *of,
                                  planefile_step *leave) {
  if (of->length > 0)
    CS_TRY(add_leave(m, PLANEFILE_LAYER, all_of(1)));
  else if (!group->inverts) /* there is no matte, so nothing is visible */
    leave->colour = (planefile_cell){{0}};
  return add_leave(m, leave->how, leave->colour);
}

static celspan_status leave_plain(program_maker *m, const planefile_step *leave) {
  if (!does_nothing(leave) || m->has_veil[m->depth])
    return add_leave(m, leave->how, leave->colour);
  forget_enter(m);
  return CELSPAN_OK;
}

static celspan_status leave_group(program_maker *m) {
  const cs_group *group = &m->source->stack->groups[m->group];
  planefile_step leave = leaving(group);
  if (group->is_frame) {
    m->is_hard |= m->keep != 1 && group->fade != 1;
    CS_TRY(end_frame(m));
  }
  const entered_group of = m->outer[--m->count];
  m->group = of.group;
  switch ((cs_group_kind)group->kind) {
  case CS_GROUP_HEAD:
    return leave_head(m, &leave);
  case CS_GROUP_GROUND:
    m->is_hard |= m->keep != 1;
    return leave_ground(m, group, &of, &leave);
  case CS_GROUP_MATTE:
    return leave_matte(m, group, &of, &leave);
  case CS_GROUP_PLAIN:
    break;
  }
  return leave_plain(m, &leave);
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

/* ---------------------------------------------------------------- gradients */

static celspan_status add_stop(program_maker *m, double at, planefile_cell colour) {
  cs_recording *record = m->record;
  return CS_ARRAY_APPEND(m->source->context, record->stops, record->stop_count,
                         ((planefile_stop){at, colour}));
}

/* Adds a ramp over the stops that were added from `stop` on. */
static celspan_status add_varied(program_maker *m, const cs_layer *layer, size_t stop) {
  uint32_t axis;
  CS_TRY(cs_record_axis(m->source, m->record, layer, &axis));
  return add_step(m, (planefile_step){.kind = PLANEFILE_RAMP,
                                      .axis = axis,
                                      .stop = (uint32_t)stop,
                                      .stop_count = (uint32_t)(m->record->stop_count - stop)});
}

/* A paint in its layer. */
static cs_over_pair lit(const cs_layer *layer, const cs_paint *paint) {
  cs_v4 s = {paint->s[0], paint->s[1], paint->s[2], 0};
  cs_v4 t = {paint->t[0], paint->t[1], paint->t[2], 0};
  if (layer->role != CS_LAYER_PAINT)
    t = cs_v4_all(1);
  return cs_over_lit(layer->front, layer->role == CS_LAYER_FRONT ? 1 : layer->fade, s, t);
}

/* The part of a gradient that is added. */
typedef enum part { WHOLE, LIGHT, THROUGH } part;

static celspan_status add_part(program_maker *m, const cs_layer *layer, part what) {
  const cs_texture_variation *of = m->source->stack->shades[layer->index].texture->variation;
  size_t stop = m->record->stop_count;
  for (size_t i = 0; i < of->stop_count; i++) {
    cs_over_pair pair = lit(layer, &of->stops[i].paint);
    planefile_cell cell = what == WHOLE   ? cell_of(pair.e, 1 - pair.t[0])
                          : what == LIGHT ? cell_of(pair.e, 0)
                                          : cell_of(pair.t, 1);
    CS_TRY(add_stop(m, of->stops[i].at, cell));
  }
  return add_varied(m, layer, stop);
}

/* A layer that dims the channels differently becomes a light in front of glass. */
static celspan_status add_gradient(program_maker *m, const cs_layer *layer) {
  const cs_texture_variation *of = m->source->stack->shades[layer->index].texture->variation;
  bool is_glass = false;
  for (size_t i = 0; i < of->stop_count; i++)
    is_glass |= !is_grey(lit(layer, &of->stops[i].paint).t);
  CS_TRY(add_part(m, layer, is_glass ? LIGHT : WHOLE));
  if (!is_glass)
    return CELSPAN_OK;
  CS_TRY(add_enter(m));
  CS_TRY(add_part(m, layer, THROUGH));
  return m->is_hard ? CELSPAN_OK : add_leave(m, PLANEFILE_GLASS, all_of(1));
}

/* A triangle is limited before it is lit, so it is a group. */
static celspan_status add_triangle(program_maker *m, const cs_layer *layer) {
  const cs_texture_variation *of = m->source->stack->shades[layer->index].texture->variation;
  size_t stop = m->record->stop_count;
  m->is_hard |= layer->role != CS_LAYER_PAINT;
  CS_TRY(add_enter(m));
  for (int i = 0; i < 3; i++) {
    const cs_paint *corner = &of->corners[i];
    const cs_v4 s = {corner->s[0], corner->s[1], corner->s[2], 0};
    for (int c = 0; c < 3; c++)
      m->is_hard |= fabsf(corner->t[c] - (1 - corner->beta)) > 1e-6f;
    CS_TRY(add_stop(m, i, cell_of(s, corner->beta)));
  }
  CS_TRY(add_varied(m, layer, stop));
  return m->is_hard
             ? CELSPAN_OK
             : add_leave(m, PLANEFILE_LAYER, cell_of(layer->fade * layer->front, layer->fade));
}

/* Adds a picture. If it hides everything behind it, a flat layer behind it records this. */
static celspan_status add_picture(program_maker *m, const cs_layer *layer) {
  celspan_context *context = m->source->context;
  size_t stop = m->record->stop_count;
  bool hides = false, is_paint = layer->role == CS_LAYER_PAINT;
  if (layer->kind == CS_LAYER_PICTURE && is_paint)
    CS_TRY(cs_record_image_hides(context, &m->source->stack->images[layer->index], &hides));
  float fade = layer->role == CS_LAYER_FRONT ? 1 : layer->fade;
  CS_TRY(add_stop(m, 0, cell_of(fade * layer->front, is_paint ? fade : 0)));
  CS_TRY(add_varied(m, layer, stop));
  return hides && fade == 1 ? add_flat(m, cs_v4_all(0), 1) : CELSPAN_OK;
}

/* A picture that is a gel. */
static celspan_status add_gel(program_maker *m, const cs_layer *layer) {
  size_t stop = m->record->stop_count;
  CS_TRY(add_enter(m));
  CS_TRY(add_stop(m, 0, all_of(layer->fade)));
  CS_TRY(add_varied(m, layer, stop));
  return m->is_hard ? CELSPAN_OK : add_leave(m, PLANEFILE_GLASS, all_of(1));
}

/* Glass of one colour. */
static celspan_status add_flat_paint(program_maker *m, const cs_layer *layer) {
  if (is_grey(layer->t))
    return add_flat(m, layer->s, 1 - layer->t[0]);
  CS_TRY(add_flat(m, layer->s, 0));
  CS_TRY(add_enter(m));
  CS_TRY(add_flat(m, layer->t, 1));
  return m->is_hard ? CELSPAN_OK : add_leave(m, PLANEFILE_GLASS, all_of(1));
}

static celspan_status add_paint(program_maker *m, const cs_layer *layer) {
  const cs_stack *stack = m->source->stack;
  if (layer->kind == CS_LAYER_FLAT)
    return add_flat_paint(m, layer);
  if (layer->kind == CS_LAYER_PICTURE &&
      stack->images[layer->index].texture->variation->use == CELSPAN_PICTURE_GEL)
    return add_gel(m, layer);
  if (layer->kind == CS_LAYER_PICTURE || layer->kind == CS_LAYER_DEFOCUSED)
    return add_picture(m, layer);
  const cs_shade *shade = &stack->shades[layer->index];
  return shade->texture->kind == CS_TEXTURE_TRIANGLE ? add_triangle(m, layer)
                                                     : add_gradient(m, layer);
}

/* The front light of a group multiplies everything in the group. */
static celspan_status add_layer(program_maker *m, const cs_layer *layer) {
  if (layer->role != CS_LAYER_FRONT)
    return add_paint(m, layer);
  m->is_hard |= layer->kind == CS_LAYER_FLAT;
  CS_TRY(add_enter(m));
  if (!m->is_hard)
    CS_TRY(add_paint(m, layer));
  return m->is_hard ? CELSPAN_OK : add_leave(m, PLANEFILE_LIT, all_of(1));
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

/* The colours from one stop of a gradient to the next. */
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

/* Whether all samples between two samples lie on the line between these two. */
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

/* The only layer of a program that varies, if it is a gradient with stops; otherwise NULL. */
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
                   "plane: gradients or pictures lie under a grade, a mode other than multiply and "
                   "screen, or faded glass; a plane keeps only one gradient there");
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
  const char *reason = image->texture->variation->medium    ? "has a medium of its own"
                       : image->space == CELSPAN_SPACE_SRGB ? "is composited in sRGB"
                                                            : NULL;
  return reason
             ? cs_fail(source->context, CELSPAN_BAD_ARGUMENT,
                       "plane: a picture is visible that %s; a plane keeps no such picture", reason)
             : CELSPAN_OK;
}

static celspan_status check_kinds(const cs_record_source *source, const cs_program *program) {
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer *layer = &source->stack->layers[program->items[i].layer];
    if (layer->kind == CS_LAYER_PICTURE)
      CS_TRY(check_picture(source, layer));
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
  CS_TRY(CS_ARRAY_APPEND(source->context, record->steps, record->step_count, enter));
  CS_TRY(make_program(source, program, record));
  return CS_ARRAY_APPEND(source->context, record->steps, record->step_count, leave);
}

celspan_status cs_record_program(const cs_record_source *source, const cs_program *program,
                                 cs_recording *record, planefile_program *out) {
  uint32_t first = (uint32_t)record->step_count;
  CS_TRY(source->weight == 1 ? make_program(source, program, record)
                             : make_weighted(source, program, record));
  *out = (planefile_program){first, (uint32_t)record->step_count - first};
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- what they are */

static void hash_colour(cs_hash *hash, const planefile_cell *colour) {
  for (int c = 0; c < 4; c++)
    cs_hash_word(hash, (uint64_t)colour->colour[c]);
}

cs_hash cs_record_program_hash(const cs_recording *record, const planefile_program *program) {
  cs_hash hash = cs_hash_begin(0x70726f67u);
  for (uint32_t i = program->step; i < program->step + program->step_count; i++) {
    const planefile_step *step = &record->steps[i];
    bool is_ramp = step->kind == PLANEFILE_RAMP;
    cs_hash_word(&hash, step->kind | (uint64_t)step->how << 8 | (uint64_t)step->stop_count << 32);
    cs_hash_word(&hash, is_ramp ? step->axis : 0);
    hash_colour(&hash, &step->colour);
    for (uint32_t k = step->stop; is_ramp && k < step->stop + step->stop_count; k++) {
      cs_hash_number(&hash, record->stops[k].at);
      hash_colour(&hash, &record->stops[k].colour);
    }
  }
  return cs_hash_end(hash);
}
