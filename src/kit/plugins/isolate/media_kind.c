#include "plugins/isolate/media_kind.h"

#include <errno.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>
#include <sys/types.h>

#include "inside/files.h"

enum {
  HEAD = 192,
  PACKET = 188, /* bytes of a packet of a transport stream */
  TAG_HEAD = 10,
  BOTH = CS_MEDIA_SOUND | CS_MEDIA_MOVIE
};

/* Up to two marks of a container, and who reads it. A row without a name refuses. */
static const struct {
  struct {
    size_t offset;
    const char *bytes;
  } marks[2];
  const char *name;
  int uses;
} kinds[] = {
    {{{0, "RIFF"}, {8, "WAVE"}}, "wav", CS_MEDIA_SOUND},
    {{{0, "RF64"}, {8, "WAVE"}}, "wav", CS_MEDIA_SOUND},
    {{{0, "BW64"}, {8, "WAVE"}}, "wav", CS_MEDIA_SOUND},
    {{{0, "fLaC"}, {0, ""}}, "flac", CS_MEDIA_SOUND},
    {{{0, "OggS"}, {0, ""}}, "ogg", BOTH},
    {{{4, "ftyp"}, {8, "avif"}}, NULL, BOTH},
    {{{4, "ftyp"}, {8, "avis"}}, NULL, BOTH},
    {{{4, "ftyp"}, {8, "hei"}}, NULL, BOTH},
    {{{4, "ftyp"}, {8, "hev"}}, NULL, BOTH},
    {{{4, "ftyp"}, {8, "mif1"}}, NULL, BOTH},
    {{{4, "ftyp"}, {8, "msf1"}}, NULL, BOTH},
    {{{4, "ftyp"}, {8, "crx "}}, NULL, BOTH},
    {{{4, "ftyp"}, {0, ""}}, "mov", BOTH},
    {{{4, "moov"}, {0, ""}}, "mov", CS_MEDIA_MOVIE},
    {{{4, "mdat"}, {0, ""}}, "mov", CS_MEDIA_MOVIE},
    {{{4, "wide"}, {0, ""}}, "mov", CS_MEDIA_MOVIE},
    {{{0, "\x1a\x45\xdf\xa3"}, {0, ""}}, "matroska", BOTH},
    {{{0, "RIFF"}, {8, "AVI "}}, "avi", BOTH},
    {{{0, "\x06\x0e\x2b\x34"}, {0, ""}}, "mxf", BOTH},
    {{{0, "YUV4MPEG2 "}, {0, ""}}, "yuv4mpegpipe", CS_MEDIA_MOVIE},
    {{{0, "G"}, {PACKET, "G"}}, "mpegts", BOTH},
};

static bool has(const unsigned char *bytes, size_t offset, const char *mark) {
  return memcmp(bytes + offset, mark, strlen(mark)) == 0;
}

/* The header of a frame of MPEG audio, layer 3, whose version, bit rate and sampling rate exist. */
static bool is_mp3(const unsigned char *bytes) {
  return bytes[0] == 0xff && (bytes[1] & 0xe6) == 0xe2 && (bytes[1] & 0x18) != 0x08 &&
         (bytes[2] & 0xf0) != 0xf0 && (bytes[2] & 0x0c) != 0x0c;
}

static const char *kind_of(const unsigned char bytes[HEAD], cs_media_use use) {
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
    if (has(bytes, kinds[i].marks[0].offset, kinds[i].marks[0].bytes) &&
        has(bytes, kinds[i].marks[1].offset, kinds[i].marks[1].bytes))
      return kinds[i].uses & use ? kinds[i].name : NULL;
  return use == CS_MEDIA_SOUND && is_mp3(bytes) ? "mp3" : NULL;
}

/* Bytes of an ID3 tag, whose size has seven bits in each byte. */
static off_t tag_size(const unsigned char *tag) {
  off_t size = 0;
  for (int i = 6; i < TAG_HEAD; i++)
    size = size * 128 + (tag[i] & 0x7f);
  return size + TAG_HEAD + (tag[5] & 0x10 ? TAG_HEAD : 0);
}

/* Missing bytes of a shorter file are zeros. false: it cannot be read; else errno is 0, also if
 * reading was interrupted. */
static bool read_head(int descriptor, off_t offset, unsigned char out[HEAD]) {
  memset(out, 0, HEAD);
  bool is_read = cs_open_read_at(descriptor, out, HEAD, offset) >= 0;
  errno = is_read ? 0 : errno;
  return is_read;
}

const char *cs_media_kind(int descriptor, cs_media_use use) {
  unsigned char bytes[HEAD];
  if (!read_head(descriptor, 0, bytes))
    return NULL;
  if (use != CS_MEDIA_SOUND || !has(bytes, 0, "ID3"))
    return kind_of(bytes, use);
  if (!read_head(descriptor, tag_size(bytes), bytes))
    return NULL;
  return is_mp3(bytes) ? "mp3" : has(bytes, 0, "fLaC") ? "flac" : NULL;
}
