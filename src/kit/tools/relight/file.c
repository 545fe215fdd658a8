/* Relit pictures in files: EXR of seven channels.
 *
 *   R  G  B  A                     S and beta: what other programs show, the picture in white light
 *   medium.R  medium.G  medium.B   T: a layer, in the words of OpenEXR
 */
#include <strings.h>

#include "celspan/relight.h"
#include "inside/scene.h"
#include "inside/sinks.h"
#include "tools/relight/original.h"

#define CHANNELS 7
#define MEDIUM "medium"

static const char *const names[CHANNELS] = {"R",         "G",         "B",        "A",
                                            MEDIUM ".R", MEDIUM ".G", MEDIUM ".B"};

/* ---------------------------------------------------------------- writing */

/* A file that is being written. */
typedef struct job {
  cs_original paint, medium; /* medium: only if the texture has one */
  bool has_medium;
  float *rows; /* CS_ORIGINAL_ROWS rows, of seven channels */
  cs_picture_file file;
} job;

static size_t row_bytes(const job *j) {
  return (size_t)j->paint.info.width * CHANNELS * sizeof(float);
}

static void pack_row(const job *j, int32_t y, float *out) {
  for (int32_t x = 0; x < j->paint.info.width; x++, out += CHANNELS) {
    const float *paint = cs_original_at(&j->paint, x, y);
    const float *medium = j->has_medium ? cs_original_at(&j->medium, x, y) : NULL;
    for (int c = 0; c < 4; c++)
      out[c] = paint[c];
    for (int c = 0; c < 3; c++)
      out[4 + c] = medium ? medium[c] : 1 - paint[3];
  }
}

static celspan_status write_rows(celspan_context *context, job *j) {
  int32_t height = j->paint.info.height;
  for (int32_t first = 0; first < height; first += CS_ORIGINAL_ROWS) {
    int32_t end = cs_original_end(&j->paint, first);
    CS_TRY(cs_original_read(context, &j->paint, first));
    if (j->has_medium)
      CS_TRY(cs_original_read(context, &j->medium, first));
    for (int32_t y = first; y < end; y++)
      pack_row(j, y, j->rows + (size_t)(y - first) * row_bytes(j) / sizeof *j->rows);
    CS_TRY(cs_picture_file_rows(&j->file, context, first, end - first, j->rows));
  }
  return CELSPAN_OK;
}

static celspan_status write_file(celspan_context *context, job *j, const char *path) {
  const cs_picture_output output = {.name = path,
                                    .format = "openexr",
                                    .width = j->paint.info.width,
                                    .height = j->paint.info.height,
                                    .channels = CHANNELS,
                                    .names = names,
                                    .depth = CELSPAN_DEPTH_FLOAT,
                                    .colour = "linear"};
  CS_TRY(cs_picture_file_open(context, &output, &j->file));
  celspan_status status = write_rows(context, j);
  if (status == CELSPAN_OK)
    return cs_picture_file_close(&j->file, context);
  cs_picture_file_discard(&j->file, context);
  return status;
}

static celspan_status open_medium(celspan_context *context, const celspan_texture *texture,
                                  job *j) {
  if (!texture->variation->medium)
    return CELSPAN_OK;
  CS_TRY(cs_original_open_picture(context, texture->variation->medium, &j->medium));
  j->has_medium = true;
  return cs_original_same_size(context, &j->paint, &j->medium);
}

celspan_status celspan_relight_write(celspan_context *context, const celspan_texture *texture,
                                     const char *path) {
  CS_TRY(cs_check_given(context, "relight", "the path", path));
  if (strcasecmp(cs_file_ending(path), "exr") != 0)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: a relit picture is kept in an EXR file, so its name must end in .exr",
                   path);
  job j = {0};
  CS_TRY(cs_original_open(context, "relight", texture, &j.paint));
  celspan_status status = open_medium(context, texture, &j);
  j.rows = cs_mem_array(context->memory, CS_ORIGINAL_ROWS, row_bytes(&j));
  if (status == CELSPAN_OK)
    status = j.rows ? write_file(context, &j, path) : cs_fail_memory(context);
  cs_mem_free(context->memory, j.rows, CS_ORIGINAL_ROWS * row_bytes(&j));
  cs_original_close(context, &j.paint);
  if (j.has_medium)
    cs_original_close(context, &j.medium);
  return status;
}

/* ---------------------------------------------------------------- reading */

static celspan_status check_file(celspan_context *context, const celspan_texture *texture) {
  celspan_picture_info paint, medium;
  const char *name = cs_picture_name(texture->variation->picture);
  CS_TRY(cs_store_info(context, texture->variation->picture, &paint));
  celspan_status status = cs_store_info(context, texture->variation->medium, &medium);
  if (status != CELSPAN_OK && status != CELSPAN_NO_MEMORY)
    return cs_fail(context, CELSPAN_INPUT,
                   "%s: is not a relit picture: its light has not been taken off, so it has no "
                   "channels medium.R, medium.G and medium.B",
                   name);
  CS_TRY(status);
  if (!paint.has_alpha)
    return cs_fail(context, CELSPAN_INPUT, "%s: is not a relit picture: it has no channel A", name);
  return CELSPAN_OK;
}

celspan_status celspan_relight_read(celspan_context *context, const char *path,
                                    celspan_texture **out) {
  CS_TRY(cs_check_given(context, "relight", "the path", path));
  celspan_picture_desc desc = {.struct_size = sizeof desc, .file = path, .colour = "linear"};
  celspan_texture *paint, *texture;
  CS_TRY(celspan_texture_create_picture(context, &desc, &paint));
  desc.layer = MEDIUM;
  celspan_status status = celspan_texture_with_medium(context, paint, &desc, &texture);
  celspan_texture_unref(paint);
  CS_TRY(status);
  status = check_file(context, texture);
  return CS_GIVE(status, texture, celspan_texture_unref, out);
}
