/* Rows of spans: merging, cropping, and the exposures of one frame. */
#include "engine/span/row.h"

#include "model/colour/space.h"
#include "tests/support/check.h"

static celspan_context *context;

static cs_v4 grey(float value, float alpha) { return (cs_v4){value, value, value, alpha}; }

static float red_at(const cs_row *row, int32_t x) {
  float rgba[4] = {-1, -1, -1, -1};
  for (size_t i = 0; i < row->count; i++)
    if (row->spans[i].x0 <= x && x < row->spans[i].x1)
      celspan_span_colour(&row->spans[i], x, rgba);
  return rgba[0];
}

static void test_merging(void) {
  cs_row row;
  cs_row_init(&row);
  CHECK(cs_row_single(context, &row, 0, 3, grey(0.5f, 1)) == CELSPAN_OK);
  CHECK(cs_row_single(context, &row, 3, 3, grey(0.1f, 1)) == CELSPAN_OK);
  CHECK(cs_row_single(context, &row, 3, 7, grey(0.5f, 1)) == CELSPAN_OK);
  CHECK(row.count == 1 && row.spans[0].x1 == 7);
  CHECK(cs_row_single(context, &row, 7, 8, grey(0.5f, 0.5f)) == CELSPAN_OK);
  CHECK(cs_row_gradient(context, &row, 8, 12, grey(0, 1), grey(0, 0)) == CELSPAN_OK);
  CHECK(row.count == 3 && row.spans[2].kind == CELSPAN_SPAN_SINGLE && row.varied.gradients == 0);
  CHECK(cs_row_gradient(context, &row, 12, 16, grey(0, 1), grey(0.25f, 0)) == CELSPAN_OK);
  CHECK(row.count == 4 && row.varied.gradients == 1);
  cs_row_finish(&row, context->memory);
}

/* Cropping moves no colour: every column keeps its colour. */
static void test_cropping(void) {
  for (int32_t from = 0; from < 20; from++) {
    cs_row row, whole;
    for (cs_row *r = &row;; r = &whole) {
      float *array;
      cs_row_init(r);
      CHECK(cs_row_single(context, r, 0, 6, grey(0.25f, 1)) == CELSPAN_OK);
      CHECK(cs_row_gradient(context, r, 6, 13, grey(0.1f, 1), grey(0.07f, 0)) == CELSPAN_OK);
      CHECK(cs_row_array(context, r, 13, 20, &array) == CELSPAN_OK);
      for (int i = 0; i < 28; i++)
        array[i] = (float)i;
      if (r == &whole)
        break;
    }
    int32_t to = from + 5 < 20 ? from + 5 : 20;
    cs_row_crop(&row, from, to);
    CHECK(row.spans[0].x0 == 0 && row.spans[row.count - 1].x1 == to - from);
    for (int32_t x = from; x < to; x++)
      CHECK(red_at(&row, x - from) == red_at(&whole, x));
    cs_row_finish(&row, context->memory);
    cs_row_finish(&whole, context->memory);
  }
}

/* Light adds, weighted; so does alpha, clamped to 1 from the column where it exceeds it. */
static void test_exposing(void) {
  cs_row rows[2], sum;
  float weights[2] = {0.5f, 2};
  cs_row_init(&rows[0]);
  cs_row_init(&rows[1]);
  cs_row_init(&sum);
  CHECK(cs_row_single(context, &rows[0], 0, 10, grey(0.5f, 0.25f)) == CELSPAN_OK);
  CHECK(cs_row_gradient(context, &rows[1], 0, 8, (cs_v4){0.125f, 0, 0, 0},
                        (cs_v4){0.0625f, 0, 0, 0.125f}) == CELSPAN_OK);
  CHECK(cs_row_single(context, &rows[1], 8, 10, grey(3, 0.75f)) == CELSPAN_OK);
  CHECK(cs_row_expose(context, &sum, CELSPAN_SPACE_LINEAR, rows, weights, 2) == CELSPAN_OK);
  CHECK(sum.spans[0].x0 == 0 && sum.spans[sum.count - 1].x1 == 10);
  for (size_t i = 0; i < sum.count; i++) {
    CHECK(sum.spans[i].kind != CELSPAN_SPAN_ARRAY);
    for (int32_t x = sum.spans[i].x0; x < sum.spans[i].x1; x++) {
      float rgba[4], alpha = 0.5f * 0.25f + 2 * (x < 8 ? 0.125f * (float)x : 0.75f);
      celspan_span_colour(&sum.spans[i], x, rgba);
      CHECK_NEAR(rgba[0], 0.25f + 2 * (x < 8 ? 0.125f + 0.0625f * (float)x : 3), 1e-6);
      CHECK_NEAR(rgba[3], alpha > 1 ? 1 : alpha, 1e-6);
    }
  }
  for (int i = 0; i < 2; i++)
    cs_row_finish(&rows[i], context->memory);
  cs_row_finish(&sum, context->memory);
}

