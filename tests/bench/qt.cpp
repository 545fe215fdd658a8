// Qt: QPainter on a QImage, premultiplied ARGB32.
#include <QBrush>
#include <QImage>
#include <QLinearGradient>
#include <QPainter>
#include <QPainterPath>
#include <QTransform>
#include <cstring>
#include <vector>

#include "peer.h"

namespace {

struct Frame {
  const bench_drawing *drawing;
  std::vector<QPainterPath> paths; // at full size
  int side;
  bool is_antialiased;
};

QPainterPath trace(const bench_shape &shape, double side) {
  QPainterPath path;
  path.setFillRule(shape.is_evenodd ? Qt::OddEvenFill : Qt::WindingFill);
  for (size_t i = 0; i < shape.segment_count; i++) {
    const bench_point *p = shape.segments[i].p;
    switch (shape.segments[i].verb) {
    case BENCH_MOVE:
      path.moveTo(side * p[0].x, side * p[0].y);
      break;
    case BENCH_LINE:
      path.lineTo(side * p[0].x, side * p[0].y);
      break;
    case BENCH_CUBIC:
      path.cubicTo(side * p[0].x, side * p[0].y, side * p[1].x, side * p[1].y, side * p[2].x,
                   side * p[2].y);
      break;
    case BENCH_CLOSE:
      path.closeSubpath();
      break;
    }
  }
  return path;
}

void *begin(const bench_drawing *drawing, int side, bool is_antialiased) {
  auto *frame = new Frame{drawing, {}, side, is_antialiased};
  for (size_t i = 0; i < drawing->shape_count; i++)
    frame->paths.push_back(trace(drawing->shapes[i], side));
  return frame;
}

QColor colour(bench_colour c) { return QColor(c.red, c.green, c.blue, c.alpha); }

// Qt looks gradients up in a table of 1024 colours.
QBrush brush(const bench_shape &shape, double side) {
  if (!shape.is_gradient)
    return colour(shape.colour);
  QLinearGradient gradient(side * shape.x0, 0, side * shape.x1, 0);
  gradient.setColorAt(0, colour(shape.colour));
  gradient.setColorAt(1, colour(shape.far_colour));
  return gradient;
}

// The shapes that meet these rows of the drawing at this side.
void draw(const Frame &frame, QPainter &painter, double side, double first_row, int rows) {
  painter.setRenderHint(QPainter::Antialiasing, frame.is_antialiased);
  painter.setPen(Qt::NoPen);
  for (size_t i = 0; i < frame.paths.size(); i++) {
    const bench_shape &s = frame.drawing->shapes[i];
    if (bench_shape_meets(&s, side, first_row, rows))
      painter.fillPath(frame.paths[i], brush(s, frame.side));
  }
}

void band(void *user, uint8_t *pixels, int width, int rows, int first_row) {
  const auto *frame = static_cast<const Frame *>(user);
  QImage image(pixels, width, rows, 4 * width, QImage::Format_ARGB32_Premultiplied);
  image.fill(Qt::white);
  QPainter painter(&image);
  painter.translate(0, -first_row);
  draw(*frame, painter, frame->side, first_row, rows);
}

void place(void *user, uint8_t *pixels, int side, bench_place place) {
  QImage image(pixels, side, side, 4 * side, QImage::Format_ARGB32_Premultiplied);
  QPainter painter(&image);
  painter.translate(place.x * side, place.y * side);
  painter.scale(place.scale, place.scale);
  draw(*static_cast<const Frame *>(user), painter, place.scale * side, -place.y * side, side);
}

void end(void *user) { delete static_cast<Frame *>(user); }

void picture(const bench_job *job, uint8_t *pixels) {
  const double *m = job->matrix;
  std::memcpy(pixels, job->ground, size_t(4) * BENCH_FRAME_WIDTH * BENCH_FRAME_HEIGHT);
  QImage frame(pixels, BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT, 4 * BENCH_FRAME_WIDTH,
               QImage::Format_ARGB32_Premultiplied);
  const QImage overlay(job->overlay, BENCH_OVERLAY_WIDTH, BENCH_OVERLAY_HEIGHT,
                       4 * BENCH_OVERLAY_WIDTH, QImage::Format_ARGB32_Premultiplied);
  QPainter painter(&frame);
  painter.setRenderHint(QPainter::SmoothPixmapTransform, job->kind != BENCH_SHIFT);
  painter.setTransform(QTransform(m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]));
  painter.drawImage(0, 0, overlay);
}

} // namespace

extern "C" const bench_peer bench_peer_here = {true, begin, band, place, end, picture, true};
