/* Direct edges: spans are the mean over each pixel, cover the row, and have the same bits with
 * every instruction set. Cover: all ways to the area right of a line agree, and areas sum exactly.
 */
#include "engine/area/direct.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

#include <string.h>

enum { MOST = 40, ROOM = MOST + CS_ADVANCE_BATCH, WIDTH = 200, SPANS = 8 * MOST + 64 };

/* Edges through a row from 0 to 1, from left to right, and cells with more or less similar
 * colours. */
typedef struct stage {
  double x[ROOM], x_next[ROOM];
  cs_bend bends[MOST];
  uint32_t bend_of[ROOM];
  celspan_point vertices[MOST];
  cs_cell cells[MOST + 1];
  uint32_t boundaries[MOST];
  cs_active active;
  cs_edges edges;
  cs_direct_edges direct;
} stage;

static cs_v4 random_colour(test_random *random, cs_v4 last) {
  float grey = (float)random_below(random, 5) / 4;
  switch (random_below(random, 4)) {
  case 0:
    return cs_v4_all(grey);
  case 1: /* nearly the same as the last one */
    return cs_v4_max(last - cs_v4_all(0x1p-24f), cs_v4_all(0));
  default:
    return (cs_v4){grey * (float)random_between(random, 0, 1), 0, grey / 3, grey};
  }
}

static double least(double a, double b) { return a < b ? a : b; }
static double most(double a, double b) { return a > b ? a : b; }

/* Bends edge i as far as its neighbours leave room. */
static void bend_edge(stage *s, size_t i, test_random *random) {
  cs_bend *bend = &s->bends[s->active.bend_count];
  double y = random_between(random, 0.1, 0.9);
  double x = s->x[i] + y * (s->x_next[i] - s->x[i]) + random_between(random, -0.2, 0.2);
  double low = least(s->x[i], s->x_next[i]), high = most(s->x[i], s->x_next[i]);
  *bend = (cs_bend){.boundary = (uint32_t)i,
                    .vertex = (uint32_t)s->active.vertex_count,
                    .vertex_count = 1,
                    .low = least(low, x),
                    .high = most(high, x)};
  s->vertices[s->active.vertex_count++] = (celspan_point){x, y};
  s->bend_of[i] = (uint32_t)s->active.bend_count++;
}

/* left: where the first edge is, about. */
static void set_stage(stage *s, test_random *random, double left) {
  size_t count = (size_t)random_below(random, MOST);
  s->active = (cs_active){.x = s->x,
                          .x_next = s->x_next,
                          .count = count,
                          .y_next = 1,
                          .bends = s->bends,
                          .bend_of = s->bend_of,
                          .vertices = s->vertices};
  double top = left, foot = left;
  bool is_bent = false;
  for (size_t i = 0; i < count; i++) {
    double gap = is_bent || random_below(random, 40) ? random_between(random, 2, 8) : 0;
    top += gap + (random_below(random, 4) ? 0 : random_between(random, 0, 12));
    foot =
        most(foot + gap, top - 1.5) + (random_below(random, 8) ? 0 : random_between(random, 0, 12));
    bool is_upright = random_below(random, 6) == 0; /* on the edge of a pixel */
    if (is_upright)
      top = foot = (double)(int)most(top, foot) + 1;
    s->x[i] = top;
    s->x_next[i] = foot;
    is_bent = gap > 0 && !is_upright && random_below(random, 4) == 0;
    if (is_bent)
      bend_edge(s, i, random);
    s->boundaries[i] = (uint32_t)i;
  }
  memset(s->cells, 0, sizeof s->cells);
  for (size_t i = 0; i <= count; i++)
    s->cells[i].colour = random_colour(random, i > 0 ? s->cells[i - 1].colour : cs_v4_all(1));
  s->direct = (cs_direct_edges){&s->active, &s->edges, s->cells, s->boundaries, count, WIDTH};
}

static size_t draw(celspan_context *context, const stage *s, cs_isa isa, cs_row *row) {
  cs_row_clear(row);
  CHECK(cs_row_reserve(context, row, SPANS) == CELSPAN_OK);
  memset(row->spans, 0, SPANS * sizeof *row->spans);
  cs_row_writer writer = cs_row_writer_begin(row, 0);
  size_t done = CS_WIDE_CHOOSE(isa, cs_direct_draw)(&s->direct, &writer);
  cs_row_writer_end(&writer);
  return done;
}

/* The area right of edge i in column p. */
static double cover(const stage *s, size_t i, int32_t p) {
  const cs_bend *bend = cs_active_bend(&s->active, i);
  if (!bend)
    return cs_cover_of(s->x[i], s->x_next[i], 1, p);
  celspan_point vertex = s->vertices[bend->vertex];
  return cs_cover_of(s->x[i], vertex.x, vertex.y, p) +
         cs_cover_of(vertex.x, s->x_next[i], 1 - vertex.y, p);
}

