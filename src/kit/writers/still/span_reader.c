#include "writers/still/span_reader.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "inside/colour.h"
#include "inside/context.h"
#include "inside/files.h"
#include "inside/pictures.h"

struct cs_span_reader {
  celspan_context *context;
  size_t allocated;
  int descriptor;
  uint64_t bytes;
  spanfile_reader *reader;
  spanfile_info info;
  float light[256]; /* the light of an 8-bit sRGB code */
  CS_ARRAY(celspan_span, spans);
  CS_ARRAY(float, colours);        /* the colours of the row's arrays */
  CS_ARRAY(unsigned char, pixels); /* the pixels of one array, as in the file */
  char path[];
};

/* ---------------------------------------------------------------- the file */

static bool read_all(int descriptor, uint64_t offset, unsigned char *bytes, size_t size) {
  ssize_t got = cs_open_read_at(descriptor, bytes, size, (off_t)offset);
  if (got >= 0 && (size_t)got < size)
    errno = EIO; /* the file has become shorter */
  return got == (ssize_t)size;
}

static bool read_bytes(void *user, uint64_t offset, void *bytes, size_t size) {
  const cs_span_reader *file = user;
  return read_all(file->descriptor, offset, bytes, size);
}

static celspan_status report(const cs_span_reader *file, spanfile_status status,
                             const spanfile_fault *fault) {
  if (status == SPANFILE_OK)
    return CELSPAN_OK;
  if (status == SPANFILE_NO_MEMORY)
    return cs_fail_memory(file->context);
  if (status == SPANFILE_READ_FAILED)
    return cs_fail(file->context, CELSPAN_INPUT, "%s: byte %" PRIu64 ": %s", file->path,
                   fault->offset, strerror(errno));
  return cs_fail(file->context, CELSPAN_INPUT, "%s: byte %" PRIu64 ": %s", file->path,
                 fault->offset, fault->reason);
}

bool cs_span_reader_accepts(const char *path) {
  unsigned char start[SPANFILE_MAGIC_BYTES];
  struct stat there;
  int descriptor = cs_open_to_read(path);
  bool is_file = descriptor >= 0 && fstat(descriptor, &there) == 0 && S_ISREG(there.st_mode);
  bool is_span =
      is_file && read_all(descriptor, 0, start, sizeof start) && spanfile_is(start, sizeof start);
  if (descriptor >= 0)
    close(descriptor);
  return is_span;
}

static celspan_status open_file(cs_span_reader *file) {
  struct stat there;
  file->descriptor = cs_open_to_read(file->path);
  if (file->descriptor < 0 || fstat(file->descriptor, &there) != 0)
    return cs_fail(file->context, CELSPAN_INPUT, "%s: %s", file->path, strerror(errno));
  file->bytes = (uint64_t)there.st_size;
  spanfile_source source = {.read = read_bytes,
                            .user = file,
                            .size = file->bytes,
                            .resize = cs_mem_resize_of,
                            .resize_user = file->context->memory};
  spanfile_fault fault;
  CS_TRY(report(file, spanfile_reader_create(&source, &file->reader, &fault), &fault));
  file->info = spanfile_reader_info(file->reader);
  if (file->info.width > CS_PICTURE_SIDE || file->info.height > CS_PICTURE_SIDE)
    return cs_fail(file->context, CELSPAN_LIMIT,
                   "%s: is %" PRIu32 " x %" PRIu32 " pixels; at most %d a side are read",
                   file->path, file->info.width, file->info.height, CS_PICTURE_SIDE);
  for (int code = 0; code < 256; code++)
    file->light[code] = cs_transfer_decode(CELSPAN_TRANSFER_SRGB, (float)code / 255);
  return CELSPAN_OK;
}

celspan_status cs_span_reader_open(celspan_context *context, const char *path,
                                   cs_span_reader **out) {
  size_t size = sizeof(cs_span_reader) + strlen(path) + 1;
  cs_span_reader *file;
  CS_TRY(cs_mem_make(context, (void **)&file, 1, size));
  file->context = context;
  file->allocated = size;
  file->descriptor = -1;
  memcpy(file->path, path, strlen(path) + 1);
  celspan_status status = open_file(file);
  return CS_GIVE(status, file, cs_span_reader_close, out);
}

void cs_span_reader_close(cs_span_reader *file) {
  if (!file)
    return;
  cs_memory *memory = file->context->memory;
  spanfile_reader_destroy(file->reader);
  if (file->descriptor >= 0)
    close(file->descriptor);
  CS_ARRAYS_FREE(memory, file, spans, pixels);
  cs_mem_free(memory, file, file->allocated);
}

spanfile_info cs_span_reader_info(const cs_span_reader *file) { return file->info; }
uint64_t cs_span_reader_bytes(const cs_span_reader *file) { return file->bytes; }

celspan_status cs_span_reader_check(cs_span_reader *file, spanfile_counts *counts) {
  spanfile_fault fault;
  return report(file, spanfile_reader_check(file->reader, counts, &fault), &fault);
}

/* ---------------------------------------------------------------- colours */

static float from_half(unsigned half) {
  unsigned exponent = half >> 10 & 31, fraction = half & 1023;
  uint32_t bits = ((exponent == 31 ? 255 : exponent + 127 - 15) << 23) | fraction << 13;
  float size = (float)fraction * 0x1p-24f; /* below 2^-14 */
  if (exponent > 0)
    memcpy(&size, &bits, sizeof size);
  return half & 0x8000 ? -size : size;
}

