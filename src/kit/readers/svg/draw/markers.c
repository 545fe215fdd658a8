#include "readers/svg/draw/markers.h"

#include <string.h>

#include "inside/geometry.h"
#include "inside/number.h"
#include "readers/svg/document/shapes.h"
#include "readers/svg/words/transforms.h"

#define DEFAULT_SIZE 3 /* markerWidth and markerHeight. Source: SVG 2, 11.6.2 */

enum { START, MID, END };

/* The values that the marks of one shape share. */
typedef struct marking {
  cs_svg_reading *reading;
  const cs_svg_place *place;
  cs_svg_marks *marks;
  const cs_svg_node *markers[3]; /* NULL: none */
  cs_svg_line line;
  size_t inner; /* how many entries of line.closed.inner have been passed */
} marking;

/* A vertex of the line, and the unit vectors of the line's directions before and after it. */
typedef struct vertex {
  celspan_point at, in, out;
} vertex;

bool cs_svg_is_marked(const cs_svg_node *node, const cs_svg_style *style) {
  return cs_svg_is_shape(node) && (style->markers[START].size > 0 || style->markers[MID].size > 0 ||
                                   style->markers[END].size > 0);
}

void cs_svg_marks_finish(cs_svg_marks *marks, cs_memory *memory) {
  cs_mem_free(memory, marks->items, marks->capacity * sizeof *marks->items);
}

/* ---------------------------------------------------------------- directions */

/* The unit vector from a to b; false if they are the same point. */
static bool direction(celspan_point a, celspan_point b, celspan_point *out) {
  double x = b.x - a.x, y = b.y - a.y, length = cs_number_length(x, y);
  if (!(length > 0))
    return false;
  *out = (celspan_point){x / length, y / length};
  return true;
}

/* The direction of a piece at its beginning or end; false for a piece that is a point. */
static bool end_direction(const cs_outline *outline, size_t piece, bool at_end,
                          celspan_point *out) {
  const cs_hpoint *points = outline->points + outline->starts[piece];
  int degree = outline->degrees[piece];
  for (int i = 1; i <= degree; i++)
    if (at_end
            ? direction(cs_hpoint_place(points[degree - i]), cs_hpoint_place(points[degree]), out)
            : direction(cs_hpoint_place(points[0]), cs_hpoint_place(points[i]), out))
      return true;
  return false;
}

/* The direction of the pieces before `piece` in its contour, or after it; pieces that are points
 * are skipped. (0, 0) if there is none. */
static celspan_point near_direction(const marking *m, size_t begin, size_t end, size_t piece,
                                    bool before) {
  celspan_point found = {0, 0};
  if (before) {
    while (piece > begin && !end_direction(&m->line.outline, piece - 1, true, &found))
      piece--;
  } else {
    while (piece < end && !end_direction(&m->line.outline, piece, false, &found))
      piece++;
  }
  return found;
}

/* The unit vector in the middle between both; if they are opposite, the first one turned by a right
 * angle. */
static celspan_point bisector(celspan_point in, celspan_point out) {
  celspan_point found = {1, 0};
  if (!direction((celspan_point){-in.x, -in.y}, out, &found) && (in.x != 0 || in.y != 0))
    found = (celspan_point){-in.y, in.x};
  return found;
}

/* ---------------------------------------------------------------- one mark */

/* The direction in degrees that the attribute orient gives; false if the direction of the line is
 * used. */
static bool read_angle(const char *text, double *degrees) {
  *degrees = 0;
  text = cs_svg_skip_space(text ? text : "");
  return cs_svg_take_angle(&text, degrees) || *text == 0 || strncmp(text, "auto", 4) != 0;
}

static celspan_matrix turn_of(const cs_svg_node *marker, int which, const vertex *v) {
  const char *orient = cs_svg_node_value(marker, CS_SVG_ORIENT);
  celspan_point along = bisector(v->in, v->out);
  double degrees;
  if (read_angle(orient, &degrees))
    return cs_matrix_turn(degrees, (celspan_point){0, 0});
  if (which == START && cs_svg_is_word(orient, "auto-start-reverse"))
    along = (celspan_point){-along.x, -along.y};
  return (celspan_matrix){{along.x, -along.y, 0, along.y, along.x, 0, 0, 0, 1}};
}

/* The size of the viewport and its view box. *is_sized: false if nothing is shown. */
static celspan_status read_viewport(const marking *m, const cs_svg_node *marker, cs_svg_mark *mark,
                                    celspan_point *reference, bool *is_sized) {
  celspan_context *context = m->reading->context;
  const cs_svg_measure *measure = &m->place->measure;
  const cs_svg_length size = {DEFAULT_SIZE, CS_SVG_UNIT_NUMBER};
  const char *value = cs_svg_node_value(marker, CS_SVG_VIEW_BOX);
  cs_svg_view_box box = {.is_given = false};
  CS_TRY(cs_svg_length_of(context, marker, CS_SVG_MARKER_WIDTH, CS_SVG_AXIS_X, measure, size,
                          &mark->width));
  CS_TRY(cs_svg_length_of(context, marker, CS_SVG_MARKER_HEIGHT, CS_SVG_AXIS_Y, measure, size,
                          &mark->height));
  *is_sized = mark->width > 0 && mark->height > 0 && (!value || cs_svg_parse_view_box(value, &box));
  if (!*is_sized)
    return CELSPAN_OK;
  mark->content = celspan_matrix_identity();
  mark->measure = *measure;
  mark->measure.width = box.is_given ? box.width : mark->width;
  mark->measure.height = box.is_given ? box.height : mark->height;
  if (box.is_given)
    mark->content = cs_svg_fit(&box, mark->width, mark->height,
                               cs_svg_node_value(marker, CS_SVG_PRESERVE_ASPECT_RATIO));
  CS_TRY(cs_svg_reference_of(context, marker, CS_SVG_AXIS_X, &mark->measure, box.x, &reference->x));
  return cs_svg_reference_of(context, marker, CS_SVG_AXIS_Y, &mark->measure, box.y, &reference->y);
}

