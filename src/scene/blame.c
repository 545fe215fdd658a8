#include "scene/blame.h"

#include <stdio.h>
#include <string.h>

/* ---------------------------------------------------------------- words */

cs_blame_text cs_blame_cel(size_t number, cs_mark cel) {
  cs_blame_text out;
  snprintf(out.text, sizeof out.text, "cel %zu%s", number, cs_mark_describe(cel).text);
  return out;
}

cs_blame_text cs_blame_object(size_t number, cs_mark cel, const celspan_object *object) {
  cs_blame_text out = cs_blame_cel(number, cel);
  const cs_primitive_data *data = object->data;
  bool is_primitive =
      data->kind == CS_PRIMITIVE_DATA_OUTLINE || data->kind == CS_PRIMITIVE_DATA_SCANLINE;
  const char *noun = is_primitive ? "primitive" : "object";
  cs_mark mark = object->mark;
  if (!mark.name && data->texture && data->texture->mark.name)
    mark = data->texture->mark;
  size_t length = strlen(out.text);
  snprintf(out.text + length, sizeof out.text - length, ", %s%s", noun,
           cs_mark_describe(mark).text);
  return out;
}

/* ---------------------------------------------------------------- the picture of a failure */

static const celspan_object *find(celspan_object *const *objects, size_t count,
                                  const char *sentence);

static const celspan_object *find_in_rostrum(const celspan_rostrum *rostrum, const char *sentence) {
  const celspan_object *found = NULL;
  for (size_t i = 0; i < rostrum->cel_count && !found; i++)
    found = find(rostrum->cels[i]->objects, rostrum->cels[i]->object_count, sentence);
  return found;
}

/* picture: may be NULL. */
static bool is_about(const char *sentence, const cs_picture *picture) {
  size_t length = picture ? strlen(picture->file) : 0;
  return picture && strncmp(sentence, picture->file, length) == 0 && sentence[length] == ':';
}

/* The object whose picture's file the sentence begins with, in a list or deeper; else NULL.
 * Recursion ends: nesting is at most CS_SCENE_DEPTH. */
static const celspan_object *find(celspan_object *const *objects, size_t count,
                                  const char *sentence) {
  const celspan_object *found = NULL;
  for (size_t i = 0; i < count && !found; i++) {
    const cs_primitive_data *data = objects[i]->data;
    const cs_texture_variation *variation = data->texture ? data->texture->variation : NULL;
    if (variation &&
        (is_about(sentence, variation->picture) || is_about(sentence, variation->medium)))
      found = objects[i];
    else if (data->kind == CS_PRIMITIVE_DATA_ROSTRUM)
      found = find_in_rostrum(data->rostrum, sentence);
    else if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
      found = find(data->boolean->operands, data->boolean->operand_count, sentence);
  }
  return found;
}

static bool blame_rostrum(celspan_context *context, const celspan_rostrum *rostrum) {
  char sentence[CS_ERROR_SIZE];
  snprintf(sentence, sizeof sentence, "%s", context->error);
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    const celspan_cel *cel = rostrum->cels[i];
    const celspan_object *object = find(cel->objects, cel->object_count, sentence);
    if (!object)
      continue;
    (void)cs_fail(context, CELSPAN_INPUT, "%s: %s", cs_blame_object(i + 1, cel->mark, object).text,
                  sentence);
    return true;
  }
  return false;
}

celspan_status cs_blame_picture(celspan_context *context, const celspan_exposure *exposures,
                                size_t count, celspan_status status) {
  bool is_found = status != CELSPAN_INPUT;
  for (size_t i = 0; i < count && !is_found; i++)
    is_found = exposures[i].rostrum && blame_rostrum(context, exposures[i].rostrum);
  return status;
}