static void to_colour(const cs_span_reader *file, const unsigned char *pixel, float rgba[4]) {
  if (file->info.format == SPANFILE_HALF) {
    for (int c = 0; c < 4; c++)
      rgba[c] = from_half(pixel[2 * c] | (unsigned)pixel[2 * c + 1] << 8);
    return;
  }
  rgba[3] = (float)pixel[3] / 255;
  for (int c = 0; c < 3; c++)
    rgba[c] = file->light[pixel[c]] * rgba[3];
}

/* How many pixels of the row's values belong to a span. */
static uint32_t values_of(const spanfile_span *span, uint32_t start) {
  return span->kind == SPANFILE_RAW ? span->end - start : span->kind == SPANFILE_GRADIENT ? 2 : 0;
}

/* The spans of a row that overlap [x0, x1), from `first` on. */
typedef struct row_range {
  uint32_t x0, x1;
  const spanfile_span *first, *end; /* end: of the row */
  uint32_t start;                   /* the column where the first span begins */
  const unsigned char *values;      /* the values of the first span */
} row_range;

static row_range find_range(const cs_span_reader *file, const spanfile_row *row, uint32_t x0,
                            uint32_t x1) {
  const spanfile_span *span = row->spans, *end = row->spans + row->count;
  uint32_t start = 0;
  size_t pixels = 0;
  for (; span < end && span->end <= x0; start = span++->end)
    pixels += values_of(span, start);
  return (row_range){x0,    x1,
                     span,  row->spans + row->count,
                     start, row->values + pixels * spanfile_pixel_size(file->info.format)};
}

static celspan_status make_room(cs_span_reader *file, const row_range *range) {
  size_t spans = 0, arrays = 0, longest = 0;
  uint32_t from = range->x0;
  for (const spanfile_span *span = range->first; span < range->end && from < range->x1; span++) {
    size_t count = (span->end < range->x1 ? span->end : range->x1) - from;
    spans++;
    if (span->kind != SPANFILE_RUN) {
      arrays += count;
      longest = count > longest ? count : longest;
    }
    from = span->end;
  }
  celspan_context *context = file->context;
  size_t pixel_size = spanfile_pixel_size(file->info.format);
  CS_TRY(CS_ARRAY_RESERVE(context, file->spans, spans));
  CS_TRY(CS_ARRAY_RESERVE(context, file->colours, 4 * arrays));
  return CS_ARRAY_RESERVE(context, file->pixels, longest * pixel_size);
}

/* Writes the array's colours. The span is passed as a row by itself, so that only it is decoded. */
static void decode_array(const cs_span_reader *file, const spanfile_span *span, uint32_t start,
                         const unsigned char *values, uint32_t from, uint32_t to, float *colours) {
  spanfile_span alone = {span->end - start, span->kind, span->pixel};
  spanfile_row row = {&alone, 1, values};
  spanfile_row_pixels(file->info.format, &row, from - start, to - start, file->pixels);
  size_t pixel_size = spanfile_pixel_size(file->info.format);
  for (uint32_t i = 0; i < to - from; i++)
    to_colour(file, file->pixels + i * pixel_size, colours + 4 * (size_t)i);
}

static void set_run(const cs_span_reader *file, const spanfile_span *span, celspan_span *out) {
  unsigned char pixel[8];
  for (int i = 0; i < 8; i++)
    pixel[i] = (unsigned char)(span->pixel >> 8 * i);
  out->kind = CELSPAN_SPAN_SINGLE;
  to_colour(file, pixel, out->colour);
}

/* Converts the spans into file->spans and file->colours, which are large enough. Returns how
 * many. */
static size_t convert_range(cs_span_reader *file, const row_range *range) {
  size_t pixel_size = spanfile_pixel_size(file->info.format);
  const unsigned char *values = range->values;
  celspan_span *out = file->spans;
  float *colours = file->colours;
  uint32_t start = range->start, from = range->x0;
  for (const spanfile_span *span = range->first; span < range->end && from < range->x1; span++) {
    uint32_t to = span->end < range->x1 ? span->end : range->x1;
    *out = (celspan_span){.x0 = (int32_t)(from - range->x0), .x1 = (int32_t)(to - range->x0)};
    if (span->kind == SPANFILE_RUN) {
      set_run(file, span, out);
    } else {
      out->kind = CELSPAN_SPAN_ARRAY;
      out->array = colours;
      decode_array(file, span, start, values, from, to, colours);
      colours += 4 * (size_t)(to - from);
    }
    values += values_of(span, start) * pixel_size;
    start = from = span->end;
    out++;
  }
  return (size_t)(out - file->spans);
}

celspan_status cs_span_reader_row(cs_span_reader *file, int32_t y, int32_t x0, int32_t x1,
                                  const celspan_span **spans, size_t *span_count) {
  spanfile_row row;
  spanfile_fault fault;
  CS_TRY(report(file, spanfile_reader_row(file->reader, (uint32_t)y, &row, &fault), &fault));
  row_range range = find_range(file, &row, (uint32_t)x0, (uint32_t)x1);
  CS_TRY(make_room(file, &range));
  *span_count = convert_range(file, &range);
  *spans = file->spans;
  return CELSPAN_OK;
}
