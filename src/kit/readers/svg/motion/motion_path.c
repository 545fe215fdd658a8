/* animateMotion: places on a line, or between points. */
#include "readers/svg/motion/motion_smil.h"

#include <math.h>
#include <string.h>

#include "inside/geometry.h"
#include "inside/number.h"
#include "readers/svg/document/written.h"
#include "readers/svg/motion/motion_lists.h"

/* A place, and the direction of the movement there in degrees. */
typedef struct spot {
  celspan_point point;
  double degrees;
} spot;

static const char *mode_of(const cs_svg_node *node) {
  const char *mode = cs_svg_node_value(node, CS_SVG_CALC_MODE);
  return mode ? mode : "paced";
}

/* ---------------------------------------------------------------- lines */

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

/* Point i of the list keyPoints; 1: it is missing. */
static double key_point(const char *text, size_t i) {
  double point = 1;
  for (; i > 0; i--) {
    text += strcspn(text, ";");
    text += *text == ';';
  }
  text = cs_svg_skip_space(text);
  return cs_svg_take_number(&text, &point) ? cs_number_clamp(point, 0, 1) : 1;
}

/* The share of the line at a share of the time. False: the lists of the element lie. */
static bool share_of_line(const cs_svg_node *node, double at, double *out) {
  const char *points = cs_svg_node_value(node, CS_SVG_KEY_POINTS), *mode = mode_of(node);
  size_t count = points ? cs_svg_list_count(points) : 2, first;
  double share;
  *out = at;
  if (cs_svg_is_word(mode, "paced") || (!points && !cs_svg_is_word(mode, "spline")))
    return true;
  if (count == 0 || !cs_svg_list_place(node, mode, at, count, NULL, &first, &share))
    return false;
  double from = points ? key_point(points, first) : (double)first;
  double to = points ? key_point(points, first + 1 < count ? first + 1 : first) : 1;
  *out = from + (to - from) * share;
  return true;
}

/* *counts: false if there is no line. */
static celspan_status spot_on_line(cs_svg_reading *reading, const cs_svg_node *node,
                                   const cs_svg_node *line, double share, spot *out, spot *end,
                                   bool *counts) {
  const cs_svg_measure measure = {100, 100, 16, 16, 100, 100};
  cs_svg_text_path path;
  celspan_status status = cs_svg_text_path_of(reading, line, &measure, false, &path);
  *counts = status == CELSPAN_OK && path.way.length > 0 && cs_number_is_sane(path.way.length) &&
            share_of_line(node, share, &share);
  if (*counts) {
    out->point = cs_svg_way_at(&path.way, share * path.way.length, &out->degrees);
    end->point = cs_svg_way_at(&path.way, path.way.length, &end->degrees);
  }
  cs_svg_text_path_finish(&path, reading->context->memory);
  return status;
}

/* ---------------------------------------------------------------- points */

/* A point "x,y" of a list, or of from, to or by. */
static bool read_point(const char *text, celspan_point *out) {
  text = cs_svg_skip_space(text);
  if (!cs_svg_take_number(&text, &out->x))
    return false;
  text = cs_svg_skip_comma(text);
  return cs_svg_take_number(&text, &out->y);
}

/* The points of the list, or the two of from, to and by. *points: in the document's arena. */
static celspan_status read_points(cs_svg_reading *reading, const cs_svg_node *node,
                                  celspan_point **points, size_t *count) {
  const char *values = cs_svg_node_value(node, CS_SVG_VALUES);
  const char *from = cs_svg_node_value(node, CS_SVG_FROM), *to = cs_svg_node_value(node, CS_SVG_TO);
  const char *by = cs_svg_node_value(node, CS_SVG_BY);
  size_t most = values ? cs_svg_list_count(values) : 2;
  *count = 0;
  *points =
      cs_arena_take(reading->context, &reading->document->arena, (most + 2) * sizeof **points);
  if (!*points)
    return CELSPAN_NO_MEMORY;
  for (; values && *count < most; values += strcspn(values, ";"), values += *values == ';')
    if (!read_point(values, &(*points)[(*count)++]))
      *count = most = 0;
  if (values || !(to || by))
    return CELSPAN_OK;
  celspan_point *two = *points;
  two[0] = two[1] = (celspan_point){0, 0};
  bool is_read = (!from || read_point(from, &two[0])) && read_point(to ? to : by, &two[1]);
  if (!to)
    two[1] = (celspan_point){two[0].x + two[1].x, two[0].y + two[1].y};
  *count = is_read ? 2 : 0;
  return CELSPAN_OK;
}

