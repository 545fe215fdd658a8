/* base/pipeline.c: whatever the number of threads, items are made once and delivered in order, with
 * the owner's context; the first that fails is the one that is reported; unwanted items are not
 * begun; nothing leaks when memory or threads run short. */
#include "base/pipeline.h"

#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/thread_pool.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"

enum { ITEMS = 60, NOWHERE = -1 };

/* ---------------------------------------------------------------- shortage of threads */

static int threads_left = INT32_MAX;

typedef int (*creator)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);

/* Replaces the library's own for everything that is linked with this program. */
int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *),
                   void *argument) {
  void *found = dlsym(RTLD_NEXT, "pthread_create");
  creator create;
  memcpy(&create, &found, sizeof create);
  return threads_left-- > 0 ? create(thread, attributes, start, argument) : EAGAIN;
}

/* ---------------------------------------------------------------- the user of a pipeline */

typedef struct works {
  celspan_context *context;
  cs_pipeline *pipeline;
  pthread_t owner;
  int threads;
  size_t slots;
  cs_pipeline_step steps[ITEMS];
  int fails_to_add, fails_to_make, fails_later, fails_to_deliver, cancels_in; /* items */
  int rests_in, idle_most; /* an item that takes long; how often the owner may be idle */
  atomic_int made[ITEMS];
  int made_by[ITEMS];
  int added, delivered, idle;
  atomic_int told;   /* of items that other threads have made */
  atomic_int faults; /* seen by the callbacks */
} works;

static works quiet(void) {
  return (works){.fails_to_add = NOWHERE,
                 .fails_to_make = NOWHERE,
                 .fails_later = NOWHERE,
                 .fails_to_deliver = NOWHERE,
                 .cancels_in = NOWHERE,
                 .rests_in = NOWHERE,
                 .idle_most = INT32_MAX};
}

static bool is_owner(const works *w) { return pthread_equal(pthread_self(), w->owner); }

/* Some items take long, so that those after them are ready first. */
static void be_busy(size_t item) {
  volatile unsigned sum = 0;
  for (unsigned i = 0; i < (item % 3 == 0 ? 100000u : 100u); i++)
    sum += i;
  (void)sum;
}

static void rest(void) {
  const struct timespec time = {.tv_nsec = 350000000};
  nanosleep(&time, NULL);
}

static celspan_status make(void *user, celspan_context *context, int worker, size_t item) {
  works *w = user;
  w->faults += (worker == 0) != is_owner(w) || (worker == 0) != (context == w->context);
  w->faults += worker > w->threads || context->root != w->context;
  w->faults += w->steps[item] != CS_PIPELINE_ANYWHERE && worker != 0;
  w->faults += w->steps[item] == CS_PIPELINE_IN_ORDER && w->delivered != (int)item;
  w->made[item]++;
  w->made_by[item] = worker;
  if ((int)item == w->rests_in)
    rest();
  else
    be_busy(item);
  if ((int)item == w->cancels_in)
    cs_pipeline_end_at(w->pipeline, 0);
  if (!cs_pipeline_is_wanted(w->pipeline, item))
    return cs_fail(context, CELSPAN_CANCELLED, "not wanted");
  if ((int)item == w->fails_to_make || (int)item == w->fails_later)
    return cs_fail(context, CELSPAN_INPUT, "item %zu", item);
  return CELSPAN_OK;
}

static celspan_status deliver(void *user, celspan_context *context, size_t item,
                              celspan_status status) {
  works *w = user;
  w->faults += !is_owner(w) || context != w->context || (int)item != w->delivered;
  w->faults += status == CELSPAN_OK && w->made[item] != (w->steps[item] != CS_PIPELINE_NOTHING);
  CS_TRY(status);
  if ((int)item == w->fails_to_deliver)
    return cs_fail(context, CELSPAN_OUTPUT, "delivery %zu", item);
  w->delivered++;
  return CELSPAN_OK;
}

static celspan_status be_idle(void *user, celspan_context *context) {
  works *w = user;
  w->faults += !is_owner(w);
  return w->idle++ < w->idle_most ? CELSPAN_OK : cs_fail(context, CELSPAN_CANCELLED, "waited");
}

