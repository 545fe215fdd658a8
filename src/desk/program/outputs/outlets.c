#include "program/outputs/outlets.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "inside/context.h"
#include "inside/frames.h"
#include "inside/sinks.h"
#include "program/outputs/target.h"
#include "program/outputs/video_target.h"
#include "program/outputs/writers.h"

static cs_exit report(const cs_into *into, celspan_status status) {
  return cs_report_failure(into->script->context, status, NULL);
}

/* ---------------------------------------------------------------- standard output */

/* Bytes that are written together: a system call for each row takes long. */
#define RAW_TOGETHER ((size_t)128 << 10)

/* A sink that writes coded rows of a frame to standard output, without a header. */
typedef struct raw_rows {
  const celspan_sink *coder; /* codes into `rows`, so that nothing is copied */
  size_t pixel_size;
  unsigned char *rows; /* rows that are not written yet */
  size_t row_size, count, capacity;
} raw_rows;

static celspan_status begin_raw(void *user, celspan_context *context, int32_t width,
                                int32_t height) {
  raw_rows *raw = user;
  (void)height;
  raw->row_size = (size_t)width * raw->pixel_size;
  raw->capacity = raw->row_size < RAW_TOGETHER ? RAW_TOGETHER / raw->row_size : 1;
  raw->rows = cs_mem_resize(context->memory, NULL, 0, raw->capacity * raw->row_size);
  cs_coder_aim(raw->coder, raw->rows);
  return raw->rows ? CELSPAN_OK : cs_fail_memory(context);
}

static celspan_status fail_output(celspan_context *context) {
  return celspan_context_fail(context, CELSPAN_OUTPUT, "standard output: %s", strerror(errno));
}

static celspan_status write_raw(raw_rows *raw, celspan_context *context) {
  size_t size = raw->count * raw->row_size;
  raw->count = 0;
  return fwrite(raw->rows, 1, size, stdout) == size ? CELSPAN_OK : fail_output(context);
}

/* The end of a frame. */
static celspan_status flush(celspan_context *context) {
  return fflush(stdout) == 0 ? CELSPAN_OK : fail_output(context);
}

static celspan_status put_raw_row(void *user, celspan_context *context, int32_t y,
                                  const celspan_span *spans, size_t span_count) {
  raw_rows *raw = user;
  unsigned char *row = raw->rows + raw->count++ * raw->row_size;
  (void)y, (void)span_count;
  if (spans->codes != row) /* coded before */
    memcpy(row, spans->codes, raw->row_size);
  if (raw->count == raw->capacity)
    CS_TRY(write_raw(raw, context));
  cs_coder_aim(raw->coder, raw->rows + raw->count * raw->row_size);
  return CELSPAN_OK;
}

static celspan_status end_raw(void *user, celspan_context *context, celspan_status outcome) {
  raw_rows *raw = user;
  if (outcome == CELSPAN_OK)
    outcome = write_raw(raw, context);
  cs_mem_free(context->memory, raw->rows, raw->capacity * raw->row_size);
  raw->rows = NULL;
  return outcome == CELSPAN_OK ? flush(context) : outcome;
}

/* Makes a frame, and writes its rows while they are made. */
static celspan_status print_frame(celspan_context *context, const celspan_frame_desc *frame,
                                  const celspan_coding *coding) {
  const cs_coder coder = cs_coder_of(coding, frame->crop_x, frame->crop_y);
  celspan_sink sink;
  raw_rows raw = {.coder = &sink, .pixel_size = celspan_coding_pixel_size(&coder.coding)};
  sink = (celspan_sink){sizeof sink, &raw, begin_raw, put_raw_row, end_raw, false};
  CS_TRY(cs_coder_sink(context, &coder, &sink));
  return cs_frame_render_own(context, frame, &sink, NULL);
}

/* Bytes of a row. */
static size_t stride_of(const celspan_frame_desc *frame, const celspan_coding *coding) {
  const celspan_coding resolved = cs_pixels_resolve(coding, CELSPAN_DEPTH_8);
  int32_t width = frame->crop_width > 0 ? frame->crop_width : frame->width;
  return (size_t)width * celspan_coding_pixel_size(&resolved);
}

static celspan_coding raw_coding(const cs_into *into, const celspan_frame_desc *frame) {
  celspan_coding coding = cs_target_coding(into->request);
  coding.space = frame->space;
  return coding;
}

static void close_raw(cs_into *into) { cs_slots_close(&into->raw, into->script->context); }

/* Frames are made in slots, if there are several and workers can make them beside each other. */
static cs_exit open_raw(cs_into *into) {
  celspan_context *context = into->script->context;
  const celspan_frame_desc *frame = into->frame;
  const celspan_coding coding = raw_coding(into, frame);
  int32_t height = frame->crop_width > 0 ? frame->crop_height : frame->height;
  size_t size = stride_of(frame, &coding) * (size_t)height;
  size_t count = cs_slots_count(context, size, frame->workers);
  if (into->frames->count < 2 || into->keeps_nothing || count < 2)
    return CS_EXIT_OK;
  celspan_status status = cs_slots_open(&into->raw, context, count, size);
  if (status != CELSPAN_OK)
    close_raw(into);
  return report(into, status);
}

