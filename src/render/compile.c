#include "render/compile.h"

#include "base/number.h"
#include "defocus/layer.h"
#include "paint/shade.h"
#include "scene/texture.h"

#include <math.h>

typedef struct compiler {
  celspan_context *context;
  cs_plan *plan;
  int workers; /* threads at most */
  cs_boundary_frame frame;
  double first_height, end_height; /* of the rows that will be asked for, with their margin */
  size_t cel;                      /* from 1: for messages */
  cs_v4 front;
  uint32_t group; /* the faded group being filled */
  bool records;   /* inside a boolean tree: steps are recorded */
  bool fades_out; /* inside something faded to nothing: present, but clear */
} compiler;

#define APPEND(compiler, array, count, capacity)                                                   \
  cs_mem_reserve((compiler)->context, (void **)&(compiler)->plan->stack.array,                     \
                 &(compiler)->plan->stack.capacity, (compiler)->plan->stack.count + 1,             \
                 sizeof *(compiler)->plan->stack.array)

/* ---------------------------------------------------------------- layers */

static void fill_flat(cs_layer *layer, cs_paint paint, float fade) {
  cs_paint faded = cs_paint_fade(paint, fade);
  layer->kind = CS_LAYER_FLAT;
  cs_v4 s = {faded.s[0], faded.s[1], faded.s[2], 0}, t = {faded.t[0], faded.t[1], faded.t[2], 0};
  layer->s = cs_over_lit(layer->front, 1, s, t).e;
  layer->t = t;
  layer->is_opaque = cs_paint_is_opaque(&faded);
}

static celspan_status fill_shaded(compiler *c, cs_layer *layer, const celspan_texture *texture,
                                  const celspan_matrix *inverse) {
  cs_stack *stack = &c->plan->stack;
  CS_TRY(APPEND(c, shades, shade_count, shade_capacity));
  cs_shade *shade = &stack->shades[stack->shade_count];
  *shade = (cs_shade){.texture = texture, .inverse = *inverse};
  cs_shade_prepare(shade);
  layer->kind = CS_LAYER_SHADED;
  layer->index = (uint32_t)stack->shade_count++;
  layer->is_opaque =
      layer->fade == 1 && cs_matrix_is_affine(inverse) && cs_texture_is_opaque(texture);
  return CELSPAN_OK;
}

/* A picture that fills its primitive's rectangle is clamped at its edges, because the boundary
 * decides where it ends, not the picture. */
static celspan_status fill_picture(compiler *c, cs_layer *layer, const celspan_texture *texture,
                                   const celspan_box *bounds, const celspan_matrix *inverse) {
  cs_stack *stack = &c->plan->stack;
  const celspan_box *box = texture->has_box ? &texture->box : bounds;
  if (box->width <= 0 || box->height <= 0) {
    fill_flat(layer, CS_PAINT_CLEAR, 1);
    return CELSPAN_OK;
  }
  CS_TRY(APPEND(c, images, image_count, image_capacity));
  bool is_own = !texture->has_box && texture->wrap == CELSPAN_WRAP_CLEAR;
  stack->images[stack->image_count] =
      (cs_image_layer){texture, *inverse, *box, is_own ? CELSPAN_WRAP_CLAMP : texture->wrap};
  layer->kind = CS_LAYER_PICTURE;
  layer->index = (uint32_t)stack->image_count++;
  return CELSPAN_OK;
}

static celspan_status append_layer(compiler *c, double fade, celspan_rule rule, uint32_t *index) {
  cs_stack *stack = &c->plan->stack;
  if (stack->layer_count == CS_STACK_LAYERS)
    return cs_fail(c->context, CELSPAN_LIMIT, "cel %zu: more than %zu primitives in one frame",
                   c->cel, (size_t)CS_STACK_LAYERS);
  CS_TRY(APPEND(c, layers, layer_count, layer_capacity));
  CS_TRY(APPEND(c, rules, layer_count, rule_capacity));
  *index = (uint32_t)stack->layer_count++;
  stack->layers[*index] =
      (cs_layer){.group = c->group, .front = c->front, .fade = c->fades_out ? 0 : (float)fade};
  cs_hash key = cs_hash_begin(*index);
  key = cs_hash_end(key);
  stack->rules[*index] = (cs_layer_rule){{key.a, key.b}, rule == CELSPAN_RULE_EVENODD ? 1 : -1};
  return CELSPAN_OK;
}

