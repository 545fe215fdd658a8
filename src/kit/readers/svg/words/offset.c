#include "readers/svg/words/offset.h"

#include <math.h>
#include <string.h>

#include "inside/number.h"
#include "readers/svg/words/transforms.h"
#include "readers/svg/words/ways.h"

#define BYTE 8 /* a byte of a path costs as much as several tests of selectors */

/* ---------------------------------------------------------------- values */

bool cs_svg_parse_way(const char *text, const char **data, size_t *size) {
  *data = "";
  *size = 0;
  if (cs_svg_is_word(text, "none"))
    return true;
  text = cs_svg_skip_space(text);
  if (strncmp(text, "path(", 5) != 0)
    return false;
  text = cs_svg_skip_space(text + 5);
  const char quote = *text, *end = quote == '"' || quote == '\'' ? strchr(text + 1, quote) : NULL;
  if (!end)
    return false;
  *data = text + 1;
  *size = (size_t)(end - text) - 1;
  text = cs_svg_skip_space(end + 1);
  return *text == ')' && !*cs_svg_skip_space(text + 1);
}

bool cs_svg_parse_heading(const char *text, bool *follows, double *degrees) {
  bool has_word = false, has_angle = false, is_back = false;
  double angle = 0;
  text = cs_svg_skip_space(text);
  for (; *text; text = cs_svg_skip_space(text)) {
    bool is_reverse = cs_svg_take_word(&text, "reverse");
    bool is_word = is_reverse || cs_svg_take_word(&text, "auto");
    if (is_word ? has_word : has_angle || !cs_svg_take_angle(&text, &angle))
      return false;
    is_back = is_back || is_reverse;
    has_word = has_word || is_word;
    has_angle = has_angle || !is_word;
  }
  *follows = has_word;
  *degrees = angle + (is_back ? 180 : 0);
  return has_word || has_angle;
}

/* ---------------------------------------------------------------- places */

/* The path as a line. *is_closed: its last part is; the line has no length if the data are
 * damaged. */
static celspan_status read_way(celspan_context *context, cs_arena *arena, const char *data,
                               size_t size, cs_svg_way *way, bool *is_closed) {
  cs_outline_closed closed = {.count = 0};
  char *copy = cs_arena_take(context, arena, size + 1);
  if (!copy)
    return CELSPAN_NO_MEMORY;
  memcpy(copy, data, size);
  copy[size] = 0;
  celspan_status status = cs_outline_path_open(context, &way->outline, &closed, copy);
  size_t last = way->outline.contour_count - 1;
  *is_closed = closed.count > 0 && closed.contours[closed.count - 1] == last;
  cs_outline_closed_finish(&closed, context->memory);
  if (status == CELSPAN_BAD_ARGUMENT)
    return CELSPAN_OK;
  return status == CELSPAN_OK ? cs_svg_way_measure(context, way) : status;
}

/* The distance along a path: one that is closed begins again after its end. */
static double distance_of(const char *text, const cs_svg_measure *measure, double whole,
                          bool is_closed) {
  cs_svg_length length;
  if (!text || !cs_svg_parse_length(text, &length))
    return 0;
  double distance = length.unit == CS_SVG_UNIT_PERCENT
                        ? whole * length.value / 100
                        : cs_svg_resolve(length, CS_SVG_AXIS_BOTH, measure);
  if (!is_closed || !cs_number_is_sane(distance))
    return cs_number_clamp(distance, 0, whole);
  distance = fmod(distance, whole);
  return distance < 0 ? distance + whole : distance;
}

static void place(const char *const *values, const cs_svg_measure *measure, const cs_svg_way *way,
                  bool is_closed, cs_svg_offset *out) {
  bool follows = true;
  double degrees, more = 0;
  const char *heading = values[CS_SVG_OFFSET_ROTATE];
  const char *anchor = values[CS_SVG_OFFSET_ANCHOR];
  if (heading && !cs_svg_parse_heading(heading, &follows, &more)) {
    follows = true;
    more = 0;
  }
  double distance = distance_of(values[CS_SVG_OFFSET_DISTANCE], measure, way->length, is_closed);
  out->is_there = true;
  out->at = cs_svg_way_at(way, distance, &degrees);
  out->degrees = (follows ? degrees : 0) + more;
  out->anchor = anchor && !cs_svg_is_word(anchor, "auto") ? anchor : NULL;
}

celspan_status cs_svg_offset_read(celspan_context *context, cs_arena *arena, uint32_t line,
                                  const char *const *values, const cs_svg_measure *measure,
                                  uint64_t *tests, cs_svg_offset *out) {
  const char *text = values[CS_SVG_OFFSET_PATH], *data;
  size_t size;
  bool is_closed;
  *out = (cs_svg_offset){.is_there = false};
  if (!text || !cs_svg_parse_way(text, &data, &size) || size == 0)
    return CELSPAN_OK;
  if (BYTE * (uint64_t)size >= *tests)
    return cs_fail(context, CELSPAN_LIMIT,
                   "line %u: the paths that elements lie on are too long together", line);
  *tests -= BYTE * (uint64_t)size;
  cs_svg_way way = {.length = 0};
  cs_outline_init(&way.outline);
  celspan_status status = read_way(context, arena, data, size, &way, &is_closed);
  if (status == CELSPAN_OK && way.length > 0 && cs_number_is_sane(way.length))
    place(values, measure, &way, is_closed, out);
  cs_svg_way_finish(&way, context->memory);
  return status;
}
