#include "frames/render/compile.h"

#include <math.h>

#include "engine/compose/tree.h"
#include "engine/defocus/layer.h"
#include "frames/render/compiler.h"
#include "frames/render/layers.h"
#include "frames/render/lights.h"
#include "frames/render/objects.h"
#include "frames/render/patterns.h"
#include "frames/render/through.h"
#include "model/pictures/surface.h"

/* ---------------------------------------------------------------- what is hidden */

/* What is hidden: the layers of a plan as the cull needs to know them.
 *
 *   layer  the most that it lets through     a bound (through.h), the same that cuts the
 *                                            programs of the composer: where a tile is dead, the
 *                                            fold of colours has stopped before
 *                                            (of a picture by its header, which is read for it)
 *   group  faded, or lit by a light with a shape; sources, mattes and the groups that mattes fade
 *          hide nothing
 *   tree   where its layers are certain to be painted (engine/compose/tree.h)
 */

#define LAYERS_LEAST 8
#define ROWS_LEAST 20 /* rows of the frame for each piece of the outlines, on average */
/* How many pixels beside the requested columns are compiled too, because of rounding. The number is
 * small, because many dashes may lie there. */
#define BESIDE 0x1p-6
#define DEPTH_LEAST 6   /* halvings of light; a tile dies at CS_THROUGH_OPAQUE */
#define SOURCES_MOST 64 /* grounds inside each other; the cull would enter each */

/* ---------------------------------------------------------------- in the words of the cull */

typedef struct hidden {
  const cs_stack *stack;
  cs_cull_layer *layers;
  cs_cull_group *groups;
  cs_cull_tree *trees;
} hidden;

static double most_of(cs_v4 t) {
  float most = t[0] > t[1] ? t[0] : t[1];
  return most > t[2] ? most : t[2];
}

static void resolve(const void *user, size_t tree, const cs_cull_presence *presences, void *scratch,
                    uint64_t *painted) {
  const hidden *h = user;
  cs_tree_certain(h->stack, &h->stack->trees[tree], presences, scratch, painted);
}

static void fill(celspan_context *context, hidden *h) {
  const cs_stack *stack = h->stack;
  for (size_t i = 0; i < stack->layer_count; i++) {
    const cs_layer *layer = &stack->layers[i];
    h->layers[i] = (cs_cull_layer){.through = most_of(cs_through_layer(context, stack, layer)),
                                   .winding_mask = stack->rules[i].winding_mask,
                                   .group = layer->group,
                                   .is_anywhere = layer->kind == CS_LAYER_SCANLINE};
  }
  for (size_t i = 0; i < stack->group_count; i++) {
    const cs_group *group = &stack->groups[i];
    bool hides =
        (group->kind == CS_GROUP_PLAIN || group->kind == CS_GROUP_GROUND) && !cs_group_keys(group);
    h->groups[i] = (cs_cull_group){group->parent, group->first, hides ? (double)group->fade : 0};
  }
  for (size_t i = 0; i < stack->tree_count; i++)
    h->trees[i] = (cs_cull_tree){stack->trees[i].first, stack->trees[i].end};
}

/* ---------------------------------------------------------------- the cull */

static celspan_status cull(cs_compiler *c, const hidden *h) {
  const cs_stack *stack = h->stack;
  const cs_cull_desc desc = {.set = &c->plan->boundaries,
                             .layers = h->layers,
                             .layer_count = stack->layer_count,
                             .groups = h->groups,
                             .group_count = stack->group_count,
                             .trees = h->trees,
                             .tree_count = stack->tree_count,
                             .resolve = resolve,
                             .user = h,
                             .scratch_size = stack->step_depth * sizeof(cs_tree_certain_result),
                             .width = c->plan->width,
                             .height = c->plan->height,
                             .margin = c->plan->margin,
                             .opaque = (double)CS_PAINT_OPAQUE * 0.999,
                             .workers = c->workers};
  return cs_cull_create(c->context, &desc, &c->plan->cull);
}

