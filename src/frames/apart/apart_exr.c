/* Each layer is a frame of its own, whose rows are made on demand:
 *
 *   frame      --rows--> R G B A  R G B A ... \
 *   layer 1    --rows--> R G B A  R G B A ...  +-- a row of all channels --> exr.h --> file
 *   layer 2    --rows--> R G B A  R G B A ... /
 */
#include <stdio.h>
#include <string.h>

#include "base/description.h"
#include "frames/apart/apart.h"
#include "frames/render/frame.h"
#include "output/exr/exr.h"
#include "output/sinks/file.h"
#include "output/sinks/pixels.h"

enum { CHANNELS = 4, SUFFIX = 2 }; /* ".R" */

#define ROW_MOST ((uint64_t)1 << 31) /* bytes: sizes in the file are 32 bits */
#define LIST "celspan:layers"

/* Gradient spans are this close to their colours. So the frame and its layers, where gradients
 * begin at different columns, agree. */
#define TOLERANCE 0x1p-20

typedef struct writing {
  celspan_context *context;
  cs_apart apart;
  celspan_frame_desc frame;
  celspan_coding coding;
  int32_t width, height;
  size_t pixel, count; /* bytes of a pixel of a layer; layers, with the frame */
  celspan_rows **rows; /* of the frame, then of each layer */
  cs_exr_channel *channels;
  char (*names)[CS_EXR_NAME + 1]; /* of the channels */
  char *list;                     /* the names of the layers */
  size_t list_size;
  unsigned char *row; /* of all layers, one after the other */
  void *memory;       /* of the file */
  size_t memory_size;
  cs_exr exr;
  cs_file *file;
  celspan_status status; /* of the file */
} writing;

static size_t row_size(const writing *w) { return w->count * (size_t)w->width * w->pixel; }

/* ---------------------------------------------------------------- what is written */

static void name_channels(writing *w) {
  static const char letters[] = "RGBA";
  for (size_t i = 0; i < w->count * CHANNELS; i++) {
    size_t layer = i / CHANNELS, c = i % CHANNELS;
    snprintf(w->names[i], sizeof w->names[i], "%.*s%s%c", CS_APART_NAME - 1 - SUFFIX,
             layer ? w->apart.layers[layer - 1].name : "", layer ? "." : "", letters[c]);
    w->channels[i] = (cs_exr_channel){
        .name = w->names[i],
        .type = w->coding.depth == CELSPAN_DEPTH_FLOAT ? CS_EXR_FLOAT : CS_EXR_HALF,
        .offset = layer * (size_t)w->width * w->pixel + c * (w->pixel / CHANNELS),
        .stride = w->pixel};
  }
  cs_exr_sort(w->channels, w->count * CHANNELS);
}

static void list_layers(writing *w) {
  char *end = w->list;
  for (size_t i = 0; i < w->apart.count; i++)
    end += snprintf(end, w->list_size - (size_t)(end - w->list), "%s%s", i ? "," : "",
                    w->apart.layers[i].name);
  *end = '\0';
}

static celspan_status take_memory(writing *w) {
  cs_memory *memory = w->context->memory;
  size_t channels = w->count * CHANNELS;
  w->list_size = w->count * CS_APART_NAME;
  w->channels = cs_mem_array(memory, channels, sizeof *w->channels);
  w->names = cs_mem_array(memory, channels, sizeof *w->names);
  w->list = cs_mem_array(memory, w->list_size, 1);
  w->rows = cs_mem_array(memory, w->count, sizeof *w->rows);
  w->row = cs_mem_array(memory, row_size(w), 1);
  return w->channels && w->names && w->list && w->rows && w->row ? CELSPAN_OK
                                                                 : cs_fail_memory(w->context);
}

static void finish(writing *w) {
  cs_memory *memory = w->context->memory;
  for (size_t i = 0; w->rows && i < w->count; i++)
    celspan_rows_destroy(w->rows[i]);
  cs_mem_free(memory, w->memory, w->memory_size);
  cs_mem_free(memory, w->row, row_size(w));
  cs_mem_free(memory, w->rows, w->count * sizeof *w->rows);
  cs_mem_free(memory, w->list, w->list_size);
  cs_mem_free(memory, w->names, w->count * CHANNELS * sizeof *w->names);
  cs_mem_free(memory, w->channels, w->count * CHANNELS * sizeof *w->channels);
  cs_apart_finish(&w->apart);
}

/* ---------------------------------------------------------------- rows */

