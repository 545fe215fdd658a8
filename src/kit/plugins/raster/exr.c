/* OpenEXR, by OpenEXRCore: scan lines and tiles of every packing, chosen as plugins/oiio chooses.
 *
 *   chunk --library--> rows of channels as they are stored --put_rows--> raster of floats
 *
 * The library's own conversions to floats are not used: where one channel of four is read, they
 * write the others, too. Beside the raster only one chunk is in memory. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define IMATH_HALF_NO_LOOKUP_TABLE
#include <half.h>
#include <openexr.h>

#include "inside/colour.h"
#include "plugins/raster/raster.h"

typedef exr_attr_chlist_entry_t channel;

typedef struct reading {
  const cs_raster_file *file;
  cs_raster *out;
  cs_picture_failure *failure;
  exr_context_t exr;
  int part;
  const exr_attr_chlist_t *channels;          /* as they are stored */
  const channel *sorted[CS_PICTURE_CHANNELS]; /* by `compare` */
  const channel *chosen[4];                   /* for each channel of the raster; NULL: 1 */
  exr_attr_box2i_t data, shown;               /* with their last columns and rows */
  exr_decode_pipeline_t chunk;
  exr_result_t (*unpack)(exr_decode_pipeline_t *chunk);
} reading;

static celspan_status fail(const reading *r, const char *text) {
  return cs_raster_fail(r->failure, CELSPAN_INPUT, "%s", text);
}

static celspan_status fail_by(const reading *r, exr_result_t result) {
  if (result == EXR_ERR_OUT_OF_MEMORY)
    return cs_raster_fail(r->failure, CELSPAN_NO_MEMORY, "out of memory");
  return fail(r, result == EXR_ERR_FEATURE_NOT_IMPLEMENTED
                     ? "is compressed in a way that needs OpenImageIO; save it with ZIP"
                     : "is corrupt or truncated");
}

/* ---------------------------------------------------------------- the file in memory */

static int64_t read_bytes(exr_const_context_t exr, void *user, void *out, uint64_t size,
                          uint64_t offset, exr_stream_error_func_ptr_t report) {
  const cs_raster_file *file = user;
  uint64_t left = offset < file->size ? file->size - offset : 0, got = size < left ? size : left;
  (void)exr, (void)report;
  memcpy(out, file->bytes + (got ? offset : 0), (size_t)got);
  return (int64_t)got;
}

static int64_t size_of(exr_const_context_t exr, void *user) {
  (void)exr;
  return (int64_t)((const cs_raster_file *)user)->size;
}

static void ignore(exr_const_context_t exr, exr_result_t result, const char *text) {
  (void)exr, (void)result, (void)text;
}

/* What a damaged chunk leaves out is the same in every run. */
static void *take_clear(size_t size) { return calloc(1, size); }

/* ---------------------------------------------------------------- channels */

/* The bytes of a name up to its last dot, after which there is the name in a layer. */
static size_t layer_size(const channel *c) {
  const char *dot = strrchr(c->name.str, '.');
  return dot ? (size_t)(dot - c->name.str) + 1 : 0;
}

static bool is_named(const channel *c, const char *name) {
  return strcasecmp(c->name.str + layer_size(c), name) == 0;
}

static int rank(const channel *c) {
  static const char *const names[] = {"R",    "Red",  "G",  "Green", "B",     "Blue", "Y",
                                      "real", "imag", "A",  "Alpha", "AR",    "RA",   "AG",
                                      "GA",   "AB",   "BA", "Z",     "Depth", "Zback"};
  int count = (int)(sizeof names / sizeof *names), i = 0;
  while (i < count && !is_named(c, names[i]))
    i++;
  return i;
}

