/* frames/film/frame_pipeline.c: whatever the number of workers and wherever frames are made, they
 * are built and finished in order, made once and released once; and the first failure is reported.
 */
#include "frames/film/frame_pipeline.h"

#include <pthread.h>

#include "tests/support/check.h"
#include "tests/support/memory.h"

enum { FRAMES = 40, NOWHERE = -1 };

typedef struct studio {
  celspan_context *context;
  pthread_t thread; /* the calling one */
  cs_pipeline_step steps[FRAMES];
  int fails_to_build, fails_to_make, fails_to_finish; /* a frame, or NOWHERE */
  int stops_after;                                    /* frames finished, or NOWHERE */
  int stops_once_in; /* a frame of the calling thread, or NOWHERE: it ignores the stop */
  bool says_stop;
  atomic_int made[FRAMES];
  int built, finished, released, failed;
  double share; /* reported last */
  int faults;   /* seen by the callbacks */
} studio;

typedef struct frame {
  int index;
  int made;   /* 1 once it is */
  int before; /* frames finished before it was made, if the calling thread made it */
} frame;

static bool is_calling_thread(const studio *s) { return pthread_equal(pthread_self(), s->thread); }

static celspan_status build(void *user, size_t index, void *carried, cs_pipeline_step *step) {
  studio *s = user;
  frame *f = carried;
  s->faults += !is_calling_thread(s) || (int)index != s->built || f->index != 0 || f->made != 0;
  for (int i = 0; i < s->built; i++)
    s->faults += s->steps[i] == CS_PIPELINE_HERE && i != s->fails_to_build && !s->made[i];
  s->built++;
  f->index = (int)index;
  *step = s->steps[index];
  if ((int)index == s->fails_to_build)
    return cs_fail(s->context, CELSPAN_CALLBACK, "build %zu", index);
  return CELSPAN_OK;
}

/* Some frames take long, so that those after them are ready first. */
static void be_busy(int index) {
  volatile unsigned sum = 0;
  for (unsigned i = 0; i < (index % 3 == 0 ? 300000u : 1000u); i++)
    sum += i;
  (void)sum;
}

static celspan_status make(void *user, celspan_context *context, void *carried, int workers,
                           cs_frame_pipeline_frame *turn) {
  studio *s = user;
  frame *f = carried;
  bool is_here = is_calling_thread(s);
  s->made[f->index]++;
  f->made = workers >= 1;
  if (is_here)
    f->before = s->finished;
  be_busy(f->index);
  if (f->index == s->stops_once_in) {
    s->says_stop = true;
    s->faults += !is_here || cs_frame_pipeline_progress(turn, 1, 2);
    s->says_stop = false;
    return CELSPAN_OK;
  }
  if (!cs_frame_pipeline_progress(turn, 1, 2))
    return cs_fail(context, CELSPAN_CANCELLED, "not wanted");
  if (f->index == s->fails_to_make)
    return cs_fail(context, CELSPAN_INPUT, "make %d", f->index);
  return CELSPAN_OK;
}

static celspan_status finish(void *user, void *carried, celspan_status status) {
  studio *s = user;
  const frame *f = carried;
  int index = s->finished + s->failed;
  s->faults += !is_calling_thread(s) || f->index != index;
  s->faults += status == CELSPAN_OK && f->made != (s->steps[index] != CS_PIPELINE_NOTHING);
  s->faults += s->steps[index] == CS_PIPELINE_IN_ORDER && f->made && f->before != s->finished;
  if (status != CELSPAN_OK) {
    s->failed++;
    return s->fails_to_finish == NOWHERE ? status : CELSPAN_OK;
  }
  s->finished++;
  if (index == s->fails_to_finish)
    return cs_fail(s->context, CELSPAN_OUTPUT, "finish %d", index);
  return CELSPAN_OK;
}

static void release(void *user, void *carried) {
  (void)carried;
  ((studio *)user)->released++;
}

static bool tick(void *user, double share) {
  studio *s = user;
  s->faults += !is_calling_thread(s) || !(share >= 0 && share <= FRAMES - s->finished);
  s->share = share;
  if (s->says_stop)
    return false;
  return s->stops_after == NOWHERE || s->finished < s->stops_after;
}

static celspan_status run(studio *s, celspan_context *context, int workers, bool keeps_going) {
  const cs_frame_pipeline pipeline = {.count = FRAMES,
                                      .workers = workers,
                                      .keeps_going = keeps_going,
                                      .frame_size = sizeof(frame),
                                      .user = s,
                                      .build = build,
                                      .make = make,
                                      .finish = finish,
                                      .release = release,
                                      .tick = tick};
  s->context = context;
  s->thread = pthread_self();
  return cs_frame_pipeline_run(context, &pipeline);
}

