/* Textures as values: checked, hashed and copied. */
#include "model/scene/texture.h"

#include <string.h>

#include "base/description.h"
#include "base/self_check.h"
#include "model/colour/space.h"
#include "model/pictures/store.h"
#include "model/pictures/surface.h"
#include "model/scene/check.h"
#include "model/scene/value.h"

static const cs_texture_variation no_variation = {.stop_count = 0};

typedef struct varying {
  celspan_texture texture;
  cs_texture_variation variation;
} varying;

static size_t size_of(cs_texture_kind kind) {
  return kind == CS_TEXTURE_FLAT ? sizeof(celspan_texture) : sizeof(varying);
}

cs_texture_variation *cs_texture_own(celspan_texture *texture) {
  CS_SELF_CHECK(texture->kind != CS_TEXTURE_FLAT);
  return &((varying *)texture)->variation;
}

celspan_status cs_texture_create_kind(celspan_context *context, cs_texture_kind kind,
                                      celspan_texture **out) {
  celspan_texture *texture;
  CS_TRY(cs_mem_make(context, (void **)&texture, 1, size_of(kind)));
  texture->variation = kind == CS_TEXTURE_FLAT ? &no_variation : &((varying *)texture)->variation;
  atomic_init(&texture->references, 1);
  texture->memory = cs_memory_ref(context->memory);
  texture->mark = cs_mark_now(context);
  texture->kind = kind;
  *out = texture;
  return CELSPAN_OK;
}

static void hash_picture(cs_hash *hash, const celspan_texture *texture) {
  cs_hash_hash(hash, cs_picture_hash(texture->variation->picture));
  if (texture->variation->medium)
    cs_hash_hash(hash, cs_picture_hash(texture->variation->medium));
  cs_hash_word(hash, texture->variation->sampling);
  cs_hash_word(hash, texture->variation->use);
  cs_hash_word(hash, texture->variation->wrap);
  cs_hash_word(hash, texture->variation->has_box);
  cs_value_hash_box(hash, &texture->variation->box);
}

static void hash_pattern(cs_hash *hash, const cs_texture_variation *variation) {
  cs_hash_hash(hash, variation->tile_hash);
  cs_value_hash_box(hash, &variation->box);
}

static void hash_noise(cs_hash *hash, const cs_noise *noise) {
  cs_hash_word(hash, noise->kind);
  cs_hash_number(hash, noise->size);
  cs_hash_word(hash, (uint64_t)noise->octaves);
  cs_hash_number(hash, noise->gain);
  cs_hash_word(hash, (uint64_t)noise->seed);
  cs_hash_number(hash, noise->at);
  cs_hash_word(hash, noise->fades);
}

static cs_hash hash_texture(const celspan_texture *texture) {
  const cs_texture_variation *variation = texture->variation;
  cs_hash hash = cs_hash_begin(CS_VALUE_TEXTURE);
  cs_hash_word(&hash, texture->kind);
  cs_value_hash_paint(&hash, &texture->flat);
  for (int i = 0; i < 3; i++) {
    cs_value_hash_point(&hash, variation->points[i]);
    cs_value_hash_paint(&hash, &variation->corners[i]);
  }
  cs_hash_number(&hash, variation->radius);
  cs_hash_word(&hash, variation->stop_count);
  for (size_t i = 0; i < variation->stop_count; i++) {
    cs_hash_number(&hash, variation->stops[i].at);
    cs_value_hash_paint(&hash, &variation->stops[i].paint);
  }
  cs_hash_word(&hash, variation->spread);
  if (variation->fit != CS_TEXTURE_FIT_NONE)
    cs_hash_word(&hash, variation->fit);
  cs_hash_word(&hash, variation->has_matrix);
  if (variation->has_matrix)
    cs_value_hash_matrix(&hash, &variation->matrix);
  if (texture->kind == CS_TEXTURE_PICTURE)
    hash_picture(&hash, texture);
  if (texture->kind == CS_TEXTURE_PATTERN)
    hash_pattern(&hash, variation);
  if (texture->kind == CS_TEXTURE_NOISE)
    hash_noise(&hash, &variation->noise);
  return cs_hash_end(hash);
}