/* Whether anything inside a box may be on the rows that will be asked for. */
static bool meets_rows(const compiler *c, const celspan_box *box, const celspan_matrix *matrix) {
  cs_boundary_frame around;
  return !cs_boundary_around_box(box, matrix, &around) ||
         (around.bottom >= c->first_height && around.top <= c->end_height);
}

static celspan_status compile_outline(compiler *c, const cs_primitive_data *data, double fade,
                                      const celspan_matrix *matrix) {
  uint32_t index;
  celspan_matrix inverse;
  CS_TRY(append_layer(c, fade, data->rule, &index));
  cs_layer *layer = &c->plan->stack.layers[index];
  const celspan_texture *texture = data->texture;
  if (!celspan_matrix_inverse(cs_matrix_facing(matrix), &inverse)) {
    fill_flat(layer, CS_PAINT_CLEAR, 1); /* it has no area */
    return CELSPAN_OK;
  }
  if (layer->fade == 0)
    fill_flat(layer, CS_PAINT_CLEAR, 1);
  else if (texture->kind == CS_TEXTURE_FLAT)
    fill_flat(layer, texture->flat, (float)fade);
  else if (texture->kind == CS_TEXTURE_PICTURE)
    CS_TRY(fill_picture(c, layer, texture, &data->bounds, &inverse));
  else
    CS_TRY(fill_shaded(c, layer, texture, &inverse));
  celspan_matrix facing = cs_matrix_facing(matrix);
  if (!meets_rows(c, &data->bounds, &facing))
    return CELSPAN_OK;
  return cs_boundary_add(c->context, &c->plan->boundaries, &data->outline, matrix, &c->frame,
                         index);
}

