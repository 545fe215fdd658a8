/* One file, because a group, a mode, a matte, a boolean and a composition each hold objects of all
 * kinds: the functions that add them call each other. */
#include "frames/render/objects.h"

#include <math.h>

#include "frames/render/layers.h"
#include "frames/render/lights.h"
#include "frames/render/patterns.h"
#include "frames/render/unseen.h"
#include "model/geometry/matrix.h"
#include "model/scene/shift.h"

#define SMALLEST 1e-9 /* pixels of a unit, at which a frame is not changed */
#define PARTS 16      /* a union of more operands is compiled as a union of this many unions */

/* Moves to the nearest multiples of the units; objects in perspective keep their place. */
static void snap(const cs_compiler *c, celspan_matrix *matrix) {
  double *m = matrix->m;
  if (c->unit.x == 0 || m[6] != 0 || m[7] != 0 || m[8] != 1)
    return;
  m[2] = floor(m[2] / c->unit.x + 0.5) * c->unit.x;
  m[5] = floor(m[5] / c->unit.y + 0.5) * c->unit.y;
}

static celspan_status add_object(cs_compiler *c, const celspan_object *object,
                                 const celspan_matrix *parent);

/* ---------------------------------------------------------------- groups */

static cs_objects_outside outside_of(const cs_compiler *c) {
  return (cs_objects_outside){c->group, c->fades_out, c->isolation, CS_STACK_NONE};
}

/* Whether the result of a group is not an affine function of its contents. The strength of a matte
 * of alpha is affine, since alpha is, and lies between 0 and 1 without clamping. */
static bool curves_by_itself(const cs_group *group, const cs_group *around) {
  if (group->kind == CS_GROUP_HEAD)
    return around->kind != CS_GROUP_MATTE || around->is_luma;
  return group->grade || group->converts != CELSPAN_SPACE_AROUND || group->dissolves;
}

/* Begins a group inside the group of the compiler; the fields that are still missing are set
 * here. */
static celspan_status enter(cs_compiler *c, cs_group group) {
  cs_stack *stack = &c->plan->stack;
  CS_TRY(CS_COMPILER_APPEND(c, groups, group_count));
  const cs_group *around = c->group == CS_STACK_NONE ? NULL : &stack->groups[c->group];
  group.parent = c->group;
  group.first = (uint32_t)stack->layer_count;
  group.varies |= around && around->varies;
  group.curves = curves_by_itself(&group, around) || (around && around->curves);
  group.is_source = group.kind == CS_GROUP_HEAD || (around && around->is_source);
  stack->has_curves |= group.curves;
  stack->has_sources |= group.is_source;
  c->group = (uint32_t)stack->group_count;
  stack->groups[stack->group_count++] = group;
  return CELSPAN_OK;
}

/* A group that is graded in a space, and then converted to the space of the compiler. */
static cs_group developed(const cs_compiler *c, celspan_space space, const celspan_grade *grade) {
  celspan_space to = space == c->space ? CELSPAN_SPACE_AROUND : c->space;
  return (cs_group){
      .fade = 1, .grade = cs_grade_steps(grade), .space = (uint8_t)space, .converts = (uint8_t)to};
}

/* Begins a group that is lit as a whole. */
static celspan_status enter_whole(cs_compiler *c, celspan_space space, const celspan_grade *grade) {
  cs_group group = developed(c, space, grade);
  group.has_front = true;
  group.front = c->front;
  return c->fades_out ? CELSPAN_OK : enter(c, group);
}

celspan_status cs_objects_begin_frame(cs_compiler *c, celspan_space space,
                                      const celspan_grade *grade) {
  cs_group group = developed(c, space, grade);
  group.is_frame = true;
  if (space == c->space && !grade)
    return CELSPAN_OK;
  CS_TRY(enter(c, group));
  c->plan->stack.has_root = true;
  c->space = space;
  return CELSPAN_OK;
}

celspan_status cs_objects_begin_group(cs_compiler *c, double fade, bool is_lit,
                                      cs_objects_outside *outer) {
  *outer = outside_of(c);
  c->fades_out |= fade == 0;
  if ((fade == 1 && !is_lit) || c->fades_out)
    return CELSPAN_OK;
  CS_TRY(enter(c, (cs_group){.fade = (float)fade, .varies = is_lit}));
  outer->begun = c->group;
  return CELSPAN_OK;
}

