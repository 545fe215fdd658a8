/* Every call of a render fails in turn: an allocation of the core or of Lua, a call to the system,
 * a function of the host; once, and with all that follow. Whichever it is,
 *
 *   - the render ends with the same result as without faults, or with the status and the sentence
 *     of the fault, and then without a file, or with the complete one if it already had its name;
 *   - no temporary file and no memory is left;
 *   - the same context and the same Lua state then make the same frame, to the bit.
 *
 *   faults_sweep SCRIPT ROOT [NAME]    SCRIPT: tests/faults/renders.lua; ROOT: the folder of the
 *                                      tree; NAME: one render alone
 *
 * Where a render makes many calls of a kind, some of them are selected at random, by CELSPAN_SEED,
 * and of these one in CELSPAN_FAULTS. With CELSPAN_STARVE=1 all are tried, and with
 * CELSPAN_STARVE=memory every allocation of the core, once.
 */
#include <errno.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/context.h"
#include "base/open.h"
#include "output/sinks/temporary.h"
#include "tests/faults/stage.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

enum { SAMPLES = 10, SYSTEM_SAMPLES = 4 /* for each errno */, TRIES_MOST = 1000000 };

typedef enum fault_kind { OF_MEMORY, OF_LUA, OF_HOST, OF_SYSTEM, KINDS } fault_kind;

static const char *const kind_names[KINDS] = {"allocation", "allocation of Lua", "call of the host",
                                              "call to the system"};

typedef struct sweep {
  const char *script, *root, *folder;
  const char *starve; /* CELSPAN_STARVE: NULL, or what is tried without sampling */
  test_random random;
  stage stage;
  size_t tries, faults;
  int sample; /* the number of the next one */
  /* the current try */
  size_t render;
  const char *name, *sink;
  bool is_cold;    /* every try in a stage of its own */
  bool leaves_out; /* files that cannot be found may be left out */
  fault_kind kind;
  bool is_for_good; /* all calls after the n-th fail too */
  int error;        /* of calls to the system */
  stage_outcome wanted;
} sweep;

/* ---------------------------------------------------------------- one try */

static void arm(sweep *w, size_t at) {
  stage *s = &w->stage;
  if (w->kind == OF_MEMORY) {
    s->watch.allocations = 0;
    s->watch.is_for_good = w->is_for_good;
    s->watch.fail_at = at;
  } else if (w->kind == OF_SYSTEM) {
    fault_calls.error = w->error;
    fault_arm(&fault_calls, at, w->is_for_good);
  } else {
    fault_arm(w->kind == OF_LUA ? &s->lua : &s->host, at, w->is_for_good);
  }
}

static size_t count_made(const sweep *w) {
  const stage *s = &w->stage;
  return w->kind == OF_MEMORY   ? s->watch.allocations
         : w->kind == OF_SYSTEM ? fault_calls.made
         : w->kind == OF_LUA    ? s->lua.made
                                : s->host.made;
}

static bool is_wanted(const sweep *w, const stage_outcome *out) {
  return out->has_result && out->result[0] == w->wanted.result[0] &&
         out->result[1] == w->wanted.result[1];
}

/* Calls that a signal may interrupt are repeated, and incomplete reads and writes are continued. */
static bool is_invisible(const sweep *w) {
  static const char *const interruptible =
      " open64 openat64 read write pread64 pwrite64 fsync close ";
  char call[32];
  if (w->kind != OF_SYSTEM || !fault_calls.call)
    return false;
  snprintf(call, sizeof call, " %s ", fault_calls.call);
  return w->error == FAULT_SHORT || (w->error == EINTR && strstr(interruptible, call));
}

/* Modules are searched in many places: one that cannot be accessed has none. */
static bool is_search(void) { return strstr(" access realpath readlink ", fault_calls.call); }

/* If a module is found nowhere, the message only lists the possible remedies. */
static bool is_absence_right(const sweep *w, const stage_outcome *out) {
  return w->error == ENOENT && strstr(out->sentence, "which was not found");
}

/* If closing a file fails after it was read, the file is valid; a later fault decides then. */
static bool may_leave_out(const sweep *w) {
  return w->leaves_out && w->kind == OF_SYSTEM && fault_calls.call &&
         (is_search() || strcmp(fault_calls.call, "close") == 0 || cs_open_is_about_file(w->error));
}

