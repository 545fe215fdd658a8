/* The public entries: a frame into a sink, into pixels, into a file, into a digest, or row by
 * row. */
#include "base/description.h"
#include "frames/render/drawings.h"
#include "frames/render/held.h"
#include "frames/render/row_worker.h"
#include "model/scene/check.h"
#include "model/scene/inspect.h"
#include "output/sinks/coder.h"
#include "output/sinks/pixels.h"
#include "output/sinks/sink.h"

/* ---------------------------------------------------------------- into a sink */

/* Measures the peak of the memory from the beginning of the frame; afterwards the context's own
 * peak is restored. */
typedef struct meter {
  size_t bytes, peak;
  uint64_t allocations;
} meter;

static meter meter_begin(celspan_context *context) {
  meter m;
  celspan_context_memory(context, &m.bytes, &m.peak, &m.allocations);
  atomic_store(&context->memory->peak, m.bytes);
  return m;
}

static void meter_end(celspan_context *context, const meter *m, celspan_statistics *statistics) {
  size_t bytes, peak;
  uint64_t allocations;
  celspan_context_memory(context, &bytes, &peak, &allocations);
  statistics->peak_bytes = peak - m->bytes;
  statistics->allocations = allocations - m->allocations;
  if (peak < m->peak)
    atomic_store(&context->memory->peak, m->peak);
}

/* *ended: the sink's end was called, so it has freed itself. */
static celspan_status feed_sink(celspan_context *context, const cs_frame *frame,
                                const celspan_frame_desc *desc, const celspan_sink *sink,
                                celspan_statistics *statistics, bool *ended) {
  if (sink->begin)
    CS_TRY(sink->begin(sink->user, context, frame->crop_width, frame->crop_height));
  celspan_status status = cs_strips_render(context, frame, desc, sink, statistics);
  if (!sink->end)
    return status;
  char error[sizeof context->error];
  memcpy(error, context->error, sizeof error);
  *ended = true;
  celspan_status last = sink->end(sink->user, context, status);
  if (status == CELSPAN_OK)
    return last;
  memcpy(context->error, error, sizeof error); /* the first failure is reported */
  return status;
}

static void count_cels(const cs_frame *frame, celspan_statistics *statistics) {
  for (size_t i = 0; i < frame->count; i++) {
    const cs_map_frame *sheets = &frame->maps[i];
    statistics->maps_made += sheets->made;
    for (size_t k = 0; k < sheets->count; k++)
      *(sheets->sheets[k].plan ? &statistics->swept : &statistics->maps) +=
          sheets->sheets[k].source_count;
    if (!cs_drawings_are_used(sheets))
      statistics->swept += frame->rostrums[i]->cel_count;
  }
}

static celspan_status render(celspan_context *context, const celspan_frame_desc *desc,
                             const celspan_sink *sink, celspan_statistics *statistics,
                             bool *ended) {
  celspan_statistics counted = {0};
  meter m = {0};
  if (statistics) /* before any work: checks that it has a size */
    CS_TRY(CS_RESULT(context, "statistics", celspan_statistics, &counted, statistics));
  if (statistics) /* otherwise other frames may be made at the same time and change the peak too */
    m = meter_begin(context);
  cs_account_kind before = cs_account_begin_rendering(context->memory);
  cs_frame frame;
  celspan_status status = cs_frame_create(context, desc, &frame);
  if (status == CELSPAN_OK) {
    frame.takes_codes = sink->takes_codes;
    frame.coder = cs_sink_coder(sink);
    count_cels(&frame, &counted);
    status = cs_held_begin(context, desc, &frame);
    counted.rows_held = cs_held_rows(&frame);
    if (status == CELSPAN_OK)
      status = feed_sink(context, &frame, desc, sink, &counted, ended);
    cs_held_end(context, &frame, status == CELSPAN_OK);
    cs_frame_free(&frame, context->memory);
  }
  cs_account_end_rendering(context->memory, before);
  if (status == CELSPAN_INPUT)
    status = cs_blame_picture(context, desc->exposures, desc->exposure_count, status);
  if (!statistics)
    return status;
  meter_end(context, &m, &counted);
  celspan_status written =
      CS_RESULT(context, "statistics", celspan_statistics, &counted, statistics);
  return status == CELSPAN_OK ? written : status;
}

celspan_status celspan_frame_render(celspan_context *context, const celspan_frame_desc *desc,
                                    const celspan_sink *sink, celspan_statistics *statistics) {
  CS_READ(context, "frame", celspan_frame_desc, desc);
  bool ended = false;
  CS_READ(context, "frame: sink", celspan_sink, sink);
  return render(context, desc, sink, statistics, &ended);
}

