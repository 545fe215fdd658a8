/* The sweep by events: courses keep areas, and parts have at every height the windings that the
 * chains there add up to. Random drawings of triangles, rectangles on whole pixels and ellipses,
 * many of which share corners and edges.
 */
#include "engine/events/events.h"
#include "model/geometry/boundary_build.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"
#include "tests/support/random.h"

#define WIDTH 100
#define HEIGHT 80
#define ZONE 16
#define LAYERS 12
#define DRAWINGS 300
#define HEIGHTS 40
#define PI 3.14159265358979323846

static celspan_context *context;
static const cs_cull no_cull = {0};
static const cs_events_rows all_rows = {0, HEIGHT, HEIGHT, ZONE};
static const cs_events_limits no_limits = {SIZE_MAX, SIZE_MAX, 0};
static const cs_events_limits limits[] = {{20, 20, 0}, {SIZE_MAX, 8, 1}};
#define LIMITS 2
static int missing_count[LIMITS]; /* drawings of which zones are missing, but not all */

#define MUST(call) CHECK((call) == CELSPAN_OK)

static void add(cs_boundary_set *set, const cs_outline *outline, uint32_t layer) {
  const cs_boundary_frame frame = {-1, WIDTH + 1, -1, HEIGHT + 1};
  const celspan_matrix matrix = celspan_matrix_identity();
  cs_boundary_builder builder;
  cs_boundary_builder_init(&builder, context, set, &frame);
  MUST(cs_boundary_add(&builder, outline, &matrix, layer));
  cs_boundary_builder_finish(&builder);
}

static void random_outline(test_random *random, cs_outline *out) {
  celspan_point corners[5];
  int kind = random_below(random, 5), count = 3 + random_below(random, 3);
  for (int k = 0; k < count; k++) {
    corners[k] = random_point(random, 0, WIDTH, 0, HEIGHT);
    if (kind != 0)
      corners[k] = (celspan_point){10 * floor(corners[k].x / 10), 10 * floor(corners[k].y / 10)};
    if (kind == 4) { /* edges that hardly differ from those of others */
      celspan_point shift = random_point(random, -4, 4, -4, 4);
      corners[k].x += shift.x / CS_COURSE_UNIT;
      corners[k].y += shift.y / CS_COURSE_UNIT;
    }
  }
  if (kind <= 1 || kind == 4)
    MUST(cs_outline_polygon(context, out, corners, (size_t)count));
  else if (kind == 2)
    MUST(cs_outline_rect(context, out, corners[0].x, corners[0].y, 20, 30, 0));
  else
    MUST(cs_outline_ellipse(context, out, corners[0], 5 * count, 4 * count));
}

static cs_boundary_set random_drawing(uint64_t seed) {
  test_random random = {seed};
  cs_boundary_set set;
  cs_boundary_init(&set);
  int count = 1 + random_below(&random, 40);
  for (int i = 0; i < count; i++) {
    cs_outline outline;
    cs_outline_init(&outline);
    random_outline(&random, &outline);
    add(&set, &outline, (uint32_t)random_below(&random, LAYERS));
    cs_outline_finish(&outline, context->memory);
  }
  MUST(cs_boundary_sort(context, &set));
  return set;
}

/* ---------------------------------------------------------------- parts at a height */

typedef struct crossed {
  double x;
  uint32_t chain, left, right;
  bool is_near_event; /* it begins or ends within two units of the height */
} crossed;

static int by_x(const void *a, const void *b) {
  const crossed *p = a, *q = b;
  return (p->x > q->x) - (p->x < q->x);
}

static double x_of(const cs_courses *courses, uint32_t chain, int32_t y) {
  const cs_course_point *at = courses->points + courses->courses[chain].first;
  while (at[1].y <= y)
    at++;
  return cs_course_x(at, y);
}

static size_t list_crossed(const cs_events *events, int32_t y, crossed *out) {
  size_t count = 0;
  for (size_t i = 0; i < events->part_count; i++) {
    const cs_events_part *f = &events->parts[i];
    if (f->top <= y && y < f->foot)
      out[count++] = (crossed){x_of(&events->courses, f->course, y), f->course, f->left, f->right,
                               y < f->top + 2 || y >= f->foot - 2};
  }
  qsort(out, count, sizeof *out, by_x);
  return count;
}

