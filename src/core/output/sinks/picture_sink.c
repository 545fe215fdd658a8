/* Frames in the formats of the picture module: coded here, row by row, and passed on in batches.
 *
 *   spans --cs_pixels_row--> RGBA --pack--> the file's own channels --batch--> picture_file.h
 *           R G B A of a depth        R G B, or R G B A
 *
 * The limits of a format are checked before its writer is opened: some writers end the process,
 * wrap the size around, or report success and leave an unreadable file.
 */
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "output/sinks/coder.h"
#include "output/sinks/file.h"
#include "output/sinks/picture_file.h"
#include "output/sinks/pixels.h"
#include "output/sinks/sink.h"

#define BATCH_BYTES ((size_t)4 << 20)
#define BATCH_ROWS 64

#define HAS(depth) (1u << (depth))

typedef struct file_format {
  const char *endings; /* the endings of paths, each between spaces */
  const char *name;    /* the name in the module */
  const char *title;   /* in messages */
  int32_t side;        /* pixels, at most */
  int64_t pixels;      /* width times height at most; 0: any */
  int channels;        /* 4, or 3: the frame over black */
  celspan_depth depth; /* the depth unless another is given */
  unsigned depths;     /* a bit for each depth that the format supports */
  bool is_film;        /* ten bits and Cineon by default */
  bool is_multiplied;  /* alpha is always premultiplied */
  bool is_tagged;      /* colours are said by numbers that only srgb, rec709 and linear have */
} file_format;

static const file_format formats[] = {
    {" exr openexr ", "openexr", "EXR", 1048576, 0, 4, CELSPAN_DEPTH_HALF,
     HAS(CELSPAN_DEPTH_HALF) | HAS(CELSPAN_DEPTH_FLOAT), false, true, false},
    {" tif tiff ", "tiff", "TIFF", 1048576, 0, 4, CELSPAN_DEPTH_8,
     HAS(CELSPAN_DEPTH_8) | HAS(CELSPAN_DEPTH_16) | HAS(CELSPAN_DEPTH_FLOAT), false, false, false},
    /* The writer of this format keeps the whole picture in memory. */
    {" dpx ", "dpx", "DPX", 1048576, (int64_t)1 << 28, 3, CELSPAN_DEPTH_16,
     HAS(CELSPAN_DEPTH_8) | HAS(CELSPAN_DEPTH_16), true, true, false},
    {" jpg jpeg ", "jpeg", "JPEG", 65500, 0, 3, CELSPAN_DEPTH_8, HAS(CELSPAN_DEPTH_8), false, true,
     false},
    /* Sizes in the file are 32 bits. */
    {" bmp ", "bmp", "BMP", 1048576, (int64_t)1 << 30, 3, CELSPAN_DEPTH_8, HAS(CELSPAN_DEPTH_8),
     false, true, false},
    {" hdr rgbe ", "hdr", "HDR", 1048576, 0, 3, CELSPAN_DEPTH_FLOAT, HAS(CELSPAN_DEPTH_FLOAT),
     false, true, false},
    /* In files of sixteen bits, values would be shifted by a byte. */
    {" ppm pnm ", "pnm", "PNM", 1048576, 0, 3, CELSPAN_DEPTH_8, HAS(CELSPAN_DEPTH_8), false, true,
     false},
    /* The writer of this format divides by alpha with a curve of its own, so it gets no alpha. */
    {" webp ", "webp", "WebP", 16383, 0, 3, CELSPAN_DEPTH_8, HAS(CELSPAN_DEPTH_8), false, true,
     false},
    {" gif ", "gif", "GIF", 65535, (int64_t)1 << 28, 3, CELSPAN_DEPTH_8, HAS(CELSPAN_DEPTH_8),
     false, true, false},
    {" jp2 j2k jpeg2000 ", "jpeg2000", "JPEG 2000", 65535, (int64_t)1 << 28, 3, CELSPAN_DEPTH_8,
     HAS(CELSPAN_DEPTH_8) | HAS(CELSPAN_DEPTH_16), false, true, false},
    {" avif ", CS_PICTURE_AVIF, "AVIF", CS_AVIF_SIDE, CS_AVIF_PIXELS, 4, CELSPAN_DEPTH_8,
     HAS(CELSPAN_DEPTH_8) | HAS(CELSPAN_DEPTH_16), false, false, true},
};

typedef struct picture_sink {
  const file_format *format;
  celspan_coding coding; /* the coding of `pixels` */
  celspan_depth depth;   /* in the file */
  int bits;              /* how many bits of each value are used; 0: all */
  char *path, *title;    /* title: may be NULL */
  double frames_second;
  int32_t frame;
  int32_t width, height;
  cs_picture_file file;
  unsigned char *pixels; /* one row of RGBA */
  unsigned char *batch;  /* rows in the form of the file */
  int32_t batch_rows, batch_first, batch_count;
} picture_sink;

/* ---------------------------------------------------------------- formats and codings */

