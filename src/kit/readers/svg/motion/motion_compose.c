/* Values of animations that are added to the values without them. */
#include "readers/svg/motion/motion_values.h"

#include <string.h>

#include "readers/svg/words/names.h"

#define SUM 8192 /* the most bytes of a list to which another is added */

/* The functions of both lists. */
static celspan_status join(const cs_css_place *place, cs_svg_name name, const char *first,
                           cs_svg_mixed *value) {
  const char *second;
  CS_TRY(cs_svg_mixed_write(place, value, &second));
  if (!second)
    return CELSPAN_OK;
  size_t size = strlen(first) + strlen(second) + 2;
  if (strlen(first) > SUM)
    return cs_fail(place->context, CELSPAN_LIMIT,
                   "line %u: too many transforms are added to each other", place->line);
  char *text = cs_arena_take(place->context, place->arena, size);
  if (!text)
    return CELSPAN_NO_MEMORY;
  strcpy(text, first);
  strcat(text, " ");
  strcat(text, second);
  return cs_svg_mixed_read(place, name, text, value);
}

static bool is_nothing(const cs_svg_mixed *value) { return cs_svg_is_word(value->text, "none"); }

static celspan_status multiply(const cs_css_place *place, const cs_svg_mixed *under,
                               cs_svg_mixed *value) {
  double products[2];
  for (int i = 0; i < 2; i++)
    products[i] = under->numbers[i].value * value->numbers[i].value;
  *value = (cs_svg_mixed){.text = NULL};
  return cs_svg_mixed_fit(place, products, 2, value);
}

celspan_status cs_svg_motion_compose(const cs_css_place *place, cs_svg_name name,
                                     cs_svg_composition how, const cs_svg_mixed *under,
                                     cs_svg_mixed *value) {
  cs_svg_form form = cs_svg_name_facts_of(name)->form;
  bool is_list = form == CS_SVG_FORM_TRANSFORM || form == CS_SVG_FORM_FILTERS;
  bool fits = cs_svg_mixed_fits(under, value), is_sum = how == CS_SVG_COMPOSITION_ACCUMULATE;
  if (is_nothing(under) && is_list)
    return CELSPAN_OK;
  if (is_nothing(value) && is_list) {
    *value = *under;
    return CELSPAN_OK;
  }
  if (is_list && !(is_sum && fits))
    return join(place, name, under->text, value);
  if (!fits)
    return CELSPAN_OK;
  if (name == CS_SVG_SCALE && !is_sum && value->count == 2)
    return multiply(place, under, value);
  return name == CS_SVG_SCALE || form == CS_SVG_FORM_TRANSFORM
             ? cs_svg_matrices_add(place, under, value, value)
             : cs_svg_mixed_add(place, under, value, 1, value);
}
