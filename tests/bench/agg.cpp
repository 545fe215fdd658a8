// AGG: scanline_p8 on premultiplied BGRA.
#include <agg_conv_curve.h>
#include <agg_conv_transform.h>
#include <agg_image_accessors.h>
#include <agg_path_storage.h>
#include <agg_pixfmt_rgba.h>
#include <agg_rasterizer_scanline_aa.h>
#include <agg_renderer_base.h>
#include <agg_renderer_scanline.h>
#include <agg_scanline_p.h>
#include <agg_span_allocator.h>
#include <agg_span_gradient.h>
#include <agg_span_image_filter_rgba.h>
#include <agg_span_interpolator_linear.h>
#include <agg_span_subdiv_adaptor.h>
#include <agg_trans_perspective.h>
#include <cstring>
#include <map>
#include <vector>

#include "peer.h"

namespace {

using Format = agg::pixfmt_bgra32_pre;
using Base = agg::renderer_base<Format>;

using Rasterizer = agg::rasterizer_scanline_aa<>;
// A gradient's colours between ends that are premultiplied and rounded to 8 bits.
using Colours = agg::pod_auto_array<agg::rgba8, 256>;

agg::rgba8 colour(bench_colour c) {
  return agg::rgba8(c.red, c.green, c.blue, c.alpha).premultiply();
}

struct Frame {
  const bench_drawing *drawing;
  agg::path_storage curves; // of all shapes, at full size
  agg::path_storage paths;  // the same, flattened
  std::vector<unsigned> starts, curve_starts;
  std::map<size_t, Colours> tables; // of the shapes that have gradients
  int side;
  bool is_antialiased;
};

// Returns where the new path begins.
unsigned trace(const bench_shape &shape, double side, agg::path_storage &path) {
  const unsigned start = path.start_new_path();
  for (size_t i = 0; i < shape.segment_count; i++) {
    const bench_point *p = shape.segments[i].p;
    switch (shape.segments[i].verb) {
    case BENCH_MOVE:
      path.move_to(side * p[0].x, side * p[0].y);
      break;
    case BENCH_LINE:
      path.line_to(side * p[0].x, side * p[0].y);
      break;
    case BENCH_CUBIC:
      path.curve4(side * p[0].x, side * p[0].y, side * p[1].x, side * p[1].y, side * p[2].x,
                  side * p[2].y);
      break;
    case BENCH_CLOSE:
      path.close_polygon();
      break;
    }
  }
  return start;
}

Colours table(const bench_shape &s) {
  Colours colours;
  for (unsigned i = 0; i < colours.size(); i++)
    colours[i] = colour(s.colour).gradient(colour(s.far_colour), i / (colours.size() - 1.0));
  return colours;
}

void *begin(const bench_drawing *drawing, int side, bool is_antialiased) {
  auto *frame = new Frame{drawing, {}, {}, {}, {}, {}, side, is_antialiased};
  for (size_t i = 0; i < drawing->shape_count; i++) {
    frame->curve_starts.push_back(trace(drawing->shapes[i], side, frame->curves));
    agg::conv_curve<agg::path_storage> curve(frame->curves);
    frame->starts.push_back(frame->paths.start_new_path());
    frame->paths.concat_path(curve, frame->curve_starts.back());
    if (drawing->shapes[i].is_gradient)
      frame->tables[i] = table(drawing->shapes[i]);
  }
  return frame;
}

// Columns count in 16ths of a pixel. `left` and `size`: where the unit square lies.
void fill_gradient(const bench_shape &s, const Colours &colours, double left, double size,
                   Rasterizer &rasterizer, agg::scanline_p8 &scanline, Base &base) {
  using Interpolator = agg::span_interpolator_linear<>;
  using Span = agg::span_gradient<agg::rgba8, Interpolator, agg::gradient_x, const Colours>;
  agg::trans_affine as_it_is;
  Interpolator interpolator(as_it_is);
  agg::gradient_x along;
  Span span(interpolator, along, colours, left + size * s.x0, left + size * s.x1);
  agg::span_allocator<agg::rgba8> spans;
  agg::render_scanlines_aa(rasterizer, scanline, base, spans, span);
}

// Fills the shapes that meet a picture of this height, whose unit square lies at these places. Path
// is a source of vertices with a path at each of `starts`.
template <class Path>
void draw(const Frame &frame, Base &base, Path &path, const std::vector<unsigned> &starts,
          double left, double top, double size) {
  Rasterizer rasterizer;
  agg::scanline_p8 scanline;
  const int rows = int(base.height());
  rasterizer.clip_box(0, 0, base.width(), rows);
  if (!frame.is_antialiased)
    rasterizer.gamma(agg::gamma_threshold(0.5));
  for (size_t i = 0; i < starts.size(); i++) {
    const bench_shape &s = frame.drawing->shapes[i];
    if (!bench_shape_meets(&s, size, -top, rows))
      continue;
    rasterizer.reset();
    rasterizer.filling_rule(s.is_evenodd ? agg::fill_even_odd : agg::fill_non_zero);
    rasterizer.add_path(path, starts[i]);
    if (s.is_gradient)
      fill_gradient(s, frame.tables.at(i), left, size, rasterizer, scanline, base);
    else
      agg::render_scanlines_aa_solid(rasterizer, scanline, base, colour(s.colour));
  }
}

void band(void *user, uint8_t *pixels, int width, int rows, int first_row) {
  auto *frame = static_cast<Frame *>(user);
  agg::rendering_buffer buffer(pixels, width, rows, 4 * width);
  Format format(buffer);
  Base base(format);
  base.clear(agg::rgba8(255, 255, 255, 255));
  agg::trans_affine down = agg::trans_affine_translation(0, -first_row);
  agg::conv_transform<agg::path_storage> placed(frame->paths, down);
  draw(*frame, base, placed, frame->starts, 0, -first_row, frame->side);
}

// Curves are placed and then flattened, as each zoom needs it.
void place(void *user, uint8_t *pixels, int side, bench_place place) {
  auto *frame = static_cast<Frame *>(user);
  agg::rendering_buffer buffer(pixels, side, side, 4 * side);
  Format format(buffer);
  Base base(format);
  agg::trans_affine matrix = agg::trans_affine_scaling(place.scale) *
                             agg::trans_affine_translation(place.x * side, place.y * side);
  agg::conv_transform<agg::path_storage> placed(frame->curves, matrix);
  agg::conv_curve<agg::conv_transform<agg::path_storage>> flattened(placed);
  draw(*frame, base, flattened, frame->curve_starts, place.x * side, place.y * side,
       place.scale * side);
}

void end(void *user) { delete static_cast<Frame *>(user); }

// Fills the overlay's quadrilateral with the colours that `interpolator` finds in it.
template <class Interpolator, class Filter>
void fill(const bench_job *job, Base &base, Interpolator &interpolator) {
  agg::rendering_buffer buffer(job->overlay, BENCH_OVERLAY_WIDTH, BENCH_OVERLAY_HEIGHT,
                               4 * BENCH_OVERLAY_WIDTH);
  Format overlay(buffer);
  agg::image_accessor_clip<Format> source(overlay, agg::rgba8(0, 0, 0, 0));
  Filter filter(source, interpolator);
  Rasterizer rasterizer;
  agg::scanline_p8 scanline;
  agg::span_allocator<agg::rgba8> spans;
  rasterizer.clip_box(0, 0, BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT);
  rasterizer.move_to_d(job->corners[0][0], job->corners[0][1]);
  for (int i = 1; i < 4; i++)
    rasterizer.line_to_d(job->corners[i][0], job->corners[i][1]);
  agg::render_scanlines_aa(rasterizer, scanline, base, spans, filter);
}

void fill_affine(const bench_job *job, Base &base) {
  using Interpolator = agg::span_interpolator_linear<>;
  using Source = agg::image_accessor_clip<Format>;
  const double *m = job->inverse;
  agg::trans_affine back(m[0], m[3], m[1], m[4], m[2], m[5]);
  Interpolator interpolator(back);
  fill<Interpolator, agg::span_image_filter_rgba_bilinear<Source, Interpolator>>(job, base,
                                                                                 interpolator);
}

void fill_perspective(const bench_job *job, Base &base) {
  using Linear = agg::span_interpolator_linear<agg::trans_perspective>;
  using Interpolator = agg::span_subdiv_adaptor<Linear>;
  using Source = agg::image_accessor_clip<Format>;
  const double *m = job->inverse;
  agg::trans_perspective back(m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]);
  Linear linear(back);
  Interpolator interpolator(linear);
  fill<Interpolator, agg::span_image_filter_rgba_bilinear<Source, Interpolator>>(job, base,
                                                                                 interpolator);
}

void picture(const bench_job *job, uint8_t *pixels) {
  std::memcpy(pixels, job->ground, size_t(4) * BENCH_FRAME_WIDTH * BENCH_FRAME_HEIGHT);
  agg::rendering_buffer buffer(pixels, BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT,
                               4 * BENCH_FRAME_WIDTH);
  Format format(buffer);
  Base base(format);
  if (job->kind == BENCH_PERSPECTIVE)
    fill_perspective(job, base);
  else
    fill_affine(job, base);
}

} // namespace

extern "C" const bench_peer bench_peer_here = {true, begin, band, place, end, picture, true};
