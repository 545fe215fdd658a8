/* The sounds of a script's film, mixed for videos and for `celspan sound`.
 *
 *   film --lua/module/heard.h--> a flat list --plugins/sound/mix.h--> stream
 */
#pragma once

#include "inside/films.h"
#include "lua/module/heard.h"
#include "program/film/script.h"

/* One of several files: the sounds of a name. */
typedef struct cs_stem {
  const char *name;
  double *gain; /* for --loudness, the same for all: below 0 until it is found for the first one */
} cs_stem;

/* Adds to a hash everything on which the sound depends: the sounds, and the sizes and times of
 * their files. Errors: those of celspan_lua_sounds. */
CELSPAN_CHECKED celspan_status cs_soundtrack_hash(cs_script *script, cs_hash *hash);
/* Finds the files and, if is_deep, decodes them up to the end of the film; OK without ffmpeg.
 * Errors: those of cs_mix_open. */
CELSPAN_CHECKED celspan_status cs_soundtrack_check(cs_script *script, bool is_deep);
/* The sounds of the film. They remain on the script's stack, and therefore live as long as the
 * script. Errors: those of celspan_lua_sounds. */
CELSPAN_CHECKED celspan_status cs_soundtrack_read(cs_script *script, cs_heard *out);
/* Mixes the sound of `count` frames from number `first` on; *moments: the number of moments.
 * Errors: those of celspan_lua_sounds and cs_mix_open. */
CELSPAN_CHECKED celspan_status cs_soundtrack_mix(cs_script *script, int64_t first, int64_t count,
                                                 cs_sound_stream *out, int64_t *moments);
/* Mixes the sound of a run of frames, as loud as --loudness says of all stems together. stem: the
 * only one that is heard; NULL: all. *moments: the number of moments. OK, or reported. */
cs_exit cs_soundtrack_open(cs_script *script, const cs_request *request, const cs_sequence *frames,
                           const cs_stem *stem, cs_sound_stream *out, int64_t *moments);
