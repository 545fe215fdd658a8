#include "readers/svg/document/recipe.h"

#include "inside/context.h"
#include "inside/scene.h"

celspan_status cs_svg_recipe_create(celspan_context *context, cs_svg_recipe **out) {
  cs_svg_recipe *recipe;
  CS_TRY(CS_COUNTED_MAKE(context, recipe));
  *out = recipe;
  return CELSPAN_OK;
}

static void finish_step(const cs_svg_step *step) {
  celspan_grade_unref(step->grade);
  celspan_object_unref(step->object);
  cs_nearby_unref(step->nearby);
}

celspan_status cs_svg_recipe_append(celspan_context *context, cs_svg_recipe *recipe,
                                    const cs_svg_step *step) {
  celspan_status status = CS_ARRAY_APPEND(context, recipe->steps, recipe->step_count, *step);
  if (status != CELSPAN_OK)
    finish_step(step);
  return status;
}

cs_svg_recipe *cs_svg_recipe_ref(cs_svg_recipe *recipe) {
  if (recipe)
    cs_counted_keep(&recipe->references);
  return recipe;
}

static void drop(cs_svg_recipe *recipe) {
  for (size_t i = 0; i < recipe->step_count; i++)
    finish_step(&recipe->steps[i]);
  cs_memory *memory = recipe->memory;
  CS_ARRAYS_FREE(memory, recipe, steps, inputs);
  cs_mem_free(memory, recipe, sizeof *recipe);
  cs_memory_unref(memory);
}

void cs_svg_recipe_unref(cs_svg_recipe *recipe) {
  while (recipe && cs_counted_drop(&recipe->references)) {
    cs_svg_recipe *next = recipe->next;
    drop(recipe);
    recipe = next;
  }
}
