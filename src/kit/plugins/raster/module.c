/* The table of functions that the core finds in this module: opening, turning, and rectangles. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/opened.h"
#include "plugins/raster/raster.h"
#include "plugins/raster/write.h"

#define FILE_MOST ((off_t)1 << 32)

struct cs_picture_reader {
  cs_raster raster;
};

/* ---------------------------------------------------------------- the file */

static const struct {
  const char *format, *magic;
  size_t size, at;
  cs_raster_decode decode;
} formats[] = {
    {"png", "\x89PNG\r\n\x1a\n", 8, 0, cs_raster_png},
    {"jpeg", "\xff\xd8\xff", 3, 0, cs_raster_jpeg},
    {"webp", "WEBP", 4, 8, cs_raster_webp},
    {"tiff", "II*\0", 4, 0, cs_raster_tiff},
    {"tiff", "MM\0*", 4, 0, cs_raster_tiff},
    {"tiff", "II+\0", 4, 0, cs_raster_tiff},
    {"tiff", "MM\0+", 4, 0, cs_raster_tiff},
    {"openexr", "\x76\x2f\x31\x01", 4, 0, cs_raster_exr},
};

static bool read_all(int descriptor, unsigned char *bytes, size_t size) {
  for (size_t done = 0; done < size;) {
    ssize_t got = pread(descriptor, bytes + done, size - done, (off_t)done);
    if (got < 0 && errno == EINTR)
      continue;
    if (got <= 0)
      return false;
    done += (size_t)got;
  }
  return true;
}

/* Reads the bytes of an open file; *bytes must be freed. */
static celspan_status load(int descriptor, const struct stat *found, unsigned char **bytes,
                           cs_picture_failure *failure) {
  if (!S_ISREG(found->st_mode))
    return cs_raster_fail(failure, CELSPAN_INPUT, "is not a file; a picture must be one");
  if (found->st_size == 0)
    return cs_raster_fail(failure, CELSPAN_INPUT, "is empty");
  if (found->st_size > FILE_MOST)
    return cs_raster_fail(failure, CELSPAN_LIMIT, "has more than 4 GiB");
  *bytes = malloc((size_t)found->st_size);
  if (!*bytes)
    return cs_raster_fail(failure, CELSPAN_NO_MEMORY, "out of memory");
  errno = EIO; /* if the file has become shorter */
  return read_all(descriptor, *bytes, (size_t)found->st_size)
             ? CELSPAN_OK
             : cs_raster_fail(failure, CELSPAN_INPUT, "cannot be read: %s", strerror(errno));
}

static celspan_status decode(const cs_raster_file *file, cs_raster *out,
                             cs_picture_failure *failure) {
  for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
    bool is_it = file->size >= formats[i].at + formats[i].size &&
                 memcmp(file->bytes + formats[i].at, formats[i].magic, formats[i].size) == 0;
    if (!is_it)
      continue;
    *out = (cs_raster){.format = formats[i].format, .orientation = 1};
    bool has_layers = formats[i].decode == cs_raster_exr,
         has_parts = has_layers || formats[i].decode == cs_raster_tiff;
    if (file->subimage && !has_parts)
      return cs_raster_fail(failure, CELSPAN_INPUT, "has no subimage %d", file->subimage);
    if (file->layer && !has_layers)
      return cs_raster_fail(failure, CELSPAN_INPUT, "has no layer \"%s\"", file->layer);
    return formats[i].decode(file, out, failure);
  }
  return cs_raster_fail(failure, CELSPAN_INPUT,
                        "is not a picture of a format that is read without OpenImageIO (png, "
                        "jpeg, webp, tiff, openexr)");
}

/* ---------------------------------------------------------------- opening */

static bool is_transposed(const cs_raster *raster) { return raster->orientation >= 5; }

static bool has_alpha(const cs_raster *raster) { return raster->channels % 2 == 0; }

static void describe(const cs_raster *raster, const struct stat *found, cs_picture_header *header) {
  bool turns = is_transposed(raster);
  *header = (cs_picture_header){
      .info = {.width = turns ? raster->height : raster->width,
               .height = turns ? raster->width : raster->height,
               .channels = raster->stored ? raster->stored : raster->channels,
               .has_alpha = has_alpha(raster) && !raster->lacks_alpha,
               .is_float = raster->bits == 32 && !raster->is_whole},
      .alpha = raster->is_multiplied ? CS_PICTURE_ALPHA_CODED : CS_PICTURE_ALPHA_STRAIGHT,
      .bits = raster->bits == 32 ? 0 : raster->bits,
      .dpi = raster->dpi,
      .is_whole = true,
      .file_size = (int64_t)found->st_size,
      .file_time = (int64_t)found->st_mtim.tv_sec * 1000000000 + found->st_mtim.tv_nsec,
      .file_number = (uint64_t)found->st_ino};
  snprintf(header->info.format, sizeof header->info.format, "%s", raster->format);
  snprintf(header->info.colour, sizeof header->info.colour, "%s", raster->colour);
  memcpy(header->space, raster->space, sizeof header->space);
  memcpy(header->profile, raster->profile, sizeof header->profile);
  header->names_colour = raster->names_colour;
  header->has_primaries = raster->has_primaries;
  memcpy(header->primaries, raster->primaries, sizeof header->primaries);
}

