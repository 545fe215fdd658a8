/* OpenRaster: an archive of PNG pictures and stack.xml, which describes their order and places. */
#include <string.h>

#include "celspan/layers.h"
#include "common/blend_names.h"
#include "common/bytes.h"
#include "readers/layered/document.h"
#include "readers/layered/png.h"
#include "readers/layered/profile.h"
#include "readers/layered/zip.h"

/* ---------------------------------------------------------------- the colours of a PNG */

/* The chunks before a PNG's data that describe its colours: a profile, or values in its place.
 *
 *   iCCP   name, NUL, 0, profile in zlib     sRGB   that it is sRGB
 *   gAMA   a power                           cHRM   white and primaries
 *
 * The first two take precedence; without any of them the codes are sRGB.
 */

/* Bytes before the data in which chunks of colour are searched for. */
#define SCANNED_MOST ((int64_t)1 << 20)

enum { BEFORE_CHUNKS = 8, SUM = 4 };

typedef struct chunks {
  celspan_context *context;
  cs_stream base;    /* reads the rest of the open chunk */
  cs_stream *source; /* the member's bytes */
  uint32_t left;     /* bytes left in the open chunk */
  int64_t scanned;
  bool is_told;              /* iCCP or sRGB has given the colours */
  cs_colour_request request; /* made from gAMA and cHRM */
  celspan_painting *painting;
  cs_profile profile;
} chunks;

static celspan_status take(chunks *c, void *bytes, size_t size) {
  c->scanned += (int64_t)size;
  return cs_stream_read(c->source, c->context, bytes, size, "a PNG picture");
}

static celspan_status skip(chunks *c, size_t count) {
  unsigned char bytes[1024];
  for (size_t step; count > 0 && c->scanned <= SCANNED_MOST; count -= step) {
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

/* Unpacks the zlib stream in the rest of the chunk. Errors: as cs_stream_load. */
static celspan_status unpack(chunks *c, unsigned char **bytes, size_t *size) {
  cs_stream_inflate inflate;
  CS_TRY(cs_stream_inflate_init(&inflate, c->context, &c->base, CS_STREAM_ZLIB));
  celspan_status status =
      cs_stream_load(&inflate.base, c->context, "a colour profile", CS_PROFILE_BYTES, bytes, size);
  cs_stream_inflate_finish(&inflate);
  return status;
}

/* A profile that cannot be unpacked counts as not understood. */
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

/* Reads a profile chunk: a name of 79 bytes at most, its NUL, a byte for the compression method,
 * and the compressed profile. */
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
  while (c->scanned <= SCANNED_MOST) {
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

/* *scanned: the number of bytes that were unpacked. Errors: INPUT, NO_MEMORY; those of
 * cs_profile_read. */
static celspan_status read_colours(celspan_context *context, const cs_input *input,
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

static celspan_status read_common(cs_document *document, cs_contents_layer *layer) {
  const char *visibility = cs_document_text(document, "visibility");
  const char *blend = cs_document_text(document, "composite-op");
  layer->is_visible = !visibility || strcmp(visibility, "hidden") != 0;
  if (blend)
    cs_blend_word_of_openraster(blend, layer->blend);
  CS_TRY(cs_document_number(document, "opacity", 0, 1, &layer->opacity));
  CS_TRY(cs_document_whole(document, "x", &layer->x));
  return cs_document_whole(document, "y", &layer->y);
}

static celspan_status start_group(cs_document *document) {
  cs_contents_layer *layer;
  if (document->unnamed++ == 0) /* the outermost stack is the painting itself */
    return CELSPAN_OK;
  CS_TRY(cs_document_add(document, true, &layer));
  CS_TRY(read_common(document, layer));
  const char *isolation = cs_document_text(document, "isolation");
  /* A stack that is not isolated blends as if its layers were outside of it. */
  if (isolation && strcmp(isolation, "auto") == 0 && strcmp(layer->blend, "normal") == 0 &&
      layer->opacity == 1)
    strcpy(layer->blend, "pass-through");
  if (layer->x == 0 && layer->y == 0)
    return CELSPAN_OK;
  layer->x = layer->y = 0;
  return CS_DOCUMENT_NOTE(document, "an offset of a group: it stays where it is");
}

static celspan_status read_pixels(cs_document *document, cs_contents_layer *layer) {
  const char *name = cs_document_text(document, "src");
  cs_rows_source *source;
  cs_profile profile;
  int64_t scanned;
  if (!name)
    return cs_document_fail(document, CELSPAN_INPUT, "a layer without src");
  if (!cs_document_is_inside(name))
    return cs_document_fail(document, CELSPAN_INPUT,
                            "src is \"%.200s\"; it must lie in the archive", name);
  const char *ending = strrchr(name, '.');
  if (!ending || strcmp(ending, ".png") != 0)
    return CS_DOCUMENT_NOTE(document, "\"%.100s\", which is not a PNG: it is empty", name);
  const cs_zip_member *member = cs_zip_find(document->zip, name);
  if (!member)
    return cs_document_fail(document, CELSPAN_INPUT,
                            "src is \"%.200s\", which is not in the archive", name);
  CS_TRY(cs_png_create(document->context, document->input, member, &source));
  cs_contents_set_pixels(layer, layer->x, layer->y, source);
  CS_TRY(read_colours(document->context, document->input, member, document->painting, &profile,
                      &scanned));
  CS_TRY(cs_document_scan(document, scanned));
  cs_profile_apply(&profile, layer);
  return cs_profile_note(document->context, document->painting,
                         cs_contents_last(document->painting), &profile);
}

static celspan_status start_layer(cs_document *document) {
  cs_contents_layer *layer;
  CS_TRY(cs_document_add(document, false, &layer));
  CS_TRY(read_common(document, layer));
  return read_pixels(document, layer);
}

static celspan_status start(cs_document *document, const char *name) {
  cs_contents_layer *layer;
  if (strcmp(name, "image") == 0)
    return cs_document_size(document, "w", "h");
  if (strcmp(name, "stack") == 0)
    return start_group(document);
  if (strcmp(name, "layer") == 0)
    return start_layer(document);
  if (strcmp(name, "text") != 0)
    return CELSPAN_OK;
  CS_TRY(cs_document_add(document, false, &layer));
  CS_TRY(read_common(document, layer));
  return CS_DOCUMENT_NOTE(document, "text: it is empty");
}

static celspan_status end(cs_document *document, const char *name) {
  if (strcmp(name, "stack") == 0 && --document->unnamed > 0)
    cs_document_close_group(document);
  return CELSPAN_OK;
}

const cs_document_format cs_openraster_format = {"stack.xml", "reading OpenRaster files", start,
                                                 end, CS_CONTENTS_DEPTH + 3};
