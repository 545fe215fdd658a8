/* Busy rows: chords, units, their columns, the kinds of rows, and whole rows against calm ones.
 */
#include "area/edges.h"
#include "geometry/chords.h"
#include "geometry/polyline.h"
#include "render/row_worker.h"
#include "tests/support/random.h"
#include "tests/support/scene.h"

#define SIDE 256 /* pixels of a frame */

static studio s;
static test_random numbers = {5};

/* ---------------------------------------------------------------- scenes */

static celspan_texture *random_colour(void) {
  celspan_paint paint = {.beta = random_below(&numbers, 2) ? 1 : random_unit(&numbers)};
  for (int c = 0; c < 3; c++)
    paint.pigment[c] = random_unit(&numbers);
  return studio_paint(&s, paint);
}

/* Points in and about a box, some of them outside the frame. */
static celspan_object *random_polygon(celspan_point centre, double reach, bool is_even) {
  celspan_point points[9];
  size_t count = 3 + (size_t)random_below(&numbers, 7);
  for (size_t i = 0; i < count; i++)
    points[i] = random_point(&numbers, centre.x - reach, centre.x + reach, centre.y - reach,
                             centre.y + reach);
  return studio_polygon(&s, points, count, is_even ? CELSPAN_RULE_EVENODD : CELSPAN_RULE_NONZERO,
                        random_colour());
}

typedef enum shapes { STRAIGHT, CURVED } shapes;

/* Small shapes above a height, shapes as high as the frame, and very many in one place. */
static celspan_rostrum *random_scene(shapes kind, double below, int count) {
  celspan_object *objects[200];
  for (int i = 0; i < count; i++) {
    celspan_point centre = random_point(&numbers, -5, SIDE + 5, -5, below);
    double reach = random_between(&numbers, 0.5, 20);
    if (i % 4 == 0)
      centre = random_point(&numbers, 30, 33, 30, 33);
    objects[i] = kind == CURVED && i % 2
                     ? studio_circle(&s, centre.x, centre.y, reach, random_colour())
                     : random_polygon(centre, reach, i % 3 == 0);
  }
  celspan_cel *cel = studio_cel(&s, CELSPAN_CEL_DESC, objects, (size_t)count);
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.back = (celspan_light){1, 1, 1, 1};
  return studio_rostrum(&s, desc, &cel, 1);
}

static cs_frame frame_of(celspan_rostrum *rostrum, int32_t first, int32_t count) {
  const celspan_antialias_mode area = CELSPAN_ANTIALIAS_AREA;
  const celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc desc = CELSPAN_FRAME_DESC;
  desc.exposures = &exposure;
  desc.exposure_count = 1;
  desc.film_width = desc.film_height = desc.width = desc.height = SIDE;
  desc.crop_y = first;
  desc.crop_width = SIDE;
  desc.crop_height = count;
  desc.antialias = &area;
  cs_frame frame;
  studio_check(&s, cs_frame_create(s.context, &desc, &frame));
  return frame;
}

/* One row of a frame, RGBA. */
static void render_row(cs_row_worker *worker, int32_t y, float (*rgba)[4]) {
  const cs_row *row = NULL;
  if (!CHECK(cs_row_worker_row(worker, y, &row) == CELSPAN_OK))
    return;
  for (size_t i = 0; i < row->count; i++)
    for (int32_t x = row->spans[i].x0; x < row->spans[i].x1; x++)
      celspan_span_colour(&row->spans[i], x, rgba[x]);
}

static void render(const cs_frame *frame, float (*rgba)[4]) {
  cs_row_worker worker;
  studio_check(&s, cs_row_worker_init(&worker, s.context, frame));
  for (int32_t y = 0; y < frame->crop_height; y++)
    render_row(&worker, y, rgba + (size_t)y * SIDE);
  cs_row_worker_finish(&worker);
}

/* ---------------------------------------------------------------- chords */