static bool is_mean(const stage *s, const celspan_span *span, size_t done) {
  bool is_right = true;
  for (int32_t p = span->x0; p < span->x1; p++) {
    float found[4];
    cs_v4d sum = cs_v4_wide(s->cells[0].colour);
    celspan_span_colour(span, p, found);
    for (size_t i = 0; i < done; i++)
      sum = cs_v4d_add(sum, cs_v4d_scale(cover(s, i, p),
                                         cs_v4d_step(s->cells[i].colour, s->cells[i + 1].colour)));
    cs_v4 off = cs_v4_load(found) - cs_v4_narrow(sum);
    is_right &= !cs_v4_any_above(cs_v4_max(off, -off), cs_v4_all(2e-6f));
  }
  return is_right;
}

static bool is_same(const celspan_span *a, const celspan_span *b) {
  return memcmp(a, b, offsetof(celspan_span, slope)) == 0 &&
         (a->kind == CELSPAN_SPAN_SINGLE || memcmp(a->slope, b->slope, sizeof a->slope) == 0);
}

/* The spans of the edges drawn: their mean, without gaps, no two neighbours equal. */
static void check_row(const stage *s, const cs_row *row, size_t done) {
  size_t wrong = 0, gradients = 0;
  int32_t from = 0;
  for (size_t k = 0; k < row->count; k++) {
    const celspan_span *span = &row->spans[k], *last = span - 1;
    wrong += span->x0 != from || span->x1 <= from || !is_mean(s, span, done);
    wrong += k > 0 && span->kind == CELSPAN_SPAN_SINGLE && last->kind == span->kind &&
             memcmp(span->colour, last->colour, sizeof span->colour) == 0;
    wrong += span->kind == CELSPAN_SPAN_GRADIENT && span->x1 - from < 2;
    gradients += span->kind == CELSPAN_SPAN_GRADIENT;
    from = span->x1;
  }
  CHECK(wrong == 0 && row->varied.gradients == gradients && row->varied.arrays == 0);
}

static void check_strokes(celspan_context *context, stage *s) {
  cs_row expected, found;
  size_t done = draw(context, s, CS_ISA_ANY, (cs_row_init(&expected), &expected));
  check_row(s, &expected, done);
  cs_row_init(&found);
  for (int isa = CS_ISA_AVX2; isa <= (int)cs_isa_best(); isa++) {
    size_t wrong = draw(context, s, (cs_isa)isa, &found) != done || found.count != expected.count;
    for (size_t k = 0; k < expected.count; k++)
      wrong += !is_same(&expected.spans[k], &found.spans[k]);
    CHECK(wrong == 0);
  }
  cs_row_finish(&expected, context->memory);
  cs_row_finish(&found, context->memory);
}

/* The area right of a line in the pixel of column p, as the mean over heights. */
static double sampled(double xa, double xb, int32_t p) {
  enum { HEIGHTS = 512 };
  double sum = 0;
  for (int i = 0; i < HEIGHTS; i++) {
    double x = xa + (xb - xa) * ((i + 0.5) / HEIGHTS);
    sum += 1 - least(most(x - p, 0), 1);
  }
  return sum / HEIGHTS;
}

/* A line from column 1 on, over up to four columns. */
static void check_cover(test_random *random, int columns) {
  double low = 1 + random_between(random, 0, 1), high = columns + random_between(random, 0, 1);
  double xa = low < high ? low : high, xb = low < high ? high : low;
  double by_twice = cs_cover_by_twice(xa, xb), all = 0;
  for (int32_t p = 0; p < 6; p++) {
    double area = cs_cover_of(xb, xa, 1, p);
    CHECK_NEAR(area, sampled(xa, xb, p), 1e-3);
    CHECK(area == cs_cover_of(xa, xb, 1, p) && area == cs_cover_round(area));
    CHECK_NEAR(cs_cover_of(xa, xb, 0.25, p), area / 4, 0x1p-28);
    all += area + (1 - area);
  }
  CHECK(all == 6);
  CHECK_NEAR(cs_cover_passed(xa, xb, by_twice, 6), 6 - 0.5 * (xa + xb), 1e-12);
  if (columns == 1)
    CHECK_NEAR(cs_cover_within(xa, xb, 2), cs_cover_of(xa, xb, 1, 1), 0x1p-28);
  if (columns > 1) {
    CHECK_NEAR(cs_cover_first(xa, 2, by_twice), cs_cover_of(xa, xb, 1, 1), 0x1p-28);
    CHECK_NEAR(cs_cover_last(xb, columns, by_twice), cs_cover_of(xa, xb, 1, columns), 0x1p-28);
  }
}

int main(void) {
  celspan_context *context;
  static stage s;
  size_t drawn = 0, all = 0;
  test_random random = {31};
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  for (int k = 0; k < 3000; k++) {
    set_stage(&s, &random, random_between(&random, k % 8 ? 0 : -4, 6));
    CHECK(cs_edges_measure(context, &s.edges, &s.active, WIDTH) == CELSPAN_OK);
    check_strokes(context, &s);
    cs_row row;
    cs_row_init(&row);
    drawn += draw(context, &s, CS_ISA_ANY, &row);
    all += s.active.count;
    cs_row_finish(&row, context->memory);
  }
  for (int k = 0; k < 400; k++)
    check_cover(&random, 1 + k % 4);
  CHECK(4 * drawn > all); /* else the test compared too little */
  cs_edges_finish(&s.edges, context->memory);
  celspan_context_destroy(context);
  return check_done();
}