/* The order of OpenImageIO: by layers, then usual names before others. */
static int compare(const void *left, const void *right) {
  const channel *a = *(const channel *const *)left, *b = *(const channel *const *)right;
  size_t sizes[] = {layer_size(a), layer_size(b)};
  bool is_shorter = sizes[0] < sizes[1];
  int order = strncmp(a->name.str, b->name.str, sizes[is_shorter ? 0 : 1]);
  if (order == 0 && sizes[0] != sizes[1])
    order = is_shorter ? -1 : 1;
  if (order == 0)
    order = rank(a) - rank(b);
  return order ? order : a < b ? -1 : 1;
}

/* layer: the first `size` bytes of the name, with the dot. */
static const channel *find(const reading *r, const char *layer, size_t size, const char *name) {
  for (int i = 0; i < r->channels->num_channels; i++) {
    const channel *c = r->sorted[i];
    if (strncasecmp(c->name.str, layer, size) == 0 && strcasecmp(c->name.str + size, name) == 0)
      return c;
  }
  return NULL;
}

/* The colours of a layer: three, or grey. Returns how many. */
static int find_colours(const reading *r, const char *layer, size_t size, const channel *out[3]) {
  static const char *const names[] = {"R", "G", "B"};
  for (int i = 0; i < 3; i++)
    out[i] = find(r, layer, size, names[i]);
  if (out[0] && out[1] && out[2])
    return 3;
  out[0] = find(r, layer, size, "Y");
  return out[0] ? 1 : 0;
}

/* Without a layer, channels of any names are colours, and the last one of two or four may be
 * alpha. */
