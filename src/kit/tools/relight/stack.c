/* A frame taken apart into what its lights add: celspan_stack of the public header.
 *
 *   rostrum --scene/scene.h, for each light--> frame --spans--> addend (addend.h)
 *   rostrum, in its own lights --------------------> frame --spans--> addend: the base
 *
 *   row = sum of addend * light, for every light that is on        or, where few lights differ,
 *   row = base + sum of addend * (light - own light)
 *
 * The addend of a light does not depend on the other lights: composing is linear in all lights, and
 * so is antialiasing, in the space of the frame. The numbers of this space are summed. The share of
 * light that comes through all cels is 1 - alpha in the frame of the rearmost light. If all media
 * are grey, this share is also the addend of a light behind the cels, so the frame of a front light
 * gives the addend of the back light as well.
 */
#include <stdatomic.h>
#include <string.h>

#include "celspan/relight.h"
#include "inside/context.h"
#include "inside/description.h"
#include "inside/frames.h"
#include "inside/scene.h"
#include "inside/threads.h"
#include "tools/relight/addend.h"

#define MOST_CELS 4096
/* Gradients replace curves in each addend, with a finer tolerance than in a frame, because addends
 * are summed. */
#define TOLERANCE 0x1p-18
/* Rows that a worker sums at a time. */
#define STRIP 4
/* Numbers on a line of the cache. */
#define LINE (CS_WIDE_LINE / sizeof(float))
enum { PLANES = 4 };

/* The lights are numbered from the rear: 0 is the back light of the rostrum itself, and has no
 * front. The back light of the first cel lies in the same place as light 0, so both have one
 * addend. */
struct celspan_stack {
  atomic_size_t references;
  cs_memory *memory;
  int32_t width, height;
  celspan_space space; /* the space of the frame and of its rostrum */
  size_t light_count;
  celspan_stack_light *own; /* the rostrum's lights */
  cs_addend *fronts, *backs;
  cs_addend base; /* the frame in its own lights */
  /* the light through all cels; empty if media are grey, because backs[0] is used then */
  cs_addend through;
  bool is_grey;
};

/* ---------------------------------------------------------------- lights */

static celspan_status check_flat(celspan_context *context, const cs_light *light, size_t cel,
                                 const char *field) {
  if (!light->texture)
    return CELSPAN_OK;
  if (cel == 0)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "stack: the %s light of the rostrum is a texture; a stack takes flat lights",
                   field);
  return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                 "stack: the %s light of cel %zu is a texture; a stack takes flat lights", field,
                 cel);
}

static celspan_light flat_of(cs_light light, celspan_space space) {
  return cs_light_in(&light, space);
}