static bool is_status_right(const sweep *w, const stage_outcome *out) {
  celspan_status status = out->status;
  switch (w->kind) {
  case OF_MEMORY:
  case OF_LUA:
    return status == CELSPAN_NO_MEMORY;
  case OF_HOST:
    return status == CELSPAN_CALLBACK || status == CELSPAN_CANCELLED;
  default:
    return (status == CELSPAN_INPUT || status == CELSPAN_OUTPUT || status == CELSPAN_CALLBACK) &&
           (strstr(out->sentence, strerror(w->error)) || is_absence_right(w, out));
  }
}

static bool any_name(const char *pattern, const char *name) {
  (void)pattern, (void)name;
  return true;
}

/* Whether a temporary file may be left: it could not be removed, or its lock was reported as held
 * by another process, which removes it. */
static bool may_be_left(const sweep *w) {
  if (w->kind != OF_SYSTEM || fault_calls.failed == 0)
    return false;
  return w->is_for_good || strcmp(fault_calls.call, "unlink") == 0 ||
         (strcmp(fault_calls.call, "flock") == 0 && w->error == EWOULDBLOCK);
}

/* A later render finds the remaining files and removes them. */
static bool is_folder_empty(const sweep *w) {
  char pattern[512];
  snprintf(pattern, sizeof pattern, "%s/frame", w->folder);
  if (may_be_left(w))
    cs_temporary_sweep(pattern, any_name);
  return stage_count_files(&w->stage) == 0;
}

static void tell(const sweep *w, size_t at, const stage_outcome *out) {
  char call[128] = "";
  if (check_failures > 20)
    return;
  if (w->kind == OF_SYSTEM)
    snprintf(call, sizeof call, " (%s, %s)", fault_calls.call ? fault_calls.call : "none",
             w->error == FAULT_SHORT ? "short" : strerror(w->error));
  fprintf(stderr, "  %s to %s: %s %zu%s%s: %s: %s\n", w->name, w->sink, kind_names[w->kind], at,
          call, w->is_for_good ? " and all after it" : "", celspan_status_name(out->status),
          out->sentence);
}

/* Empties the caches of this context. */
static void forget(sweep *w) {
  lua_gc(w->stage.L, LUA_GCCOLLECT); /* first: what nobody uses any more may still be cached */
  cs_context_trim(w->stage.context);
}

/* The `at`-th call fails; then the frame is made again. false: there were fewer calls. */
static bool try_one(sweep *w, size_t at) {
  stage_outcome out;
  if (w->is_cold && !stage_open(&w->stage, w->script, w->root, w->folder))
    return false;
  forget(w);
  arm(w, at);
  stage_render(&w->stage, w->render, w->sink, &out);
  bool has_come = count_made(w) >= at;
  w->tries++;
  w->faults += has_come;
  bool is_right = out.status == CELSPAN_OK
                      ? is_wanted(w, &out) || may_leave_out(w)
                      : has_come && !is_invisible(w) && is_status_right(w, &out) &&
                            (!out.has_result || is_wanted(w, &out));
  bool is_clean = CHECK(is_folder_empty(w));
  if (!CHECK(is_right) || !is_clean)
    tell(w, at, &out);
  stage_render(&w->stage, w->render, w->sink, &out);
  if (!CHECK(out.status == CELSPAN_OK && is_wanted(w, &out)))
    tell(w, at, &out);
  if (w->is_cold)
    stage_close(&w->stage);
  return has_come;
}

/* ---------------------------------------------------------------- all tries */

/* How many calls of a kind there are in all. */
static size_t count_calls(sweep *w, fault_kind kind) {
  stage_outcome out;
  w->kind = kind;
  w->is_for_good = false;
  if (w->is_cold && !stage_open(&w->stage, w->script, w->root, w->folder))
    return 0;
  forget(w);
  arm(w, (size_t)-1);
  stage_render(&w->stage, w->render, w->sink, &out);
  size_t count = count_made(w);
  if (w->is_cold)
    stage_close(&w->stage);
  return count;
}

static bool is_whole(const sweep *w) {
  bool is_memory = w->starve && strcmp(w->starve, "memory") == 0;
  return is_memory ? w->kind == OF_MEMORY && !w->is_for_good : w->starve != NULL;
}

/* count: of the calls of this kind. */
static void try_all(sweep *w, fault_kind kind, size_t count, bool is_for_good, int error) {
  w->kind = kind;
  w->is_for_good = is_for_good;
  w->error = error;
  int samples = kind == OF_SYSTEM ? SYSTEM_SAMPLES : SAMPLES;
  if (is_whole(w)) {
    for (size_t at = 1; at < TRIES_MOST && try_one(w, at); at++)
      continue;
    return;
  }
  bool is_each = count <= (size_t)samples; /* and one beyond them, which is not reached */
  for (size_t i = 1; i <= (is_each ? count + 1 : (size_t)samples); i++)
    if (check_is_drawn_by("CELSPAN_FAULTS", w->sample++))
      try_one(w, is_each ? i : 1 + (size_t)(random_bits(&w->random) % count));
}

