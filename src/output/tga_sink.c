/* Targa 2.0 (Truevision, 1991), true colour in packets, straight from spans:
 *
 *   header (18 bytes) | packets of row 0 | ... | extension (495) | footer (26)
 *
 *   a run       1nnnnnnn  B G R A              n + 1 equal pixels, 128 at most
 *   plain       0nnnnnnn  B G R A  B G R A...  n + 1 pixels, each with its bytes
 *
 * Packets end with their row. A is left out of opaque pictures.
 */
#include <string.h>

#include "output/file.h"
#include "output/pixels.h"
#include "output/sink.h"

enum {
  SIDE_MOST = 65535,
  PACKET_MOST = 128,
  WORST_PIXEL = 5, /* bytes of a pixel that is a packet of its own */
  CHUNK = 256,
  HEADER_BYTES = 18,
  EXTENSION_BYTES = 495,
  FOOTER_BYTES = 26
};

typedef struct tga_sink {
  size_t allocated;
  const char *path, *title; /* title: "" without one */
  cs_file *file;            /* from begin to end */
  celspan_coding coding;
  size_t pixel_size; /* 3 without alpha, else 4 */
  int32_t width;
  unsigned char *row; /* packets of a row; from begin to end */
  size_t size;        /* of those packets, in bytes */
  uint32_t run_pixel;
  int32_t run_count; /* pixels not yet in a packet */
  size_t plain_head; /* where the plain packet that can still grow begins */
  int plain_count;   /* its pixels; 0: there is none */
  bool is_clear;     /* some pixel's alpha is not 1 */
  char text[];
} tga_sink;

/* ---------------------------------------------------------------- packets */

/* In the file blue comes first. */
static void put_pixel(tga_sink *sink, uint32_t rgba) {
  uint32_t bgra = (rgba & 0xff00ff00u) | (rgba >> 16 & 0xff) | (rgba & 0xff) << 16;
  memcpy(sink->row + sink->size, &bgra, sizeof bgra);
  sink->size += sink->pixel_size;
}

static void put_plain(tga_sink *sink, uint32_t rgba) {
  if (sink->plain_count == 0 || sink->plain_count == PACKET_MOST) {
    sink->plain_head = sink->size++;
    sink->plain_count = 0;
  }
  sink->row[sink->plain_head] = (unsigned char)sink->plain_count++;
  put_pixel(sink, rgba);
}

static void end_run(tga_sink *sink) {
  if (sink->run_count == 1) {
    put_plain(sink, sink->run_pixel);
  } else {
    for (int32_t left = sink->run_count, count; left > 0; left -= count) {
      count = left < PACKET_MOST ? left : PACKET_MOST;
      sink->row[sink->size++] = (unsigned char)(0x80 | (count - 1));
      put_pixel(sink, sink->run_pixel);
    }
    sink->plain_count = sink->run_count > 0 ? 0 : sink->plain_count;
  }
  sink->run_count = 0;
}

static inline void add_run(tga_sink *sink, uint32_t rgba, int32_t count) {
  if (rgba != sink->run_pixel)
    end_run(sink);
  sink->run_pixel = rgba;
  sink->run_count += count;
  sink->is_clear |= rgba >> 24 != 255;
}

static void add_varying(tga_sink *sink, const celspan_span *span) {
  uint32_t coded[CHUNK];
  for (int32_t x = span->x0; x < span->x1; x += CHUNK) {
    int32_t count = span->x1 - x < CHUNK ? span->x1 - x : CHUNK;
    celspan_span cropped = cs_pixels_crop(span, x, count);
    cs_pixels_row(&sink->coding, &cropped, 1, coded);
    for (int32_t i = 0; i < count; i++)
      add_run(sink, coded[i], 1);
  }
}

static void add_spans(tga_sink *sink, const celspan_span *spans, size_t span_count) {
  for (const celspan_span *span = spans; span < spans + span_count; span++) {
    uint32_t coded;
    if (span->kind != CELSPAN_SPAN_SINGLE) {
      add_varying(sink, span);
      continue;
    }
    cs_pixels_code(&sink->coding, span->colour, &coded);
    add_run(sink, coded, span->x1 - span->x0);
  }
  end_run(sink);
}

/* ---------------------------------------------------------------- around the rows */

static void store_16(unsigned char *at, unsigned number) {
  at[0] = (unsigned char)number;
  at[1] = (unsigned char)(number >> 8);
}

static void store_32(unsigned char *at, uint32_t number) {
  store_16(at, number & 0xffff);
  store_16(at + 2, number >> 16);
}

static celspan_status put_header(tga_sink *sink, celspan_context *context, int32_t height) {
  bool has_alpha = sink->pixel_size == 4;
  unsigned char header[HEADER_BYTES] = {[2] = 10}; /* run-length coded true colour */
  store_16(header + 12, (unsigned)sink->width);
  store_16(header + 14, (unsigned)height);
  header[16] = has_alpha ? 32 : 24;
  header[17] = has_alpha ? 0x28 : 0x20; /* 8 bits of alpha; rows from the top */
  return cs_file_write(sink->file, context, header, sizeof header);
}

