/* celspan sound SCRIPT -o mix.wav: the mixed sound of a film, or of a run of its frames.
 *
 *   --stems -o mix.{name}.wav    mix.voice.wav, mix.music.wav, mix.rest.wav: they add up to the mix
 */
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "inside/context.h"
#include "inside/files.h"
#include "inside/films.h"
#include "inside/sinks.h"
#include "plugins/sound/wave_file.h"
#include "program/film/soundtrack.h"
#include "program/options/progress.h"
#include "program/options/verbs.h"
#include "program/outputs/outputs.h"
#include "program/outputs/whole.h"

#define PLACE "{name}" /* of the name of a stem */

static cs_exit refuse_stems(const cs_request *request, const char *output) {
  if (!cs_request_has(request, "--stems"))
    return CS_EXIT_OK;
  if (!strstr(output, PLACE))
    return cs_report_usage("%s: --stems writes several files: put " PLACE " into the name, as in "
                           "mix." PLACE ".wav",
                           output);
  if (cs_request_has(request, "--resume"))
    return cs_report_usage("--stems and --resume exclude each other: give one of them");
  return CS_EXIT_OK;
}

static cs_exit refuse_request(const cs_script *script, const cs_request *request, bool *is_float) {
  const char *output = cs_request_text(request, "-o");
  celspan_depth depth = CELSPAN_DEPTH_DEFAULT;
  cs_request_read(request, "--depth", &depth);
  *is_float = depth == CELSPAN_DEPTH_FLOAT;
  if (!output)
    return cs_report_usage("-o is missing: the file to write, such as mix.wav");
  if (strcasecmp(cs_file_ending(output), "wav") != 0)
    return cs_report_usage("%s: a sound is written as WAV: give a name such as mix.wav", output);
  if (depth != CELSPAN_DEPTH_DEFAULT && depth != CELSPAN_DEPTH_16 && !*is_float)
    return cs_report_usage("%s: a sound takes --depth 16 or float", output);
  if (cs_request_has(request, "--keep-going"))
    return cs_report_usage("--keep-going is about the rows of a table: give --table, or leave it "
                           "out");
  CS_TRY_EXIT(refuse_stems(request, output));
  if (!script->film.has_sound)
    return cs_report_usage("%s: the film has no sound", request->operands[0]);
  return CS_EXIT_OK;
}

static void report_peak(const char *output, double peak, bool is_float) {
  if (peak > 1)
    cs_report_note("%s: the mix is up to %.1f dB louder than full scale%s: lower the gain of its "
                   "sounds",
                   output, 20 * log10(peak), is_float ? "" : ", and cut there");
}

/* stem: the only one that is heard; NULL: all. */
static cs_exit write_file(cs_script *script, const cs_request *request, const cs_sequence *frames,
                          const cs_stem *stem, const char *output, bool is_float) {
  cs_sound_stream samples;
  int64_t moments;
  double peak = 0;
  cs_temporary_sweep(output, cs_sequence_matches);
  CS_TRY_EXIT(cs_soundtrack_open(script, request, frames, stem, &samples, &moments));
  celspan_status status =
      cs_wave_file_write(script->context, output, &samples, moments, is_float, &peak);
  cs_sound_stream_close(&samples);
  if (status == CELSPAN_OK)
    report_peak(output, peak, is_float);
  return cs_report_failure(script->context, status, NULL);
}

static cs_exit write_mix(cs_script *script, const cs_request *request, const cs_sequence *frames,
                         bool is_float, cs_file_contents *contents) {
  script->context->contents = contents;
  cs_exit outcome =
      write_file(script, request, frames, NULL, cs_request_text(request, "-o"), is_float);
  script->context->contents = NULL;
  return outcome;
}

/* ---------------------------------------------------------------- --stems */

/* Replaces the place in the output by the name of the stem. */
static cs_exit name_stem(const char *output, const char *stem, char path[PATH_MAX]) {
  const char *place = strstr(output, PLACE);
  if (stem[0] == '\0' || strchr(stem, '/') || strcmp(stem, "..") == 0)
    return cs_report_usage("--stems: the sound '%s' needs a name without / for its file", stem);
  int size = snprintf(path, PATH_MAX, "%.*s%s%s", (int)(place - output), output, stem,
                      place + sizeof PLACE - 1);
  return size < PATH_MAX
             ? CS_EXIT_OK
             : cs_report_usage("%s: the name of the stem '%s' would be too long", output, stem);
}

