#include "tools/relight/original.h"

#include <string.h>

#include "inside/pictures.h"
#include "inside/scene.h"

celspan_status cs_original_open_picture(celspan_context *context, const cs_picture *picture,
                                        cs_original *out) {
  celspan_picture_info info;
  CS_TRY(cs_store_info(context, picture, &info));
  if ((int64_t)info.width * info.height > CS_ORIGINAL_MOST)
    return cs_fail(context, CELSPAN_LIMIT,
                   "%s: %d x %d pixels are more than can be relit, %d in all; relight parts of it",
                   cs_picture_name(picture), info.width, info.height, CS_ORIGINAL_MOST);
  *out = (cs_original){.picture = picture, .info = info};
  return cs_mem_make(context, (void **)&out->rows, (size_t)info.width * CS_ORIGINAL_ROWS,
                     4 * sizeof *out->rows);
}

celspan_status cs_original_open(celspan_context *context, const char *noun,
                                const celspan_texture *texture, cs_original *out) {
  CS_TRY(cs_check_given(context, noun, "the picture", texture));
  if (texture->kind != CS_TEXTURE_PICTURE || texture->variation->use != CELSPAN_PICTURE_PAINT)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: it takes pictures that are used as paint",
                   noun);
  return cs_original_open_picture(context, texture->variation->picture, out);
}

static celspan_status read_texels(celspan_context *context, cs_original *original, int32_t x) {
  int32_t width = original->info.width, end = cs_original_end(original, original->first);
  int32_t columns = width - x < CS_PICTURE_BLOCK ? width - x : CS_PICTURE_BLOCK;
  cs_picture_block *block;
  CS_TRY(cs_load_block(context, original->picture, 0, x / CS_PICTURE_BLOCK,
                       original->first / CS_PICTURE_BLOCK, &block));
  for (int32_t row = 0; row < end - original->first; row++)
    memcpy(original->rows + 4 * ((size_t)row * (size_t)width + (size_t)x),
           block->texels + 4 * (size_t)row * CS_PICTURE_BLOCK, (size_t)columns * 4 * sizeof(float));
  cs_store_release(block);
  return CELSPAN_OK;
}

celspan_status cs_original_read(celspan_context *context, cs_original *original, int32_t first) {
  original->first = first;
  for (int32_t x = 0; x < original->info.width; x += CS_PICTURE_BLOCK)
    CS_TRY(read_texels(context, original, x));
  return CELSPAN_OK;
}

void cs_original_close(celspan_context *context, cs_original *original) {
  cs_mem_free(context->memory, original->rows,
              (size_t)original->info.width * CS_ORIGINAL_ROWS * 4 * sizeof *original->rows);
  original->rows = NULL;
}

celspan_status cs_original_same_size(celspan_context *context, const cs_original *a,
                                     const cs_original *b) {
  const celspan_picture_info *first = &a->info, *second = &b->info;
  if (first->width == second->width && first->height == second->height)
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                 "relight: %s has %d x %d pixels, and %s %d x %d; they must lie pixel on pixel",
                 cs_picture_name(a->picture), first->width, first->height,
                 cs_picture_name(b->picture), second->width, second->height);
}

/* ---------------------------------------------------------------- pixels without light */

static size_t bytes_of(const cs_unlit *unlit) {
  return (size_t)unlit->width * (size_t)unlit->height * 4 * sizeof(float);
}

celspan_status cs_unlit_create(celspan_context *context, int32_t width, int32_t height,
                               bool has_medium, cs_unlit *out) {
  if (width < 1 || height < 1 || (int64_t)width * height > CS_ORIGINAL_MOST)
    return cs_fail(
        context, CELSPAN_BAD_ARGUMENT,
        "relight: %d x %d pixels: a side must be 1 or more, and %d pixels in all at most", width,
        height, CS_ORIGINAL_MOST);
  cs_unlit unlit = {.width = width, .height = height};
  size_t pixels = (size_t)width * (size_t)height;
  unlit.paint = cs_mem_array(context->memory, pixels, 4 * sizeof(float));
  if (has_medium)
    unlit.medium = cs_mem_array(context->memory, pixels, 4 * sizeof(float));
  if (!unlit.paint || (has_medium && !unlit.medium)) {
    cs_unlit_discard(context, &unlit);
    return cs_fail_memory(context);
  }
  *out = unlit;
  return CELSPAN_OK;
}

