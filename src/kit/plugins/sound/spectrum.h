/* How loud a sound is in bands of frequency, a hundred times a second.
 *
 *   samples --a window around each step--> Fourier transform --> power by frequency --> bands
 *
 *   40 Hz |  |  |  |  | ... 96 bands, each 1.064 times as wide as the one before ... |  | 16 kHz
 *
 * A level is in quarters of a decibel above -60, of the mean power of the channels: a sine of full
 * scale in all channels has 240, which is 0 dB. A window has 0.043 s, so that sines less than 50 Hz
 * apart are not told apart: below 400 Hz, neighbouring bands share what is near.
 */
#pragma once

#include "common/sound_stream.h"

enum { CS_SPECTRUM_BANDS = 96, CS_SPECTRUM_STEP = 480 /* moments, of 48,000 in a second */ };

typedef struct cs_spectrum_step {
  unsigned char levels[CS_SPECTRUM_BANDS];
} cs_spectrum_step;

typedef struct cs_spectrum {
  cs_spectrum_step *steps; /* owned; steps[i] is around i hundredths of a second */
  size_t count, capacity;
} cs_spectrum;

/* Decodes the sound. tried: another path that does not exist either, or NULL. out: new, for
 * cs_spectrum_finish. Errors: those of cs_sound_open; LIMIT beyond 24 hours. */
CELSPAN_CHECKED celspan_status cs_spectrum_measure(celspan_context *context, const char *path,
                                                   const char *tried, cs_spectrum *out);
void cs_spectrum_finish(cs_spectrum *spectrum, celspan_context *context);