/* Whether an earlier sound has the same stem. */
static bool is_known(const cs_heard *track, size_t place) {
  for (size_t i = 0; i < place; i++)
    if (strcmp(track->sounds[i].stem, track->sounds[place].stem) == 0)
      return true;
  return false;
}

static cs_exit write_stems(cs_script *script, const cs_request *request, const cs_sequence *frames,
                           bool is_float) {
  cs_heard track;
  char path[PATH_MAX];
  double gain = -1;
  celspan_status status = cs_soundtrack_read(script, &track);
  CS_TRY_EXIT(cs_report_failure(script->context, status, NULL));
  for (size_t i = 0; i < track.count; i++)
    CS_TRY_EXIT(name_stem(cs_request_text(request, "-o"), track.sounds[i].stem, path));
  for (size_t i = 0; i < track.count; i++) {
    if (is_known(&track, i))
      continue;
    CS_TRY_EXIT(name_stem(cs_request_text(request, "-o"), track.sounds[i].stem, path));
    const cs_stem stem = {track.sounds[i].stem, &gain};
    CS_TRY_EXIT(write_file(script, request, frames, &stem, path, is_float));
  }
  return CS_EXIT_OK;
}

/* ---------------------------------------------------------------- --resume */

static cs_exit keep_or_write(cs_whole *whole, cs_script *script, const cs_request *request,
                             const cs_sequence *frames, bool is_float) {
  celspan_status status = cs_whole_begin(whole, script, request, frames);
  CS_TRY_EXIT(cs_report_failure(script->context, status, NULL));
  if (cs_whole_is_kept(whole))
    return CS_EXIT_OK;
  CS_TRY_EXIT(write_mix(script, request, frames, is_float, &whole->file.contents));
  return cs_report_failure(script->context, cs_whole_finish(whole), NULL);
}

static cs_exit resume(cs_script *script, const cs_request *request, const cs_sequence *frames,
                      bool is_float, bool *is_kept) {
  cs_whole whole;
  celspan_frame_desc no_frame = CELSPAN_FRAME_DESC;
  celspan_status status = cs_whole_open(&whole, script, request, &no_frame);
  cs_exit outcome = cs_report_failure(script->context, status, NULL);
  if (outcome == CS_EXIT_OK)
    outcome = keep_or_write(&whole, script, request, frames, is_float);
  *is_kept = whole.file.way == CS_SHOOT_KEPT;
  cs_whole_close(&whole);
  return outcome;
}

static cs_exit make(cs_script *script, const cs_request *request, const cs_sequence *frames,
                    bool is_float) {
  bool is_kept = false;
  cs_progress progress;
  cs_progress_start(&progress, request, CS_PROGRESS_NONE, 1);
  progress.noun = "sound";
  cs_exit outcome =
      cs_request_has(request, "--resume")  ? resume(script, request, frames, is_float, &is_kept)
      : cs_request_has(request, "--stems") ? write_stems(script, request, frames, is_float)
                                           : write_mix(script, request, frames, is_float, NULL);
  if (outcome == CS_EXIT_OK)
    cs_progress_frame(&progress, 1, cs_request_text(request, "-o"), is_kept ? "kept" : "made");
  cs_progress_end(&progress, (cs_progress_failures){NULL, 0}, (int)outcome);
  return outcome;
}

static cs_exit run(cs_script *script, const cs_request *request) {
  bool is_float;
  cs_sequence frames = {0};
  CS_TRY_EXIT(refuse_request(script, request, &is_float));
  cs_exit outcome = cs_output_frames(script, request, NULL, &frames);
  if (outcome == CS_EXIT_OK)
    outcome = make(script, request, &frames, is_float);
  cs_sequence_finish(&frames);
  return outcome;
}

cs_exit cs_verb_sound(celspan_context *context, const cs_request *request) {
  return cs_script_run(context, request, run);
}
