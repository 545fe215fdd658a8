/* Random films, one after the other, in one process, one context and one Lua state: random sinks
 * and formats, pictures, text, defocus, workers, and in every second frame a fault of a random
 * kind. Their use of memory, descriptors and threads must not grow.
 *
 *   faults_soak SCRIPT ROOT MINUTES     SCRIPT: tests/faults/soak.lua
 *
 * A frame that fails must be the same afterwards as before. Figures are printed every minute; in
 * the end they are compared with those after a tenth of the time, or after WARM films if that is
 * later: by then everything that is ever used has been loaded. A slow build continues until it has
 * made as many films again.
 */
#include <dirent.h>
#include <errno.h>
#include <lauxlib.h>
#include <limits.h>
#include <malloc.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "base/context.h"
#include "output/sinks/temporary.h"
#include "tests/faults/stage.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

/* Growth of resident memory: pages between allocations, which cannot be returned. They come and go
 * with the largest films, so the least of the second half of the time counts. Sanitizers keep
 * freed memory, and records of accesses: with them resident memory is printed but not checked. */
#define BYTES_MORE ((long)16 << 20)
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define BYTES_MORE_RESIDENT LONG_MAX
#else
#define BYTES_MORE_RESIDENT BYTES_MORE
#endif

enum {
  PICTURES = 3, /* files that may be open, to be read further */
  WARM = 200
};

typedef struct figures {
  long resident;  /* bytes */
  long allocated; /* of these in allocated blocks, including those of libraries */
  long held;      /* of these by the context, after emptying its caches */
  int descriptors, threads;
} figures;

typedef struct soak {
  stage stage;
  test_random random;
  size_t films, frames, faults;
} soak;

/* ---------------------------------------------------------------- figures */

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int count_entries(const char *folder) {
  int count = 0;
  DIR *entries = opendir(folder);
  while (entries && readdir(entries))
    count++;
  if (entries)
    closedir(entries);
  return count - 2;
}

static long resident_bytes(void) {
  long pages = 0;
  FILE *file = fopen("/proc/self/statm", "r");
  if (!file || fscanf(file, "%*d %ld", &pages) != 1)
    pages = 0;
  if (file)
    fclose(file);
  return pages * sysconf(_SC_PAGESIZE);
}

/* Bytes allocated in the whole process and not freed; 0: unknown. */
static long allocated_bytes(void) {
#ifdef __GLIBC__
  malloc_trim(0); /* unused pages go back to the system */
  struct mallinfo2 info = mallinfo2();
  return (long)(info.uordblks + info.hblkhd);
#else
  return 0;
#endif
}

static figures measure(soak *k) {
  lua_gc(k->stage.L, LUA_GCCOLLECT);
  cs_context_trim(k->stage.context);
  long allocated = allocated_bytes();
  return (figures){resident_bytes(), allocated, (long)k->stage.watch.bytes,
                   count_entries("/proc/self/fd") - 1, count_entries("/proc/self/task")};
}

static void print(const soak *k, double minutes, figures f) {
  printf("%5.1f min: %7zu frames of %6zu films, %6zu faults; %6.1f MB resident, %6.2f MB "
         "allocated, %5.2f MB of them by the context, %d descriptors, %d threads\n",
         minutes, k->frames, k->films, k->faults, (double)f.resident / 1e6,
         (double)f.allocated / 1e6, (double)f.held / 1e6, f.descriptors, f.threads);
  fflush(stdout);
}

/* ---------------------------------------------------------------- films */

/* Replaces the film by a new one. */
static void take_film(soak *k) {
  lua_State *L = k->stage.L;
  lua_Integer seed = (lua_Integer)(random_bits(&k->random) >> 20);
  stage_item *item = &k->stage.items[0];
  lua_pushvalue(L, 1);
  lua_pushinteger(L, seed);
  lua_pushboolean(L, TEST_PICTURES && TEST_TYPE);
  if (!CHECK(lua_pcall(L, 2, 1, 0) == LUA_OK))
    fprintf(stderr, "seed %lld: %s\n", (long long)seed, lua_tostring(L, -1));
  lua_rawseti(L, LUA_REGISTRYINDEX, item->film);
  item->workers = 1 + random_below(&k->random, 3);
  k->films++;
}

static const char *pick_sink(soak *k) {
  static const char *const sinks[] = {"digest", "float", "rows",       "sink", "probe",
                                      "png",    "png16", "dither.png", "tga",  "span",
                                      "exr",    "tiff",  "jpg",        "ppm"};
  int count = (int)(sizeof sinks / sizeof *sinks) - (TEST_PICTURES ? 0 : 4);
  return sinks[random_below(&k->random, count)];
}

