#include "plugins/sound/sound.h"

#include <fcntl.h>
#include <stddef.h>
#include <string.h>
#include <sys/stat.h>

#include "base/open.h"

/* ---------------------------------------------------------------- formats */

/* The formats of sounds, found from the first bytes of a file, whatever its name.
 *
 *   format      first bytes                                  in ffmpeg
 *   wav         RIFF, RF64 or BW64, a size, WAVE             wav
 *   flac        fLaC                                         flac
 *   ogg, opus   OggS                                         ogg
 *   m4a, mp4    a size, ftyp                                 mov
 *   mkv, webm   1a 45 df a3                                  matroska
 *   avi         RIFF, a size, AVI                            avi
 *   mp3         the header of a frame of layer 3             mp3
 *   mp3, flac   ID3, with a tag before one of the two        mp3, flac
 *
 * INVARIANT: all other files are refused, above all lists of files, addresses and texts.
 */

#define KINDS "wav, mp3, flac, ogg, opus or m4a"

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
  if (has(bytes, 0, "\x1a\x45\xdf\xa3"))
    return "matroska";
  if (has(bytes, 0, "RIFF") && has(bytes, 8, "AVI "))
    return "avi";
  return is_mp3(bytes) ? "mp3" : NULL;
}

/* Bytes of an ID3 tag, whose size has seven bits in each byte. */
static off_t tag_size(const unsigned char *tag) {
  off_t size = 0;
  for (int i = 6; i < TAG_HEAD; i++)
    size = size * 128 + (tag[i] & 0x7f);
  return size + TAG_HEAD + (tag[5] & 0x10 ? TAG_HEAD : 0);
}

/* Missing bytes of a shorter file are zeros. false: it cannot be read. */
static bool read_head(int descriptor, off_t offset, unsigned char out[HEAD]) {
  memset(out, 0, HEAD);
  return cs_open_read_at(descriptor, out, HEAD, offset) >= 0;
}

/* ffmpeg's name for the format of the file behind the descriptor; NULL: it is of another format,
 * or, with errno not 0, it cannot be read. */
static const char *find_kind(int descriptor) {
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

/* ---------------------------------------------------------------- finding */

static celspan_status refuse_opening(celspan_context *context, const char *path, const char *tried,
                                     int error) {
  return cs_fail(context, CELSPAN_INPUT, "the sound %s cannot be opened: %s%s%s", path,
                 strerror(error), tried ? "; also looked for at " : "", tried ? tried : "");
}

/* *kind: its format. The descriptor is not one of the standard streams. */
static celspan_status recognize(celspan_context *context, const char *path, int descriptor,
                                const char **kind) {
  struct stat found;
  if (fstat(descriptor, &found) != 0)
    return refuse_opening(context, path, NULL, errno);
  if (S_ISDIR(found.st_mode))
    return refuse_opening(context, path, NULL, EISDIR);
  if (!S_ISREG(found.st_mode))
    return cs_fail(context, CELSPAN_INPUT, "the sound %s is not a file; a sound must be one", path);
  *kind = find_kind(descriptor);
  if (!*kind && errno)
    return cs_fail(context, CELSPAN_INPUT, "the sound %s cannot be read: %s", path,
                   strerror(errno));
  if (!*kind)
    return cs_fail(context, CELSPAN_INPUT,
                   "the sound %s has none of the formats that are read, which are found by the "
                   "first bytes of a file and not by its name: convert it to " KINDS,
                   path);
  return CELSPAN_OK;
}

/* *descriptor: of the sound; *kind: its format; both are set if the result is OK. */
static celspan_status open_file(celspan_context *context, const char *path, const char *tried,
                                int *descriptor, const char **kind) {
  *descriptor = cs_open_to_read(path);
  if (*descriptor < 0)
    return refuse_opening(context, path, tried, errno);
  celspan_status status = recognize(context, path, *descriptor, kind);
  if (status != CELSPAN_OK)
    close(*descriptor);
  return status;
}

celspan_status cs_sound_find(celspan_context *context, const char *path, const char *tried) {
  const char *kind;
  int descriptor;
  CS_TRY(open_file(context, path, tried, &descriptor, &kind));
  close(descriptor);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- decoding */

celspan_status cs_sound_open(celspan_context *context, const cs_sound_request *request,
                             cs_sound_stream *out) {
  const char *kind;
  int descriptor;
  *out = (cs_sound_stream){.user = NULL};
  CS_TRY(open_file(context, request->path, NULL, &descriptor, &kind));
  const cs_decoder_desc desc = {.path = request->path,
                                .kind = kind,
                                .descriptor = descriptor,
                                .rate = request->rate,
                                .channels = request->channels,
                                .speed = request->speed > 0 ? request->speed : 1};
  celspan_status status = cs_decoder_open(context, &desc, out);
  close(descriptor);
  return status;
}
