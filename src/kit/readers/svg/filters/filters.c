#include "readers/svg/filters/filters.h"

#include <string.h>

#include "inside/geometry.h"
#include "readers/svg/document/shapes.h"
#include "readers/svg/draw/regions.h"
#include "readers/svg/filters/filter_steps.h"

#define REPEATS "that repeats its input too often"

/* Both sources contain the element as often as the filters before this one have put it there. */
static celspan_status start_uses(cs_svg_filter *f) {
  for (size_t i = 0; i < CS_SVG_SOURCES; i++)
    CS_TRY(CS_ARRAY_APPEND(f->reading->context, f->uses, f->use_count, f->weight));
  return CELSPAN_OK;
}

/* Counts how often the result of the step contains the sources. */
static celspan_status count_uses(cs_svg_filter *f) {
  uint32_t uses = 0;
  const size_t factor = f->step.kind == CS_SVG_STEP_SUM      ? 2 * CS_SVG_SUM_MOST
                        : f->step.kind == CS_SVG_STEP_SHADOW ? 2
                                                             : 1;
  for (size_t i = 0; i < f->step.input_count && uses <= CS_SVG_RECIPE_USES; i++)
    uses += (uint32_t)factor * f->uses[f->recipe->inputs[f->step.first_input + i]];
  if (uses > CS_SVG_RECIPE_USES)
    f->reason = REPEATS;
  f->weight = uses;
  return CS_ARRAY_APPEND(f->reading->context, f->uses, f->use_count, uses);
}

static celspan_status read_step(cs_svg_filter *f, cs_svg_step_reader *read) {
  const cs_svg_reading *reading = f->reading;
  const char *name = cs_svg_node_value(f->node, CS_SVG_RESULT);
  CS_TRY(cs_svg_style_in_file(f->reading, f->node, &f->style));
  f->step = (cs_svg_step){.opacity = 1, .first_input = f->recipe->input_count};
  if (!reading->is_coded)
    f->step.space = f->style.filters_codes ? CELSPAN_SPACE_SRGB : CELSPAN_SPACE_LINEAR;
  celspan_status status = read(f);
  if (status == CELSPAN_OK)
    status = cs_svg_filter_read_box(f);
  if (status == CELSPAN_OK)
    status = count_uses(f);
  CS_TRY(cs_svg_recipe_append(f->reading->context, f->recipe, &f->step));
  if (status == CELSPAN_OK && name && *name)
    status = CS_ARRAY_APPEND(f->reading->context, f->names, f->name_count,
                             (cs_svg_named_result){name, cs_svg_filter_last(f)});
  return status;
}

