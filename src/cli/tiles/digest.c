#include "cli/tiles/digest.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "pictures/picture.h"
#include "scene/scene.h"

typedef struct scene_facts {
  cs_hash pictures;
  bool has_procedure;
} scene_facts;

static void add_file_state(cs_hash *hash, const char *path) {
  struct stat found;
  memset(&found, 0, sizeof found);
  if (stat(path, &found) != 0)
    found.st_size = -1;
  cs_hash_word(hash, (uint64_t)found.st_size);
  cs_hash_word(hash, (uint64_t)found.st_mtim.tv_sec);
  cs_hash_word(hash, (uint64_t)found.st_mtim.tv_nsec);
}

/* Recursion ends: nesting is at most CS_SCENE_DEPTH. */
static void add_objects(scene_facts *facts, celspan_object *const *objects, size_t count) {
  for (size_t i = 0; i < count; i++) {
    const cs_primitive_data *data = objects[i]->data;
    if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
      add_objects(facts, data->operands, data->operand_count);
    else if (data->kind == CS_PRIMITIVE_DATA_SCANLINE)
      facts->has_procedure = true;
    else if (data->texture->kind == CS_TEXTURE_PICTURE)
      add_file_state(&facts->pictures, data->texture->picture->file);
  }
}

static void add_file(cs_hash *hash, const char *path) {
  unsigned char bytes[4096];
  size_t size;
  FILE *file = fopen(path, "rb");
  if (!file)
    return;
  while ((size = fread(bytes, 1, sizeof bytes, file)) > 0)
    cs_hash_bytes(hash, bytes, size);
  fclose(file);
}

static void add_scene(cs_hash *hash, const cs_request *request, const celspan_frame_desc *frame) {
  scene_facts facts = {.pictures = cs_hash_begin(frame->exposure_count)};
  bool has_procedure = false;
  for (size_t i = 0; i < frame->exposure_count; i++) {
    const celspan_rostrum *rostrum = frame->exposures[i].rostrum;
    facts.has_procedure = false;
    for (size_t c = 0; c < rostrum->cel_count; c++)
      add_objects(&facts, rostrum->cels[c]->objects, rostrum->cels[c]->object_count);
    if (!facts.has_procedure)
      cs_hash_hash(hash, rostrum->hash);
    has_procedure |= facts.has_procedure;
    cs_hash_number(hash, frame->exposures[i].weight);
  }
  cs_hash_hash(hash, cs_hash_end(facts.pictures));
  if (!has_procedure)
    return;
  add_file(hash, request->operands[0]);
  for (size_t i = 0; i < request->script_argument_count; i++)
    cs_hash_text(hash, request->script_arguments[i]);
}

static void add_shape(cs_hash *hash, const cs_pyramid *pyramid) {
  const int32_t numbers[] = {(int32_t)pyramid->layout, pyramid->width, pyramid->height,
                             pyramid->tile, pyramid->overlap};
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
    cs_hash_word(hash, (uint64_t)numbers[i]);
  cs_hash_text(hash, pyramid->ending);
}

cs_hash cs_tile_digest(const cs_request *request, const cs_pyramid *pyramid,
                       const celspan_frame_desc *frame, bool is_script) {
  cs_hash hash = cs_hash_begin(is_script);
  cs_hash_text(&hash, celspan_version());
  add_shape(&hash, pyramid);
  cs_hash_number(&hash, frame->film_width);
  cs_hash_number(&hash, frame->film_height);
  cs_hash_word(&hash, frame->antialias ? 1 + (uint64_t)*frame->antialias : 0);
  cs_hash_word(&hash, (uint64_t)frame->filter.kernel);
  cs_hash_word(&hash, (uint64_t)frame->filter.rows);
  cs_hash_word(&hash, request->skips_empty);
  if (is_script)
    add_scene(&hash, request, frame);
  else
    add_file_state(&hash, request->operands[0]);
  return cs_hash_end(hash);
}
