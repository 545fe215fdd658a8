/* The beginning of a WAV file of 32-bit float samples without a known end: the form in which
 * samples come through a pipe from ffmpeg.
 *
 *   "RIFF" size "WAVE" | "fmt " size, form of the samples | ... | "data" size | samples
 *
 * INVARIANT: sizes of the whole are not read, because a pipe has none; all other numbers are
 * checked.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct cs_wave {
  int32_t rate, channels;
  uint32_t places; /* see frames/video/sound_stream.h */
} cs_wave;

/* Reads the beginning, up to the first sample, by `read`, which is false if there are no `size`
 * more bytes. false: they are missing, or not in this form. */
bool cs_wave_read(cs_wave *out, bool (*read)(void *user, unsigned char *bytes, size_t size),
                  void *user);
