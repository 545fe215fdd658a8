#include "tools/scan/layer.h"

#include <string.h>

#include "inside/elementary.h"
#include "inside/hash.h"
#include "inside/number.h"

typedef struct layer {
  cs_memory *memory; /* counted */
  cs_layer_desc desc;
  double sine, cosine;
} layer;

/* ---------------------------------------------------------------- pixels */

/* The weights of four pixels, for a place `u` behind the second one. */
static void weigh(float u, float weights[4]) {
  weights[0] = u * (u * (1 - 0.5f * u) - 0.5f);
  weights[1] = u * u * (1.5f * u - 2.5f) + 1;
  weights[2] = u * (u * (2 - 1.5f * u) + 0.5f);
  weights[3] = u * u * (0.5f * u - 0.5f);
}

/* The mean of the 4 x 4 pixels around a place, whose column and row are those of the second. */
static uint8_t mean_at(const uint8_t *first, size_t width, float u, float v) {
  uint32_t rows[4], any = 0;
  float across[4], down[4], sum = 0.5f;
  for (size_t j = 0; j < 4; j++) {
    memcpy(&rows[j], first + j * width, sizeof rows[j]);
    any |= rows[j];
  }
  if (any == 0)
    return 0;
  weigh(u, across);
  weigh(v, down);
  for (size_t j = 0; j < 4; j++) {
    const uint8_t *row = first + j * width;
    float part = 0;
    for (int i = 0; i < 4; i++)
      part += across[i] * (float)row[i];
    sum += down[j] * part;
  }
  return (uint8_t)cs_number_clampf(sum, 0, 255);
}

static uint8_t alpha_at(const layer *lines, double along, double down) {
  const cs_layer_desc *desc = &lines->desc;
  double u = desc->place.x + lines->cosine * along - lines->sine * down - 0.5;
  double v = desc->place.y + lines->sine * along + lines->cosine * down - 0.5;
  if (!(u >= 1 && v >= 1 && u < desc->width - 2 && v < desc->height - 2))
    return 0;
  int32_t column = (int32_t)u, row = (int32_t)v;
  size_t first = (size_t)(row - 1) * (size_t)desc->width + (size_t)(column - 1);
  return mean_at(desc->plane + first, (size_t)desc->width, (float)(u - column), (float)(v - row));
}

static celspan_status fill(void *user, celspan_context *context, const celspan_rectangle *rectangle,
                           void *destination, size_t stride, int32_t *rows) {
  const layer *lines = user;
  (void)context;
  for (int32_t y = 0; y < rectangle->height; y++) {
    unsigned char *out = (unsigned char *)destination + (size_t)y * stride;
    double down = rectangle->y + y + 0.5 - lines->desc.place.to_y;
    for (int32_t x = rectangle->x; x < rectangle->x + rectangle->width; x++, out += 4) {
      memcpy(out, lines->desc.code, sizeof lines->desc.code);
      out[3] = alpha_at(lines, x + 0.5 - lines->desc.place.to_x, down);
    }
  }
  *rows = rectangle->height;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the surface */

static size_t size_of(const cs_layer_desc *desc) {
  return (size_t)desc->width * (size_t)desc->height;
}

static void release(void *user) {
  layer *lines = user;
  cs_memory *memory = lines->memory;
  cs_mem_free(memory, lines->desc.plane, size_of(&lines->desc));
  cs_mem_free(memory, lines, sizeof *lines);
  cs_memory_unref(memory);
}

static cs_hash hash_of(const cs_layer_desc *desc) {
  const cs_layer_place *to = &desc->place;
  cs_hash hash = cs_hash_begin((uint64_t)desc->width);
  cs_hash_bytes(&hash, desc->code, sizeof desc->code);
  cs_hash_bytes(&hash, desc->plane, size_of(desc));
  cs_hash_numbers(&hash, (const double[]){to->turn, to->x, to->y, to->to_x, to->to_y}, 5);
  return cs_hash_end(hash);
}

celspan_status cs_layer_create(celspan_context *context, const cs_layer_desc *desc,
                               celspan_surface **out) {
  const cs_hash hash = hash_of(desc);
  layer *lines = cs_mem_array(context->memory, 1, sizeof *lines);
  if (!lines) {
    cs_mem_free(context->memory, desc->plane, size_of(desc));
    return cs_fail_memory(context);
  }
  *lines = (layer){.memory = cs_memory_ref(context->memory), .desc = *desc};
  cs_elementary_sincos(-desc->place.turn, &lines->sine, &lines->cosine);
  celspan_surface_desc surface = CELSPAN_SURFACE_DESC;
  surface.width = desc->place.width;
  surface.height = desc->place.height;
  surface.format = CELSPAN_SURFACE_RGBA8;
  surface.fill = fill;
  surface.user = lines;
  surface.release = release;
  surface.any_thread = surface.has_key = true;
  surface.key[0] = hash.a;
  surface.key[1] = hash.b;
  celspan_status status = celspan_surface_create(context, &surface, out);
  if (status != CELSPAN_OK)
    release(lines);
  return status;
}