celspan_status cs_objects_begin_grade(cs_compiler *c, const celspan_grade *grade,
                                      cs_objects_outside *outer) {
  *outer = outside_of(c);
  if (!grade || c->fades_out)
    return CELSPAN_OK;
  CS_TRY(enter(c, developed(c, c->space, grade)));
  outer->begun = c->group;
  return CELSPAN_OK;
}

/* Sources inside may have begun another ground since. */
void cs_objects_end_group(cs_compiler *c, cs_objects_outside outer) {
  bool was_ground = outer.group == outer.isolation.ground;
  c->fades_out = outer.fades_out;
  if (outer.begun != CS_STACK_NONE)
    c->group = was_ground ? c->isolation.ground : outer.group;
}

/* ---------------------------------------------------------------- sources and their grounds */

/* like: the ground inside it, or one with the values that all grounds of an isolating group
 * share. */
static celspan_status begin_ground(cs_compiler *c, const cs_group *like) {
  cs_stack *stack = &c->plan->stack;
  const cs_group common = *like;
  c->group = common.around;
  CS_TRY(enter(c, common));
  cs_group *ground = &stack->groups[c->group];
  bool is_innermost = common.innermost == CS_STACK_NONE;
  ground->first = is_innermost ? ground->first : common.first;
  ground->innermost = is_innermost ? c->group : common.innermost;
  c->isolation.ground = c->group;
  return CELSPAN_OK;
}

celspan_status cs_objects_begin_isolation(cs_compiler *c, bool blends, bool is_frame,
                                          cs_objects_outside *outer) {
  *outer = outside_of(c);
  c->isolation = (cs_compiler_isolation){.ground = CS_STACK_NONE};
  if (!blends || c->fades_out)
    return CELSPAN_OK;
  const cs_group common = {.kind = CS_GROUP_GROUND,
                           .fade = 1,
                           .is_frame = is_frame,
                           .around = c->group,
                           .innermost = CS_STACK_NONE};
  return begin_ground(c, &common);
}

void cs_objects_end_isolation(cs_compiler *c, cs_objects_outside outer) {
  c->group = outer.group;
  c->isolation = outer.isolation;
}

/* ---------------------------------------------------------------- lights with a shape */

/* The group of a part that the light falls on; no group inside something faded to nothing. */
static celspan_status open_light(cs_compiler *c) {
  bool falls = c->isolation.light && !c->fades_out;
  return falls ? enter(c, (cs_group){.fade = 1, .varies = true}) : CELSPAN_OK;
}

static celspan_status close_light(cs_compiler *c) {
  if (!c->isolation.light || c->fades_out)
    return CELSPAN_OK;
  CS_TRY(cs_lights_light_group(c, c->isolation.light, c->isolation.film));
  c->group = c->plan->stack.groups[c->group].parent;
  return CELSPAN_OK;
}

celspan_status cs_objects_begin_light(cs_compiler *c, const struct cs_lights_front *light,
                                      const cs_compiler_film *film) {
  c->isolation.light = c->fades_out ? NULL : light;
  c->isolation.film = film;
  return open_light(c);
}

