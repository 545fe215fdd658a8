#include "plugins/sound/wave.h"

#include <string.h>

#include "frames/video/sound_stream.h"

enum {
  EXTENSIBLE = 0xfffe, /* the form is in a longer chunk, which has the places */
  FORM = 40,           /* bytes of that chunk */
  PLAIN_FORM = 16,     /* the fewest bytes of the chunk */
  CHUNK_MOST = 4096,   /* bytes of other chunks before the samples */
  CHUNKS_MOST = 16
};

/* Samples are floats: the identifier's first word is the plain number of the form. */
static const unsigned char FLOATS[16] = {3,    0, 0, 0,    0, 0,    0x10, 0,
                                         0x80, 0, 0, 0xaa, 0, 0x38, 0x9b, 0x71};

static uint32_t get(const unsigned char *at, int bytes) {
  uint32_t value = 0;
  for (int i = 0; i < bytes; i++)
    value |= (uint32_t)at[i] << (8 * i);
  return value;
}

static bool read_form(const unsigned char *form, uint32_t size, cs_wave *out) {
  bool is_longer = get(form, 2) == EXTENSIBLE;
  if (size < PLAIN_FORM || (is_longer && size < FORM))
    return false;
  uint32_t channels = get(form + 2, 2), rate = get(form + 4, 4);
  *out = (cs_wave){.rate = rate <= CS_SOUND_STREAM_RATE ? (int32_t)rate : 0,
                   .channels = channels <= CS_SOUND_STREAM_CHANNELS ? (int32_t)channels : 0,
                   .places = is_longer ? get(form + 20, 4) : 0};
  bool is_float = is_longer ? memcmp(form + 24, FLOATS, sizeof FLOATS) == 0 : get(form, 2) == 3;
  return is_float && get(form + 14, 2) == 32 && out->rate > 0 && out->channels > 0;
}

bool cs_wave_read(cs_wave *out, bool (*read)(void *user, unsigned char *bytes, size_t size),
                  void *user) {
  unsigned char head[12], chunk[CHUNK_MOST];
  *out = (cs_wave){0};
  if (!read(user, head, 12) || memcmp(head, "RIFF", 4) != 0 || memcmp(head + 8, "WAVE", 4) != 0)
    return false;
  for (int i = 0; i < CHUNKS_MOST; i++) {
    if (!read(user, head, 8))
      return false;
    uint32_t size = get(head + 4, 4);
    if (memcmp(head, "data", 4) == 0)
      return out->rate > 0;
    if (size > CHUNK_MOST || !read(user, chunk, size + size % 2))
      return false;
    if (memcmp(head, "fmt ", 4) == 0 && !read_form(chunk, size, out))
      return false;
  }
  return false;
}
