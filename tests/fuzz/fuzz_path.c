/* Any bytes as path data: no fault, no leak, every refusal with a sentence; an accepted path has
 * bounds, and is drawn in the same way as pixels and as rows.
 *
 *   byte 0   0: rule, 1 to 7: how it is antialiased
 *   then     the data
 */
#include "tests/fuzz/target.h"

#include <math.h>

#include "tests/fuzz/meter.h"

#define MOST_BYTES ((size_t)64 << 20)
#define SIDE 8   /* pixels */
#define RUNS 256 /* in one context */

static meter memory = {.limit = MOST_BYTES};

static bool is_expected(celspan_status status) {
  return status == CELSPAN_OK || status == CELSPAN_BAD_ARGUMENT || status == CELSPAN_LIMIT ||
         status == CELSPAN_NO_MEMORY;
}

static celspan_rostrum *make_rostrum(celspan_context *context, celspan_object *object) {
  celspan_cel_desc cel_desc = CELSPAN_CEL_DESC;
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  celspan_cel *cel = NULL;
  celspan_rostrum *rostrum = NULL;
  cel_desc.objects = &object;
  cel_desc.object_count = 1;
  if (celspan_cel_create(context, &cel_desc, &cel) != CELSPAN_OK)
    return NULL;
  desc.cels = &cel;
  desc.cel_count = 1;
  if (celspan_rostrum_create(context, &desc, &rostrum) != CELSPAN_OK)
    rostrum = NULL;
  celspan_cel_unref(cel);
  return rostrum;
}

static void draw(celspan_context *context, celspan_object *object, int how) {
  celspan_antialias_mode mode = (celspan_antialias_mode)(how % 3);
  celspan_exposure exposure = {make_rostrum(context, object), 1};
  float pixels[SIDE * SIDE][4];
  const celspan_coding coding = {.struct_size = sizeof coding, .depth = CELSPAN_DEPTH_FLOAT};
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  frame.exposures = &exposure;
  frame.exposure_count = 1;
  frame.width = frame.height = SIDE;
  frame.workers = 1;
  frame.has_antialias = true;
  frame.antialias = mode;
  if (!exposure.rostrum)
    return;
  celspan_status status =
      celspan_frame_pixels(context, &frame, &coding, pixels, sizeof *pixels * SIDE, NULL);
  demand(is_expected(status), "a drawing fails in another way");
  for (int i = 0; i < SIDE * SIDE && status == CELSPAN_OK; i++)
    demand(pixels[i][3] >= 0 && pixels[i][3] <= 1, "an alpha beyond 0 to 1");
  celspan_rostrum_unref(exposure.rostrum);
}

static void check_object(celspan_context *context, celspan_object *object, int how) {
  celspan_box box;
  if (celspan_object_bounds(object, &box))
    demand(isfinite(box.x + box.y + box.width + box.height) && box.width >= 0 && box.height >= 0,
           "bounds that are not a box");
  (void)celspan_object_contains(object, (celspan_point){1, 1});
  draw(context, object, how);
}

/* The context of the latest runs; every now and then it is destroyed, and no memory may be left. */
static celspan_context *shared_context(void) {
  static celspan_context *context;
  static int runs;
  if (runs++ % RUNS == 0) {
    celspan_context_destroy(context);
    meter_close(&memory);
    context = meter_context(&memory);
  }
  demand(context, "no context");
  return context;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  celspan_context *context = shared_context();
  char *text = calloc(1, size + 1);
  int how = size > 0 ? data[0] : 0;
  if (size > 1)
    memcpy(text, data + 1, size - 1);
  const celspan_path_desc desc = {
      .struct_size = sizeof desc, .data = text, .rule = (celspan_rule)(how & 1)};
  celspan_object *object = NULL;
  celspan_status status = celspan_object_create_path(context, &desc, &object);
  demand(is_expected(status), "a refusal of another kind");
  demand(status == CELSPAN_OK || celspan_context_error(context)[0], "a refusal without a sentence");
  if (status == CELSPAN_OK)
    check_object(context, object, how >> 1);
  celspan_object_unref(object);
  free(text);
  return 0;
}

#ifdef REPLAY_MAIN
#include "tests/fuzz/replay.h"
#endif