/* The windings of a number, by the way on which they were found. */
static void windings_of(const cs_windings *windings, const cs_boundary_set *set, uint32_t number,
                        int *out) {
  memset(out, 0, LAYERS * sizeof *out);
  for (; number != 0; number = windings->entries[number].parent) {
    const cs_boundary_chain *chain = &set->chains[windings->entries[number].boundary];
    out[chain->layer] += chain->direction;
  }
}

/* Those between parts that are clearly apart must be the sum of all boundaries on the left. */
static void check_order(const cs_events *events, const cs_boundary_set *set, const crossed *at,
                        size_t count) {
  int sum[LAYERS] = {0}, found[LAYERS];
  for (size_t k = 0; k < count; k++) {
    const cs_boundary_chain *chain = &set->chains[at[k].chain];
    sum[chain->layer] += chain->direction;
    bool is_clear = k + 1 == count || at[k + 1].x > at[k].x + 8;
    if (!is_clear || at[k].is_near_event || (k + 1 < count && at[k + 1].is_near_event))
      continue;
    /* of several that lie closely together the rightmost in the list is not known */
    if (k > 0 && at[k].x < at[k - 1].x + 8)
      continue;
    windings_of(&events->windings, set, at[k].right, found);
    CHECK(memcmp(sum, found, sizeof sum) == 0);
    if (k + 1 < count && (k + 2 >= count || at[k + 2].x > at[k + 1].x + 8))
      CHECK(at[k + 1].left == at[k].right);
  }
}

/* Each of the windings must begin as often as it ends, so that all sums along the height close. */
static void check_balance(const cs_events *events, const crossed *at, size_t count) {
  int *balance = calloc(events->windings.count, sizeof *balance);
  for (size_t k = 0; k < count; k++) {
    balance[at[k].left]--;
    balance[at[k].right]++;
  }
  bool is_even = true;
  for (size_t i = 0; i < events->windings.count; i++)
    is_even = is_even && balance[i] == 0;
  CHECK(is_even);
  free(balance);
}

static void test_drawings(void) {
  for (uint64_t seed = 0; seed < DRAWINGS; seed++) {
    test_random random = {seed + 1000};
    cs_boundary_set set = random_drawing(seed);
    cs_events events;
    MUST(cs_events_find(context, &set, &no_cull, all_rows, no_limits, &events));
    CHECK(events.missing == 0);
    crossed *at = calloc(events.part_count + 1, sizeof *at);
    for (int k = 0; k < HEIGHTS; k++) {
      double y = random_between(&random, 0, HEIGHT * CS_COURSE_UNIT);
      int32_t whole = (int32_t)(k % 4 == 0 ? floor(y / CS_COURSE_UNIT) * CS_COURSE_UNIT : y);
      size_t count = list_crossed(&events, whole, at);
      check_balance(&events, at, count);
      check_order(&events, &set, at, count);
    }
    free(at);
    cs_events_finish(&events, context->memory);
    cs_boundary_finish(&set, context->memory);
  }
}

/* ---------------------------------------------------------------- some rows */

/* A part, cut at the ends of some rows. */
typedef struct cut_part {
  uint64_t windings[4];
  uint32_t course;
  int32_t top, foot;
} cut_part;

static int by_place(const void *a, const void *b) {
  const cut_part *p = a, *q = b;
  return p->course != q->course ? (p->course > q->course) - (p->course < q->course)
                                : (p->top > q->top) - (p->top < q->top);
}

static cut_part *cut_parts(const cs_events *events, int32_t top, int32_t foot, size_t *count) {
  cut_part *out = calloc(events->part_count + 1, sizeof *out);
  *count = 0;
  for (size_t i = 0; i < events->part_count; i++) {
    const cs_events_part *f = &events->parts[i];
    const cs_windings_hash left = events->windings.entries[f->left].hash,
                           right = events->windings.entries[f->right].hash;
    cut_part part = {.windings = {left.a, left.b, right.a, right.b}, .course = f->course};
    part.top = f->top > top ? f->top : top;
    part.foot = f->foot < foot ? f->foot : foot;
    if (part.top < part.foot)
      out[(*count)++] = part;
  }
  qsort(out, *count, sizeof *out, by_place);
  return out;
}

