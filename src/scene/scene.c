/* What a frame shows: its name, and whether it can have one. */
#include "scene/scene.h"

static bool has_procedure(const celspan_cel *cel) {
  for (size_t i = 0; i < cel->object_count; i++)
    if (cel->objects[i]->data->has_procedure)
      return true;
  return false;
}

bool cs_scene_has_procedure(const celspan_exposure *exposures, size_t count) {
  for (size_t i = 0; i < count; i++)
    for (size_t k = 0; k < exposures[i].rostrum->cel_count; k++)
      if (has_procedure(exposures[i].rostrum->cels[k]))
        return true;
  return false;
}

cs_hash cs_scene_hash(const celspan_exposure *exposures, size_t count) {
  cs_hash hash = cs_hash_begin(count);
  for (size_t i = 0; i < count; i++) {
    cs_hash_hash(&hash, exposures[i].rostrum->hash);
    cs_hash_number(&hash, exposures[i].weight);
  }
  return cs_hash_end(hash);
}
