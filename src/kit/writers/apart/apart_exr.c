/* Each layer is a frame of its own, whose rows are made on demand; and so is each step of the
 * mattes:
 *
 *   frame      --rows--> R G B A  R G B A ... \
 *   layer 1    --rows--> R G B A  R G B A ...  +-- a row of all channels --> exr.h --> file
 *   layer 2    --rows--> R G B A  R G B A ... /
 *   mattes     --rows--> id w id w id w   ... /
 */
#include <stdio.h>
#include <string.h>

#include "inside/colour.h"
#include "inside/scene.h"
#include "inside/sinks.h"
#include "writers/apart/apart.h"
#include "writers/apart/cryptomatte.h"
#include "writers/apart/sources.h"
#include "writers/exr/exr.h"

enum { CHANNELS = 4, SUFFIX = 2 }; /* ".R" */

#define LIST "celspan:layers"

typedef struct exr_writing {
  cs_apart_writing base;
  cs_account_kind account; /* the account before */
  cs_cryptomatte crypto;   /* used if there are mattes */
  cs_sources sources;      /* the sources of the frame, then of each layer */
  int32_t lines;           /* rows that are made together */
  size_t count;            /* layers, with the frame */
  size_t channel_count;
  cs_exr_channel *channels;
  char (*names)[CS_EXR_NAME + 1]; /* names of the channels of layers */
  char *list;                     /* the names of the layers */
  size_t list_size;
  unsigned char *rows; /* all layers, one after the other, and the mattes */
  void *memory;        /* what the file is made in */
  size_t memory_size;
  cs_exr exr;
  cs_file *file;
  celspan_status status; /* the status of the file */
} exr_writing;

static bool has_mattes(const exr_writing *w) {
  return w->base.contents.mattes != CS_APART_MATTES_NONE;
}

static size_t layers_size(const exr_writing *w) {
  return w->count * (size_t)w->base.width * cs_pixels_size(&w->base.coding);
}

static size_t row_size(const exr_writing *w) {
  size_t mattes = (size_t)w->base.width * CS_CRYPTOMATTE_VALUES * sizeof(float);
  return layers_size(w) + (has_mattes(w) ? mattes : 0);
}

/* ---------------------------------------------------------------- what is written */

static void name_channels(exr_writing *w) {
  static const char letters[] = "RGBA";
  size_t pixel = cs_pixels_size(&w->base.coding);
  for (size_t i = 0; i < w->count * CHANNELS; i++) {
    size_t layer = i / CHANNELS, c = i % CHANNELS;
    snprintf(w->names[i], sizeof w->names[i], "%.*s%s%c", CS_APART_NAME - 1 - SUFFIX,
             layer ? w->base.apart.layers[layer - 1].name : "", layer ? "." : "", letters[c]);
    w->channels[i] = (cs_exr_channel){
        .name = w->names[i],
        .type = w->base.coding.depth == CELSPAN_DEPTH_FLOAT ? CS_EXR_FLOAT : CS_EXR_HALF,
        .offset = layer * (size_t)w->base.width * pixel + c * (pixel / CHANNELS),
        .stride = pixel};
  }
}

static void list_layers(exr_writing *w) {
  char *end = w->list;
  for (size_t i = 0; i < w->base.apart.count; i++)
    end += snprintf(end, w->list_size - (size_t)(end - w->list), "%s%s", i ? "," : "",
                    w->base.apart.layers[i].name);
  *end = '\0';
}

static celspan_status take_memory(exr_writing *w) {
  celspan_context *context = w->base.context;
  size_t fitting = CS_SOURCES_PORTION / row_size(w);
  w->lines = fitting < 1 ? 1 : fitting < CS_EXR_LINES ? (int32_t)fitting : CS_EXR_LINES;
  w->list_size = w->count * CS_APART_NAME;
  w->channel_count = w->count * CHANNELS + (has_mattes(w) ? CS_CRYPTOMATTE_VALUES : 0);
  CS_TRY(CS_MAKE(context, w->channels, w->channel_count));
  CS_TRY(CS_MAKE(context, w->names, w->count * CHANNELS));
  CS_TRY(CS_MAKE(context, w->list, w->list_size));
  return CS_MAKE(context, w->rows, (size_t)w->lines * row_size(w));
}

static void finish(exr_writing *w) {
  cs_memory *memory = w->base.context->memory;
  cs_sources_finish(&w->sources);
  cs_cryptomatte_finish(&w->crypto);
  cs_mem_free(memory, w->memory, w->memory_size);
  cs_mem_free(memory, w->rows, (size_t)w->lines * row_size(w));
  cs_mem_free(memory, w->list, w->list_size);
  cs_mem_free(memory, w->names, w->count * CHANNELS * sizeof *w->names);
  cs_mem_free(memory, w->channels, w->channel_count * sizeof *w->channels);
}

/* ---------------------------------------------------------------- rows */

static celspan_status make_rows(exr_writing *w, int32_t y, int32_t lines) {
  CS_TRY(cs_sources_make(&w->sources, y, lines, w->rows, row_size(w)));
  return has_mattes(w)
             ? cs_cryptomatte_make(&w->crypto, y, lines, w->rows + layers_size(w), row_size(w))
             : CELSPAN_OK;
}

static celspan_status report_progress(const exr_writing *w, int32_t y) {
  const celspan_frame_desc *frame = &w->base.frame;
  return !frame->progress || frame->progress(frame->progress_user, y, w->base.height)
             ? CELSPAN_OK
             : cs_fail(w->base.context, CELSPAN_CANCELLED, "stopped");
}

/* ---------------------------------------------------------------- the file */