void cs_texture_rehash(celspan_texture *texture) { texture->hash = hash_texture(texture); }

celspan_status cs_texture_finish(celspan_texture *texture, celspan_texture **out) {
  texture->hash = hash_texture(texture);
  *out = texture;
  return CELSPAN_OK;
}

static celspan_status create_flat(celspan_context *context, const cs_paint *paint,
                                  celspan_texture **out) {
  celspan_texture *texture = NULL;
  CS_TRY(cs_texture_create_kind(context, CS_TEXTURE_FLAT, &texture));
  texture->flat = *paint;
  return cs_texture_finish(texture, out);
}

celspan_status cs_texture_create_flat(celspan_context *context, const celspan_paint *paint,
                                      celspan_texture **out) {
  cs_paint flat = cs_paint_from_straight(paint);
  return create_flat(context, &flat, out);
}

celspan_status celspan_texture_create_paint(celspan_context *context, const celspan_paint *paint,
                                            celspan_texture **out) {
  CS_TRY(cs_check_given(context, "paint", "the paint", paint));
  CS_TRY(cs_check_paint(context, "paint", "", 0, paint));
  return cs_texture_create_flat(context, paint, out);
}

celspan_status cs_texture_or_black(celspan_context *context, celspan_texture *texture,
                                   celspan_texture **out) {
  const celspan_paint black = celspan_paint_rgb(0, 0, 0, 1);
  if (!texture)
    return cs_texture_create_flat(context, &black, out);
  *out = celspan_texture_ref(texture);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- pictures */

static celspan_status check_picture(celspan_context *context, const celspan_picture_desc *desc) {
  CS_TRY(cs_check_choice(context, "picture", "sampling", (unsigned)desc->sampling,
                         CELSPAN_SAMPLING_BICUBIC + 1));
  CS_TRY(cs_check_choice(context, "picture", "use", (unsigned)desc->use, CELSPAN_PICTURE_GEL + 1));
  CS_TRY(
      cs_check_choice(context, "picture", "wrap", (unsigned)desc->wrap, CELSPAN_WRAP_REPEAT + 1));
  return desc->has_box ? cs_check_box(context, "picture", "box", &desc->box) : CELSPAN_OK;
}

celspan_status celspan_texture_create_picture(celspan_context *context,
                                              const celspan_picture_desc *desc,
                                              celspan_texture **out) {
  CS_READ(context, "picture", celspan_picture_desc, desc);
  const cs_paint clear = CS_PAINT_CLEAR;
  CS_TRY(check_picture(context, desc));
  cs_picture *picture;
  CS_TRY(cs_picture_create(context, desc, &picture));
  celspan_picture_info info;
  celspan_status status = desc->has_source ? cs_store_info(context, picture, &info) : CELSPAN_OK;
  if (status != CELSPAN_OK) {
    cs_picture_unref(picture);
    return status;
  }
  bool is_degenerate = desc->has_box && !(desc->box.width > 0 && desc->box.height > 0);
  celspan_texture *texture = NULL;
  status = is_degenerate ? create_flat(context, &clear, &texture)
                         : cs_texture_create_kind(context, CS_TEXTURE_PICTURE, &texture);
  if (status != CELSPAN_OK || is_degenerate)
    cs_picture_unref(picture);
  CS_TRY(status);
  if (!is_degenerate) {
    cs_texture_variation *variation = cs_texture_own(texture);
    variation->picture = picture;
    variation->sampling = desc->sampling;
    variation->use = desc->use;
    variation->wrap = desc->wrap;
    variation->has_box = desc->has_box;
    if (desc->has_box)
      variation->box = desc->box;
  }
  return cs_texture_finish(texture, out);
}

/* ---------------------------------------------------------------- media */

celspan_status cs_texture_copy_medium(celspan_context *context, const celspan_texture *texture,
                                      cs_picture *medium, celspan_texture **out) {
  celspan_texture *copy;
  CS_TRY(cs_texture_copy(context, texture, texture->variation->stop_count,
                         cs_mark_keep(texture->mark), &copy));
  cs_texture_variation *variation = cs_texture_own(copy);
  if (variation->medium)
    cs_picture_unref(variation->medium);
  variation->medium = medium ? cs_picture_ref(medium) : NULL;
  return cs_texture_finish(copy, out);
}

celspan_status celspan_texture_with_medium(celspan_context *context, celspan_texture *texture,
                                           const celspan_picture_desc *medium,
                                           celspan_texture **out) {
  CS_READ(context, "medium", celspan_picture_desc, medium);
  CS_TRY(cs_check_given(context, "medium", "the texture", texture));
  CS_TRY(check_picture(context, medium));
  if (texture->kind != CS_TEXTURE_PICTURE || texture->variation->use != CELSPAN_PICTURE_PAINT)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "medium: the texture must be a picture that is used as paint");
  cs_picture *picture;
  CS_TRY(cs_picture_create(context, medium, &picture));
  celspan_status status = cs_texture_copy_medium(context, texture, picture, out);
  cs_picture_unref(picture);
  return status;
}

