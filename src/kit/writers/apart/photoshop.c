/* Everything of a document but its pixels. */
#include "writers/apart/photoshop.h"

#include <string.h>

#include "common/blend_names.h"
#include "common/bytes.h"

/* The most pixels a side, and the steps of opacities. */
enum { SIDE = 30000, STEPS = 255 };

/* The most bytes of a record, and of everything before the records. */
enum { RECORD = 1200, FRONT = 1024 + CS_SRGB_PROFILE };

static unsigned char *store(unsigned char *at, uint32_t number, int bytes) {
  return cs_bytes_put_big(at, number, bytes);
}

static unsigned char *store_text(unsigned char *at, const char *text) {
  return (unsigned char *)stpcpy((char *)at, text);
}

/* The length of what lies between, in the four bytes before it. */
static void store_length(unsigned char *start, const unsigned char *end) {
  store(start - 4, (uint32_t)(end - start), 4);
}

/* Zeros up to a multiple of `step` bytes from `start`. */
static unsigned char *pad(unsigned char *at, const unsigned char *start, int step) {
  while ((at - start) % step != 0)
    *at++ = 0;
  return at;
}

/* ---------------------------------------------------------------- names */

/* The character at *at in valid UTF-8, and moves *at behind it. */
static uint32_t next_character(const char **at) {
  unsigned char head = (unsigned char)*(*at)++;
  uint32_t character = head < 0x80   ? head
                       : head < 0xe0 ? head & 31
                       : head < 0xf0 ? head & 15
                                     : head & 7;
  while (((unsigned char)**at & 0xc0) == 0x80)
    character = character << 6 | ((unsigned char)*(*at)++ & 63);
  return character;
}

/* As UTF-16, with its length before it. */
static unsigned char *store_unicode(unsigned char *at, const char *text) {
  unsigned char *length = at;
  at += 4;
  while (*text) {
    uint32_t character = next_character(&text);
    if (character >= 0x10000)
      at = store(at, 0xd800 + ((character - 0x10000) >> 10), 2);
    at = store(at, character < 0x10000 ? character : 0xdc00 + (character & 0x3ff), 2);
  }
  store(length, (uint32_t)(at - length - 4) / 2, 4);
  return at;
}

/* For readers that know no other name: one byte a character, of ASCII, and its length before. */
static unsigned char *store_short(unsigned char *at, const char *text) {
  unsigned char *start = at++;
  while (*text) {
    uint32_t character = next_character(&text);
    *at++ = character < 0x80 ? (unsigned char)character : '_';
  }
  *start = (unsigned char)(at - start - 1);
  return pad(at, start, 4);
}

/* ---------------------------------------------------------------- a layer */

static unsigned char *store_names(unsigned char *at, const char *name) {
  at = store_short(at, name);
  at = store_text(at, "8BIMluni");
  unsigned char *start = at + 4;
  at = pad(store_unicode(start, name), start, 4);
  store_length(start, at);
  return at;
}

/* A layer covers the whole picture. */
static unsigned char *store_record(unsigned char *at, const cs_photoshop *document, size_t index) {
  const cs_apart_layer *layer = &document->base.apart.layers[index];
  enum { VISIBLE = 8 << 8 }; /* 8: the bit that says whether its pixels count has a meaning */
  at = store(store(at, 0, 4), 0, 4);
  at = store(at, (uint32_t)document->base.height, 4);
  at = store(at, (uint32_t)document->base.width, 4);
  at = store(at, CS_PHOTOSHOP_CHANNELS, 2);
  for (int c = 0; c < CS_PHOTOSHOP_CHANNELS; c++)
    at = store(store(at, (uint32_t)(c - 1), 2), document->sizes[index][c], 4); /* -1: alpha */
  at = store_text(at, "8BIM");
  at = store_text(at, cs_blend_photoshop(layer->blend));
  at = store(at, (uint32_t)(layer->opacity * STEPS + 0.5), 1);
  at = store(at, VISIBLE, 3); /* not clipped to the layer behind it; a byte of 0 at the end */
  unsigned char *start = at + 4;
  at = store(store(start, 0, 4), 0, 4); /* no mask, and no conditions of blending */
  at = store_names(at, cs_apart_title(layer));
  store_length(start, at);
  return at;
}

/* ---------------------------------------------------------------- the front */

static bool is_deep(const cs_photoshop *document) {
  return document->base.coding.depth == CELSPAN_DEPTH_16;
}

static unsigned char *store_header(unsigned char *at, const cs_photoshop *document) {
  enum { VERSION = 1, RGB = 3 };
  at = store_text(at, "8BPS");
  at = store(at, VERSION, 2);
  at = store(store(at, 0, 4), 0, 2);
  at = store(at, document->is_opaque ? 3 : 4, 2);
  at = store(at, (uint32_t)document->base.height, 4);
  at = store(at, (uint32_t)document->base.width, 4);
  at = store(at, is_deep(document) ? 16 : 8, 2);
  at = store(at, RGB, 2);
  return store(at, 0, 4); /* no table of colours */
}

