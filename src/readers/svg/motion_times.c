#include "readers/svg/motion_times.h"

#include <math.h>

#include "base/context.h"

/* How many steps for each animation are tried to find whether they ever end. */
#define TRIES 64

typedef enum kind { END, BEGIN } kind; /* at the same time, ends come first */

typedef struct event {
  double time;
  kind kind;
  uint32_t animation;
  uint32_t serial; /* of an end: it counts only if it is the latest one of the animation */
} event;

/* Another animation that waits for one. */
typedef struct follower {
  uint32_t animation, next; /* next: place in the list + 1; 0: the last */
  double offset;
  bool after_end, is_end; /* is_end: the moment is an end of the waiting one */
} follower;

typedef struct state {
  uint32_t serial, first; /* first: of its links, place + 1 */
  double end_given;       /* the earliest end that other animations gave after its beginning */
  double period;          /* between its last two beginnings; 0: it began once */
} state;

typedef struct running {
  celspan_context *context;
  const cs_svg_timing *timings;
  size_t count;
  cs_svg_interval *intervals;
  state *states;
  follower *links;
  size_t link_count, link_capacity;
  event *heap; /* a heap: the earliest first */
  size_t waiting, capacity;
  double last_end; /* of the intervals that ended */
  size_t steps;    /* of work so far */
} running;

/* ---------------------------------------------------------------- events */

static bool is_earlier(const event *a, const event *b) {
  if (a->time != b->time)
    return a->time < b->time;
  if (a->kind != b->kind)
    return a->kind < b->kind;
  return a->animation < b->animation;
}

static celspan_status push(running *c, event pushed) {
  c->steps++;
  if (isnan(pushed.time) || pushed.time == INFINITY)
    return CELSPAN_OK;
  CS_TRY(CS_RESERVE(c->context, c->heap, c->capacity, c->waiting + 1));
  size_t place = c->waiting++;
  for (; place > 0 && is_earlier(&pushed, &c->heap[(place - 1) / 2]); place = (place - 1) / 2)
    c->heap[place] = c->heap[(place - 1) / 2];
  c->heap[place] = pushed;
  return CELSPAN_OK;
}

static event pop(running *c) {
  const event top = c->heap[0], moved = c->heap[--c->waiting];
  size_t place = 0, below;
  while ((below = 2 * place + 1) < c->waiting) {
    below += below + 1 < c->waiting && is_earlier(&c->heap[below + 1], &c->heap[below]);
    if (!is_earlier(&c->heap[below], &moved))
      break;
    c->heap[place] = c->heap[below];
    place = below;
  }
  c->heap[place] = moved;
  return top;
}

/* ---------------------------------------------------------------- intervals */

/* The end of an interval that begins at `begin`. */
static double end_of(const cs_svg_timing *timing, double begin, double given) {
  double end = INFINITY, until = given;
  for (size_t i = 0; i < timing->end_count; i++)
    if (timing->ends[i].after < 0 && timing->ends[i].offset >= begin)
      until = fmin(until, timing->ends[i].offset);
  end = fmin(begin + timing->whole, until);
  end = fmax(end, begin + timing->least);
  return fmin(end, begin + timing->most);
}

/* Whether all ends are written as times that are over: then there is no interval. */
static bool is_over(const cs_svg_timing *timing, double begin) {
  for (size_t i = 0; i < timing->end_count; i++)
    if (timing->ends[i].after >= 0 || timing->ends[i].offset >= begin)
      return false;
  return timing->end_count > 0;
}

static celspan_status give_end(running *c, uint32_t animation, double time) {
  const cs_svg_interval *interval = &c->intervals[animation];
  state *s = &c->states[animation];
  if (!interval->is_active || time < interval->begin || time >= s->end_given)
    return CELSPAN_OK;
  s->end_given = time;
  c->steps += c->timings[animation].end_count;
  c->intervals[animation].end = end_of(&c->timings[animation], interval->begin, time);
  return push(c, (event){interval->end, END, animation, ++s->serial});
}

/* Reports to the animations that wait for a beginning or an end of this one. */
static celspan_status inform(running *c, uint32_t animation, double time, bool is_end) {
  for (uint32_t at = c->states[animation].first; at > 0; at = c->links[at - 1].next) {
    const follower *it = &c->links[at - 1];
    c->steps++;
    if (it->after_end != is_end)
      continue;
    if (it->is_end)
      CS_TRY(give_end(c, it->animation, time + it->offset));
    else
      CS_TRY(push(c, (event){time + it->offset, BEGIN, it->animation, 0}));
  }
  return CELSPAN_OK;
}

/* Reports to those that begin before the end of this one, which is already known. */
static celspan_status inform_before(running *c, uint32_t animation, double end) {
  for (uint32_t at = c->states[animation].first; at > 0; at = c->links[at - 1].next) {
    const follower *it = &c->links[at - 1];
    c->steps++;
    if (it->after_end && !it->is_end && it->offset < 0)
      CS_TRY(push(c, (event){end + it->offset, BEGIN, it->animation, 0}));
  }
  return CELSPAN_OK;
}

static celspan_status finish(running *c, uint32_t animation, double time) {
  cs_svg_interval *interval = &c->intervals[animation];
  interval->is_active = false;
  interval->end = time;
  c->last_end = fmax(c->last_end, time);
  return inform(c, animation, time, true);
}

static bool may_begin(const running *c, uint32_t animation, double time) {
  const cs_svg_interval *interval = &c->intervals[animation];
  cs_svg_restart restart = c->timings[animation].restart;
  if (!interval->has_begun)
    return true;
  if (restart == CS_SVG_RESTART_NEVER || time <= interval->begin)
    return false;
  return interval->is_active ? restart == CS_SVG_RESTART_ALWAYS : time >= interval->end;
}