celspan_status cs_objects_end_light(cs_compiler *c) {
  CS_TRY(close_light(c));
  c->isolation.light = NULL;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- sources */

/* The mattes of back lights that are behind a source belong to its ground. */
static void take_mattes(cs_compiler *c) {
  cs_stack *stack = &c->plan->stack;
  cs_compiler_isolation *film = &c->isolation;
  if (film->mattes_end == 0)
    return;
  for (uint32_t layer = film->mattes; layer < film->mattes_end; layer++)
    stack->layers[layer].group = film->ground;
  stack->groups[film->ground].first = film->mattes;
  film->mattes_end = film->mattes < film->mattes_end ? film->mattes : film->mattes_end;
}

celspan_status cs_objects_begin_source(cs_compiler *c, double fade, bool blends,
                                       cs_objects_outside *outer) {
  const cs_compiler_isolation around = c->isolation;
  cs_objects_outside unused;
  if (!c->fades_out && fade != 0)
    take_mattes(c);
  *outer = outside_of(c);
  c->fades_out |= fade == 0;
  if (c->fades_out)
    return CELSPAN_OK;
  CS_TRY(close_light(c));
  c->group = around.ground;
  CS_TRY(enter(c, (cs_group){.kind = CS_GROUP_HEAD, .fade = (float)fade}));
  outer->begun = c->group;
  CS_TRY(cs_objects_begin_isolation(c, blends, false, &unused));
  return around.light ? cs_objects_begin_light(c, around.light, around.film) : CELSPAN_OK;
}

celspan_status cs_objects_end_source(cs_compiler *c, celspan_blend mode, cs_objects_outside outer) {
  cs_stack *stack = &c->plan->stack;
  const cs_compiler_isolation *around = &outer.isolation;
  if (outer.begun != CS_STACK_NONE)
    CS_TRY(cs_objects_end_light(c));
  c->fades_out = outer.fades_out;
  c->isolation = outer.isolation;
  if (outer.begun == CS_STACK_NONE)
    return CELSPAN_OK;
  stack->source_count++;
  CS_TRY(begin_ground(c, &stack->groups[around->ground]));
  stack->groups[around->ground].blend = (uint8_t)mode;
  stack->groups[around->ground].parent = c->group;
  return open_light(c);
}

/* ---------------------------------------------------------------- mattes */

/* light: of the cel, if it falls on each part; otherwise NULL. */
static celspan_status add_isolated(cs_compiler *c, const celspan_object *object,
                                   const celspan_matrix *matrix,
                                   const cs_compiler_isolation *light) {
  cs_objects_outside outer;
  CS_TRY(cs_objects_begin_isolation(c, cs_object_blends(object, c->space), false, &outer));
  if (light)
    CS_TRY(cs_objects_begin_light(c, light->light, light->film));
  CS_TRY(add_object(c, object, matrix));
  CS_TRY(cs_objects_end_light(c));
  cs_objects_end_isolation(c, outer);
  return CELSPAN_OK;
}

/* The head of a matte: under white light, whatever lights the art. */
static celspan_status add_head(cs_compiler *c, const celspan_object *by,
                               const celspan_matrix *matrix) {
  const cs_v4 front = c->front;
  const uint32_t group = c->group;
  c->front = (cs_v4){1, 1, 1, 0};
  CS_TRY(enter(c, (cs_group){.kind = CS_GROUP_HEAD, .fade = 1}));
  CS_TRY(add_isolated(c, by, matrix, NULL));
  c->front = front;
  c->group = group;
  return CELSPAN_OK;
}

/* An operand of an operator. */
static celspan_status add_operand(cs_compiler *c, const cs_boolean *boolean, size_t i,
                                  const celspan_matrix *matrix) {
  const celspan_object *operand = boolean->operands[i];
  if (boolean->op != CS_OPERATOR_MATTE)
    return add_object(c, operand, matrix);
  const cs_compiler_isolation around = c->isolation;
  return i == 0 || c->fades_out ? add_isolated(c, operand, matrix, &around)
                                : add_head(c, operand, matrix);
}

/* ---------------------------------------------------------------- trees */

static celspan_status append_step(cs_compiler *c, cs_step step) {
  cs_stack *stack = &c->plan->stack;
  CS_TRY(CS_COMPILER_APPEND(c, steps, step_count));
  stack->steps[stack->step_count++] = step;
  return CELSPAN_OK;
}

static bool is_layer(const celspan_object *object) {
  cs_primitive_data_kind kind = object->data->kind;
  return kind == CS_PRIMITIVE_DATA_OUTLINE || kind == CS_PRIMITIVE_DATA_SCANLINE;
}

static bool operands_are_layers(const cs_primitive_data *data) {
  for (size_t i = 0; i < data->boolean->operand_count; i++)
    if (!is_layer(data->boolean->operands[i]))
      return false;
  return true;
}

static uint32_t next_layer(const cs_compiler *c) { return (uint32_t)c->plan->stack.layer_count; }

/* Whether an operator is absent wherever its operand i is absent. If this is true for several
 * operands, only the last of them counts. */
static bool is_needed(const cs_boolean *boolean, size_t i) {
  switch (boolean->op) {
  case CELSPAN_OPERATOR_UNION:
  case CELSPAN_OPERATOR_XOR:
    return false;
  case CELSPAN_OPERATOR_INTERSECTION:
  case CELSPAN_OPERATOR_CLIP:
    return i + 1 == boolean->operand_count; /* the shape of a clip */
  case CELSPAN_OPERATOR_DIFFERENCE:
    break;
  }
  return i == 0; /* the same for a matte */
}

static celspan_status add_one_operand(cs_compiler *c, const cs_boolean *boolean, size_t i,
                                      const celspan_matrix *matrix) {
  uint32_t layer = next_layer(c);
  CS_TRY(add_operand(c, boolean, i, matrix));
  return c->records && is_layer(boolean->operands[i])
             ? append_step(c, (cs_step){.kind = CS_STEP_LAYER, .first = layer, .end = layer + 1})
             : CELSPAN_OK;
}

/* Some operands of an operator, and the layers of which the operator needs at least one. */
typedef struct operands {
  size_t begin, end;
  cs_step guard;
} operands;

static celspan_status add_operands(cs_compiler *c, const cs_boolean *boolean,
                                   const celspan_matrix *matrix, operands *o) {
  bool has_needed = false;
  o->guard = (cs_step){.kind = CS_STEP_GUARD, .first = next_layer(c)};
  for (size_t i = o->begin; i < o->end; i++) {
    uint32_t layer = next_layer(c);
    CS_TRY(add_one_operand(c, boolean, i, matrix));
    has_needed |= is_needed(boolean, i);
    if (is_needed(boolean, i))
      o->guard = (cs_step){.kind = CS_STEP_GUARD, .first = layer, .end = next_layer(c)};
  }
  if (!has_needed)
    o->guard.end = next_layer(c);
  return CELSPAN_OK;
}

static celspan_status add_guarded(cs_compiler *c, const cs_boolean *boolean,
                                  const celspan_matrix *matrix, operands *o);

/* A union of many operands as a union of unions. A part without a present operand is skipped as a
 * whole. Recursion ends: each part has a sixteenth of the operands. *count: the number of parts. */
static celspan_status add_unions(cs_compiler *c, const cs_boolean *boolean,
                                 const celspan_matrix *matrix, operands *o, size_t *count) {
  size_t all = o->end - o->begin, each = (all + PARTS - 1) / PARTS;
  o->guard = (cs_step){.kind = CS_STEP_GUARD, .first = next_layer(c)};
  for (*count = 0; *count * each < all; ++*count) {
    size_t begin = o->begin + *count * each;
    operands part = {.begin = begin, .end = o->end - begin < each ? o->end : begin + each};
    CS_TRY(add_guarded(c, boolean, matrix, &part));
  }
  o->guard.end = next_layer(c);
  return CELSPAN_OK;
}

/* An operator of which some operands have operands themselves: a guard, the steps of the operands,
 * and the step of the operator. */
static celspan_status add_guarded(cs_compiler *c, const cs_boolean *boolean,
                                  const celspan_matrix *matrix, operands *o) {
  cs_stack *stack = &c->plan->stack;
  uint32_t first = next_layer(c), place = (uint32_t)stack->step_count;
  size_t count = o->end - o->begin;
  CS_TRY(append_step(c, (cs_step){.kind = CS_STEP_GUARD}));
  CS_TRY(boolean->op == CELSPAN_OPERATOR_UNION && count > PARTS
             ? add_unions(c, boolean, matrix, o, &count)
             : add_operands(c, boolean, matrix, o));
  o->guard.operands = (uint32_t)stack->step_count - place;
  stack->steps[place] = o->guard;
  return append_step(c, (cs_step){.kind = CS_STEP_OPERATOR,
                                  .op = boolean->op,
                                  .first = first,
                                  .end = next_layer(c),
                                  .operands = (uint32_t)count});
}

/* An operator: the layers of its operands, and the step that combines them. An operator whose
 * operands are single layers needs neither steps for them nor a guard. */
static celspan_status add_operator(cs_compiler *c, const cs_primitive_data *data,
                                   const celspan_matrix *matrix) {
  operands all = {.end = data->boolean->operand_count};
  bool records = c->records;
  uint32_t first = next_layer(c);
  if (records && !operands_are_layers(data))
    return add_guarded(c, data->boolean, matrix, &all);
  c->records = false;
  CS_TRY(add_operands(c, data->boolean, matrix, &all));
  c->records = records;
  return records ? append_step(c, (cs_step){.kind = CS_STEP_LAYERS,
                                            .op = data->boolean->op,
                                            .first = first,
                                            .end = next_layer(c),
                                            .operands = (uint32_t)all.end})
                 : CELSPAN_OK;
}

/* Unions of unions need no steps: every layer that is present is painted. Neither do mattes. A
 * rostrum has a tree of its own. */
static bool is_plain_union(const cs_primitive_data *data) {
  if (data->kind != CS_PRIMITIVE_DATA_BOOLEAN)
    return true;
  if (data->boolean->op != CELSPAN_OPERATOR_UNION && data->boolean->op != CS_OPERATOR_MATTE)
    return false;
  for (size_t i = 0; i < data->boolean->operand_count; i++)
    if (!is_plain_union(data->boolean->operands[i]->data))
      return false;
  return true;
}

/* The greatest number of results that the steps of a tree keep at a time. */
static size_t measure_depth(const cs_stack *stack, const cs_tree *tree) {
  size_t depth = 0, most = 0;
  for (uint32_t i = 0; i < tree->step_count; i++) {
    const cs_step *step = &stack->steps[tree->step + i];
    if (step->kind == CS_STEP_OPERATOR || step->kind == CS_STEP_FRAME)
      depth -= step->operands;
    depth += step->kind != CS_STEP_GUARD;
    most = depth > most ? depth : most;
  }
  return most;
}

/* A tree begins with the next layer. */
static cs_tree begin_tree(const cs_compiler *c) {
  const cs_stack *stack = &c->plan->stack;
  return (cs_tree){.first = (uint32_t)stack->layer_count, .step = (uint32_t)stack->step_count};
}

static celspan_status end_tree(cs_compiler *c, cs_tree tree) {
  cs_stack *stack = &c->plan->stack;
  tree.end = (uint32_t)stack->layer_count;
  tree.step_count = (uint32_t)stack->step_count - tree.step;
  CS_TRY(CS_COMPILER_APPEND(c, trees, tree_count));
  stack->trees[stack->tree_count++] = tree;
  size_t depth = measure_depth(stack, &tree) + 1;
  stack->step_depth = depth > stack->step_depth ? depth : stack->step_depth;
  return CELSPAN_OK;
}

/* A boolean object. If it is not an operand of another one, it is the root of a tree, unless it
 * needs no steps. Inside a rostrum it belongs to the rostrum's tree. */
static celspan_status add_boolean(cs_compiler *c, const cs_primitive_data *data,
                                  const celspan_matrix *matrix) {
  if (c->records || is_plain_union(data))
    return add_operator(c, data, matrix);
  cs_tree tree = begin_tree(c);
  c->records = true;
  CS_TRY(add_operator(c, data, matrix));
  c->records = false;
  c->results++;
  return c->is_nested ? CELSPAN_OK : end_tree(c, tree);
}

/* ---------------------------------------------------------------- a rostrum inside another */

/* Where its frame is. What is read from pixels may end at the frame, within a pixel, which has only
 * that share of it already: then the frame is larger by a pixel. As an operand it has its own size,
 * since there the frame is what is united, cut and cut away. */
static celspan_box frame_of(const cs_primitive_data *data, const celspan_matrix *matrix,
                            bool is_operand) {
  const double *m = matrix->m;
  const celspan_box *box = &data->bounds;
  const cs_shift *shift = data->rostrum->cel_count == 1 ? data->rostrum->cels[0]->shift : NULL;
  const double across = sqrt(m[0] * m[0] + m[3] * m[3]), down = sqrt(m[1] * m[1] + m[4] * m[4]);
  if (is_operand || !shift || shift->is_cut || !cs_matrix_keeps_weights(matrix) ||
      fmin(across, down) < SMALLEST)
    return *box;
  return (celspan_box){box->x - 1 / across, box->y - 1 / down, box->width + 2 / across,
                       box->height + 2 / down};
}

/* The layer of its frame: clear, except for the part that the mattes of its flat back lights hold
 * back. */
static celspan_status add_frame(cs_compiler *c, const cs_primitive_data *data,
                                const celspan_box *frame, const celspan_matrix *matrix) {
  uint32_t index;
  bool has_layers = cs_rostrum_blends(data->rostrum, c->space); /* layers of mattes, one for each */
  float keep = c->fades_out || has_layers ? 1 : cs_lights_keep(data->rostrum);
  CS_TRY(cs_layers_append(c, 1, CELSPAN_RULE_NONZERO, &index));
  cs_layer *layer = &c->plan->stack.layers[index];
  cs_layers_fill_flat(layer, CS_PAINT_CLEAR, 1);
  layer->t = (cs_v4){keep, keep, keep, 0};
  cs_outline_box room;
  return cs_layers_add_outline(c, cs_outline_of_box(frame, &room), frame, matrix, index);
}

/* Adds the layers of a rostrum, and the step that cuts them at the frame and leaves one result. */
static celspan_status add_framed(cs_compiler *inner, const cs_primitive_data *data,
                                 const celspan_box *frame, const celspan_matrix *matrix) {
  const cs_stack *stack = &inner->plan->stack;
  const celspan_rostrum *rostrum = data->rostrum;
  cs_outline_box room;
  const cs_compiler_film film = {rostrum->width, rostrum->height, *matrix, inner->front,
                                 cs_primitive_data_outline(data, &room)};
  uint32_t first = next_layer(inner), guard = (uint32_t)stack->step_count;
  CS_TRY(append_step(inner, (cs_step){.kind = CS_STEP_GUARD, .first = first, .end = first + 1}));
  CS_TRY(add_frame(inner, data, frame, matrix));
  CS_TRY(inner->compile_nested(inner, rostrum, &film));
  stack->steps[guard].operands = (uint32_t)stack->step_count - guard;
  return append_step(inner, (cs_step){.kind = CS_STEP_FRAME,
                                      .first = first,
                                      .end = next_layer(inner),
                                      .operands = inner->results});
}

/* Changes are made in a copy of the compiler, which has the same plan. Light multiplies level by
 * level, except where modes or grades are inside, or codes instead of light: then it falls on their
 * result. */
static celspan_status add_rostrum(cs_compiler *c, const cs_primitive_data *data,
                                  const celspan_matrix *matrix) {
  celspan_space space = cs_space_inside(data->rostrum->space, c->space);
  const celspan_grade *grade = data->rostrum->grade;
  bool is_lit_whole = grade || space != c->space || cs_rostrum_has_modes(data->rostrum);
  cs_objects_outside outer = outside_of(c);
  if (is_lit_whole)
    CS_TRY(enter_whole(c, space, grade));
  cs_compiler inner = *c;
  c->group = outer.group;
  inner.space = space;
  inner.front = is_lit_whole ? (cs_v4){1, 1, 1, 0} : c->front;
  cs_tree tree = begin_tree(c);
  inner.records = false;
  inner.is_nested = true;
  inner.results = 0;
  const celspan_box frame = frame_of(data, matrix, c->records);
  CS_TRY(add_framed(&inner, data, &frame, matrix));
  c->results += !c->records;
  return c->records || c->is_nested ? CELSPAN_OK : end_tree(c, tree);
}

/* ---------------------------------------------------------------- groups of their own kinds */

static bool develops(const cs_primitive_data *data, celspan_space around) {
  return data->kind == CS_PRIMITIVE_DATA_BOOLEAN && cs_boolean_develops(data->boolean, around);
}

/* Whether a mode inside the data acts on the backdrop in the group that the data begin. */
static bool blends_around(const cs_primitive_data *data, celspan_space space) {
  return data->blends[space] && !develops(data, space);
}

/* The operands of a boolean; with a grade, or in a space of its own, they are a group, which is lit
 * as a whole. */
static celspan_status add_inside(cs_compiler *c, const cs_primitive_data *data,
                                 const celspan_matrix *matrix) {
  if (!develops(data, c->space))
    return add_boolean(c, data, matrix);
  const cs_v4 front = c->front;
  const celspan_space around = c->space;
  const uint32_t group = c->group;
  cs_objects_outside outer;
  CS_TRY(enter_whole(c, cs_boolean_space(data->boolean, around), data->boolean->grade));
  c->space = cs_boolean_space(data->boolean, around);
  c->front = (cs_v4){1, 1, 1, 0};
  CS_TRY(cs_objects_begin_isolation(c, data->blends[around], false, &outer));
  CS_TRY(add_boolean(c, data, matrix));
  cs_objects_end_isolation(c, outer);
  c->front = front;
  c->space = around;
  c->group = group;
  return CELSPAN_OK;
}

/* An object with a mode. */
static celspan_status add_source(cs_compiler *c, const celspan_object *object,
                                 const celspan_matrix *matrix) {
  const cs_primitive_data *data = object->data;
  cs_objects_outside outer;
  CS_TRY(cs_objects_begin_source(c, object->fade, blends_around(data, c->space), &outer));
  CS_TRY(add_inside(c, data, matrix));
  return cs_objects_end_source(c, data->boolean->blend, outer);
}

static celspan_status add_matte(cs_compiler *c, const celspan_object *object,
                                const celspan_matrix *matrix) {
  const cs_boolean *boolean = object->data->boolean;
  CS_TRY(close_light(c));
  const cs_objects_outside outer = outside_of(c);
  c->fades_out |= object->fade == 0;
  if (!c->fades_out)
    CS_TRY(enter(c, (cs_group){.kind = CS_GROUP_MATTE,
                               .fade = (float)object->fade,
                               .is_luma = boolean->is_luma,
                               .inverts = boolean->inverts,
                               .dissolves = boolean->dissolves}));
  CS_TRY(add_boolean(c, object->data, matrix));
  c->group = outer.group;
  c->fades_out = outer.fades_out;
  return open_light(c);
}

/* A union that isolates, or any other object with parts. */
static celspan_status add_parts(cs_compiler *c, const celspan_object *object,
                                const celspan_matrix *matrix) {
  const cs_primitive_data *data = object->data;
  const cs_compiler_isolation light = c->isolation;
  cs_objects_outside outer, around;
  bool isolates =
      object->fade < 1 || (data->kind == CS_PRIMITIVE_DATA_BOOLEAN && data->boolean->isolates);
  bool splits = isolates && light.light && data->has_modes;
  if (splits)
    CS_TRY(close_light(c));
  CS_TRY(cs_objects_begin_group(c, object->fade, false, &outer));
  if (isolates)
    CS_TRY(cs_objects_begin_isolation(c, blends_around(data, c->space), false, &around));
  if (splits)
    CS_TRY(cs_objects_begin_light(c, light.light, light.film));
  CS_TRY(data->kind == CS_PRIMITIVE_DATA_ROSTRUM ? add_rostrum(c, data, matrix)
                                                 : add_inside(c, data, matrix));
  if (splits)
    CS_TRY(cs_objects_end_light(c));
  if (isolates)
    cs_objects_end_isolation(c, around);
  cs_objects_end_group(c, outer);
  return splits ? open_light(c) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- patterns */

/* Adds the visible boxes of a pattern in place of its plane. */
static celspan_status add_pattern(cs_compiler *c, const celspan_object *plane,
                                  const celspan_matrix *matrix) {
  celspan_object *seen;
  CS_TRY(cs_patterns_expand(c, plane->data, matrix, &seen));
  celspan_status status = add_parts(c, seen, matrix);
  celspan_object_unref(seen);
  return status;
}

/* ---------------------------------------------------------------- lists of objects */

static celspan_status add_object(cs_compiler *c, const celspan_object *object,
                                 const celspan_matrix *parent) {
  const cs_primitive_data *data = object->data;
  celspan_matrix matrix = celspan_matrix_then(*object->matrix, *parent);
  snap(c, &matrix);
  if (is_layer(object))
    return cs_layers_add(c, data, object->fade, &matrix);
  if (cs_object_mode(object) != CELSPAN_BLEND_NORMAL)
    return add_source(c, object, &matrix);
  if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN && data->boolean->op == CS_OPERATOR_MATTE)
    return add_matte(c, object, &matrix);
  if (data->repeat)
    return add_pattern(c, object, &matrix);
  return add_parts(c, object, &matrix);
}

/* Adds the objects that are not hidden behind others. */
static celspan_status add_visible(cs_compiler *c, celspan_object *const *objects,
                                  const cs_unseen *list, const celspan_matrix *matrix) {
  for (size_t i = 0; i < list->count; i++)
    if (!cs_unseen_has(list, i))
      CS_TRY(add_object(c, objects[i], matrix));
  return CELSPAN_OK;
}

celspan_status cs_objects_add(cs_compiler *c, celspan_object *const *objects, size_t count,
                              const celspan_matrix *matrix) {
  cs_unseen list;
  CS_TRY(cs_unseen_find(c, objects, count, matrix, &list));
  celspan_status status = add_visible(c, objects, &list, matrix);
  cs_unseen_finish(&list, c->context->memory);
  return status;
}
