#include "render/compile.h"

#include "defocus/layer.h"
#include "geometry/matrix.h"
#include "render/hidden.h"
#include "render/layers.h"
#include "render/lights.h"
#include "render/objects.h"

/* ---------------------------------------------------------------- defocused cels */

static celspan_status append_defocused(cs_compiler *c, const cs_defocus_cel *place,
                                       const cs_outline *box, uint32_t detail) {
  cs_stack *stack = &c->plan->stack;
  celspan_matrix identity = celspan_matrix_identity();
  double opacity = place->rostrum->cels[place->index]->opacity;
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
  const cs_defocus_compiler alone = {compile_alone, c};
  cs_outline box;
  CS_TRY(CS_COMPILER_APPEND(c, defocused, defocused_count, defocused_capacity));
  CS_TRY(cs_mem_reserve(c->context, (void **)&plan->defocus, &plan->defocus_capacity,
                        plan->defocus_count + 1, sizeof(cs_defocus *)));
  cs_outline_init(&box);
  cs_defocus *defocus = NULL, *made = NULL;
  if (c->front_plan && plan->defocus_count < c->front_plan->defocus_count)
    made = c->front_plan->defocus[plan->defocus_count];
  celspan_status status = cs_defocus_layer_create(c->context, place, &alone, made, &box, &defocus);
  if (status == CELSPAN_OK && defocus) {
    plan->defocus[plan->defocus_count++] = defocus;
    stack->defocused[stack->defocused_count] = &defocus->grid;
    status = append_defocused(c, place, &box, (uint32_t)stack->defocused_count++);
  }
  cs_outline_finish(&box, c->context->memory);
  return status;
}

/* ---------------------------------------------------------------- cels */

static celspan_status compile_sharp(cs_compiler *c, const celspan_cel *cel,
                                    const celspan_matrix *matrix) {
  cs_objects_outside outer;
  CS_TRY(cs_objects_begin_group(c, cel->opacity, false, &outer));
  CS_TRY(cs_objects_add(c, cel->objects, cel->object_count, matrix));
  cs_objects_end_group(c, outer);
  return CELSPAN_OK;
}

static celspan_status compile_paint(cs_compiler *c, const celspan_rostrum *rostrum, size_t index,
                                    const celspan_matrix *matrix, const cs_compiler_film *film) {
  const cs_defocus_cel place = {rostrum,         index,
                                film->to_pixels, film->width,
                                film->height,    *matrix,
                                c->frame,        c->plan->width,
                                c->plan->height, c->plan->antialias != CELSPAN_ANTIALIAS_NONE};
  return cs_defocus_layer_is_needed(&place) ? compile_defocused(c, &place)
                                            : compile_sharp(c, rostrum->cels[index], matrix);
}

static celspan_status compile_cel(cs_compiler *c, const celspan_rostrum *rostrum, size_t index,
                                  const cs_compiler_film *film) {
  celspan_matrix matrix;
  cs_objects_outside outer;
  cs_lights_front front;
  CS_TRY(cs_scene_cel_matrix(c->context, rostrum, index, film->width, film->height, &matrix));
  matrix = celspan_matrix_then(matrix, film->to_pixels);
  CS_TRY(cs_lights_add_back(c, rostrum, index, &rostrum->cels[index]->back, film));
  CS_TRY(cs_lights_set_front(c, rostrum, index, film, &front));
  CS_TRY(cs_objects_begin_group(c, 1, front.is_shape, &outer));
  CS_TRY(compile_paint(c, rostrum, index, &matrix, film));
  if (front.is_shape)
    CS_TRY(cs_lights_light_group(c, &front, film));
  cs_objects_end_group(c, outer);
  return CELSPAN_OK;
}

/* The cels of a film, from the rear. */
static celspan_status compile_film(cs_compiler *c, const celspan_rostrum *rostrum,
                                   const cs_compiler_film *film) {
  CS_TRY(cs_lights_add_mattes(c, rostrum, film));
  CS_TRY(cs_lights_add_back(c, rostrum, 0, &rostrum->back, film));
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    if (!c->is_nested) { /* a nested one is named by the cel that holds it */
      c->cel = i + 1;
      c->mark = rostrum->cels[i]->mark;
    }
    CS_TRY(compile_cel(c, rostrum, i, film));
  }
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

static celspan_status compile_rostrum(cs_compiler *c, const celspan_rostrum *rostrum,
                                      double film_width, double film_height) {
  const cs_compiler_film film = {.width = film_width,
                                 .height = film_height,
                                 .to_pixels = celspan_matrix_scaling(c->plan->width / film_width,
                                                                     c->plan->height / film_height),
                                 .shine = {1, 1, 1, 0}};
  CS_TRY(compile_film(c, rostrum, &film));
  reverse_lights(&c->plan->stack);
  cs_boundary_sort(&c->plan->boundaries);
  return cs_hidden_cull(c);
}

static void begin(cs_compiler *c, cs_boundary_builder *boundaries, celspan_context *context,
                  cs_plan *plan, int32_t first_row, int32_t end_row) {
  double margin = plan->margin;
  *c = (cs_compiler){.context = context,
                     .plan = plan,
                     .boundaries = boundaries,
                     .frame = {-margin, plan->width + margin, -margin, plan->height + margin},
                     .first_height = first_row - margin - 1, /* a pixel more, against rounding */
                     .end_height = end_row + margin + 1,
                     .group = CS_STACK_NONE,
                     .compile_nested = compile_film};
  cs_boundary_init(&plan->boundaries);
  cs_boundary_builder_init(boundaries, context, &plan->boundaries, &c->frame);
}

/* status: that of compiling. The plan is given away, or freed. */
static celspan_status finish(cs_compiler *c, celspan_status status, cs_plan *out) {
  cs_boundary_builder_finish(c->boundaries);
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
  begin(&c, &boundaries, context, &plan, view->first_row, view->end_row);
  c.workers = workers;
  plan.stack.span_error = view->span_error;
  return finish(&c, compile_rostrum(&c, rostrum, view->film_width, view->film_height), out);
}

/* ---------------------------------------------------------------- one cel alone */

static celspan_status compile_objects(cs_compiler *c, const cs_defocus_job *job) {
  c->front = job->is_through ? cs_v4_all(0) : (cs_v4){1, 1, 1, 0};
  if (job->is_through)
    CS_TRY(cs_lights_add_flat(c, (celspan_light){1, 1, 1, 0}));
  CS_TRY(cs_objects_add(c, job->cel->objects, job->cel->object_count, &job->matrix));
  cs_boundary_sort(&c->plan->boundaries);
  return cs_hidden_cull(c);
}

static celspan_status compile_alone(void *user, const cs_defocus_job *job, cs_plan *out) {
  const cs_compiler *outer = user;
  cs_plan plan = {.width = job->width,
                  .height = job->height,
                  .margin = job->kernel ? cs_kernel_extent(job->kernel) : 0,
                  .kernel = job->kernel,
                  .borrows_defocus = job->front != NULL};
  cs_compiler c;
  cs_boundary_builder boundaries;
  begin(&c, &boundaries, outer->context, &plan, 0, job->height);
  c.front_plan = job->front;
  c.workers = 1;
  c.cel = outer->cel;
  return finish(&c, compile_objects(&c, job), out);
}

void cs_compile_free(cs_plan *plan, cs_memory *memory) { cs_defocus_layer_free_plan(plan, memory); }