/* Reads steps until one of them cannot be made. */
static celspan_status read_steps(cs_svg_filter *f) {
  CS_TRY(start_uses(f));
  for (const cs_svg_node *node = f->owner->first; node && !f->reason; node = node->next) {
    cs_svg_step_reader *read = cs_svg_step_reader_of(node->element);
    f->node = node;
    if (read)
      CS_TRY(read_step(f, read));
    else if (strncmp(node->tag, "fe", 2) == 0)
      f->reason = "";
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- functions */

static celspan_status make_function(cs_svg_filter *f, const cs_svg_filter_call *call) {
  f->weight *= call->kind == CS_SVG_FILTER_SHADOW ? 2 : 1;
  if (f->weight > CS_SVG_RECIPE_USES)
    f->reason = REPEATS;
  return cs_svg_filter_function_make(f->reading, call, f->place, f->recipe);
}

/* ---------------------------------------------------------------- the whole */

/* Notes the step that cannot be made, at its line. */
static celspan_status note(const cs_svg_filter *f, const cs_svg_filter_call *call) {
  bool is_function = call->kind != CS_SVG_FILTER_REFERENCE;
  const char *name = is_function ? cs_svg_filter_name(call->kind) : f->node->tag;
  return cs_svg_skip(f->reading, is_function ? f->element : f->node, "filter of %.40s: %.40s%s%s",
                     f->element->tag, name, *f->reason ? " " : "", f->reason);
}

/* The region in user units. If it has no size, nothing is drawn, and there are no steps. */
static celspan_status make_steps(cs_svg_filter *f) {
  cs_svg_recipe *recipe = f->recipe;
  cs_svg_region region;
  CS_TRY(
      cs_svg_region_find(f->reading, f->owner, CS_SVG_FILTER_UNITS, f->element, f->place, &region));
  f->is_in_shares = cs_svg_node_says(f->owner, CS_SVG_PRIMITIVE_UNITS, "objectBoundingBox");
  if (!region.is_sized || (f->is_in_shares && !region.has_box))
    return CELSPAN_OK;
  const celspan_matrix user = celspan_matrix_then(region.own, recipe->back);
  recipe->region = cs_svg_box_mapped(&region.box, &user);
  f->box = region.element;
  return read_steps(f);
}

static celspan_status make_recipe(cs_svg_filter *f, const cs_svg_filter_call *call) {
  cs_svg_recipe *recipe = f->recipe;
  recipe->space = f->reading->is_coded ? CELSPAN_SPACE_AROUND : f->reading->space;
  recipe->matrix = f->place->matrix;
  if (!celspan_matrix_inverse(recipe->matrix, &recipe->back) || !cs_matrix_is_sane(&recipe->back))
    return CELSPAN_OK;
  celspan_status status = f->owner ? make_steps(f) : make_function(f, call);
  if (status == CELSPAN_OK && f->reason)
    status = note(f, call);
  CS_ARRAYS_FREE(f->reading->context->memory, f, names, uses);
  return status;
}

/* The filter that a reference means. *is_there: false: it is missing or circular, and this is
 * noted. */
static celspan_status find_owner(cs_svg_filter *f, cs_svg_reference reference, bool *is_there) {
  f->owner = cs_svg_referred(f->reading, reference);
  *is_there = f->owner && f->owner->element == CS_SVG_ELEMENT_FILTER;
  if (!*is_there)
    return cs_svg_skip(f->reading, f->element, "filter of %.40s", f->element->tag);
  *is_there = !cs_svg_is_open(f->place->open, f->owner);
  return *is_there ? CELSPAN_OK
                   : cs_svg_skip(f->reading, f->element, "filter that shows what it filters");
}

/* The recipe of a call. weight: how often the filtered picture contains the element; updated. *out:
 * new; NULL: it cannot be made. */
static celspan_status add_recipe(cs_svg_filter f, const cs_svg_filter_call *call, uint32_t *weight,
                                 cs_svg_recipe **out) {
  bool is_there = true;
  f.weight = *weight;
  if (call->kind == CS_SVG_FILTER_REFERENCE)
    CS_TRY(find_owner(&f, call->reference, &is_there));
  if (!is_there)
    return CELSPAN_OK;
  CS_TRY(cs_svg_recipe_create(f.reading->context, &f.recipe));
  celspan_status status = make_recipe(&f, call);
  *weight = f.weight;
  if (status == CELSPAN_OK && !f.reason)
    *out = f.recipe;
  else
    cs_svg_recipe_unref(f.recipe);
  return status;
}

celspan_status cs_svg_filter_make(cs_svg_reading *reading, const cs_svg_node *node,
                                  const cs_svg_place *place, cs_svg_recipe **out) {
  const cs_svg_filter whole = {.reading = reading, .element = node, .place = place};
  const char *text = place->style.filter;
  celspan_status status = CELSPAN_OK;
  cs_svg_filter_call call;
  cs_svg_recipe **last = out;
  uint32_t weight = 1;
  bool is_complete = true;
  *out = NULL;
  while (status == CELSPAN_OK && is_complete && cs_svg_take_filter(&text, &call)) {
    status = add_recipe(whole, &call, &weight, last);
    is_complete = *last;
    last = is_complete ? &(*last)->next : last;
  }
  if (is_complete && status == CELSPAN_OK)
    return CELSPAN_OK;
  cs_svg_recipe_unref(*out);
  *out = NULL;
  return status;
}
