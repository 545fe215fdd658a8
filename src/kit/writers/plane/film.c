/* Frames as plane files, one each or all of a film in one. */
#include <math.h>

#include "celspan/plane.h"
#include "inside/sinks.h"
#include "writers/plane/plane.h"
#include "writers/plane/plane_data.h"
#include "writers/record/record.h"

struct cs_plane_film {
  celspan_context *context;
  cs_file *file;
  planefile_writer *writer;
  celspan_plane_desc desc;
  planefile_grid grid;
  bool has_last;
  cs_hash last;          /* the hash of the scene of the latest frame */
  celspan_status status; /* the result of writing bytes */
};

/* ---------------------------------------------------------------- life */

static bool write_bytes(void *user, const void *bytes, size_t size) {
  cs_plane_film *film = user;
  film->status = cs_file_write(film->file, film->context, bytes, size);
  return film->status == CELSPAN_OK;
}

/* The failure of a call of the writer. */
static celspan_status report(const cs_plane_film *film, planefile_status status) {
  return status == PLANEFILE_WRITE_FAILED ? film->status : cs_plane_report(film->context, status);
}

/* The columns or rows of the grid: those of the film, each cut into enough of them for `least`, so
 * that what lies at the edges of pixels stays there. */
static uint16_t count_of(double side, double least) {
  double whole = fmax(ceil(side), 1), parts = ceil(least / whole);
  return (uint16_t)fmin(whole * parts, UINT16_MAX);
}

static celspan_status open_writer(cs_plane_film *film, double frames_second) {
  const planefile_writer_desc desc = {.width = film->desc.width,
                                      .height = film->desc.height,
                                      .write = write_bytes,
                                      .user = film,
                                      .resize = cs_mem_resize_of,
                                      .resize_user = film->context->memory,
                                      .frames_second = frames_second,
                                      .is_coded = film->desc.depth == 8,
                                      .grid = film->grid};
  return report(film, planefile_writer_create(&desc, &film->writer));
}

celspan_status cs_plane_film_create(celspan_context *context, const char *path,
                                    const cs_plane_film_desc *desc, cs_plane_film **out) {
  cs_plane_film *film;
  *out = NULL;
  CS_TRY(CS_MAKE(context, film, 1));
  film->context = context;
  film->desc = CELSPAN_PLANE_DESC;
  film->desc.width = desc->width;
  film->desc.height = desc->height;
  film->desc.depth = desc->depth;
  if (desc->depth == 8 && desc->frames_second > 0)
    film->grid = (planefile_grid){count_of(desc->width, 1280), count_of(desc->height, 720)};
  celspan_status status = cs_file_create(context, NULL, path, &film->file);
  if (status == CELSPAN_OK)
    status = open_writer(film, desc->frames_second);
  return CS_GIVE(status, film, cs_plane_film_discard, out);
}

/* Frees all except the file, which has been committed or discarded. */
static void finish(cs_plane_film *film) {
  planefile_writer_destroy(film->writer);
  cs_mem_free(film->context->memory, film, sizeof *film);
}

void cs_plane_film_discard(cs_plane_film *film) {
  if (!film)
    return;
  if (film->file)
    cs_file_discard(film->file, film->context);
  finish(film);
}

celspan_status cs_plane_film_commit(cs_plane_film *film) {
  celspan_status status = report(film, planefile_writer_end(film->writer));
  if (status != CELSPAN_OK) {
    cs_plane_film_discard(film);
    return status;
  }
  status = cs_file_commit(film->file, film->context);
  finish(film);
  return status;
}

/* ---------------------------------------------------------------- frames */

static celspan_status put_scene(cs_plane_film *film, const celspan_frame_desc *frame) {
  cs_plane_frame made;
  film->desc.space = frame->space;
  celspan_status status = cs_plane_record(film->context, frame->exposures, frame->exposure_count,
                                          &film->desc, film->grid, &made);
  if (status == CELSPAN_OK) {
    planefile_band band = cs_record_plane(&made.record);
    planefile_status written = planefile_writer_frame(film->writer, &band);
    status = written == PLANEFILE_WRITE_FAILED
                 ? film->status
                 : cs_plane_report_record(film->context, written, &made.record);
  }
  cs_plane_frame_finish(&made, film->context->memory);
  return status;
}

celspan_status cs_plane_film_put(cs_plane_film *film, const celspan_frame_desc *frame,
                                 const cs_hash *scene) {
  if (scene && film->has_last && scene->a == film->last.a && scene->b == film->last.b)
    return report(film, planefile_writer_repeat(film->writer));
  film->has_last = scene != NULL;
  if (scene)
    film->last = *scene;
  return put_scene(film, frame);
}

celspan_status cs_plane_write_frame(celspan_context *context, const celspan_frame_desc *frame,
                                    const char *path, int32_t depth) {
  const cs_plane_film_desc desc = {
      .depth = depth,
      .width = frame->film_width > 0 ? frame->film_width : frame->width,
      .height = frame->film_height > 0 ? frame->film_height : frame->height};
  cs_plane_film *film;
  CS_TRY(cs_plane_film_create(context, path, &desc, &film));
  celspan_status status = cs_plane_film_put(film, frame, NULL);
  if (status == CELSPAN_OK)
    return cs_plane_film_commit(film);
  cs_plane_film_discard(film);
  return status;
}
