#include "writers/exr/exr.h"

#include <zlib.h>

#include "common/bytes.h"
#include "inside/sort.h"
#include "writers/exr/rate.h"

#define WIDE ((size_t)1 << 20) /* the bytes of a row from which on a chunk has one */

/* ---------------------------------------------------------------- bytes */

static bool put(cs_exr *exr, const void *bytes, size_t size) {
  bool is_good = exr->target.put(exr->target.user, exr->at, bytes, size);
  exr->at += size;
  return is_good;
}

static bool put_number(cs_exr *exr, uint32_t number) {
  unsigned char bytes[4];
  cs_bytes_put_little(bytes, number, 4);
  return put(exr, bytes, sizeof bytes);
}

static bool put_float(cs_exr *exr, float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  return put_number(exr, bits);
}

/* A text with its end. */
static bool put_name(cs_exr *exr, const char *name) { return put(exr, name, strlen(name) + 1); }

/* ---------------------------------------------------------------- the header */

static bool put_attribute(cs_exr *exr, const char *name, const char *type, size_t size) {
  return put_name(exr, name) && put_name(exr, type) && put_number(exr, (uint32_t)size);
}

void cs_exr_time(cs_exr_timing *timing, double frames_second, int32_t frame) {
  int32_t fraction[2];
  cs_bytes_put_little(timing->frame, (uint32_t)frame, 4);
  timing->attributes[0] = (cs_exr_attribute){"celspan:frame", "int", timing->frame, 4};
  timing->count = 1;
  if (!cs_rate_fraction(frames_second, fraction))
    return;
  cs_bytes_put_little(timing->rate, (uint32_t)fraction[0], 4);
  cs_bytes_put_little(timing->rate + 4, (uint32_t)fraction[1], 4);
  timing->attributes[timing->count++] =
      (cs_exr_attribute){"framesPerSecond", "rational", timing->rate, 8};
}

static bool put_attributes(cs_exr *exr) {
  const cs_exr_attribute *first = exr->picture->attributes;
  bool is_good = true;
  for (const cs_exr_attribute *a = first; a < first + exr->picture->attribute_count; a++)
    is_good =
        is_good && put_attribute(exr, a->name, a->type, a->size) && put(exr, a->bytes, a->size);
  return is_good;
}

static bool put_primaries(cs_exr *exr) {
  const float *xy = exr->picture->primaries;
  bool is_good = !xy || put_attribute(exr, "chromaticities", "chromaticities", 32);
  for (int i = 0; xy && i < 8; i++)
    is_good = is_good && put_float(exr, xy[i]);
  return is_good;
}

static bool put_channels(cs_exr *exr) {
  const cs_exr_picture *picture = exr->picture;
  size_t size = 1;
  for (size_t i = 0; i < picture->channel_count; i++)
    size += strlen(picture->channels[i].name) + 1 + 16;
  bool is_good = put_attribute(exr, "channels", "chlist", size);
  for (size_t i = 0; i < picture->channel_count && is_good; i++)
    is_good = put_name(exr, picture->channels[i].name) &&
              put_number(exr, picture->channels[i].type) && put_number(exr, 0) &&
              put_number(exr, 1) && put_number(exr, 1);
  return is_good && put(exr, "", 1);
}

static bool put_box(cs_exr *exr, const char *name) {
  return put_attribute(exr, name, "box2i", 16) && put_number(exr, 0) && put_number(exr, 0) &&
         put_number(exr, (uint32_t)exr->picture->width - 1) &&
         put_number(exr, (uint32_t)exr->picture->height - 1);
}

static bool put_byte(cs_exr *exr, const char *name, unsigned char byte) {
  return put_attribute(exr, name, name, 1) && put(exr, &byte, 1);
}

static bool put_screen(cs_exr *exr) {
  return put_attribute(exr, "pixelAspectRatio", "float", 4) && put_float(exr, 1) &&
         put_attribute(exr, "screenWindowCenter", "v2f", 8) && put_float(exr, 0) &&
         put_float(exr, 0) && put_attribute(exr, "screenWindowWidth", "float", 4) &&
         put_float(exr, 1);
}

static uint32_t version_of(const cs_exr_picture *picture) {
  uint32_t version = CS_EXR_VERSION;
  for (size_t i = 0; i < picture->channel_count; i++)
    version |= strlen(picture->channels[i].name) > 31 ? CS_EXR_LONG_NAMES : 0;
  return version;
}