/* How far a place on a curve is from a chord. */
static double distance(const cs_polyline_point *p, const celspan_point *a, const celspan_point *b) {
  double dx = b->x - a->x, dy = b->y - a->y, long_side = dx * dx + dy * dy;
  double t = cs_number_clamp(((p->x - a->x) * dx + (p->y - a->y) * dy) / long_side, 0, 1);
  return hypot(p->x - (a->x + t * dx), p->y - (a->y + t * dy));
}

/* All vertices of a piece, in batches; returns how many. */
static uint32_t make_all(const cs_boundary_set *set, const cs_boundary_piece *piece,
                         celspan_point *vertices, uint32_t room) {
  uint32_t chords = cs_chords_count(piece), count = 0;
  for (uint32_t first = 0, made; first < chords && first + CS_CHORDS_BATCH < room; first += made) {
    cs_chords batch;
    made = cs_chords_make(set, piece, chords, first, &batch);
    if (first > 0) /* the last vertex of one batch is the first of the next, to the bit */
      CHECK(batch.x[0] == vertices[first].x && batch.y[0] == vertices[first].y);
    for (uint32_t k = 0; k <= made; k++)
      vertices[first + k] = (celspan_point){batch.x[k], batch.y[k]};
    count = first + made + 1;
  }
  return count;
}

/* Chords begin and end where their piece does, keep its area, and stay near it. */
static void test_chords(void) {
  static celspan_point v[2000];
  double worst = 0, worst_area = 0;
  for (int trial = 0; trial < 20; trial++) {
    cs_frame frame = frame_of(random_scene(CURVED, SIDE, 60), 0, SIDE);
    const cs_boundary_set *set = &frame.plans[0].boundaries;
    for (size_t i = 0; i < set->piece_count; i++) {
      const cs_boundary_piece *piece = &set->pieces[i];
      uint32_t count = make_all(set, piece, v, 2000);
      CHECK(v[0].x == piece->x0 && v[0].y == piece->y0);
      CHECK(v[count - 1].x == piece->x1 && v[count - 1].y == piece->y1);
      if (count == 2)
        continue;
      double area = 0, step = 1.0 / (count - 1) / 16;
      cs_polyline_point last = cs_polyline_at(set, piece, 0);
      for (uint32_t k = 1; k < count; k++) {
        area -= (v[k - 1].x + v[k].x) * (v[k].y - v[k - 1].y);
        for (int part = 1; part <= 16; part++) {
          cs_polyline_point p = cs_polyline_at(set, piece, (16 * (k - 1) + part) * step);
          area += (last.x + p.x) * (p.y - last.y);
          double away = distance(&p, &v[k - 1], &v[k]);
          worst = away > worst && part < 16 ? away : worst;
          last = p;
        }
      }
      worst_area = fabs(area) > worst_area ? fabs(area) : worst_area;
    }
    cs_frame_free(&frame, s.context->memory);
    studio_finish(&s);
  }
  CHECK(worst > 0.5 * CS_CHORDS_SAG && worst < 1.5 * CS_CHORDS_SAG);
  CHECK(worst_area < 0.02);
}

/* ---------------------------------------------------------------- units */

static int compare_units(const cs_units *a, const cs_unit *p, const cs_units *b, const cs_unit *q) {
  if (p->layer != q->layer || p->count != q->count)
    return p->layer != q->layer ? (p->layer < q->layer ? -1 : 1) : (p->count < q->count ? -1 : 1);
  return memcmp(cs_units_points(a, p), cs_units_points(b, q), p->count * sizeof(celspan_point));
}

/* Whether every unit of one list is in the other. */
static bool are_in(const cs_units *a, const cs_units *b) {
  for (size_t i = 0; i < a->count; i++) {
    size_t k = 0;
    while (k < b->count && compare_units(a, &a->units[i], b, &b->units[k]) != 0)
      k++;
    if (k == b->count)
      return false;
  }
  return true;
}

/* The windings of all units that cross a height cancel. */
static int sum_windings(const cs_units *units, double y) {
  int sum = 0;
  for (size_t i = 0; i < units->count; i++)
    if (units->units[i].y0 <= y && y < units->units[i].y1)
      sum += units->units[i].direction;
  return sum;
}