static bool put_bytes(void *user, uint64_t offset, const void *bytes, size_t size) {
  exr_writing *w = user;
  w->status = offset == cs_file_size(w->file)
                  ? cs_file_write(w->file, w->base.context, bytes, size)
                  : cs_file_write_at(w->file, w->base.context, offset, bytes, size);
  return w->status == CELSPAN_OK;
}

/* The file's own error, or an error of packing, which fails only without memory. */
static celspan_status conclude(const exr_writing *w, bool is_good) {
  return w->status != CELSPAN_OK ? w->status
         : is_good               ? CELSPAN_OK
                                 : cs_fail_memory(w->base.context);
}

static celspan_status write_rows(exr_writing *w) {
  for (int32_t y = 0; y < w->base.height; y += w->lines) {
    int32_t lines = w->base.height - y < w->lines ? w->base.height - y : w->lines;
    CS_TRY(report_progress(w, y));
    CS_TRY(make_rows(w, y, lines));
    for (int32_t i = 0; i < lines; i++)
      CS_TRY(conclude(w, cs_exr_row(&w->exr, w->rows + (size_t)i * row_size(w))));
  }
  return conclude(w, cs_exr_end(&w->exr));
}

static celspan_status write_picture(exr_writing *w, const cs_exr_picture *picture) {
  w->memory_size = cs_exr_memory(picture);
  CS_TRY(cs_mem_make(w->base.context, (void **)&w->memory, w->memory_size, 1));
  CS_TRY(conclude(w, cs_exr_begin(&w->exr, picture, (cs_exr_target){put_bytes, w}, w->memory)));
  return write_rows(w);
}

/* Room for all attributes: four texts, timing, and the mattes'. */
enum { ATTRIBUTES = 6 + CS_CRYPTOMATTE_ATTRIBUTES };

static size_t list_attributes(const exr_writing *w, const cs_exr_timing *timing,
                              cs_exr_attribute out[ATTRIBUTES]) {
  const char *title = w->base.file.title;
  cs_exr_attribute *end = out;
  *end++ = cs_exr_text("celspan:colour", "linear");
  *end++ = cs_exr_text("Software", cs_context_maker(w->base.context));
  if (w->base.contents.has_layers)
    *end++ = cs_exr_text(LIST, w->list);
  for (size_t i = 0; i < timing->count; i++)
    *end++ = timing->attributes[i];
  if (title)
    *end++ = cs_exr_text("comments", title);
  if (has_mattes(w)) {
    cs_cryptomatte_describe(&w->crypto, layers_size(w), w->channels + w->count * CHANNELS, end);
    end += CS_CRYPTOMATTE_ATTRIBUTES;
  }
  return (size_t)(end - out);
}

static celspan_status write_file(exr_writing *w) {
  const cs_apart_writing *base = &w->base;
  cs_exr_attribute attributes[ATTRIBUTES];
  cs_exr_timing timing;
  cs_exr_time(&timing, base->file.frames_second, base->file.frame);
  const cs_exr_picture picture = {.width = base->width,
                                  .height = base->height,
                                  .channels = w->channels,
                                  .channel_count = w->channel_count,
                                  .attributes = attributes,
                                  .primaries = cs_primaries_known[0].xy,
                                  .attribute_count = list_attributes(w, &timing, attributes)};
  cs_exr_sort(w->channels, w->channel_count);
  CS_TRY(cs_file_create(base->context, NULL, base->path, &w->file));
  return cs_file_end(w->file, base->context, write_picture(w, &picture));
}

/* ---------------------------------------------------------------- all */

static celspan_status check(cs_apart_writing *base) {
  base->suffix = SUFFIX;
  base->coding.transfer = CELSPAN_TRANSFER_LINEAR;
  base->frame.has_tolerance = true;
  base->frame.tolerance = CS_SOURCES_TOLERANCE;
  return CELSPAN_OK;
}

/* Sizes in the file are signed and have 32 bits. */
static celspan_status check_row(const exr_writing *w) {
  return row_size(w) <= INT32_MAX
             ? CELSPAN_OK
             : cs_fail(w->base.context, CELSPAN_LIMIT,
                       "%s: %zu layers of %d pixels are more than a row of OpenEXR can have",
                       w->base.path, w->count, (int)w->base.width);
}

static celspan_status begin(cs_apart_writing *base) {
  exr_writing *w = (exr_writing *)base;
  w->account = cs_account_begin_rendering(base->context->memory);
  w->count = base->apart.count + 1;
  CS_TRY(check_row(w));
  CS_TRY(take_memory(w));
  name_channels(w);
  list_layers(w);
  return cs_sources_begin(base->context, &base->coding, base->width, w->count, &w->sources);
}

static celspan_status put(cs_apart_writing *base, const celspan_frame_desc *picture, size_t index) {
  return cs_sources_open(&((exr_writing *)base)->sources, index, picture);
}

static celspan_status write_pictures(exr_writing *w) {
  if (has_mattes(w))
    CS_TRY(cs_cryptomatte_begin(w->base.context, &w->base.frame, w->base.contents.mattes, w->lines,
                                &w->crypto));
  return write_file(w);
}

static celspan_status end(cs_apart_writing *base, celspan_status outcome) {
  exr_writing *w = (exr_writing *)base;
  const celspan_frame_desc *frame = &base->frame;
  if (outcome == CELSPAN_OK)
    outcome = write_pictures(w);
  finish(w);
  cs_account_end_rendering(base->context->memory, w->account);
  return outcome == CELSPAN_INPUT
             ? cs_blame_picture(base->context, frame->exposures, frame->exposure_count, outcome)
             : outcome;
}

const cs_apart_format cs_apart_exr = {.size = sizeof(exr_writing),
                                      .depth = CELSPAN_DEPTH_HALF,
                                      .is_light = true,
                                      .check = check,
                                      .begin = begin,
                                      .put = put,
                                      .end = end};