/* ---------------------------------------------------------------- other paints */

static cs_paint light_paint(cs_paint paint) {
  for (int c = 0; c < 3; c++)
    paint.t[c] = 1 - paint.beta;
  return paint;
}

static cs_paint coded_paint(cs_paint paint) { return cs_space_paint(CELSPAN_SPACE_SRGB, paint); }

static void map_paints(cs_texture_variation *variation, cs_paint (*map)(cs_paint paint)) {
  for (int i = 0; i < 3; i++)
    variation->corners[i] = map(variation->corners[i]);
  for (size_t i = 0; i < variation->stop_count; i++)
    variation->stops[i].paint = map(variation->stops[i].paint);
}

celspan_status cs_texture_create_light(celspan_context *context, celspan_texture *texture,
                                       celspan_texture **out) {
  const cs_paint clear = CS_PAINT_CLEAR;
  celspan_texture *light = NULL;
  if (texture->kind == CS_TEXTURE_PICTURE && texture->variation->use == CELSPAN_PICTURE_GEL)
    return create_flat(context, &clear, out);
  if (texture->variation->medium)
    return cs_texture_copy_medium(context, texture, NULL, out);
  if (texture->kind == CS_TEXTURE_PICTURE) {
    *out = celspan_texture_ref(texture);
    return CELSPAN_OK;
  }
  CS_TRY(cs_texture_copy(context, texture, texture->variation->stop_count, cs_mark_now(context),
                         &light));
  light->flat = light_paint(light->flat);
  if (light->kind != CS_TEXTURE_FLAT) {
    cs_texture_variation *variation = cs_texture_own(light);
    celspan_texture_unref(variation->origin); /* it has other paints */
    variation->origin = NULL;
    map_paints(variation, light_paint);
  }
  return cs_texture_finish(light, out);
}

celspan_status cs_texture_create_coded(celspan_context *context, const celspan_texture *texture,
                                       celspan_texture **out) {
  celspan_texture *coded;
  CS_TRY(cs_texture_copy(context, texture, texture->variation->stop_count,
                         cs_mark_keep(texture->mark), &coded));
  map_paints(cs_texture_own(coded), coded_paint);
  return cs_texture_finish(coded, out);
}

/* ---------------------------------------------------------------- questions */

static bool is_grey(const cs_paint *paint) {
  return paint->t[0] == paint->t[1] && paint->t[1] == paint->t[2];
}

static bool all_paints_are_grey(const celspan_texture *texture) {
  const cs_paint *corners = texture->variation->corners;
  if (texture->kind == CS_TEXTURE_FLAT)
    return is_grey(&texture->flat);
  if (texture->kind == CS_TEXTURE_TRIANGLE)
    return is_grey(&corners[0]) && is_grey(&corners[1]) && is_grey(&corners[2]);
  for (size_t i = 0; i < texture->variation->stop_count; i++)
    if (!is_grey(&texture->variation->stops[i].paint))
      return false;
  return true;
}

bool cs_texture_is_grey(const celspan_texture *texture) {
  return texture->kind == CS_TEXTURE_PICTURE
             ? texture->variation->use == CELSPAN_PICTURE_PAINT && !texture->variation->medium
             : all_paints_are_grey(texture);
}

