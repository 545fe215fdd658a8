/* Pictures for tests: files made from a function of the pixel, and texels read back. */
#pragma once

#include <stdlib.h>
#include <unistd.h>

#include "model/pictures/load.h"
#include "output/sinks/sink.h"
#include "tests/support/check.h"

/* Linear premultiplied RGBA of pixel (x, y). */
typedef void (*picture_paint)(int x, int y, float rgba[4]);

/* A path in a folder of this process, below the system's temporary one. Five paths may be in
 * use. */
static inline const char *picture_path(const char *name) {
  static char paths[5][512];
  static int next;
  char *path = paths[next++ % 5];
  const char *folder = getenv("TMPDIR");
  snprintf(path, sizeof paths[0], "%s/celspan-test-%d-%s", folder ? folder : "/tmp", (int)getpid(),
           name);
  return path;
}

static inline celspan_status picture_write(celspan_context *context, const char *path,
                                           const celspan_coding *coding, int width, int height,
                                           picture_paint paint) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coded = CELSPAN_CODING;
  file.coding = &coded;
  celspan_sink sink;
  if (coding)
    coded = *coding;
  CS_TRY(cs_sink_file(context, path, &file, &sink));
  celspan_status status = sink.begin(sink.user, context, width, height);
  if (status != CELSPAN_OK) {
    cs_sink_discard(context, &sink);
    return status;
  }
  float *row = malloc((size_t)width * 4 * sizeof(float));
  for (int y = 0; y < height && status == CELSPAN_OK; y++) {
    for (int x = 0; x < width; x++)
      paint(x, y, row + 4 * x);
    celspan_span span = {.x1 = width, .kind = CELSPAN_SPAN_ARRAY, .array = row};
    status = sink.row(sink.user, context, y, &span, 1);
  }
  free(row);
  return sink.end(sink.user, context, status);
}

static inline celspan_status picture_open(celspan_context *context, const char *path,
                                          cs_picture **out, celspan_picture_info *info) {
  celspan_picture_desc desc = {.struct_size = sizeof desc, .file = path};
  cs_picture *picture;
  CS_TRY(cs_picture_create(context, &desc, &picture));
  celspan_status status = cs_store_info(context, picture, info);
  if (status == CELSPAN_OK)
    *out = picture;
  else
    cs_picture_unref(picture);
  return status;
}

static inline celspan_status picture_texel(celspan_context *context, const cs_picture *picture,
                                           int level, int x, int y, float rgba[4]) {
  cs_picture_block *block;
  CS_TRY(
      cs_load_block(context, picture, level, x / CS_PICTURE_BLOCK, y / CS_PICTURE_BLOCK, &block));
  memcpy(rgba, block->texels + 4 * (y % CS_PICTURE_BLOCK * CS_PICTURE_BLOCK + x % CS_PICTURE_BLOCK),
         4 * sizeof(float));
  cs_store_release(block);
  return CELSPAN_OK;
}

/* Whether pictures can be read and written; if not, the context's error says why. */
static inline bool picture_module_is_there(celspan_context *context) {
  celspan_picture_info info;
  celspan_picture_desc desc = {.struct_size = sizeof desc, .file = "/nonexistent"};
  return celspan_picture_inspect(context, &desc, &info) == CELSPAN_INPUT &&
         !strstr(celspan_context_error(context), "module");
}

/* The same; if they cannot, checks are skipped. */
static inline bool picture_module_or_skip(celspan_context *context) {
  bool is_there = picture_module_is_there(context);
  if (!is_there)
    check_skip(celspan_context_error(context));
  return is_there;
}
