/* Rows of nodes of defocused cels: nodes that were not written are not read, and the loops that
 * make them give the same bits with every instruction set.
 */
#include <math.h>
#include <string.h>

#include "engine/defocus/regrid.h"
#include "engine/defocus/sample_sums.h"
#include "engine/defocus/slices.h"
#include "engine/defocus/swept_lines.h"
#include "engine/sample/defocused.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"
#include "tests/support/random.h"

enum { GROUP = CS_DEFOCUSED_GROUP, MOST = 83, ROOM = 400 };

/* ---------------------------------------------------------------- even groups */

typedef struct nodes {
  int32_t count;
  float whole[2][MOST][4];   /* all nodes */
  float written[2][MOST][4]; /* of even groups only the ends */
  bool even[MOST];
} nodes;

/* Stretches of one colour and slopes, in any order. */
static void random_nodes(test_random *random, nodes *n) {
  n->count = 2 + random_below(random, MOST - 2);
  for (int32_t x = 0; x < n->count;) {
    int32_t end = x + 1 + random_below(random, 30);
    bool is_even = random_below(random, 2);
    float slope = is_even ? 0 : (float)random_between(random, -0.05, 0.05);
    float start = (float)random_below(random, 3) / 3;
    for (int32_t from = x; x < end && x < n->count; x++)
      for (int i = 0; i < 8; i++)
        n->whole[i / 4][x][i % 4] = start + (float)(x - from) * slope * (i % 4 == 1 ? 2 : 1);
  }
}

static void find_even(nodes *n, int planes) {
  memcpy(n->written, n->whole, sizeof n->whole);
  for (int32_t first = 0; first < n->count; first += GROUP) {
    int32_t end = first + GROUP < n->count ? first + GROUP : n->count;
    bool *even = &n->even[first / GROUP];
    *even = true;
    for (int32_t x = first + 1; x < end; x++)
      for (int p = 0; p < planes; p++)
        *even &= memcmp(n->whole[p][x], n->whole[p][first], sizeof n->whole[p][x]) == 0;
    for (int32_t x = first + 1; *even && x < end - 1; x++)
      for (int i = 0; i < 8; i++)
        n->written[i / 4][x][i % 4] = NAN;
  }
}

static void check_even(celspan_context *context, test_random *random) {
  static nodes n;
  cs_defocus_band bands[2] = {{0}, {0}};
  cs_defocused grid = {
      .pitch_x = random_below(random, 2) ? 1 : 1.5, .pitch_y = 1, .band_rows = 1, .planes = 1};
  grid.planes += random_below(random, 2);
  random_nodes(random, &n);
  find_even(&n, grid.planes);
  grid.columns = n.count;
  for (int i = 0; i < 2; i++) {
    float(*from)[MOST][4] = i == 0 ? n.whole : n.written;
    cs_defocused_nodes row = {{(const float(*)[4])from[0], (const float(*)[4])from[1]},
                              i == 0 ? NULL : n.even};
    CHECK(cs_defocus_band_begin(context, 1, &bands[i]) == CELSPAN_OK);
    CHECK(cs_defocus_band_add(&grid, context, &row, &bands[i]) == CELSPAN_OK);
    CHECK(cs_defocus_band_end(&grid, context, &bands[i]) == CELSPAN_OK);
  }
  const cs_node_polyline *a = &bands[0].polyline, *b = &bands[1].polyline;
  if (CHECK(a->count == b->count && a->at[a->count - 1] == n.count - 1)) {
    CHECK(memcmp(a->at, b->at, a->count * sizeof *a->at) == 0);
    CHECK(memcmp(a->values, b->values, a->count * (size_t)grid.planes * sizeof *a->values) == 0);
  }
  for (int i = 0; i < 2; i++)
    cs_defocus_band_free(&bands[i], context->memory);
}

/* ---------------------------------------------------------------- sets of instructions */

static void fill(test_random *random, float *values, size_t count) {
  for (size_t i = 0; i < count; i++)
    values[i] = (float)random_between(random, 0, 1);
}

static void check_spread(cs_isa isa, test_random *random) {
  float low[24], high[24], shares[24];
  cs_defocus_halves step, near[2][24];
  int32_t count = random_below(random, 24);
  fill(random, low, 24), fill(random, high, 24);
  fill(random, (float *)&step, 8), fill(random, (float *)near[0], sizeof near[0] / 4);
  memcpy(near[1], near[0], sizeof near[0]);
  CS_WIDE_CHOOSE(CS_ISA_ANY, cs_defocus_lines_spread)
  (low, high, 0.3f, count, shares, &step, near[0]);
  CS_WIDE_CHOOSE(isa, cs_defocus_lines_spread)(low, high, 0.3f, count, shares, &step, near[1]);
  CHECK(memcmp(near[0], near[1], sizeof near[0]) == 0);
}

static void check_sum(cs_isa isa, test_random *random) {
  enum { COUNT = 13 };
  cs_defocus_halves near[2][COUNT];
  cs_defocus_passed steps[2][COUNT], sums[2];
  cs_v4 below[2][COUNT], lines[2][COUNT] = {{{0}}};
  fill(random, (float *)near[0], sizeof near[0] / 4);
  fill(random, (float *)below[0], sizeof below[0] / 4);
  for (size_t i = 0; i < COUNT; i++)
    for (size_t c = 0; c < 8; c++)
      ((double *)&steps[0][i])[c] = random_between(random, -1, 1);
  sums[0] = steps[0][0];
  memcpy(near[1], near[0], sizeof near[0]);
  memcpy(steps[1], steps[0], sizeof steps[0]);
  memcpy(below[1], below[0], sizeof below[0]);
  sums[1] = sums[0];
  int32_t first = random_below(random, COUNT), end = first + random_below(random, COUNT - first);
  for (int i = 0; i < 2; i++) {
    cs_defocus_columns columns = {.near = near[i], .steps = steps[i], .below = below[i]};
    CS_WIDE_CHOOSE(i == 0 ? CS_ISA_ANY : isa, cs_defocus_lines_sum)
    (&columns, first, end, &sums[i], lines[i]);
  }
  CHECK(memcmp(lines[0], lines[1], sizeof lines[0]) == 0);
  CHECK(memcmp(below[0], below[1], sizeof below[0]) == 0);
  CHECK(memcmp(near[0], near[1], sizeof near[0]) == 0);
  CHECK(memcmp(steps[0], steps[1], sizeof steps[0]) == 0);
  CHECK(memcmp(&sums[0], &sums[1], sizeof sums[0]) == 0);
}

