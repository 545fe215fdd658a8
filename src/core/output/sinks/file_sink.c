/* Files of every format: the choice of the sink, and a guard in front of it. */
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/context.h"
#include "base/description.h"
#include "output/sinks/coder.h"
#include "output/sinks/file.h"
#include "output/sinks/pixels.h"
#include "output/sinks/shares.h"
#include "output/sinks/sink.h"

/* ---------------------------------------------------------------- the guard */

/* The entry of every sink that writes a file: it checks the order of a caller's calls.
 *
 *   create --> begin --> row 0, row 1, ... row height-1 --> end(OK)         the file is complete
 *      |         |          |
 *      +---------+----------+-- a call out of order, spans that do not cover the row, a failure:
 *                               every later call is refused, and end leaves nothing
 *
 * INVARIANT: the sink behind the door gets calls in this order alone: one begin with a size of 1 to
 * 1,048,576 pixels a side, rows whose spans cover them without gap, and an end whose outcome is OK
 * only if all rows were put. So no format asks for this again.
 */
#define SIDE_MOST 1048576

typedef struct guard {
  celspan_sink inner;
  size_t allocated;
  int32_t width, height;  /* 0 until a begin has succeeded */
  int32_t rows;           /* rows that were put */
  celspan_status failure; /* the first call's that failed; after it only `end` is allowed */
  bool has_shares;        /* rows are put into shares, and not through the guard */
  bool takes_codes;
  char path[];
} guard;

/* Refuses a call. After it, as after a failed one, the sink cannot be used any more. */
#define REFUSE(guard, context, ...)                                                                \
  ((guard)->failure = cs_fail((context), CELSPAN_BAD_ARGUMENT, __VA_ARGS__))

static celspan_status refuse_failed(const guard *g, celspan_context *context) {
  return cs_fail(context, g->failure, "%s: the picture cannot continue after a failure (%s)",
                 g->path, celspan_status_name(g->failure));
}

/* ---------------------------------------------------------------- begin */

static celspan_status check_begin(guard *g, celspan_context *context, int32_t width,
                                  int32_t height) {
  if (g->failure != CELSPAN_OK)
    return refuse_failed(g, context);
  if (g->width > 0)
    return REFUSE(g, context, "%s: the picture has begun already", g->path);
  if (width < 1 || height < 1 || width > SIDE_MOST || height > SIDE_MOST)
    return REFUSE(g, context, "%s: the frame is %d x %d pixels; it must have 1 to %d a side",
                  g->path, (int)width, (int)height, SIDE_MOST);
  return CELSPAN_OK;
}

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  guard *g = user;
  CS_TRY(check_begin(g, context, width, height));
  g->failure = g->inner.begin(g->inner.user, context, width, height);
  if (g->failure == CELSPAN_OK) {
    g->width = width;
    g->height = height;
  }
  return g->failure;
}

/* ---------------------------------------------------------------- rows */

static bool has_pixels(const guard *g, const celspan_span *span) {
  switch (span->kind) {
  case CELSPAN_SPAN_SINGLE:
  case CELSPAN_SPAN_GRADIENT:
    return true;
  case CELSPAN_SPAN_ARRAY:
    return span->array || (g->takes_codes && span->codes);
  }
  return false;
}

static celspan_status check_spans(guard *g, celspan_context *context, int32_t y,
                                  const celspan_span *spans, size_t span_count) {
  int32_t x = 0;
  if (!spans || span_count == 0 || span_count > (size_t)g->width)
    return REFUSE(g, context, "%s: row %d has %zu spans; a row of %d pixels has from 1 to %d",
                  g->path, (int)y, spans ? span_count : 0, (int)g->width, (int)g->width);
  for (const celspan_span *span = spans; span < spans + span_count; span++) {
    if (span->x0 != x || span->x1 <= x || span->x1 > g->width)
      return REFUSE(g, context,
                    "%s: row %d: span %zu is from %d to %d; it must begin at %d and end by %d",
                    g->path, (int)y, (size_t)(span - spans) + 1, (int)span->x0, (int)span->x1,
                    (int)x, (int)g->width);
    if (!has_pixels(g, span))
      return REFUSE(g, context, "%s: row %d: span %zu is of kind %d and has no array of pixels",
                    g->path, (int)y, (size_t)(span - spans) + 1, (int)span->kind);
    x = span->x1;
  }
  if (x < g->width)
    return REFUSE(g, context, "%s: row %d: the spans end at %d of %d pixels", g->path, (int)y,
                  (int)x, (int)g->width);
  return CELSPAN_OK;
}