static celspan_status compile_scanline(compiler *c, const cs_primitive_data *data, double fade,
                                       const celspan_matrix *matrix) {
  cs_stack *stack = &c->plan->stack;
  const double *m = matrix->m;
  uint32_t index;
  CS_TRY(append_layer(c, fade, CELSPAN_RULE_NONZERO, &index));
  fill_flat(&stack->layers[index], CS_PAINT_CLEAR, 1);
  if (!cs_matrix_is_upright(matrix))
    return cs_fail(
        c->context, CELSPAN_BAD_ARGUMENT,
        "cel %zu: a scan-line primitive can be moved and scaled, but not rotated, skewed "
        "or put in perspective",
        c->cel);
  if (m[0] == 0 || m[4] == 0)
    return CELSPAN_OK;
  CS_TRY(APPEND(c, procedures, procedure_count, procedure_capacity));
  stack->procedures[stack->procedure_count] =
      (cs_procedure){&data->scanline, index, m[0] / m[8], m[2] / m[8], m[4] / m[8], m[5] / m[8]};
  stack->layers[index].kind = CS_LAYER_SCANLINE;
  stack->layers[index].index = (uint32_t)stack->procedure_count++;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- trees */

static celspan_status compile_object(compiler *c, const celspan_object *object,
                                     const celspan_matrix *parent);

static celspan_status append_step(compiler *c, cs_step step) {
  cs_stack *stack = &c->plan->stack;
  CS_TRY(APPEND(c, steps, step_count, step_capacity));
  stack->steps[stack->step_count++] = step;
  return CELSPAN_OK;
}

static bool operands_are_layers(const cs_primitive_data *data) {
  for (size_t i = 0; i < data->operand_count; i++)
    if (data->operands[i]->data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
      return false;
  return true;
}

/* An operator: the layers of its operands, and the step that combines them. */
static celspan_status compile_operator(compiler *c, const cs_primitive_data *data,
                                       const celspan_matrix *matrix) {
  uint32_t first = (uint32_t)c->plan->stack.layer_count;
  bool records = c->records, over_layers = operands_are_layers(data);
  for (size_t i = 0; i < data->operand_count; i++) {
    uint32_t layer = (uint32_t)c->plan->stack.layer_count;
    c->records = records && !over_layers;
    CS_TRY(compile_object(c, data->operands[i], matrix));
    if (c->records && data->operands[i]->data->kind != CS_PRIMITIVE_DATA_BOOLEAN)
      CS_TRY(append_step(c, (cs_step){.kind = CS_STEP_LAYER, .first = layer, .end = layer + 1}));
  }
  c->records = records;
  if (!records)
    return CELSPAN_OK;
  return append_step(c, (cs_step){.kind = over_layers ? CS_STEP_LAYERS : CS_STEP_OPERATOR,
                                  .op = data->op,
                                  .first = first,
                                  .end = (uint32_t)c->plan->stack.layer_count,
                                  .operands = (uint32_t)data->operand_count});
}

/* Unions of unions need no steps: every layer that is present is painted. */
static bool is_plain_union(const cs_primitive_data *data) {
  if (data->kind != CS_PRIMITIVE_DATA_BOOLEAN)
    return true;
  if (data->op != CELSPAN_UNION)
    return false;
  for (size_t i = 0; i < data->operand_count; i++)
    if (!is_plain_union(data->operands[i]->data))
      return false;
  return true;
}

/* The greatest number of results that the steps of a tree keep at a time. */
static size_t measure_depth(const cs_stack *stack, const cs_tree *tree) {
  size_t depth = 0, most = 0;
  for (uint32_t i = 0; i < tree->step_count; i++) {
    const cs_step *step = &stack->steps[tree->step + i];
    if (step->kind == CS_STEP_OPERATOR)
      depth -= step->operands;
    depth++;
    most = depth > most ? depth : most;
  }
  return most;
}

/* A boolean object that is not an operand of another: the root of a tree, unless it needs no
 * steps. */
static celspan_status compile_root(compiler *c, const cs_primitive_data *data,
                                   const celspan_matrix *matrix) {
  cs_stack *stack = &c->plan->stack;
  if (c->records || is_plain_union(data))
    return compile_operator(c, data, matrix);
  cs_tree tree = {.first = (uint32_t)stack->layer_count, .step = (uint32_t)stack->step_count};
  c->records = true;
  CS_TRY(compile_operator(c, data, matrix));
  c->records = false;
  tree.end = (uint32_t)stack->layer_count;
  tree.step_count = (uint32_t)stack->step_count - tree.step;
  CS_TRY(APPEND(c, trees, tree_count, tree_capacity));
  stack->trees[stack->tree_count++] = tree;
  size_t depth = measure_depth(stack, &tree) + 1;
  stack->step_depth = depth > stack->step_depth ? depth : stack->step_depth;
  return CELSPAN_OK;
}

/* The state of the compiler outside of a group. */
typedef struct outside {
  uint32_t group;
  bool fades_out;
} outside;

static celspan_status begin_group(compiler *c, double fade, outside *outer) {
  cs_stack *stack = &c->plan->stack;
  *outer = (outside){c->group, c->fades_out};
  c->fades_out |= fade == 0;
  if (fade == 1 || c->fades_out)
    return CELSPAN_OK;
  CS_TRY(APPEND(c, groups, group_count, group_capacity));
  stack->groups[stack->group_count] =
      (cs_group){c->group, (uint32_t)stack->layer_count, (float)fade};
  c->group = (uint32_t)stack->group_count++;
  return CELSPAN_OK;
}

static void end_group(compiler *c, outside outer) {
  c->group = outer.group;
  c->fades_out = outer.fades_out;
}

static celspan_status compile_object(compiler *c, const celspan_object *object,
                                     const celspan_matrix *parent) {
  const cs_primitive_data *data = object->data;
  celspan_matrix matrix = celspan_matrix_then(object->matrix, *parent);
  if (data->kind == CS_PRIMITIVE_DATA_OUTLINE)
    return compile_outline(c, data, object->fade, &matrix);
  if (data->kind == CS_PRIMITIVE_DATA_SCANLINE)
    return compile_scanline(c, data, object->fade, &matrix);
  outside outer;
  CS_TRY(begin_group(c, object->fade, &outer));
  CS_TRY(compile_root(c, data, &matrix));
  end_group(c, outer);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- cels */

static cs_v4 light_colour(celspan_light light) { return (cs_v4){light.r, light.g, light.b, 0}; }

/* A back light that shines on every layer from `below` on. While compiling, the rear light is
 * first. */
static celspan_status append_light(compiler *c, celspan_light light, uint32_t below) {
  cs_stack *stack = &c->plan->stack;
  if (light.r == 0 && light.g == 0 && light.b == 0 && light.a == 0)
    return CELSPAN_OK;
  CS_TRY(APPEND(c, lights, light_count, light_capacity));
  stack->lights[stack->light_count++] = (cs_back_light){below, light_colour(light), 1 - light.a};
  return CELSPAN_OK;
}

static celspan_status append_defocused(compiler *c, const cs_defocus_cel *place,
                                       const cs_outline *box, uint32_t detail) {
  cs_stack *stack = &c->plan->stack;
  celspan_matrix identity = celspan_matrix_identity();
  double opacity = place->rostrum->cels[place->index]->opacity;
  uint32_t index;
  CS_TRY(append_layer(c, opacity, CELSPAN_RULE_NONZERO, &index));
  stack->layers[index].kind = CS_LAYER_DEFOCUSED;
  stack->layers[index].index = detail;
  return cs_boundary_add(c->context, &c->plan->boundaries, box, &identity, &c->frame, index);
}

static celspan_status compile_alone(void *user, const cs_defocus_job *job, cs_plan *out);

/* A defocused cel: one layer, present in the box that its blurred art covers. */
static celspan_status compile_defocused(compiler *c, const cs_defocus_cel *place) {
  cs_plan *plan = c->plan;
  cs_stack *stack = &plan->stack;
  const cs_defocus_compiler alone = {compile_alone, c};
  cs_outline box;
  CS_TRY(APPEND(c, defocused, defocused_count, defocused_capacity));
  CS_TRY(cs_mem_reserve(c->context, (void **)&plan->defocus, &plan->defocus_capacity,
                        plan->defocus_count + 1, sizeof(cs_defocus *)));
  cs_outline_init(&box);
  cs_defocus *defocus = NULL;
  celspan_status status = cs_defocus_layer_create(c->context, place, &alone, &box, &defocus);
  if (status == CELSPAN_OK && defocus) {
    plan->defocus[plan->defocus_count++] = defocus;
    stack->defocused[stack->defocused_count] = &defocus->grid;
    status = append_defocused(c, place, &box, (uint32_t)stack->defocused_count++);
  }
  cs_outline_finish(&box, c->context->memory);
  return status;
}

static celspan_status compile_cel(compiler *c, const celspan_rostrum *rostrum, size_t index,
                                  const celspan_matrix *to_pixels, double film_width,
                                  double film_height) {
  const celspan_cel *cel = rostrum->cels[index];
  celspan_matrix matrix;
  c->cel = index + 1;
  CS_TRY(cs_scene_cel_matrix(c->context, rostrum, index, film_width, film_height, &matrix));
  matrix = celspan_matrix_then(matrix, *to_pixels);
  CS_TRY(append_light(c, cs_scene_back(rostrum, cel->back), (uint32_t)c->plan->stack.layer_count));
  c->front = light_colour(cs_scene_front(rostrum, cel));
  const cs_defocus_cel place = {rostrum,         index,
                                *to_pixels,      film_width,
                                film_height,     matrix,
                                c->frame,        c->plan->width,
                                c->plan->height, c->plan->antialias != CELSPAN_ANTIALIAS_NONE};
  if (cs_defocus_layer_is_needed(&place))
    return compile_defocused(c, &place);
  outside outer;
  CS_TRY(begin_group(c, cel->opacity, &outer));
  for (size_t i = 0; i < cel->object_count; i++)
    CS_TRY(compile_object(c, cel->objects[i], &matrix));
  end_group(c, outer);
  return CELSPAN_OK;
}

/* The composer needs lights from the camera backwards. */
static void reverse_lights(cs_stack *stack) {
  for (size_t i = 0, j = stack->light_count; i + 1 < j; i++) {
    cs_back_light light = stack->lights[i];
    stack->lights[i] = stack->lights[--j];
    stack->lights[j] = light;
  }
}

/* ---------------------------------------------------------------- the cull */

/* The most that a layer lets through; 1 for a layer of a faded group, which lets through more than
 * its paint says. */
static double layer_through(const cs_layer *layer) {
  if (layer->group != CS_STACK_NONE)
    return 1;
  if (layer->kind != CS_LAYER_FLAT)
    return layer->is_opaque ? 0 : 1;
  double through = layer->t[0];
  for (int c = 1; c < 3; c++)
    through = layer->t[c] > through ? layer->t[c] : through;
  return through;
}

static celspan_status cull(compiler *c) {
  const cs_stack *stack = &c->plan->stack;
  cs_cull_layer *layers = cs_mem_array(c->context->memory, stack->layer_count, sizeof *layers);
  if (stack->layer_count > 0 && !layers)
    return cs_fail_memory(c->context);
  for (size_t i = 0; i < stack->layer_count; i++)
    layers[i] = (cs_cull_layer){layer_through(&stack->layers[i]), stack->rules[i].winding_mask};
  for (size_t t = 0; t < stack->tree_count; t++) /* where a layer may be present but not painted */
    for (uint32_t i = stack->trees[t].first; i < stack->trees[t].end; i++)
      layers[i].through = 1;
  const cs_cull_desc desc = {.set = &c->plan->boundaries,
                             .layers = layers,
                             .layer_count = stack->layer_count,
                             .width = c->plan->width,
                             .height = c->plan->height,
                             .margin = c->plan->margin,
                             .opaque = (double)CS_PAINT_OPAQUE * 0.999,
                             .workers = c->workers};
  celspan_status status = cs_cull_create(c->context, &desc, &c->plan->cull);
  cs_mem_free(c->context->memory, layers, stack->layer_count * sizeof *layers);
  return status;
}

static celspan_status compile_rostrum(compiler *c, const celspan_rostrum *rostrum,
                                      double film_width, double film_height) {
  celspan_matrix to_pixels =
      celspan_matrix_scaling(c->plan->width / film_width, c->plan->height / film_height);
  CS_TRY(append_light(c, cs_scene_back(rostrum, rostrum->back), 0));
  for (size_t i = 0; i < rostrum->cel_count; i++)
    CS_TRY(compile_cel(c, rostrum, i, &to_pixels, film_width, film_height));
  reverse_lights(&c->plan->stack);
  cs_boundary_sort(&c->plan->boundaries);
  return cull(c);
}

static void begin(compiler *c, celspan_context *context, cs_plan *plan, int32_t first_row,
                  int32_t end_row) {
  double margin = plan->margin;
  *c = (compiler){.context = context,
                  .plan = plan,
                  .frame = {-margin, plan->width + margin, -margin, plan->height + margin},
                  .first_height = first_row - margin - 1, /* a pixel more, against rounding */
                  .end_height = end_row + margin + 1,
                  .group = CS_STACK_NONE};
  cs_boundary_init(&plan->boundaries);
}

celspan_status cs_compile(celspan_context *context, const celspan_rostrum *rostrum,
                          const cs_view *view, const cs_antialias *antialias, int workers,
                          cs_plan *out) {
  cs_plan plan = {.width = view->width, .height = view->height, .antialias = antialias->mode};
  if (antialias->mode == CELSPAN_ANTIALIAS_FILTER) {
    CS_TRY(cs_kernel_create(context, antialias, &plan.kernel));
    plan.margin = cs_kernel_extent(plan.kernel);
  }
  compiler c;
  begin(&c, context, &plan, view->first_row, view->end_row);
  c.workers = workers;
  celspan_status status = compile_rostrum(&c, rostrum, view->film_width, view->film_height);
  if (status == CELSPAN_OK)
    *out = plan;
  else
    cs_compile_free(&plan, context->memory);
  return status;
}

/* ---------------------------------------------------------------- one cel alone */

static celspan_status compile_objects(compiler *c, const cs_defocus_job *job) {
  const celspan_light white = {1, 1, 1, 0};
  c->front = job->is_through ? cs_v4_all(0) : light_colour(white);
  if (job->is_through)
    CS_TRY(append_light(c, white, 0));
  for (size_t i = 0; i < job->cel->object_count; i++)
    CS_TRY(compile_object(c, job->cel->objects[i], &job->matrix));
  cs_boundary_sort(&c->plan->boundaries);
  return cull(c);
}

static celspan_status compile_alone(void *user, const cs_defocus_job *job, cs_plan *out) {
  const compiler *outer = user;
  cs_plan plan = {.width = job->width,
                  .height = job->height,
                  .margin = job->kernel ? cs_kernel_extent(job->kernel) : 0,
                  .kernel = job->kernel};
  compiler c;
  begin(&c, outer->context, &plan, 0, job->height);
  c.workers = 1;
  c.cel = outer->cel;
  celspan_status status = compile_objects(&c, job);
  if (status == CELSPAN_OK)
    *out = plan;
  else
    cs_compile_free(&plan, outer->context->memory);
  return status;
}

void cs_compile_free(cs_plan *plan, cs_memory *memory) {
  for (size_t i = 0; i < plan->defocus_count; i++)
    cs_defocus_layer_free(plan->defocus[i], memory);
  cs_plan_finish(plan, memory);
}