/* The bytes that are still allocated after all caches are emptied. */
static size_t count_held(sweep *w) {
  forget(w);
  return w->stage.watch.bytes;
}

static void sweep_sink(sweep *w) {
  static const int errors[] = {EIO,    ENOSPC, EDQUOT, EACCES,       EROFS,      EMFILE,
                               ENOENT, EAGAIN, EINTR,  ENAMETOOLONG, FAULT_SHORT};
  stage_render(&w->stage, w->render, w->sink, &w->wanted);
  if (!CHECK(w->wanted.status == CELSPAN_OK && w->wanted.has_result)) {
    fprintf(stderr, "  %s to %s: %s\n", w->name, w->sink, w->wanted.sentence);
    return;
  }
  size_t held = count_held(w);
  if (w->is_cold)
    stage_close(&w->stage);
  size_t counts[KINDS];
  for (int kind = 0; kind < KINDS; kind++)
    counts[kind] = count_calls(w, (fault_kind)kind);
  for (int i = 0; i < 2; i++) {
    try_all(w, OF_MEMORY, counts[OF_MEMORY], i, 0);
    try_all(w, OF_LUA, counts[OF_LUA], i, 0);
    try_all(w, OF_HOST, counts[OF_HOST], i, 0);
    for (size_t k = 0; k < sizeof errors / sizeof *errors; k++)
      if (!(errors[k] == EINTR && i)) /* with endless signals nothing ends */
        try_all(w, OF_SYSTEM, counts[OF_SYSTEM], i, errors[k]);
  }
  if (w->is_cold) {
    CHECK(stage_open(&w->stage, w->script, w->root, w->folder));
    return;
  }
  /* A render without faults first: after the last one that was tried, its message is still held. */
  count_calls(w, OF_MEMORY);
  size_t still_held = count_held(w);
  if (!CHECK(still_held <= held))
    fprintf(stderr, "  %s to %s: %zu bytes were held before, %zu are after\n", w->name, w->sink,
            held, still_held);
}

static bool is_skipped(const sweep *w) {
  bool has_modules = TEST_PICTURES || !stage_render_text(&w->stage, w->render, "has_modules");
  bool has_type = TEST_TYPE || !stage_render_text(&w->stage, w->render, "has_type");
  return !has_modules || !has_type;
}

static void sweep_render(sweep *w, size_t render) {
  char name[64];
  snprintf(name, sizeof name, "%s", stage_render_text(&w->stage, render, "name"));
  w->name = name;
  w->render = render;
  if (is_skipped(w)) {
    check_skip(name);
    return;
  }
  w->is_cold = stage_render_text(&w->stage, render, "is_cold");
  w->leaves_out = stage_render_text(&w->stage, render, "leaves_out");
  char sink[32];
  w->sink = sink;
  for (size_t i = 0;; i++) {
    const char *found = stage_render_sink(&w->stage, render, i);
    if (!found)
      break;
    snprintf(sink, sizeof sink, "%s", found);
    sweep_sink(w);
  }
  fprintf(stderr, "%s: %zu tries, %zu faults so far\n", name, w->tries, w->faults);
}

int main(int count, char **arguments) {
  char folder[] = "/tmp/celspan-test-faults-XXXXXX";
  const char *seed = getenv("CELSPAN_SEED");
  if (count < 3 || !mkdtemp(folder))
    return 1;
  sweep w = {.script = arguments[1],
             .root = arguments[2],
             .folder = folder,
             .starve = getenv("CELSPAN_STARVE"),
             .random = {seed ? strtoull(seed, NULL, 10) : 1}};
  if (!stage_open(&w.stage, w.script, w.root, w.folder))
    return 1;
  for (size_t i = 0; i < w.stage.item_count; i++) {
    const char *name = stage_render_text(&w.stage, i, "name");
    if (check_is_for_threads() && w.stage.items[i].workers == 1)
      continue;
    if (count < 4 || strcmp(name, arguments[3]) == 0)
      sweep_render(&w, i);
  }
  stage_close(&w.stage);
  CHECK(rmdir(folder) == 0);
  CHECK(w.faults > 0);
  return check_done();
}
