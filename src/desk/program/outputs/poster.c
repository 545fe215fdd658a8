#include "program/outputs/poster.h"

#include <limits.h>
#include <stdio.h>
#include <unistd.h>

#include "inside/context.h"
#include "inside/scene.h"
#include "inside/sinks.h"
#include "program/film/change.h"
#include "program/film/spaces.h"

enum { PIXEL = 4 }; /* bytes */

static bool is_wanted(const cs_script *script, const cs_video_format *format,
                      cs_video_poster place) {
  return script->film.has_poster && format->poster == place;
}

/* Builds the frame and adds it to the view. */
static cs_exit build(cs_script *script, const cs_request *request, celspan_frame_desc *frame) {
  const cs_frame_change change = cs_change_read(request);
  CS_TRY_EXIT(cs_script_build(script, script->film.poster));
  celspan_status status = cs_change_frame(script->context, &change, &script->frame);
  cs_film_expose(&script->film, &script->frame, frame);
  return cs_script_failure(script, status);
}

/* 8 bits and straight alpha, which every program shows. */
static celspan_coding coding_of(const cs_request *request) {
  celspan_coding coding = CELSPAN_CODING;
  coding.depth = CELSPAN_DEPTH_8;
  coding.alpha = CELSPAN_ALPHA_STRAIGHT;
  cs_spaces_set(request, &coding);
  return coding;
}

cs_exit cs_poster_make(cs_script *script, const cs_request *request, const cs_video_format *format,
                       const celspan_frame_desc *frame, unsigned char **out, size_t *size) {
  celspan_frame_desc desc = *frame;
  celspan_coding coding = coding_of(request);
  *out = NULL;
  if (!is_wanted(script, format, CS_POSTER_ATTACHED))
    return CS_EXIT_OK;
  CS_TRY_EXIT(build(script, request, &desc));
  bool is_part = desc.crop_width > 0;
  size_t stride = PIXEL * (size_t)(is_part ? desc.crop_width : desc.width);
  *size = stride * (size_t)(is_part ? desc.crop_height : desc.height);
  *out = cs_mem_resize(script->context->memory, NULL, 0, *size);
  celspan_status status =
      *out ? celspan_frame_pixels(script->context, &desc, &coding, *out, stride, NULL)
           : cs_fail_memory(script->context);
  if (status != CELSPAN_OK) {
    cs_mem_free(script->context->memory, *out, *size);
    *out = NULL;
  }
  return cs_script_failure(script, status);
}

/* ---------------------------------------------------------------- beside the video */

/* film.mp4: film.poster.png. false: the name is too long. */
static bool name_file(const char *output, char path[PATH_MAX]) {
  const char *ending = cs_file_ending(output);
  size_t stem = (size_t)(ending - output) - (ending[0] ? 1 : 0);
  return snprintf(path, PATH_MAX, "%.*s.poster.png", (int)stem, output) < PATH_MAX;
}

bool cs_poster_is_there(const cs_script *script, const cs_request *request,
                        const cs_video_format *format) {
  char path[PATH_MAX];
  return !is_wanted(script, format, CS_POSTER_BESIDE) ||
         (name_file(cs_request_text(request, "-o"), path) && access(path, F_OK) == 0);
}

static celspan_status write_file(cs_script *script, const cs_request *request, const char *path,
                                 const celspan_frame_desc *desc) {
  celspan_coding coding = coding_of(request);
  celspan_file_desc file = CELSPAN_FILE_DESC;
  file.format = "png";
  file.coding = &coding;
  return celspan_frame_write(script->context, desc, path, &file, NULL);
}

cs_exit cs_poster_write(cs_script *script, const cs_request *request, const cs_video_format *format,
                        const celspan_frame_desc *frame) {
  celspan_frame_desc desc = *frame;
  const char *output = cs_request_text(request, "-o");
  char path[PATH_MAX];
  if (!is_wanted(script, format, CS_POSTER_BESIDE))
    return CS_EXIT_OK;
  CS_TRY_EXIT(build(script, request, &desc));
  celspan_status status = name_file(output, path)
                              ? write_file(script, request, path, &desc)
                              : cs_fail(script->context, CELSPAN_OUTPUT,
                                        "%s: the name of its poster would be too long", output);
  return cs_script_failure(script, status);
}

/* ---------------------------------------------------------------- --resume */

celspan_status cs_poster_hash(cs_script *script, cs_hash *hash) {
  if (!script->film.has_poster)
    return CELSPAN_OK;
  CS_TRY(cs_script_try(script, script->film.poster));
  const cs_film_frame *frame = &script->frame;
  cs_hash_word(hash, 1);
  cs_hash_hash(hash, cs_scene_hash(frame->exposures, frame->count));
  cs_hash_hash(hash, cs_walk_hash_files(frame->exposures, frame->count));
  return CELSPAN_OK;
}
