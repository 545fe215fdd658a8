/* Any bytes as the file of a picture, whatever its format: no fault, no leak, every refusal with a
 * sentence that names the file; a picture with a valid header is shown in a frame of few pixels,
 * whose alphas are in 0..1.
 *
 * The libraries under the picture module are not built for the fuzzer: it does not see their
 * coverage, but a fault in them ends the run too.
 */
#include "tests/fuzz/target.h"

#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "tests/fuzz/meter.h"

#define MOST_BYTES ((size_t)256 << 20)
#define MOST_PIXELS ((int64_t)1 << 20) /* of pictures shown */
#define SIDE 4                         /* pixels of the frame */

static bool is_expected(celspan_status status) {
  return status == CELSPAN_OK || status == CELSPAN_INPUT || status == CELSPAN_LIMIT ||
         status == CELSPAN_NO_MEMORY;
}

/* A refusal names the file, unless the picture module is missing. */
static void check_outcome(const celspan_context *context, celspan_status status, const char *path) {
  demand(is_expected(status), "a failure of another kind");
  if (status == CELSPAN_INPUT || status == CELSPAN_LIMIT)
    demand(strstr(celspan_context_error(context), path) != NULL, celspan_context_error(context));
}

/* The picture over the whole frame; the rostrum keeps the values made on the way. */
static celspan_status stage(celspan_context *context, const celspan_picture_desc *picture,
                            celspan_rostrum **out) {
  const celspan_image_desc image = {
      .struct_size = sizeof image, .picture = picture, .width = SIDE, .height = SIDE};
  celspan_object *object = NULL;
  celspan_cel *cel = NULL;
  celspan_status status = celspan_object_create_image(context, &image, &object);
  celspan_cel_desc cel_desc = CELSPAN_CEL_DESC;
  cel_desc.objects = &object;
  cel_desc.object_count = 1;
  if (status == CELSPAN_OK)
    status = celspan_cel_create(context, &cel_desc, &cel);
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.cels = &cel;
  desc.cel_count = 1;
  if (status == CELSPAN_OK)
    status = celspan_rostrum_create(context, &desc, out);
  celspan_cel_unref(cel);
  celspan_object_unref(object);
  return status;
}

static void show(celspan_context *context, const celspan_picture_desc *picture) {
  celspan_exposure exposure = {NULL, 1};
  float pixels[SIDE * SIDE][4];
  const celspan_coding coding = {.struct_size = sizeof coding, .depth = CELSPAN_DEPTH_FLOAT};
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  frame.exposures = &exposure;
  frame.exposure_count = 1;
  frame.width = frame.height = SIDE;
  frame.workers = 1;
  celspan_status status = stage(context, picture, &exposure.rostrum);
  if (status == CELSPAN_OK)
    status = celspan_frame_pixels(context, &frame, &coding, pixels, sizeof *pixels * SIDE, NULL);
  check_outcome(context, status, picture->file);
  for (int i = 0; i < SIDE * SIDE && status == CELSPAN_OK; i++)
    demand(pixels[i][3] >= 0 && pixels[i][3] <= 1, "an alpha beyond 0 to 1");
  celspan_rostrum_unref(exposure.rostrum);
}

static void read_file(const char *path) {
  meter m = {.limit = MOST_BYTES};
  celspan_context *context = meter_context(&m);
  celspan_picture_desc picture = {.struct_size = sizeof picture};
  celspan_picture_info info = CELSPAN_PICTURE_INFO;
  demand(context, "no context");
  picture.file = path;
  celspan_status status = celspan_picture_inspect(context, &picture, &info);
  check_outcome(context, status, path);
  if (status == CELSPAN_OK) {
    demand(info.width > 0 && info.height > 0 && info.channels > 0, "a picture of no size");
    if ((int64_t)info.width * info.height <= MOST_PIXELS)
      show(context, &picture);
  }
  celspan_context_destroy(context);
  meter_close(&m);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  char path[64];
  int descriptor = memfd_create("picture", MFD_CLOEXEC);
  demand(descriptor >= 0 && write(descriptor, data, size) == (ssize_t)size,
         "the file cannot be made");
  snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
  read_file(path);
  close(descriptor);
  return 0;
}

#ifdef REPLAY_MAIN
#include "tests/fuzz/replay.h"
#endif
