/* animateMotion: places on a line. */
#include "readers/svg/motion/motion.h"

#include <string.h>

#include "inside/geometry.h"
#include "inside/number.h"
#include "readers/svg/document/written.h"

/* The element whose d is the line; NULL: none. *room: for one that has an attribute `path`. */
static const cs_svg_node *line_of(cs_svg_reading *reading, const cs_svg_node *node,
                                  cs_svg_attribute *d, cs_svg_node *room) {
  for (const cs_svg_node *child = node->first; child; child = child->next)
    if (child->element == CS_SVG_ELEMENT_MPATH)
      return cs_svg_linked(reading, child);
  const char *path = cs_svg_node_value(node, CS_SVG_PATH);
  if (!path)
    return NULL;
  *d = (cs_svg_attribute){CS_SVG_D, false, path};
  *room = (cs_svg_node){.element = CS_SVG_ELEMENT_PATH,
                        .tag = "path",
                        .line = node->line,
                        .attributes = d,
                        .attribute_count = 1};
  return room;
}

/* The bytes that are read for a place. */
static size_t length_of(const cs_svg_node *node, const cs_svg_node *line) {
  const char *data = line ? cs_svg_node_value(line, CS_SVG_D) : NULL;
  const char *points = line ? cs_svg_node_value(line, CS_SVG_POINTS) : NULL;
  const char *values = cs_svg_node_value(node, CS_SVG_VALUES);
  return (data ? strlen(data) : 0) + (points ? strlen(points) : 0) + (values ? strlen(values) : 0);
}

celspan_status cs_svg_mover_spot(cs_svg_mover *mover, const cs_svg_animation *animation,
                                 double share, cs_svg_spot *out) {
  const cs_svg_measure measure = {100, 100, 16, 16, 100, 100};
  cs_svg_reading *reading = mover->reading;
  cs_svg_attribute d;
  cs_svg_node room;
  cs_svg_text_path path;
  double end_degrees;
  const cs_svg_node *line = line_of(reading, animation->node, &d, &room);
  *out = (cs_svg_spot){.has_line = line};
  CS_TRY(cs_svg_motion_count(reading, animation->node, length_of(animation->node, line)));
  if (!line)
    return CELSPAN_OK;
  celspan_status status = cs_svg_text_path_of(reading, line, &measure, false, &path);
  out->is_there = status == CELSPAN_OK && path.way.length > 0 && cs_number_is_sane(path.way.length);
  if (out->is_there) {
    out->point = cs_svg_way_at(&path.way, share * path.way.length, &out->degrees);
    out->end = cs_svg_way_at(&path.way, path.way.length, &end_degrees);
  }
  cs_svg_text_path_finish(&path, reading->context->memory);
  return status;
}

celspan_status cs_svg_mover_place(cs_svg_mover *mover, const cs_svg_animation *animation,
                                  celspan_point point, double degrees, bool adds) {
  cs_svg_reading *reading = mover->reading;
  const celspan_matrix *before = animation->target->motion;
  if (!cs_number_is_sane(point.x) || !cs_number_is_sane(point.y) || !cs_number_is_sane(degrees))
    return CELSPAN_OK;
  celspan_matrix *made = cs_arena_take(reading->context, &reading->document->arena, sizeof *made);
  if (!made)
    return CELSPAN_NO_MEMORY;
  *made = celspan_matrix_then(cs_matrix_turn(degrees, (celspan_point){0, 0}),
                              celspan_matrix_translation(point.x, point.y));
  if (before && adds)
    *made = celspan_matrix_then(*made, *before);
  animation->target->motion = made;
  return CELSPAN_OK;
}
