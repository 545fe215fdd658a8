#include "writers/record/pictures.h"

#include <math.h>
#include <string.h>

#include "inside/number.h"
#include "inside/pictures.h"
#include "writers/record/places.h"

#define NODES_MOST ((size_t)1 << 23)

struct cs_record_picture {
  celspan_context *context;
  cs_picture *picture; /* a reference; NULL: the source is the nodes of */
  const cs_defocused *grid;
  bool is_light;
  celspan_status *status; /* the status of reading it, if reading failed */
};

void cs_record_pictures_finish(cs_recording *record) {
  for (size_t i = 0; i < record->picture_count; i++)
    cs_picture_unref(record->sources[i].picture);
}

/* ---------------------------------------------------------------- pixels */

static void copy_light(const float (*texels)[4], int32_t count, planefile_cell *out) {
  for (int32_t i = 0; i < count; i++)
    for (int c = 0; c < 4; c++) {
      double channel = floor((double)texels[i][c] * PLANEFILE_WHITE + 0.5);
      out[i].colour[c] = (int32_t)cs_number_clamp(channel, -PLANEFILE_BRIGHT, PLANEFILE_BRIGHT);
    }
}

/* The part of a row that lies in one block. */
static celspan_status copy_part(const cs_record_picture *source, int32_t x, int32_t y,
                                int32_t count, void *out) {
  cs_picture_block *block;
  int32_t row = y % CS_PICTURE_BLOCK;
  CS_TRY(cs_load_block(source->context, source->picture, 0, x / CS_PICTURE_BLOCK,
                       y / CS_PICTURE_BLOCK, &block));
  if (source->is_light)
    copy_light((const float(*)[4])block->texels + (size_t)row * CS_PICTURE_BLOCK, count,
               (planefile_cell *)out + x);
  else
    memcpy((unsigned char *)out + 4 * (size_t)x, block->codes[row], 4 * (size_t)count);
  cs_store_release(block);
  return CELSPAN_OK;
}

/* A row of the nodes of a cel's own grid. */
static celspan_status put_nodes(const cs_record_picture *source, int32_t y, planefile_cell *out) {
  const cs_defocused *grid = source->grid;
  cs_defocus_band *band;
  CS_TRY(grid->acquire(grid, source->context, y / grid->band_rows, &band));
  size_t first = (size_t)(y % grid->band_rows) * (size_t)grid->columns;
  copy_light((const float(*)[4])band->nodes + first, grid->columns, out);
  grid->release(grid, source->context, band);
  return CELSPAN_OK;
}

static celspan_status put_texels(const cs_record_picture *source, int32_t y, void *out) {
  celspan_picture_info info;
  CS_TRY(cs_store_info(source->context, source->picture, &info));
  for (int32_t x = 0; x < info.width; x += CS_PICTURE_BLOCK) {
    int32_t left = info.width - x;
    CS_TRY(copy_part(source, x, y, left < CS_PICTURE_BLOCK ? left : CS_PICTURE_BLOCK, out));
  }
  return CELSPAN_OK;
}

static bool put_row(void *user, uint32_t y, void *out) {
  const cs_record_picture *source = user;
  celspan_status status =
      source->picture ? put_texels(source, (int32_t)y, out) : put_nodes(source, (int32_t)y, out);
  if (status != CELSPAN_OK)
    *source->status = status;
  return status == CELSPAN_OK;
}

/* ---------------------------------------------------------------- pictures */

/* Whether a picture has only codes of 8 bits. A part has the codes of its whole picture. */
static celspan_status find_form(celspan_context *context, const cs_picture *picture,
                                bool *is_light) {
  cs_picture_entry *entry;
  bool is_smooth = picture->is_smooth;
  while (picture->whole && !is_smooth) {
    picture = picture->whole;
    is_smooth = picture->is_smooth;
  }
  CS_TRY(cs_store_entry(context, picture, &entry));
  *is_light = is_smooth || entry->header.bits != 8 || entry->decoder.is_linear ||
              entry->decoder.alpha != CS_PICTURE_ALPHA_STRAIGHT ||
              entry->decoder.transfer != CELSPAN_TRANSFER_SRGB;
  cs_store_leave(entry);
  return CELSPAN_OK;
}

/* Appends a picture with its source, and takes over the source's reference. */
static celspan_status append(const cs_record_picture *source, planefile_picture picture,
                             cs_recording *record) {
  celspan_context *context = source->context;
  celspan_status status = CS_ARRAY_RESERVE(context, record->sources, record->picture_count + 1);
  if (status == CELSPAN_OK) {
    record->sources[record->picture_count] = *source;
    status = CS_ARRAY_APPEND(context, record->pictures, record->picture_count, picture);
  }
  if (status != CELSPAN_OK)
    cs_picture_unref(source->picture);
  return status;
}