static celspan_status spot_on_points(cs_svg_reading *reading, const cs_svg_node *node, double share,
                                     spot *out, spot *end, bool *counts) {
  celspan_point *points;
  double *distances;
  size_t count, first;
  CS_TRY(read_points(reading, node, &points, &count));
  *counts = count > 0;
  if (count == 0)
    return CELSPAN_OK;
  distances = cs_arena_take(reading->context, &reading->document->arena, count * sizeof *distances);
  if (!distances)
    return CELSPAN_NO_MEMORY;
  for (size_t i = 0; i + 1 < count; i++)
    distances[i] = cs_number_length(points[i + 1].x - points[i].x, points[i + 1].y - points[i].y);
  bool is_paced = cs_svg_is_word(mode_of(node), "paced");
  *counts = cs_svg_list_place(node, mode_of(node), share, count, is_paced ? distances : NULL,
                              &first, &share);
  celspan_point a = points[first], b = points[first + 1 < count ? first + 1 : first];
  out->point = (celspan_point){a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share};
  out->degrees = cs_svg_direction(b.x - a.x, b.y - a.y);
  end->point = points[count - 1];
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- motions */

/* The turn that `rotate` asks for. */
static double turn_of(const cs_svg_node *node, double degrees) {
  const char *rotate = cs_svg_node_value(node, CS_SVG_ROTATE);
  double angle = 0;
  if (!rotate)
    return 0;
  if (cs_svg_is_word(rotate, "auto"))
    return degrees;
  if (cs_svg_is_word(rotate, "auto-reverse"))
    return degrees + 180;
  rotate = cs_svg_skip_space(rotate);
  return cs_svg_take_number(&rotate, &angle) ? angle : 0;
}

/* Only by, without a list, a line or a beginning, is always added. */
static bool adds(const cs_svg_node *node, bool has_line) {
  bool is_by = !has_line && !cs_svg_node_value(node, CS_SVG_VALUES) &&
               !cs_svg_node_value(node, CS_SVG_FROM) && !cs_svg_node_value(node, CS_SVG_TO);
  return is_by || cs_svg_node_says(node, CS_SVG_ADDITIVE, "sum");
}

celspan_status cs_svg_motion_path(cs_svg_reading *reading, const cs_svg_animation *animation,
                                  const cs_svg_progress *progress, const celspan_matrix **motion) {
  const cs_svg_node *node = animation->node;
  cs_svg_attribute d;
  cs_svg_node room;
  spot at = {{0, 0}, 0}, end = {{0, 0}, 0};
  bool counts;
  const cs_svg_node *line = line_of(reading, node, &d, &room);
  CS_TRY(cs_svg_motion_count(reading, node, length_of(node, line)));
  if (line)
    CS_TRY(spot_on_line(reading, node, line, progress->share, &at, &end, &counts));
  else
    CS_TRY(spot_on_points(reading, node, progress->share, &at, &end, &counts));
  if (!counts)
    return CELSPAN_OK;
  double rounds = cs_svg_node_says(node, CS_SVG_ACCUMULATE, "sum") ? progress->round : 0;
  at.point.x += end.point.x * rounds;
  at.point.y += end.point.y * rounds;
  if (!cs_number_is_sane(at.point.x) || !cs_number_is_sane(at.point.y))
    return CELSPAN_OK;
  celspan_matrix *made = cs_arena_take(reading->context, &reading->document->arena, sizeof *made);
  if (!made)
    return CELSPAN_NO_MEMORY;
  *made = celspan_matrix_then(cs_matrix_turn(turn_of(node, at.degrees), (celspan_point){0, 0}),
                              celspan_matrix_translation(at.point.x, at.point.y));
  if (*motion && adds(node, line))
    *made = celspan_matrix_then(*made, **motion);
  *motion = made;
  return CELSPAN_OK;
}
