/* engine/area/intersections.c: boundaries that descend together intersect in order, and end in
 * order.
 */
#include "engine/area/intersections.h"

#include "tests/support/check.h"
#include "tests/support/random.h"

#define MOST 60
#define BENDS 4

static test_random numbers = {5};

static celspan_point points[MOST][BENDS + 2];
static int point_counts[MOST];
static double tops[MOST], feet[MOST];

/* Polylines from height 2 to 3, from left to right at the top. */
static void make_polylines(size_t count, int bends) {
  for (size_t i = 0; i < count; i++) {
    int inner = random_below(&numbers, bends + 1), last = inner + 1;
    double step = 1.0 / (inner + 1);
    point_counts[i] = inner + 2;
    points[i][0] = (celspan_point){(double)i / 8, 2};
    for (int k = 1; k <= inner; k++) {
      celspan_point bend = random_point(&numbers, 0, 8, 0, 0.4);
      points[i][k] = (celspan_point){bend.x, 2 + step * (k - 0.5 + bend.y)};
    }
    points[i][last] = (celspan_point){random_between(&numbers, 0, 8), 3};
    tops[i] = points[i][0].x;
    feet[i] = points[i][last].x;
  }
}

static double x_at(size_t i, double y) {
  int at = 1;
  while (points[i][at].y < y && at + 1 < point_counts[i])
    at++;
  celspan_point a = points[i][at - 1], b = points[i][at];
  return a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
}

static void find(celspan_context *context, cs_intersections *m, size_t count, double y0,
                 double y1) {
  CHECK(cs_intersections_reserve(m, context, count) == CELSPAN_OK);
  for (size_t i = 0; i < count; i++) {
    m->edges[i] = (cs_active_edge){
        .points = points[i], .at = 1, .last_at = 1, .last_x = tops[i], .last_y = 2};
    m->foot[i] = x_at(i, y0);
  }
  CHECK(cs_intersections_find(m, context, count, y0, y1) == CELSPAN_OK);
}

/* Whether the intersections of every place are listed in order, without omission. */
static bool are_listed(const cs_intersections *m, size_t count) {
  size_t listed = 0;
  for (size_t place = 0; place < count; place++)
    for (uint32_t k = m->first[place], before = 0; k != CS_INTERSECTIONS_NONE;
         before = k, k = m->intersections[k].next, listed++)
      if (k < before)
        return false;
  return listed == m->count;
}

static void check_intersections(const cs_intersections *m, size_t count) {
  uint32_t order[MOST];
  double y = 2;
  for (uint32_t i = 0; i < count; i++)
    order[i] = i;
  for (size_t k = 0; k < m->count; k++) {
    const cs_intersection *intersection = &m->intersections[k];
    size_t place = 0;
    while (place + 1 < count && order[place] != intersection->left)
      place++;
    CHECK(place + 1 < count && order[place + 1] == intersection->right);
    CHECK(intersection->y >= y - 1e-12 && intersection->y <= 3);
    CHECK_NEAR(intersection->left_x, x_at(intersection->left, intersection->y), 1e-9);
    CHECK_NEAR(intersection->left_x, intersection->right_x, 1e-9);
    CHECK(points[intersection->left][intersection->left_at - 1].y <= intersection->y);
    CHECK(points[intersection->left][intersection->left_at].y >= intersection->y);
    order[place] = intersection->right;
    order[place + 1] = intersection->left;
    y = intersection->y;
  }
  CHECK(memcmp(order, m->order, count * sizeof *order) == 0);
  for (size_t place = 0; place < count; place++) {
    CHECK(m->foot[place] == feet[order[place]]);
    CHECK(place == 0 || m->foot[place - 1] <= m->foot[place]);
  }
  CHECK(are_listed(m, count));
}

static size_t count_inversions(size_t count) {
  size_t inversions = 0;
  for (size_t i = 0; i < count; i++)
    for (size_t j = i + 1; j < count; j++)
      inversions += feet[i] > feet[j];
  return inversions;
}

static void test_polylines(celspan_context *context) {
  cs_intersections m = {0};
  for (int round = 0; round < 200; round++) {
    size_t count = 1 + (size_t)random_below(&numbers, MOST - 1);
    int bends = round % 2 == 0 ? 0 : BENDS;
    make_polylines(count, bends);
    find(context, &m, count, 2, 3);
    check_intersections(&m, count);
    CHECK(bends > 0 || m.count == count_inversions(count));
  }
  find(context, &m, 0, 2, 3);
  CHECK(m.count == 0);
  cs_intersections_finish(&m, context->memory);
}

/* Boundaries that coincide never cross; those that separate in another order do so at once. */
static void test_touching(celspan_context *context) {
  cs_intersections m = {0};
  make_polylines(2, 0);
  points[0][0].x = points[1][0].x = tops[0] = tops[1] = 4;
  points[0][1].x = points[1][1].x = 6;
  find(context, &m, 2, 2, 3);
  CHECK(m.count == 0);
  points[0][1].x = 7;
  find(context, &m, 2, 2, 3);
  CHECK(m.count == 1 && m.intersections[0].y == 2 && m.intersections[0].left_x == 4);
  cs_intersections_finish(&m, context->memory);
}

int main(void) {
  celspan_context *context;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  test_polylines(context);
  test_touching(context);
  celspan_context_destroy(context);
  return check_done();
}