static celspan_status choose_channels(reading *r, const char *name) {
  char layer[CS_PICTURE_SPACE + 1] = "";
  size_t size = name ? (size_t)snprintf(layer, sizeof layer, "%s.", name) : 0;
  int stored = r->channels->num_channels;
  int count = size < sizeof layer ? find_colours(r, layer, size, r->chosen) : 0;
  if (!count && name)
    return cs_raster_fail(r->failure, CELSPAN_INPUT, "has no layer \"%s\"", name);
  if (!count) {
    count = stored >= 3 ? 3 : 1;
    memcpy(r->chosen, r->sorted, (size_t)count * sizeof *r->chosen);
  }
  const channel *alpha = find(r, layer, size, "A"), *last = r->sorted[stored - 1];
  if (!alpha && !name && (stored == 2 || stored == 4) &&
      (is_named(last, "A") || is_named(last, "Alpha")))
    alpha = last;
  r->out->is_multiplied = alpha != NULL;
  r->out->lacks_alpha = !alpha && memcmp(&r->data, &r->shown, sizeof r->data) != 0;
  r->chosen[count] = alpha;
  r->out->channels = count + (alpha || r->out->lacks_alpha);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- parts */

/* Whether a window is within the limits. Pixels beyond the display window are decoded, too. */
static bool is_sane(exr_attr_box2i_t w) {
  int64_t width = (int64_t)w.max.x - w.min.x + 1, height = (int64_t)w.max.y - w.min.y + 1;
  return width >= 1 && height >= 1 && width <= CS_PICTURE_SIDE && height <= CS_PICTURE_SIDE &&
         (uint64_t)(width * height) <= CS_RASTER_PIXELS;
}

static int32_t width_of(exr_attr_box2i_t w) { return w.max.x - w.min.x + 1; }

static int32_t height_of(exr_attr_box2i_t w) { return w.max.y - w.min.y + 1; }

static celspan_status open_part(reading *r, int part) {
  exr_storage_t storage;
  exr_result_t results[] = {
      exr_get_storage(r->exr, part, &storage), exr_get_channels(r->exr, part, &r->channels),
      exr_get_data_window(r->exr, part, &r->data), exr_get_display_window(r->exr, part, &r->shown)};
  for (size_t i = 0; i < sizeof results / sizeof *results; i++)
    if (results[i] != EXR_ERR_SUCCESS)
      return fail_by(r, results[i]);
  int count = r->channels->num_channels;
  r->part = part;
  if (storage == EXR_STORAGE_DEEP_SCANLINE || storage == EXR_STORAGE_DEEP_TILED)
    return fail(r, "has deep data, which are not read: save it flattened");
  if (!is_sane(r->data) || !is_sane(r->shown))
    return cs_raster_fail(r->failure, CELSPAN_LIMIT, "has a window without pixels, or too large");
  if (count < 1)
    return fail(r, "is a picture without channels");
  if (count > CS_PICTURE_CHANNELS)
    return cs_raster_fail(r->failure, CELSPAN_LIMIT, "has %d channels; at most %d are read", count,
                          CS_PICTURE_CHANNELS);
  for (int i = 0; i < count; i++) {
    r->sorted[i] = r->channels->entries + i;
    if (r->sorted[i]->x_sampling != 1 || r->sorted[i]->y_sampling != 1)
      return fail(r, "has channels of another size than the picture, which are not read");
  }
  qsort(r->sorted, (size_t)count, sizeof *r->sorted, compare);
  return CELSPAN_OK;
}

/* What all channels have in common; FLOAT: they have different types. */
static exr_pixel_type_t type_of(const reading *r) {
  const channel *c = r->channels->entries;
  for (int i = 1; i < r->channels->num_channels; i++)
    if (c[i].pixel_type != c->pixel_type)
      return EXR_PIXEL_FLOAT;
  return c->pixel_type;
}

static cs_picture_part *add_part(const reading *r, int subimage, const char *name, size_t size) {
  static const char *const depths[] = {
      [EXR_PIXEL_UINT] = "32", [EXR_PIXEL_HALF] = "half", [EXR_PIXEL_FLOAT] = "float"};
  cs_picture_part *part = &r->out->parts[r->out->part_count++];
  *part = (cs_picture_part){.subimage = subimage,
                            .width = width_of(r->data),
                            .height = height_of(r->data),
                            .channels = r->channels->num_channels};
  snprintf(part->name, sizeof part->name, "%.*s", (int)size, name);
  snprintf(part->depth, sizeof part->depth, "%s", depths[type_of(r)]);
  return part;
}

/* The layers of a part are groups of channels such as light.R, light.G, light.B. */
static void add_layers(const reading *r) {
  const channel *found[3];
  for (int i = 0, end; i < r->channels->num_channels; i = end) {
    const char *name = r->sorted[i]->name.str;
    size_t size = layer_size(r->sorted[i]);
    for (end = i + 1; end < r->channels->num_channels; end++)
      if (layer_size(r->sorted[end]) != size || strncmp(r->sorted[end]->name.str, name, size) != 0)
        break;
    if (size > 1 && find_colours(r, name, size, found))
      add_part(r, -1, name, size - 1)->channels = end - i;
  }
}

/* Lists the parts up to the first that cannot be read, and opens the one that is asked for. */
static celspan_status choose_part(reading *r) {
  const char *layer = r->file->layer, *name;
  int count = 0, chosen = layer ? 0 : r->file->subimage;
  exr_get_count(r->exr, &count);
  r->out->parts = calloc((size_t)count + CS_PICTURE_CHANNELS, sizeof *r->out->parts);
  if (!r->out->parts)
    return fail_by(r, EXR_ERR_OUT_OF_MEMORY);
  for (int i = 0; i < count && open_part(r, i) == CELSPAN_OK; i++) {
    bool has_name = exr_get_name(r->exr, i, &name) == EXR_ERR_SUCCESS;
    add_part(r, i, has_name ? name : "", CS_PICTURE_SPACE);
    if (i == 0)
      add_layers(r);
    if (layer && has_name && strcmp(name, layer) == 0) {
      chosen = i;
      layer = NULL;
    }
  }
  if (chosen >= count)
    return cs_raster_fail(r->failure, CELSPAN_INPUT, "has no subimage %d", chosen);
  celspan_status status = open_part(r, chosen);
  return status == CELSPAN_OK ? choose_channels(r, layer) : status;
}

/* Codes in another space are of no use without it; light is, if its primaries are known. */
static void choose_colour(reading *r) {
  celspan_transfer own;
  exr_attr_chromaticities_t primaries;
  const char *text = NULL;
  cs_raster *out = r->out;
  int32_t size;
  out->bits = 32;
  out->stored = r->channels->num_channels;
  out->is_whole = type_of(r) == EXR_PIXEL_UINT;
  out->has_primaries =
      exr_attr_get_chromaticities(r->exr, r->part, "chromaticities", &primaries) == EXR_ERR_SUCCESS;
  if (out->has_primaries)
    memcpy(out->primaries, &primaries, sizeof out->primaries);
  bool has_name =
      exr_attr_get_string(r->exr, r->part, "celspan:colour", &size, &text) == EXR_ERR_SUCCESS &&
      text && *text;
  bool is_own = has_name && cs_transfer_parse(text, &own);
  bool is_other = has_name && !is_own && !out->has_primaries;
  out->colour = is_own          ? cs_transfer_name(own)
                : is_other      ? CS_PICTURE_OTHER
                : out->is_whole ? "srgb"
                                : "linear";
  out->names_colour = is_own || is_other;
  if (has_name && !is_own)
    snprintf(out->space, sizeof out->space, "%s", text);
  exr_attr_get_int(r->exr, r->part, "Orientation", &out->orientation);
}

/* ---------------------------------------------------------------- pixels */

/* Whole numbers are shares of the largest one, as OpenImageIO has them. */
static float value_of(const unsigned char *bytes, exr_pixel_type_t type) {
  uint32_t whole;
  float value;
  if (type == EXR_PIXEL_HALF)
    return imath_half_to_float((uint16_t)(bytes[0] | bytes[1] << 8));
  memcpy(&whole, bytes, sizeof whole);
  memcpy(&value, bytes, sizeof value);
  return type == EXR_PIXEL_UINT ? (float)(whole / 4294967295.0) : value;
}

/* Puts a row of a channel, from column `left` of the display window on. */
static void put_row(const reading *r, const channel *c, const unsigned char *row, int64_t left,
                    int64_t y) {
  int64_t from = left < 0 ? -left : 0, room = r->out->width - left, width = r->chunk.chunk.width;
  size_t count = (size_t)r->out->channels, size = c && c->pixel_type == EXR_PIXEL_HALF ? 2 : 4;
  float *out = (float *)r->out->pixels + (size_t)y * (size_t)r->out->width * count;
  for (size_t i = 0; i < count; i++)
    for (int64_t x = from; r->chosen[i] == c && x < (room < width ? room : width); x++)
      out[(size_t)(x + left) * count + i] = c ? value_of(row + (size_t)x * size, c->pixel_type) : 1;
}

/* Puts the chunk that was read, whose first pixel is there in the display window. */
static void put_rows(const reading *r, int64_t left, int64_t top) {
  const exr_chunk_info_t *chunk = &r->chunk.chunk;
  const unsigned char *from = r->chunk.unpacked_buffer;
  for (int64_t y = top; y < top + chunk->height; y++) {
    bool is_shown = y >= 0 && y < r->out->height;
    for (int i = 0; i < r->channels->num_channels; i++) {
      const channel *c = r->channels->entries + i;
      if (is_shown)
        put_row(r, c, from, left, y);
      from += (size_t)chunk->width * (c->pixel_type == EXR_PIXEL_HALF ? 2 : 4);
    }
    if (is_shown && r->out->lacks_alpha)
      put_row(r, NULL, NULL, left, y);
  }
}

/* Reads a chunk and puts it. A chunk that is as large as its pixels is not packed, whatever the
 * library believes of B44. A smaller one is packed, or else damaged. */
static exr_result_t read_chunk(reading *r, const exr_chunk_info_t *info, int64_t x, int64_t y) {
  bool is_packed = info->packed_size != info->unpacked_size;
  exr_result_t result = EXR_ERR_SUCCESS;
  if (r->chunk.context)
    result = exr_decoding_update(r->exr, r->part, info, &r->chunk);
  else {
    result = exr_decoding_initialize(r->exr, r->part, info, &r->chunk);
    if (result == EXR_ERR_SUCCESS)
      result = exr_decoding_choose_default_routines(r->exr, r->part, &r->chunk);
    r->unpack = r->chunk.decompress_fn;
    r->chunk.unpack_and_convert_fn = NULL;
  }
  r->chunk.decompress_fn = is_packed ? r->unpack : NULL;
  if (result == EXR_ERR_SUCCESS)
    result = is_packed && !r->unpack ? EXR_ERR_CORRUPT_CHUNK
                                     : exr_decoding_run(r->exr, r->part, &r->chunk);
  if (result == EXR_ERR_SUCCESS)
    put_rows(r, x + r->data.min.x - r->shown.min.x, y + r->data.min.y - r->shown.min.y);
  return result;
}

/* Scan lines are chunks as wide as the picture, whose height the library says. */
static exr_result_t read_chunks(reading *r) {
  exr_storage_t storage;
  exr_chunk_info_t info;
  uint32_t w = (uint32_t)width_of(r->data), h = 1;
  exr_result_t result = exr_get_storage(r->exr, r->part, &storage);
  bool is_tiled = result == EXR_ERR_SUCCESS && storage == EXR_STORAGE_TILED;
  if (is_tiled)
    result = exr_get_tile_descriptor(r->exr, r->part, &w, &h, NULL, NULL);
  if (w < 1 || w > INT32_MAX || h < 1 || h > INT32_MAX)
    result = EXR_ERR_FILE_BAD_HEADER;
  for (int64_t y = 0; y < height_of(r->data) && result == EXR_ERR_SUCCESS; y += h)
    for (int64_t x = 0; x < width_of(r->data) && result == EXR_ERR_SUCCESS; x += w) {
      result =
          is_tiled
              ? exr_read_tile_chunk_info(r->exr, r->part, (int)(x / w), (int)(y / h), 0, 0, &info)
              : exr_read_scanline_chunk_info(r->exr, r->part, (int)(y + r->data.min.y), &info);
      if (result == EXR_ERR_SUCCESS)
        result = read_chunk(r, &info, x, y);
      if (result == EXR_ERR_SUCCESS && !is_tiled)
        h = (uint32_t)info.height;
    }
  return result;
}

static celspan_status read_opened(reading *r) {
  celspan_status status = choose_part(r);
  if (status != CELSPAN_OK)
    return status;
  choose_colour(r);
  status = cs_raster_make(r->out, (uint64_t)width_of(r->shown), (uint64_t)height_of(r->shown),
                          r->failure);
  if (status != CELSPAN_OK)
    return status;
  exr_result_t result = read_chunks(r);
  exr_decoding_destroy(r->exr, &r->chunk);
  return result == EXR_ERR_SUCCESS ? CELSPAN_OK : fail_by(r, result);
}

celspan_status cs_raster_exr(const cs_raster_file *file, cs_raster *out,
                             cs_picture_failure *failure) {
  reading r = {.file = file, .out = out, .failure = failure};
  cs_raster_file readable = *file;
  exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
  start.error_handler_fn = ignore;
  start.alloc_fn = take_clear;
  start.user_data = &readable;
  start.read_fn = read_bytes;
  start.size_fn = size_of;
  start.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
  exr_result_t result = exr_start_read(&r.exr, "picture", &start);
  celspan_status status = result == EXR_ERR_SUCCESS ? read_opened(&r) : fail_by(&r, result);
  exr_finish(&r.exr);
  return status;
}