/* A chain costs the cull about as much as it costs the sweep in some tens of rows. So the cull pays
 * where chains are long, and where layers are so deep that many tiles die. */
static bool pays(const cs_compiler *c) {
  return c->plan->stack.layer_count >= LAYERS_LEAST &&
         c->plan->stack.source_count <= SOURCES_MOST &&
         c->census.rows >= ROWS_LEAST * c->census.pieces && c->census.depth >= DEPTH_LEAST;
}

/* Culls the boundaries of a plan, which are in their final order, if that pays. Errors: NO_MEMORY.
 */
static CELSPAN_CHECKED celspan_status cull_hidden(cs_compiler *c) {
  const cs_stack *stack = &c->plan->stack;
  cs_memory *memory = c->context->memory;
  if (c->plan->is_crowded || !pays(c))
    return CELSPAN_OK;
  size_t layers = stack->layer_count, groups = stack->group_count, trees = stack->tree_count;
  hidden h = {stack, cs_mem_array(memory, layers, sizeof *h.layers),
              cs_mem_array(memory, groups, sizeof *h.groups),
              cs_mem_array(memory, trees, sizeof *h.trees)};
  celspan_status status = CELSPAN_OK;
  if ((!h.layers && layers > 0) || (!h.groups && groups > 0) || (!h.trees && trees > 0))
    status = cs_fail_memory(c->context);
  if (status == CELSPAN_OK) {
    fill(c->context, &h);
    status = cull(c, &h);
  }
  cs_mem_free(memory, h.layers, layers * sizeof *h.layers);
  cs_mem_free(memory, h.groups, groups * sizeof *h.groups);
  cs_mem_free(memory, h.trees, trees * sizeof *h.trees);
  return status;
}

/* ---------------------------------------------------------------- defocused cels */

static celspan_status append_defocused(cs_compiler *c, const cs_defocus_cel *place,
                                       const cs_outline *box, uint32_t detail) {
  cs_stack *stack = &c->plan->stack;
  celspan_matrix identity = celspan_matrix_identity();
  double opacity = place->cel->opacity;
  uint32_t index;
  CS_TRY(cs_layers_append(c, opacity, CELSPAN_RULE_NONZERO, &index));
  stack->layers[index].kind = CS_LAYER_DEFOCUSED;
  stack->layers[index].index = detail;
  stack->layers[index].t = (cs_v4){1, 1, 1, 0};
  return cs_boundary_add(c->boundaries, box, &identity, index);
}

static celspan_status compile_alone(void *user, const cs_defocus_job *job, cs_plan *out);

/* A defocused cel: one layer, present in the box that its blurred art covers. */
static celspan_status compile_defocused(cs_compiler *c, const cs_defocus_cel *place) {
  cs_plan *plan = c->plan;
  cs_stack *stack = &plan->stack;
  const cs_defocus_compiler alone = {compile_alone, c, c->blurs};
  cs_outline box;
  CS_TRY(CS_COMPILER_APPEND(c, defocused, defocused_count));
  CS_TRY(CS_ARRAY_RESERVE(c->context, plan->defocus, plan->defocus_count + 1));
  cs_outline_init(&box);
  cs_defocus *defocus;
  celspan_status status = cs_defocus_layer_create(c->context, place, &alone, &box, &defocus);
  if (status == CELSPAN_OK && defocus) {
    plan->defocus[plan->defocus_count++] = defocus;
    stack->defocused[stack->defocused_count] = &defocus->grid;
    status = append_defocused(c, place, &box, (uint32_t)stack->defocused_count++);
  }
  cs_outline_finish(&box, c->context->memory);
  return status;
}

/* ---------------------------------------------------------------- cels */

/* light: the light with a shape that falls on the parts of the cel; NULL: no light has a shape, or
 * it falls on the cel as a whole. */
