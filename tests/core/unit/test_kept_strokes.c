/* model/stroke/kept.c: an outline that is found again is the one that would be made, it serves all
 * places and threads, and the memory for it is never exceeded for long.
 */
#include "model/stroke/kept.h"

#include "base/thread_pool.h"
#include "model/stroke/outliner.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"

enum { SIDE = 1000, THREADS = 4, PLACES = 60 };

static celspan_context *context_of(memory_watch *watch, size_t bytes) {
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  desc.resize = memory_watch_resize;
  desc.resize_user = watch;
  desc.defocus_bytes = bytes;
  celspan_context *context = NULL;
  CHECK(celspan_context_create(&desc, &context) == CELSPAN_OK);
  return context;
}

static celspan_stroke_desc desc_of(double width) {
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  desc.data = "M20 20C60 -10 90 80 60 60S10 70 40 30L80 20";
  desc.width = width;
  desc.cap = CELSPAN_STROKE_CAP_ROUND;
  desc.join = CELSPAN_STROKE_JOIN_ROUND;
  return desc;
}

static celspan_status make_stroke(celspan_context *context, double width, cs_stroke *stroke) {
  celspan_stroke_desc desc = desc_of(width);
  return cs_stroke_init(context, stroke, &desc, NULL, NULL);
}

static cs_stroke_view view_of(double scale, double x, double y) {
  return (cs_stroke_view){.matrix = {{scale, 0, x, 0, scale, y, 0, 0, 1}},
                          .frame = {0, SIDE, 0, SIDE},
                          .tolerance = CS_STROKE_TOLERANCE,
                          .bottom = SIDE,
                          .right = SIDE};
}

static bool is_same(const cs_outline *a, const cs_outline *b) {
  return a->point_count == b->point_count && a->piece_count == b->piece_count &&
         a->contour_count == b->contour_count &&
         memcmp(a->points, b->points, a->point_count * sizeof *a->points) == 0 &&
         memcmp(a->degrees, b->degrees, a->piece_count) == 0;
}

/* Found again wherever the stroke is moved to, and the same as without the cache; made again for
 * another scale, and for another stroke. */
static void check_places(size_t bytes) {
  memory_watch watch = {0};
  celspan_context *context = context_of(&watch, bytes);
  cs_stroke strokes[2];
  CHECK(make_stroke(context, 3, &strokes[0]) == CELSPAN_OK);
  CHECK(make_stroke(context, 4, &strokes[1]) == CELSPAN_OK);
  for (int i = 0; i < PLACES; i++) {
    const cs_stroke *stroke = &strokes[i % 2];
    cs_stroke_view view = view_of(i % 4 < 2 ? 1 : 2, 300 + 3.7 * i, 200 + 0.1 * i);
    CHECK(cs_stroke_kept_suits(stroke, &view));
    cs_stroke_kept *kept = NULL;
    CHECK(cs_stroke_kept_acquire(context, stroke, &view, &kept) == CELSPAN_OK);
    cs_outline wanted;
    cs_outline_init(&wanted);
    CHECK(cs_stroke_outline(context, stroke, &view, &wanted) == CELSPAN_OK);
    CHECK(is_same(&kept->outline, &wanted));
    cs_outline_finish(&wanted, context->memory);
    cs_stroke_kept_release(context, kept);
  }
  cs_cache_counts counts = cs_stroke_kept_count(context);
  CHECK(counts.made == (bytes ? 4 : PLACES));
  CHECK(bytes ? counts.bytes > 0 : counts.bytes == 0);
  for (int i = 0; i < 2; i++)
    cs_stroke_finish(&strokes[i], context->memory);
  celspan_context_destroy(context);
  CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
}

/* What the frame cuts, and perspective, are not kept. The rows that are asked for do not matter. */
static void check_suits(void) {
  memory_watch watch = {0};
  celspan_context *context = context_of(&watch, 1 << 20);
  cs_stroke stroke;
  CHECK(make_stroke(context, 3, &stroke) == CELSPAN_OK);
  cs_stroke_view cut = view_of(1, -40, 100), far = view_of(1, 300, 300);
  cs_stroke_view part = view_of(1, 300, 300), large = view_of(20, 0, 0);
  far.matrix.m[6] = 1e-5;
  part.bottom = 320;
  CHECK(!cs_stroke_kept_suits(&stroke, &cut) && !cs_stroke_kept_suits(&stroke, &far));
  CHECK(!cs_stroke_kept_suits(&stroke, &large) && cs_stroke_kept_suits(&stroke, &part));
  cs_stroke_finish(&stroke, context->memory);
  celspan_context_destroy(context);
}