/* Source: SMIL 3.0, 5.4.3: an interval that is over at 0 does not count. */
static celspan_status begin(running *c, uint32_t animation, double time) {
  const cs_svg_timing *timing = &c->timings[animation];
  cs_svg_interval *interval = &c->intervals[animation];
  state *s = &c->states[animation];
  c->steps += timing->end_count;
  double end = end_of(timing, time, INFINITY);
  if (!may_begin(c, animation, time) || is_over(timing, time) || end <= 0)
    return CELSPAN_OK;
  if (interval->is_active)
    CS_TRY(finish(c, animation, time));
  s->period = interval->has_begun ? time - interval->begin : 0;
  *interval = (cs_svg_interval){true, true, time, end};
  s->end_given = INFINITY;
  CS_TRY(push(c, (event){end, END, animation, ++s->serial}));
  CS_TRY(inform(c, animation, time, false));
  return end < INFINITY ? inform_before(c, animation, end) : CELSPAN_OK;
}

static celspan_status handle(running *c, event it) {
  if (it.kind == BEGIN)
    return begin(c, it.animation, it.time);
  bool is_latest = it.serial == c->states[it.animation].serial;
  return is_latest && c->intervals[it.animation].is_active ? finish(c, it.animation, it.time)
                                                           : CELSPAN_OK;
}

/* ---------------------------------------------------------------- the clock */

static celspan_status add_moments(running *c, uint32_t animation, const cs_svg_moment *moments,
                                  size_t count, bool is_end) {
  for (size_t i = 0; i < count; i++) {
    const cs_svg_moment *it = &moments[i];
    if (it->after < 0) {
      if (!is_end)
        CS_TRY(push(c, (event){it->offset, BEGIN, animation, 0}));
      continue;
    }
    state *other = &c->states[it->after];
    CS_TRY(CS_APPEND(c->context, c->links, c->link_count, c->link_capacity,
                     (follower){animation, other->first, it->offset, it->after_end, is_end}));
    other->first = (uint32_t)c->link_count;
  }
  return CELSPAN_OK;
}

static celspan_status start(running *c) {
  CS_TRY(CS_MAKE(c->context, c->states, c->count));
  for (size_t i = 0; i < c->count; i++) {
    const cs_svg_timing *timing = &c->timings[i];
    c->intervals[i] = (cs_svg_interval){false, false, 0, 0};
    CS_TRY(add_moments(c, (uint32_t)i, timing->begins, timing->begin_count, false));
    CS_TRY(add_moments(c, (uint32_t)i, timing->ends, timing->end_count, true));
  }
  return CELSPAN_OK;
}

/* *is_whole: false if it takes more than `most` steps, and `tries` for each animation and link. */
static celspan_status run(running *c, double seconds, size_t most, size_t tries, bool *is_whole) {
  CS_TRY(start(c));
  most += tries * (c->count + c->link_count);
  while (c->waiting > 0 && c->heap[0].time <= seconds && c->steps <= most)
    CS_TRY(handle(c, pop(c)));
  *is_whole = c->steps <= most;
  return CELSPAN_OK;
}

static void stop(running *c) {
  cs_memory *memory = c->context->memory;
  cs_mem_free(memory, c->states, c->count * sizeof *c->states);
  cs_mem_free(memory, c->links, c->link_capacity * sizeof *c->links);
  cs_mem_free(memory, c->heap, c->capacity * sizeof *c->heap);
}

celspan_status cs_svg_times_run(celspan_context *context, const cs_svg_timing *timings,
                                size_t count, double seconds, cs_svg_interval *out) {
  running c = {.context = context, .timings = timings, .count = count, .intervals = out};
  bool is_whole = true;
  celspan_status status = run(&c, seconds, CS_SVG_MOTION_STEPS, 1, &is_whole);
  stop(&c);
  if (status == CELSPAN_OK && !is_whole)
    return cs_fail(
        context, CELSPAN_LIMIT,
        "the animations begin and end too often until %g s: they take more than %d steps", seconds,
        CS_SVG_MOTION_STEPS);
  return status;
}

/* ---------------------------------------------------------------- the extent */

/* One that has no end: it repeats, or it stays as it is from its beginning on. */
static void add_endless(const cs_svg_timing *timing, const cs_svg_interval *interval,
                        cs_svg_extent *out) {
  if (timing->simple < INFINITY)
    out->period = fmax(out->period, timing->simple);
  else
    out->end = fmax(out->end, interval->begin);
}

celspan_status cs_svg_times_measure(celspan_context *context, const cs_svg_timing *timings,
                                    size_t count, cs_svg_extent *out) {
  running c = {.context = context, .timings = timings, .count = count};
  bool is_whole = true;
  celspan_status status = CS_MAKE(context, c.intervals, count);
  if (status == CELSPAN_OK)
    status = run(&c, INFINITY, TRIES, TRIES, &is_whole);
  for (size_t i = 0; i < count && status == CELSPAN_OK; i++) {
    const cs_svg_interval *it = &c.intervals[i];
    if (it->is_active && it->end == INFINITY)
      add_endless(&timings[i], it, out);
    if (!is_whole)
      out->period = fmax(out->period, c.states[i].period);
  }
  if (status == CELSPAN_OK && is_whole)
    out->end = fmax(out->end, c.last_end);
  cs_mem_free(context->memory, c.intervals, count * sizeof *c.intervals);
  stop(&c);
  return status;
}
