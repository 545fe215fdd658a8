#include "cli/view.h"

#include "cli/interrupt.h"

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
  return outcome == CS_EXIT_OK ? set_crop(request->crop, out) : outcome;
}
