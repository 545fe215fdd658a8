#include "readers/layered/psd.h"

#include <string.h>

#include "common/blend_names.h"
#include "readers/layered/profile.h"

typedef struct document {
  celspan_context *context;
  const cs_input *input;
  celspan_painting *painting;
  bool is_large, is_grey;
  int bits, channels;
  int32_t width, height;
  cs_profile profile;
  cs_psd_record *records;
  size_t count;
  size_t open[CS_CONTENTS_DEPTH]; /* the first layers of all groups that are open */
  int depth;
} document;

bool cs_psd_is(const unsigned char start[4]) { return memcmp(start, "8BPS", 4) == 0; }

static celspan_status fail(const document *d, int64_t offset, const char *sentence) {
  return cs_input_fail(d->context, d->input, offset, CELSPAN_INPUT, "%s", sentence);
}

/* ---------------------------------------------------------------- header */

static celspan_status check_mode(const document *d, int mode) {
  static const char *const modes[] = {"bitmap", NULL, "indexed",      NULL,      "CMYK",
                                      NULL,     NULL, "multichannel", "duotone", "Lab"};
  const char *name = mode < 10 ? modes[mode] : NULL;
  if (mode != 1 && mode != 3)
    return cs_input_fail(d->context, d->input, 24, CELSPAN_INPUT,
                         "is a Photoshop document in %s colour; RGB and grey are read",
                         name ? name : "an unknown kind of");
  if (d->bits != 8 && d->bits != 16)
    return cs_input_fail(d->context, d->input, 22, CELSPAN_INPUT,
                         "is a Photoshop document of %d bits per channel; 8 and 16 are read",
                         d->bits);
  return CELSPAN_OK;
}

