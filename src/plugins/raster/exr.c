#include "plugins/raster/exr.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zlib.h>

#include "model/colour/transfer_names.h"

enum {
  NAME = 256,    /* bytes of a name, with its end */
  TILED = 0x200, /* flags behind the version */
  DEEP = 0x800,
  PARTS = 0x1000,
  PACKED_NONE = 0,
  PACKED_RUNS = 1
};

typedef struct channel {
  char name[NAME];
  cs_exr_type type;
  int output; /* the channel of the raster; -1: it is not read */
} channel;

typedef struct window {
  int32_t x0, y0, x1, y1; /* the last column and row are included */
} window;

typedef struct reading {
  const cs_raster_file *file;
  size_t at;
  bool is_over;      /* a read went beyond the end */
  channel *channels; /* CS_PICTURE_CHANNELS; owned */
  int count;
  int packing;
  window data, shown;
  char colour[CS_PICTURE_SPACE];
  cs_raster *out;
  cs_picture_failure *failure;
  unsigned char *rows, *scratch; /* of a chunk */
  size_t row;                    /* bytes of one row */
} reading;

static celspan_status fail(const reading *r, const char *text) {
  return cs_raster_fail(r->failure, CELSPAN_INPUT, "%s", text);
}

/* ---------------------------------------------------------------- bytes */

static const unsigned char *take(reading *r, size_t size) {
  r->is_over = r->is_over || size > r->file->size - r->at;
  const unsigned char *bytes = r->file->bytes + r->at;
  r->at += r->is_over ? 0 : size;
  return r->is_over ? NULL : bytes;
}

