#include "relight/unlit.h"

#include "relight/original.h"

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

/* Takes the pixels over, and leaves NULL there, when it succeeds. */
static celspan_status make_surface(celspan_context *context, const cs_unlit *unlit, float **pixels,
                                   celspan_surface **out) {
  owned_pixels *owned = cs_mem_array(context->memory, 1, sizeof *owned);
  if (!owned)
    return cs_fail_memory(context);
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
  celspan_picture_desc desc = {0};
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

/* *texture is exchanged for one with the medium. */
static celspan_status add_medium(celspan_context *context, cs_unlit *unlit,
                                 celspan_texture **texture) {
  celspan_picture_desc desc = {0};
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
  if (status == CELSPAN_OK)
    *out = texture;
  else
    celspan_texture_unref(texture);
  return status;
}
