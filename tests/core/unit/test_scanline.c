/* The spans that a scan-line procedure emits on a row: they are checked and cut to the bounds, and
 * their paints stay at the same columns.
 */
#include "model/scene/scanline.h"

#include "tests/support/check.h"
#include "tests/support/memory.h"

static const celspan_paint ramp[3] = {
    {{1, 0, 0}, {1, 1, 1}, 1}, {{0, 1, 0}, {1, 1, 1}, 0.5f}, {{0, 0, 1}, {1, 1, 1}, 1}};

/* The spans a procedure emits, in order. */
typedef struct script {
  double ends[4][2];
  size_t span_count, paint_count;
  int calls;
} script;

static celspan_status play(void *user, celspan_context *context, double y,
                           const celspan_scanline_row *row, celspan_scanline_output *output) {
  script *played = user;
  (void)context, (void)y, (void)row;
  played->calls++;
  for (size_t i = 0; i < played->span_count; i++)
    CS_TRY(celspan_scanline_emit(output, played->ends[i][0], played->ends[i][1], ramp,
                                 played->paint_count));
  return CELSPAN_OK;
}

static celspan_status collect(celspan_context *context, script *played, double y,
                              celspan_scanline_output *output) {
  celspan_scanline_desc desc = {
      .struct_size = sizeof desc, .bounds = {0, 0, 10, 5}, .spans = play, .user = played};
  celspan_scanline_row row = {0, 10, 1};
  return cs_scanline_collect(context, &desc, y, &row, output);
}

static void test_spans_are_cut(celspan_context *context) {
  celspan_scanline_output output;
  cs_scanline_init(&output);
  script played = {{{-4, -2}, {-2, 2}, {3, 3}, {8, 12}}, 4, 3, 0};
  CHECK(collect(context, &played, 1, &output) == CELSPAN_OK);
  CHECK(output.span_count == 2 && output.paint_count == 6);
  CHECK(output.spans[0].x0 == 0 && output.spans[0].x1 == 2);
  CHECK(output.spans[0].paint_x0 == -2 && output.spans[0].paint_x1 == 2);
  CHECK(output.spans[1].x0 == 8 && output.spans[1].x1 == 10);
  CHECK(output.spans[1].paint_x0 == 8 && output.spans[1].paint_x1 == 12);
  CHECK(output.spans[1].first_paint == 3 && output.spans[1].paint_count == 3);
  CHECK(output.paints[4].s[1] == 0.5f && output.paints[4].t[0] == 0.5f);
  cs_scanline_finish(&output, context->memory);
}

static void test_rows_outside_are_not_asked_for(celspan_context *context) {
  celspan_scanline_output output;
  cs_scanline_init(&output);
  script played = {{{1, 2}}, 1, 1, 0};
  CHECK(collect(context, &played, -0.01, &output) == CELSPAN_OK && output.span_count == 0);
  CHECK(collect(context, &played, 5, &output) == CELSPAN_OK && output.span_count == 0);
  CHECK(played.calls == 0);
  CHECK(collect(context, &played, 0, &output) == CELSPAN_OK && output.span_count == 1);
  CHECK(collect(context, &played, 4.99, &output) == CELSPAN_OK && output.span_count == 1);
  cs_scanline_finish(&output, context->memory);
}

static void test_span_without_paint_is_refused(celspan_context *context) {
  celspan_scanline_output output;
  cs_scanline_init(&output);
  script played = {{{1, 2}}, 1, 0, 0};
  CHECK(collect(context, &played, 1, &output) == CELSPAN_CALLBACK);
  CHECK_TEXT(celspan_context_error(context), "scanline: span 1 at y = 1 has no paint");
  cs_scanline_finish(&output, context->memory);
}

static celspan_status emit_bad_paint(void *user, celspan_context *context, double y,
                                     const celspan_scanline_row *row,
                                     celspan_scanline_output *output) {
  const celspan_paint paints[2] = {ramp[0], {{0, 2, 0}, {1, 1, 1}, 1}};
  (void)user, (void)context, (void)y, (void)row;
  return celspan_scanline_emit(output, 1, 2, paints, 2);
}

static void test_bad_paint_is_refused(celspan_context *context) {
  celspan_scanline_output output;
  cs_scanline_init(&output);
  celspan_scanline_desc desc = {
      .struct_size = sizeof desc, .bounds = {0, 0, 10, 5}, .spans = emit_bad_paint};
  celspan_scanline_row row = {0, 10, 1};
  CHECK(cs_scanline_collect(context, &desc, 2.5, &row, &output) == CELSPAN_CALLBACK);
  CHECK_TEXT(celspan_context_error(context),
             "scanline: paint 2 of span 1 at y = 2.5 has a value outside 0..1");
  cs_scanline_finish(&output, context->memory);
}

