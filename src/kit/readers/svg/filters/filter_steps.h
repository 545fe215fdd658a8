/* Elements in a filter, such as feBlend, as steps of a recipe.
 *
 *     element --reader--> step: its kind, numbers and inputs --> its box
 *
 * An input is the number of a source, or of an earlier step after the sources.
 */
#pragma once

#include "readers/svg/document/reading.h"
#include "readers/svg/document/recipe.h"

/* A result with a name. */
typedef struct cs_svg_named_result {
  const char *name;
  size_t number; /* counted in the same way as the inputs of steps */
} cs_svg_named_result;

/* A filter that is being read, and the element in it that becomes the next step. */
typedef struct cs_svg_filter {
  cs_svg_reading *reading;
  const cs_svg_node *element; /* the element that is filtered */
  const cs_svg_place *place;  /* of that */
  const cs_svg_node *owner;   /* the filter; NULL: a function */
  celspan_box box;            /* the box of the element, in its user units */
  bool is_in_shares;          /* numbers are shares of that box */
  cs_svg_recipe *recipe;
  CS_ARRAY(cs_svg_named_result, names);
  /* for each source, and then for each step: how often both sources are in it */
  CS_ARRAY(uint32_t, uses);
  size_t name_count, use_count;
  uint32_t weight; /* how often the element is in the last result; at first: in the source */
  const cs_svg_node *node;
  cs_svg_style style;
  cs_svg_step step;
  const char *reason; /* why a step cannot be made; NULL: no step has failed */
} cs_svg_filter;

/* Fills in the step of the element, without its box, or the reason why that cannot be made. */
typedef celspan_status cs_svg_step_reader(cs_svg_filter *f);
/* NULL: recipes do not have this step. */
cs_svg_step_reader *cs_svg_step_reader_of(cs_svg_element element);
/* Finds the box of the step, whose inputs are known, within the region. */
CELSPAN_CHECKED celspan_status cs_svg_filter_read_box(cs_svg_filter *f);
/* The default input: the previous step, or the element if there is none. */
size_t cs_svg_filter_last(const cs_svg_filter *f);

/* The paint of an input of the next step of a recipe for an element at `place`; false: it may have
 * several. The silhouette of an element with several colours is taken to be opaque. feMorphology
 * takes inputs of one colour, so that their greatest and least pixels are shapes.
 *
 *     the element or its silhouette --> feOffset, feMorphology --> the same paint
 */
bool cs_svg_filter_one_paint(const cs_svg_reading *reading, const cs_svg_node *element,
                             const cs_svg_place *place, const cs_svg_recipe *recipe, size_t number,
                             celspan_paint *out);
