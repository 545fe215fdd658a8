/* How loud a sound is, moment by moment, as ITU-R BS.1770-4 and EBU R 128 measure it.
 *
 *   samples --two filters that imitate the head and the ear--> squares, weighted by channel
 *           --added up--> one sum for each hundredth of a second
 *
 * The loudness of a part is -0.691 + 10 log10(its sum / its moments) LUFS; "momentary" is that of
 * the last 0.4 seconds. The loudness of a whole is the mean of all 0.4 seconds, one every 0.1, that
 * are above -70 LUFS and not more than 10 LU below the mean of these.
 */
#pragma once

#include "common/sound_stream.h"

enum { CS_LOUDNESS_STEP = 480 /* moments of a sum */ };

typedef struct cs_loudness {
  double *sums; /* owned; sums[i]: of all moments before step i; sums[0] is 0 */
  size_t count, capacity;
  int64_t moments;
  double peak; /* the greatest sample, without its sign */
} cs_loudness;

/* Decodes the sound. tried: another path that does not exist either, or NULL. out: new, for
 * cs_loudness_finish. Errors: those of cs_sound_open; LIMIT. */
CELSPAN_CHECKED celspan_status cs_loudness_measure(celspan_context *context, const char *path,
                                                   const char *tried, cs_loudness *out);
/* The same for a stream of CS_SOUND_HEARD_RATE, which is read to its end. name: for messages. */
CELSPAN_CHECKED celspan_status cs_loudness_hear(celspan_context *context,
                                                const cs_sound_stream *samples, const char *name,
                                                cs_loudness *out);
/* The factor with which the whole sound has the loudness `lufs`; 0 if it is silent. */
double cs_loudness_gain(const cs_loudness *loudness, double lufs);
void cs_loudness_finish(cs_loudness *loudness, celspan_context *context);

/* ---- amplify.c */

/* Multiplies all samples of a stream, which is moved into the new one. Closes it on failure.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_amplify(celspan_context *context, cs_sound_stream *samples,
                                          double gain);
