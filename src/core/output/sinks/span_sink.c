/* Span files. Single spans become runs without being laid out:
 *
 *   single spans --cs_single_colours_code--> runs -------+
 *   gradients, arrays --cs_pixels_row--> pixels ---------+--> the library spanfile --> file
 *
 * In pixels, which come CHUNK at a time, the library itself looks for runs and gradients.
 *
 * Several threads each pack parts of the file, which are joined in order (output/sinks/shares.h).
 */
#include <spanfile.h>
#include <string.h>

#include "output/sinks/file.h"
#include "output/sinks/pixels.h"
#include "output/sinks/shares.h"
#include "output/sinks/sink.h"
#include "output/sinks/strip.h"

enum { CHUNK = 4096 };

/* The state of one thread that packs rows. */
typedef struct packer {
  const celspan_coding *coding;
  spanfile_writer *writer; /* the writer of the file, or of the part that is packed */
  cs_single_colours colours;
  spanfile_run runs[CS_SINGLE_COLOURS_MOST];
  unsigned char chunk[CHUNK * 8];
} packer;

typedef struct span_sink {
  size_t allocated;
  celspan_context *context; /* the context of the call in progress, for put_bytes */
  celspan_coding coding;
  cs_strip strip;
  spanfile_writer_desc desc; /* from begin on */
  cs_file *file;             /* from begin to end */
  packer packer;             /* likewise its writer */
  char path[];
} span_sink;

/* ---------------------------------------------------------------- the library's callbacks */

static bool put_bytes(void *user, const void *bytes, size_t size) {
  span_sink *sink = user;
  return cs_file_write(sink->file, sink->context, bytes, size) == CELSPAN_OK;
}

/* A write that failed has set the error already. */
static celspan_status report(const span_sink *sink, celspan_context *context,
                             spanfile_status status) {
  switch (status) {
  case SPANFILE_OK:
    return CELSPAN_OK;
  case SPANFILE_NO_MEMORY:
    return cs_fail_memory(context);
  case SPANFILE_WRITE_FAILED:
    return CELSPAN_OUTPUT;
  default:
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: the rows do not make up the picture that was begun", sink->path);
  }
}

/* ---------------------------------------------------------------- spans */

static spanfile_status put_varying(packer *p, const celspan_span *span) {
  spanfile_status status = SPANFILE_OK;
  for (int32_t x = span->x0; x < span->x1 && status == SPANFILE_OK; x += CHUNK) {
    int32_t count = span->x1 - x < CHUNK ? span->x1 - x : CHUNK;
    celspan_span cropped = cs_pixels_crop(span, x, count);
    cs_pixels_row(p->coding, &cropped, 1, p->chunk);
    status = spanfile_writer_pixels(p->writer, p->chunk, (uint32_t)count);
  }
  return status;
}

/* At most CS_SINGLE_COLOURS_MOST spans. */
static spanfile_status put_group(packer *p, const celspan_span *spans, size_t count) {
  size_t pixel_size = cs_pixels_size(p->coding), run_count = 0;
  spanfile_status status = SPANFILE_OK;
  cs_single_colours_code(&p->colours, p->coding, spans, count);
  for (size_t i = 0; i < count; i++)
    if (spans[i].kind == CELSPAN_SPAN_SINGLE) {
      uint64_t pixel = cs_single_colours_pixel(&p->colours, pixel_size, i);
      p->runs[run_count++] = (spanfile_run){(uint32_t)(spans[i].x1 - spans[i].x0), pixel};
    } else {
      (void)spanfile_writer_runs(p->writer, p->runs, run_count); /* errors stick */
      run_count = 0;
      status = put_varying(p, &spans[i]);
    }
  return run_count > 0 ? spanfile_writer_runs(p->writer, p->runs, run_count) : status;
}

static spanfile_status put_spans(packer *p, const celspan_span *spans, size_t count) {
  spanfile_status status = SPANFILE_OK;
  for (size_t done = 0; done < count && status == SPANFILE_OK; done += CS_SINGLE_COLOURS_MOST)
    status =
        put_group(p, spans + done,
                  count - done < CS_SINGLE_COLOURS_MOST ? count - done : CS_SINGLE_COLOURS_MOST);
  return status;
}

static spanfile_status put_spans_row(packer *p, const celspan_span *spans, size_t count) {
  spanfile_status status = put_spans(p, spans, count);
  return status == SPANFILE_OK ? spanfile_writer_row(p->writer) : status;
}

