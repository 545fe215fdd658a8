/* Span files: spans stay spans. A colour is coded once and then found again by its bits; gradients
 * and arrays are coded in pieces, and the library finds in them what is even.
 */
#include <spanfile.h>
#include <string.h>

#include "output/file.h"
#include "output/pixels.h"
#include "output/sink.h"

enum {
  PIECE = 4096,
  COLOUR_BITS = 10,
  SHORT = 4,  /* pixels; on an edge, whose colours are not met again */
  EDGE = 1024 /* pixels coded together */
};

typedef struct coded_colour {
  uint64_t bits[2]; /* of the RGBA floats */
  uint64_t pixel;
} coded_colour;

typedef struct span_sink {
  size_t allocated;
  celspan_context *context; /* of the call that is running, for put_bytes */
  celspan_coding coding;
  cs_file *file;                          /* from begin to end */
  spanfile_writer *writer;                /* likewise */
  coded_colour colours[1 << COLOUR_BITS]; /* an empty one says that zeros are coded as zeros */
  unsigned char piece[PIECE * 8];
  float edge[4 * EDGE]; /* colours of short spans, and what they are coded as */
  unsigned char coded_edge[EDGE * 8];
  char path[];
} span_sink;

/* ---------------------------------------------------------------- the library's callbacks */

static bool put_bytes(void *user, const void *bytes, size_t size) {
  span_sink *sink = user;
  return cs_file_write(sink->file, sink->context, bytes, size) == CELSPAN_OK;
}

static void *resize(void *user, void *block, size_t old_size, size_t new_size) {
  return cs_mem_resize(user, block, old_size, new_size);
}

/* A failed write has left its sentence. */
static celspan_status report(const span_sink *sink, spanfile_status status) {
  switch (status) {
  case SPANFILE_OK:
    return CELSPAN_OK;
  case SPANFILE_NO_MEMORY:
    return cs_fail_memory(sink->context);
  case SPANFILE_WRITE_FAILED:
    return CELSPAN_OUTPUT;
  default:
    return cs_fail(sink->context, CELSPAN_BAD_ARGUMENT,
                   "%s: the rows do not make up the picture that was begun", sink->path);
  }
}

/* ---------------------------------------------------------------- colours and spans */

static uint64_t code(const span_sink *sink, const float colour[4]) {
  uint64_t pixel = 0;
  cs_pixels_code(&sink->coding, colour, &pixel);
  return pixel;
}

static uint64_t find_coded(span_sink *sink, const float colour[4]) {
  uint64_t bits[2];
  memcpy(bits, colour, sizeof bits);
  uint64_t mixed = (bits[0] ^ bits[1] * 0x9e3779b97f4a7c15u) * 0xd6e8feb86659fd93u;
  coded_colour *found = &sink->colours[mixed >> (64 - COLOUR_BITS)];
  if (found->bits[0] != bits[0] || found->bits[1] != bits[1]) {
    found->bits[0] = bits[0];
    found->bits[1] = bits[1];
    found->pixel = code(sink, colour);
  }
  return found->pixel;
}

static spanfile_status put_pieces(span_sink *sink, const celspan_span *span) {
  spanfile_status status = SPANFILE_OK;
  for (int32_t x = span->x0; x < span->x1 && status == SPANFILE_OK; x += PIECE) {
    int32_t count = span->x1 - x < PIECE ? span->x1 - x : PIECE;
    celspan_span piece = *span;
    piece.x0 = 0;
    piece.x1 = count;
    piece.origin = span->origin - x;
    if (span->kind == CELSPAN_SPAN_ARRAY)
      piece.array = span->array + 4 * (size_t)(x - span->x0);
    cs_pixels_row(&sink->coding, &piece, 1, sink->piece);
    status = spanfile_writer_pixels(sink->writer, sink->piece, (uint32_t)count);
  }
  return status;
}

static bool is_short(const celspan_span *span) {
  return span->kind == CELSPAN_SPAN_SINGLE && span->x1 - span->x0 < SHORT;
}

/* Codes the short ones among the spans, as many as fit; the first span that was not looked at. */
static const celspan_span *code_edges(span_sink *sink, const celspan_span *span,
                                      const celspan_span *end) {
  int32_t length = 0;
  for (; span < end && length <= EDGE - SHORT; span++) {
    /* Copied whether it counts or not: which ones do cannot be foreseen. */
    float *edge = sink->edge + 4 * length;
    memcpy(edge, span->colour, sizeof span->colour);
    int32_t count = is_short(span) ? span->x1 - span->x0 : 0;
    for (int32_t i = 1; i < count; i++)
      memcpy(edge + 4 * i, edge, sizeof span->colour);
    length += count;
  }
  celspan_span edge = {.x1 = length, .kind = CELSPAN_SPAN_ARRAY, .array = sink->edge};
  cs_pixels_row(&sink->coding, &edge, 1, sink->coded_edge);
  return span;
}

