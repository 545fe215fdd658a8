/* The sweep's vector code gives the same bits with every instruction set.
 */
#include "engine/area/crowd_solver.h"
#include "engine/area/edges.h"
#include "engine/row/centre.h"
#include "engine/sweep/advance.h"
#include "model/geometry/polyline.h"
#include "model/geometry/polyline_vertex.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

#include <math.h>
#include <string.h>

enum { MOST = 203, ROOM = MOST + CS_ADVANCE_BATCH, WIDTH = 640 };

static bool same_doubles(const double *a, const double *b, size_t count) {
  return memcmp(a, b, count * sizeof *a) == 0;
}

/* Columns left of the frame, in it, right of it, and on the edges of pixels. */
static double random_x(test_random *random) {
  double x = random_between(random, -8, WIDTH + 8);
  return random_below(random, 4) ? x : (double)(int)x;
}

/* Values beyond the count must have no effect. */
static void fill_with_rubbish(double array[ROOM]) {
  for (size_t i = 0; i < ROOM; i++)
    array[i] = i % 3 ? -1e300 : NAN;
}

static void check_advance(cs_isa isa, test_random *random) {
  double x0[ROOM], y0[ROOM], slope[ROOM], curve[ROOM], y1[ROOM], expected[ROOM], found[ROOM];
  fill_with_rubbish(x0), fill_with_rubbish(y0), fill_with_rubbish(slope), fill_with_rubbish(curve);
  fill_with_rubbish(y1);
  size_t count = (size_t)random_below(random, MOST);
  for (size_t i = 0; i < count; i++) {
    x0[i] = random_x(random);
    y0[i] = random_between(random, 0, 10);
    slope[i] = random_between(random, -100, 100);
    curve[i] = random_below(random, 2) ? random_between(random, -1, 1) : 0;
    y1[i] = y0[i] + random_between(random, 0, 40);
  }
  cs_segments segments = {x0, y0, slope, curve, y1};
  double y = random_between(random, 10, 12);
  uint32_t ended[ROOM];
  cs_advanced advanced = CS_WIDE_CHOOSE(isa, cs_advance_to)(&segments, count, y, found, ended);
  size_t falls = 0, ends = 0, wrong = 0;
  for (size_t i = 0; i < count; i++) {
    double down = y - y0[i];
    expected[i] = x0[i] + down * (slope[i] + down * curve[i]);
    falls += i > 0 && !(expected[i - 1] < expected[i]);
    if (y1[i] <= y)
      wrong += ended[ends++] != i;
  }
  CHECK(same_doubles(expected, found, count));
  CHECK(advanced.falls == falls && advanced.ended == ends && wrong == 0);
}

static void check_order(cs_isa isa, test_random *random) {
  double x[ROOM];
  fill_with_rubbish(x);
  size_t count = 1 + (size_t)random_below(random, MOST - 1);
  for (size_t i = 0; i < count; i++)
    x[i] = (double)i;
  CHECK(CS_WIDE_CHOOSE(isa, cs_advance_rises)(x, count));
  if (count < 2)
    return;
  size_t place = 1 + (size_t)random_below(random, (int)count - 1);
  x[place] = x[place - 1]; /* equal is not rising */
  CHECK(!CS_WIDE_CHOOSE(isa, cs_advance_rises)(x, count));
}

typedef struct room {
  double low[MOST], high[MOST];
  float one[MOST], two[MOST], second[MOST], fall[MOST];
  int32_t first[MOST], end[MOST];
} room;

static void measure(cs_isa isa, room *r, const double *top, const double *foot, size_t count) {
  cs_edges edges = {.low = r->low,
                    .high = r->high,
                    .one = r->one,
                    .two = r->two,
                    .second = r->second,
                    .fall = r->fall,
                    .first = r->first,
                    .end = r->end};
  CS_WIDE_CHOOSE(isa, cs_edges_straight)(&edges, top, foot, count, WIDTH);
}

static void check_edges(cs_isa isa, test_random *random) {
  static room expected, found;
  double top[MOST] = {0}, foot[MOST] = {0};
  size_t count = (size_t)random_below(random, MOST);
  for (size_t i = 0; i < count; i++) {
    top[i] = random_x(random);
    foot[i] = random_below(random, 8) ? top[i] + random_between(random, -3, 3) : top[i];
  }
  measure(CS_ISA_ANY, &expected, top, foot, count);
  measure(isa, &found, top, foot, count);
  CHECK(same_doubles(expected.low, found.low, count));
  CHECK(same_doubles(expected.high, found.high, count));
  CHECK(memcmp(expected.first, found.first, count * sizeof *expected.first) == 0);
  CHECK(memcmp(expected.end, found.end, count * sizeof *expected.end) == 0);
  for (size_t i = 0; i < count; i++)
    if (expected.end[i] - expected.first[i] <= 2) {
      CHECK(memcmp(&expected.one[i], &found.one[i], sizeof found.one[i]) == 0);
      CHECK(memcmp(&expected.two[i], &found.two[i], sizeof found.two[i]) == 0);
    }
}