enum { EXPOSURES = 3, COLUMNS = 1200 };

/* Spans of every kind, which end elsewhere in every row; its arrays are longer or shorter than the
 * spans that lie beside them. */
static void fill_row(cs_row *row, int number) {
  cs_row_init(row);
  for (int32_t x0 = 0, k = number; x0 < COLUMNS; k++) {
    int32_t x1 = x0 + 1 + 20 * ((5 * k + 3 * number) % 11);
    x1 = x1 < COLUMNS ? x1 : COLUMNS;
    float *array;
    cs_v4 colour = grey(0.03f * (float)(k % 29), 0.1f * (float)(k % 7));
    if (k % 3 == 0) {
      CHECK(cs_row_single(context, row, x0, x1, colour) == CELSPAN_OK);
    } else if (k % 3 == 1) {
      CHECK(cs_row_gradient(context, row, x0, x1, colour, grey(0.013f, 0.007f)) == CELSPAN_OK);
    } else {
      CHECK(cs_row_array(context, row, x0, x1, &array) == CELSPAN_OK);
      for (int32_t i = 0; i < 4 * (x1 - x0); i++)
        array[i] = 0.037f * (float)((x0 + i) % 31);
    }
    x0 = x1;
  }
}

/* What the exposures of one column add up to. */
static void add_column(celspan_space space, const cs_row *rows, const float *weights, int32_t x,
                       float sum[4]) {
  memset(sum, 0, 4 * sizeof *sum);
  for (int i = 0; i < EXPOSURES; i++) {
    float rgba[4];
    for (size_t k = 0; k < rows[i].count; k++)
      if (rows[i].spans[k].x0 <= x && x < rows[i].spans[k].x1)
        celspan_span_colour(&rows[i].spans[k], x, rgba);
    cs_space_decode(space, rgba);
    for (int c = 0; c < 4; c++)
      sum[c] += weights[i] * rgba[c];
  }
  sum[3] = sum[3] > 1 ? 1 : sum[3];
  cs_space_encode(space, sum);
}

/* Columns of single spans and arrays are what they are one by one, to the bit. */
static void test_columns(celspan_space space) {
  const float weights[EXPOSURES] = {0.3f, 0.6f, 0.7f};
  cs_row rows[EXPOSURES], sum;
  int32_t columns = 0, wrong = 0;
  for (int i = 0; i < EXPOSURES; i++)
    fill_row(&rows[i], i);
  cs_row_init(&sum);
  CHECK(cs_row_expose(context, &sum, space, rows, weights, EXPOSURES) == CELSPAN_OK);
  CHECK(sum.spans[0].x0 == 0 && sum.spans[sum.count - 1].x1 == COLUMNS);
  for (const celspan_span *span = sum.spans; span < sum.spans + sum.count; span++)
    for (int32_t x = span->x0; x < span->x1 && span->kind != CELSPAN_SPAN_GRADIENT; x++) {
      float found[4], wanted[4];
      celspan_span_colour(span, x, found);
      add_column(space, rows, weights, x, wanted);
      wrong += memcmp(found, wanted, sizeof found) != 0;
      columns++;
    }
  CHECK(wrong == 0 && columns > COLUMNS / 2);
  for (int i = 0; i < EXPOSURES; i++)
    cs_row_finish(&rows[i], context->memory);
  cs_row_finish(&sum, context->memory);
}

#ifdef CELSPAN_CHECKS
/* The self-check finds every fault of a row, and nothing else. */
static void test_self_check(void) {
  cs_row row;
  cs_row_init(&row);
  CHECK(!cs_row_is_whole(&row, 6));
  CHECK(cs_row_single(context, &row, 0, 3, grey(0.5f, 1)) == CELSPAN_OK);
  CHECK(!cs_row_is_whole(&row, 6));
  CHECK(cs_row_gradient(context, &row, 3, 6, grey(0, 1), grey(0.25f, 0)) == CELSPAN_OK);
  CHECK(cs_row_is_whole(&row, 6));
  CHECK(!cs_row_is_whole(&row, 7));
  row.spans[1].x0 = 4;
  CHECK(!cs_row_is_whole(&row, 6));
  row.spans[1].x0 = 3;
  row.varied.gradients = 0;
  CHECK(!cs_row_is_whole(&row, 6));
  row.spans[1].kind = CELSPAN_SPAN_SINGLE;
  CHECK(cs_row_is_whole(&row, 6));
  cs_v4_store(row.spans[1].colour, grey(0.5f, 1));
  CHECK(!cs_row_is_whole(&row, 6));
  cs_row_finish(&row, context->memory);
}
#endif

int main(void) {
  if (celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  test_merging();
  test_cropping();
  test_exposing();
  test_columns(CELSPAN_SPACE_LINEAR);
  test_columns(CELSPAN_SPACE_SRGB);
#ifdef CELSPAN_CHECKS
  test_self_check();
#endif
  celspan_context_destroy(context);
  return check_done();
}
