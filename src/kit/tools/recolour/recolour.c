#include "tools/recolour/recolour.h"

#include <math.h>
#include <stdio.h>

#include "inside/colour.h"
#include "tools/relight/original.h"

celspan_status cs_recolour_begin(cs_recolour *recolour) {
  return recolour->is_strict ? CS_MAKE(recolour->context, recolour->strange, CS_STRANGE_MOST)
                             : CELSPAN_OK;
}

void cs_recolour_finish(cs_recolour *recolour) {
  cs_memory *memory = recolour->context->memory;
  for (size_t i = 0; i < recolour->picture_count; i++)
    cs_picture_unref(recolour->pictures[i]);
  cs_mem_free(memory, recolour->pictures, recolour->picture_capacity * sizeof *recolour->pictures);
  cs_mem_free(memory, recolour->strange,
              recolour->strange ? CS_STRANGE_MOST * sizeof *recolour->strange : 0);
  cs_hash_table_finish(&recolour->indices, recolour->context);
  cs_swatches_finish(recolour->context, &recolour->swatches);
}

/* ---------------------------------------------------------------- strange colours */

static void note(void *user, const double code[3], int32_t x, int32_t y) {
  cs_recolour *recolour = user;
  uint32_t rgb = 0;
  size_t i = 0;
  for (int c = 0; c < 3; c++)
    rgb = rgb << 8 | (uint32_t)(fmin(fmax(code[c], 0), 1) * 255 + 0.5);
  while (i < recolour->strange_count && recolour->strange[i].rgb != rgb)
    i++;
  if (i == CS_STRANGE_MOST)
    return;
  cs_strange *strange = &recolour->strange[i];
  if (i == recolour->strange_count) {
    const cs_mark none = {0};
    *strange = (cs_strange){.rgb = rgb, .x = x, .y = y};
    snprintf(strange->place, sizeof strange->place, "%s",
             cs_mark_describe(recolour->object ? recolour->object->mark : none).text);
    recolour->strange_count++;
  }
  strange->count++;
}

/* ---------------------------------------------------------------- paints */

static void recolour_paint(cs_recolour *recolour, cs_paint *paint, bool *is_changed) {
  double code[3], light[3];
  if (!(paint->beta > 0))
    return;
  for (int c = 0; c < 3; c++)
    code[c] = cs_transfer_code((double)paint->s[c] / (double)paint->beta);
  const cs_swatch *found = cs_swatches_find(&recolour->swatches, code, CS_PAINTING_WITHIN);
  if (!found && recolour->is_strict)
    note(recolour, code, -1, -1);
  if (!found)
    return;
  cs_swatches_light(&recolour->swatches, found->to, light);
  for (int c = 0; c < 3; c++)
    paint->s[c] = (float)(light[c] * (double)paint->beta);
  *is_changed = true;
}

static void recolour_paints(cs_recolour *recolour, celspan_texture *texture, bool *is_changed) {
  if (texture->kind == CS_TEXTURE_FLAT) {
    recolour_paint(recolour, &texture->flat, is_changed);
    return;
  }
  cs_texture_variation *variation = cs_texture_own(texture);
  for (int i = 0; i < 3 && texture->kind == CS_TEXTURE_TRIANGLE; i++)
    recolour_paint(recolour, &variation->corners[i], is_changed);
  for (size_t i = 0; i < variation->stop_count; i++)
    recolour_paint(recolour, &variation->stops[i].paint, is_changed);
}

/* ---------------------------------------------------------------- paintings */

static celspan_status read(celspan_context *context, cs_original *original, const cs_unlit *unlit) {
  for (int32_t y = 0; y < unlit->height; y += CS_ORIGINAL_ROWS) {
    CS_TRY(cs_original_read(context, original, y));
    size_t rows = (size_t)(cs_original_end(original, y) - y);
    memcpy(cs_unlit_paint(unlit, 0, y), original->rows,
           rows * (size_t)unlit->width * 4 * sizeof(float));
  }
  return CELSPAN_OK;
}