/* The units of a row do not depend on where the descent began. */
static void test_units(void) {
  for (int trial = 0; trial < 10; trial++) {
    cs_frame frame = frame_of(random_scene(CURVED, SIDE, 60), 0, SIDE);
    const cs_boundary_set *set = &frame.plans[0].boundaries;
    cs_descent down, alone;
    cs_descent_init(&down, set);
    for (int32_t y = 0; y < SIDE; y++) {
      CHECK(cs_descent_row(s.context, &down, y) == CELSPAN_OK);
      cs_descent_init(&alone, set);
      CHECK(cs_descent_row(s.context, &alone, y) == CELSPAN_OK);
      CHECK(down.units.count == alone.units.count);
      CHECK(are_in(&down.units, &alone.units) && are_in(&alone.units, &down.units));
      CHECK(sum_windings(&down.units, random_unit(&numbers)) == 0);
      cs_descent_finish(&alone, s.context->memory);
    }
    cs_descent_finish(&down, s.context->memory);
    cs_frame_free(&frame, s.context->memory);
    studio_finish(&s);
  }
}

/* ---------------------------------------------------------------- columns */

/* The area right of a unit in a column, piece by piece. */
static double area_right(const cs_units *units, const cs_unit *unit, int32_t column) {
  const celspan_point *p = cs_units_points(units, unit);
  double area = 0;
  for (uint32_t k = 1; k < unit->count; k++)
    area += cs_edges_cover(p[k - 1].x, p[k].x, p[k].y - p[k - 1].y, column);
  return area;
}

static void check_columns(const cs_columns *columns, const cs_units *units) {
  for (size_t i = 0; i < units->count; i++) {
    const cs_unit *unit = &units->units[i];
    double height = unit->y1 - unit->y0;
    for (int32_t column = unit->first; column <= unit->last; column++) {
      double area = columns->nodes[unit->node + (uint32_t)(column - unit->first)].area;
      CHECK_NEAR(area, area_right(units, unit, column), 1e-7);
      bool is_listed = false;
      for (uint32_t k = columns->heads[column]; k != 0; k = columns->nodes[k].next)
        is_listed = is_listed || columns->nodes[k].unit == i;
      CHECK(is_listed && cs_columns_next(columns, column) == column);
    }
    if (unit->last >= 0 && unit->last < columns->width - 1)
      CHECK_NEAR(area_right(units, unit, unit->last + 1), height, 1e-7);
    if (unit->first > 0 && unit->first < columns->width)
      CHECK_NEAR(area_right(units, unit, unit->first - 1), 0, 1e-7);
  }
}

static void test_columns(void) {
  for (int trial = 0; trial < 10; trial++) {
    cs_frame frame = frame_of(random_scene(trial % 2 ? CURVED : STRAIGHT, SIDE, 60), 0, SIDE);
    cs_descent descent;
    cs_columns columns;
    cs_descent_init(&descent, &frame.plans[0].boundaries);
    CHECK(cs_columns_init(s.context, &columns, SIDE) == CELSPAN_OK);
    for (int32_t y = 0; y < SIDE; y++) {
      CHECK(cs_descent_row(s.context, &descent, y) == CELSPAN_OK);
      CHECK(cs_columns_list(s.context, &columns, &descent.units) == CELSPAN_OK);
      check_columns(&columns, &descent.units);
      cs_columns_clear(&columns);
      CHECK(cs_columns_next(&columns, 0) == SIDE);
    }
    cs_columns_finish(&columns, s.context->memory);
    cs_descent_finish(&descent, s.context->memory);
    cs_frame_free(&frame, s.context->memory);
    studio_finish(&s);
  }
}

/* ---------------------------------------------------------------- kinds */

