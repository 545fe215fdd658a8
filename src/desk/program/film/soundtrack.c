#include "program/film/soundtrack.h"

#include <math.h>
#include <string.h>

#include "plugins/sound/loudness.h"

celspan_status cs_soundtrack_read(cs_script *script, cs_heard *out) {
  return cs_heard_push(script->L, CS_SCRIPT_FILM, out);
}

celspan_status cs_soundtrack_hash(cs_script *script, cs_hash *hash) {
  cs_heard track;
  CS_TRY(cs_soundtrack_read(script, &track));
  cs_mix_hash(hash, track.sounds, track.count);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- mixing */

static int64_t moments_of(double seconds) { return llround(seconds * CS_MIX_RATE); }

celspan_status cs_soundtrack_check(cs_script *script, bool is_deep) {
  cs_heard track;
  cs_sound_stream samples = {.user = NULL};
  const cs_film_info *film = &script->film;
  CS_TRY(cs_soundtrack_read(script, &track));
  if (!is_deep)
    return cs_mix_find(script->context, track.sounds, track.count);
  celspan_status status =
      cs_mix_open(script->context, track.sounds, track.count, 0,
                  moments_of((double)film->count / film->frames_second), &samples);
  cs_sound_stream_close(&samples);
  return status == CELSPAN_OUTPUT ? CELSPAN_OK : status;
}

static celspan_status open_track(cs_script *script, const cs_heard *track, int64_t first,
                                 int64_t moments, cs_sound_stream *out) {
  return cs_mix_open(script->context, track->sounds, track->count,
                     (double)(first - script->film.first) / script->film.frames_second, moments,
                     out);
}

celspan_status cs_soundtrack_mix(cs_script *script, int64_t first, int64_t count,
                                 cs_sound_stream *out, int64_t *moments) {
  cs_heard track;
  *moments = moments_of((double)count / script->film.frames_second);
  CS_TRY(cs_soundtrack_read(script, &track));
  return open_track(script, &track, first, *moments, out);
}

/* Mixes one stem. The other sounds are silent, but lower the stem as in the whole mix. */
static celspan_status mix_stem(cs_script *script, int64_t first, int64_t moments, const char *stem,
                               cs_sound_stream *out) {
  cs_heard track;
  celspan_context *context = script->context;
  CS_TRY(cs_soundtrack_read(script, &track));
  cs_mix_sound *sounds;
  CS_TRY(CS_MAKE(context, sounds, track.count));
  memcpy(sounds, track.sounds, track.count * sizeof *sounds);
  for (size_t i = 0; i < track.count; i++)
    if (strcmp(sounds[i].stem, stem) != 0)
      memset(sounds[i].gain, 0, sizeof sounds[i].gain);
  const cs_heard one = {.sounds = sounds, .count = track.count};
  celspan_status status = open_track(script, &one, first, moments, out);
  cs_mem_free(context->memory, sounds, track.count * sizeof *sounds);
  return status;
}

/* ---------------------------------------------------------------- --loudness */

/* The factor for the loudness. *out: a stream that was read to its end; closed. */
static celspan_status find_gain(cs_script *script, const char *film, double lufs,
                                cs_sound_stream *samples, double *gain) {
  cs_loudness loudness;
  celspan_status status = cs_loudness_hear(script->context, samples, film, &loudness);
  cs_sound_stream_close(samples);
  CS_TRY(status);
  *gain = cs_loudness_gain(&loudness, lufs);
  if (*gain == 0)
    cs_report_note("%s: the sound is silent, and stays so with --loudness", film);
  else if (*gain * loudness.peak > 1)
    cs_report_note("%s: with --loudness %g the sound is up to %.1f dB louder than full scale, and "
                   "cut there where the file holds no more",
                   film, lufs, 20 * log10(*gain * loudness.peak));
  cs_loudness_finish(&loudness, script->context);
  return CELSPAN_OK;
}

/* Mixes the sound, and hears it to its end, where its loudness is given. *gain: 0 without. */
static celspan_status hear_gain(cs_script *script, const cs_request *request,
                                const cs_sequence *frames, double *gain) {
  cs_sound_stream whole;
  int64_t unused;
  double lufs;
  *gain = 0;
  if (!cs_request_read(request, "--loudness", &lufs))
    return CELSPAN_OK;
  CS_TRY(cs_soundtrack_mix(script, frames->frames[0], (int64_t)frames->count, &whole, &unused));
  return find_gain(script, request->operands[0], lufs, &whole, gain);
}

static celspan_status open_mix(cs_script *script, const cs_request *request,
                               const cs_sequence *frames, const cs_stem *stem, cs_sound_stream *out,
                               int64_t *moments) {
  int64_t first = frames->frames[0], count = (int64_t)frames->count;
  double own = -1, *gain = stem ? stem->gain : &own;
  *moments = moments_of((double)count / script->film.frames_second);
  if (*gain < 0)
    CS_TRY(hear_gain(script, request, frames, gain));
  CS_TRY(stem ? mix_stem(script, first, *moments, stem->name, out)
              : cs_soundtrack_mix(script, first, count, out, moments));
  return *gain == 0 ? CELSPAN_OK : cs_amplify(script->context, out, *gain);
}

cs_exit cs_soundtrack_open(cs_script *script, const cs_request *request, const cs_sequence *frames,
                           const cs_stem *stem, cs_sound_stream *out, int64_t *moments) {
  if (!cs_sequence_is_run(frames))
    return cs_report_usage("--frames %s: the film has a sound, which goes with one run of frames "
                           "such as 10-20",
                           cs_request_text(request, "--frames"));
  celspan_status status = open_mix(script, request, frames, stem, out, moments);
  return cs_report_failure(script->context, status, NULL);
}