bool cs_texture_stays_on_thread(const celspan_texture *texture) {
  const cs_picture *picture =
      texture->kind == CS_TEXTURE_PICTURE ? texture->variation->picture : NULL;
  return picture && picture->surface && cs_surface_stays_on_thread(picture->surface);
}

/* ---------------------------------------------------------------- copies */

/* The variation of a copy, with its own stops, for which there is room. */
static void copy_variation(const cs_texture_variation *from, cs_stop *stops, size_t stop_count,
                           cs_texture_variation *to) {
  size_t kept = stop_count < from->stop_count ? stop_count : from->stop_count;
  *to = *from;
  to->stops = stops;
  to->stop_count = stop_count;
  if (kept > 0)
    memcpy(stops, from->stops, kept * sizeof *stops);
  if (to->picture)
    cs_picture_ref(to->picture);
  if (to->medium)
    cs_picture_ref(to->medium);
  if (to->origin)
    celspan_texture_ref(to->origin);
  if (to->calls)
    (void)to->calls->keep(to->tile);
}

celspan_status cs_texture_copy(celspan_context *context, const celspan_texture *texture,
                               size_t stop_count, cs_mark mark, celspan_texture **out) {
  celspan_texture *copy = NULL;
  cs_stop *stops = cs_mem_array(context->memory, stop_count, sizeof *stops);
  celspan_status status = !stops && stop_count > 0
                              ? cs_fail_memory(context)
                              : cs_texture_create_kind(context, texture->kind, &copy);
  if (status != CELSPAN_OK) {
    cs_mem_free(context->memory, stops, stop_count * sizeof *stops);
    cs_mark_drop(mark);
    return status;
  }
  copy->hash = texture->hash;
  copy->mark = mark;
  copy->flat = texture->flat;
  if (copy->kind != CS_TEXTURE_FLAT)
    copy_variation(texture->variation, stops, stop_count, cs_texture_own(copy));
  *out = copy;
  return CELSPAN_OK;
}

celspan_status cs_texture_boxed(celspan_context *context, celspan_texture *texture,
                                const celspan_box *box, celspan_texture **out) {
  if (texture->kind != CS_TEXTURE_PICTURE || texture->variation->has_box) {
    *out = celspan_texture_ref(texture);
    return CELSPAN_OK;
  }
  celspan_texture *boxed;
  CS_TRY(cs_texture_copy(context, texture, 0, cs_mark_keep(texture->mark), &boxed));
  cs_texture_variation *variation = cs_texture_own(boxed);
  variation->has_box = true;
  variation->box = *box;
  if (variation->wrap == CELSPAN_WRAP_CLEAR)
    variation->wrap = CELSPAN_WRAP_CLAMP;
  return cs_texture_finish(boxed, out);
}

celspan_status celspan_texture_named(celspan_context *context, celspan_texture *texture,
                                     const char *name, celspan_texture **out) {
  CS_TRY(cs_check_given(context, "named", "the texture", texture));
  cs_mark mark;
  CS_TRY(cs_mark_named(context, texture->mark, name, &mark));
  return cs_texture_copy(context, texture, texture->variation->stop_count, mark, out);
}

const char *celspan_texture_name(const celspan_texture *texture) {
  return cs_mark_name(texture->mark);
}

celspan_origin celspan_texture_origin(const celspan_texture *texture) {
  return cs_mark_origin(texture->mark);
}

/* ---------------------------------------------------------------- references */

static void destroy(celspan_texture *texture) {
  cs_memory *memory = texture->memory;
  const cs_texture_variation *variation = texture->variation;
  cs_mem_free(memory, variation->stops, variation->stop_count * sizeof *variation->stops);
  if (variation->picture)
    cs_picture_unref(variation->picture);
  if (variation->medium)
    cs_picture_unref(variation->medium);
  celspan_texture_unref(variation->origin);
  if (variation->calls)
    variation->calls->release(variation->tile);
  cs_mark_drop(texture->mark);
  cs_counted_free(memory, texture, size_of(texture->kind));
}

CS_COUNTED(celspan_texture)