/* ---------------------------------------------------------------- our own sinks */

celspan_status cs_frame_render_own(celspan_context *context, const celspan_frame_desc *desc,
                                   celspan_sink *sink, celspan_statistics *statistics) {
  bool ended = false;
  celspan_status status = render(context, desc, sink, statistics, &ended);
  if (!ended)
    cs_sink_discard(context, sink);
  return status;
}

void celspan_spans_code(const celspan_coding *coding, const celspan_span *spans, size_t span_count,
                        void *pixels) {
  celspan_spans_code_at(coding, 0, 0, spans, span_count, pixels);
}

void celspan_spans_code_at(const celspan_coding *coding, int32_t x, int32_t y,
                           const celspan_span *spans, size_t span_count, void *pixels) {
  celspan_coding whole;
  if (cs_pixels_read(NULL, &coding, &whole) != CELSPAN_OK)
    return;
  const cs_coder coder = cs_coder_of(coding, x, 0);
  cs_coder_row(&coder, y, spans, span_count, pixels);
}

/* Checks a frame and reads a coding into *whole, which *coding points to then. *resolved: without
 * defaults, in the space of the frame. */
static celspan_status read_coding(celspan_context *context, const celspan_frame_desc *desc,
                                  const celspan_coding **coding, celspan_coding *whole,
                                  celspan_coding *resolved) {
  CS_TRY(cs_frame_check(context, desc));
  CS_TRY(cs_pixels_read(context, coding, whole));
  *resolved = cs_pixels_resolve(*coding, CELSPAN_DEPTH_8);
  resolved->space = desc->space;
  return CELSPAN_OK;
}

celspan_status celspan_frame_pixels(celspan_context *context, const celspan_frame_desc *desc,
                                    const celspan_coding *coding, void *pixels, size_t stride,
                                    celspan_statistics *statistics) {
  CS_READ(context, "frame", celspan_frame_desc, desc);
  celspan_sink sink;
  celspan_coding whole, resolved;
  CS_TRY(read_coding(context, desc, &coding, &whole, &resolved));
  CS_TRY(cs_sink_memory(context, &resolved, pixels, stride, &sink));
  CS_TRY(cs_coder_dither(context, coding, &resolved, desc->crop_x, desc->crop_y, &sink));
  return cs_frame_render_own(context, desc, &sink, statistics);
}

static bool is_backed(const celspan_rostrum *rostrum) {
  if (rostrum->back.flat.a == 1)
    return true;
  for (size_t i = 0; i < rostrum->cel_count; i++)
    if (rostrum->cels[i]->back.flat.a == 1)
      return true;
  return false;
}

/* A crop that reaches beyond the frame is clear there. The alphas of exposures add up. The weights
 * of a shutter of many exposures sum to 1, except for rounding. */
static bool is_opaque(const celspan_frame_desc *desc) {
  double alpha = 0;
  if (desc->crop_x < 0 || desc->crop_y < 0 ||
      (int64_t)desc->crop_x + desc->crop_width > desc->width ||
      (int64_t)desc->crop_y + desc->crop_height > desc->height)
    return false;
  size_t count = desc->exposures ? desc->exposure_count : 0;
  for (size_t i = 0; i < count && count <= CS_CHECK_ITEMS; i++)
    if (desc->exposures[i].rostrum && is_backed(desc->exposures[i].rostrum))
      alpha += desc->exposures[i].weight;
  return alpha > 1 - 1e-9;
}

bool celspan_frame_is_opaque(const celspan_frame_desc *desc) {
  celspan_frame_desc whole;
  return cs_description_read(NULL, "frame", &cs_celspan_frame_desc_description, desc, &whole) ==
             CELSPAN_OK &&
         is_opaque(&whole);
}

celspan_status celspan_frame_write(celspan_context *context, const celspan_frame_desc *desc,
                                   const char *path, const celspan_file_desc *file,
                                   celspan_statistics *statistics) {
  CS_READ(context, "frame", celspan_frame_desc, desc);
  celspan_sink sink;
  CS_TRY(cs_frame_check(context, desc));
  celspan_file_desc known = CELSPAN_FILE_DESC;
  if (file)
    CS_TRY(cs_description_read(context, "file", &cs_celspan_file_desc_description, file, &known));
  const celspan_coding *asked = known.coding;
  celspan_coding coding;
  CS_TRY(cs_pixels_read(context, &asked, &coding));
  known.coding = &coding;
  known.is_opaque = known.is_opaque || is_opaque(desc);
  known.workers = known.workers ? known.workers : desc->workers;
  coding.space = desc->space;
  known.place_x += desc->crop_x;
  known.place_y += desc->crop_y;
  CS_TRY(cs_sink_file(context, path, &known, &sink));
  return cs_frame_render_own(context, desc, &sink, statistics);
}

