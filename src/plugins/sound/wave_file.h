/* Samples as a WAV file: 16-bit numbers, or 32-bit floats.
 *
 * INVARIANT: the file appears under its name when it is whole, or not at all. A 16-bit sample is
 * the float times 32,768, rounded to the nearest number within -32,768 .. 32,767.
 */
#pragma once

#include "frames/video/sound_stream.h"

/* *peak: the greatest magnitude of a sample. Errors: those of the samples; OUTPUT; LIMIT, for more
 * than 4 GiB; NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_wave_file_write(celspan_context *context, const char *path,
                                                  const cs_sound_stream *samples, int64_t moments,
                                                  bool is_float, double *peak);
