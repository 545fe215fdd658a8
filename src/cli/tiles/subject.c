#include "cli/tiles/subject.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "cli/confine.h"
#include "scene/scene.h"

static bool is_script(const char *path) {
  size_t length = strlen(path);
  return length > 4 && strcasecmp(path + length - 4, ".lua") == 0;
}

/* "shots/night.lua" -> "night" */
static void set_name(const char *path, char name[CS_TILE_SUBJECT_NAME]) {
  const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
  const char *dot = strrchr(base, '.');
  int length = (int)(dot && dot > base ? (size_t)(dot - base) : strlen(base));
  snprintf(name, CS_TILE_SUBJECT_NAME, "%.*s", length, base);
}

static cs_exit open_still(cs_tile_subject *subject, const cs_request *request) {
  cs_exit outcome = cs_confine_refuse(request);
  if (outcome != CS_EXIT_OK)
    return outcome;
  outcome = cs_still_open(subject->context, request->operands[0], &subject->still);
  return outcome == CS_EXIT_OK ? cs_still_frame(&subject->still, request, &subject->frame)
                               : outcome;
}

static cs_exit open_script(cs_tile_subject *subject, const cs_request *request) {
  cs_exit outcome = cs_script_open(subject->context, request, &subject->script);
  if (outcome == CS_EXIT_OK)
    outcome = cs_script_frame(&subject->script, request, &subject->frame);
  if (outcome == CS_EXIT_OK && subject->script.film.title)
    subject->title = subject->script.film.title;
  return outcome;
}

cs_exit cs_tile_subject_open(celspan_context *context, const cs_request *request,
                             cs_tile_subject *out) {
  const char *path = request->operands[0];
  *out = (cs_tile_subject){.context = context, .is_script = is_script(path), .title = out->name};
  set_name(path, out->name);
  return out->is_script ? open_script(out, request) : open_still(out, request);
}

void cs_tile_subject_close(cs_tile_subject *subject) {
  if (subject->is_script)
    cs_script_close(&subject->script);
  else
    cs_still_close(&subject->still);
}

void cs_tile_subject_background(const cs_tile_subject *subject, float out[4]) {
  const celspan_frame_desc *frame = &subject->frame;
  memset(out, 0, 4 * sizeof *out);
  for (size_t i = 0; subject->is_script && i < frame->exposure_count; i++) {
    const celspan_exposure *exposure = &frame->exposures[i];
    celspan_light back = cs_scene_back(exposure->rostrum, &exposure->rostrum->back).flat;
    const float light[4] = {back.r, back.g, back.b, back.a};
    for (int c = 0; c < 4; c++)
      out[c] += (float)exposure->weight * light[c];
  }
  if (out[3] > 1)
    out[3] = 1;
}

celspan_status cs_tile_subject_render(const cs_tile_subject *subject,
                                      const celspan_frame_desc *frame, const celspan_sink *sink) {
  return subject->is_script ? celspan_frame_render(subject->context, frame, sink, NULL)
                            : cs_still_render(subject->context, &subject->still, frame, sink);
}