static celspan_status change_pixels(cs_recolour *recolour, cs_original *original,
                                    const cs_unlit *unlit, bool *is_changed) {
  bool is_half = original->info.is_float;
  cs_painting painting = {.swatches = &recolour->swatches,
                          .width = unlit->width,
                          .height = unlit->height,
                          .rgba = unlit->paint,
                          .within = is_half ? CS_PAINTING_WITHIN_HALF : CS_PAINTING_WITHIN,
                          .only_known = recolour->only_known,
                          .report = recolour->is_strict ? note : NULL,
                          .user = recolour};
  recolour->work += (int64_t)unlit->width * unlit->height;
  CS_TRY(read(recolour->context, original, unlit));
  celspan_status status = cs_painting_recolour(recolour->context, &painting);
  *is_changed = painting.is_changed;
  return status;
}

/* *out: NULL where the picture stays. */
static celspan_status make_painting(cs_recolour *recolour, const cs_picture *picture,
                                    cs_picture **out) {
  celspan_context *context = recolour->context;
  cs_original original;
  cs_unlit unlit = {0};
  celspan_texture *made = NULL;
  bool is_changed = false;
  CS_TRY(cs_original_open_picture(context, picture, &original));
  celspan_status status =
      cs_unlit_create(context, original.info.width, original.info.height, false, &unlit);
  if (status == CELSPAN_OK)
    status = change_pixels(recolour, &original, &unlit, &is_changed);
  cs_original_close(context, &original);
  if (status == CELSPAN_OK && is_changed)
    status = cs_unlit_finish(context, &unlit, NULL, &made);
  else
    cs_unlit_discard(context, &unlit);
  if (made)
    *out = cs_picture_ref(made->variation->picture);
  celspan_texture_unref(made);
  return status;
}

/* *out: borrowed; NULL where the picture stays. */
static celspan_status painting_of(cs_recolour *recolour, const cs_picture *picture,
                                  cs_picture **out) {
  celspan_context *context = recolour->context;
  cs_hash hash = cs_picture_hash(picture);
  size_t index = recolour->picture_count;
  if (!cs_hash_table_find(&recolour->indices, hash, &index)) {
    CS_TRY(CS_RESERVE(context, recolour->pictures, recolour->picture_capacity, index + 1));
    recolour->pictures[index] = NULL;
    CS_TRY(make_painting(recolour, picture, &recolour->pictures[index]));
    recolour->picture_count++;
    CS_TRY(cs_hash_table_add(&recolour->indices, context, hash, index));
  }
  *out = recolour->pictures[index];
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- textures */

static celspan_status change(cs_recolour *recolour, celspan_texture *copy, bool *is_changed) {
  const cs_texture_variation *variation = copy->variation;
  cs_picture *painting = NULL;
  if (copy->kind != CS_TEXTURE_PICTURE)
    recolour_paints(recolour, copy, is_changed);
  else if (variation->use == CELSPAN_PICTURE_PAINT && !variation->medium)
    CS_TRY(painting_of(recolour, variation->picture, &painting));
  if (!painting)
    return CELSPAN_OK;
  *is_changed = true;
  cs_picture_unref(variation->picture);
  cs_texture_own(copy)->picture = cs_picture_ref(painting);
  return CELSPAN_OK;
}

celspan_status cs_recolour_texture(cs_recolour *recolour, celspan_texture *texture,
                                   celspan_texture **out) {
  celspan_texture *copy;
  bool is_changed = false;
  CS_TRY(cs_texture_copy(recolour->context, texture, texture->variation->stop_count,
                         cs_mark_keep(texture->mark), &copy));
  celspan_status status = change(recolour, copy, &is_changed);
  if (status == CELSPAN_OK && is_changed)
    return cs_texture_finish(copy, out);
  celspan_texture_unref(copy);
  *out = celspan_texture_ref(texture);
  return status;
}