/* ---------------------------------------------------------------- the sink */

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  span_sink *sink = user;
  sink->context = context;
  sink->desc = (spanfile_writer_desc){
      .width = (uint32_t)width,
      .height = (uint32_t)height,
      .strip_row = (uint32_t)sink->strip.row,
      .strip_height = (uint32_t)sink->strip.height,
      .format = sink->coding.depth == CELSPAN_DEPTH_HALF ? SPANFILE_HALF : SPANFILE_SRGB8,
      .write = put_bytes,
      .user = sink,
      .resize = cs_mem_resize_of,
      .resize_user = context->memory};
  CS_TRY(cs_strip_check(context, sink->path, sink->strip, height));
  CS_TRY(cs_file_create(context, NULL, sink->path, &sink->file));
  return report(sink, context, spanfile_writer_create(&sink->desc, &sink->packer.writer));
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  span_sink *sink = user;
  (void)y;
  sink->context = context;
  return report(sink, context, put_spans_row(&sink->packer, spans, span_count));
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  span_sink *sink = user;
  sink->context = context;
  if (outcome == CELSPAN_OK)
    outcome = report(sink, context, spanfile_writer_finish(sink->packer.writer));
  spanfile_writer_destroy(sink->packer.writer);
  outcome = cs_file_end(sink->file, context, outcome);
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
  celspan_coding coding = cs_pixels_resolve(file->coding, CELSPAN_DEPTH_8);
  if (file->coding->depth == CELSPAN_DEPTH_8_DITHER)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: span files hold the colours of spans, which dithering would break into "
                   "pixels; dither PNG, Targa or another format of pixels",
                   path);
  if (!is_storable(&coding))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: span files hold depth 8 in sRGB with straight alpha, or depth half in "
                   "linear light, premultiplied; for others use PNG, EXR or TIFF",
                   path);
  size_t path_size = strlen(path) + 1;
  span_sink *sink;
  CS_TRY(cs_mem_make(context, (void **)&sink, 1, sizeof *sink + path_size));
  sink->allocated = sizeof *sink + path_size;
  sink->coding = coding;
  sink->strip = cs_strip_of(file);
  sink->packer.coding = &sink->coding;
  memcpy(sink->path, path, path_size);
  *out = (celspan_sink){CS_SINK_CALLS, .user = sink};
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- shares */

static celspan_status open_worker(void *user, celspan_context *context, void **out) {
  const span_sink *sink = user;
  packer *p = cs_mem_array(context->memory, 1, sizeof *p);
  *out = p;
  if (!p)
    return cs_fail_memory(context);
  p->coding = &sink->coding;
  return CELSPAN_OK;
}

static void close_worker(void *user, celspan_context *context, void *worker) {
  (void)user;
  cs_mem_free(context->memory, worker, sizeof(packer));
}

static celspan_status open_share(void *user, celspan_context *context, void **out) {
  const span_sink *sink = user;
  spanfile_writer *part = NULL;
  celspan_status status = report(sink, context, spanfile_writer_create_part(&sink->desc, &part));
  *out = part;
  return status;
}

static void close_share(void *user, celspan_context *context, void *share) {
  (void)user;
  (void)context;
  spanfile_writer_destroy(share);
}

static celspan_status begin_share(void *worker, celspan_context *context, void *share,
                                  int32_t index) {
  packer *p = worker;
  (void)context;
  p->writer = share;
  /* Cannot fail, because shares are within the picture. */
  (void)spanfile_writer_begin_part(share, (uint32_t)index * SPANFILE_PART_ROWS);
  return CELSPAN_OK;
}

static celspan_status put_share_row(void *user, void *worker, celspan_context *context, int32_t y,
                                    const celspan_span *spans, size_t span_count) {
  (void)y;
  return report(user, context, put_spans_row(worker, spans, span_count));
}

static celspan_status join_share(void *user, celspan_context *context, void *share, int32_t index) {
  span_sink *sink = user;
  (void)index;
  sink->context = context;
  return report(sink, context, spanfile_writer_join(sink->packer.writer, share));
}

bool cs_span_sink_shares(const celspan_sink *sink, cs_shares *out) {
  if (sink->row != put_row)
    return false;
  *out = (cs_shares){.user = sink->user, .rows = SPANFILE_PART_ROWS, CS_SHARES_CALLS};
  return true;
}