static double scale_of(const marking *m, const cs_svg_node *marker) {
  if (cs_svg_node_says(marker, CS_SVG_MARKER_UNITS, "userSpaceOnUse"))
    return 1;
  return cs_svg_resolve(m->place->style.stroke_width, CS_SVG_AXIS_BOTH, &m->place->measure);
}

static celspan_status add_mark(marking *m, int which, const vertex *v) {
  const cs_svg_node *marker = m->markers[which];
  cs_svg_mark mark = {.marker = marker};
  celspan_point reference = {0, 0};
  celspan_matrix inverse;
  bool is_sized;
  if (!marker)
    return CELSPAN_OK;
  CS_TRY(read_viewport(m, marker, &mark, &reference, &is_sized));
  double scale = scale_of(m, marker);
  if (!is_sized || !(scale > 0))
    return CELSPAN_OK;
  cs_hpoint at = cs_matrix_apply(&mark.content, (cs_hpoint){reference.x, reference.y, 1});
  mark.viewport = celspan_matrix_then(celspan_matrix_translation(-at.x, -at.y),
                                      celspan_matrix_scaling(scale, scale));
  mark.viewport = celspan_matrix_then(mark.viewport, turn_of(marker, which, v));
  mark.viewport = celspan_matrix_then(mark.viewport, celspan_matrix_translation(v->at.x, v->at.y));
  if (!cs_matrix_is_sane(&mark.viewport) || !cs_matrix_is_sane(&mark.content) ||
      !celspan_matrix_inverse(mark.viewport, &inverse))
    return CELSPAN_OK;
  return CS_APPEND(m->reading->context, m->marks->items, m->marks->count, m->marks->capacity, mark);
}

/* ---------------------------------------------------------------- vertices */

/* Whether a piece continues the arc of the piece before it. Must be called for pieces in ascending
 * order. */
static bool is_inner(marking *m, size_t piece) {
  const cs_outline_closed *closed = &m->line.closed;
  if (m->inner == closed->inner_count || closed->inner[m->inner] != piece)
    return false;
  m->inner++;
  return true;
}

static bool is_closed(const marking *m, size_t contour, size_t *next) {
  const cs_outline_closed *closed = &m->line.closed;
  if (*next == closed->count || closed->contours[*next] != contour)
    return false;
  ++*next;
  return true;
}

/* Marks the vertices of pieces begin .. end - 1, which form a contour. */
static celspan_status mark_contour(marking *m, size_t begin, size_t end, bool closes) {
  const cs_outline *outline = &m->line.outline;
  bool is_last = end == outline->piece_count;
  celspan_point first = near_direction(m, begin, end, begin, false);
  celspan_point last = near_direction(m, begin, end, end, true);
  vertex v = {cs_hpoint_place(outline->points[outline->starts[begin]]),
              closes ? last : (celspan_point){0, 0}, first};
  CS_TRY(add_mark(m, begin == 0 ? START : MID, &v));
  for (size_t piece = begin + 1; piece < end; piece++) {
    if (is_inner(m, piece))
      continue;
    v = (vertex){cs_hpoint_place(outline->points[outline->starts[piece]]),
                 near_direction(m, begin, end, piece, true),
                 near_direction(m, begin, end, piece, false)};
    CS_TRY(add_mark(m, MID, &v));
  }
  v = (vertex){
      cs_hpoint_place(outline->points[outline->starts[end - 1] + outline->degrees[end - 1]]), last,
      closes ? first : (celspan_point){0, 0}};
  return add_mark(m, is_last ? END : MID, &v);
}

static celspan_status mark_line(marking *m) {
  const cs_outline *outline = &m->line.outline;
  size_t next = 0;
  for (size_t i = 0; i < outline->contour_count; i++) {
    size_t begin = outline->contours[i];
    size_t end = i + 1 < outline->contour_count ? outline->contours[i + 1] : outline->piece_count;
    CS_TRY(mark_contour(m, begin, end, is_closed(m, i, &next)));
  }
  return CELSPAN_OK;
}

static celspan_status find_markers(marking *m, const cs_svg_node *node) {
  for (int i = 0; i < 3; i++) {
    const cs_svg_node *marker = cs_svg_referred(m->reading, m->place->style.markers[i]);
    if (!marker || marker->element != CS_SVG_ELEMENT_MARKER)
      continue;
    if (cs_svg_is_open(m->place->open, marker))
      CS_TRY(cs_svg_skip(m->reading, node, "marker inside of itself"));
    else
      m->markers[i] = marker;
  }
  return CELSPAN_OK;
}

celspan_status cs_svg_marks_find(cs_svg_reading *reading, const cs_svg_node *node,
                                 const cs_svg_place *place, cs_svg_marks *marks) {
  marking m = {.reading = reading, .place = place, .marks = marks};
  *marks = (cs_svg_marks){0};
  CS_TRY(find_markers(&m, node));
  if (!m.markers[START] && !m.markers[MID] && !m.markers[END])
    return CELSPAN_OK;
  celspan_status status = cs_svg_line_init(reading->context, node, &place->measure, &m.line);
  if (status == CELSPAN_OK)
    status = mark_line(&m);
  cs_svg_line_finish(&m.line, reading->context);
  return status;
}
