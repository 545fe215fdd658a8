#include "plugins/sound/kind.h"

#include <string.h>

#include "base/open.h"

enum { HEAD = 12, TAG_HEAD = 10 };

static bool has(const unsigned char *bytes, size_t offset, const char *name) {
  return memcmp(bytes + offset, name, strlen(name)) == 0;
}

/* The header of a frame of MPEG audio, layer 3, whose version, bit rate and sampling rate exist. */
static bool is_mp3(const unsigned char *bytes) {
  return bytes[0] == 0xff && (bytes[1] & 0xe6) == 0xe2 && (bytes[1] & 0x18) != 0x08 &&
         (bytes[2] & 0xf0) != 0xf0 && (bytes[2] & 0x0c) != 0x0c;
}

static const char *kind_of(const unsigned char bytes[HEAD]) {
  bool is_riff = has(bytes, 0, "RIFF") || has(bytes, 0, "RF64") || has(bytes, 0, "BW64");
  if (is_riff && has(bytes, 8, "WAVE"))
    return "wav";
  if (has(bytes, 0, "fLaC"))
    return "flac";
  if (has(bytes, 0, "OggS"))
    return "ogg";
  if (has(bytes, 4, "ftyp"))
    return "mov";
  return is_mp3(bytes) ? "mp3" : NULL;
}

/* Bytes of an ID3 tag, whose size has seven bits in each byte. */
static off_t tag_size(const unsigned char *tag) {
  off_t size = 0;
  for (int i = 6; i < TAG_HEAD; i++)
    size = size * 128 + (tag[i] & 0x7f);
  return size + TAG_HEAD + (tag[5] & 0x10 ? TAG_HEAD : 0);
}

/* A file that is shorter counts as zeros. false: it cannot be read. */
static bool read_head(int descriptor, off_t offset, unsigned char out[HEAD]) {
  memset(out, 0, HEAD);
  return cs_open_read_at(descriptor, out, HEAD, offset) >= 0;
}

const char *cs_sound_kind(int descriptor) {
  unsigned char bytes[HEAD];
  errno = 0;
  if (!read_head(descriptor, 0, bytes))
    return NULL;
  if (!has(bytes, 0, "ID3"))
    return kind_of(bytes);
  if (!read_head(descriptor, tag_size(bytes), bytes))
    return NULL;
  return is_mp3(bytes) ? "mp3" : has(bytes, 0, "fLaC") ? "flac" : NULL;
}