/* The spans whose short ones are coded. */
static spanfile_status put_group(span_sink *sink, const celspan_span *span,
                                 const celspan_span *end) {
  const unsigned char *coded = sink->coded_edge;
  size_t pixel_size = celspan_coding_pixel_size(&sink->coding);
  spanfile_status status = SPANFILE_OK;
  while (span < end && status == SPANFILE_OK) {
    int32_t x0 = span->x0;
    uint32_t length = (uint32_t)(span->x1 - x0);
    if (is_short(span)) {
      for (span++; span < end && is_short(span);)
        span++;
      length = (uint32_t)(span[-1].x1 - x0);
      status = spanfile_writer_pixels(sink->writer, coded, length);
      coded += length * pixel_size;
    } else if (span->kind == CELSPAN_SPAN_SINGLE) {
      status = spanfile_writer_run(sink->writer, length, find_coded(sink, span->colour));
      span++;
    } else {
      status = put_pieces(sink, span++);
    }
  }
  return status;
}

static spanfile_status put_spans(span_sink *sink, const celspan_span *spans, size_t count) {
  const celspan_span *end = spans + count;
  spanfile_status status = SPANFILE_OK;
  while (spans < end && status == SPANFILE_OK) {
    const celspan_span *next = code_edges(sink, spans, end);
    status = put_group(sink, spans, next);
    spans = next;
  }
  return status;
}

/* ---------------------------------------------------------------- the sink */

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  span_sink *sink = user;
  sink->context = context;
  spanfile_writer_desc desc = {.width = (uint32_t)width,
                               .height = (uint32_t)height,
                               .format = sink->coding.depth == CELSPAN_DEPTH_HALF ? SPANFILE_HALF
                                                                                  : SPANFILE_SRGB8,
                               .write = put_bytes,
                               .user = sink,
                               .resize = resize,
                               .resize_user = context->memory};
  CS_TRY(cs_file_create(context, NULL, sink->path, &sink->file));
  return report(sink, spanfile_writer_create(&desc, &sink->writer));
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  span_sink *sink = user;
  (void)y;
  sink->context = context;
  spanfile_status status = put_spans(sink, spans, span_count);
  return report(sink, status == SPANFILE_OK ? spanfile_writer_row(sink->writer) : status);
}

static celspan_status finish(span_sink *sink) {
  CS_TRY(report(sink, spanfile_writer_finish(sink->writer)));
  cs_file *file = sink->file;
  sink->file = NULL;
  return cs_file_commit(file, sink->context);
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  span_sink *sink = user;
  sink->context = context;
  if (outcome == CELSPAN_OK)
    outcome = finish(sink);
  spanfile_writer_destroy(sink->writer);
  cs_file_discard(sink->file, context);
  cs_mem_free(context->memory, sink, sink->allocated);
  return outcome;
}

static bool is_storable(const celspan_coding *coding) {
  if (coding->depth == CELSPAN_DEPTH_8)
    return coding->transfer == CELSPAN_TRANSFER_SRGB && coding->alpha == CELSPAN_ALPHA_STRAIGHT;
  return coding->depth == CELSPAN_DEPTH_HALF && coding->transfer == CELSPAN_TRANSFER_LINEAR &&
         coding->alpha == CELSPAN_ALPHA_PREMULTIPLIED;
}

celspan_status cs_sink_span(celspan_context *context, const char *path,
                            const celspan_file_desc *file, celspan_sink *out) {
  celspan_coding coding = cs_pixels_resolve(&file->coding, CELSPAN_DEPTH_8);
  if (!is_storable(&coding))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: span files hold depth 8 in sRGB with straight alpha, or depth half in "
                   "linear light, premultiplied; for others use PNG, EXR or TIFF",
                   path);
  size_t path_size = strlen(path) + 1;
  span_sink *sink = cs_mem_array(context->memory, 1, sizeof *sink + path_size);
  if (!sink)
    return cs_fail_memory(context);
  sink->allocated = sizeof *sink + path_size;
  sink->coding = coding;
  memcpy(sink->path, path, path_size);
  *out = (celspan_sink){.user = sink, .begin = begin, .row = put_row, .end = end};
  return CELSPAN_OK;
}