/* The head of a resource without a name, and with room for its length. */
static unsigned char *begin_resource(unsigned char *at, uint32_t number) {
  return store(store(store(store_text(at, "8BIM"), number, 2), 0, 2), 0, 4);
}

static unsigned char *store_profile(unsigned char *at) {
  unsigned char *start = begin_resource(at, 1039);
  cs_srgb_profile(start);
  store_length(start, start + CS_SRGB_PROFILE);
  return pad(start + CS_SRGB_PROFILE, start, 2);
}

/* What made the file, and that its merged picture is real. */
static unsigned char *store_maker(unsigned char *at, const cs_photoshop *document) {
  const char *maker = cs_context_maker(document->base.context);
  unsigned char *start = begin_resource(at, 1057);
  at = store(store(start, 1, 4), 1, 1);
  at = store(store_unicode(store_unicode(at, maker), maker), 1, 4);
  store_length(start, at);
  return pad(at, start, 2);
}

static unsigned char *store_resources(unsigned char *at, const cs_photoshop *document) {
  unsigned char *start = at + 4;
  at = store_maker(store_profile(start), document);
  store_length(start, at);
  return at;
}

/* The layers of 16 bits are in a block, behind the place of those of 8 bits, which is empty. */
static unsigned char *store_lengths(unsigned char *at, const cs_photoshop *document) {
  uint32_t list = (uint32_t)(document->end - document->start);
  if (!is_deep(document))
    return store(store(at, 4 + list + 4, 4), list, 4);
  at = store(at, 4 + 4 + 12 + list, 4);
  at = store(store(at, 0, 4), 0, 4);
  return store(store_text(at, "8BIMLr16"), list, 4);
}

/* A number below 0 says that the first channel behind the colours is the merged picture's alpha. */
static unsigned char *store_number(unsigned char *at, const cs_photoshop *document) {
  uint32_t count = (uint32_t)document->base.apart.count;
  return store(at, document->is_opaque ? count : 0 - count, 2);
}

/* Writes all up to the channels, with the lengths that are known. */
static celspan_status put_front(cs_photoshop *document) {
  celspan_context *context = document->base.context;
  size_t size = FRONT + document->base.apart.count * RECORD;
  unsigned char *front;
  CS_TRY(CS_MAKE(context, front, size));
  unsigned char *at = store_resources(store_header(front, document), document);
  at = store_lengths(at, document);
  document->start = (uint64_t)(at - front);
  at = store_number(at, document);
  for (size_t i = 0; i < document->base.apart.count; i++)
    at = store_record(at, document, i);
  celspan_status status = cs_file_write_at(document->file, context, 0, front, (size_t)(at - front));
  cs_mem_free(context->memory, front, size);
  return status;
}

static celspan_status end_layers(cs_photoshop *document) {
  static const unsigned char zeros[8] = {0};
  uint64_t end = cs_file_size(document->file);
  size_t padding = (size_t)(0 - (end - document->start)) % 4;
  document->end = end + padding;
  /* Behind the list of 8 bits, the masks of all layers have no bytes. */
  return cs_file_write(document->file, document->base.context, zeros,
                       padding + (is_deep(document) ? 0 : 4));
}

/* ---------------------------------------------------------------- the format */

static celspan_status check(cs_apart_writing *base) {
  return base->width <= SIDE && base->height <= SIDE
             ? CELSPAN_OK
             : cs_fail(base->context, CELSPAN_LIMIT,
                       "%s: the frame has %d x %d pixels, and a Photoshop document at most %d a "
                       "side: write OpenEXR or PNG files, or a smaller --size",
                       base->path, (int)base->width, (int)base->height, SIDE);
}

static celspan_status begin(cs_apart_writing *base) {
  cs_photoshop *document = (cs_photoshop *)base;
  document->is_opaque = celspan_frame_is_opaque(&base->frame);
  CS_TRY(CS_MAKE(base->context, document->sizes, base->apart.count + 1));
  CS_TRY(cs_file_create(base->context, NULL, base->path, &document->file));
  return put_front(document);
}

static celspan_status put(cs_apart_writing *base, const celspan_frame_desc *picture, size_t index) {
  celspan_sink sink;
  CS_TRY(cs_photoshop_sink((cs_photoshop *)base, index, &sink));
  return cs_apart_render(base, picture, &sink);
}

static celspan_status end(cs_apart_writing *base, celspan_status outcome) {
  cs_photoshop *document = (cs_photoshop *)base;
  if (outcome == CELSPAN_OK)
    outcome = end_layers(document);
  outcome = cs_photoshop_end_merged(document, outcome);
  if (outcome == CELSPAN_OK)
    outcome = put_front(document);
  cs_mem_free(base->context->memory, document->sizes,
              (base->apart.count + 1) * sizeof *document->sizes);
  return document->file ? cs_file_end(document->file, base->context, outcome) : outcome;
}

const cs_apart_format cs_apart_psd = {.size = sizeof(cs_photoshop),
                                      .depth = CELSPAN_DEPTH_8,
                                      .has_mode = cs_blend_is_photoshop,
                                      .steps = STEPS,
                                      .check = check,
                                      .begin = begin,
                                      .put = put,
                                      .end = end};