static void arm(soak *k) {
  static const int errors[] = {EIO, ENOSPC, EMFILE, EACCES, EINTR, FAULT_SHORT};
  bool is_for_good = random_below(&k->random, 2);
  int kind = random_below(&k->random, 4);
  fault_plan *plan = kind == 1 ? &k->stage.lua : kind == 2 ? &k->stage.host : &fault_calls;
  size_t at = 1 + (size_t)random_below(&k->random, kind < 2 ? 300 : 20);
  fault_calls.error = errors[random_below(&k->random, 6)];
  if (fault_calls.error == EINTR)
    is_for_good = false;
  k->stage.watch.allocations = 0;
  k->stage.watch.is_for_good = is_for_good;
  if (kind == 0)
    k->stage.watch.fail_at = at;
  else
    fault_arm(plan, at, is_for_good);
}

static bool any_name(const char *pattern, const char *name) {
  (void)pattern, (void)name;
  return true;
}

static bool is_same(const stage_outcome *a, const stage_outcome *b) {
  return a->status == b->status && a->has_result == b->has_result && a->result[0] == b->result[0] &&
         a->result[1] == b->result[1];
}

static void check_folder(const soak *k) {
  char pattern[512];
  snprintf(pattern, sizeof pattern, "%s/frame", k->stage.folder);
  cs_temporary_sweep(pattern, any_name);
  CHECK(stage_count_files(&k->stage) == 0);
}

/* A frame, the same with a fault, and the same once more. */
static void make_frames(soak *k) {
  stage_outcome before, out, after;
  const char *sink = pick_sink(k);
  stage_render(&k->stage, 0, sink, &before);
  if (!CHECK(before.status == CELSPAN_OK))
    fprintf(stderr, "  %s: %s\n", sink, before.sentence);
  k->frames++;
  if (random_below(&k->random, 2))
    return;
  arm(k);
  stage_render(&k->stage, 0, sink, &out);
  check_folder(k);
  stage_render(&k->stage, 0, sink, &after);
  k->frames += 2;
  k->faults += out.status != CELSPAN_OK;
  CHECK(out.status != CELSPAN_OK || is_same(&out, &before));
  if (!CHECK(is_same(&after, &before)))
    fprintf(stderr, "  %s: %s; after %s\n", sink, after.sentence, out.sentence);
}

/* ---------------------------------------------------------------- the run */

static void run(soak *k, double minutes) {
  double start = seconds(), end = start + 60 * minutes, next = start;
  long least = LONG_MAX;
  figures first = {0}, last = {0};
  while (seconds() < end || k->films < 2 * WARM) {
    take_film(k);
    for (int i = random_below(&k->random, 4); i >= 0; i--)
      make_frames(k);
    if (seconds() >= next) {
      print(k, (seconds() - start) / 60, last = measure(k));
      if (seconds() - start > 30 * minutes && last.resident < least)
        least = last.resident;
      next += 60 * (minutes < 10 ? minutes / 10 : 1);
    }
    if (first.resident == 0 && k->films >= WARM && seconds() - start > 6 * minutes)
      first = measure(k);
  }
  print(k, (seconds() - start) / 60, last = measure(k));
  least = last.resident < least ? last.resident : least;
  CHECK(first.resident > 0 && least - first.resident <= BYTES_MORE_RESIDENT);
  CHECK(last.allocated <= first.allocated + BYTES_MORE / 8);
  CHECK(last.held <= first.held + BYTES_MORE / 16);
  CHECK(last.descriptors <= first.descriptors + PICTURES && last.threads <= first.threads);
}

/* One heap for all threads: malloc_trim returns the free end of the first alone, and those of the
 * others keep up to 64 MB. Which thread begins one is a matter of time. */
static void share_heap(void) {
#ifdef __GLIBC__
  mallopt(M_ARENA_MAX, 1);
#endif
}

int main(int count, char **arguments) {
  share_heap();
  char folder[] = "/tmp/celspan-soak-XXXXXX";
  if (count < 4 || !mkdtemp(folder))
    return 1;
  const char *seed = getenv("CELSPAN_SEED");
  soak k = {.random = {seed ? strtoull(seed, NULL, 10) : 1}};
  if (!stage_open(&k.stage, arguments[1], arguments[2], folder))
    return 1;
  lua_pushboolean(k.stage.L, false);
  k.stage.items[0].film = luaL_ref(k.stage.L, LUA_REGISTRYINDEX);
  run(&k, strtod(arguments[3], NULL));
  stage_close(&k.stage);
  CHECK(rmdir(folder) == 0);
  return check_done();
}