/* As much of the text as fits, cut between UTF-8 characters. */
static void store_text(unsigned char *at, size_t room, const char *text) {
  size_t size = strlen(text);
  if (size >= room)
    for (size = room - 1; size > 0 && (text[size] & 0xc0) == 0x80; size--) {
    }
  memcpy(at, text, size);
}

static celspan_status put_footer(tga_sink *sink, celspan_context *context) {
  bool is_straight = sink->coding.alpha == CELSPAN_ALPHA_STRAIGHT;
  uint64_t offset = cs_file_size(sink->file);
  unsigned char tail[EXTENSION_BYTES + FOOTER_BYTES] = {0};
  unsigned char *footer = tail + EXTENSION_BYTES;
  store_16(tail, EXTENSION_BYTES);
  store_text(tail + 379, 41, sink->title); /* the job's name */
  store_text(tail + 426, 41, "celspan");
  store_16(tail + 467, 100 * CELSPAN_VERSION_MAJOR + 10 * CELSPAN_VERSION_MINOR);
  tail[469] = ' ';                                        /* the version has no letter */
  if (sink->coding.transfer == CELSPAN_TRANSFER_LINEAR) { /* gamma, as a fraction */
    store_16(tail + 478, 1);
    store_16(tail + 480, 1);
  }
  tail[494] = sink->pixel_size == 3 ? 0 : is_straight ? 3 : 4;
  store_32(footer, offset <= UINT32_MAX ? (uint32_t)offset : 0);
  memcpy(footer + 8, "TRUEVISION-XFILE.", 18);
  bool is_near = offset <= UINT32_MAX; /* else nothing can point to the extension */
  return cs_file_write(sink->file, context, is_near ? tail : footer,
                       is_near ? sizeof tail : FOOTER_BYTES);
}

/* ---------------------------------------------------------------- the sink */

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  tga_sink *sink = user;
  if (width > SIDE_MOST || height > SIDE_MOST)
    return cs_fail(context, CELSPAN_LIMIT,
                   "%s: the frame is %d x %d pixels; targa files hold at most %d a side",
                   sink->path, (int)width, (int)height, SIDE_MOST);
  sink->width = width;
  sink->row = cs_mem_array(context->memory, (size_t)width, WORST_PIXEL);
  if (!sink->row)
    return cs_fail_memory(context);
  CS_TRY(cs_file_create(context, NULL, sink->path, &sink->file));
  return put_header(sink, context, height);
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  tga_sink *sink = user;
  sink->size = 0;
  sink->plain_count = 0;
  add_spans(sink, spans, span_count);
  if (sink->is_clear && sink->pixel_size == 3)
    return cs_fail(
        context, CELSPAN_BAD_ARGUMENT,
        "%s: row %d has pixels that are not opaque, in a picture that was begun as opaque",
        sink->path, (int)y);
  return cs_file_write(sink->file, context, sink->row, sink->size);
}

static celspan_status finish(tga_sink *sink, celspan_context *context) {
  CS_TRY(put_footer(sink, context));
  cs_file *file = sink->file;
  sink->file = NULL;
  return cs_file_commit(file, context);
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  tga_sink *sink = user;
  if (outcome == CELSPAN_OK)
    outcome = finish(sink, context);
  cs_file_discard(sink->file, context);
  if (sink->row)
    cs_mem_free(context->memory, sink->row, (size_t)sink->width * WORST_PIXEL);
  cs_mem_free(context->memory, sink, sink->allocated);
  return outcome;
}

celspan_status cs_sink_tga(celspan_context *context, const char *path,
                           const celspan_file_desc *file, celspan_sink *out) {
  celspan_coding coding = cs_pixels_resolve(&file->coding, CELSPAN_DEPTH_8);
  if (coding.depth != CELSPAN_DEPTH_8)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: targa files hold depth 8; for more use PNG, EXR or TIFF", path);
  const char *title = file->title ? file->title : "";
  size_t path_size = strlen(path) + 1, title_size = strlen(title) + 1;
  size_t size = sizeof(tga_sink) + path_size + title_size;
  tga_sink *sink = cs_mem_array(context->memory, 1, size);
  if (!sink)
    return cs_fail_memory(context);
  sink->allocated = size;
  sink->coding = coding;
  sink->pixel_size = file->is_opaque ? 3 : 4;
  sink->path = memcpy(sink->text, path, path_size);
  sink->title = memcpy(sink->text + path_size, title, title_size);
  *out = (celspan_sink){.user = sink,
                        .begin = begin,
                        .row = put_row,
                        .end = end,
                        .takes_codes = cs_pixels_takes_codes(&sink->coding)};
  return CELSPAN_OK;
}
