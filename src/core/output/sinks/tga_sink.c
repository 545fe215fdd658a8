/* Targa 2.0 (Truevision, 1991), true colour in packets, straight from spans:
 *
 *   header (18 bytes) | image ID of a strip (12) | packets | ... | extension (495) | footer (26)
 *
 *   a run       1nnnnnnn  B G R A              n + 1 equal pixels, 128 at most
 *   plain       0nnnnnnn  B G R A  B G R A...  n + 1 pixels, each with its bytes
 *
 * Packets end with their row. A is left out of opaque pictures.
 */
#include <string.h>

#include "output/sinks/file.h"
#include "output/sinks/pixels.h"
#include "output/sinks/sink.h"
#include "output/sinks/strip.h"
#include "output/sinks/tga.h"

enum {
  PACKET_MOST = 128,
  WORST_PIXEL = 5, /* bytes of a pixel that needs a packet for itself */
  CHUNK = 256
};

typedef struct tga_sink {
  size_t allocated;
  const char *path, *title; /* title: "" if there is none */
  cs_file *file;            /* from begin to end */
  celspan_coding coding;
  cs_strip strip;
  size_t pixel_size; /* 3 without alpha, otherwise 4 */
  int32_t width;
  unsigned char *row; /* packets of a row; from begin to end */
  size_t size;        /* bytes of those packets */
  uint32_t run_pixel;
  int32_t run_count; /* pixels not yet in a packet */
  size_t plain_head; /* where the last plain packet begins, which can still grow */
  int plain_count;   /* pixels of this packet; 0: there is none */
  bool is_clear;     /* some pixel's alpha is not 1 */
  char text[];
} tga_sink;

/* ---------------------------------------------------------------- packets */

/* In the file, blue is the first channel. */
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

static celspan_status put_header(tga_sink *sink, celspan_context *context, int32_t height) {
  bool has_alpha = sink->pixel_size == 4;
  unsigned char header[CS_TGA_HEADER] = {[2] = 10}; /* run-length coded true colour */
  unsigned char place[CS_TGA_PLACE] = CS_STRIP_MARK;
  bool is_strip = sink->strip.height > 0;
  header[0] = is_strip ? CS_TGA_PLACE : 0;
  cs_tga_store_16(header + 12, (unsigned)sink->width);
  cs_tga_store_16(header + 14, (unsigned)height);
  header[16] = has_alpha ? 32 : 24;
  header[17] = has_alpha ? 0x28 : 0x20; /* 8 bits of alpha; rows from the top */
  cs_tga_store_32(place + 4, (uint32_t)sink->strip.row);
  cs_tga_store_32(place + 8, (uint32_t)sink->strip.height);
  CS_TRY(cs_file_write(sink->file, context, header, sizeof header));
  return is_strip ? cs_file_write(sink->file, context, place, sizeof place) : CELSPAN_OK;
}

/* Stores as much of the text as fits, cut between UTF-8 characters. */
static void store_text(unsigned char *at, size_t room, const char *text) {
  size_t size = strlen(text);
  if (size >= room)
    for (size = room - 1; size > 0 && (text[size] & 0xc0) == 0x80; size--) {
    }
  memcpy(at, text, size);
}

static celspan_status put_footer(tga_sink *sink, celspan_context *context) {
  bool is_straight = sink->coding.alpha == CELSPAN_ALPHA_STRAIGHT;
  unsigned char tail[CS_TGA_EXTENSION] = {0};
  cs_tga_store_16(tail, CS_TGA_EXTENSION);
  store_text(tail + 379, 41, sink->title); /* the job's name */
  store_text(tail + 426, 41, "celspan");
  cs_tga_store_16(tail + 467, 100 * CELSPAN_VERSION_MAJOR + 10 * CELSPAN_VERSION_MINOR);
  tail[469] = ' ';                                        /* the version has no letter */
  if (sink->coding.transfer == CELSPAN_TRANSFER_LINEAR) { /* gamma, as a fraction */
    cs_tga_store_16(tail + 478, 1);
    cs_tga_store_16(tail + 480, 1);
  }
  tail[494] = sink->pixel_size == 3 ? 0 : is_straight ? 3 : 4;
  return cs_tga_put_end(sink->file, context, tail);
}

/* ---------------------------------------------------------------- the sink */

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  tga_sink *sink = user;
  int32_t whole = sink->strip.height > height ? sink->strip.height : height;
  if (width > CS_TGA_SIDE_MOST || whole > CS_TGA_SIDE_MOST)
    return cs_fail(context, CELSPAN_LIMIT,
                   "%s: the frame is %d x %d pixels; Targa files hold at most %d a side",
                   sink->path, (int)width, (int)whole, CS_TGA_SIDE_MOST);
  CS_TRY(cs_strip_check(context, sink->path, sink->strip, height));
  sink->width = width;
  CS_TRY(cs_mem_make(context, (void **)&sink->row, (size_t)width, WORST_PIXEL));
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

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  tga_sink *sink = user;
  if (outcome == CELSPAN_OK)
    outcome = put_footer(sink, context);
  outcome = cs_file_end(sink->file, context, outcome);
  if (sink->row)
    cs_mem_free(context->memory, sink->row, (size_t)sink->width * WORST_PIXEL);
  cs_mem_free(context->memory, sink, sink->allocated);
  return outcome;
}

celspan_status cs_sink_tga(celspan_context *context, const char *path,
                           const celspan_file_desc *file, celspan_sink *out) {
  celspan_coding coding = cs_pixels_resolve(file->coding, CELSPAN_DEPTH_8);
  if (coding.depth != CELSPAN_DEPTH_8)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: Targa files hold depth 8; for more use PNG, EXR or TIFF", path);
  const char *title = file->title ? file->title : "";
  size_t path_size = strlen(path) + 1, title_size = strlen(title) + 1;
  size_t size = sizeof(tga_sink) + path_size + title_size;
  tga_sink *sink;
  CS_TRY(cs_mem_make(context, (void **)&sink, 1, size));
  sink->allocated = size;
  sink->coding = coding;
  sink->strip = cs_strip_of(file);
  sink->pixel_size = file->is_opaque ? 3 : 4;
  sink->path = memcpy(sink->text, path, path_size);
  sink->title = memcpy(sink->text + path_size, title, title_size);
  *out = (celspan_sink){CS_SINK_CALLS, .user = sink,
                        .takes_codes = cs_pixels_takes_codes(&sink->coding)};
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- what joining shares */

celspan_status cs_tga_put_end(cs_file *file, celspan_context *context,
                              const unsigned char extension[CS_TGA_EXTENSION]) {
  uint64_t offset = cs_file_size(file);
  bool is_near = offset <= UINT32_MAX; /* otherwise the extension cannot be addressed */
  unsigned char footer[CS_TGA_FOOTER] = {0};
  cs_tga_store_32(footer, is_near ? (uint32_t)offset : 0);
  memcpy(footer + 8, CS_TGA_SIGNATURE, sizeof CS_TGA_SIGNATURE);
  if (is_near)
    CS_TRY(cs_file_write(file, context, extension, CS_TGA_EXTENSION));
  return cs_file_write(file, context, footer, sizeof footer);
}
