/* The sounds of a film, mixed: one stream of 48,000 moments in a second, with two channels.
 *
 *   film seconds   0      start       begin                    end
 *                  |        |---------|========================|----------
 *                           first     heard: its passages, its fades, its gains; lower
 *                           sample    while a sound is heard that ducks it
 *
 *   sounds --measured, when it is opened--> passages in samples --sum in double--> cs_sound_stream
 *
 * INVARIANT: all sounds were decoded to their end, or to that of the film, before the first moment
 * is given, so what cannot be read is refused before the first frame. A sample depends on the
 * sounds and its time alone, not on where the stream begins. A sound of which few samples are
 * needed is kept, for all parts that play it, so that its file is decoded once; of the others only
 * those are open that are heard now.
 */
#pragma once

#include "celspan/film.h"
#include "common/sound_stream.h"
#include "inside/hash.h"

enum {
  CS_MIX_RATE = 48000,
  CS_MIX_CHANNELS = 2,
  CS_MIX_OPEN = 64 /* sounds that are not kept may be heard at the same time */
};

typedef struct cs_mix_sound {
  const char *path;  /* the path of a file, or an address that contains it */
  const char *tried; /* another path that does not exist either, or NULL */
  const char *stem;  /* the name of the part of the mix that it belongs to */
  double start;      /* second of the film at which the first sample would be heard */
  double speed;      /* above 0 */
  double from;       /* the seconds of the file that are skipped, for messages */
  int number;        /* in the film's list, for messages */
  double gain[CS_MIX_CHANNELS];
  /* Of the sound itself, then of the films around it: all must be open. */
  const celspan_sound_passage *passages;
  size_t passage_count;
  const celspan_sound_ducker *duckers;
  size_t ducker_count;
} cs_mix_sound;

/* Checks that all files exist and have a format that can be read. Errors: INPUT. */
CELSPAN_CHECKED celspan_status cs_mix_find(celspan_context *context, const cs_mix_sound *sounds,
                                           size_t count);
/* Adds to a hash everything on which the mix depends: the sounds, and names, sizes and times of
 * their files. */
void cs_mix_hash(cs_hash *hash, const cs_mix_sound *sounds, size_t count);
/* The mix from second `begin` of the film, `moments` of them. sounds: copied, except their paths,
 * passages and duckers, which are borrowed until it is closed. Errors: those of cs_sound_open. */
CELSPAN_CHECKED celspan_status cs_mix_open(celspan_context *context, const cs_mix_sound *sounds,
                                           size_t count, double begin, int64_t moments,
                                           cs_sound_stream *out);