static celspan_status compile_sharp(cs_compiler *c, const celspan_cel *cel,
                                    const celspan_matrix *matrix, const cs_lights_front *light,
                                    const cs_compiler_film *film) {
  cs_objects_outside outer, around;
  bool isolates = cs_cel_isolates(cel);
  CS_TRY(cs_objects_begin_group(c, cel->opacity, false, &outer));
  if (isolates)
    CS_TRY(cs_objects_begin_isolation(c, cel->blends_inside[c->space], false, &around));
  if (light)
    CS_TRY(cs_objects_begin_light(c, light, film));
  CS_TRY(cs_objects_add(c, cel->objects, cel->object_count, matrix));
  if (light)
    CS_TRY(cs_objects_end_light(c));
  if (isolates)
    cs_objects_end_isolation(c, around);
  cs_objects_end_group(c, outer);
  return CELSPAN_OK;
}

static bool is_source(const cs_compiler *c) {
  return c->group != CS_STACK_NONE && c->plan->stack.groups[c->group].is_source;
}

/* A cel under its front light, which falls on all of it, or on its parts where modes are inside. */
static celspan_status compile_paint(cs_compiler *c, const celspan_rostrum *rostrum, size_t index,
                                    const celspan_matrix *matrix, const cs_compiler_film *film) {
  const celspan_cel *cel = rostrum->cels[index];
  const cs_defocus_cel place = {rostrum,
                                cel,
                                film->to_pixels,
                                film->width,
                                film->height,
                                *matrix,
                                c->frame,
                                c->plan->width,
                                c->plan->height,
                                c->plan->antialias != CELSPAN_ANTIALIAS_NONE,
                                c->space,
                                is_source(c),
                                NULL};
  bool is_defocused = cs_defocus_layer_is_needed(&place);
  cs_objects_outside outer;
  cs_lights_front front;
  CS_TRY(cs_lights_set_front(c, rostrum, index, film, &front));
  if (front.is_shape && cel->has_modes && !is_defocused)
    return compile_sharp(c, cel, matrix, &front, film);
  CS_TRY(cs_objects_begin_group(c, 1, front.is_shape, &outer));
  CS_TRY(is_defocused ? compile_defocused(c, &place) : compile_sharp(c, cel, matrix, NULL, film));
  if (front.is_shape)
    CS_TRY(cs_lights_light_group(c, &front, film));
  cs_objects_end_group(c, outer);
  return CELSPAN_OK;
}

/* The same for a cel with a grade, which acts on the lit cel. */
static celspan_status compile_graded(cs_compiler *c, const celspan_rostrum *rostrum, size_t index,
                                     const celspan_matrix *matrix, const cs_compiler_film *film) {
  cs_objects_outside outer;
  CS_TRY(cs_objects_begin_grade(c, rostrum->cels[index]->grade, &outer));
  CS_TRY(compile_paint(c, rostrum, index, matrix, film));
  cs_objects_end_group(c, outer);
  return CELSPAN_OK;
}

static celspan_status compile_cel(cs_compiler *c, const celspan_rostrum *rostrum, size_t index,
                                  const cs_compiler_film *film) {
  const celspan_cel *cel = rostrum->cels[index];
  celspan_matrix matrix;
  cs_objects_outside outer;
  CS_TRY(cs_scene_cel_matrix(c->context, rostrum, index, film->width, film->height, &matrix));
  matrix = celspan_matrix_then(matrix, film->to_pixels);
  CS_TRY(cs_lights_add_back(c, rostrum, index, &cel->back, film));
  if (cel->blend == CELSPAN_BLEND_NORMAL)
    return compile_graded(c, rostrum, index, &matrix, film);
  CS_TRY(cs_objects_begin_source(c, cel->opacity > 0 ? 1 : 0, false, &outer));
  CS_TRY(compile_graded(c, rostrum, index, &matrix, film));
  return cs_objects_end_source(c, cel->blend, outer);
}