static celspan_status open_rows(writing *w) {
  for (size_t i = 0; i < w->count; i++) {
    celspan_frame_desc frame = w->frame;
    if (i > 0) {
      frame.exposures = w->apart.layers[i - 1].exposures;
      frame.exposure_count = w->apart.layers[i - 1].count;
    }
    CS_TRY(celspan_rows_create(w->context, &frame, &w->rows[i]));
  }
  return CELSPAN_OK;
}

static celspan_status make_row(writing *w, int32_t y) {
  for (size_t i = 0; i < w->count; i++) {
    const celspan_span *spans;
    size_t span_count;
    CS_TRY(celspan_rows_get(w->rows[i], y, &spans, &span_count));
    cs_pixels_row(&w->coding, spans, span_count, w->row + i * (size_t)w->width * w->pixel);
  }
  return CELSPAN_OK;
}

static celspan_status report_progress(const writing *w, int32_t y) {
  const celspan_frame_desc *frame = &w->frame;
  return !frame->progress || frame->progress(frame->progress_user, y, w->height)
             ? CELSPAN_OK
             : cs_fail(w->context, CELSPAN_CANCELLED, "stopped");
}

/* ---------------------------------------------------------------- the file */

static bool put(void *user, uint64_t offset, const void *bytes, size_t size) {
  writing *w = user;
  w->status = offset == cs_file_size(w->file)
                  ? cs_file_write(w->file, w->context, bytes, size)
                  : cs_file_write_at(w->file, w->context, offset, bytes, size);
  return w->status == CELSPAN_OK;
}

/* The file's own error, or that of packing, which fails only without memory. */
static celspan_status conclude(const writing *w, bool is_good) {
  return w->status != CELSPAN_OK ? w->status : is_good ? CELSPAN_OK : cs_fail_memory(w->context);
}

static celspan_status write_rows(writing *w) {
  for (int32_t y = 0; y < w->height; y++) {
    CS_TRY(report_progress(w, y));
    CS_TRY(make_row(w, y));
    CS_TRY(conclude(w, cs_exr_row(&w->exr, w->row)));
  }
  return conclude(w, cs_exr_end(&w->exr));
}

static celspan_status write_picture(writing *w, const cs_exr_picture *picture) {
  w->memory_size = cs_exr_memory(picture);
  w->memory = cs_mem_array(w->context->memory, w->memory_size, 1);
  if (!w->memory)
    return cs_fail_memory(w->context);
  CS_TRY(conclude(w, cs_exr_begin(&w->exr, picture, (cs_exr_target){put, w}, w->memory)));
  return write_rows(w);
}

static celspan_status write_file(writing *w, const char *path, const char *title) {
  const cs_exr_text texts[] = {{"celspan:colour", "linear"}, {LIST, w->list}, {"comments", title}};
  const cs_exr_picture picture = {.width = w->width,
                                  .height = w->height,
                                  .channels = w->channels,
                                  .channel_count = w->count * CHANNELS,
                                  .texts = texts,
                                  .text_count = title ? 3 : 2};
  CS_TRY(cs_file_create(w->context, NULL, path, &w->file));
  return cs_file_end(w->file, w->context, write_picture(w, &picture));
}

static celspan_status write_layers(writing *w, const char *path, const char *title) {
  w->count = w->apart.count + 1;
  if ((uint64_t)w->count * (uint64_t)w->width * w->pixel > ROW_MOST)
    return cs_fail(w->context, CELSPAN_LIMIT,
                   "%s: %zu layers of %d pixels are more than a row of OpenEXR can have", path,
                   w->count, (int)w->width);
  CS_TRY(take_memory(w));
  name_channels(w);
  list_layers(w);
  CS_TRY(open_rows(w));
  return write_file(w, path, title);
}

celspan_status cs_apart_write_exr(celspan_context *context, const celspan_frame_desc *desc,
                                  const char *path, const celspan_file_desc *file) {
  CS_TRY(cs_frame_check(context, desc));
  writing w = {.context = context, .frame = *desc};
  w.coding = cs_pixels_resolve(file->coding, CELSPAN_DEPTH_HALF);
  w.coding.transfer = CELSPAN_TRANSFER_LINEAR;
  w.coding.space = desc->space;
  w.pixel = cs_pixels_size(&w.coding);
  w.width = desc->crop_width > 0 ? desc->crop_width : desc->width;
  w.height = desc->crop_height > 0 ? desc->crop_height : desc->height;
  w.frame.has_tolerance = true;
  w.frame.tolerance = TOLERANCE;
  CS_TRY(cs_apart_make(context, desc->exposures, desc->exposure_count, SUFFIX, &w.apart));
  celspan_status status = write_layers(&w, path, file->title);
  finish(&w);
  return status;
}