static celspan_status add_picture(celspan_context *context, cs_picture *picture,
                                  cs_recording *record) {
  celspan_picture_info info;
  cs_hash hash = cs_picture_hash(picture);
  cs_record_picture source = {.context = context, .status = &record->status};
  if (picture->tiles.size > 0)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "plane: %s is a picture in tiles; a plane keeps every pixel of its pictures: "
                   "give it one of the part that is in view",
                   picture->file);
  CS_TRY(cs_store_info(context, picture, &info));
  CS_TRY(find_form(context, picture, &source.is_light));
  source.picture = cs_picture_ref(picture);
  const planefile_picture made = {.width = (uint32_t)info.width,
                                  .height = (uint32_t)info.height,
                                  .kind = source.is_light ? PLANEFILE_LIGHT : PLANEFILE_CODES,
                                  .key = {hash.a, hash.b},
                                  .row = put_row};
  return append(&source, made, record);
}

static celspan_status add_grid(celspan_context *context, const cs_defocus *own,
                               cs_recording *record) {
  const cs_defocused *grid = &own->grid;
  const cs_record_picture source = {.context = context, .grid = grid, .status = &record->status};
  const planefile_picture made = {.width = (uint32_t)grid->columns,
                                  .height = (uint32_t)grid->rows,
                                  .kind = PLANEFILE_LIGHT,
                                  .key = {own->key.a, own->key.b},
                                  .row = put_row};
  if ((size_t)grid->columns * (size_t)grid->rows > NODES_MOST)
    return cs_fail(context, CELSPAN_LIMIT,
                   "plane: a blurred object is in view that has more than %zu nodes of its blur; a "
                   "plane keeps wider blurs, or smaller objects",
                   NODES_MOST);
  return append(&source, made, record);
}

/* Whether a picture of a key is in the record; *out: its number, or the next free number. */
static bool is_known(const cs_recording *record, cs_hash key, uint32_t *out) {
  size_t i = 0;
  while (i < record->picture_count &&
         (record->pictures[i].key[0] != key.a || record->pictures[i].key[1] != key.b))
    i++;
  *out = (uint32_t)i;
  return i < record->picture_count;
}

void cs_record_pictures_join(cs_recording *record) {
  for (size_t i = 0; i < record->picture_count; i++)
    record->pictures[i].user = &record->sources[i];
}

/* ---------------------------------------------------------------- image layers */

celspan_status cs_record_image(celspan_context *context, const cs_image_layer *image,
                               cs_recording *record, planefile_axis *out) {
  const cs_texture_variation *of = image->texture->variation;
  const celspan_box *box = &image->box;
  *out = (planefile_axis){.kind = PLANEFILE_PICTURE,
                          .wrap = (uint8_t)image->wrap,
                          .filter = (uint8_t)of->sampling,
                          .w = {0, 0, 1}};
  if (!is_known(record, cs_picture_hash(of->picture), &out->picture))
    CS_TRY(add_picture(context, of->picture, record));
  double across = record->pictures[out->picture].width / box->width;
  double down = record->pictures[out->picture].height / box->height;
  cs_place_own(&image->inverse, (double[3]){across, 0, -box->x * across}, out->p);
  cs_place_own(&image->inverse, (double[3]){0, down, -box->y * down}, out->q);
  if (!cs_place_is_affine(&image->inverse))
    cs_place_own(&image->inverse, (double[3]){0, 0, 1}, out->w);
  return CELSPAN_OK;
}

celspan_status cs_record_image_hides(celspan_context *context, const cs_image_layer *image,
                                     bool *out) {
  celspan_picture_info info;
  CS_TRY(cs_store_info(context, image->texture->variation->picture, &info));
  *out = !info.has_alpha && cs_image_layer_hides(image) && cs_place_is_affine(&image->inverse);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- defocused layers */

/* Node n of an axis is at n - 1/2 on the own grid, and the middle of texel n of a picture is at n +
 * 1/2. */
celspan_status cs_record_defocused(celspan_context *context, const cs_defocus *defocus,
                                   cs_recording *record, planefile_axis *out) {
  const cs_regrid_axis *axes = defocus->regrid.axes;
  if (!defocus->own || defocus->own->grid.planes != 1)
    return cs_fail(
        context, CELSPAN_BAD_ARGUMENT,
        "plane: a blurred object is in view that is in perspective, is coloured glass, or "
        "is blurred too little to be kept without a size, or one that is sharpened or filtered "
        "by its pixels");
  *out = (planefile_axis){.kind = PLANEFILE_PICTURE,
                          .wrap = PLANEFILE_WRAP_CLAMP,
                          .filter = PLANEFILE_FILTER_CUBIC,
                          .w = {0, 0, 1}};
  cs_place_plane((double[3]){axes[0].scale, 0, axes[0].offset + 1}, out->p);
  cs_place_plane((double[3]){0, axes[1].scale, axes[1].offset + 1}, out->q);
  return is_known(record, defocus->own->key, &out->picture)
             ? CELSPAN_OK
             : add_grid(context, defocus->own, record);
}