static void be_told(void *user) {
  works *w = user;
  w->faults += is_owner(w);
  w->told++;
}

static celspan_status add_all(works *w) {
  while (w->added < ITEMS) {
    CS_TRY(cs_pipeline_deliver(w->pipeline, w->context, w->slots - 1));
    if (!cs_pipeline_has_room(w->pipeline))
      break;
    int item = w->added++;
    celspan_status status = CELSPAN_OK;
    if (item == w->fails_to_add)
      status = cs_fail(w->context, CELSPAN_CALLBACK, "added %d", item);
    cs_pipeline_add(w->pipeline, w->context, w->steps[item], status);
  }
  return cs_pipeline_deliver(w->pipeline, w->context, 0);
}

static celspan_status run(works *w, celspan_context *context, int threads, bool owner_claims) {
  w->context = context;
  w->owner = pthread_self();
  w->threads = threads;
  w->slots = 2 * (size_t)threads + 1;
  const cs_pipeline_desc desc = {.count = ITEMS,
                                 .slots = w->slots,
                                 .threads = threads,
                                 .owner_claims = owner_claims,
                                 .user = w,
                                 .make = make,
                                 .deliver = deliver,
                                 .idle = be_idle,
                                 .tell = be_told};
  CS_TRY(cs_pipeline_create(context, &desc, &w->pipeline));
  celspan_status status = add_all(w);
  cs_pipeline_destroy(w->pipeline);
  return status;
}

/* ---------------------------------------------------------------- order */

static void check_order(celspan_context *context, int threads, bool owner_claims) {
  for (int kinds = 1; kinds <= 4; kinds++) {
    works w = quiet();
    for (int i = 0; i < ITEMS; i++)
      w.steps[i] = (cs_pipeline_step)(i * 7 % 11 % kinds);
    CHECK(run(&w, context, threads, owner_claims) == CELSPAN_OK);
    CHECK(w.delivered == ITEMS && w.faults == 0);
    int others = 0;
    for (int i = 0; i < ITEMS; i++) {
      others += w.made_by[i] > 0;
      CHECK(w.made[i] == (w.steps[i] != CS_PIPELINE_NOTHING) &&
            (owner_claims || w.steps[i] != CS_PIPELINE_ANYWHERE || w.made_by[i] > 0));
    }
    CHECK(w.told == others);
  }
}

/* ---------------------------------------------------------------- failures */

static void check_failing(celspan_context *context, int threads, bool owner_claims) {
  works w = quiet();
  w.fails_to_make = 21;
  w.fails_later = 22;
  CHECK(run(&w, context, threads, owner_claims) == CELSPAN_INPUT);
  CHECK_TEXT(celspan_context_error(context), "item 21");
  CHECK(w.delivered == 21 && w.faults == 0);

  w = quiet();
  w.fails_to_add = 8;
  w.fails_later = 30;
  CHECK(run(&w, context, threads, owner_claims) == CELSPAN_CALLBACK);
  CHECK_TEXT(celspan_context_error(context), "added 8");
  CHECK(w.delivered == 8 && w.added == 9 && w.faults == 0);

  w = quiet();
  w.fails_to_deliver = 17;
  CHECK(run(&w, context, threads, owner_claims) == CELSPAN_OUTPUT);
  CHECK_TEXT(celspan_context_error(context), "delivery 17");
  CHECK(w.delivered == 17 && w.faults == 0);
}

/* Whoever cancels: items without a slot are not begun any more. */
static void check_cancelled(celspan_context *context, int threads, bool owner_claims) {
  works w = quiet();
  w.cancels_in = 11;
  w.idle_most = 0;
  CHECK(run(&w, context, threads, owner_claims) == CELSPAN_CANCELLED);
  CHECK(w.delivered <= 11 && w.faults == 0);
  for (int i = 11 + 2 * threads + 1; i < ITEMS; i++)
    CHECK(!w.made[i]);
}

/* ---------------------------------------------------------------- waiting */