static void check_ends(celspan_context *context, double x0, double x1, const char *sentence) {
  celspan_scanline_output output;
  cs_scanline_init(&output);
  script played = {{{1, 2}, {x0, x1}, {3, 4}}, 3, 1, 0};
  CHECK(collect(context, &played, 1, &output) == CELSPAN_CALLBACK);
  CHECK_TEXT(celspan_context_error(context), sentence);
  cs_scanline_finish(&output, context->memory);
}

static void test_bad_ends_are_refused(celspan_context *context) {
  check_ends(context, NAN, 4,
             "scanline: the beginning of span 2 at y = 1 must be a finite number, got nan");
  check_ends(context, 2, INFINITY,
             "scanline: the end of span 2 at y = 1 must be a finite number, got inf");
  check_ends(context, 2e12, 3e12,
             "scanline: the beginning of span 2 at y = 1 must be a number between -1e12 and 1e12, "
             "got 2e12");
  check_ends(
      context, 3, 2e12,
      "scanline: the end of span 2 at y = 1 must be a number between -1e12 and 1e12, got 2e12");
  check_ends(context, 4, 3, "scanline: span 2 at y = 1 ends at 3, before it begins at 4");
  check_ends(context, 1.5, 3,
             "scanline: span 2 at y = 1 begins at 1.5, before the one before it ends at 2; "
             "spans must ascend and not overlap");
}

static celspan_status emit_without_looking(void *user, celspan_context *context, double y,
                                           const celspan_scanline_row *row,
                                           celspan_scanline_output *output) {
  (void)user, (void)context, (void)y, (void)row;
  for (int i = 4; i > 0; i--)
    CHECK(celspan_scanline_emit(output, i, i + 1, ramp, 1) ==
          (i == 4 ? CELSPAN_OK : CELSPAN_CALLBACK));
  return CELSPAN_OK;
}

/* If a procedure continues after a refusal, both it and the caller get the first refusal. */
static void test_refusal_lasts(celspan_context *context) {
  celspan_scanline_output output;
  cs_scanline_init(&output);
  celspan_scanline_desc desc = {
      .struct_size = sizeof desc, .bounds = {0, 0, 10, 5}, .spans = emit_without_looking};
  celspan_scanline_row row = {0, 10, 1};
  CHECK(cs_scanline_collect(context, &desc, 1, &row, &output) == CELSPAN_CALLBACK);
  CHECK(strstr(celspan_context_error(context), "span 2 at y = 1 begins at 3"));
  cs_scanline_finish(&output, context->memory);
}

/* After a refused row the same output serves the next one. */
static void test_output_is_used_again(celspan_context *context) {
  celspan_scanline_output output;
  cs_scanline_init(&output);
  script wrong = {{{1, 4}, {3, 5}}, 2, 1, 0}, right = {{{1, 2}, {2, 3}}, 2, 1, 0};
  CHECK(collect(context, &wrong, 1, &output) == CELSPAN_CALLBACK);
  CHECK(collect(context, &right, 1, &output) == CELSPAN_OK && output.span_count == 2);
  cs_scanline_finish(&output, context->memory);
}

static void test_failing_allocations(void) {
  celspan_status status = CELSPAN_NO_MEMORY;
  for (size_t n = 1; status != CELSPAN_OK && n < 10; n++) {
    memory_watch watch = {0};
    celspan_context *context = memory_watch_context(&watch);
    celspan_scanline_output output;
    cs_scanline_init(&output);
    script played = {{{1, 2}}, 1, 1, 0};
    watch.fail_at = watch.allocations + n;
    status = collect(context, &played, 1, &output);
    CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
    cs_scanline_finish(&output, context->memory);
    celspan_context_destroy(context);
    CHECK(watch.blocks == 0 && watch.size_errors == 0);
  }
  CHECK(status == CELSPAN_OK);
}

int main(void) {
  void (*const tests[])(celspan_context *) = {
      test_spans_are_cut,
      test_rows_outside_are_not_asked_for,
      test_span_without_paint_is_refused,
      test_bad_paint_is_refused,
      test_bad_ends_are_refused,
      test_refusal_lasts,
      test_output_is_used_again,
  };
  for (size_t i = 0; i < sizeof tests / sizeof *tests; i++) {
    memory_watch watch = {0};
    celspan_context *context = memory_watch_context(&watch);
    tests[i](context);
    celspan_context_destroy(context);
    CHECK(watch.blocks == 0 && watch.size_errors == 0);
  }
  test_failing_allocations();
  return check_done();
}