static studio quiet(void) {
  return (studio){.fails_to_build = NOWHERE,
                  .fails_to_make = NOWHERE,
                  .fails_to_finish = NOWHERE,
                  .stops_after = NOWHERE,
                  .stops_once_in = NOWHERE};
}

static const int WORKERS[] = {1, 2, 3, 8, 100};
enum { WAYS = sizeof WORKERS / sizeof *WORKERS };

static void test_order(celspan_context *context, int workers) {
  for (int kinds = 1; kinds <= 4; kinds++) {
    studio s = quiet();
    for (int i = 0; i < FRAMES; i++)
      s.steps[i] = (cs_pipeline_step)(i * 7 % 11 % kinds);
    CHECK(run(&s, context, workers, false) == CELSPAN_OK);
    CHECK(s.finished == FRAMES && s.built == FRAMES && s.released == FRAMES);
    CHECK(s.faults == 0);
    CHECK(s.share == 0);
    for (int i = 0; i < FRAMES; i++)
      CHECK(s.made[i] == (s.steps[i] != CS_PIPELINE_NOTHING));
  }
}

static void test_failures(celspan_context *context, int workers) {
  studio s = quiet();
  s.fails_to_build = 20;
  s.fails_to_make = 13;
  CHECK(run(&s, context, workers, false) == CELSPAN_INPUT);
  CHECK_TEXT(celspan_context_error(context), "make 13");
  CHECK(s.finished == 13 && s.failed == 1 && s.released == s.built && s.faults == 0);

  s = quiet();
  s.fails_to_build = 5;
  s.fails_to_make = 30;
  CHECK(run(&s, context, workers, false) == CELSPAN_CALLBACK);
  CHECK_TEXT(celspan_context_error(context), "build 5");
  CHECK(s.finished == 5 && s.built == 6 && s.released == 6 && s.faults == 0);

  s = quiet();
  s.fails_to_finish = 9;
  CHECK(run(&s, context, workers, false) == CELSPAN_OUTPUT);
  CHECK_TEXT(celspan_context_error(context), "finish 9");
  CHECK(s.finished == 10 && s.released == s.built && s.faults == 0);
}

static void test_going_on(celspan_context *context, int workers) {
  studio s = quiet();
  s.fails_to_build = 20;
  s.fails_to_make = 13;
  s.fails_to_finish = FRAMES; /* failures are ignored */
  CHECK(run(&s, context, workers, true) == CELSPAN_OK);
  CHECK(s.finished == FRAMES - 2 && s.failed == 2 && s.released == FRAMES && s.faults == 0);
}

static void test_stop(celspan_context *context, int workers) {
  studio s = quiet();
  s.stops_after = 7;
  CHECK(run(&s, context, workers, true) == CELSPAN_CANCELLED);
  CHECK_TEXT(celspan_context_error(context), "stopped after 7 of 40 frames");
  CHECK(s.finished == 7 && s.released == s.built && s.faults == 0);
}

/* One refusal is enough, although the frame in which it was reported is still completed. */
static void test_stop_once(celspan_context *context, int workers) {
  studio s = quiet();
  s.stops_once_in = 11;
  s.steps[11] = CS_PIPELINE_HERE;
  CHECK(run(&s, context, workers, false) == CELSPAN_CANCELLED);
  CHECK(s.finished <= 12 && s.released == s.built && s.faults == 0);
}

/* With the n-th allocation failing, for every n, nothing is begun and nothing is lost. */
static void test_memory(int workers) {
  celspan_status status = CELSPAN_NO_MEMORY;
  for (size_t n = 1; status == CELSPAN_NO_MEMORY; n++) {
    memory_watch watch = {0};
    celspan_context *context = memory_watch_context(&watch);
    watch.allocations = 0;
    watch.fail_at = n;
    studio s = quiet();
    status = run(&s, context, workers, false);
    CHECK(status == CELSPAN_OK ? s.finished == FRAMES : s.built == 0);
    celspan_context_destroy(context);
    CHECK(watch.blocks == 0 && watch.size_errors == 0);
  }
  CHECK(status == CELSPAN_OK);
}

int main(void) {
  celspan_context *context = NULL;
  if (celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  for (int i = 0; i < WAYS; i++) {
    test_order(context, WORKERS[i]);
    test_failures(context, WORKERS[i]);
    test_going_on(context, WORKERS[i]);
    test_stop(context, WORKERS[i]);
    test_stop_once(context, WORKERS[i]);
    test_memory(WORKERS[i]);
  }
  celspan_context_destroy(context);
  return check_done();
}
