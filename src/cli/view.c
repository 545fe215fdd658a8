#include "cli/view.h"

#include "cli/interrupt.h"
#include "output/strip.h"

/* Film units to pixels, rounded, at least 1; -1 when that is more than a frame can have. */
static int32_t pixels(double units, double scale) {
  double side = units * scale + 0.5;
  if (!(side < CS_SIDE_MAX + 1.0))
    return -1;
  return side < 1 ? 1 : (int32_t)side;
}

static cs_exit set_size(const cs_request *request, celspan_frame_desc *out) {
  if (request->size[0] && request->scale > 0)
    return cs_report_usage("--size and --scale say the same thing twice: give one of them");
  double scale = request->scale > 0 ? request->scale : 1;
  out->width = request->size[0] ? request->size[0] : pixels(out->film_width, scale);
  out->height = request->size[1] ? request->size[1] : pixels(out->film_height, scale);
  if (out->width > 0 && out->height > 0)
    return CS_EXIT_OK;
  cs_report_error("a film of %g x %g at scale %g is more than %d pixels a side: lower --scale",
                  out->film_width, out->film_height, scale, CS_SIDE_MAX);
  return CS_EXIT_LIMIT;
}

static cs_exit set_crop(const int32_t crop[4], celspan_frame_desc *out) {
  if (!crop[2])
    return CS_EXIT_OK;
  if ((int64_t)crop[0] + crop[2] > out->width || (int64_t)crop[1] + crop[3] > out->height)
    return cs_report_usage("--crop %d,%d,%d,%d is not within the frame of %d x %d pixels", crop[0],
                           crop[1], crop[2], crop[3], out->width, out->height);
  out->crop_x = crop[0];
  out->crop_y = crop[1];
  out->crop_width = crop[2];
  out->crop_height = crop[3];
  return CS_EXIT_OK;
}

/* Strips are as even as their grid of CS_STRIP_ROWS rows allows. */
static cs_exit set_strip(const cs_request *request, celspan_frame_desc *out) {
  const int32_t *strip = request->strip;
  if (!strip[1])
    return CS_EXIT_OK;
  if (request->crop[2])
    return cs_report_usage("--strip and --crop both say which part to make: give one of them");
  int64_t bands = (out->height + CS_STRIP_ROWS - 1) / CS_STRIP_ROWS;
  if (strip[1] > bands)
    return cs_report_usage("--strip %d/%d: strips begin at every %d rows, so a frame of %d rows "
                           "makes at most %d",
                           strip[0], strip[1], CS_STRIP_ROWS, out->height, (int)bands);
  int32_t begin = (int32_t)(bands * (strip[0] - 1) / strip[1]) * CS_STRIP_ROWS;
  int32_t end = (int32_t)(bands * strip[0] / strip[1]) * CS_STRIP_ROWS;
  end = end < out->height ? end : out->height;
  return set_crop((int32_t[4]){0, begin, out->width, end - begin}, out);
}

cs_exit cs_view_frame(const cs_request *request, double film_width, double film_height,
                      celspan_frame_desc *out) {
  *out = CELSPAN_FRAME_DESC;
  out->film_width = film_width;
  out->film_height = film_height;
  out->workers = request->workers;
  out->progress = cs_interrupt_progress;
  out->antialias = request->antialias.is_given ? &request->antialias.mode : NULL;
  out->filter = request->antialias.filter;
  cs_exit outcome = set_size(request, out);
  if (outcome == CS_EXIT_OK)
    outcome = set_crop(request->crop, out);
  return outcome == CS_EXIT_OK ? set_strip(request, out) : outcome;
}
