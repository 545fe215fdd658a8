/* OpenEXR: half or float, 16 rows at a time compressed by zlib. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zlib.h>

#include "plugins/raster/exr.h"
#include "plugins/raster/write.h"

enum { VERSION = 2 };

typedef struct writing {
  const cs_picture_output *output;
  cs_write_target *target;
  int order[CS_PICTURE_CHANNELS]; /* of the channels, by their names */
  size_t value, row;              /* bytes */
  uint64_t list;                  /* the offset of the list of chunks */
  unsigned char *places;
  int32_t done; /* rows */
  int kept;     /* rows in the chunk that is not full */
  unsigned char *rows, *scratch, *packed;
} writing;

/* ---------------------------------------------------------------- the header */

static void put_number(writing *w, uint32_t number) {
  const unsigned char bytes[4] = {(unsigned char)number, (unsigned char)(number >> 8),
                                  (unsigned char)(number >> 16), (unsigned char)(number >> 24)};
  cs_write_put(w->target, bytes, sizeof bytes);
}

static void put_text(writing *w, const char *text) {
  cs_write_put(w->target, text, strlen(text) + 1);
}

static void put_attribute(writing *w, const char *name, const char *type, size_t size) {
  put_text(w, name);
  put_text(w, type);
  put_number(w, (uint32_t)size);
}

static void put_string(writing *w, const char *name, const char *text) {
  put_attribute(w, name, "string", strlen(text));
  cs_write_put(w->target, text, strlen(text));
}

static void put_float(writing *w, float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  put_number(w, bits);
}

static void put_window(writing *w, const char *name) {
  put_attribute(w, name, "box2i", 16);
  put_number(w, 0);
  put_number(w, 0);
  put_number(w, (uint32_t)w->output->width - 1);
  put_number(w, (uint32_t)w->output->height - 1);
}

static const char *name_of(const cs_picture_output *output, int channel) {
  static const char *const usual[] = {"R", "G", "B", "A"};
  return output->names ? output->names[channel] : output->channels == 1 ? "Y" : usual[channel];
}

static void put_channels(writing *w) {
  size_t size = 1;
  for (int i = 0; i < w->output->channels; i++)
    size += strlen(name_of(w->output, i)) + 1 + 16;
  put_attribute(w, "channels", "chlist", size);
  for (int i = 0; i < w->output->channels; i++) {
    put_text(w, name_of(w->output, w->order[i]));
    put_number(w, w->value == 2 ? CS_EXR_HALF : CS_EXR_FLOAT);
    put_number(w, 0);
    put_number(w, 1);
    put_number(w, 1);
  }
  cs_write_put(w->target, "", 1);
}

static void put_header(writing *w) {
  put_number(w, CS_EXR_MAGIC);
  put_number(w, VERSION);
  put_string(w, "celspan:colour", w->output->colour);
  put_channels(w);
  if (w->output->title)
    put_string(w, "comments", w->output->title);
  put_attribute(w, "compression", "compression", 1);
  cs_write_put(w->target, &(unsigned char){CS_EXR_ROWS}, 1);
  put_window(w, "dataWindow");
  put_window(w, "displayWindow");
  put_attribute(w, "lineOrder", "lineOrder", 1);
  cs_write_put(w->target, "", 1);
  put_attribute(w, "pixelAspectRatio", "float", 4);
  put_float(w, 1);
  put_attribute(w, "screenWindowCenter", "v2f", 8);
  put_float(w, 0);
  put_float(w, 0);
  put_attribute(w, "screenWindowWidth", "float", 4);
  put_float(w, 1);
  cs_write_put(w->target, "", 1);
}

/* ---------------------------------------------------------------- chunks */

void cs_exr_spread(const unsigned char *bytes, size_t size, unsigned char *out) {
  for (size_t i = 0; i < size; i++)
    out[i / 2 + (i % 2 ? (size + 1) / 2 : 0)] = bytes[i];
  for (size_t i = size; i-- > 1;)
    out[i] = (unsigned char)(out[i] - out[i - 1] + 128);
}

/* One row: all values of a channel together, with the channels in the order of their names. */
static void split_row(const writing *w, const unsigned char *row, unsigned char *out) {
  size_t channels = (size_t)w->output->channels;
  for (size_t i = 0; i < channels; i++)
    for (size_t x = 0; x < (size_t)w->output->width; x++, out += w->value)
      memcpy(out, row + (x * channels + (size_t)w->order[i]) * w->value, w->value);
}

static bool put_chunk(writing *w) {
  size_t size = (size_t)w->kept * w->row;
  uLongf packed = compressBound((uLong)size);
  uint64_t place = w->target->at;
  int32_t first = w->done - w->kept;
  cs_exr_spread(w->rows, size, w->scratch);
  if (compress(w->packed, &packed, w->scratch, (uLong)size) != Z_OK)
    return false;
  for (int i = 0; i < 8; i++)
    w->places[8 * (first / CS_EXR_LINES) + i] = (unsigned char)(place >> 8 * i);
  bool is_smaller = packed < size;
  put_number(w, (uint32_t)first);
  put_number(w, (uint32_t)(is_smaller ? packed : size));
  w->kept = 0;
  return cs_write_put(w->target, is_smaller ? w->packed : w->rows, is_smaller ? packed : size);
}

static size_t places_size(const writing *w) {
  return 8 * (((size_t)w->output->height + CS_EXR_LINES - 1) / CS_EXR_LINES);
}

/* ---------------------------------------------------------------- the file */

static void destroy(void *self) {
  writing *w = self;
  free(w->places);
  free(w->rows);
  free(w->scratch);
  free(w->packed);
  free(w);
}

static void sort_channels(writing *w) {
  for (int i = 0; i < w->output->channels; i++) {
    int at = i;
    for (; at > 0 && strcmp(name_of(w->output, w->order[at - 1]), name_of(w->output, i)) > 0; at--)
      w->order[at] = w->order[at - 1];
    w->order[at] = i;
  }
}

static void *begin(const cs_picture_output *output, cs_write_target *target) {
  writing *w = calloc(1, sizeof *w);
  if (!w)
    return NULL;
  w->output = output;
  w->target = target;
  w->value = output->depth == CELSPAN_DEPTH_FLOAT ? 4 : 2;
  w->row = cs_write_row(output);
  sort_channels(w);
  w->places = calloc(1, places_size(w));
  w->rows = malloc(CS_EXR_LINES * w->row);
  w->scratch = malloc(CS_EXR_LINES * w->row);
  w->packed = malloc(compressBound((uLong)(CS_EXR_LINES * w->row)));
  if (!w->places || !w->rows || !w->scratch || !w->packed) {
    destroy(w);
    return NULL;
  }
  put_header(w);
  w->list = target->at;
  cs_write_put(target, w->places, places_size(w));
  return w;
}

static bool put_rows(void *self, int32_t count, const unsigned char *rows) {
  writing *w = self;
  for (int32_t i = 0; i < count; i++) {
    split_row(w, rows + (size_t)i * w->row, w->rows + (size_t)w->kept * w->row);
    w->kept++;
    w->done++;
    if ((w->kept == CS_EXR_LINES || w->done == w->output->height) && !put_chunk(w))
      return false;
  }
  return true;
}

static bool end(void *self) {
  writing *w = self;
  w->target->at = w->list;
  return cs_write_put(w->target, w->places, places_size(w));
}

const cs_write_format cs_write_exr = {"openexr", begin, put_rows, end, destroy};