/* Small shapes above, and behind them strips from the top of the frame to its foot. */
static celspan_rostrum *two_kinds(void) {
  celspan_object *objects[60];
  for (int i = 0; i < 60; i++)
    objects[i] = i < 20 ? studio_rect(&s, 10 * i + 0.3, -200, 3, 900, random_colour())
                        : random_polygon(random_point(&numbers, 0, SIDE, 10, 60), 8, false);
  celspan_cel *cel = studio_cel(&s, CELSPAN_CEL_DESC, objects, 60);
  return studio_rostrum(&s, CELSPAN_ROSTRUM_DESC, &cel, 1);
}

/* Kinds depend on what is in the rows, and not on which rows are asked for; and a crop has the rows
 * of the whole. */
static void test_kinds(void) {
  static float whole[SIDE * SIDE][4], part[SIDE * SIDE][4];
  celspan_rostrum *rostrum = two_kinds();
  cs_frame frame = frame_of(rostrum, 0, SIDE);
  const cs_kind *kind = &frame.plans[0].kind;
  CHECK(cs_kind_is_busy(kind, 0) && cs_kind_is_busy(kind, 63) && !cs_kind_is_busy(kind, 70));
  CHECK(!cs_kind_are_busy(kind));
  render(&frame, whole);
  for (int trial = 0; trial < 60; trial++) {
    int32_t first = random_below(&numbers, SIDE), count = 1 + random_below(&numbers, SIDE - first);
    cs_frame crop = frame_of(rostrum, first, count);
    for (int32_t y = first; y < first + count; y++)
      CHECK(cs_kind_is_busy(&crop.plans[0].kind, y) == cs_kind_is_busy(kind, y));
    render(&crop, part);
    CHECK(memcmp(part, whole + (size_t)first * SIDE, (size_t)count * SIDE * sizeof *part) == 0);
    cs_frame_free(&crop, s.context->memory);
  }
  cs_frame_free(&frame, s.context->memory);
  studio_finish(&s);
}

/* ---------------------------------------------------------------- rows */

/* Where nothing is curved, a busy row is the row that the sweep makes, but for rounding. */
static void test_against_calm(void) {
  static float busy[SIDE * SIDE][4], calm[SIDE * SIDE][4];
  for (int trial = 0; trial < 30; trial++) {
    cs_frame frame = frame_of(random_scene(STRAIGHT, SIDE, 20 + 5 * trial), 0, SIDE);
    CHECK(cs_kind_are_busy(&frame.plans[0].kind));
    render(&frame, busy);
    cs_kind_free(&frame.plans[0].kind, s.context->memory);
    render(&frame, calm);
    float worst = 0;
    for (size_t i = 0; i < SIDE * SIDE; i++)
      for (int c = 0; c < 4; c++)
        worst = fmaxf(worst, fabsf(busy[i][c] - calm[i][c]));
    CHECK_NEAR(worst, 0, 2e-6);
    cs_frame_free(&frame, s.context->memory);
    studio_finish(&s);
  }
}

/* Rows in any order, each by a maker that has made others before. */
static void test_order(void) {
  static float whole[SIDE * SIDE][4];
  for (int trial = 0; trial < 10; trial++) {
    cs_frame frame = frame_of(trial % 2 ? two_kinds() : random_scene(CURVED, SIDE, 150), 0, SIDE);
    cs_row_worker worker;
    render(&frame, whole);
    studio_check(&s, cs_row_worker_init(&worker, s.context, &frame));
    for (int i = 0; i < 200; i++) {
      float row[SIDE][4];
      int32_t y = random_below(&numbers, SIDE);
      render_row(&worker, y, row);
      CHECK(memcmp(row, whole + (size_t)y * SIDE, sizeof row) == 0);
    }
    cs_row_worker_finish(&worker);
    cs_frame_free(&frame, s.context->memory);
    studio_finish(&s);
  }
}

int main(void) {
  if (celspan_context_create(NULL, &s.context) != CELSPAN_OK)
    return 1;
  test_chords();
  test_units();
  test_columns();
  test_kinds();
  test_against_calm();
  test_order();
  celspan_context_destroy(s.context);
  return check_done();
}
