#include "readers/layered/png_profile.h"

#include <string.h>

#include "readers/layered/bytes.h"

enum { BEFORE_CHUNKS = 8, SUM = 4 };

typedef struct chunks {
  celspan_context *context;
  cs_stream base;    /* pulls the rest of the open chunk */
  cs_stream *source; /* the member's bytes */
  uint32_t left;     /* of the open chunk */
  int64_t scanned;
  bool is_told;              /* by iCCP or sRGB */
  cs_colour_request request; /* of gAMA and cHRM */
  celspan_painting *painting;
  cs_profile profile;
} chunks;

static celspan_status take(chunks *c, void *bytes, size_t size) {
  c->scanned += (int64_t)size;
  return cs_stream_read(c->source, c->context, bytes, size, "a PNG picture");
}

static celspan_status skip(chunks *c, size_t count) {
  unsigned char bytes[1024];
  for (size_t step; count > 0 && c->scanned <= CS_PNG_PROFILE_SCANNED; count -= step) {
    step = count < sizeof bytes ? count : sizeof bytes;
    CS_TRY(take(c, bytes, step));
  }
  return CELSPAN_OK;
}

static celspan_status pull(cs_stream *stream, celspan_context *context, void *bytes, size_t size,
                           size_t *got) {
  chunks *c = (chunks *)((char *)stream - offsetof(chunks, base));
  *got = 0;
  if (c->left == 0)
    return CELSPAN_OK;
  CS_TRY(c->source->pull(c->source, context, bytes, size < c->left ? size : c->left, got));
  c->left -= (uint32_t)*got;
  c->scanned += (int64_t)*got;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the profile */

/* The unpacked zlib stream in the rest of the chunk. Errors: as cs_stream_load. */
static celspan_status unpack(chunks *c, unsigned char **bytes, size_t *size) {
  cs_stream_inflate inflate;
  CS_TRY(cs_stream_inflate_init(&inflate, c->context, &c->base, CS_STREAM_ZLIB));
  celspan_status status =
      cs_stream_load(&inflate.base, c->context, "a colour profile", CS_PROFILE_BYTES, bytes, size);
  cs_stream_inflate_finish(&inflate);
  return status;
}

/* A profile that cannot be unpacked is not understood. */
static celspan_status read_packed(chunks *c) {
  unsigned char *bytes;
  size_t size;
  celspan_status status = unpack(c, &bytes, &size);
  if (status != CELSPAN_OK)
    return status == CELSPAN_NO_MEMORY ? status : CELSPAN_OK;
  status = cs_profile_read(c->context, c->base.input, c->painting,
                           &(cs_colour_request){.bytes = bytes, .size = size}, &c->profile);
  c->scanned += (int64_t)size;
  cs_mem_free(c->context->memory, bytes, size + 1);
  return status;
}

/* The name, of 79 bytes at most, its NUL and the number of the packing. */
static celspan_status read_profile(chunks *c) {
  char name[80];
  size_t done = 0;
  c->is_told = true;
  c->profile.codes = CS_PROFILE_UNKNOWN;
  do {
    if (c->left < 2 || done == sizeof name)
      return CELSPAN_OK;
    CS_TRY(take(c, name + done, 1));
    c->left--;
  } while (name[done++]);
  CS_TRY(skip(c, 1));
  c->left--;
  return read_packed(c);
}

/* ---------------------------------------------------------------- chunks */

static celspan_status read_places(chunks *c) {
  unsigned char bytes[32];
  CS_TRY(take(c, bytes, sizeof bytes));
  c->left -= (uint32_t)sizeof bytes;
  c->request.has_places = true;
  for (size_t i = 0; i < 8; i++)
    c->request.places[i] = cs_bytes_big32(bytes + 4 * i);
  return CELSPAN_OK;
}

static celspan_status read_power(chunks *c) {
  unsigned char bytes[4];
  CS_TRY(take(c, bytes, sizeof bytes));
  c->left -= (uint32_t)sizeof bytes;
  c->request.power = cs_bytes_big32(bytes);
  return CELSPAN_OK;
}

static celspan_status read_chunk(chunks *c, const char *type) {
  if (memcmp(type, "iCCP", 4) == 0)
    return read_profile(c);
  if (memcmp(type, "sRGB", 4) == 0 && !c->is_told) {
    c->is_told = true;
    c->profile.codes = CS_PROFILE_SRGB;
  }
  if (memcmp(type, "gAMA", 4) == 0 && c->left == 4)
    return read_power(c);
  return memcmp(type, "cHRM", 4) == 0 && c->left == 32 ? read_places(c) : CELSPAN_OK;
}

static celspan_status read_chunks(chunks *c) {
  static const char last[][5] = {"IDAT", "PLTE", "IEND"};
  unsigned char head[8];
  CS_TRY(skip(c, BEFORE_CHUNKS));
  while (c->scanned <= CS_PNG_PROFILE_SCANNED) {
    CS_TRY(take(c, head, sizeof head));
    for (size_t i = 0; i < sizeof last / sizeof *last; i++)
      if (memcmp(head + 4, last[i], 4) == 0)
        return CELSPAN_OK;
    c->left = cs_bytes_big32(head);
    CS_TRY(read_chunk(c, (const char *)head + 4));
    CS_TRY(skip(c, (size_t)c->left + SUM));
  }
  return CELSPAN_OK;
}

celspan_status cs_png_read_profile(celspan_context *context, const cs_input *input,
                                   const cs_zip_member *member, celspan_painting *painting,
                                   cs_profile *out, int64_t *scanned) {
  cs_zip_stream stream;
  CS_TRY(cs_zip_open(context, input, member, &stream));
  chunks c = {
      .context = context, .base = {pull, input}, .source = stream.bytes, .painting = painting};
  celspan_status status = read_chunks(&c);
  cs_zip_close(&stream);
  CS_TRY(status);
  if (!c.is_told && c.request.power > 0)
    CS_TRY(cs_profile_of_power(context, input, painting, &c.request, &c.profile));
  *out = c.profile;
  *scanned = c.scanned;
  return CELSPAN_OK;
}
