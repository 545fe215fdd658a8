/* Shifts from C: what is refused, and the nodes that are read, which every instruction set mixes
 * alike. spec/displace compares frames with a second implementation. */
#include <math.h>
#include <string.h>

#include "engine/defocus/shifted.h"
#include "model/colour/space.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

#define COLUMNS 9
#define ROWS 6
#define PLACES 37

static celspan_context *context;
static test_random random_state = {1};

/* ---------------------------------------------------------------- reads */

typedef struct grid {
  float nodes[2][ROWS][4 * COLUMNS]; /* by plane */
  const float *rows[ROWS];
  double x[PLACES], y[PLACES];
} grid;

/* Places are anywhere among the nodes, also on the last ones. */
static void fill(grid *g) {
  for (int row = 0; row < ROWS; row++) {
    g->rows[row] = g->nodes[0][row];
    for (int i = 0; i < 4 * COLUMNS; i++)
      for (int plane = 0; plane < 2; plane++)
        g->nodes[plane][row][i] = (float)random_between(&random_state, 0, 2);
  }
  for (int k = 0; k < PLACES; k++) {
    g->x[k] = k % 5 == 0 ? COLUMNS - 1 : random_between(&random_state, 0, COLUMNS - 1);
    g->y[k] = k % 7 == 0 ? ROWS - 1 : random_between(&random_state, 0, ROWS - 1);
  }
}

/* One value of a node, mixed from the four around a place. */
static float mixed(const grid *g, int plane, int k, int lane) {
  int i = g->x[k] < COLUMNS - 2 ? (int)g->x[k] : COLUMNS - 2;
  int j = g->y[k] < ROWS - 2 ? (int)g->y[k] : ROWS - 2;
  const float *upper = g->nodes[plane][j] + 4 * i + lane;
  const float *lower = g->nodes[plane][j + 1] + 4 * i + lane;
  float across = (float)(g->x[k] - i), down = (float)(g->y[k] - j);
  float a = upper[0] + across * (upper[4] - upper[0]);
  float b = lower[0] + across * (lower[4] - lower[0]);
  return a + down * (b - a);
}

static void check_reads(const grid *g, int plane, int count, bool adds) {
  const cs_shifted_nodes nodes = {g->rows, (size_t)plane * (ROWS * 4 * COLUMNS), COLUMNS, ROWS};
  float out[3][4 * PLACES];
  for (cs_isa isa = CS_ISA_ANY; isa <= cs_isa_best(); isa++) {
    for (int i = 0; i < 4 * PLACES; i++)
      out[isa][i] = (float)i;
    CS_WIDE_CHOOSE(isa, cs_shifted_read)(&nodes, g->x, g->y, count, adds, out[isa]);
    CHECK(memcmp(out[isa], out[CS_ISA_ANY], sizeof *out) == 0);
  }
  for (int i = 0; i < 4 * PLACES; i++) {
    float want = (float)i;
    if (i < 4 * count)
      want = mixed(g, plane, i / 4, i % 4) + (adds ? want : 0);
    CHECK(out[CS_ISA_ANY][i] == want);
  }
}

static void test_reads(void) {
  static grid g;
  fill(&g);
  for (int count = 1; count <= PLACES; count++)
    for (int plane = 0; plane < 2; plane++) {
      check_reads(&g, plane, count, false);
      check_reads(&g, plane, count, true);
    }
}

/* ---------------------------------------------------------------- moves */

/* The exact rule: p + scale (code - 1/2). */
static double moved(const cs_shifted_moving *moving, const float node[4]) {
  const float alpha = node[CELSPAN_CHANNEL_ALPHA];
  bool is_alpha = moving->channel == CELSPAN_CHANNEL_ALPHA;
  float share = fminf(fmaxf(is_alpha ? alpha : node[moving->channel] / alpha, 0), 1);
  if (moving->is_converted && !is_alpha)
    share = cs_space_channel(moving->space, share, 1);
  return alpha > 0 ? moving->scale * ((double)share - 0.5) : moving->clear;
}

static void check_moves(const cs_shifted_moving *moving, const float (*nodes)[4], int count) {
  double out[3][PLACES];
  for (cs_isa isa = CS_ISA_ANY; isa <= cs_isa_best(); isa++) {
    memset(out[isa], 0, sizeof *out);
    CS_WIDE_CHOOSE(isa, cs_shifted_moves)(moving, nodes, count, out[isa]);
    CHECK(memcmp(out[isa], out[CS_ISA_ANY], sizeof *out) == 0);
  }
  for (int k = 0; k < count; k++)
    CHECK(fabs(out[0][k] - moved(moving, nodes[k])) <= 5e-7 * moving->scale);
}