static celspan_status put_raw(void *user, const cs_shoot_put *one) {
  const cs_into *into = user;
  const celspan_coding coding = raw_coding(into, one->desc);
  return into->raw.count
             ? celspan_frame_pixels(one->context, one->desc, &coding, into->raw.frames[one->slot],
                                    stride_of(one->desc, &coding), NULL)
             : print_frame(one->context, one->desc, &coding);
}

static size_t raw_slots(const cs_into *into) { return into->raw.count; }

static celspan_status give_raw(void *user, size_t slot) {
  const cs_into *into = user;
  const cs_slots *slots = &into->raw;
  bool is_written = fwrite(slots->frames[slot], 1, slots->frame_size, stdout) == slots->frame_size;
  return is_written ? flush(into->script->context) : fail_output(into->script->context);
}

static celspan_status commit_raw(cs_into *into) {
  close_raw(into);
  return CELSPAN_OK;
}

const cs_outlet cs_outlet_raw = {.open = open_raw,
                                 .put = put_raw,
                                 .slots = raw_slots,
                                 .give = give_raw,
                                 .commit = commit_raw,
                                 .discard = close_raw};

/* ---------------------------------------------------------------- videos */

static cs_exit open_video(cs_into *into) {
  return cs_video_target_open(&into->video, into->script, into->request, into->frame, into->played,
                              into->chapters, into->captions);
}

static celspan_status put_video(void *user, const cs_shoot_put *one) {
  const cs_into *into = user;
  return cs_video_put(&into->video, one->context, one->desc, one->slot, one->frame->digest);
}

static size_t video_slots(const cs_into *into) { return into->video.slots.count; }

static celspan_status give_video(void *user, size_t slot) {
  cs_into *into = user;
  return cs_video_give(&into->video, slot);
}

static celspan_status repeat_video(void *user) {
  cs_into *into = user;
  return cs_video_repeat(&into->video);
}

static celspan_status commit_video(cs_into *into) { return cs_video_finish(&into->video); }

static void discard_video(cs_into *into) { cs_video_discard(&into->video); }

const cs_outlet cs_outlet_video = {.is_file = true,
                                   .open = open_video,
                                   .put = put_video,
                                   .slots = video_slots,
                                   .give = give_video,
                                   .repeat = repeat_video,
                                   .commit = commit_video,
                                   .discard = discard_video};

/* ---------------------------------------------------------------- planes */

static cs_exit open_plane(cs_into *into) {
  const cs_film_info *film = &into->script->film;
  celspan_depth depth = CELSPAN_DEPTH_DEFAULT;
  cs_request_read(into->request, "--depth", &depth);
  const cs_plane_film_desc desc = {.width = film->width,
                                   .height = film->height,
                                   .frames_second = film->frames_second,
                                   .depth = cs_plane_depth(depth)};
  return report(into, cs_plane_film_create(into->script->context, into->path, &desc, &into->plane));
}

static celspan_status put_plane(void *user, const cs_shoot_put *one) {
  const cs_into *into = user;
  return cs_plane_film_put(into->plane, one->desc,
                           one->frame->is_named ? &one->frame->scene : NULL);
}

static celspan_status commit_plane(cs_into *into) { return cs_plane_film_commit(into->plane); }

static void discard_plane(cs_into *into) { cs_plane_film_discard(into->plane); }

const cs_outlet cs_outlet_plane = {.is_file = true,
                                   .open = open_plane,
                                   .put = put_plane,
                                   .commit = commit_plane,
                                   .discard = discard_plane};

/* ---------------------------------------------------------------- pages of a PDF */

static cs_exit open_pages(cs_into *into) {
  cs_plot_desc desc = cs_write_describe(into->request, true);
  desc.title = into->script->film.title;
  return report(into, cs_plot_begin(into->script->context, into->path, &desc, &into->pages));
}

static celspan_status put_page(void *user, const cs_shoot_put *one) {
  cs_into *into = user;
  cs_plot_facts facts;
  CS_TRY(cs_plot_add_frame(into->pages, one->desc, &facts));
  if (!into->has_noted) {
    const cs_plot_desc desc = cs_write_describe(into->request, true);
    cs_write_report(into->script->context, into->path, &desc, &facts);
    into->has_noted = facts.picture_width > 0;
  }
  return CELSPAN_OK;
}

static celspan_status commit_pages(cs_into *into) { return cs_plot_end(into->pages, CELSPAN_OK); }

static void discard_pages(cs_into *into) { (void)!cs_plot_end(into->pages, CELSPAN_CANCELLED); }

const cs_outlet cs_outlet_pages = {.is_file = true,
                                   .open = open_pages,
                                   .put = put_page,
                                   .commit = commit_pages,
                                   .discard = discard_pages};