static bool put_header(cs_exr *exr) {
  return put_number(exr, CS_EXR_MAGIC) && put_number(exr, version_of(exr->picture)) &&
         put_attributes(exr) && put_primaries(exr) && put_channels(exr) &&
         put_byte(exr, "compression", exr->lines == 1 ? CS_EXR_ROW : CS_EXR_ROWS) &&
         put_box(exr, "dataWindow") && put_box(exr, "displayWindow") &&
         put_byte(exr, "lineOrder", 0) && put_screen(exr) && put(exr, "", 1);
}

/* ---------------------------------------------------------------- chunks */

/* Before compression, the bytes are reordered, first those with even indices and then those with
 * odd ones; then each byte is replaced by its difference from the previous one. */
static void spread(const unsigned char *bytes, size_t size, unsigned char *out) {
  for (size_t i = 0; i < size; i++)
    out[i / 2 + (i % 2 ? (size + 1) / 2 : 0)] = bytes[i];
  for (size_t i = size; i-- > 1;)
    out[i] = (unsigned char)(out[i] - out[i - 1] + 128);
}

static bool put_chunk(cs_exr *exr) {
  size_t size = (size_t)exr->kept * exr->row;
  uLongf packed = compressBound((uLong)size);
  int32_t first = exr->done - exr->kept;
  spread(exr->rows, size, exr->scratch);
  if (compress(exr->packed, &packed, exr->scratch, (uLong)size) != Z_OK)
    return false;
  cs_bytes_put_little(exr->places + 8 * (first / exr->lines), exr->at, 8);
  bool is_smaller = packed < size;
  size_t stored = is_smaller ? packed : size;
  exr->kept = 0;
  return put_number(exr, (uint32_t)first) && put_number(exr, (uint32_t)stored) &&
         put(exr, is_smaller ? exr->packed : exr->rows, stored);
}

static size_t value_size(const cs_exr_channel *channel) {
  return channel->type == CS_EXR_HALF ? 2 : 4;
}

/* All values of a channel together, with the channels in the order of their names. */
static void split_row(const cs_exr_picture *picture, const unsigned char *row, unsigned char *out) {
  for (size_t i = 0; i < picture->channel_count; i++) {
    const cs_exr_channel *channel = &picture->channels[i];
    size_t size = value_size(channel);
    for (size_t x = 0; x < (size_t)picture->width; x++, out += size)
      memcpy(out, row + channel->offset + x * channel->stride, size);
  }
}

/* ---------------------------------------------------------------- the file */

static inline bool is_before(const cs_exr_channel *a, const cs_exr_channel *b) {
  return strcmp(a->name, b->name) < 0;
}

CS_SORT_DEFINE(sort_channels, cs_exr_channel, is_before)

void cs_exr_sort(cs_exr_channel *channels, size_t count) { sort_channels(channels, count); }

static size_t row_size(const cs_exr_picture *picture) {
  size_t size = 0;
  for (size_t i = 0; i < picture->channel_count; i++)
    size += (size_t)picture->width * value_size(&picture->channels[i]);
  return size;
}

static int lines_of(const cs_exr_picture *picture) {
  return row_size(picture) < WIDE ? CS_EXR_LINES : 1;
}

static size_t places_size(const cs_exr_picture *picture) {
  size_t lines = (size_t)lines_of(picture);
  return 8 * (((size_t)picture->height + lines - 1) / lines);
}

size_t cs_exr_memory(const cs_exr_picture *picture) {
  size_t chunk = row_size(picture) * (size_t)lines_of(picture);
  return places_size(picture) + 2 * chunk + compressBound((uLong)chunk);
}

bool cs_exr_begin(cs_exr *exr, const cs_exr_picture *picture, cs_exr_target target, void *memory) {
  *exr = (cs_exr){.picture = picture,
                  .target = target,
                  .row = row_size(picture),
                  .lines = lines_of(picture),
                  .places = memory};
  size_t places = places_size(picture), chunk = exr->row * (size_t)exr->lines;
  memset(exr->places, 0, places);
  exr->rows = exr->places + places;
  exr->scratch = exr->rows + chunk;
  exr->packed = exr->scratch + chunk;
  if (!put_header(exr))
    return false;
  exr->list = exr->at;
  return put(exr, exr->places, places);
}

bool cs_exr_row(cs_exr *exr, const unsigned char *row) {
  split_row(exr->picture, row, exr->rows + (size_t)exr->kept * exr->row);
  exr->kept++;
  exr->done++;
  return (exr->kept < exr->lines && exr->done < exr->picture->height) || put_chunk(exr);
}

bool cs_exr_end(cs_exr *exr) {
  exr->at = exr->list;
  return put(exr, exr->places, places_size(exr->picture));
}
