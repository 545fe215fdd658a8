#include "model/scene/walk.h"

#include "base/open.h"
#include "model/colour/transfer_names.h"
#include "model/pictures/configuration.h"
#include "model/pictures/store.h"
#include "model/pictures/tile_file.h"
#include "model/scene/shift.h"

/* Recursion ends: nesting is at most CS_SCENE_DEPTH. */
static celspan_status visit(cs_walk *walk, celspan_object *const *objects, size_t count) {
  for (size_t i = 0; i < count; i++) {
    const cs_primitive_data *data = objects[i]->data;
    walk->object = objects[i];
    if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
      CS_TRY(visit(walk, data->boolean->operands, data->boolean->operand_count));
    else if (data->kind == CS_PRIMITIVE_DATA_ROSTRUM)
      CS_TRY(cs_walk_rostrum(walk, data->rostrum));
    else
      CS_TRY(walk->call(walk, data, data->texture));
  }
  return CELSPAN_OK;
}

celspan_status cs_walk_lights(cs_walk *walk, const cs_light *front, const cs_light *back) {
  if (front->texture)
    CS_TRY(walk->call(walk, NULL, front->texture));
  return back->texture ? walk->call(walk, NULL, back->texture) : CELSPAN_OK;
}

celspan_status cs_walk_cel(cs_walk *walk, const celspan_cel *cel) {
  walk->cels++;
  CS_TRY(cs_walk_lights(walk, &cel->front, &cel->back));
  if (cel->shift && cel->shift->by)
    CS_TRY(visit(walk, cel->shift->by->objects, 1));
  return visit(walk, cel->objects, cel->object_count);
}

celspan_status cs_walk_rostrum(cs_walk *walk, const celspan_rostrum *rostrum) {
  CS_TRY(cs_walk_lights(walk, &rostrum->front, &rostrum->back));
  if (rostrum->grain)
    CS_TRY(walk->call(walk, NULL, rostrum->grain));
  for (size_t i = 0; i < rostrum->cel_count; i++)
    CS_TRY(cs_walk_cel(walk, rostrum->cels[i]));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- what is met */

static const cs_picture *picture_of(const celspan_texture *texture) {
  return texture ? texture->variation->picture : NULL;
}

static const cs_picture *medium_of(const celspan_texture *texture) {
  return texture ? texture->variation->medium : NULL;
}

static celspan_status count_primitive(const cs_walk *walk, const cs_primitive_data *primitive,
                                      const celspan_texture *texture) {
  celspan_rostrum_counts *counts = walk->user;
  counts->primitives += primitive != NULL;
  counts->pictures += picture_of(texture) != NULL;
  return CELSPAN_OK;
}

void celspan_rostrum_count(const celspan_rostrum *rostrum, celspan_rostrum_counts *out) {
  *out = (celspan_rostrum_counts){0};
  cs_walk walk = {.call = count_primitive, .user = out};
  celspan_status never_fails = cs_walk_rostrum(&walk, rostrum);
  (void)never_fails;
  out->cels = walk.cels;
}

static celspan_status check_primitive(const cs_walk *walk, const cs_primitive_data *primitive,
                                      const celspan_texture *texture) {
  (void)primitive;
  celspan_picture_info info;
  const cs_picture *picture = picture_of(texture), *medium = medium_of(texture);
  if (picture)
    CS_TRY(cs_store_info(walk->context, picture, &info));
  return medium ? cs_store_info(walk->context, medium, &info) : CELSPAN_OK;
}

celspan_status celspan_rostrum_check(celspan_context *context, const celspan_rostrum *rostrum) {
  cs_walk walk = {.context = context, .call = check_primitive};
  return cs_walk_rostrum(&walk, rostrum);
}

/* A picture in a space of OpenColorIO, which its file may name, is other light when the
 * configuration is another one. */
static void hash_configuration(cs_hash *hash, const cs_picture *picture) {
  celspan_transfer own;
  const char *file = cs_space_configuration();
  if (!file || (picture->colour && cs_transfer_parse(picture->colour, &own)))
    return;
  cs_hash_text(hash, file);
  cs_open_hash(hash, file);
}

static void hash_file(cs_hash *hash, const cs_picture *picture) {
  if (!picture)
    return;
  if (picture->surface) { /* the hash of its content, or the key that the host gave */
    cs_hash_hash(hash, cs_picture_hash(picture));
    return;
  }
  cs_open_hash(hash, picture->file);
  if (picture->tiles.size > 0)
    cs_tile_file_hash(picture, hash);
  hash_configuration(hash, picture);
}

static celspan_status hash_files(const cs_walk *walk, const cs_primitive_data *primitive,
                                 const celspan_texture *texture) {
  (void)primitive;
  hash_file(walk->user, picture_of(texture));
  hash_file(walk->user, medium_of(texture));
  return CELSPAN_OK;
}

cs_hash cs_walk_hash_files(const celspan_exposure *exposures, size_t count) {
  cs_hash hash = cs_hash_begin(count);
  cs_walk walk = {.call = hash_files, .user = &hash};
  for (size_t i = 0; i < count; i++) {
    celspan_status never_fails = cs_walk_rostrum(&walk, exposures[i].rostrum);
    (void)never_fails;
  }
  return cs_hash_end(hash);
}