/* The parts of each zone, one that crosses several zones being one in each. */
static size_t count_crossing(const cs_events *events, int32_t first, int32_t end) {
  size_t count = 0;
  for (int32_t row = first; row < end; row += ZONE)
    for (size_t i = 0; i < events->part_count; i++)
      count += events->parts[i].top < (row + ZONE) * CS_COURSE_UNIT &&
               events->parts[i].foot > row * CS_COURSE_UNIT;
  return count;
}

/* A sweep of some rows must find the parts that the sweep of all rows has there. */
static void check_rows(const cs_boundary_set *set, const cs_cull *cull, const cs_events *whole,
                       int32_t first, int32_t end) {
  cs_events some;
  size_t count, found_count;
  int32_t top = (first - first % 8) * CS_COURSE_UNIT, foot = end * CS_COURSE_UNIT;
  MUST(cs_events_find(context, set, cull, (cs_events_rows){first, end, HEIGHT, ZONE}, no_limits,
                      &some));
  cut_part *parts = cut_parts(whole, top, foot, &count);
  cut_part *found = cut_parts(&some, top, foot, &found_count);
  CHECK(found_count == count && memcmp(parts, found, count * sizeof *parts) == 0);
  CHECK(found_count == some.part_count);
  free(parts);
  free(found);
  cs_events_finish(&some, context->memory);
}

/* Of a drawing in which the nearest layers hide the layers behind them. */
static cs_cull make_cull(const cs_boundary_set *set) {
  cs_cull cull;
  cs_cull_layer layers[LAYERS];
  for (int i = 0; i < LAYERS; i++)
    layers[i] = (cs_cull_layer){
        .through = i < LAYERS / 2 ? 1 : 0, .winding_mask = -1, .group = CS_CULL_NONE};
  const cs_cull_desc desc = {.set = set,
                             .layers = layers,
                             .layer_count = LAYERS,
                             .width = WIDTH,
                             .height = HEIGHT,
                             .opaque = 0.001,
                             .workers = 1};
  MUST(cs_cull_create(context, &desc, &cull));
  return cull;
}

/* Which zones of the rows from `first` on have too many windings, and how many parts the others
 * have. */
static uint64_t find_missing(const cs_boundary_set *set, const cs_cull *cull, int32_t first,
                             int32_t end, const cs_events_limits *limit, size_t *parts) {
  cs_events events;
  MUST(cs_events_find(context, set, cull, (cs_events_rows){first, end, HEIGHT, ZONE}, *limit,
                      &events));
  const uint64_t missing = events.missing;
  *parts += count_crossing(&events, first, end);
  cs_events_finish(&events, context->memory);
  return missing;
}

/* Whether a zone has too many windings must not depend on which others are swept. */
static void check_zones(const cs_boundary_set *set, const cs_cull *cull, int k) {
  size_t parts = 0, parts_alone = 0;
  uint64_t missing = find_missing(set, cull, 0, HEIGHT, &limits[k], &parts), alone = 0;
  for (int32_t row = 0; row < HEIGHT; row += ZONE)
    alone |= find_missing(set, cull, row, row + ZONE, &limits[k], &parts_alone);
  CHECK(missing == alone);
  CHECK(parts == parts_alone);
  missing_count[k] += missing != 0 && missing != 31;
}

static void check_drawing(const cs_boundary_set *set, const cs_cull *cull, test_random *random) {
  for (int k = 0; k < LIMITS; k++)
    check_zones(set, cull, k);
  cs_events events;
  MUST(cs_events_find(context, set, cull, all_rows, no_limits, &events));
  for (int k = 0; k < 4; k++) {
    int first = random_below(random, HEIGHT), end = first + random_below(random, HEIGHT - first);
    check_rows(set, cull, &events, k < 2 ? first - first % 8 : first, end);
  }
  cs_events_finish(&events, context->memory);
}

static void test_rows(void) {
  size_t deferred = 0;
  for (uint64_t seed = 0; seed < DRAWINGS; seed++) {
    test_random random = {seed + 2000};
    cs_boundary_set set = random_drawing(seed);
    cs_cull cull = make_cull(&set);
    check_drawing(&set, &no_cull, &random);
    check_drawing(&set, &cull, &random);
    deferred += cull.deferred_count;
    cs_cull_free(&cull, context->memory);
    cs_boundary_finish(&set, context->memory);
  }
  CHECK(deferred > 100);
  for (int k = 0; k < LIMITS; k++)
    if (!CHECK(missing_count[k] > 100))
      fprintf(stderr, "  %d drawings for limits %d\n", missing_count[k], k);
}