static celspan_status check_row(guard *g, celspan_context *context, int32_t y) {
  if (g->failure != CELSPAN_OK)
    return refuse_failed(g, context);
  if (g->width == 0)
    return REFUSE(g, context, "%s: row %d comes before the picture has begun", g->path, (int)y);
  if (g->rows == g->height)
    return REFUSE(g, context, "%s: row %d comes after all %d rows", g->path, (int)y,
                  (int)g->height);
  if (y != g->rows)
    return REFUSE(g, context, "%s: row %d comes where row %d is due", g->path, (int)y,
                  (int)g->rows);
  return CELSPAN_OK;
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  guard *g = user;
  CS_TRY(check_row(g, context, y));
  CS_TRY(check_spans(g, context, y, spans, span_count));
  g->failure = g->inner.row(g->inner.user, context, y, spans, span_count);
  g->rows += g->failure == CELSPAN_OK;
  return g->failure;
}

/* ---------------------------------------------------------------- end */

static celspan_status check_end(guard *g, celspan_context *context) {
  if (g->failure != CELSPAN_OK)
    return refuse_failed(g, context);
  if (g->width == 0)
    return REFUSE(g, context, "%s: the picture ends without a beginning", g->path);
  if (g->rows < g->height && !(g->has_shares && g->rows == 0))
    return REFUSE(g, context, "%s: the picture ends after %d of %d rows", g->path, (int)g->rows,
                  (int)g->height);
  return CELSPAN_OK;
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  guard *g = user;
  if (outcome == CELSPAN_OK)
    outcome = check_end(g, context);
  outcome = g->inner.end(g->inner.user, context, outcome);
  cs_mem_free(context->memory, g, g->allocated);
  return outcome;
}

/* Puts a guard in front of *sink. path: for messages; copied. On failure *sink is discarded.
 * Errors: NO_MEMORY. */
static CELSPAN_CHECKED celspan_status guard_sink(celspan_context *context, const char *path,
                                                 celspan_sink *sink) {
  size_t path_size = strlen(path) + 1, size = sizeof(guard) + path_size;
  guard *g = cs_mem_array(context->memory, 1, size);
  if (!g) {
    cs_sink_discard(context, sink);
    return cs_fail_memory(context);
  }
  g->inner = *sink;
  g->allocated = size;
  g->takes_codes = sink->takes_codes;
  memcpy(g->path, path, path_size);
  *sink = (celspan_sink){CS_SINK_CALLS, .user = g, .takes_codes = g->takes_codes};
  return CELSPAN_OK;
}

/* The sink behind a guard, which will get its rows in shares from now on; for another sink, the
 * sink itself. */
static const celspan_sink *open_guard(const celspan_sink *sink) {
  if (sink->row != put_row)
    return sink;
  guard *g = sink->user;
  g->has_shares = true;
  return &g->inner;
}

/* ---------------------------------------------------------------- the choice of a format */

/* A format that is made from spans. */
typedef struct file_format {
  const char *endings[2];
  celspan_status (*create)(celspan_context *, const char *, const celspan_file_desc *,
                           celspan_sink *);
  bool is_dithered; /* depth 8_DITHER is allowed: another sink dithers before it */
  bool has_strips;  /* writers/join can join them */
} file_format;

static const file_format formats[] = {{{"png"}, cs_sink_png, true, true},
                                      {{"tga", "targa"}, cs_sink_tga, true, true},
                                      {{"span"}, cs_sink_span, false, true}};
/* Any other. */
static const file_format picture_format = {{NULL}, cs_sink_picture, false, false};

static const char *format_name(const char *path, const celspan_file_desc *file) {
  return file->format ? file->format : cs_file_ending(path);
}

static const file_format *find_format(const char *path, const celspan_file_desc *file) {
  const char *name = format_name(path, file);
  for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
    for (size_t k = 0; k < 2 && formats[i].endings[k]; k++)
      if (strcasecmp(name, formats[i].endings[k]) == 0)
        return &formats[i];
  return &picture_format;
}