static celspan_status find_lights(celspan_context *context, const celspan_rostrum *rostrum,
                                  celspan_space space, celspan_stack_light *out) {
  CS_TRY(check_flat(context, &rostrum->back, 0, "back"));
  out[0].back = flat_of(cs_scene_back(rostrum, &rostrum->back), space);
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    const celspan_cel *cel = rostrum->cels[i];
    cs_light front = cs_scene_front(rostrum, cel);
    CS_TRY(check_flat(context, &front, i + 1, "front"));
    CS_TRY(check_flat(context, &cel->back, i + 1, "back"));
    out[i + 1] = (celspan_stack_light){flat_of(front, space),
                                       flat_of(cs_scene_back(rostrum, &cel->back), space)};
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- taking a frame apart */

/* Frames that are being rendered, and the place for their rows. */
typedef struct taking {
  cs_addend_writer colours, through;
  cs_addend_budget budget;
  const celspan_frame_desc *frame; /* the frame of the whole */
  size_t done, total;              /* frames */
} taking;

static celspan_status take_row(void *user, celspan_context *context, int32_t y,
                               const celspan_span *spans, size_t count) {
  taking *t = user;
  CS_TRY(cs_addend_writer_row(context, &t->colours, y, spans, count));
  return t->through.addend ? cs_addend_writer_row(context, &t->through, y, spans, count)
                           : CELSPAN_OK;
}

/* Progress over the rows of all renderings together, as if they were one frame. */
static bool pass_progress(void *user, int32_t rows_done, int32_t rows_total) {
  const taking *t = user;
  double total = (double)rows_total * (double)t->total;
  double done = (double)rows_total * (double)t->done + rows_done;
  double scale = total > INT32_MAX ? INT32_MAX / total : 1;
  return !t->frame->progress || t->frame->progress(t->frame->progress_user, (int32_t)(done * scale),
                                                   (int32_t)(total * scale));
}

static celspan_status render(celspan_context *context, celspan_rostrum *rostrum, taking *t) {
  const celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc frame = *t->frame;
  frame.exposures = &exposure;
  frame.tolerance = frame.has_tolerance ? frame.tolerance : TOLERANCE;
  frame.has_tolerance = true;
  frame.progress = pass_progress;
  frame.progress_user = t;
  const celspan_sink sink = {.struct_size = sizeof sink, .user = t, .row = take_row};
  return celspan_frame_render(context, &frame, &sink, NULL);
}

/* Renders a frame and makes it an addend, or two. through: NULL, or the addend of the light that
 * its cels transmit. */
static celspan_status take(celspan_context *context, celspan_rostrum *rostrum, cs_addend *colours,
                           cs_addend *through, taking *t) {
  celspan_status status = cs_addend_writer_init(context, colours, &t->budget, false, &t->colours);
  if (status == CELSPAN_OK && through)
    status = cs_addend_writer_init(context, through, &t->budget, true, &t->through);
  if (status == CELSPAN_OK)
    status = render(context, rostrum, t);
  cs_addend_writer_finish(context, &t->colours);
  cs_addend_writer_finish(context, &t->through);
  t->done++;
  return status;
}

static celspan_status take_alone(celspan_context *context, size_t index, bool is_back,
                                 cs_addend *colours, cs_addend *through, taking *t) {
  cs_lit_alone alone;
  CS_TRY(cs_lit_alone_make(context, t->frame->exposures[0].rostrum, index, is_back, &alone));
  celspan_status status = take(context, &alone.rostrum, colours, through, t);
  cs_lit_alone_finish(context, &alone);
  return status;
}

static celspan_status find_colour(const cs_walk *walk, const cs_primitive_data *primitive,
                                  const celspan_texture *texture) {
  bool *is_grey = walk->user;
  bool is_known = primitive && primitive->kind != CS_PRIMITIVE_DATA_SCANLINE;
  *is_grey = *is_grey && (!primitive || is_known) && (!texture || cs_texture_is_grey(texture));
  return CELSPAN_OK;
}

/* Whether all media are known to be grey. */
static bool is_grey(celspan_context *context, const celspan_rostrum *rostrum) {
  bool grey = true;
  cs_walk walk = {.context = context, .call = find_colour, .user = &grey};
  return cs_walk_rostrum(&walk, rostrum) == CELSPAN_OK && grey;
}

static celspan_status take_lights(celspan_context *context, celspan_stack *stack, taking *t) {
  size_t cels = stack->light_count - 1;
  if (!stack->is_grey || cels == 0)
    CS_TRY(take_alone(context, 0, true, &stack->backs[0], &stack->through, t));
  for (size_t i = 0; i < cels; i++) {
    cs_addend *back = &stack->backs[i == 0 ? 0 : i + 1];
    CS_TRY(take_alone(context, i, false, &stack->fronts[i + 1], stack->is_grey ? back : NULL, t));
    if (!stack->is_grey && i > 0)
      CS_TRY(take_alone(context, i, true, back, NULL, t));
  }
  return CELSPAN_OK;
}

static celspan_status take_all(celspan_context *context, const celspan_frame_desc *desc,
                               celspan_stack *stack) {
  celspan_rostrum *rostrum = desc->exposures[0].rostrum;
  size_t cels = rostrum->cel_count;
  stack->is_grey = is_grey(context, rostrum);
  taking t = {.frame = desc, .total = (stack->is_grey ? cels : 2 * cels) + (cels == 0) + 1};
  CS_TRY(cs_addend_budget_init(context, stack->width, stack->height, &t.budget));
  celspan_status status = take_lights(context, stack, &t);
  if (status == CELSPAN_OK)
    status = take(context, rostrum, &stack->base, NULL, &t);
  cs_addend_budget_finish(&t.budget, context->memory);
  return status;
}

/* ---------------------------------------------------------------- summing */

/* An addend and its weights. */
typedef struct term {
  const cs_addend *addend;
  float weights[3];
} term;

/* A frame that is being summed. */
typedef struct summing {
  const celspan_stack *stack;
  cs_isa isa;
  term *terms;
  size_t count;
  float keep;
  float *planes; /* for each worker, four planes for each row: colours, and the transmitted light */
  size_t stride; /* from one plane to the next */
  float *rgba;
} summing;

static const cs_addend *front_of(const celspan_stack *stack, size_t i) { return &stack->fronts[i]; }

static const cs_addend *back_of(const celspan_stack *stack, size_t i) {
  return &stack->backs[i == 1 ? 0 : i];
}

static void add_term(summing *s, const cs_addend *addend, const celspan_light *light,
                     const celspan_light *less) {
  const term t = {addend, {light->r - less->r, light->g - less->g, light->b - less->b}};
  if (addend->span_count > 0 && (t.weights[0] != 0 || t.weights[1] != 0 || t.weights[2] != 0))
    s->terms[s->count++] = t;
}

/* Lists the terms of the sum. has_base: the base is the first term, and each light is a change of
 * it. Returns the bytes of the addends. */
static size_t list_terms(summing *s, const celspan_stack_light *lights, bool has_base) {
  const celspan_stack *stack = s->stack;
  const celspan_stack_light none = {{0, 0, 0, 0}, {0, 0, 0, 0}};
  const celspan_light white = {1, 1, 1, 1};
  size_t bytes = 0;
  s->count = 0;
  if (has_base)
    add_term(s, &stack->base, &white, &none.front);
  for (size_t i = 0; i < stack->light_count; i++) {
    const celspan_stack_light *less = has_base ? &stack->own[i] : &none;
    if (i > 0)
      add_term(s, front_of(stack, i), &lights[i].front, &less->front);
    add_term(s, back_of(stack, i), &lights[i].back, &less->back);
  }
  for (size_t i = 0; i < s->count; i++)
    bytes += cs_addend_bytes(s->terms[i].addend);
  return bytes;
}

static const cs_addend *through_of(const celspan_stack *stack) {
  return stack->is_grey && stack->light_count > 1 ? &stack->backs[0] : &stack->through;
}

/* The share of the transmitted light that the mattes of back lights leave. */
static float keep_of(const celspan_stack *stack, const celspan_stack_light *lights) {
  float keep = 1;
  for (size_t i = 0; i < stack->light_count; i++)
    keep *= 1 - lights[i].back.a;
  return keep;
}

static void add_rows(const summing *s, const term *t, int32_t y, int32_t rows, float *planes) {
  for (int32_t k = 0; k < rows; k++)
    CS_WIDE_CHOOSE(s->isa, cs_addend_add)
  (t->addend, y + k, t->weights, s->stride, planes + (size_t)k * PLANES * s->stride);
}

/* Sums addend by addend, so that memory is read in order. */
static void sum_strip(void *user, int worker, int32_t strip) {
  const summing *s = user;
  const celspan_stack *stack = s->stack;
  const term through = {through_of(stack), {1, 0, 0}};
  size_t row = PLANES * s->stride, width = (size_t)stack->width;
  int32_t y = strip * STRIP, rest = stack->height - y, rows = rest < STRIP ? rest : STRIP;
  float *planes = (float *)cs_wide_align(s->planes) + STRIP * row * (size_t)worker;
  memset(planes, 0, (size_t)rows * row * sizeof *planes);
  for (size_t i = 0; i < s->count; i++)
    add_rows(s, &s->terms[i], y, rows, planes);
  add_rows(s, &through, y, rows, planes + 3 * s->stride);
  for (int32_t k = 0; k < rows; k++)
    CS_WIDE_CHOOSE(s->isa, cs_addend_pixels)
  (planes + (size_t)k * row, s->stride, s->keep, stack->width,
   s->rgba + 4 * width * (size_t)(y + k));
  for (size_t i = 0; i < (size_t)rows * width && stack->space == CELSPAN_SPACE_SRGB; i++)
    cs_space_decode(stack->space, s->rgba + 4 * (width * (size_t)y + i));
}

static celspan_status sum(celspan_context *context, const celspan_stack *stack,
                          const celspan_stack_light *lights, int workers, float *rgba) {
  int threads = cs_frame_workers(context, workers);
  size_t terms = 2 * stack->light_count;
  summing s = {.stack = stack, .isa = cs_isa_best(), .rgba = rgba};
  s.stride = ((size_t)stack->width + LINE - 1) / LINE * LINE;
  size_t planes = STRIP * PLANES * s.stride * (size_t)threads + LINE; /* so that it is aligned */
  s.terms = cs_mem_array(context->memory, terms, sizeof *s.terms);
  s.planes = cs_mem_array(context->memory, planes, sizeof *s.planes);
  bool is_ready = s.terms && s.planes;
  if (is_ready) {
    size_t all = list_terms(&s, lights, false); /* the smaller of both sums is used */
    if (list_terms(&s, lights, true) >= all)
      (void)list_terms(&s, lights, false);
    s.keep = keep_of(stack, lights);
    cs_thread_pool_run(threads, (stack->height + STRIP - 1) / STRIP, sum_strip, &s);
  }
  cs_mem_free(context->memory, s.terms, terms * sizeof *s.terms);
  cs_mem_free(context->memory, s.planes, planes * sizeof *s.planes);
  return is_ready ? CELSPAN_OK : cs_fail_memory(context);
}

/* ---------------------------------------------------------------- life */

static void destroy(celspan_stack *stack) {
  cs_memory *memory = stack->memory;
  for (size_t i = 0; i < stack->light_count && stack->fronts && stack->backs; i++) {
    cs_addend_finish(&stack->fronts[i], memory);
    cs_addend_finish(&stack->backs[i], memory);
  }
  cs_mem_free(memory, stack->fronts, stack->light_count * sizeof *stack->fronts);
  cs_mem_free(memory, stack->backs, stack->light_count * sizeof *stack->backs);
  cs_mem_free(memory, stack->own, stack->light_count * sizeof *stack->own);
  cs_addend_finish(&stack->base, memory);
  cs_addend_finish(&stack->through, memory);
  cs_counted_free(memory, stack, sizeof *stack);
}

static celspan_status fill(celspan_context *context, const celspan_frame_desc *desc,
                           celspan_stack *stack) {
  size_t count = stack->light_count;
  CS_TRY(CS_MAKE(context, stack->own, count));
  CS_TRY(CS_MAKE(context, stack->fronts, count));
  CS_TRY(CS_MAKE(context, stack->backs, count));
  CS_TRY(find_lights(context, desc->exposures[0].rostrum, stack->space, stack->own));
  for (size_t i = 0; i < count; i++) {
    CS_TRY(cs_addend_init(context, stack->width, stack->height, &stack->fronts[i]));
    CS_TRY(cs_addend_init(context, stack->width, stack->height, &stack->backs[i]));
  }
  CS_TRY(cs_addend_init(context, stack->width, stack->height, &stack->base));
  CS_TRY(cs_addend_init(context, stack->width, stack->height, &stack->through));
  return take_all(context, desc, stack);
}

static celspan_space space_of(const celspan_frame_desc *desc) {
  return cs_space_inside(desc->space, CELSPAN_SPACE_LINEAR);
}

static celspan_status check(celspan_context *context, const celspan_frame_desc *desc) {
  CS_TRY(cs_frame_check(context, desc));
  if (desc->exposure_count != 1)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "stack: it takes one rostrum, but the frame has %zu exposures",
                   desc->exposure_count);
  if (desc->exposures[0].rostrum->cel_count > MOST_CELS)
    return cs_fail(context, CELSPAN_LIMIT, "stack: %zu cels are more than %d",
                   desc->exposures[0].rostrum->cel_count, MOST_CELS);
  if (cs_space_inside(desc->exposures[0].rostrum->space, space_of(desc)) != space_of(desc))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "stack: the rostrum is in another space than the film, so its lights do not add "
                   "up; give both the same space");
  return CELSPAN_OK;
}