static uint32_t number_of(const unsigned char *bytes) {
  return bytes ? (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
                     (uint32_t)bytes[3] << 24
               : 0;
}

static int32_t number(reading *r) { return (int32_t)number_of(take(r, 4)); }

/* Reads a text up to its 0; an empty text ends a list. */
static bool take_name(reading *r, char out[NAME]) {
  const unsigned char *from = r->file->bytes + r->at;
  size_t left = r->file->size - r->at;
  const unsigned char *end = memchr(from, 0, left < NAME ? left : NAME);
  out[0] = '\0';
  r->is_over = r->is_over || !end;
  if (r->is_over)
    return false;
  memcpy(out, from, (size_t)(end - from) + 1);
  r->at += (size_t)(end - from) + 1;
  return out[0] != '\0';
}

/* ---------------------------------------------------------------- the header */

static celspan_status read_channels(reading *r) {
  char name[NAME];
  while (take_name(r, name)) {
    if (r->count == CS_PICTURE_CHANNELS)
      return cs_raster_fail(r->failure, CELSPAN_LIMIT, "has more than %d channels",
                            CS_PICTURE_CHANNELS);
    channel *c = &r->channels[r->count++];
    memcpy(c->name, name, NAME);
    c->type = (cs_exr_type)number(r);
    c->output = -1;
    take(r, 4);
    bool is_full = number(r) == 1;
    is_full = number(r) == 1 && is_full;
    if (!r->is_over && (c->type > CS_EXR_FLOAT || !is_full))
      return fail(r, "has channels of another size than the picture, which are not read");
  }
  return CELSPAN_OK;
}

static window take_window(reading *r) {
  window w;
  w.x0 = number(r), w.y0 = number(r), w.x1 = number(r), w.y1 = number(r);
  return w;
}

static void take_colour(reading *r, size_t size) {
  const unsigned char *text = take(r, size);
  if (text && size < sizeof r->colour)
    memcpy(r->colour, text, size);
}

static void take_primaries(reading *r, cs_raster *out) {
  for (int i = 0; i < 8; i++) {
    uint32_t bits = (uint32_t)number(r);
    memcpy(&out->primaries[i], &bits, sizeof bits);
  }
  out->has_primaries = true;
}

static celspan_status read_attribute(reading *r, const char *name) {
  char type[NAME];
  take_name(r, type);
  size_t size = (uint32_t)number(r), from = r->at;
  celspan_status status = CELSPAN_OK;
  if (strcmp(name, "channels") == 0)
    status = read_channels(r);
  else if (strcmp(name, "compression") == 0) {
    const unsigned char *packing = take(r, 1);
    r->packing = packing ? *packing : -1;
  } else if (strcmp(name, "dataWindow") == 0)
    r->data = take_window(r);
  else if (strcmp(name, "displayWindow") == 0)
    r->shown = take_window(r);
  else if (strcmp(name, "celspan:colour") == 0)
    take_colour(r, size);
  else if (strcmp(name, "chromaticities") == 0 && size == sizeof r->out->primaries)
    take_primaries(r, r->out);
  r->at = from;
  take(r, size);
  return status;
}

static celspan_status read_header(reading *r) {
  char name[NAME];
  take(r, 4);
  uint32_t version = (uint32_t)number(r);
  if (version & (TILED | DEEP | PARTS))
    return fail(r, "has tiles, deep data or several parts: reading them needs OpenImageIO");
  r->packing = -1;
  while (take_name(r, name)) {
    celspan_status status = read_attribute(r, name);
    if (status != CELSPAN_OK)
      return status;
  }
  if (r->is_over || r->count == 0)
    return fail(r, "is corrupt or truncated");
  if (r->packing < PACKED_NONE || r->packing > CS_EXR_ROWS)
    return fail(r, "is compressed in a way that needs OpenImageIO; save it with ZIP");
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the form */

/* The channel of this name in the requested layer; -1: there is none. */
static int find(const reading *r, const char *name) {
  char whole[NAME + 2];
  const char *layer = r->file->layer;
  snprintf(whole, sizeof whole, "%s%s%s", layer ? layer : "", layer ? "." : "", name);
  for (int i = 0; i < r->count; i++)
    if (strcmp(r->channels[i].name, whole) == 0)
      return i;
  return -1;
}

static celspan_status choose_channels(reading *r) {
  static const char *const colours[] = {"R", "G", "B"};
  int grey = find(r, "Y"), alpha = find(r, "A");
  bool has_colours = find(r, "R") >= 0 && find(r, "G") >= 0 && find(r, "B") >= 0;
  if (!has_colours && grey < 0 && r->file->layer)
    return cs_raster_fail(r->failure, CELSPAN_INPUT, "has no layer \"%s\"", r->file->layer);
  int count = has_colours ? 3 : 1;
  for (int i = 0; i < count; i++)
    r->channels[has_colours ? find(r, colours[i]) : grey >= 0 ? grey : 0].output = i;
  if (alpha >= 0)
    r->channels[alpha].output = count++;
  r->out->channels = count;
  r->out->bits = 32;
  r->out->is_multiplied = alpha >= 0;
  return CELSPAN_OK;
}

/* Codes in another space are of no use without it; light is, if its primaries are known. */
static void choose_colour(reading *r) {
  celspan_transfer own = CELSPAN_TRANSFER_LINEAR;
  bool is_own = cs_transfer_parse(r->colour, &own), is_known = is_own || r->out->has_primaries;
  r->out->colour = is_known || !r->colour[0] ? cs_transfer_name(own) : CS_PICTURE_OTHER;
  r->out->names_colour = r->colour[0] && (is_own || !is_known);
  if (!is_own)
    memcpy(r->out->space, r->colour, sizeof r->colour);
}

/* ---------------------------------------------------------------- rows */

/* The reverse of what is done before compression: changes `from`, and fills `out`. */
static void restore(unsigned char *from, size_t size, unsigned char *out) {
  for (size_t i = 1; i < size; i++)
    from[i] = (unsigned char)(from[i] + from[i - 1] - 128);
  for (size_t i = 0; i < size; i++)
    out[i] = from[i / 2 + (i % 2 ? (size + 1) / 2 : 0)];
}

static bool unpack_runs(const unsigned char *from, size_t size, unsigned char *out, size_t room) {
  size_t done = 0;
  for (size_t at = 0; at < size;) {
    int length = (signed char)from[at++];
    size_t count = length < 0 ? (size_t)-length : (size_t)length + 1;
    if (count > room - done || (length < 0 ? count : 1) > size - at)
      return false;
    if (length < 0)
      memcpy(out + done, from + at, count);
    else
      memset(out + done, from[at], count);
    at += length < 0 ? count : 1;
    done += count;
  }
  return done == room;
}

/* The rows of a chunk before they were compressed. */
static bool unpack(reading *r, const unsigned char *from, size_t size, size_t room) {
  uLongf got = (uLongf)room;
  if (size == room) { /* stored without compression, which would not have made them smaller */
    memcpy(r->rows, from, size);
    return true;
  }
  bool is_good = r->packing == PACKED_RUNS ? unpack_runs(from, size, r->scratch, room)
                 : r->packing >= CS_EXR_ROW
                     ? uncompress(r->scratch, &got, from, (uLong)size) == Z_OK && got == room
                     : false;
  if (is_good)
    restore(r->scratch, room, r->rows);
  return is_good;
}

static float half_value(uint32_t half) {
  uint32_t sign = (half & 0x8000u) << 16, exponent = half >> 10 & 31u, part = half & 1023u;
  float value;
  if (exponent == 0) {
    value = (float)part / 16777216;
    return sign ? -value : value;
  }
  uint32_t bits = sign | (exponent == 31 ? 255u : exponent + 112) << 23 | part << 13;
  memcpy(&value, &bits, sizeof value);
  return value;
}

static float value_of(const unsigned char *bytes, cs_exr_type type) {
  float value;
  if (type == CS_EXR_HALF)
    return half_value((uint32_t)bytes[0] | (uint32_t)bytes[1] << 8);
  uint32_t bits = number_of(bytes);
  if (type == CS_EXR_WHOLE)
    return (float)bits;
  memcpy(&value, &bits, sizeof value);
  return value;
}

static size_t size_of(cs_exr_type type) { return type == CS_EXR_HALF ? 2 : 4; }

/* Copies a row of the data window into the display window. */
static void put_row(const reading *r, const unsigned char *row, int64_t y) {
  int64_t width = (int64_t)r->data.x1 - r->data.x0 + 1, left = (int64_t)r->data.x0 - r->shown.x0;
  int count = r->out->channels;
  float *out = (float *)r->out->pixels + (size_t)y * (size_t)r->out->width * (size_t)count;
  for (int i = 0; i < r->count; row += (size_t)width * size_of(r->channels[i].type), i++) {
    const channel *c = &r->channels[i];
    int64_t from = left < 0 ? -left : 0;
    int64_t to = left + width > r->out->width ? r->out->width - left : width;
    for (int64_t x = from; x < to && c->output >= 0; x++)
      out[(x + left) * count + c->output] = value_of(row + (size_t)x * size_of(c->type), c->type);
  }
}

static bool read_chunk(reading *r, uint64_t place, int lines) {
  r->at = place < r->file->size ? (size_t)place : r->file->size;
  int64_t y = (int64_t)number(r) - r->data.y0, height = (int64_t)r->data.y1 - r->data.y0 + 1;
  size_t size = (uint32_t)number(r);
  const unsigned char *from = take(r, size);
  if (!from || y < 0 || y >= height)
    return false;
  int64_t count = height - y < lines ? height - y : lines;
  if (!unpack(r, from, size, (size_t)count * r->row))
    return false;
  for (int64_t i = 0; i < count; i++) {
    int64_t shown = y + i + r->data.y0 - r->shown.y0;
    if (shown >= 0 && shown < r->out->height)
      put_row(r, r->rows + (size_t)i * r->row, shown);
  }
  return true;
}

static celspan_status read_chunks(reading *r) {
  int lines = r->packing == CS_EXR_ROWS ? CS_EXR_LINES : 1;
  int64_t height = (int64_t)r->data.y1 - r->data.y0 + 1,
          width = (int64_t)r->data.x1 - r->data.x0 + 1;
  for (int i = 0; i < r->count; i++)
    r->row += (size_t)width * size_of(r->channels[i].type);
  int64_t chunks = (height + lines - 1) / lines;
  size_t list = r->at;
  if (!take(r, (size_t)chunks * 8))
    return fail(r, "is truncated");
  r->rows = malloc(r->row * (size_t)lines);
  r->scratch = malloc(r->row * (size_t)lines);
  if (!r->rows || !r->scratch)
    return cs_raster_fail(r->failure, CELSPAN_NO_MEMORY, "out of memory");
  for (int64_t i = 0; i < chunks; i++) {
    const unsigned char *place = r->file->bytes + list + 8 * (size_t)i;
    if (!read_chunk(r, number_of(place) | (uint64_t)number_of(place + 4) << 32, lines))
      return fail(r, "is corrupt or truncated");
  }
  return CELSPAN_OK;
}

/* Whether a window is within the limits; its parts outside of the display window are not kept. */
static bool is_sane(window w) {
  int64_t width = (int64_t)w.x1 - w.x0 + 1, height = (int64_t)w.y1 - w.y0 + 1;
  return width >= 1 && height >= 1 && width <= CS_PICTURE_SIDE && height <= CS_PICTURE_SIDE &&
         (uint64_t)(width * height) <= CS_RASTER_PIXELS;
}

celspan_status cs_raster_exr(const cs_raster_file *file, cs_raster *out,
                             cs_picture_failure *failure) {
  reading r = {.file = file, .out = out, .failure = failure};
  r.channels = malloc(CS_PICTURE_CHANNELS * sizeof *r.channels);
  if (!r.channels)
    return cs_raster_fail(failure, CELSPAN_NO_MEMORY, "out of memory");
  celspan_status status = read_header(&r);
  if (status == CELSPAN_OK)
    status = choose_channels(&r);
  choose_colour(&r);
  if (status == CELSPAN_OK && !(is_sane(r.data) && is_sane(r.shown)))
    status = cs_raster_fail(failure, CELSPAN_LIMIT, "has a window without pixels, or too large");
  if (status == CELSPAN_OK)
    status = cs_raster_make(out, (uint64_t)((int64_t)r.shown.x1 - r.shown.x0 + 1),
                            (uint64_t)((int64_t)r.shown.y1 - r.shown.y0 + 1), failure);
  if (status == CELSPAN_OK)
    status = read_chunks(&r);
  free(r.channels);
  free(r.rows);
  free(r.scratch);
  return status;
}
