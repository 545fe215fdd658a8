#include "program/soundtrack.h"

#include <math.h>

#include "lua/module/heard.h"

/* The sounds of the film. They remain on the script's stack, and therefore live as long as the
 * script. */
static celspan_status read_sounds(cs_script *script, cs_heard *out) {
  return cs_heard_push(script->L, CS_SCRIPT_FILM, out);
}

celspan_status cs_soundtrack_hash(cs_script *script, cs_hash *hash) {
  cs_heard track;
  CS_TRY(read_sounds(script, &track));
  cs_mix_hash(hash, track.sounds, track.count);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- mixing */

static int64_t moments_of(double seconds) { return llround(seconds * CS_MIX_RATE); }

celspan_status cs_soundtrack_check(cs_script *script, bool is_deep) {
  cs_heard track;
  cs_sound_stream samples = {.user = NULL};
  const cs_film_info *film = &script->film;
  CS_TRY(read_sounds(script, &track));
  if (!is_deep)
    return cs_mix_find(script->context, track.sounds, track.count);
  celspan_status status =
      cs_mix_open(script->context, track.sounds, track.count, 0,
                  moments_of((double)film->count / film->frames_second), &samples);
  cs_sound_stream_close(&samples);
  return status == CELSPAN_OUTPUT ? CELSPAN_OK : status;
}

celspan_status cs_soundtrack_mix(cs_script *script, int64_t first, int64_t count,
                                 cs_sound_stream *out, int64_t *moments) {
  cs_heard track;
  double rate = script->film.frames_second;
  *moments = moments_of((double)count / rate);
  CS_TRY(read_sounds(script, &track));
  return cs_mix_open(script->context, track.sounds, track.count,
                     (double)(first - script->film.first) / rate, *moments, out);
}

cs_exit cs_soundtrack_open(cs_script *script, const cs_request *request, const cs_sequence *frames,
                           cs_sound_stream *out, int64_t *moments) {
  if (!cs_sequence_is_run(frames))
    return cs_report_usage("--frames %s: the film has a sound, which goes with one run of frames "
                           "such as 10-20",
                           cs_request_text(request, "--frames"));
  celspan_status status =
      cs_soundtrack_mix(script, frames->frames[0], (int64_t)frames->count, out, moments);
  return cs_report_failure(script->context, status, NULL);
}
