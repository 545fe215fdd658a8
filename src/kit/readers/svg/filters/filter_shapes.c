/* The inputs of filters that have one colour. */
#include "readers/svg/filters/filter_steps.h"

#include "readers/svg/document/shapes.h"

/* Whether an element contains nothing that could have its own paint. */
static bool is_plain(const cs_svg_node *element) {
  if (cs_svg_is_shape(element))
    return true;
  for (const cs_svg_node *child = element->first; child; child = child->next)
    if (child->element != CS_SVG_ELEMENT_CHARACTERS)
      return false;
  return element->element == CS_SVG_ELEMENT_TEXT;
}

static bool is_none(const cs_svg_paint *paint) {
  return !paint->has_server && paint->kind == CS_SVG_PAINT_NONE;
}

/* The only paint of an element: of its area or of its line. */
static bool own_paint(const cs_svg_reading *reading, const cs_svg_node *element,
                      const cs_svg_style *style, celspan_paint *out) {
  const bool is_filled = is_none(&style->stroke);
  const cs_svg_paint *paint = is_filled ? &style->fill : &style->stroke;
  if (!is_plain(element) || !(is_filled || is_none(&style->fill)) || paint->has_server)
    return false;
  for (int i = 0; i < 3; i++)
    if (style->markers[i].size > 0)
      return false;
  *out = cs_svg_paint_of(reading,
                         paint->kind == CS_SVG_PAINT_CURRENT ? &style->colour : &paint->colour,
                         is_filled ? style->fill_opacity : style->stroke_opacity);
  return true;
}

bool cs_svg_filter_one_paint(const cs_svg_reading *reading, const cs_svg_node *element,
                             const cs_svg_place *place, const cs_svg_recipe *recipe, size_t number,
                             celspan_paint *out) {
  while (number >= CS_SVG_SOURCES) {
    const cs_svg_step *step = &recipe->steps[number - CS_SVG_SOURCES];
    *out = step->paint;
    if (step->kind == CS_SVG_STEP_GROW || step->kind == CS_SVG_STEP_SHRINK)
      return true;
    if (step->kind != CS_SVG_STEP_OFFSET)
      return false;
    number = recipe->inputs[step->first_input];
  }
  bool has_one = own_paint(reading, element, &place->style, out);
  if (number == 1)
    *out = celspan_paint_rgb(0, 0, 0, has_one ? out->beta : 1);
  return has_one || number == 1;
}
