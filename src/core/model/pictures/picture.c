#include "model/pictures/picture.h"

#include <math.h>
#include <string.h>

#include "base/counted.h"
#include "base/description.h"
#include "base/tried.h"
#include "model/colour/transfer.h"
#include "model/pictures/configuration.h"
#include "model/pictures/surface.h"

#define SIDE_MOST 1048576
#define TILED_SIDE_MOST 16777216

static char *copy_text(cs_memory *memory, const char *text) {
  size_t size = strlen(text) + 1;
  char *copy = cs_mem_resize(memory, NULL, 0, size);
  return copy ? memcpy(copy, text, size) : NULL;
}

static void free_text(cs_memory *memory, char *text) {
  if (text)
    cs_mem_free(memory, text, strlen(text) + 1);
}

static cs_hash hash_of(const celspan_picture_desc *desc) {
  cs_hash hash = cs_hash_begin(0x70696374u);
  if (desc->surface)
    cs_hash_hash(&hash, desc->surface->hash);
  cs_hash_text(&hash, desc->file);
  cs_hash_text(&hash, desc->colour);
  cs_hash_text(&hash, desc->layer);
  cs_hash_word(&hash, (uint64_t)(desc->layer ? 0 : desc->subimage));
  if (desc->tiles) {
    cs_hash_bytes(&hash, desc->tiles, offsetof(celspan_picture_tiles, ending));
    cs_hash_text(&hash, desc->tiles->ending);
  }
  return cs_hash_end(hash);
}

static celspan_status check_surface(celspan_context *context, const celspan_picture_desc *desc) {
  celspan_transfer transfer;
  if (desc->file)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "picture: give a file or a surface, not both");
  if (desc->layer || desc->subimage != 0)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "picture: %s is given, but pixels in memory have no layers",
                   desc->layer ? "layer" : "subimage");
  if (desc->colour && !cs_transfer_parse(desc->colour, &transfer))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "picture: colour is \"%s\"; of pixels in memory it must be \"srgb\", "
                   "\"linear\", \"rec709\" or \"cineon\"",
                   desc->colour);
  return CELSPAN_OK;
}

static celspan_status check_source(celspan_context *context, const celspan_box *source) {
  static const char *const names[] = {"x", "y", "w", "h"};
  const double numbers[] = {source->x, source->y, source->width, source->height};
  for (int i = 0; i < 4; i++) {
    double least = i < 2 ? 0 : 1;
    if (!(numbers[i] >= least && numbers[i] <= SIDE_MOST) || numbers[i] != floor(numbers[i]))
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "picture: %s of source is %.9g; it must be a whole number of pixels, %.0f or "
                     "more",
                     names[i], numbers[i], least);
  }
  return CELSPAN_OK;
}

static celspan_status check_tiles(celspan_context *context, const celspan_picture_desc *desc) {
  const celspan_picture_tiles *t = desc->tiles;
  if (desc->surface || desc->layer || desc->subimage != 0 || desc->has_source || desc->smooth)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "picture: one in tiles has no pixels in memory, layer, subimage, source or "
                   "smooth");
  if (t->width >= 1 && t->width <= TILED_SIDE_MOST && t->height >= 1 &&
      t->height <= TILED_SIDE_MOST && t->size >= 1 && t->size <= SIDE_MOST && t->overlap >= 0 &&
      t->overlap <= t->size / 2 && memchr(t->ending, '\0', sizeof t->ending) && t->ending[0] &&
      !strchr(t->ending, '/'))
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                 "%s: %d x %d pixels in tiles of %d, with %d of overlap, in files '%.7s': it must "
                 "be 1 to %d pixels a side in tiles of 1 to %d, with half of that as overlap at "
                 "most, in files such as 'png'",
                 desc->file, (int)t->width, (int)t->height, (int)t->size, (int)t->overlap,
                 t->ending, TILED_SIDE_MOST, SIDE_MOST);
}