static void check_idle(celspan_context *context) {
  works w = quiet();
  w.rests_in = 0;
  CHECK(run(&w, context, 1, false) == CELSPAN_OK);
  CHECK(w.idle >= 1 && w.delivered == ITEMS && w.faults == 0);

  w = quiet();
  w.rests_in = 0;
  w.idle_most = 0;
  CHECK(run(&w, context, 1, false) == CELSPAN_CANCELLED);
  CHECK_TEXT(celspan_context_error(context), "waited");
  CHECK(w.idle == 1 && w.delivered == 0 && w.faults == 0);
}

/* ---------------------------------------------------------------- shortage */

static void check_memory(int threads) {
  celspan_status status = CELSPAN_NO_MEMORY;
  for (size_t n = 1; status == CELSPAN_NO_MEMORY; n++) {
    memory_watch watch = {0};
    celspan_context *context = memory_watch_context(&watch);
    watch.allocations = 0;
    watch.fail_at = n;
    works w = quiet();
    status = run(&w, context, threads, true);
    CHECK(w.delivered == (status == CELSPAN_OK ? ITEMS : 0) && w.faults == 0);
    celspan_context_destroy(context);
    CHECK(watch.blocks == 0 && watch.size_errors == 0);
  }
  CHECK(status == CELSPAN_OK);
}

static void check_threads(celspan_context *context, int threads) {
  for (int given = 0; given < threads; given++) {
    works w = quiet();
    threads_left = given;
    CHECK(run(&w, context, threads, true) == CELSPAN_OK);
    CHECK(w.delivered == ITEMS && w.faults == 0);
    for (int i = 0; i < ITEMS; i++)
      CHECK(w.made_by[i] <= given);
  }
  threads_left = INT32_MAX;
}

/* ---------------------------------------------------------------- fork and join */

typedef struct tally {
  atomic_int times[ITEMS];
  atomic_int faults;
  int workers;
} tally;

static void count_step(void *user, int worker, int32_t i) {
  tally *t = user;
  t->faults += worker < 0 || worker >= t->workers;
  t->times[i]++;
}

static void check_pool(int workers, int given) {
  tally t = {.workers = workers};
  threads_left = given;
  cs_thread_pool_run(workers, ITEMS, count_step, &t);
  threads_left = INT32_MAX;
  CHECK(t.faults == 0);
  for (int i = 0; i < ITEMS; i++)
    CHECK(t.times[i] == 1);
}

/* Uses a megabyte of the stack. */
__attribute__((noinline)) static void go_deep(void) {
  volatile char deep[1 << 20];
  for (size_t at = 0; at < sizeof deep; at += 1024)
    deep[at] = 1;
}

/* Worker 0 is the thread that called, whose stack is limited. */
static void step_deep(void *user, int worker, int32_t i) {
  (void)user, (void)i;
  if (worker > 0)
    go_deep();
}

/* The C library makes the stacks of threads as large as the limit with which a program begins. */
static void check_stack(char *program) {
  char deep[] = "deep", *arguments[] = {program, deep, NULL};
  int ending = -1;
  pid_t child = fork();
  if (child == 0) {
    struct rlimit limit;
    getrlimit(RLIMIT_STACK, &limit);
    limit.rlim_cur = 256 << 10;
    setrlimit(RLIMIT_STACK, &limit);
    execv(program, arguments);
    _exit(1);
  }
  CHECK(child > 0 && waitpid(child, &ending, 0) == child);
  CHECK(ending == 0);
}

int main(int count, char **arguments) {
  if (count > 1) {
    cs_thread_pool_run(4, ITEMS, step_deep, NULL);
    return 0;
  }
  check_stack(arguments[0]);
  static const int threads[] = {0, 1, 2, 7, 40};
  celspan_context *context = NULL;
  if (celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  for (size_t i = 0; i < sizeof threads / sizeof *threads; i++)
    for (int claims = threads[i] == 0; claims <= 1; claims++) {
      check_order(context, threads[i], claims);
      check_failing(context, threads[i], claims);
      check_cancelled(context, threads[i], claims);
    }
  check_idle(context);
  for (int n = 0; n <= 3; n++) {
    check_memory(n);
    check_threads(context, n);
    check_pool(n + 1, INT32_MAX);
    check_pool(n + 1, n / 2);
  }
  celspan_context_destroy(context);
  return check_done();
}
