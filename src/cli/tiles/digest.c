#include "cli/tiles/digest.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "pictures/picture.h"
#include "scene/scene.h"
#include "scene/walk.h"

static void add_file_state(cs_hash *hash, const char *path) {
  struct stat found;
  memset(&found, 0, sizeof found);
  if (stat(path, &found) != 0)
    found.st_size = -1;
  cs_hash_word(hash, (uint64_t)found.st_size);
  cs_hash_word(hash, (uint64_t)found.st_mtim.tv_sec);
  cs_hash_word(hash, (uint64_t)found.st_mtim.tv_nsec);
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
  const celspan_exposure *exposures = frame->exposures;
  for (size_t i = 0; i < frame->exposure_count; i++) {
    if (!cs_scene_has_procedure(&exposures[i], 1))
      cs_hash_hash(hash, exposures[i].rostrum->hash);
    cs_hash_number(hash, exposures[i].weight);
  }
  cs_hash_hash(hash, cs_walk_hash_files(exposures, frame->exposure_count));
  if (!cs_scene_has_procedure(exposures, frame->exposure_count))
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
