/* Any bytes as a drawing: no fault, no memory beyond a bound, no leak, every refusal with a
 * sentence that names the drawing, and parts that can be changed.
 */
#include "tests/fuzz/target.h"

#include "celspan/svg.h"

#include "tests/fuzz/meter.h"

#define MOST_BYTES ((size_t)512 << 20)
#ifndef TEST_ROOT
#define TEST_ROOT "." /* where fuzzers run */
#endif

static size_t fail_at, allocations;

/* ---------------------------------------------------------------- a drawing */

static celspan_status turn(void *user, celspan_context *context, celspan_object *part,
                           celspan_object **out) {
  const celspan_matrix matrix = celspan_matrix_rotation(1, (celspan_point){1, 2});
  (void)user;
  return celspan_object_transform(context, part, &matrix, out);
}

static bool is_expected(celspan_status status) {
  return status == CELSPAN_OK || status == CELSPAN_INPUT || status == CELSPAN_LIMIT ||
         status == CELSPAN_NO_MEMORY;
}

/* Changes the first part. A transform may exceed the limits. */
static void change_part(celspan_context *context, const celspan_svg *svg) {
  celspan_svg_changed changed = {NULL, turn, NULL};
  celspan_svg *other = NULL;
  if (celspan_svg_part_count(svg) == 0)
    return;
  celspan_svg_part(svg, 0, &changed.name);
  celspan_status status = celspan_svg_with(context, svg, &changed, 1, &other);
  demand(is_expected(status) || status == CELSPAN_BAD_ARGUMENT, "a change of another kind");
  celspan_svg_unref(other);
}

static void check_drawing(celspan_context *context, const celspan_svg *svg) {
  celspan_box box;
  demand(celspan_svg_object(svg), "a drawing without an object");
  (void)celspan_object_bounds(celspan_svg_object(svg), &box);
  (void)celspan_object_contains(celspan_svg_object(svg), (celspan_point){1, 1});
  for (size_t i = 0; i < celspan_svg_part_count(svg); i++) {
    const char *name;
    demand(celspan_svg_part(svg, i, &name) && *name, "a part without an object or a name");
  }
  for (size_t i = 0; i < celspan_svg_skipped_count(svg); i++) {
    int32_t line;
    demand(*celspan_svg_skipped(svg, i, &line) && line > 0, "a note without a line");
  }
  change_part(context, svg);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  meter m = {{.fail_at = fail_at}, 0, MOST_BYTES};
  celspan_svg_desc desc = CELSPAN_SVG_DESC;
  celspan_context *context = meter_context(&m);
  desc.bytes = size > 0 ? (const void *)data : "";
  desc.size = size;
  desc.name = "fuzz.svg";
  const celspan_svg_font font = {"default", TEST_ROOT "/scripts/type/block.ttf"};
  desc.fonts = &font;
  desc.font_count = 1;
  if (context) {
    celspan_svg *svg = NULL;
    celspan_status status = celspan_svg_read(context, &desc, &svg);
    demand(is_expected(status), "a refusal of another kind");
    if (status == CELSPAN_OK)
      check_drawing(context, svg);
    else if (status != CELSPAN_NO_MEMORY)
      demand(strncmp(celspan_context_error(context), "fuzz.svg:", 9) == 0,
             "a refusal without the drawing's name");
    celspan_svg_unref(svg);
    celspan_context_destroy(context);
  }
  allocations = m.watch.allocations;
  meter_close(&m);
  return 0;
}

#ifdef REPLAY_MAIN
#define REPLAY_FAILURES
#include "tests/fuzz/replay.h"
#endif
