/* A frame taken apart into what its lights add: celspan_stack of the public header.
 *
 *   rostrum --scene/lit_alone.h, for each light--> frame --spans--> addend (addend.h)
 *
 *   row = sum of addend * light, for every light that is on        or, where few lights differ,
 *   row = row in the rostrum's own lights + sum of addend * (light - own light)
 *
 * What a unit of a light adds does not depend on the other lights: composing is linear in all of
 * them, and so is antialiasing. Where all media are grey, what comes through the cels is 1 - alpha
 * of what a front light shows, so that one frame gives two addends.
 */
#include <stdatomic.h>
#include <string.h>

#include "base/thread_pool.h"
#include "relight/addend.h"
#include "render/frame.h"
#include "scene/check.h"
#include "scene/lit_alone.h"
#include "scene/walk.h"

#define MOST_CELS 4096
/* Gradients stand for curves in each of the addends: finer than in a frame, so that their sum is. */
#define TOLERANCE 0x1p-18
/* Rows that a worker sums at a time. */
#define STRIP 16

/* The lights are numbered from the rear: 0 is the back light of the rostrum itself, and has no front;
 * the first cel's back light lies where that is, so both have one addend. */
struct celspan_stack {
  atomic_size_t references;
  cs_memory *memory;
  int32_t width, height;
  size_t light_count;
  celspan_stack_light *own; /* the rostrum's lights */
  cs_addend *fronts, *backs;
  float *base; /* the frame in these: for each row four planes */
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

static celspan_status find_lights(celspan_context *context, const celspan_rostrum *rostrum,
                                  celspan_stack_light *out) {
  CS_TRY(check_flat(context, &rostrum->back, 0, "back"));
  out[0].back = cs_scene_back(rostrum, &rostrum->back).flat;
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    const celspan_cel *cel = rostrum->cels[i];
    cs_light front = cs_scene_front(rostrum, cel);
    CS_TRY(check_flat(context, &front, i + 1, "front"));
    CS_TRY(check_flat(context, &cel->back, i + 1, "back"));
    out[i + 1] = (celspan_stack_light){front.flat, cs_scene_back(rostrum, &cel->back).flat};
  }
  return CELSPAN_OK;
}

/* Light i of a list, as a weight for each channel. */
static void weights_of(const celspan_light *light, float weights[3]) {
  weights[0] = light->r;
  weights[1] = light->g;
  weights[2] = light->b;
}

/* ---------------------------------------------------------------- taking a frame apart */

/* A light that is rendered: where its rows go. */
typedef struct taking {
  cs_addend_writer colours, through; /* through: of a front light, where media are grey */
  const celspan_frame_desc *frame;   /* for its progress */
  size_t done, total;                /* lights */
} taking;

static celspan_status take_row(void *user, celspan_context *context, int32_t y,
                               const celspan_span *spans, size_t count) {
  taking *t = user;
  CS_TRY(cs_addend_writer_row(context, &t->colours, y, spans, count));
  return t->through.addend ? cs_addend_writer_row(context, &t->through, y, spans, count)
                           : CELSPAN_OK;
}

/* Lights count as rows of a frame that is so much higher. */
static bool pass_progress(void *user, int32_t rows_done, int32_t rows_total) {
  const taking *t = user;
  double total = (double)rows_total * (double)t->total;
  double done = (double)rows_total * (double)t->done + rows_done;
  double scale = total > INT32_MAX ? INT32_MAX / total : 1;
  return !t->frame->progress || t->frame->progress(t->frame->progress_user, (int32_t)(done * scale),
                                                   (int32_t)(total * scale));
}

static celspan_status render_alone(celspan_context *context, const celspan_frame_desc *desc,
                                   size_t index, bool is_back, taking *t) {
  const celspan_rostrum *rostrum = desc->exposures[0].rostrum;
  cs_lit_alone alone;
  CS_TRY(cs_lit_alone_make(context, rostrum, index, is_back, &alone));
  const celspan_exposure exposure = {&alone.rostrum, 1};
  celspan_frame_desc frame = *desc;
  frame.exposures = &exposure;
  frame.tolerance = desc->tolerance > 0 ? desc->tolerance : TOLERANCE;
  frame.progress = pass_progress;
  frame.progress_user = t;
  const celspan_sink sink = {.user = t, .row = take_row};
  celspan_status status = celspan_frame_render(context, &frame, &sink, NULL);
  cs_lit_alone_finish(context, &alone);
  return status;
}