/* Light of all sizes, also darker than black and brighter than its alpha, and none. */
static void test_moves(void) {
  float nodes[PLACES][4];
  for (int k = 0; k < PLACES; k++) {
    float alpha = k % 5 == 0 ? 0 : (float)random_between(&random_state, 0, 1);
    for (int c = 0; c < 3; c++)
      nodes[k][c] = alpha * (float)pow(random_between(&random_state, -0.3, 1.05), 3);
    nodes[k][3] = alpha;
  }
  for (int channel = CELSPAN_CHANNEL_RED; channel <= CELSPAN_CHANNEL_ALPHA; channel++)
    for (int way = 0; way < 3; way++) {
      const cs_shifted_moving moving = {(celspan_channel)channel, way < 2,
                                        way == 0 ? CELSPAN_SPACE_SRGB : CELSPAN_SPACE_LINEAR, 80,
                                        -40};
      for (int count = 1; count <= PLACES; count += 6)
        check_moves(&moving, (const float(*)[4])nodes, count);
    }
}

/* ---------------------------------------------------------------- refused */

static celspan_object *square(void) {
  const celspan_rect_desc desc = {sizeof desc, 0, 0, 10, 10, 0, NULL};
  celspan_object *out;
  CHECK(celspan_object_create_rect(context, &desc, &out) == CELSPAN_OK);
  return out;
}

static celspan_status displaced(celspan_displace_desc desc, bool has_by) {
  celspan_object *art = square(), *out = NULL;
  desc.by = has_by ? art : NULL;
  celspan_status status = celspan_object_displace(context, art, &desc, &out);
  celspan_object_unref(out);
  celspan_object_unref(art);
  return status;
}

static celspan_status blurred(celspan_blur_desc desc) {
  celspan_object *art = square(), *out = NULL;
  celspan_status status = celspan_object_blur(context, art, &desc, &out);
  celspan_object_unref(out);
  celspan_object_unref(art);
  return status;
}

static void test_displacement_refused(void) {
  const celspan_displace_desc good = CELSPAN_DISPLACE_DESC;
  const double wrong[] = {NAN, INFINITY, 1.1e6, -1.1e6};
  celspan_displace_desc desc = good;
  CHECK(displaced(good, true) == CELSPAN_OK);
  CHECK(displaced(good, false) == CELSPAN_BAD_ARGUMENT);
  for (int i = 0; i < 4; i++) {
    desc.scale = wrong[i];
    CHECK(displaced(desc, true) == CELSPAN_BAD_ARGUMENT);
  }
  desc = good;
  desc.y = (celspan_channel)4;
  CHECK(displaced(desc, true) == CELSPAN_BAD_ARGUMENT);
  desc = good;
  desc.space = (celspan_space)3;
  CHECK(displaced(desc, true) == CELSPAN_BAD_ARGUMENT);
}

static void test_blur_refused(void) {
  const double most[] = {0, CELSPAN_BLUR_MOST, 90, 180};
  for (int along = CELSPAN_BLUR_LINE; along <= CELSPAN_BLUR_SPIN; along++) {
    celspan_blur_desc good = CELSPAN_BLUR_DESC, desc;
    good.along = (celspan_blur_along)along;
    good.radius = most[along];
    CHECK(blurred(good) == CELSPAN_OK);
    desc = good;
    desc.radius = nextafter(most[along], INFINITY);
    CHECK(blurred(desc) == CELSPAN_BAD_ARGUMENT);
    desc.radius = NAN;
    CHECK(blurred(desc) == CELSPAN_BAD_ARGUMENT);
    desc = good;
    desc.degrees = INFINITY;
    CHECK(blurred(desc) == CELSPAN_BAD_ARGUMENT);
    desc = good;
    desc.centre.y = NAN;
    CHECK(blurred(desc) == CELSPAN_BAD_ARGUMENT);
    desc = good;
    desc.kernel = CELSPAN_DEFOCUS_DISC;
    CHECK(blurred(desc) == CELSPAN_BAD_ARGUMENT);
  }
  celspan_blur_desc unknown = CELSPAN_BLUR_DESC;
  unknown.along = (celspan_blur_along)4;
  CHECK(blurred(unknown) == CELSPAN_BAD_ARGUMENT);
}

int main(void) {
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  test_reads();
  test_moves();
  test_displacement_refused();
  test_blur_refused();
  celspan_context_destroy(context);
  return check_done();
}
