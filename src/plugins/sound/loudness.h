/* How loud a sound is, moment by moment, as ITU-R BS.1770-4 and EBU R 128 measure it.
 *
 *   samples --two filters that imitate the head and the ear--> squares, weighted by channel
 *           --added up--> one sum for each hundredth of a second
 *
 * The loudness of a part is -0.691 + 10 log10(its sum / its moments) LUFS; "momentary" is that of
 * the last 0.4 seconds.
 */
#pragma once

#include "base/context.h"

enum {
  CS_LOUDNESS_RATE = 48000,
  CS_LOUDNESS_STEP = 480, /* moments of a sum */
  CS_LOUDNESS_HOURS = 24  /* the longest sound */
};

typedef struct cs_loudness {
  double *sums; /* owned; sums[i]: of all moments before step i; sums[0] is 0 */
  size_t count, capacity;
  int64_t moments;
} cs_loudness;

/* Decodes the sound. tried: another path that does not exist either, or NULL. out: new, for
 * cs_loudness_finish. Errors: those of cs_sound_open; LIMIT. */
CELSPAN_CHECKED celspan_status cs_loudness_measure(celspan_context *context, const char *path,
                                                   const char *tried, cs_loudness *out);
void cs_loudness_finish(cs_loudness *loudness, celspan_context *context);