static celspan_status read_header(document *d, cs_cursor *cursor) {
  cs_cursor_skip(cursor, 4);
  unsigned version = cs_cursor_16(cursor);
  cs_cursor_skip(cursor, 6);
  d->channels = cs_cursor_16(cursor);
  int64_t height = cs_cursor_32(cursor), width = cs_cursor_32(cursor);
  d->bits = cs_cursor_16(cursor);
  unsigned mode = cs_cursor_16(cursor);
  CS_TRY(cursor->status);
  if (version != 1 && version != 2)
    return fail(d, 4, "is a Photoshop document of an unknown version");
  d->is_large = version == 2;
  d->is_grey = mode == 1;
  CS_TRY(check_mode(d, (int)mode));
  CS_TRY(cs_contents_check_size(d->context, d->input, "the document", width, height));
  if (d->channels < (d->is_grey ? 1 : 3) || d->channels > CS_PSD_MOST_CHANNELS)
    return fail(d, 12, "the number of channels is invalid");
  d->painting->width = d->width = (int32_t)width;
  d->painting->height = d->height = (int32_t)height;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- resources */

/* Reads `size` bytes at the cursor; the caller moves the cursor after them. */
static celspan_status read_profile(document *d, const cs_cursor *cursor, uint32_t size) {
  d->profile.codes = CS_PROFILE_UNKNOWN;
  if (size > CS_PROFILE_BYTES)
    return CELSPAN_OK;
  unsigned char *bytes = cs_mem_resize(d->context->memory, NULL, 0, (size_t)size + 1);
  if (!bytes)
    return cs_fail_memory(d->context);
  celspan_status status = cs_input_read(d->context, d->input, cursor->at, bytes, size);
  if (status == CELSPAN_OK)
    status = cs_profile_read(d->context, d->input, d->painting,
                             &(cs_colour_request){.bytes = bytes, .size = size}, &d->profile);
  cs_mem_free(d->context->memory, bytes, (size_t)size + 1);
  return status;
}

/* Blocks of a number, a name and bytes, each padded to an even length. Any other data end the
 * blocks. */
static celspan_status read_resources(document *d, cs_cursor *cursor) {
  enum { PROFILE = 1039 };
  char signature[4];
  int64_t end = cs_cursor_section(cursor, cs_cursor_32(cursor), "the resources");
  while (cursor->status == CELSPAN_OK && end - cursor->at >= 12) {
    cs_cursor_bytes(cursor, signature, sizeof signature);
    unsigned number = cs_cursor_16(cursor), name = cs_cursor_8(cursor);
    cs_cursor_skip(cursor, name + (name + 1) % 2);
    uint32_t size = cs_cursor_32(cursor);
    if (memcmp(signature, "8BIM", 4) != 0 || size > (uint64_t)(end - cursor->at))
      break;
    if (number == PROFILE && cursor->status == CELSPAN_OK)
      CS_TRY(read_profile(d, cursor, size));
    cs_cursor_skip(cursor, (uint64_t)size + size % 2);
  }
  CS_TRY(cursor->status);
  cursor->at = end;
  return cs_profile_note(d->context, d->painting, CS_CONTENTS_NONE, &d->profile);
}

/* ---------------------------------------------------------------- channels */

/* How the rows at the cursor are packed; the cursor is moved after this field. */
static celspan_status read_packing(const document *d, cs_cursor *cursor, cs_psd_channel *out) {
  int64_t at = cursor->at;
  unsigned packing = cs_cursor_16(cursor);
  CS_TRY(cursor->status);
  if (packing > CS_PSD_ZIP_PREDICTED)
    return fail(d, at, "a channel is packed in an unknown way");
  out->packing = (cs_psd_packing)packing;
  return CELSPAN_OK;
}

/* Reads a channel of `size` bytes at the cursor, and moves the cursor after it. */
static celspan_status read_channel(const document *d, cs_cursor *cursor, uint64_t size,
                                   cs_psd_channel *out) {
  int64_t end = cs_cursor_section(cursor, size, "a channel");
  CS_TRY(cursor->status);
  int64_t table = (int64_t)out->height * (d->is_large ? 4 : 2);
  CS_TRY(read_packing(d, cursor, out));
  out->is_there = true;
  out->sizes = out->at = cursor->at;
  out->end = end;
  if (out->packing == CS_PSD_PACK_BITS && table > end - out->at)
    return fail(d, out->at, "the table of a channel's row sizes is cut off");
  if (out->packing == CS_PSD_PACK_BITS)
    out->at += table;
  cursor->at = end;
  return CELSPAN_OK;
}

/* The index of channel `id` of a layer; CS_PSD_CHANNELS: it is not used. */
static int place_of(const document *d, int id) {
  if (id >= 0)
    return id < (d->is_grey ? 1 : 3) ? id : CS_PSD_CHANNELS;
  return id == -1 ? CS_PSD_ALPHA : id == -2 ? CS_PSD_MASK : CS_PSD_CHANNELS;
}

static celspan_status read_channels(const document *d, cs_cursor *cursor,
                                    const cs_psd_record *record, cs_psd_layer *layer) {
  for (int i = 0; i < record->channel_count; i++) {
    int place = place_of(d, record->ids[i]);
    cs_psd_channel *channel = &layer->channels[place % CS_PSD_CHANNELS];
    bool is_kept = place < CS_PSD_CHANNELS && !channel->is_there && record->sizes[i] >= 2 &&
                   channel->width > 0 && channel->height > 0;
    if (is_kept)
      CS_TRY(read_channel(d, cursor, record->sizes[i], channel));
    else
      cs_cursor_skip(cursor, record->sizes[i]);
  }
  return cursor->status;
}

/* ---------------------------------------------------------------- layers */

static int64_t side(int32_t low, int32_t high) { return high > low ? (int64_t)high - low : 0; }

/* The sizes of the channels and the place of the mask, which may lie outside of the layer. */
static celspan_status prepare(const document *d, const cs_psd_record *record, cs_psd_layer *layer) {
  int64_t width = side(record->left, record->right), height = side(record->top, record->bottom);
  int64_t mask_width = side(record->mask_left, record->mask_right);
  int64_t mask_height = side(record->mask_top, record->mask_bottom);
  if (width == 0 || height == 0)
    width = height = 0;
  else
    CS_TRY(cs_contents_check_size(d->context, d->input, "a layer", width, height));
  CS_TRY(cs_contents_check_corner(d->context, d->input, "a layer", record->left, record->top));
  *layer =
      (cs_psd_layer){.base = {.width = (int32_t)width, .height = (int32_t)height, .bits = d->bits},
                     .is_grey = d->is_grey,
                     .size_bytes = d->is_large ? 4 : 2};
  for (int c = CS_PSD_RED; c <= CS_PSD_ALPHA; c++) {
    layer->channels[c].width = (int32_t)width;
    layer->channels[c].height = (int32_t)height;
  }
  if (!record->has_mask || record->mask_is_off || mask_width == 0 || mask_height == 0)
    return CELSPAN_OK;
  CS_TRY(cs_contents_check_size(d->context, d->input, "a mask", mask_width, mask_height));
  CS_TRY(cs_contents_check_corner(d->context, d->input, "a mask", record->mask_left,
                                  record->mask_top));
  layer->channels[CS_PSD_MASK].width = (int32_t)mask_width;
  layer->channels[CS_PSD_MASK].height = (int32_t)mask_height;
  layer->mask = (cs_psd_mask){record->mask_left - record->left, record->mask_top - record->top,
                              record->mask_beyond, record->mask_density, record->mask_is_inverted};
  return CELSPAN_OK;
}

static celspan_status note(const document *d, const char *sentence) {
  return cs_contents_note(d->context, d->painting, cs_contents_last(d->painting), "%s", sentence);
}

static celspan_status note_what_is_left(const document *d, const cs_psd_record *record,
                                        bool has_pixels) {
  const struct {
    bool is_so;
    const char *sentence;
  } notes[] = {
      {record->adjustment[0] != 0, "an adjustment: it changes nothing here"},
      {record->fill_content[0] != 0 && !has_pixels, "a fill without pixels: it is empty"},
      {record->has_effects, "layer effects: they are not drawn"},
      {record->has_conditions, "blended by lightness ranges: it is shown whole"},
      {record->has_vector_mask && !record->has_mask && !record->fill_content[0],
       "a vector mask: it is shown whole"},
      {record->mask_is_altered, "a mask with feather, or a vector mask of less density: it is as "
                                "it is stored"},
  };
  for (size_t i = 0; i < sizeof notes / sizeof *notes; i++)
    if (notes[i].is_so)
      CS_TRY(note(d, notes[i].sentence));
  return CELSPAN_OK;
}

/* Moves the layers without a parent, from the start of the innermost group on, into the group that
 * was added last. */
static celspan_status close_group(document *d) {
  celspan_painting *painting = d->painting;
  size_t group = painting->count - 1;
  if (d->depth == 0)
    return fail(d, -1, "a group ends that did not begin");
  for (size_t i = d->open[--d->depth]; i < group; i++)
    if (painting->layers[i].parent == CS_CONTENTS_NONE)
      painting->layers[i].parent = group;
  return CELSPAN_OK;
}

static celspan_status open_group(document *d) {
  if (d->depth == CS_CONTENTS_DEPTH)
    return cs_input_fail(d->context, d->input, -1, CELSPAN_LIMIT,
                         "groups lie in one another more than %d deep", CS_CONTENTS_DEPTH);
  d->open[d->depth++] = d->painting->count;
  return CELSPAN_OK;
}

/* The mask of a group: pixels of the whole document, of which only the alpha counts. */
static celspan_status set_mask(const document *d, const cs_psd_record *record,
                               const cs_psd_layer *group, cs_contents_layer *layer) {
  cs_psd_layer source = {.base = {.width = d->width, .height = d->height, .bits = d->bits},
                         .is_grey = group->is_grey,
                         .size_bytes = group->size_bytes,
                         .mask = group->mask};
  cs_rows_source *rows;
  source.channels[CS_PSD_MASK] = group->channels[CS_PSD_MASK];
  source.mask.x += record->left;
  source.mask.y += record->top;
  CS_TRY(cs_psd_rows_create(d->context, &source, &rows));
  cs_contents_set_pixels(layer, 0, 0, rows);
  return cs_contents_note_own(d->context, d->painting, "the mask of a group: it is shown whole");
}

static celspan_status add_layer(document *d, cs_cursor *cursor, const cs_psd_record *record) {
  cs_psd_layer source;
  cs_contents_layer *layer;
  CS_TRY(prepare(d, record, &source));
  CS_TRY(read_channels(d, cursor, record, &source));
  if (record->role == CS_PSD_GROUP_START)
    return open_group(d);
  CS_TRY(
      cs_contents_add(d->context, d->input, d->painting, record->name, record->name_size, &layer));
  cs_profile_apply(&d->profile, layer);
  layer->is_visible = !record->is_hidden;
  layer->is_clipped = record->is_clipped;
  layer->opacity = record->opacity * (double)record->fill / (255.0 * 255.0);
  layer->is_group = record->role == CS_PSD_GROUP;
  cs_blend_word_of_photoshop(layer->is_group && record->group_blend[0] ? record->group_blend
                                                                       : record->blend,
                             layer->blend);
  bool has_pixels = !layer->is_group && source.channels[CS_PSD_RED].is_there;
  if (has_pixels) {
    cs_rows_source *rows;
    CS_TRY(cs_psd_rows_create(d->context, &source, &rows));
    cs_contents_set_pixels(layer, record->left, record->top, rows);
  }
  if (layer->is_group && source.channels[CS_PSD_MASK].is_there)
    CS_TRY(set_mask(d, record, &source, layer));
  if (layer->is_clipped)
    CS_TRY(cs_contents_note_own(d->context, d->painting,
                                "clipped to the layer below it: it is shown whole"));
  CS_TRY(note_what_is_left(d, record, has_pixels));
  return record->role == CS_PSD_GROUP ? close_group(d) : CELSPAN_OK;
}

/* Reads records and channels, in a section that begins at the cursor. */
static celspan_status read_layers(document *d, cs_cursor *cursor) {
  int count = (int16_t)cs_cursor_16(cursor);
  CS_TRY(cursor->status);
  size_t records = (size_t)(count < 0 ? -count : count);
  if (records == 0)
    return CELSPAN_OK;
  /* A record has at least 34 bytes. */
  if ((int64_t)records > (cursor->end - cursor->at) / 34)
    return fail(d, cursor->at - 2, "the document declares more layers than it has bytes for");
  CS_TRY(CS_MAKE(d->context, d->records, records));
  d->count = records;
  for (size_t i = 0; i < records && cursor->status == CELSPAN_OK; i++)
    cs_psd_record_read(cursor, d->is_large, &d->records[i]);
  CS_TRY(cursor->status);
  for (size_t i = 0; i < records; i++)
    CS_TRY(add_layer(d, cursor, &d->records[i]));
  return d->depth == 0 ? CELSPAN_OK : fail(d, -1, "a group does not end");
}

/* Layers of 16 bits: in a tagged block after the section of 8-bit layers and its masks. */
static celspan_status read_deep_layers(document *d, cs_cursor *cursor) {
  char key[5];
  uint64_t size;
  cs_cursor_skip(cursor, cs_cursor_32(cursor));
  CS_TRY(cursor->status);
  while (d->count == 0 && cs_psd_record_tag(cursor, d->is_large, key, &size)) {
    int64_t outer = cursor->end, end = cs_cursor_section(cursor, size, "a block of the document");
    CS_TRY(cursor->status);
    cursor->end = end;
    if (strcmp(key, "Lr16") == 0 || strcmp(key, "Layr") == 0)
      CS_TRY(read_layers(d, cursor));
    cursor->end = outer;
    cursor->at = end;
  }
  return cursor->status;
}

/* The section of layers and masks; the cursor is moved after it. */
static celspan_status read_section(document *d, cs_cursor *cursor) {
  int64_t outer = cursor->end;
  uint64_t size = d->is_large ? cs_cursor_64(cursor) : cs_cursor_32(cursor);
  int64_t end = cs_cursor_section(cursor, size, "the section of layers");
  CS_TRY(cursor->status);
  cursor->end = end;
  if (size > 0) {
    uint64_t info = d->is_large ? cs_cursor_64(cursor) : cs_cursor_32(cursor);
    int64_t info_end = cs_cursor_section(cursor, info, "the list of layers");
    CS_TRY(cursor->status);
    cursor->end = info_end;
    if (info >= 2)
      CS_TRY(read_layers(d, cursor));
    cursor->end = end;
    cursor->at = info_end;
    if (d->count == 0 && end - info_end >= 4)
      CS_TRY(read_deep_layers(d, cursor));
  }
  cursor->end = outer;
  cursor->at = end;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- without layers */

/* The merged picture: the rows of all channels, one channel after another, all packed in the same
 * way. */
static celspan_status find_merged(const document *d, cs_cursor *cursor, cs_psd_layer *layer) {
  cs_psd_channel first = {.width = d->width, .height = d->height, .is_there = true};
  CS_TRY(read_packing(d, cursor, &first));
  if (first.packing != CS_PSD_RAW && first.packing != CS_PSD_PACK_BITS)
    return fail(d, cursor->at - 2, "the merged picture is packed in an unknown way");
  int64_t table = (int64_t)d->height * layer->size_bytes, at = cursor->at;
  int64_t plane = (int64_t)d->width * d->height * (d->bits / 8);
  int64_t data = at + (first.packing == CS_PSD_RAW ? 0 : table * d->channels);
  for (int c = 0; c < (d->is_grey ? 1 : 3); c++) {
    layer->channels[c] = first;
    layer->channels[c].sizes = at + c * table;
    layer->channels[c].at = data + (first.packing == CS_PSD_RAW ? c * plane : 0);
    layer->channels[c].end = d->input->size;
  }
  return CELSPAN_OK;
}

/* A packed channel begins where the rows of the previous one end, so their sizes are added up. */
static celspan_status find_packed(const document *d, cs_psd_layer *layer) {
  cs_cursor sizes;
  int64_t at = layer->channels[CS_PSD_RED].at;
  if (at > d->input->size)
    return fail(d, -1, "the table of the merged picture's row sizes is cut off");
  cs_cursor_init(&sizes, d->context, d->input, layer->channels[CS_PSD_RED].sizes, at);
  for (int c = 0; c < (d->is_grey ? 1 : 3); c++) {
    layer->channels[c].at = at;
    for (int32_t y = 0; y < d->height; y++)
      at += layer->size_bytes == 4 ? (int64_t)cs_cursor_32(&sizes) : cs_cursor_16(&sizes);
    layer->channels[c].end = at;
  }
  CS_TRY(sizes.status);
  return at > d->input->size ? fail(d, -1, "the merged picture is cut off") : CELSPAN_OK;
}

static celspan_status add_merged(document *d, cs_cursor *cursor) {
  cs_psd_layer source = {.base = {.width = d->width, .height = d->height, .bits = d->bits},
                         .is_grey = d->is_grey,
                         .size_bytes = d->is_large ? 4 : 2};
  cs_contents_layer *layer;
  cs_rows_source *rows;
  CS_TRY(find_merged(d, cursor, &source));
  if (source.channels[CS_PSD_RED].packing == CS_PSD_PACK_BITS)
    CS_TRY(find_packed(d, &source));
  CS_TRY(cs_contents_add(d->context, d->input, d->painting, "Background", 10, &layer));
  cs_profile_apply(&d->profile, layer);
  CS_TRY(cs_psd_rows_create(d->context, &source, &rows));
  cs_contents_set_pixels(layer, 0, 0, rows);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the document */

static celspan_status read_document(document *d) {
  cs_cursor cursor;
  cs_cursor_init(&cursor, d->context, d->input, 0, d->input->size);
  CS_TRY(read_header(d, &cursor));
  cs_cursor_skip(&cursor, cs_cursor_32(&cursor)); /* the colour table */
  CS_TRY(read_resources(d, &cursor));
  CS_TRY(read_section(d, &cursor));
  return d->count > 0 ? CELSPAN_OK : add_merged(d, &cursor);
}

celspan_status cs_psd_read(celspan_context *context, const cs_input *input,
                           celspan_painting *painting) {
  document d = {.context = context, .input = input, .painting = painting};
  celspan_status status = read_document(&d);
  cs_mem_free(context->memory, d.records, d.count * sizeof *d.records);
  return status;
}
