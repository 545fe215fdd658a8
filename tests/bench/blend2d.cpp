// Blend2D, from version 0.20 on: one thread, premultiplied ARGB32. It is built where BLEND2D_ROOT
// names a folder with its include/ and lib/.
#include <blend2d/blend2d.h>
#include <vector>

#include "peer.h"

namespace {

struct Frame {
  const bench_drawing *drawing;
  std::vector<BLPath> paths; // at full size
  int side;
};

BLPath trace(const bench_shape &shape, double side) {
  BLPath path;
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
      path.cubic_to(side * p[0].x, side * p[0].y, side * p[1].x, side * p[1].y, side * p[2].x,
                    side * p[2].y);
      break;
    case BENCH_CLOSE:
      path.close();
      break;
    }
  }
  return path;
}

// Blend2D always antialiases.
void *begin(const bench_drawing *drawing, int side, bool) {
  auto *frame = new Frame{drawing, {}, side};
  for (size_t i = 0; i < drawing->shape_count; i++)
    frame->paths.push_back(trace(drawing->shapes[i], side));
  return frame;
}

BLRgba32 colour(bench_colour c) { return BLRgba32(c.red, c.green, c.blue, c.alpha); }

// Gradients are looked up in a table of at most 1024 premultiplied colours.
void fill(BLContext &context, const BLPath &path, const bench_shape &shape, double side) {
  context.set_fill_rule(shape.is_evenodd ? BL_FILL_RULE_EVEN_ODD : BL_FILL_RULE_NON_ZERO);
  if (!shape.is_gradient) {
    context.fill_path(path, colour(shape.colour));
    return;
  }
  BLGradient gradient(BLLinearGradientValues(side * shape.x0, 0, side * shape.x1, 0));
  gradient.add_stop(0, colour(shape.colour));
  gradient.add_stop(1, colour(shape.far_colour));
  context.fill_path(path, gradient);
}

// The shapes that meet these rows of the drawing at this side.
void draw(const Frame &frame, BLContext &context, double side, double first_row, int rows) {
  for (size_t i = 0; i < frame.paths.size(); i++) {
    const bench_shape &shape = frame.drawing->shapes[i];
    if (bench_shape_meets(&shape, side, first_row, rows))
      fill(context, frame.paths[i], shape, frame.side);
  }
  context.end();
}

void band(void *user, uint8_t *pixels, int width, int rows, int first_row) {
  const auto *frame = static_cast<const Frame *>(user);
  BLImage image;
  image.create_from_data(width, rows, BL_FORMAT_PRGB32, pixels, intptr_t(4) * width);
  BLContext context(image);
  context.fill_all(BLRgba32(0xFFFFFFFFu));
  context.translate(0, -first_row);
  draw(*frame, context, frame->side, first_row, rows);
}

void place(void *user, uint8_t *pixels, int side, bench_place place) {
  BLImage image;
  image.create_from_data(side, side, BL_FORMAT_PRGB32, pixels, intptr_t(4) * side);
  BLContext context(image);
  context.translate(place.x * side, place.y * side);
  context.scale(place.scale, place.scale);
  draw(*static_cast<const Frame *>(user), context, place.scale * side, -place.y * side, side);
}

void end(void *user) { delete static_cast<Frame *>(user); }

} // namespace

extern "C" const bench_peer bench_peer_here = {true, begin, band, place, end, nullptr, false};
