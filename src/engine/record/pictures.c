#include "engine/record/pictures.h"

#include <math.h>
#include <string.h>

#include "base/number.h"
#include "engine/record/places.h"
#include "model/pictures/load.h"

struct cs_record_picture {
  celspan_context *context;
  cs_picture *picture; /* a reference */
  bool is_light;
  celspan_status *status; /* of reading it, where that failed */
};

void cs_record_pictures_finish(cs_recording *record, cs_memory *memory) {
  for (size_t i = 0; i < record->picture_count; i++)
    cs_picture_unref(record->sources[i].picture);
  cs_mem_free(memory, record->pictures, record->picture_capacity * sizeof *record->pictures);
  cs_mem_free(memory, record->sources, record->source_capacity * sizeof *record->sources);
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

static bool put_row(void *user, uint32_t y, void *out) {
  const cs_record_picture *source = user;
  celspan_picture_info info;
  celspan_status status = cs_store_info(source->context, source->picture, &info);
  for (int32_t x = 0; status == CELSPAN_OK && x < info.width; x += CS_PICTURE_BLOCK) {
    int32_t left = info.width - x;
    status =
        copy_part(source, x, (int32_t)y, left < CS_PICTURE_BLOCK ? left : CS_PICTURE_BLOCK, out);
  }
  if (status != CELSPAN_OK)
    *source->status = status;
  return status == CELSPAN_OK;
}

/* ---------------------------------------------------------------- pictures */

/* Whether codes of 8 bits are all that a picture has: a part has what the whole has. */
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

static celspan_status add_picture(celspan_context *context, cs_picture *picture,
                                  cs_recording *record) {
  celspan_picture_info info;
  cs_hash hash = cs_picture_hash(picture);
  cs_record_picture source = {.context = context, .status = &record->status};
  CS_TRY(cs_store_info(context, picture, &info));
  CS_TRY(find_form(context, picture, &source.is_light));
  const planefile_picture made = {.width = (uint32_t)info.width,
                                  .height = (uint32_t)info.height,
                                  .kind = source.is_light ? PLANEFILE_LIGHT : PLANEFILE_CODES,
                                  .key = {hash.a, hash.b},
                                  .row = put_row};
  CS_TRY(CS_RESERVE(context, record->sources, record->source_capacity, record->picture_count + 1));
  source.picture = cs_picture_ref(picture);
  record->sources[record->picture_count] = source;
  celspan_status status =
      CS_APPEND(context, record->pictures, record->picture_count, record->picture_capacity, made);
  if (status != CELSPAN_OK)
    cs_picture_unref(picture);
  return status;
}

static celspan_status find_picture(celspan_context *context, cs_picture *picture,
                                   cs_recording *record, uint32_t *out) {
  cs_hash hash = cs_picture_hash(picture);
  size_t i = 0;
  while (i < record->picture_count &&
         (record->pictures[i].key[0] != hash.a || record->pictures[i].key[1] != hash.b))
    i++;
  *out = (uint32_t)i;
  return i < record->picture_count ? CELSPAN_OK : add_picture(context, picture, record);
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
  CS_TRY(find_picture(context, of->picture, record, &out->picture));
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