static celspan_status check(celspan_context *context, const celspan_picture_desc *desc) {
  celspan_transfer transfer;
  if (desc->has_source)
    CS_TRY(check_source(context, &desc->source));
  if (desc->surface && !desc->tiles)
    return check_surface(context, desc);
  if (!desc->file || !*desc->file)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "picture: file must name a file");
  if (desc->tiles)
    CS_TRY(check_tiles(context, desc));
  if (desc->subimage < 0)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "picture: subimage is %d; it must be 0 or more",
                   desc->subimage);
  if (desc->colour && !cs_transfer_parse(desc->colour, &transfer) && !cs_space_configuration())
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "picture: colour is \"%s\"; it must be \"srgb\", \"linear\", \"rec709\", "
                   "\"cineon\", or a space of the OpenColorIO configuration that --ocio or the "
                   "environment variable OCIO names",
                   desc->colour);
  return CELSPAN_OK;
}

static celspan_status create(celspan_context *context, const celspan_picture_desc *desc,
                             cs_picture **out) {
  cs_picture *picture;
  CS_TRY(CS_COUNTED_MAKE(context, picture));
  picture->hash = hash_of(desc);
  const char *tried = desc->surface ? NULL : cs_tried_find(context, desc->file);
  picture->subimage = desc->layer ? 0 : desc->subimage;
  picture->surface = desc->surface ? celspan_surface_ref(desc->surface) : NULL;
  picture->file = copy_text(picture->memory, desc->surface ? "" : desc->file);
  picture->colour = desc->colour ? copy_text(picture->memory, desc->colour) : NULL;
  picture->layer = desc->layer ? copy_text(picture->memory, desc->layer) : NULL;
  if (desc->tiles)
    picture->tiles = *desc->tiles;
  picture->tried = tried ? copy_text(picture->memory, tried) : NULL;
  if (!picture->file || !picture->colour != !desc->colour || !picture->layer != !desc->layer ||
      !picture->tried != !tried) {
    cs_picture_unref(picture);
    return cs_fail_memory(context);
  }
  *out = picture;
  return CELSPAN_OK;
}

/* Replaces *picture, the whole picture, by a part of it; a source without a width is the whole
 * picture. On failure *picture is released. */
static celspan_status cut(celspan_context *context, const celspan_picture_desc *desc,
                          const celspan_box *source, bool is_smooth, cs_picture **picture) {
  cs_picture *whole = *picture, *part;
  celspan_status status = create(context, desc, &part);
  if (status != CELSPAN_OK) {
    cs_picture_unref(whole);
    return status;
  }
  part->whole = whole;
  part->x = (int32_t)source->x;
  part->y = (int32_t)source->y;
  part->width = (int32_t)source->width;
  part->height = (int32_t)source->height;
  part->is_smooth = is_smooth;
  cs_hash hash = cs_hash_begin(is_smooth ? 0x736d7468u : 0x70617274u);
  cs_hash_hash(&hash, whole->hash);
  cs_hash_word(&hash, (uint64_t)part->x << 32 | (uint64_t)part->y);
  cs_hash_word(&hash, (uint64_t)part->width << 32 | (uint64_t)part->height);
  part->hash = cs_hash_end(hash);
  *picture = part;
  return CELSPAN_OK;
}

celspan_status cs_picture_create(celspan_context *context, const celspan_picture_desc *desc,
                                 cs_picture **out) {
  CS_READ(context, "picture", celspan_picture_desc, desc);
  CS_TRY(check(context, desc));
  cs_picture *picture;
  CS_TRY(create(context, desc, &picture));
  if (desc->smooth)
    CS_TRY(cut(context, desc, &(celspan_box){0, 0, 0, 0}, true, &picture));
  if (desc->has_source)
    CS_TRY(cut(context, desc, &desc->source, false, &picture));
  *out = picture;
  return CELSPAN_OK;
}

static void destroy(cs_picture *picture) {
  cs_memory *memory = picture->memory;
  celspan_surface_unref(picture->surface);
  cs_picture_unref(picture->whole);
  free_text(memory, picture->file);
  free_text(memory, picture->colour);
  free_text(memory, picture->layer);
  free_text(memory, picture->tried);
  cs_counted_free(memory, picture, sizeof *picture);
}

CS_COUNTED(cs_picture)

cs_hash cs_picture_hash(const cs_picture *picture) { return picture->hash; }

const char *cs_picture_name(const cs_picture *picture) {
  return picture->surface ? "a picture in memory" : picture->file;
}