celspan_status celspan_stack_create(celspan_context *context, const celspan_frame_desc *desc,
                                    celspan_stack **out) {
  CS_READ(context, "stack", celspan_frame_desc, desc);
  CS_TRY(check(context, desc));
  celspan_stack *stack;
  CS_TRY(CS_COUNTED_MAKE(context, stack));
  stack->width = desc->crop_width > 0 ? desc->crop_width : desc->width;
  stack->height = desc->crop_height > 0 ? desc->crop_height : desc->height;
  stack->light_count = desc->exposures[0].rostrum->cel_count + 1;
  stack->space = space_of(desc);
  celspan_status status = fill(context, desc, stack);
  return CS_GIVE(status, stack, destroy, out);
}

CS_COUNTED(celspan_stack)

/* ---------------------------------------------------------------- questions */

void celspan_stack_size(const celspan_stack *stack, int32_t *width, int32_t *height) {
  *width = stack->width;
  *height = stack->height;
}

size_t celspan_stack_light_count(const celspan_stack *stack) { return stack->light_count; }

void celspan_stack_lights(const celspan_stack *stack, celspan_stack_light *lights) {
  memcpy(lights, stack->own, stack->light_count * sizeof *lights);
}

size_t celspan_stack_bytes(const celspan_stack *stack) {
  size_t bytes = cs_addend_bytes(&stack->base) + cs_addend_bytes(&stack->through);
  for (size_t i = 0; i < stack->light_count; i++)
    bytes += cs_addend_bytes(&stack->fronts[i]) + cs_addend_bytes(&stack->backs[i]);
  return bytes;
}

celspan_status celspan_stack_pixels(celspan_context *context, const celspan_stack *stack,
                                    const celspan_stack_light *lights, int workers, float *rgba) {
  CS_TRY(cs_check_given(context, "stack", "lights", lights));
  CS_TRY(cs_check_given(context, "stack", "the pixels", rgba));
  for (size_t i = 0; i < stack->light_count; i++) {
    CS_TRY(cs_check_light(context, "stack", "front", &lights[i].front));
    CS_TRY(cs_check_light(context, "stack", "back", &lights[i].back));
  }
  return sum(context, stack, lights, workers, rgba);
}
