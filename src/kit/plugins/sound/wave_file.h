/* Samples as a WAV file: 16-bit numbers, or 32-bit floats.
 *
 * INVARIANT: the file appears under its name when it is whole, or not at all. A 16-bit sample is
 * the float times 32,768, rounded to the nearest number within -32,768 .. 32,767.
 */
#pragma once

#include "common/sound_stream.h"

/* The destination of a WAV file's bytes, in order. Errors of `put`: its own. */
typedef struct cs_wave_target {
  void *user;
  celspan_status (*put)(void *user, celspan_context *context, const void *bytes, size_t size);
} cs_wave_target;

/* The size in bytes of a file with this number of moments. */
int64_t cs_wave_file_size(const cs_sound_stream *samples, int64_t moments, bool is_float);
/* Writes the bytes of the file. *peak and errors: as below, and those of the target. name: of the
 * file in messages. */
CELSPAN_CHECKED celspan_status cs_wave_file_put(celspan_context *context, const char *name,
                                                const cs_wave_target *target,
                                                const cs_sound_stream *samples, int64_t moments,
                                                bool is_float, double *peak);
/* *peak: the greatest magnitude of a sample. Errors: those of the samples; OUTPUT; LIMIT, for more
 * than 4 GiB; NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_wave_file_write(celspan_context *context, const char *path,
                                                  const cs_sound_stream *samples, int64_t moments,
                                                  bool is_float, double *peak);
