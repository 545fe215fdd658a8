/* The active boundaries: which boundaries are active at a height, and in which order, depends on
 * the height alone; and culling leaves out only boundaries that cannot be seen.
 */
#include "base/number.h"
#include "engine/sweep/active.h"
#include "model/geometry/boundary_build.h"
#include "model/geometry/matrix.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

#define WIDTH 120
#define HEIGHT 90
#define LAYERS 24

static celspan_context *context;

static void add_blob(cs_boundary_builder *builder, test_random *random, uint32_t layer) {
  cs_outline outline;
  celspan_point points[6];
  celspan_matrix identity = celspan_matrix_identity();
  cs_outline_init(&outline);
  for (int i = 0; i < 6; i++)
    points[i] = random_point(random, -30, WIDTH + 30, -30, HEIGHT + 30);
  celspan_nurbs_desc desc = {
      .struct_size = sizeof desc, .points = points, .point_count = 6, .degree = 3};
  celspan_status status = layer % 3 == 0 ? cs_outline_polygon(context, &outline, points, 6)
                                         : cs_outline_nurbs(context, &outline, &desc);
  CHECK(status == CELSPAN_OK);
  CHECK(cs_boundary_add(builder, &outline, &identity, layer) == CELSPAN_OK);
  cs_outline_finish(&outline, context->memory);
}

static void make_set(cs_boundary_set *set, uint64_t seed) {
  const cs_boundary_frame frame = {0, WIDTH, 0, HEIGHT};
  test_random random = {seed};
  cs_boundary_builder builder;
  cs_boundary_init(set);
  cs_boundary_builder_init(&builder, context, set, &frame);
  for (uint32_t layer = 0; layer < LAYERS; layer++)
    add_blob(&builder, &random, layer);
  cs_boundary_builder_finish(&builder);
  CHECK(cs_boundary_sort(context, set) == CELSPAN_OK);
}

static bool same_order(const cs_active *a, const cs_active *b) {
  if (a->count != b->count)
    return false;
  for (size_t i = 0; i < a->count; i++)
    if (a->walks[a->slot[i]].chain != b->walks[b->slot[i]].chain || a->x[i] != b->x[i] ||
        a->segments.slope[i] != b->segments.slope[i])
      return false;
  return true;
}

static bool is_ordered(const cs_active *active) {
  for (size_t i = 1; i < active->count; i++)
    if (active->x[i - 1] > active->x[i])
      return false;
  return true;
}

/* Walks down in steps and, at each height, also starts a fresh list there: both must be the
 * same. */
static void check_walk(const cs_boundary_set *set, const cs_cull *cull, double step) {
  cs_active walked, fresh;
  cs_change change;
  cs_active_init(&walked, set, cull, true);
  cs_active_init(&fresh, set, cull, true);
  CHECK(cs_active_start(context, &walked, 0) == CELSPAN_OK);
  for (double y = step; y < HEIGHT; y += step) {
    CHECK(cs_active_advance(context, &walked, y) == CELSPAN_OK);
    CHECK(cs_active_settle(context, &walked, &change) == CELSPAN_OK);
    CHECK(cs_active_start(context, &fresh, y) == CELSPAN_OK);
    CHECK(same_order(&walked, &fresh));
    CHECK(is_ordered(&walked));
  }
  cs_active_finish(&walked, context->memory);
  cs_active_finish(&fresh, context->memory);
}

static int64_t winding_of(const cs_active *active, uint32_t layer, double x) {
  int64_t winding = 0;
  for (size_t i = 0; i < active->count; i++)
    if (cs_active_chain(active, i)->layer == layer && active->x[i] <= x)
      winding += cs_active_chain(active, i)->direction;
  const cs_deferred *end, *deferred = cs_active_deferred(active, &end);
  for (; deferred < end; deferred++)
    if (deferred->layer == layer && deferred->x <= x)
      winding += deferred->direction;
  return winding;
}

/* From the camera backwards until nothing shines through, culled and unculled lists contain the
 * same layers. */
static void check_presence(const cs_active *all, const cs_active *culled,
                           const cs_cull_layer *layers, double x) {
  double through = 1;
  for (uint32_t layer = LAYERS; layer-- > 0 && through > 0x1p-16;) {
    bool present = winding_of(all, layer, x) != 0;
    CHECK(present == (winding_of(culled, layer, x) != 0));
    through *= present ? layers[layer].through : 1;
  }
}

static void check_cull(const cs_boundary_set *set, const cs_cull *cull,
                       const cs_cull_layer *layers) {
  static const cs_cull nothing;
  cs_active all, culled;
  test_random random = {7};
  cs_active_init(&all, set, &nothing, true);
  cs_active_init(&culled, set, cull, true);
  for (int trial = 0; trial < 200; trial++) {
    double y = random_between(&random, 0, HEIGHT);
    CHECK(cs_active_start(context, &all, y) == CELSPAN_OK);
    CHECK(cs_active_start(context, &culled, y) == CELSPAN_OK);
    CHECK(culled.count <= all.count);
    for (int k = 0; k < 10; k++)
      check_presence(&all, &culled, layers, random_between(&random, 0, WIDTH));
  }
  cs_active_finish(&all, context->memory);
  cs_active_finish(&culled, context->memory);
}

static void check_case(uint64_t seed) {
  cs_boundary_set set;
  cs_cull none = {0}, cull;
  cs_cull_layer layers[LAYERS];
  test_random random = {seed + 1000};
  for (int layer = 0; layer < LAYERS; layer++)
    layers[layer] =
        (cs_cull_layer){.through = random_below(&random, 2) ? 0 : random_between(&random, 0, 1),
                        .winding_mask = -1,
                        .group = CS_CULL_NONE};
  make_set(&set, seed);
  const cs_cull_desc desc = {.set = &set,
                             .layers = layers,
                             .layer_count = LAYERS,
                             .width = WIDTH,
                             .height = HEIGHT,
                             .opaque = 0x1p-16,
                             .workers = 3};
  CHECK(cs_cull_create(context, &desc, &cull) == CELSPAN_OK);
  CHECK(cull.tile_rows > 0);
  check_walk(&set, &none, 1);
  check_walk(&set, &none, 0.37);
  check_walk(&set, &cull, 1);
  check_walk(&set, &cull, 0.37);
  check_walk(&set, &cull, 7.5);
  check_cull(&set, &cull, layers);
  cs_cull_free(&cull, context->memory);
  cs_boundary_finish(&set, context->memory);
}

int main(void) {
  size_t bytes, peak;
  uint64_t allocations;
  if (celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  celspan_context_memory(context, &bytes, &peak, &allocations);
  size_t before = bytes;
  for (uint64_t seed = 1; seed <= 30; seed++)
    check_case(seed);
  celspan_context_memory(context, &bytes, &peak, &allocations);
  CHECK(bytes == before);
  celspan_context_destroy(context);
  return check_done();
}