static const file_format *find_format(const char *name) {
  char wanted[16];
  size_t length = strlen(name);
  if (length + 3 > sizeof wanted)
    return NULL;
  snprintf(wanted, sizeof wanted, " %s ", name);
  for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
    if (strcasestr(formats[i].endings, wanted))
      return &formats[i];
  return NULL;
}

static const char *depth_name(celspan_depth depth) {
  static const char *const names[] = {"default", "8", "16", "half", "float"};
  return names[depth];
}

static void list_depths(const file_format *format, char *text, size_t size) {
  *text = 0;
  for (int depth = CELSPAN_DEPTH_8; depth <= CELSPAN_DEPTH_FLOAT; depth++)
    if (format->depths & HAS(depth)) {
      size_t length = strlen(text);
      snprintf(text + length, size - length, "%s%s", length ? ", " : "",
               depth_name((celspan_depth)depth));
    }
}

static celspan_status choose_coding(celspan_context *context, const char *path,
                                    const celspan_coding *wanted, picture_sink *sink) {
  const file_format *format = sink->format;
  celspan_coding plain = *wanted, *asked = &plain;
  if (asked->depth == CELSPAN_DEPTH_8_DITHER)
    asked->depth = CELSPAN_DEPTH_8;
  if (asked->depth && !(format->depths & HAS(asked->depth))) {
    char depths[64];
    list_depths(format, depths, sizeof depths);
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: %s files hold depth %s, not %s", path,
                   format->title, depths, depth_name(asked->depth));
  }
  if (format->channels == 4 && format->is_multiplied && asked->alpha == CELSPAN_ALPHA_STRAIGHT)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: %s files hold premultiplied alpha, not straight", path, format->title);
  if (format->is_tagged && (asked->convert || asked->transfer == CELSPAN_TRANSFER_CINEON))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: %s files hold colours as srgb, rec709 or linear, not as %s", path,
                   format->title, asked->convert ? cs_pixels_colour(asked) : "cineon");
  celspan_coding coding = *asked;
  if (format->is_film && coding.transfer == CELSPAN_TRANSFER_DEFAULT && !coding.convert)
    coding.transfer = CELSPAN_TRANSFER_CINEON;
  if (format->is_multiplied)
    coding.alpha = CELSPAN_ALPHA_PREMULTIPLIED;
  sink->coding = cs_pixels_resolve(&coding, format->depth);
  if (format->channels == 4 && sink->coding.alpha == CELSPAN_ALPHA_PREMULTIPLIED &&
      sink->coding.transfer != CELSPAN_TRANSFER_LINEAR)
    sink->coding.alpha = CS_ALPHA_CODED;
  if (format->channels == 3 && coding.convert)
    sink->coding.alpha = CS_ALPHA_BLACK;
  sink->depth = sink->coding.depth;
  /* Ten bits are rounded here, directly from the floats that the curve returns. */
  sink->bits = format->is_film && !asked->depth ? 10 : 0;
  if (sink->bits)
    sink->coding.depth = CELSPAN_DEPTH_FLOAT;
  return CELSPAN_OK;
}

