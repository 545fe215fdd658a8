/* Patterns: an element whose contents are drawn as art that repeats, for one shape. */
#include "readers/svg/draw/painted.h"

#include "inside/number.h"
#include "readers/svg/document/shapes.h"
#include "readers/svg/draw/viewport.h"
#include "readers/svg/words/transforms.h"

/* The most templates that follow one another by href. */
#define TEMPLATES 32

typedef struct pattern {
  cs_svg_reading *reading;
  const cs_svg_node *node;
  const cs_svg_painted *shape;
  celspan_box box;       /* the repeated box, in the pattern's units */
  celspan_matrix matrix; /* from the pattern's units to the shape's */
} pattern;

/* ---------------------------------------------------------------- elements */

/* The first of the element and its templates that `has` something; NULL: none. */
static const cs_svg_node *find_owner(const pattern *p, cs_svg_name name, bool is_of_contents) {
  const cs_svg_node *node = p->node;
  for (int i = 0; i < TEMPLATES && node && node->element == CS_SVG_ELEMENT_PATTERN; i++) {
    if (is_of_contents ? node->first != NULL : cs_svg_node_value(node, name) != NULL)
      return node;
    node = cs_svg_linked(p->reading, node);
  }
  return NULL;
}

static const char *value_of(const pattern *p, cs_svg_name name) {
  const cs_svg_node *owner = find_owner(p, name, false);
  return owner ? cs_svg_node_value(owner, name) : NULL;
}

static bool is_word(const pattern *p, cs_svg_name name, const char *word) {
  return cs_svg_is_word(value_of(p, name), word);
}

/* ---------------------------------------------------------------- places */

static celspan_status read_length(const pattern *p, cs_svg_name name, cs_svg_axis axis,
                                  const cs_svg_measure *measure, double *out) {
  const cs_svg_node *owner = find_owner(p, name, false);
  return cs_svg_number_of(p->reading->context, owner ? owner : p->node, name, axis, measure, out);
}

static celspan_status read_box(pattern *p, bool is_in_shares) {
  const celspan_box *shape = &p->shape->box;
  cs_svg_measure measure = *p->shape->measure;
  celspan_box *box = &p->box;
  if (is_in_shares)
    measure.width = measure.height = 1;
  CS_TRY(read_length(p, CS_SVG_X, CS_SVG_AXIS_X, &measure, &box->x));
  CS_TRY(read_length(p, CS_SVG_Y, CS_SVG_AXIS_Y, &measure, &box->y));
  CS_TRY(read_length(p, CS_SVG_WIDTH, CS_SVG_AXIS_X, &measure, &box->width));
  CS_TRY(read_length(p, CS_SVG_HEIGHT, CS_SVG_AXIS_Y, &measure, &box->height));
  if (is_in_shares)
    *box = (celspan_box){shape->x + box->x * shape->width, shape->y + box->y * shape->height,
                         box->width * shape->width, box->height * shape->height};
  return CELSPAN_OK;
}

static void read_matrix(pattern *p) {
  const char *transform = value_of(p, CS_SVG_PATTERN_TRANSFORM);
  const char *origin = value_of(p, CS_SVG_TRANSFORM_ORIGIN);
  celspan_matrix own;
  p->matrix = celspan_matrix_identity();
  if (transform && cs_svg_parse_transform(transform, p->shape->measure, &own))
    p->matrix = own;
  if (origin && *origin)
    p->matrix = cs_svg_about_origin(p->matrix, origin, p->shape->measure);
}