void cs_unlit_discard(celspan_context *context, cs_unlit *unlit) {
  cs_mem_free(context->memory, unlit->paint, bytes_of(unlit));
  cs_mem_free(context->memory, unlit->medium, bytes_of(unlit));
  *unlit = (cs_unlit){0};
}

/* ---------------------------------------------------------------- surfaces */

/* Pixels that belong to a surface. */
typedef struct owned_pixels {
  cs_memory *memory; /* counted */
  float *pixels;
  size_t bytes;
} owned_pixels;

static void release(void *user) {
  owned_pixels *owned = user;
  cs_memory *memory = owned->memory;
  cs_mem_free(memory, owned->pixels, owned->bytes);
  cs_mem_free(memory, owned, sizeof *owned);
  cs_memory_unref(memory);
}

/* Takes over the pixels, and sets their pointer to NULL, if it succeeds. */
static celspan_status make_surface(celspan_context *context, const cs_unlit *unlit, float **pixels,
                                   celspan_surface **out) {
  owned_pixels *owned;
  CS_TRY(CS_MAKE(context, owned, 1));
  *owned = (owned_pixels){cs_memory_ref(context->memory), *pixels, bytes_of(unlit)};
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  desc.width = unlit->width;
  desc.height = unlit->height;
  desc.format = CELSPAN_SURFACE_RGBAF;
  desc.pixels = *pixels;
  desc.user = owned;
  desc.release = release;
  celspan_status status = celspan_surface_create(context, &desc, out);
  if (status == CELSPAN_OK) {
    *pixels = NULL;
    return CELSPAN_OK;
  }
  cs_memory_unref(owned->memory);
  cs_mem_free(context->memory, owned, sizeof *owned);
  return status;
}

/* ---------------------------------------------------------------- the texture */

static celspan_picture_desc desc_like(const celspan_texture *like) {
  celspan_picture_desc desc = {.struct_size = sizeof desc};
  if (like) {
    desc.sampling = like->variation->sampling;
    desc.wrap = like->variation->wrap;
    desc.has_box = like->variation->has_box;
    desc.box = like->variation->box;
  }
  return desc;
}

static celspan_status make_paint(celspan_context *context, cs_unlit *unlit,
                                 const celspan_texture *like, celspan_texture **out) {
  celspan_picture_desc desc = desc_like(like);
  CS_TRY(make_surface(context, unlit, &unlit->paint, &desc.surface));
  celspan_status status = celspan_texture_create_picture(context, &desc, out);
  celspan_surface_unref(desc.surface);
  return status;
}

/* Replaces *texture by a texture with the medium. */
static celspan_status add_medium(celspan_context *context, cs_unlit *unlit,
                                 celspan_texture **texture) {
  celspan_picture_desc desc = {.struct_size = sizeof desc};
  celspan_texture *whole;
  CS_TRY(make_surface(context, unlit, &unlit->medium, &desc.surface));
  celspan_status status = celspan_texture_with_medium(context, *texture, &desc, &whole);
  celspan_surface_unref(desc.surface);
  CS_TRY(status);
  celspan_texture_unref(*texture);
  *texture = whole;
  return CELSPAN_OK;
}

celspan_status cs_unlit_finish(celspan_context *context, cs_unlit *unlit,
                               const celspan_texture *like, celspan_texture **out) {
  celspan_texture *texture = NULL;
  celspan_status status = make_paint(context, unlit, like, &texture);
  if (status == CELSPAN_OK && unlit->medium)
    status = add_medium(context, unlit, &texture);
  cs_unlit_discard(context, unlit);
  return CS_GIVE(status, texture, celspan_texture_unref, out);
}