static celspan_status check_size(celspan_context *context, const picture_sink *sink, int32_t width,
                                 int32_t height) {
  const file_format *format = sink->format;
  if (width > format->side || height > format->side)
    return cs_fail(context, CELSPAN_LIMIT,
                   "%s: the frame is %d x %d pixels; %s files hold at most %d a side", sink->path,
                   (int)width, (int)height, format->title, (int)format->side);
  if (format->pixels && (int64_t)width * height > format->pixels)
    return cs_fail(context, CELSPAN_LIMIT,
                   "%s: the frame is %d x %d pixels; %s files hold at most %lld pixels", sink->path,
                   (int)width, (int)height, format->title, (long long)format->pixels);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- rows */

static size_t value_size(celspan_depth depth) {
  return depth == CELSPAN_DEPTH_8 ? 1 : depth == CELSPAN_DEPTH_FLOAT ? 4 : 2;
}

static size_t row_size(const picture_sink *sink) {
  return (size_t)sink->width * (size_t)sink->format->channels * value_size(sink->depth);
}

/* Ten bits at the top of sixteen, repeated below: readers extend them in the same way. */
static void pack_film(const float *pixels, int32_t width, uint16_t *out) {
  for (int32_t x = 0; x < width; x++)
    for (int c = 0; c < 3; c++) {
      double value = (double)pixels[4 * (size_t)x + (size_t)c] * 1023 + 0.5;
      unsigned code = value >= 1023 ? 1023 : value >= 0 ? (unsigned)value : 0;
      *out++ = (uint16_t)(code << 6 | code >> 4);
    }
}

static void pack_row(const picture_sink *sink, unsigned char *out) {
  size_t from = cs_pixels_size(&sink->coding);
  if (sink->bits) {
    pack_film((const float *)(const void *)sink->pixels, sink->width, (uint16_t *)(void *)out);
    return;
  }
  size_t to = (size_t)sink->format->channels * value_size(sink->depth);
  for (int32_t x = 0; x < sink->width; x++)
    memcpy(out + (size_t)x * to, sink->pixels + (size_t)x * from, to);
}

static celspan_status flush(picture_sink *sink, celspan_context *context) {
  if (sink->batch_count == 0)
    return CELSPAN_OK;
  celspan_status status =
      cs_picture_file_rows(&sink->file, context, sink->batch_first, sink->batch_count, sink->batch);
  sink->batch_first += sink->batch_count;
  sink->batch_count = 0;
  return status;
}

/* ---------------------------------------------------------------- the sink */

static void free_text(cs_memory *memory, char *text) {
  if (text)
    cs_mem_free(memory, text, strlen(text) + 1);
}

static void destroy(picture_sink *sink, celspan_context *context) {
  cs_memory *memory = context->memory;
  cs_picture_file_discard(&sink->file, context);
  if (sink->pixels)
    cs_mem_free(memory, sink->pixels, (size_t)sink->width * cs_pixels_size(&sink->coding));
  cs_mem_free(memory, sink->batch, (size_t)sink->batch_rows * row_size(sink));
  free_text(memory, sink->path);
  free_text(memory, sink->title);
  cs_mem_free(memory, sink, sizeof *sink);
}

static celspan_status open_file(picture_sink *sink, celspan_context *context) {
  cs_picture_output output = {.name = sink->path,
                              .format = sink->format->name,
                              .width = sink->width,
                              .height = sink->height,
                              .channels = sink->format->channels,
                              .depth = sink->depth,
                              .bits = sink->bits,
                              .is_straight = sink->coding.alpha == CELSPAN_ALPHA_STRAIGHT,
                              .colour = cs_pixels_colour(&sink->coding),
                              .title = sink->title,
                              .frames_second = sink->frames_second,
                              .frame = sink->frame,
                              .moving = {.quality = CS_AVIF_CRF}};
  output.has_primaries = cs_pixels_primaries(&sink->coding, output.primaries);
  return cs_picture_file_open(context, &output, &sink->file);
}

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  picture_sink *sink = user;
  CS_TRY(check_size(context, sink, width, height));
  sink->width = width;
  sink->height = height;
  size_t fitting = BATCH_BYTES / row_size(sink);
  sink->batch_rows = fitting < 1 ? 1 : fitting > BATCH_ROWS ? BATCH_ROWS : (int32_t)fitting;
  CS_TRY(
      cs_mem_make(context, (void **)&sink->pixels, (size_t)width, cs_pixels_size(&sink->coding)));
  CS_TRY(cs_mem_make(context, (void **)&sink->batch, (size_t)sink->batch_rows, row_size(sink)));
  return open_file(sink, context);
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  picture_sink *sink = user;
  (void)y;
  cs_pixels_row(&sink->coding, spans, span_count, sink->pixels);
  pack_row(sink, sink->batch + (size_t)sink->batch_count * row_size(sink));
  sink->batch_count++;
  return sink->batch_count == sink->batch_rows ? flush(sink, context) : CELSPAN_OK;
}

static celspan_status finish(picture_sink *sink, celspan_context *context) {
  CS_TRY(flush(sink, context));
  return cs_picture_file_close(&sink->file, context);
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  celspan_status status = outcome == CELSPAN_OK ? finish(user, context) : outcome;
  destroy(user, context);
  return status;
}

bool cs_sink_picture_knows(const char *name) { return find_format(name) != NULL; }

void cs_sink_picture_list(char *out, size_t size) {
  for (size_t i = 0, length = 0; i < sizeof formats / sizeof *formats && length < size; i++) {
    const char *first = formats[i].endings + 1;
    length += (size_t)snprintf(out + length, size - length, "%s%.*s", i ? ", " : "",
                               (int)strcspn(first, " "), first);
  }
}

static char *copy_text(cs_memory *memory, const char *text) {
  char *copy = cs_mem_resize(memory, NULL, 0, strlen(text) + 1);
  return copy ? strcpy(copy, text) : NULL;
}

celspan_status cs_sink_picture(celspan_context *context, const char *path,
                               const celspan_file_desc *file, celspan_sink *out) {
  const char *name = file->format ? file->format : cs_file_ending(path);
  picture_sink made = {
      .format = find_format(name), .frames_second = file->frames_second, .frame = file->frame};
  if (!made.format)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: the format \"%s\" cannot be written", path,
                   name);
  CS_TRY(choose_coding(context, path, file->coding, &made));
  made.path = copy_text(context->memory, path);
  made.title = file->title ? copy_text(context->memory, file->title) : NULL;
  picture_sink *sink = cs_mem_array(context->memory, 1, sizeof *sink);
  if (!sink || !made.path || !made.title != !file->title) {
    cs_mem_free(context->memory, sink, sizeof *sink);
    free_text(context->memory, made.path);
    free_text(context->memory, made.title);
    return cs_fail_memory(context);
  }
  *sink = made;
  *out = (celspan_sink){CS_SINK_CALLS, .user = sink,
                        .takes_codes = cs_pixels_takes_codes(&sink->coding)};
  return cs_coder_dither(context, file->coding, &sink->coding, file->place_x, file->place_y, out);
}