/* The lights count too, because cs_lit_alone changes them without the hash of the cel. A flat back
 * light does not, because it is noted by itself. */
static cs_hash hash_cel(const celspan_cel *cel) {
  cs_hash hash = cs_hash_begin(cel->front.is_given);
  cs_hash_hash(&hash, cel->hash);
  cs_light_hash(&hash, &cel->front);
  if (cel->back.texture)
    cs_light_hash(&hash, &cel->back);
  return cs_hash_end(hash);
}

static cs_hash hash_light(const cs_back_light *light) {
  cs_hash hash = cs_hash_begin(0);
  cs_hash_bytes(&hash, &light->light, sizeof light->light);
  cs_hash_number(&hash, (double)light->keep);
  return cs_hash_end(hash);
}

static celspan_status note(const cs_compiler *c, cs_plan_shown shown) {
  cs_plan *plan = c->plan;
  return CS_ARRAY_APPEND(c->context, plan->shown, plan->shown_count, shown);
}

/* Notes a cel, and before it its flat back light, if it has one. before: the numbers of chains,
 * layers and lights that the plan had before the cel was compiled. */
static celspan_status note_cel(const cs_compiler *c, const celspan_cel *cel,
                               const size_t before[3]) {
  const cs_boundary_set *set = &c->plan->boundaries;
  const cs_stack *stack = &c->plan->stack;
  cs_plan_shown shown = {hash_cel(cel), before[1], HUGE_VAL, -HUGE_VAL};
  for (size_t i = before[0]; i < set->chain_count; i++) {
    shown.top = fmin(shown.top, set->chains[i].y0);
    shown.bottom = fmax(shown.bottom, set->chains[i].y1);
  }
  for (size_t i = before[2]; i < stack->light_count; i++)
    CS_TRY(note(c, (cs_plan_shown){hash_light(&stack->lights[i]), 0, -HUGE_VAL, HUGE_VAL}));
  return note(c, shown);
}

/* firsts: as of cs_lights_add_mattes. */
static celspan_status compile_cels(cs_compiler *c, const celspan_rostrum *rostrum,
                                   const cs_compiler_film *film, uint32_t *firsts) {
  const cs_stack *stack = &c->plan->stack;
  cs_objects_outside unused;
  uint32_t first = (uint32_t)stack->layer_count;
  CS_TRY(cs_lights_add_mattes(c, rostrum, film, firsts));
  uint32_t end = (uint32_t)stack->layer_count;
  CS_TRY(
      cs_objects_begin_isolation(c, cs_rostrum_blends(rostrum, c->space), !film->outline, &unused));
  c->isolation.mattes_end = first < end ? end : 0;
  CS_TRY(cs_lights_add_back(c, rostrum, 0, &rostrum->back, film));
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    if (!c->is_nested) { /* a nested one is named by the cel that holds it */
      c->cel = c->cel_numbers ? c->cel_numbers[i] : i + 1;
      c->mark = rostrum->cels[i]->mark;
    }
    c->isolation.mattes = firsts[i];
    const size_t before[] = {c->plan->boundaries.chain_count, stack->layer_count,
                             stack->light_count};
    CS_TRY(compile_cel(c, rostrum, i, film));
    if (!c->is_nested)
      CS_TRY(note_cel(c, rostrum->cels[i], before));
  }
  return CELSPAN_OK;
}

/* The cels of a film, from the rear. */
static celspan_status compile_film(cs_compiler *c, const celspan_rostrum *rostrum,
                                   const cs_compiler_film *film) {
  uint32_t *firsts;
  size_t room = rostrum->cel_count + 1; /* at least one */
  CS_TRY(CS_MAKE(c->context, firsts, room));
  celspan_status status = compile_cels(c, rostrum, film, firsts);
  cs_mem_free(c->context->memory, firsts, room * sizeof *firsts);
  return status;
}