/* One frame becomes an addend, or two. through: NULL, or another one. */
static celspan_status take(celspan_context *context, const celspan_frame_desc *desc, size_t index,
                           bool is_back, cs_addend *colours, cs_addend *through, taking *t) {
  celspan_status status = cs_addend_writer_init(context, colours, false, &t->colours);
  if (status == CELSPAN_OK && through)
    status = cs_addend_writer_init(context, through, true, &t->through);
  if (status == CELSPAN_OK)
    status = render_alone(context, desc, index, is_back, t);
  cs_addend_writer_finish(context, &t->colours);
  cs_addend_writer_finish(context, &t->through);
  t->done++;
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

static celspan_status take_all(celspan_context *context, const celspan_frame_desc *desc,
                               celspan_stack *stack) {
  const celspan_rostrum *rostrum = desc->exposures[0].rostrum;
  bool grey = is_grey(context, rostrum);
  size_t cels = rostrum->cel_count;
  taking t = {.frame = desc, .total = grey ? cels + 1 : 2 * cels};
  if (!grey || cels == 0)
    CS_TRY(take(context, desc, 0, true, &stack->backs[0], NULL, &t));
  for (size_t i = 0; i < cels; i++) {
    cs_addend *back = &stack->backs[i == 0 ? 0 : i + 1];
    CS_TRY(take(context, desc, i, false, &stack->fronts[i + 1], grey ? back : NULL, &t));
    if (!grey && i > 0)
      CS_TRY(take(context, desc, i, true, back, NULL, &t));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- summing */

/* An addend and its weights. */
typedef struct term {
  const cs_addend *addend;
  float weights[3];
} term;

/* A frame that is summed. */
typedef struct summing {
  const celspan_stack *stack;
  cs_isa isa;
  term *terms;
  size_t count;
  bool has_base; /* terms are added to the frame in the rostrum's own lights */
  float keep;
  float *planes; /* six of a row for each worker: light, and what comes through */
  float *rgba;   /* pixels; or NULL, and the base is made */
} summing;

static const cs_addend *front_of(const celspan_stack *stack, size_t i) { return &stack->fronts[i]; }

static const cs_addend *back_of(const celspan_stack *stack, size_t i) {
  return &stack->backs[i == 1 ? 0 : i];
}

static void add_term(summing *s, const cs_addend *addend, const celspan_light *light,
                     const celspan_light *less) {
  term t = {.addend = addend};
  float taken[3] = {0, 0, 0};
  weights_of(light, t.weights);
  if (less)
    weights_of(less, taken);
  for (int c = 0; c < 3; c++)
    t.weights[c] -= taken[c];
  if (addend->span_count > 0 && (t.weights[0] != 0 || t.weights[1] != 0 || t.weights[2] != 0))
    s->terms[s->count++] = t;
}

/* own: NULL, or the lights that are in the base. Returns the bytes that the terms have. */
static size_t list_terms(summing *s, const celspan_stack_light *lights,
                         const celspan_stack_light *own) {
  const celspan_stack *stack = s->stack;
  size_t bytes = 0;
  s->count = 0;
  for (size_t i = 0; i < stack->light_count; i++) {
    if (i > 0)
      add_term(s, front_of(stack, i), &lights[i].front, own ? &own[i].front : NULL);
    add_term(s, back_of(stack, i), &lights[i].back, own ? &own[i].back : NULL);
  }
  for (size_t i = 0; i < s->count; i++)
    bytes += cs_addend_bytes(s->terms[i].addend);
  return bytes;
}

/* What the mattes of back lights leave of what comes through. */
static float keep_of(const celspan_stack *stack, const celspan_stack_light *lights) {
  float keep = 1;
  for (size_t i = 0; i < stack->light_count; i++)
    keep *= 1 - lights[i].back.a;
  return keep;
}

static size_t row_bytes(const celspan_stack *stack) {
  return (size_t)stack->width * 4 * sizeof(float);
}

/* Whichever has fewer numbers to go through. */
static void choose_terms(summing *s, const celspan_stack_light *lights) {
  const celspan_stack *stack = s->stack;
  size_t base = row_bytes(stack) * (size_t)stack->height;
  size_t all = list_terms(s, lights, NULL);
  if (base >= all)
    return;
  size_t changed = list_terms(s, lights, stack->own);
  s->has_base = base + changed < all;
  if (!s->has_base)
    (void)list_terms(s, lights, NULL);
}

static void sum_row(const summing *s, int32_t y, float *planes) {
  const celspan_stack *stack = s->stack;
  size_t width = (size_t)stack->width, plane = width * sizeof(float);
  float *base = stack->base + 4 * width * (size_t)y, *through = planes + 3 * width;
  const float one[3] = {1, 1, 1};
  if (s->has_base)
    memcpy(planes, base, 3 * plane);
  else
    memset(planes, 0, 3 * plane);
  for (size_t i = 0; i < s->count; i++)
    cs_addend_add(s->terms[i].addend, s->isa, y, s->terms[i].weights, planes);
  if (s->rgba) {
    CS_WIDE_CHOOSE(s->isa, cs_addend_pixels)
    (planes, base + 3 * width, s->keep, stack->width, s->rgba + 4 * width * (size_t)y);
    return;
  }
  memset(through, 0, 3 * plane);
  cs_addend_add(&stack->backs[0], s->isa, y, one, through);
  memcpy(base, planes, 3 * plane);
  for (size_t x = 0; x < width; x++)
    base[3 * width + x] = (through[x] + through[width + x] + through[2 * width + x]) / 3;
}

static void sum_strip(void *user, int worker, int32_t strip) {
  const summing *s = user;
  int32_t first = strip * STRIP, rest = s->stack->height - first;
  float *planes = s->planes + 6 * (size_t)s->stack->width * (size_t)worker;
  for (int32_t y = first; y < first + (rest < STRIP ? rest : STRIP); y++)
    sum_row(s, y, planes);
}

/* rgba: NULL makes the base. */
static celspan_status sum(celspan_context *context, const celspan_stack *stack,
                          const celspan_stack_light *lights, int workers, float *rgba) {
  int threads = cs_frame_workers(workers);
  size_t terms = 2 * stack->light_count, planes = 6 * (size_t)stack->width;
  summing s = {.stack = stack, .isa = cs_isa_best(), .rgba = rgba};
  s.terms = cs_mem_array(context->memory, terms, sizeof *s.terms);
  s.planes = cs_mem_array(context->memory, planes * (size_t)threads, sizeof *s.planes);
  bool is_ready = s.terms && s.planes;
  if (is_ready) {
    if (rgba)
      choose_terms(&s, lights);
    else
      (void)list_terms(&s, lights, NULL);
    s.keep = keep_of(stack, lights);
    cs_thread_pool_run(threads, (stack->height + STRIP - 1) / STRIP, sum_strip, &s);
  }
  cs_mem_free(context->memory, s.terms, terms * sizeof *s.terms);
  cs_mem_free(context->memory, s.planes, planes * (size_t)threads * sizeof *s.planes);
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
  cs_mem_free(memory, stack->base, row_bytes(stack) * (size_t)stack->height);
  cs_mem_free(memory, stack, sizeof *stack);
  cs_memory_unref(memory);
}

static celspan_status fill(celspan_context *context, const celspan_frame_desc *desc,
                           celspan_stack *stack) {
  size_t count = stack->light_count;
  stack->own = cs_mem_array(context->memory, count, sizeof *stack->own);
  stack->fronts = cs_mem_array(context->memory, count, sizeof *stack->fronts);
  stack->backs = cs_mem_array(context->memory, count, sizeof *stack->backs);
  if (!stack->own || !stack->fronts || !stack->backs)
    return cs_fail_memory(context);
  CS_TRY(find_lights(context, desc->exposures[0].rostrum, stack->own));
  for (size_t i = 0; i < count; i++) {
    CS_TRY(cs_addend_init(context, stack->width, stack->height, &stack->fronts[i]));
    CS_TRY(cs_addend_init(context, stack->width, stack->height, &stack->backs[i]));
  }
  CS_TRY(take_all(context, desc, stack));
  stack->base = cs_mem_array(context->memory, (size_t)stack->height, row_bytes(stack));
  if (!stack->base)
    return cs_fail_memory(context);
  return sum(context, stack, stack->own, desc->workers, NULL);
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
  return CELSPAN_OK;
}

celspan_status celspan_stack_create(celspan_context *context, const celspan_frame_desc *desc,
                                    celspan_stack **out) {
  CS_TRY(check(context, desc));
  celspan_stack *stack = cs_mem_array(context->memory, 1, sizeof *stack);
  if (!stack)
    return cs_fail_memory(context);
  atomic_init(&stack->references, 1);
  stack->memory = cs_memory_ref(context->memory);
  stack->width = desc->crop_width > 0 ? desc->crop_width : desc->width;
  stack->height = desc->crop_height > 0 ? desc->crop_height : desc->height;
  stack->light_count = desc->exposures[0].rostrum->cel_count + 1;
  celspan_status status = fill(context, desc, stack);
  if (status == CELSPAN_OK)
    *out = stack;
  else
    destroy(stack);
  return status;
}

celspan_stack *celspan_stack_ref(celspan_stack *stack) {
  atomic_fetch_add_explicit(&stack->references, 1, memory_order_relaxed);
  return stack;
}

void celspan_stack_unref(celspan_stack *stack) {
  if (stack && atomic_fetch_sub_explicit(&stack->references, 1, memory_order_acq_rel) == 1)
    destroy(stack);
}

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
  size_t bytes = row_bytes(stack) * (size_t)stack->height;
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