bool cs_sink_file_knows(const char *path, const celspan_file_desc *file) {
  return find_format(path, file) != &picture_format ||
         cs_sink_picture_knows(format_name(path, file));
}

void cs_sink_file_list(char *out, size_t size) {
  size_t length = 0;
  for (size_t i = 0; i < sizeof formats / sizeof *formats && length < size; i++)
    length += (size_t)snprintf(out + length, size - length, "%s, ", formats[i].endings[0]);
  if (length < size)
    cs_sink_picture_list(out + length, size - length);
}

bool cs_sink_file_is_numbered(const char *path, const celspan_file_desc *file) {
  return find_format(path, file) == &picture_format;
}

static celspan_status create(celspan_context *context, const char *path,
                             const celspan_file_desc *file, celspan_sink *out) {
  const file_format *format = find_format(path, file);
  if (format_name(path, file)[0] == '\0')
    return cs_fail(
        context, CELSPAN_BAD_ARGUMENT,
        "%s: the format is unknown: give the file an extension such as .png, or name a format",
        path);
  if (file->strip_height != 0 && !format->has_strips)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: strips can be joined only as PNG, Targa or span files", path);
  if (!cs_sink_file_knows(path, file)) {
    char list[CS_SINK_LIST];
    cs_sink_file_list(list, sizeof list);
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: the format \"%s\" cannot be written; pictures can be %s", path,
                   format_name(path, file), list);
  }
  celspan_sink sink;
  CS_TRY(format->create(context, path, file, &sink));
  if (format->is_dithered) {
    celspan_coding coding = cs_pixels_resolve(file->coding, CELSPAN_DEPTH_8);
    CS_TRY(cs_coder_dither(context, file->coding, &coding, file->place_x, file->place_y, &sink));
  }
  *out = sink;
  return CELSPAN_OK;
}

celspan_status cs_sink_file(celspan_context *context, const char *path,
                            const celspan_file_desc *file, celspan_sink *out) {
  const celspan_coding plain = CELSPAN_CODING;
  celspan_file_desc known = *file;
  celspan_sink sink;
  if (!known.coding)
    known.coding = &plain;
  if (!path || !*path)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "the file to write has no name");
  CS_TRY(cs_pixels_check(context, known.coding));
  CS_TRY(create(context, path, &known, &sink));
  CS_TRY(guard_sink(context, path, &sink));
  *out = sink;
  return CELSPAN_OK;
}

celspan_status celspan_file_sink_create(celspan_context *context, const char *path,
                                        const celspan_file_desc *file, celspan_sink *out) {
  celspan_sink sink;
  if (!file)
    file = cs_celspan_file_desc_description.defaults;
  CS_READ(context, "file", celspan_file_desc, file);
  celspan_coding coding;
  CS_TRY(cs_pixels_read(context, &file_whole.coding, &coding));
  CS_TRY(cs_description_read(context, "sink", &cs_celspan_sink_description, out, &sink));
  CS_TRY(cs_sink_file(context, path, file, &sink));
  cs_description_write(&cs_celspan_sink_description, &sink, out, out->struct_size);
  return CELSPAN_OK;
}

bool cs_sink_shares(const celspan_sink *sink, cs_shares *out) {
  const celspan_sink *outer = open_guard(sink), *inner = cs_coder_sink_inner(outer);
  *out = (cs_shares){.rows = 0};
  if (inner->row && !cs_memory_sink_shares(inner, out) && !cs_ycc_sink_shares(inner, out) &&
      !cs_png_sink_shares(inner, out) && !cs_span_sink_shares(inner, out))
    return false;
  cs_coder_sink_shares(outer, out);
  return true;
}

const cs_coder *cs_sink_coder(const celspan_sink *sink) {
  const cs_coder *coder = cs_coder_sink_own(sink);
  coder = coder ? coder : cs_memory_sink_coder(sink);
  coder = coder ? coder : cs_ycc_sink_coder(sink);
  return coder && coder->coding.depth != CELSPAN_DEPTH_FLOAT && !coder->coding.convert ? coder
                                                                                       : NULL;
}