static void check_sums(cs_isa isa, test_random *random) {
  enum { COUNT = CS_DEFOCUS_SUMS_TOGETHER };
  float values[ROOM], out[2][4 * COUNT];
  cs_defocus_pair pairs[9];
  cs_defocus_slice slices[9];
  fill(random, values, ROOM);
  for (int i = 0; i < 9; i++) {
    size_t at[4];
    for (int k = 0; k < 4; k++)
      at[k] = 4 * (size_t)random_below(random, (ROOM - 4 * COUNT) / 4);
    pairs[i] = (cs_defocus_pair){at[0], at[1], (float)random_between(random, 0, 1)};
    slices[i] = (cs_defocus_slice){{at[0], at[1]}, {at[2], at[3]}, {0.3f, 0.1f}, {0.2f, 0.4f}};
  }
  for (int i = 0; i < 2; i++)
    CS_WIDE_CHOOSE(i == 0 ? CS_ISA_ANY : isa, cs_defocus_sums_about)
  (pairs, 9, values, 40, COUNT, out[i]);
  CHECK(memcmp(out[0], out[1], sizeof out[0]) == 0);
  for (int i = 0; i < 2; i++)
    CS_WIDE_CHOOSE(i == 0 ? CS_ISA_ANY : isa, cs_defocus_slices_sum)
  (slices, 9, values, COUNT, out[i]);
  CHECK(memcmp(out[0], out[1], sizeof out[0]) == 0);
}

/* The weighted mean of four values, by their differences from the second one. */
static float mean(const float weights[3], float a, float b, float c, float d) {
  return b - (weights[0] * (b - a) + weights[1] * (b - c) + weights[2] * (b - d));
}

static void check_mixed(const float *const four[4], const float weights[3], const float *mixed,
                        size_t count) {
  for (size_t i = 0; i < count; i++)
    CHECK(fabsf(mixed[i] - mean(weights, four[0][i], four[1][i], four[2][i], four[3][i])) < 1e-5f);
}

/* Four rows mixed into one, and columns of it, as many as there are. */
static void check_regrid(cs_isa isa, test_random *random) {
  enum { NODES = 40, COLUMNS = 13 };
  float rows[4][4 * NODES], mixed[2][NODES][4], out[2][COLUMNS][4] = {{{0}}};
  cs_regrid_column columns[COLUMNS];
  size_t across = 4 + (size_t)random_below(random, NODES - 3);
  int32_t count = random_below(random, COLUMNS + 1);
  fill(random, rows[0], 16 * NODES);
  for (int i = 0; i < COLUMNS; i++) {
    columns[i].first = random_below(random, (int32_t)across - 3);
    fill(random, columns[i].weights, 3);
  }
  for (int i = 0; i < 2; i++) {
    cs_isa by = i == 0 ? CS_ISA_ANY : isa;
    const float *const four[4] = {rows[0], rows[1], rows[2], rows[3]};
    CS_WIDE_CHOOSE(by, cs_regrid_mix)(four, columns[0].weights, 4 * across, mixed[i][0]);
    check_mixed(four, columns[0].weights, mixed[i][0], 4 * across);
    CS_WIDE_CHOOSE(by, cs_regrid_across)
    (columns, count, (const float(*)[4])mixed[i], out[i]);
  }
  CHECK(memcmp(mixed[0], mixed[1], across * sizeof mixed[0][0]) == 0);
  CHECK(memcmp(out[0], out[1], sizeof out[0]) == 0);
}

/* What can be seen of a row, of which one end, both or all of it are clear. */
static void check_seen(cs_isa isa, test_random *random) {
  enum { NODES = 70 };
  float row[NODES][4] = {{0}};
  int32_t low = random_below(random, NODES), high = random_below(random, NODES);
  int32_t first = random_below(random, NODES), end = first + random_below(random, NODES - first);
  for (int32_t i = low; i < high; i++)
    row[i][random_below(random, 4)] = 0.5f;
  const cs_defocused_range within = {first, end};
  cs_defocused_range seen = CS_WIDE_CHOOSE(isa, cs_regrid_visible)((const float(*)[4])row, within);
  low = low > first ? low : first;
  high = high < end ? high : end;
  CHECK(seen.end - seen.first == (low < high ? high - low : 0));
  CHECK(low >= high || seen.first == low);
}

int main(void) {
  test_random random = {41};
  celspan_context *context;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  for (int k = 0; k < 4000; k++)
    check_even(context, &random);
  celspan_context_destroy(context);
  for (int isa = CS_ISA_ANY; isa <= (int)cs_isa_best(); isa++)
    for (int k = 0; k < 300; k++) {
      check_spread((cs_isa)isa, &random);
      check_sum((cs_isa)isa, &random);
      check_sums((cs_isa)isa, &random);
      check_regrid((cs_isa)isa, &random);
      check_seen((cs_isa)isa, &random);
    }
  return check_done();
}