static celspan_status open_file(const cs_picture_request *request, cs_raster *out,
                                cs_picture_header *header, cs_picture_failure *failure) {
  struct stat found;
  unsigned char *bytes = NULL;
  int descriptor = cs_opened_again(request->file);
  if (descriptor < 0 || fstat(descriptor, &found) != 0) {
    cs_raster_fail(failure, CELSPAN_INPUT, "cannot be opened: %s", strerror(errno));
    if (descriptor >= 0)
      close(descriptor);
    return CELSPAN_INPUT;
  }
  celspan_status status = load(descriptor, &found, &bytes, failure);
  close(descriptor);
  const cs_raster_file file = {bytes, (size_t)found.st_size, request->layer, request->subimage};
  if (status == CELSPAN_OK)
    status = decode(&file, out, failure);
  if (status == CELSPAN_OK && (out->orientation < 1 || out->orientation > 8))
    out->orientation = 1;
  if (status == CELSPAN_OK)
    describe(out, &found, header);
  free(bytes);
  return status;
}

/* Puts the name of the file before the sentence. */
static celspan_status name_failure(cs_picture_failure *failure, const char *name) {
  cs_picture_failure named = {failure->status, ""};
  if (snprintf(named.text, sizeof named.text, "%s: %s", name, failure->text) >= 0)
    *failure = named;
  return failure->status;
}

static celspan_status open_reader(const cs_picture_request *request, cs_picture_reader **out,
                                  cs_picture_header *header, cs_picture_failure *failure) {
  cs_picture_header made;
  cs_picture_reader *reader = calloc(1, sizeof *reader);
  celspan_status status;
  if (!reader)
    status = cs_raster_fail(failure, CELSPAN_NO_MEMORY, "out of memory");
  else if (request->space)
    status = cs_raster_fail(failure, CELSPAN_BAD_ARGUMENT,
                            "colour \"%s\" is not known; \"srgb\", \"linear\", \"rec709\" and "
                            "\"cineon\" are, and others with OpenImageIO",
                            request->space);
  else
    status = open_file(request, &reader->raster, &made, failure);
  if (status == CELSPAN_OK) {
    *header = made;
    *out = reader;
    return CELSPAN_OK;
  }
  if (reader)
    cs_raster_finish(&reader->raster);
  free(reader);
  return name_failure(failure, request->file);
}

static void close_reader(cs_picture_reader *reader) {
  cs_raster_finish(&reader->raster);
  free(reader);
}

/* ---------------------------------------------------------------- reading */

/* The stored pixel that is shown at (x, y), by the orientation. */
static size_t place_of(const cs_raster *raster, int32_t x, int32_t y) {
  int32_t right = raster->width - 1, bottom = raster->height - 1;
  int o = raster->orientation;
  int32_t column = is_transposed(raster) ? y : x, row = is_transposed(raster) ? x : y;
  bool turns_x = o == 2 || o == 3 || o == 7 || o == 8,
       turns_y = o == 3 || o == 4 || o == 6 || o == 7;
  column = turns_x ? right - column : column;
  row = turns_y ? bottom - row : row;
  return (size_t)row * (size_t)raster->width + (size_t)column;
}

static float value_at(const cs_raster *raster, size_t at) {
  if (raster->bits == 8)
    return (float)((const unsigned char *)raster->pixels)[at] * (1.0f / 255);
  if (raster->bits == 16)
    return (float)((const uint16_t *)raster->pixels)[at] * (1.0f / 65535);
  return ((const float *)raster->pixels)[at];
}

static celspan_status read_reader(cs_picture_reader *reader, int32_t x, int32_t y, int32_t width,
                                  int32_t height, float *rgba, cs_picture_failure *failure) {
  const cs_raster *raster = &reader->raster;
  size_t channels = (size_t)raster->channels;
  bool is_grey = channels < 3;
  (void)failure;
  for (int32_t row = y; row < y + height; row++)
    for (int32_t column = x; column < x + width; column++, rgba += 4) {
      size_t at = place_of(raster, column, row) * channels;
      for (size_t c = 0; c < 3; c++)
        rgba[c] = value_at(raster, at + (is_grey ? 0 : c));
      rgba[3] = has_alpha(raster) ? value_at(raster, at + channels - 1) : 1;
    }
  return CELSPAN_OK;
}

static celspan_status list_reader(cs_picture_reader *reader,
                                  bool (*put)(void *user, const cs_picture_part *part), void *user,
                                  cs_picture_failure *failure) {
  const cs_raster *raster = &reader->raster;
  cs_picture_part part = {
      .width = raster->width, .height = raster->height, .channels = raster->channels};
  (void)failure;
  snprintf(part.depth, sizeof part.depth, "%s",
           raster->bits == 32   ? "float"
           : raster->bits == 16 ? "16"
                                : "8");
  for (int i = 0; i < raster->part_count; i++)
    if (!put(user, &raster->parts[i]))
      return CELSPAN_OK;
  if (!raster->part_count)
    put(user, &part);
  return CELSPAN_OK;
}

/* A caller that asks for pictures also reads errno. */
static void watch_memory(void) {}

const void *celspan_picture_module(void) {
  static const cs_picture_module table = {.version = CS_PICTURE_MODULE_VERSION,
                                          .open = open_reader,
                                          .read = read_reader,
                                          .close = close_reader,
                                          .list = list_reader,
                                          .write_open = cs_write_open,
                                          .write_rows = cs_write_rows,
                                          .write_close = cs_write_close,
                                          .write_abandon = cs_write_abandon,
                                          .watch_memory = watch_memory};
  return &table;
}
