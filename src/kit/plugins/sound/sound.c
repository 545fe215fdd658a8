#include "plugins/sound/sound.h"

#include <fcntl.h>
#include <stddef.h>
#include <string.h>
#include <sys/stat.h>

#include "common/address.h"
#include "inside/files.h"
#include "plugins/isolate/media_kind.h"

/* ---------------------------------------------------------------- finding */

const char *cs_sound_name(const char *path) { return cs_address_is_data(path) ? "data:..." : path; }

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
  *kind = cs_media_kind(descriptor, CS_MEDIA_SOUND);
  if (!*kind && errno)
    return cs_fail(context, CELSPAN_INPUT, "the sound %s cannot be read: %s", path,
                   strerror(errno));
  if (!*kind)
    return cs_fail(context, CELSPAN_INPUT,
                   "the sound %s has none of the formats that are read, which are found by the "
                   "first bytes of a file and not by its name: convert it to " CS_MEDIA_SOUNDS,
                   path);
  return CELSPAN_OK;
}

/* *descriptor: of a file in memory that has the bytes of an address. */
static celspan_status open_data(celspan_context *context, const char *address, int *descriptor) {
  cs_address_data data;
  bool is_broken = false;
  celspan_status status = cs_address_read(context, address, &data, &is_broken);
  if (status == CELSPAN_OK && is_broken)
    status = cs_fail(context, CELSPAN_INPUT,
                     "the sound %s is damaged: it must have a comma, and behind it base64 or bytes",
                     cs_sound_name(address));
  *descriptor = status == CELSPAN_OK ? cs_address_file(data.bytes, data.size) : -1;
  if (status == CELSPAN_OK && *descriptor < 0)
    status = refuse_opening(context, cs_sound_name(address), NULL, errno);
  cs_address_finish(&data, context);
  return status;
}

/* *descriptor: of the sound; *kind: its format; both are set if the result is OK. */
static celspan_status open_file(celspan_context *context, const char *path, const char *tried,
                                int *descriptor, const char **kind) {
  if (cs_address_is_data(path))
    CS_TRY(open_data(context, path, descriptor));
  else if ((*descriptor = cs_open_to_read(path)) < 0)
    return refuse_opening(context, path, tried, errno);
  celspan_status status = recognize(context, cs_sound_name(path), *descriptor, kind);
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
  CS_TRY(open_file(context, request->path, request->tried, &descriptor, &kind));
  const cs_decoder_desc desc = {.path = cs_sound_name(request->path),
                                .kind = kind,
                                .descriptor = descriptor,
                                .rate = request->rate,
                                .channels = request->channels,
                                .speed = request->speed > 0 ? request->speed : 1};
  celspan_status status = cs_decoder_open(context, &desc, out);
  close(descriptor);
  return status;
}

/* ---------------------------------------------------------------- hearing */

enum { PIECE = 1024 };

/* piece: room for PIECE moments. */
static celspan_status give_all(celspan_context *context, const cs_sound_stream *samples,
                               const char *name, cs_sound_take *take, void *user, float *piece) {
  const int64_t most = (int64_t)CS_SOUND_HOURS * 3600 * CS_SOUND_HEARD_RATE;
  int64_t moments = 0;
  size_t got = PIECE;
  while (got == PIECE) {
    CS_TRY(samples->read(samples->user, context, piece, PIECE, &got));
    CS_TRY(take(user, context, piece, got));
    moments += (int64_t)got;
    if (moments > most)
      return cs_fail(context, CELSPAN_LIMIT,
                     "the sound %s has more than %d hours, which is the limit", cs_sound_name(name),
                     CS_SOUND_HOURS);
  }
  return CELSPAN_OK;
}

celspan_status cs_sound_each(celspan_context *context, const cs_sound_stream *samples,
                             const char *name, cs_sound_take *take, void *user) {
  float *piece;
  size_t count = PIECE * (size_t)samples->channels;
  CS_TRY(CS_MAKE(context, piece, count));
  celspan_status status = give_all(context, samples, name, take, user, piece);
  cs_mem_free(context->memory, piece, count * sizeof *piece);
  return status;
}