celspan_status celspan_frame_digest(celspan_context *context, const celspan_frame_desc *desc,
                                    const celspan_coding *coding, uint64_t digest[2]) {
  CS_READ(context, "frame", celspan_frame_desc, desc);
  celspan_sink sink;
  celspan_coding whole, resolved;
  CS_TRY(read_coding(context, desc, &coding, &whole, &resolved));
  CS_TRY(cs_check_given(context, "frame", "the digest", digest));
  CS_TRY(cs_sink_digest(context, &resolved, digest, &sink));
  CS_TRY(cs_coder_dither(context, coding, &resolved, desc->crop_x, desc->crop_y, &sink));
  return cs_frame_render_own(context, desc, &sink, NULL);
}

/* ---------------------------------------------------------------- the short way */

/* A frame of one rostrum with all defaults. */
static celspan_status describe(celspan_context *context, const celspan_exposure *exposure,
                               int32_t width, int32_t height, celspan_frame_desc *out) {
  CS_TRY(cs_check_given(context, "frame", "the rostrum", exposure->rostrum));
  *out = CELSPAN_FRAME_DESC;
  out->exposures = exposure;
  out->exposure_count = 1;
  out->width = width;
  out->height = height;
  if (exposure->rostrum->has_size) {
    out->film_width = exposure->rostrum->width;
    out->film_height = exposure->rostrum->height;
  }
  return CELSPAN_OK;
}

celspan_status celspan_rostrum_write(celspan_context *context, celspan_rostrum *rostrum,
                                     int32_t width, int32_t height, const char *path) {
  const celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc frame;
  CS_TRY(describe(context, &exposure, width, height, &frame));
  return celspan_frame_write(context, &frame, path, NULL, NULL);
}

celspan_status celspan_rostrum_pixels(celspan_context *context, celspan_rostrum *rostrum,
                                      int32_t width, int32_t height, unsigned char *pixels) {
  const celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc frame;
  CS_TRY(describe(context, &exposure, width, height, &frame));
  CS_TRY(cs_check_given(context, "frame", "the pixels", pixels));
  return celspan_frame_pixels(context, &frame, NULL, pixels, 4 * (size_t)width, NULL);
}

/* ---------------------------------------------------------------- row by row */

struct celspan_rows {
  celspan_context *context;
  cs_memory *memory;
  cs_frame frame;
  cs_row_worker row_worker;
};

celspan_status celspan_rows_create(celspan_context *context, const celspan_frame_desc *desc,
                                   celspan_rows **out) {
  CS_READ(context, "frame", celspan_frame_desc, desc);
  celspan_rows *rows;
  CS_TRY(CS_MAKE(context, rows, 1));
  rows->context = context;
  rows->memory = cs_memory_ref(context->memory);
  celspan_status status = cs_frame_create(context, desc, &rows->frame);
  if (status == CELSPAN_OK) {
    status = cs_row_worker_init(&rows->row_worker, context, &rows->frame);
    if (status != CELSPAN_OK)
      (void)cs_fail(context, status, "%s", rows->row_worker.context.error);
  }
  return CS_GIVE(status, rows, celspan_rows_destroy, out);
}

int cs_rows_workers(const celspan_rows *rows) { return rows->frame.workers; }

celspan_status celspan_rows_get(celspan_rows *rows, int32_t y, const celspan_span **spans,
                                size_t *span_count) {
  const cs_row *row;
  if (y < 0 || y >= rows->frame.crop_height)
    return cs_fail(rows->context, CELSPAN_BAD_ARGUMENT, "rows: row %d is not in 0..%d", (int)y,
                   (int)rows->frame.crop_height - 1);
  celspan_status status = cs_row_worker_row(&rows->row_worker, y, &row);
  if (status != CELSPAN_OK)
    return cs_fail(rows->context, status, "%s", rows->row_worker.context.error);
  *spans = row->spans;
  *span_count = row->count;
  return CELSPAN_OK;
}

void celspan_rows_destroy(celspan_rows *rows) {
  if (!rows)
    return;
  cs_memory *memory = rows->memory;
  cs_row_worker_finish(&rows->row_worker);
  cs_frame_free(&rows->frame, memory);
  cs_mem_free(memory, rows, sizeof *rows);
  cs_memory_unref(memory);
}
