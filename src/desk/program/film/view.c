#include "program/film/view.h"

#include "inside/sinks.h"
#include "process/interrupt.h"
#include "program/film/output.h"

/* Film units to pixels, rounded, at least 1; -1 if the result is greater than a frame may be. */
static int32_t pixels(double units, double scale) {
  double side = units * scale + 0.5;
  if (!(side < CS_SIDE_MAX + 1.0))
    return -1;
  return side < 1 ? 1 : (int32_t)side;
}

/* Half of a side, rounded to an even number, because videos need this. */
static int32_t draft_side(int32_t side) {
  int32_t half = side / 2 + side % 2;
  return half + half % 2;
}

/* In a drawing, --scale applies to pictures in it. */
static bool is_drawing(const cs_request *request) {
  return request->output && cs_output_lists(request->output->takes, "--flat");
}

static cs_exit set_size(const cs_request *request, celspan_frame_desc *out) {
  int32_t size[2];
  double scale = 1;
  bool has_size = cs_request_read(request, "--size", size);
  if (!is_drawing(request) && cs_request_read(request, "--scale", &scale) && has_size)
    return cs_report_usage("--size and --scale say the same thing twice: give one of them");
  out->width = has_size ? size[0] : pixels(out->film_width, scale);
  out->height = has_size ? size[1] : pixels(out->film_height, scale);
  if (cs_request_has(request, "--draft") && out->width > 0 && out->height > 0) {
    out->width = draft_side(out->width);
    out->height = draft_side(out->height);
  }
  if (out->width > 0 && out->height > 0)
    return CS_EXIT_OK;
  cs_report_error("a frame of %g x %g at scale %g is more than %d pixels a side: give a smaller "
                  "--scale, or --size",
                  out->film_width, out->film_height, scale, CS_SIDE_MAX);
  return CS_EXIT_LIMIT;
}

/* The width in pixels of a film that has this height in pixels and its own shape. */
static int32_t fitting(double film_side, double film_other, int32_t other) {
  return pixels(film_side, other / film_other);
}

/* Makes a film of another shape than the output fit into it, or cover it: the frame gets the film's
 * shape, and the output is a crop of the frame, or reaches beyond it. */
static cs_exit set_fit(const cs_request *request, celspan_frame_desc *out) {
  cs_fit fit = CS_FIT_STRETCH;
  int32_t width = out->width, height = out->height;
  if (!cs_request_read(request, "--fit", &fit))
    return CS_EXIT_OK;
  if (!cs_request_has(request, "--size"))
    return cs_report_usage("--fit is for a --size of another shape than the film's: give --size");
  if (fit == CS_FIT_STRETCH)
    return CS_EXIT_OK;
  bool is_wider = (double)width * out->film_height > (double)height * out->film_width;
  if (is_wider == (fit == CS_FIT_CONTAIN))
    out->width = fitting(out->film_width, out->film_height, height);
  else
    out->height = fitting(out->film_height, out->film_width, width);
  if (out->width < 0 || out->height < 0)
    return cs_report_usage("--fit cover: the film would have more than %d pixels a side: give a "
                           "smaller --size",
                           CS_SIDE_MAX);
  if (out->width == width && out->height == height)
    return CS_EXIT_OK;
  out->crop_x = (out->width - width) / 2;
  out->crop_y = (out->height - height) / 2;
  out->crop_width = width;
  out->crop_height = height;
  return CS_EXIT_OK;
}

static cs_exit set_crop(const int32_t crop[4], celspan_frame_desc *out) {
  if ((int64_t)crop[0] + crop[2] > out->width || (int64_t)crop[1] + crop[3] > out->height)
    return cs_report_usage("--crop %d,%d,%d,%d is not within the frame of %d x %d pixels", crop[0],
                           crop[1], crop[2], crop[3], out->width, out->height);
  out->crop_x = crop[0];
  out->crop_y = crop[1];
  out->crop_width = crop[2];
  out->crop_height = crop[3];
  return CS_EXIT_OK;
}

/* Strips have heights as equal as their grid of CS_STRIP_ROWS rows allows. */
static cs_exit set_strip(const int32_t strip[2], celspan_frame_desc *out) {
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

static cs_exit set_part(const cs_request *request, celspan_frame_desc *out) {
  int32_t crop[4], strip[2];
  bool has_crop = cs_request_read(request, "--crop", crop);
  bool has_strip = cs_request_strip(request, strip);
  if (has_strip && has_crop)
    return cs_report_usage("--strip and --crop both say which part to make: give one of them");
  if (out->crop_width > 0 && (has_strip || has_crop))
    return cs_report_usage("--fit makes whole frames: leave %s out",
                           has_crop ? "--crop" : "--strip");
  return has_crop ? set_crop(crop, out) : has_strip ? set_strip(strip, out) : CS_EXIT_OK;
}

static void set_antialias(const cs_request *request, celspan_frame_desc *out) {
  bool is_given = cs_request_has(request, "--antialias");
  out->has_antialias = is_given || cs_request_has(request, "--draft");
  out->antialias = is_given ? request->antialias.mode : CELSPAN_ANTIALIAS_NONE;
  out->filter = &request->antialias.filter;
}

cs_exit cs_view_frame(const cs_request *request, double film_width, double film_height,
                      celspan_frame_desc *out) {
  *out = CELSPAN_FRAME_DESC;
  out->film_width = film_width;
  out->film_height = film_height;
  out->progress = cs_interrupt_progress;
  cs_request_read(request, "--workers", &out->workers);
  set_antialias(request, out);
  CS_TRY_EXIT(set_size(request, out));
  CS_TRY_EXIT(set_fit(request, out));
  return set_part(request, out);
}
