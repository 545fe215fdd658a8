/* Walks over everything that a rostrum contains: to count it, to hash what it shows, and to find
 * the files of its pictures. */
#include <sys/stat.h>

#include "pictures/store.h"
#include "scene/scene.h"

/* Called for every primitive, as often as it occurs. */
typedef celspan_status (*visitor)(celspan_context *context, void *user,
                                  const cs_primitive_data *primitive);

/* Recursion ends: nesting is at most CS_SCENE_DEPTH. */
static celspan_status visit(celspan_context *context, celspan_object *const *objects, size_t count,
                            visitor call, void *user) {
  for (size_t i = 0; i < count; i++) {
    const cs_primitive_data *data = objects[i]->data;
    CS_TRY(data->kind == CS_PRIMITIVE_DATA_BOOLEAN
               ? visit(context, data->operands, data->operand_count, call, user)
               : call(context, user, data));
  }
  return CELSPAN_OK;
}

static celspan_status visit_rostrum(celspan_context *context, const celspan_rostrum *rostrum,
                                    visitor call, void *user) {
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    const celspan_cel *cel = rostrum->cels[i];
    CS_TRY(visit(context, cel->objects, cel->object_count, call, user));
  }
  return CELSPAN_OK;
}

static const cs_picture *picture_of(const cs_primitive_data *primitive) {
  return primitive->texture ? primitive->texture->picture : NULL;
}

static celspan_status count_primitive(celspan_context *context, void *user,
                                      const cs_primitive_data *primitive) {
  (void)context;
  celspan_rostrum_counts *counts = user;
  counts->primitives++;
  counts->pictures += picture_of(primitive) != NULL;
  return CELSPAN_OK;
}

void celspan_rostrum_count(const celspan_rostrum *rostrum, celspan_rostrum_counts *out) {
  *out = (celspan_rostrum_counts){.cels = rostrum->cel_count};
  celspan_status never_fails = visit_rostrum(NULL, rostrum, count_primitive, out);
  (void)never_fails;
}

static celspan_status check_primitive(celspan_context *context, void *user,
                                      const cs_primitive_data *primitive) {
  (void)user;
  celspan_picture_info info;
  const cs_picture *picture = picture_of(primitive);
  return picture ? cs_store_info(context, picture, &info) : CELSPAN_OK;
}

celspan_status celspan_rostrum_check(celspan_context *context, const celspan_rostrum *rostrum) {
  return visit_rostrum(context, rostrum, check_primitive, NULL);
}

/* ---------------------------------------------------------------- what a frame shows */

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

static celspan_status hash_file(celspan_context *context, void *user,
                                const cs_primitive_data *primitive) {
  (void)context;
  const cs_picture *picture = picture_of(primitive);
  struct stat found = {0};
  if (!picture)
    return CELSPAN_OK;
  cs_hash_word(user, stat(picture->file, &found) == 0);
  cs_hash_word(user, (uint64_t)found.st_size);
  cs_hash_word(user, (uint64_t)found.st_mtim.tv_sec);
  cs_hash_word(user, (uint64_t)found.st_mtim.tv_nsec);
  return CELSPAN_OK;
}

cs_hash cs_scene_hash_files(const celspan_exposure *exposures, size_t count) {
  cs_hash hash = cs_hash_begin(count);
  for (size_t i = 0; i < count; i++) {
    celspan_status never_fails = visit_rostrum(NULL, exposures[i].rostrum, hash_file, &hash);
    (void)never_fails;
  }
  return cs_hash_end(hash);
}