/* Each pane of a crowded frame would make all dashes of a stroke that is kept whole. */
static void check_dashes(void) {
  memory_watch watch = {0};
  celspan_context *context = context_of(&watch, 1 << 20);
  for (int i = 0; i < 2; i++) {
    const double dash = i == 0 ? 1 : 0.01;
    const cs_stroke_view view = view_of(1, 300, 300);
    celspan_stroke_desc desc = desc_of(3);
    cs_stroke stroke;
    desc.dashes = &dash;
    desc.dash_count = 1;
    CHECK(cs_stroke_init(context, &stroke, &desc, NULL, NULL) == CELSPAN_OK);
    CHECK(cs_stroke_kept_suits(&stroke, &view) == (i == 0));
    cs_stroke_finish(&stroke, context->memory);
  }
  celspan_context_destroy(context);
}

/* Widths that change in every frame do not fill the memory. */
static void check_budget(void) {
  enum { BYTES = 1 << 20, FRAMES = 500, SHARE = BYTES / 32 };
  memory_watch watch = {0};
  celspan_context *context = context_of(&watch, BYTES);
  const cs_stroke_view view = view_of(1, 300, 300);
  for (int i = 0; i < FRAMES; i++) {
    cs_stroke stroke;
    cs_stroke_kept *kept = NULL;
    CHECK(make_stroke(context, 2 + 0.01 * i, &stroke) == CELSPAN_OK);
    CHECK(cs_stroke_kept_acquire(context, &stroke, &view, &kept) == CELSPAN_OK);
    cs_stroke_kept_release(context, kept);
    cs_stroke_finish(&stroke, context->memory);
    CHECK(cs_stroke_kept_count(context).bytes <= SHARE);
  }
  CHECK(cs_stroke_kept_count(context).bytes > SHARE / 2);
  celspan_context_destroy(context);
}

/* ---------------------------------------------------------------- threads and shortage */

typedef struct job {
  celspan_context *contexts[THREADS];
  const cs_stroke *stroke;
  atomic_int wrong;
} job;

static void work(void *user, int thread, int32_t index) {
  job *j = user;
  (void)thread;
  celspan_context branch;
  cs_context_branch(&branch, j->contexts[index]);
  for (int i = 0; i < PLACES; i++) {
    const cs_stroke_view view = view_of(1 + i % 5, 100 + i, 200);
    cs_stroke_kept *kept;
    if (cs_stroke_kept_acquire(&branch, j->stroke, &view, &kept) != CELSPAN_OK) {
      j->wrong++;
      continue;
    }
    j->wrong += kept->outline.piece_count == 0;
    cs_stroke_kept_release(&branch, kept);
  }
}

/* One stroke in threads of two contexts. */
static void check_threads(void) {
  memory_watch watch = {0};
  celspan_context *contexts[2] = {context_of(&watch, 1 << 22), context_of(&watch, 1 << 22)};
  cs_stroke stroke;
  CHECK(make_stroke(contexts[0], 3, &stroke) == CELSPAN_OK);
  job j = {.stroke = &stroke};
  for (int i = 0; i < THREADS; i++)
    j.contexts[i] = contexts[i % 2];
  cs_thread_pool_run(THREADS, THREADS, work, &j);
  CHECK(j.wrong == 0);
  for (int i = 0; i < 2; i++)
    CHECK(cs_stroke_kept_count(contexts[i]).made == 5);
  cs_stroke_finish(&stroke, contexts[0]->memory);
  celspan_context_destroy(contexts[0]);
  celspan_context_destroy(contexts[1]);
  CHECK(watch.blocks == 0 && watch.bytes == 0);
}

/* Every allocation fails once: a failure says so, and leaves nothing behind. */
static void check_memory(void) {
  celspan_status status = CELSPAN_NO_MEMORY;
  int failures = 0;
  for (size_t n = 1; status == CELSPAN_NO_MEMORY; n++, failures++) {
    memory_watch watch = {0};
    celspan_context *context = context_of(&watch, 1 << 20);
    const cs_stroke_view view = view_of(1, 300, 300);
    cs_stroke stroke;
    cs_stroke_kept *kept = NULL;
    CHECK(make_stroke(context, 3, &stroke) == CELSPAN_OK);
    watch.fail_at = watch.allocations + n;
    status = cs_stroke_kept_acquire(context, &stroke, &view, &kept);
    if (status == CELSPAN_OK)
      cs_stroke_kept_release(context, kept);
    cs_stroke_finish(&stroke, context->memory);
    celspan_context_destroy(context);
    CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  }
  CHECK(status == CELSPAN_OK && failures > 4);
}

int main(void) {
  check_places(1 << 22);
  check_places(0);
  check_suits();
  check_dashes();
  check_budget();
  check_threads();
  check_memory();
  return check_done();
}
