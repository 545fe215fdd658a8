#include "program/film/shown.h"

#include "lua/module/artwork.h"
#include "program/film/script.h"
#include "program/film/view.h"

/* ---------------------------------------------------------------- drawings and paintings */

bool cs_shown_is_film(const char *path) {
  cs_artwork artwork = cs_artwork_of(path);
  return artwork == CS_ARTWORK_ARCHIVE || artwork == CS_ARTWORK_SVG;
}

/* The frame of a film, which has one exposure. */
static cs_still still_of(const cs_script *script) {
  cs_still still = {.exposure = script->frame.exposures[0], .space = script->film.space};
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  cs_film_expose(&script->film, &script->frame, &frame);
  celspan_rostrum_ref(still.exposure.rostrum);
  still.info = (celspan_picture_info){.width = script->film.width,
                                      .height = script->film.height,
                                      .channels = 4,
                                      .has_alpha = !celspan_frame_is_opaque(&frame),
                                      .format = "artwork",
                                      .colour = "srgb"};
  return still;
}

static cs_exit open_artwork(celspan_context *context, const cs_request *request, const char *path,
                            int32_t frame, cs_still *out) {
  cs_script script;
  cs_exit outcome = cs_script_open(context, request, path, false, &script);
  const int64_t count = outcome == CS_EXIT_OK ? script.film.count : 0;
  if (outcome == CS_EXIT_OK && frame > count)
    outcome =
        count == 1
            ? cs_report_usage("%s: there is no frame %d: it has only frame 1", path, (int)frame)
            : cs_report_usage("%s: there is no frame %d: it has %d", path, (int)frame, (int)count);
  if (outcome == CS_EXIT_OK)
    outcome = cs_script_build(&script, script.film.first + (frame > 0 ? frame - 1 : 0));
  if (outcome == CS_EXIT_OK)
    *out = still_of(&script);
  cs_script_close(&script);
  return outcome;
}

/* ---------------------------------------------------------------- all files */

cs_exit cs_shown_open(celspan_context *context, const cs_request *request, const char *path,
                      bool has_frames, cs_still *out) {
  int32_t frame = 0;
  bool has_frame = has_frames && cs_request_read(request, "--frame", &frame);
  if (has_frame && frame < 1)
    return cs_report_usage("--frame %d: frames of a plane file are numbered from 1", (int)frame);
  if (cs_shown_is_film(path))
    return open_artwork(context, request, path, frame, out);
  celspan_status status = cs_still_open(context, path, frame, out);
  if (status == CELSPAN_OK && cs_artwork_of(path) == CS_ARTWORK_PSD)
    cs_report_note("%s: its merged picture is taken; 'celspan render' shows its layers", path);
  if (status == CELSPAN_BAD_ARGUMENT && has_frame)
    return cs_report_usage("%s", celspan_context_error(context));
  return cs_report_failure(context, status, NULL);
}

cs_exit cs_shown_frame(const cs_request *request, const cs_still *still, celspan_frame_desc *out) {
  cs_exit outcome = cs_view_frame(request, still->info.width, still->info.height, out);
  cs_still_expose(still, out);
  return outcome;
}