/* The place of the contents in the pattern's units: their origin is the corner of the box. */
static celspan_status find_place(const pattern *p, const cs_svg_node *owner,
                                 const cs_svg_open *open, cs_svg_place *out) {
  const celspan_matrix corner = celspan_matrix_translation(p->box.x, p->box.y);
  const char *view_box = value_of(p, CS_SVG_VIEW_BOX);
  cs_svg_view_box given = {.is_given = false};
  *out = (cs_svg_place){.matrix = corner, .measure = *p->shape->measure, .open = open};
  CS_TRY(cs_svg_style_in_file(p->reading, owner, &out->style));
  out->measure.font_size = out->style.font_size;
  if (view_box && cs_svg_parse_view_box(view_box, &given)) {
    (void)cs_svg_viewport_fit(view_box, value_of(p, CS_SVG_PRESERVE_ASPECT_RATIO), p->box.width,
                              p->box.height, out);
  } else if (is_word(p, CS_SVG_PATTERN_CONTENT_UNITS, "objectBoundingBox")) {
    out->matrix = celspan_matrix_then(
        celspan_matrix_scaling(p->shape->box.width, p->shape->box.height), corner);
    out->measure.width = out->measure.height = 1;
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- textures */

static celspan_status make_texture(const pattern *p, celspan_object *art, cs_svg_server *out) {
  celspan_context *context = p->reading->context;
  celspan_pattern_desc desc = CELSPAN_PATTERN_DESC;
  celspan_object *faded;
  CS_TRY(celspan_object_fade(context, art, p->shape->opacity, &faded));
  desc.art = faded;
  desc.box = p->box;
  celspan_status status = celspan_texture_create_pattern(context, &desc, &out->texture);
  celspan_object_unref(faded);
  if (status == CELSPAN_LIMIT)
    return cs_fail(context, CELSPAN_LIMIT,
                   "line %u: patterns and their contents are nested more than %d deep",
                   p->node->line, CS_SVG_DEPTH);
  CS_TRY(status);
  out->matrix = p->matrix;
  out->kind = CS_SVG_SERVER_TEXTURE;
  return CELSPAN_OK;
}

static celspan_status draw(const pattern *p, const cs_svg_node *owner, cs_svg_server *out) {
  cs_svg_reading *reading = p->reading;
  const cs_svg_open open = {p->node, p->shape->open}, inner = {owner, &open};
  cs_svg_place place;
  celspan_object *art = NULL;
  if (++reading->depth > CS_SVG_DEPTH)
    return cs_fail(reading->context, CELSPAN_LIMIT,
                   "line %u: patterns refer to one another more than %d deep", p->node->line,
                   CS_SVG_DEPTH);
  CS_TRY(find_place(p, owner, &inner, &place));
  celspan_status status = reading->draw(reading, owner, false, &place, &art);
  reading->depth--;
  if (status == CELSPAN_OK && art)
    status = make_texture(p, art, out);
  celspan_object_unref(art);
  return status;
}

static bool fits(const pattern *p) {
  celspan_matrix inverse;
  return p->box.width > 0 && p->box.height > 0 && cs_number_is_sane(p->box.x) &&
         cs_number_is_sane(p->box.y) && cs_number_is_sane(p->box.width) &&
         cs_number_is_sane(p->box.height) && celspan_matrix_inverse(p->matrix, &inverse);
}

celspan_status cs_svg_pattern_make(cs_svg_reading *reading, const cs_svg_node *node,
                                   const cs_svg_painted *shape, bool *is_missing,
                                   cs_svg_server *out) {
  pattern p = {.reading = reading, .node = node, .shape = shape};
  const cs_svg_node *owner = find_owner(&p, CS_SVG_NAME_COUNT, true);
  bool is_in_shares = !is_word(&p, CS_SVG_PATTERN_UNITS, "userSpaceOnUse");
  bool has_box = shape->box.width > 0 && shape->box.height > 0;
  *is_missing = is_in_shares && !has_box;
  *is_missing = *is_missing || !owner;
  if (*is_missing)
    return CELSPAN_OK;
  if (cs_svg_is_open(shape->open, node) || cs_svg_is_open(shape->open, owner))
    return cs_svg_skip(reading, node, "pattern that is inside what it paints");
  CS_TRY(read_box(&p, is_in_shares));
  read_matrix(&p);
  *is_missing = !(p.box.width > 0 && p.box.height > 0);
  return fits(&p) ? draw(&p, owner, out) : CELSPAN_OK;
}
