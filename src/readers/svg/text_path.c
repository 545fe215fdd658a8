#include "readers/svg/text_path.h"

#include "base/elementary.h"
#include "base/number.h"
#include "model/stroke/curve.h"
#include "readers/svg/shapes.h"

#define DEGREES (180 / 3.14159265358979323846)

/* ---------------------------------------------------------------- the line */

/* The line in the units of the element that names it, its own transform done. */
static celspan_status read_line(cs_svg_reading *reading, const cs_svg_node *path,
                                const cs_svg_measure *measure, cs_svg_text_path *out) {
  cs_svg_style style;
  cs_svg_line line;
  CS_TRY(cs_svg_style_in_file(reading, path, &style));
  const celspan_matrix matrix = cs_svg_transform_of(&style, measure);
  celspan_status status = cs_svg_line_init(reading->context, path, measure, &line);
  if (status == CELSPAN_OK && cs_svg_outline_map(&line.outline, &matrix)) {
    out->outline = line.outline;
    cs_outline_init(&line.outline);
  }
  cs_svg_line_finish(&line, reading->context);
  return status;
}

static celspan_status measure_line(celspan_context *context, cs_svg_text_path *path) {
  size_t count = path->outline.piece_count;
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, path->lengths, count));
  for (size_t i = 0; i < count; i++) {
    cs_bezier piece;
    cs_curve_load_line(&path->outline, i, 0, 1, &piece);
    path->lengths[i] = path->length;
    path->length += cs_curve_length(&piece, 0, 1);
  }
  return CELSPAN_OK;
}

/* Per cents refer to the length of the line; numbers are in units, and the path says how many units
 * long it is. */
static celspan_status read_start(cs_svg_reading *reading, const cs_svg_node *node,
                                 const cs_svg_node *path, const cs_svg_place *place,
                                 cs_svg_text_path *out) {
  const cs_svg_length none = {0, CS_SVG_UNIT_NUMBER};
  cs_svg_measure measure = place->measure;
  double declared; /* its length */
  CS_TRY(cs_svg_number_of(reading->context, path, CS_SVG_PATH_LENGTH, CS_SVG_AXIS_BOTH, &measure,
                          &declared));
  measure.width = declared > 0 ? declared : out->length;
  CS_TRY(cs_svg_length_of(reading->context, node, CS_SVG_START_OFFSET, CS_SVG_AXIS_X, &measure,
                          none, &out->start));
  out->start *= out->length / measure.width;
  return CELSPAN_OK;
}

celspan_status cs_svg_text_path_make(cs_svg_reading *reading, const cs_svg_node *node,
                                     const cs_svg_place *place, cs_svg_text_path *out,
                                     bool *is_there) {
  const cs_svg_node *path = cs_svg_linked(reading, node);
  *out = (cs_svg_text_path){.begin = 0};
  *is_there = false;
  cs_outline_init(&out->outline);
  if (!path || !cs_svg_is_shape(path))
    return CELSPAN_OK;
  CS_TRY(read_line(reading, path, &place->measure, out));
  CS_TRY(measure_line(reading->context, out));
  *is_there = out->length > 0 && cs_number_is_sane(out->length);
  if (*is_there)
    CS_TRY(read_start(reading, node, path, place, out));
  return CELSPAN_OK;
}

void cs_svg_text_path_finish(cs_svg_text_path *path, cs_memory *memory) {
  cs_mem_free(memory, path->lengths, path->outline.piece_count * sizeof *path->lengths);
  cs_outline_finish(&path->outline, memory);
}

/* ---------------------------------------------------------------- places on it */

/* The last piece that begins at the distance or before it. */
static size_t piece_at(const cs_svg_text_path *path, double distance) {
  size_t low = 0, high = path->outline.piece_count;
  while (high - low > 1) {
    size_t middle = low + (high - low) / 2;
    if (path->lengths[middle] <= distance)
      low = middle;
    else
      high = middle;
  }
  return low;
}

celspan_point cs_svg_text_path_at(const cs_svg_text_path *path, double distance, double *degrees) {
  size_t piece = piece_at(path, distance);
  size_t next = piece + 1;
  double end = next < path->outline.piece_count ? path->lengths[next] : path->length;
  double whole = end - path->lengths[piece];
  cs_bezier line;
  celspan_point point, velocity;
  cs_curve_load_line(&path->outline, piece, 0, 1, &line);
  double t = whole > 0 ? cs_curve_parameter(&line, whole, distance - path->lengths[piece]) : 0;
  cs_curve_line_at(&line, t, &point, &velocity);
  if (velocity.x == 0 && velocity.y == 0)
    velocity = cs_curve_departure(&line);
  *degrees = cs_elementary_atan2(velocity.y, velocity.x) * DEGREES;
  return point;
}