/* The composer needs lights from the camera backwards. */
static void reverse_lights(cs_stack *stack) {
  for (size_t i = 0, j = stack->light_count; i + 1 < j; i++) {
    cs_back_light light = stack->lights[i];
    stack->lights[i] = stack->lights[--j];
    stack->lights[j] = light;
  }
}

static celspan_status compile_rostrum(cs_compiler *c, const celspan_rostrum *rostrum,
                                      const cs_view *view) {
  const cs_compiler_film film = {.width = view->film_width,
                                 .height = view->film_height,
                                 .to_pixels =
                                     celspan_matrix_scaling(c->plan->width / view->film_width,
                                                            c->plan->height / view->film_height),
                                 .shine = {1, 1, 1, 0}};
  const celspan_space around = cs_space_inside(view->film_space, c->space);
  CS_TRY(cs_objects_begin_frame(c, cs_space_inside(rostrum->space, around), rostrum->grade));
  CS_TRY(compile_film(c, rostrum, &film));
  reverse_lights(&c->plan->stack);
  CS_TRY(cs_boundary_sort(c->context, &c->plan->boundaries));
  return cull_hidden(c);
}

static void begin(cs_compiler *c, cs_boundary_builder *boundaries, celspan_context *context,
                  cs_plan *plan, const cs_view *view) {
  double margin = plan->margin;
  *c = (cs_compiler){.context = context,
                     .plan = plan,
                     .boundaries = boundaries,
                     .frame = {-margin, plan->width + margin, -margin, plan->height + margin},
                     .first_height = view->first_row - margin - 1, /* a pixel more, for rounding */
                     .end_height = view->end_row + margin + 1,
                     .first_place = view->first_column - margin - BESIDE,
                     .end_place = view->end_column + margin + BESIDE,
                     .most_dashes = view->most_dashes,
                     .space = view->space,
                     .unit = view->unit,
                     .cel_numbers = view->cel_numbers,
                     .group = CS_STACK_NONE,
                     .isolation = {.ground = CS_STACK_NONE},
                     .compile_nested = compile_film,
                     .compile_alone = compile_alone,
                     .free_alone = cs_defocus_layer_free_plan};
  cs_boundary_init(&plan->boundaries);
  plan->boundaries.keeps_curves = view->unit.x > 0;
  cs_boundary_builder_init(boundaries, context, &plan->boundaries, &c->frame);
}

/* ---------------------------------------------------------------- a plan */

/* picture: may be NULL. */
static bool picture_stays_on_thread(const cs_picture *picture) {
  return picture && picture->surface && cs_surface_stays_on_thread(picture->surface);
}

static bool stays_on_thread(const cs_plan *plan) {
  for (size_t k = 0; k < plan->stack.procedure_count; k++)
    if (!plan->stack.procedures[k].desc->any_thread)
      return true;
  for (size_t k = 0; k < plan->stack.image_count; k++) {
    const cs_texture_variation *variation = plan->stack.images[k].texture->variation;
    if (picture_stays_on_thread(variation->picture) || picture_stays_on_thread(variation->medium))
      return true;
  }
  for (size_t k = 0; k < plan->defocus_count; k++)
    if (cs_defocus_stays_on_thread(plan->defocus[k]))
      return true;
  return false;
}

/* status: the result of compiling. The plan is moved to *out, or freed. */
static celspan_status finish(cs_compiler *c, celspan_status status, cs_plan *out) {
  cs_boundary_builder_finish(c->boundaries);
  c->plan->stays_on_thread = status == CELSPAN_OK && stays_on_thread(c->plan);
  if (status == CELSPAN_OK)
    *out = *c->plan;
  else
    cs_compile_free(c->plan, c->context->memory);
  return status;
}