/* ---------------------------------------------------------------- known drawings */

/* A square and a diamond over it: each of its four edges crosses an upright one twice. */
static void test_intersections(void) {
  cs_boundary_set set;
  cs_events events;
  const celspan_point square[] = {{11, 11}, {29, 11}, {29, 29}, {11, 29}};
  const celspan_point diamond[] = {{20, 6}, {34, 20}, {20, 34}, {6, 20}};
  const celspan_point *const corners[] = {square, diamond};
  cs_boundary_init(&set);
  for (uint32_t k = 0; k < 2; k++) {
    cs_outline outline;
    cs_outline_init(&outline);
    MUST(cs_outline_polygon(context, &outline, corners[k], 4));
    add(&set, &outline, k);
    cs_outline_finish(&outline, context->memory);
  }
  MUST(cs_boundary_sort(context, &set));
  MUST(cs_events_find(context, &set, &no_cull, all_rows, no_limits, &events));
  CHECK(events.intersections == 4);
  CHECK(events.windings.count == 4); /* none, each, both */
  cs_events_finish(&events, context->memory);
  MUST(cs_events_find(context, &set, &no_cull, all_rows, ((cs_events_limits){2, 2, 0}), &events));
  CHECK(events.missing == 3 && events.part_count == 2); /* the foot of the diamond */
  cs_events_finish(&events, context->memory);
  cs_boundary_finish(&set, context->memory);
}

static double area_of(const cs_events *events, const cs_boundary_set *set) {
  double area = 0;
  for (size_t i = 0; i < set->chain_count; i++) {
    const cs_course *course = &events->courses.courses[i];
    const cs_course_point *p = events->courses.points + course->first;
    for (uint32_t k = 0; k + 1 < course->count; k++)
      area -= set->chains[i].direction * 0.5 * ((double)p[k].x + p[k + 1].x) *
              ((double)p[k + 1].y - p[k].y);
  }
  return fabs(area) / CS_COURSE_UNIT / CS_COURSE_UNIT;
}

/* Chords keep the area of an ellipse to less than a thousandth of a pixel along its outline. */
static void test_area(void) {
  for (int k = 1; k <= 30; k++) {
    cs_boundary_set set;
    cs_events events;
    cs_outline outline;
    double rx = 1.3 * k, ry = 1.1 * k;
    cs_outline_init(&outline);
    cs_boundary_init(&set);
    MUST(cs_outline_ellipse(context, &outline, (celspan_point){50, 40}, rx, ry));
    add(&set, &outline, 0);
    MUST(cs_boundary_sort(context, &set));
    MUST(cs_events_find(context, &set, &no_cull, all_rows, no_limits, &events));
    CHECK(events.part_count == 2);
    CHECK_NEAR(area_of(&events, &set), PI * rx * ry, 0.001 * PI * (rx + ry));
    cs_events_finish(&events, context->memory);
    cs_boundary_finish(&set, context->memory);
    cs_outline_finish(&outline, context->memory);
  }
}

/* Whichever allocation fails, that is reported and nothing is lost. */
static void test_without_memory(void) {
  memory_watch watch = {0};
  cs_boundary_set set = random_drawing(7);
  celspan_context *starving = memory_watch_context(&watch);
  size_t before = watch.blocks;
  celspan_status status = CELSPAN_NO_MEMORY;
  for (size_t fail = 1; fail < 1000 && status != CELSPAN_OK; fail++) {
    cs_events events;
    watch.fail_at = watch.allocations + fail;
    status = cs_events_find(starving, &set, &no_cull, all_rows, no_limits, &events);
    CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
    watch.fail_at = 0;
    cs_events_finish(&events, starving->memory);
    CHECK(watch.blocks == before);
  }
  CHECK(status == CELSPAN_OK && watch.size_errors == 0);
  celspan_context_destroy(starving);
  cs_boundary_finish(&set, context->memory);
}

int main(void) {
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  test_drawings();
  test_rows();
  test_intersections();
  test_area();
  test_without_memory();
  celspan_context_destroy(context);
  return check_done();
}
