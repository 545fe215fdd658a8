#include "program/outputs/outlets.h"

#include "program/outputs/raw_frame.h"
#include "program/outputs/target.h"
#include "program/outputs/video_target.h"
#include "program/outputs/writers.h"

static cs_exit report(const cs_into *into, celspan_status status) {
  return cs_report_failure(into->script->context, status, NULL);
}

/* ---------------------------------------------------------------- standard output */

static celspan_coding raw_coding(const cs_into *into, const celspan_frame_desc *frame) {
  celspan_coding coding = cs_target_coding(into->request);
  coding.space = frame->space;
  return coding;
}

static void close_raw(cs_into *into) { cs_slots_close(&into->raw, into->script->context); }

/* Frames are made in slots, if there are several and workers can make them beside each other. */
static cs_exit open_raw(cs_into *into) {
  celspan_context *context = into->script->context;
  const celspan_coding coding = raw_coding(into, into->frame);
  if (into->frames->count < 2 || into->keeps_nothing)
    return CS_EXIT_OK;
  celspan_status status = cs_raw_frame_slots(context, into->frame, &coding, &into->raw);
  if (status != CELSPAN_OK)
    close_raw(into);
  return report(into, status);
}

static celspan_status put_raw(cs_into *into, const cs_shoot_put *one) {
  const celspan_coding coding = raw_coding(into, one->desc);
  return into->raw.count
             ? cs_raw_frame_make(one->context, one->desc, &coding, &into->raw, one->slot)
             : cs_raw_frame_print(one->context, one->desc, &coding);
}

static size_t raw_slots(const cs_into *into) { return into->raw.count; }

static celspan_status give_raw(cs_into *into, size_t slot) {
  return cs_raw_frame_give(into->script->context, &into->raw, slot);
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
  return cs_video_target_open(&into->video, into->script, into->request, into->frame, into->played);
}

static celspan_status put_video(cs_into *into, const cs_shoot_put *one) {
  return cs_video_put(&into->video, one->context, one->desc, one->slot, one->frame->digest);
}

static size_t video_slots(const cs_into *into) { return into->video.slots.count; }

static celspan_status give_video(cs_into *into, size_t slot) {
  return cs_video_give(&into->video, slot);
}

static celspan_status repeat_video(cs_into *into) { return cs_video_repeat(&into->video); }

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

static celspan_status put_plane(cs_into *into, const cs_shoot_put *one) {
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

static celspan_status put_page(cs_into *into, const cs_shoot_put *one) {
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