celspan_status cs_compile(celspan_context *context, const celspan_rostrum *rostrum,
                          const cs_view *view, const cs_antialias *antialias, int workers,
                          cs_plan *out) {
  cs_plan plan = {.width = view->width, .height = view->height, .antialias = antialias->mode};
  if (antialias->mode == CELSPAN_ANTIALIAS_FILTER) {
    CS_TRY(cs_kernel_create(context, antialias, &plan.kernel));
    plan.margin = cs_kernel_extent(plan.kernel);
  }
  cs_compiler c;
  cs_boundary_builder boundaries;
  cs_patterns patterns = {0};
  cs_defocus_made blurs = {0};
  begin(&c, &boundaries, context, &plan, view);
  c.workers = workers;
  c.patterns = &patterns;
  c.blurs = &blurs;
  plan.stack.span_error = view->span_error;
  plan.stack.space = view->space;
  celspan_status status = compile_rostrum(&c, rostrum, view);
  cs_patterns_finish(&patterns, context->memory);
  cs_defocus_made_finish(&blurs, context);
  return finish(&c, status, out);
}

/* ---------------------------------------------------------------- one cel alone */

static celspan_status compile_objects(cs_compiler *c, const cs_defocus_job *job) {
  c->front = job->is_through ? cs_v4_all(0) : (cs_v4){1, 1, 1, 0};
  if (job->is_through)
    CS_TRY(cs_lights_add_flat(c, (celspan_light){1, 1, 1, 0}));
  cs_objects_outside unused;
  CS_TRY(cs_objects_begin_isolation(c, job->cel->blends_inside[c->space], false, &unused));
  CS_TRY(cs_objects_add(c, job->cel->objects, job->cel->object_count, &job->matrix));
  CS_TRY(cs_boundary_sort(c->context, &c->plan->boundaries));
  return cull_hidden(c);
}

static celspan_status compile_raster(const cs_compiler *outer, const cs_defocus_job *job,
                                     const cs_view *view, cs_plan *out) {
  cs_plan plan = {.width = job->width,
                  .height = job->height,
                  .margin = job->kernel ? cs_kernel_extent(job->kernel) : 0,
                  .kernel = job->kernel};
  cs_compiler c;
  cs_boundary_builder boundaries;
  begin(&c, &boundaries, outer->context, &plan, view);
  c.patterns = outer->patterns;
  c.blurs = outer->blurs;
  c.workers = 1;
  c.cel = outer->cel;
  c.mark = outer->mark;
  celspan_status status =
      cs_boundary_expect(c.context, &plan.boundaries, view->pieces, view->points);
  if (status == CELSPAN_OK)
    status = compile_objects(&c, job);
  return finish(&c, status, out);
}

static celspan_status compile_alone(void *user, const cs_defocus_job *job, cs_plan *out) {
  const cs_compiler *outer = user;
  const cs_view view = {.end_row = job->height,
                        .end_column = job->width,
                        .most_dashes = SIZE_MAX,
                        .space = outer->space};
  return compile_raster(outer, job, &view, out);
}

celspan_status cs_compile_drawing(celspan_context *context, const celspan_cel *cel, size_t number,
                                  const celspan_matrix *matrix, const cs_view *view, cs_plan *out) {
  cs_patterns patterns = {0};
  cs_defocus_made blurs = {0};
  const cs_compiler outer = {.context = context,
                             .cel = number,
                             .mark = cel->mark,
                             .space = view->space,
                             .patterns = &patterns,
                             .blurs = &blurs};
  const cs_defocus_job job = {
      .cel = cel, .matrix = *matrix, .width = view->width, .height = view->height};
  celspan_status status = compile_raster(&outer, &job, view, out);
  cs_patterns_finish(&patterns, context->memory);
  cs_defocus_made_finish(&blurs, context);
  return status;
}

void cs_compile_free(cs_plan *plan, cs_memory *memory) { cs_defocus_layer_free_plan(plan, memory); }