/* The ends of visible cells under pixel centres, and the spans that are placed there. */
static void check_centres(cs_isa isa, test_random *random) {
  double x[ROOM];
  bool is_visible[ROOM], is_full = true;
  int32_t ends[ROOM + 1], last = 0;
  static celspan_span spans[ROOM + 1];
  size_t count = (size_t)random_below(random, MOST), found = 0, wrong = 0;
  fill_with_rubbish(x);
  memset(is_visible, true, sizeof is_visible); /* also beyond the count, without effect */
  memset(spans, 1, sizeof spans);
  for (size_t i = 0; i < count; i++) {
    x[i] = random_below(random, 400) ? (WIDTH - 8) * (double)(i + 1) / MOST : random_x(random);
    is_visible[i] = random_below(random, 3) > 0;
  }
  size_t said = CS_WIDE_CHOOSE(isa, cs_centre_place)(x, is_visible, count, WIDTH, spans, ends);
  for (size_t i = 0; i <= count; i++)
    if (i == count || is_visible[i]) {
      double first = i < count ? ceil(x[i] - 0.5) : WIDTH;
      int32_t end = (int32_t)(first < 0 ? 0 : first > WIDTH ? WIDTH : first);
      const celspan_span *span = &spans[found];
      wrong += ends[found++] != end;
      wrong += span->x0 != last || span->x1 != end || span->origin != last;
      wrong += span->kind != CELSPAN_SPAN_SINGLE || memcmp(span->colour, "\1\1\1\1", 4) != 0;
      is_full &= end > last;
      last = end;
    }
  CHECK(wrong == 0 && said == (is_full ? found : 0));
}

static cs_boundary_piece random_piece(test_random *random) {
  cs_boundary_piece piece = {
      .x0 = -100, .y0 = -100, .x1 = 300, .y1 = 300, .left = -90, .right = 290, .sag = 0.02};
  piece.group = (uint8_t)(1 + random_below(random, CS_BOUNDARY_GROUP));
  piece.half = piece.group > 5 ? piece.group / 2 : piece.group;
  piece.chords = 3u * piece.group;
  piece.step = cs_polyline_step(piece.chords);
  return piece;
}

static void check_vertices(cs_isa isa, test_random *random) {
  cs_polyline_vertices expected, found;
  double c[8];
  for (int k = 0; k < 8; k++)
    c[k] = random_between(random, -200, 200);
  cs_boundary_piece piece = random_piece(random);
  uint32_t first = (uint32_t)random_below(random, 3) * piece.group;
  uint32_t stride = 1 + (uint32_t)random_below(random, 4);
  cs_polyline_powers_any(c, &piece, first, stride, &expected);
  CS_WIDE_CHOOSE(isa, cs_polyline_powers)(c, &piece, first, stride, &found);
  size_t count = piece.group + 1u;
  CHECK(same_doubles(expected.on_x, found.on_x, count));
  CHECK(same_doubles(expected.on_y, found.on_y, count));
  CHECK(same_doubles(expected.x, found.x, count));
  CHECK(same_doubles(expected.y, found.y, count));
}

/* Vertices near an arc, one of them perhaps too far from it; those beyond the arc have no
 * effect. */
static void check_strays(cs_isa isa, test_random *random) {
  double x = random_x(random), y = random_x(random), height = random_between(random, 5, 50);
  double mean = random_between(random, -2, 2), curve = random_between(random, -0.03, 0.03);
  cs_polyline_arc arc = {x, y, height, mean, curve};
  cs_polyline_vertices v;
  int first = random_below(random, 4), end = first + 2 + random_below(random, 3);
  int odd = random_below(random, CS_POLYLINE_ROOM);
  for (int k = 0; k < CS_POLYLINE_ROOM; k++) {
    double down = arc.height * (k - first) / (end - first);
    v.on_y[k] = arc.y + down;
    v.on_x[k] = arc.x + down * (arc.mean + arc.curve * (down - arc.height)) + (k == odd ? 10 : 0);
  }
  bool strays = cs_polyline_strays_any(&arc, &v, first, end);
  CHECK(CS_WIDE_CHOOSE(isa, cs_polyline_strays)(&arc, &v, first, end) == strays);
  CHECK(strays || odd < first || odd > end);
}

/* Sums over pairs of lines of a pixel are the same to the bit. */
static void check_joint(cs_isa isa, test_random *random) {
  enum { LINES = 3 * CS_CROWD_SUMS };
  float numbers[6][LINES] = {{0}};
  const cs_crowd_numbers n = {numbers[0], numbers[1], numbers[2],
                              numbers[3], numbers[4], numbers[5]};
  size_t first = (size_t)random_below(random, LINES), end = (size_t)random_below(random, LINES);
  double expected = 0;
  for (size_t k = 0; k < LINES; k++) {
    n.x[k] = (float)random_below(random, CS_CROWD_UNIT);
    n.top[k] = (float)random_below(random, CS_CROWD_UNIT / 2);
    n.foot[k] = n.top[k] + 1 + (float)random_below(random, CS_CROWD_UNIT / 2);
    n.direction[k] = random_below(random, 2) ? 1 : -1;
    n.weight[k] = k < first ? (float)random_between(random, -1, 1) : 0;
  }
  for (size_t k = first; k < end; k++)
    for (size_t i = 0; i < first; i++) {
      double high = fmin(n.foot[i], n.foot[k]) - fmax(n.top[i], n.top[k]);
      expected +=
          n.direction[k] * n.weight[i] * fmax(high, 0) * 2 * (CS_CROWD_UNIT - fmax(n.x[i], n.x[k]));
    }
  float joint = CS_WIDE_CHOOSE(isa, cs_crowd_solver_joint)(&n, first, end);
  CHECK(joint == cs_crowd_solver_joint_any(&n, first, end));
  CHECK(fabs(joint - expected) <= 1e-4 * CS_CROWD_TWICE);
}

int main(void) {
  for (int isa = CS_ISA_ANY; isa <= (int)cs_isa_best(); isa++) {
    test_random random = {29};
    for (int k = 0; k < 300; k++) {
      check_advance((cs_isa)isa, &random);
      check_order((cs_isa)isa, &random);
      check_edges((cs_isa)isa, &random);
      check_centres((cs_isa)isa, &random);
      check_vertices((cs_isa)isa, &random);
      check_strays((cs_isa)isa, &random);
      check_joint((cs_isa)isa, &random);
    }
  }
  return check_done();
}
