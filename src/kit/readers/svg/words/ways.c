#include "readers/svg/words/ways.h"

#include "inside/elementary.h"
#include "inside/geometry.h"

#define DEGREES (180 / 3.14159265358979323846)

celspan_status cs_svg_way_measure(celspan_context *context, cs_svg_way *way) {
  size_t count = way->outline.piece_count;
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, way->lengths, count));
  for (size_t i = 0; i < count; i++) {
    cs_bezier piece;
    cs_curve_load_line(&way->outline, i, 0, 1, &piece);
    way->lengths[i] = way->length;
    way->length += cs_curve_length(&piece, 0, 1);
  }
  return CELSPAN_OK;
}

void cs_svg_way_finish(cs_svg_way *way, cs_memory *memory) {
  cs_mem_free(memory, way->lengths, way->outline.piece_count * sizeof *way->lengths);
  cs_outline_finish(&way->outline, memory);
}

/* The last piece that begins at or before the distance. */
static size_t piece_at(const cs_svg_way *way, double distance) {
  size_t low = 0, high = way->outline.piece_count;
  while (high - low > 1) {
    size_t middle = low + (high - low) / 2;
    if (way->lengths[middle] <= distance)
      low = middle;
    else
      high = middle;
  }
  return low;
}

celspan_point cs_svg_way_at(const cs_svg_way *way, double distance, double *degrees) {
  size_t piece = piece_at(way, distance);
  size_t next = piece + 1;
  double end = next < way->outline.piece_count ? way->lengths[next] : way->length;
  double whole = end - way->lengths[piece];
  cs_bezier line;
  celspan_point point, velocity;
  cs_curve_load_line(&way->outline, piece, 0, 1, &line);
  double t = whole > 0 ? cs_curve_parameter(&line, whole, distance - way->lengths[piece]) : 0;
  cs_curve_line_at(&line, t, &point, &velocity);
  if (velocity.x == 0 && velocity.y == 0)
    velocity = cs_curve_departure(&line);
  *degrees = cs_elementary_atan2(velocity.y, velocity.x) * DEGREES;
  return point;
}
