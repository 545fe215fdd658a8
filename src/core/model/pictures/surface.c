#include "model/pictures/surface.h"

#include <stdio.h>
#include <string.h>

#include "base/counted.h"
#include "base/description.h"
#include "base/vector.h"

typedef struct layout {
  size_t size;  /* bytes of a pixel */
  int channels; /* 1 grey, 3, 4 with alpha */
  int bits;     /* the bits of a code; 0: floats */
} layout;

static const layout layouts[] = {
    [CELSPAN_SURFACE_RGBA8] = {4, 4, 8},  [CELSPAN_SURFACE_RGB8] = {3, 3, 8},
    [CELSPAN_SURFACE_GREY8] = {1, 1, 8},  [CELSPAN_SURFACE_RGBA16] = {8, 4, 16},
    [CELSPAN_SURFACE_RGBAF] = {16, 4, 0},
};

static const layout *layout_of(const celspan_surface *surface) {
  return &layouts[surface->desc.format];
}

size_t celspan_surface_pixel_size(celspan_surface_format format) {
  return (unsigned)format < sizeof layouts / sizeof *layouts ? layouts[format].size : 0;
}

/* ---------------------------------------------------------------- checks */

static celspan_status check_numbers(celspan_context *context, const celspan_surface_desc *desc) {
  if (desc->width < 1 || desc->height < 1 || desc->width > CS_PICTURE_SIDE ||
      desc->height > CS_PICTURE_SIDE)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "surface: its size is %d x %d; it must be 1 to %d pixels a side",
                   (int)desc->width, (int)desc->height, CS_PICTURE_SIDE);
  if ((unsigned)desc->format > CELSPAN_SURFACE_RGBAF)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "surface: format is %d; it must be 0 to %d",
                   (int)desc->format, (int)CELSPAN_SURFACE_RGBAF);
  if ((unsigned)desc->alpha > CELSPAN_ALPHA_PREMULTIPLIED)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "surface: alpha is %d; it must be 0 to %d",
                   (int)desc->alpha, (int)CELSPAN_ALPHA_PREMULTIPLIED);
  size_t row = (size_t)desc->width * layouts[desc->format].size;
  if (desc->stride != 0 && desc->stride < row)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "surface: stride is %zu; it must be 0, or %zu or more for %d pixels",
                   desc->stride, row, (int)desc->width);
  if (desc->stride > PTRDIFF_MAX / (size_t)desc->height)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "surface: stride is %zu; %d rows of it do not fit into memory", desc->stride,
                   (int)desc->height);
  return CELSPAN_OK;
}

static celspan_status check(celspan_context *context, const celspan_surface_desc *desc) {
  if (!desc->pixels == !desc->fill)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "surface: give pixels or a fill function%s",
                   desc->pixels ? ", not both" : "");
  if (desc->fill && !desc->has_key)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "surface: a fill function needs a key; its pixels cannot be compared before "
                   "they are there");
  return check_numbers(context, desc);
}

/* ---------------------------------------------------------------- making */

static cs_hash hash_of(const celspan_surface_desc *desc, bool is_reader) {
  cs_hash hash = cs_hash_begin(is_reader ? 0x72646572u : 0x73757266u);
  cs_hash_word(&hash, (uint64_t)desc->width);
  cs_hash_word(&hash, (uint64_t)desc->height);
  cs_hash_word(&hash, desc->format);
  cs_hash_word(&hash, desc->alpha);
  cs_hash_word(&hash, desc->has_key);
  for (int i = 0; desc->has_key && i < 2; i++)
    cs_hash_word(&hash, desc->key[i]);
  const unsigned char *row = desc->pixels;
  for (int32_t y = 0; !desc->has_key && y < desc->height; y++, row += desc->stride)
    cs_hash_bytes(&hash, row, (size_t)desc->width * layouts[desc->format].size);
  return cs_hash_end(hash);
}

/* Fills in missing values. Without an alpha, the colours cannot be multiplied by it. */
static void complete(celspan_surface_desc *desc) {
  const layout *shape = &layouts[desc->format];
  if (desc->stride == 0)
    desc->stride = (size_t)desc->width * shape->size;
  if (shape->channels < 4)
    desc->alpha = CELSPAN_ALPHA_STRAIGHT;
  else if (desc->alpha == CELSPAN_ALPHA_DEFAULT)
    desc->alpha = shape->bits ? CELSPAN_ALPHA_STRAIGHT : CELSPAN_ALPHA_PREMULTIPLIED;
}

static bool copy_pixels(celspan_surface *surface) {
  celspan_surface_desc *desc = &surface->desc;
  size_t row = (size_t)desc->width * layout_of(surface)->size, rows = (size_t)desc->height;
  if (rows > SIZE_MAX / row)
    return false;
  unsigned char *copy = cs_mem_resize(surface->memory, NULL, 0, row * rows);
  const unsigned char *from = desc->pixels;
  for (size_t y = 0; copy && y < rows; y++)
    memcpy(copy + y * row, from + y * desc->stride, row);
  desc->pixels = copy;
  desc->stride = row;
  surface->copied = copy ? row * rows : 0;
  return copy;
}

static celspan_status create(celspan_context *context, const celspan_surface_desc *desc,
                             bool is_reader, celspan_surface **out) {
  CS_TRY(check(context, desc));
  celspan_surface *surface;
  CS_TRY(CS_COUNTED_MAKE(context, surface));
  surface->desc = *desc;
  complete(&surface->desc);
  if (desc->pixels && !desc->release && !copy_pixels(surface)) {
    celspan_surface_unref(surface);
    return cs_fail_memory(context);
  }
  surface->hash = hash_of(&surface->desc, is_reader);
  surface->is_reader = is_reader;
  *out = surface;
  return CELSPAN_OK;
}

celspan_status celspan_surface_create(celspan_context *context, const celspan_surface_desc *desc,
                                      celspan_surface **out) {
  CS_READ(context, "surface", celspan_surface_desc, desc);
  return create(context, desc, false, out);
}

celspan_status cs_surface_create_reader(celspan_context *context, const celspan_surface_desc *desc,
                                        celspan_surface **out) {
  return create(context, desc, true, out);
}

static void destroy(celspan_surface *surface) {
  cs_memory *memory = surface->memory;
  if (surface->desc.release)
    surface->desc.release(surface->desc.user);
  cs_mem_free(memory, surface->copied ? (void *)(uintptr_t)surface->desc.pixels : NULL,
              surface->copied);
  cs_counted_free(memory, surface, sizeof *surface);
}

CS_COUNTED(celspan_surface)

/* ---------------------------------------------------------------- facts */

void cs_surface_describe(const celspan_surface *surface, cs_picture_header *out) {
  const layout *shape = layout_of(surface);
  *out = (cs_picture_header){
      .info = {.width = surface->desc.width,
               .height = surface->desc.height,
               .channels = shape->channels,
               .has_alpha = shape->channels == 4,
               .is_float = shape->bits == 0},
      .alpha = surface->desc.alpha == CELSPAN_ALPHA_PREMULTIPLIED ? CS_PICTURE_ALPHA_CODED
                                                                  : CS_PICTURE_ALPHA_STRAIGHT,
      .bits = shape->bits,
      .is_sequential = surface->is_reader,
  };
  snprintf(out->info.format, sizeof out->info.format, "memory");
  snprintf(out->info.colour, sizeof out->info.colour, "%s", shape->bits ? "srgb" : "linear");
}

bool cs_surface_stays_on_thread(const celspan_surface *surface) {
  return surface->desc.fill && !surface->desc.any_thread;
}

/* ---------------------------------------------------------------- pixels */

/* The same as below, for the most frequent pixels. */
static void widen_rgba8(const unsigned char *codes, size_t count, float *rgba) {
  typedef unsigned char bytes __attribute__((vector_size(4)));
  for (size_t i = 0; i < count; i++) {
    bytes pixel;
    memcpy(&pixel, codes + 4 * i, sizeof pixel);
    cs_v4_store(rgba + 4 * i, __builtin_convertvector(pixel, cs_v4) * (1.0f / 255));
  }
}

/* Codes to floats from 0 to 1, as a reader of files gives them. `rgba` may begin before `codes` in
 * the same memory: see the figure. */
static void widen(const layout *shape, const unsigned char *codes, size_t count, float *rgba) {
  if (shape->size == 4) {
    widen_rgba8(codes, count, rgba);
    return;
  }
  for (size_t i = 0; i < count; i++, codes += shape->size, rgba += 4) {
    float pixel[4] = {0, 0, 0, 1};
    for (int c = 0; c < shape->channels && shape->bits == 8; c++)
      pixel[c] = (float)codes[c] * (1.0f / 255);
    for (int c = 0; c < shape->channels && shape->bits == 16; c++) {
      uint16_t code;
      memcpy(&code, codes + 2 * c, sizeof code);
      pixel[c] = (float)code * (1.0f / 65535);
    }
    if (shape->channels == 1)
      pixel[1] = pixel[2] = pixel[0];
    memcpy(rgba, pixel, sizeof pixel);
  }
}

static void read_buffer(const celspan_surface *surface, const celspan_rectangle *r, float *rgba) {
  const layout *shape = layout_of(surface);
  const unsigned char *row = surface->desc.pixels;
  row += (size_t)r->y * surface->desc.stride + (size_t)r->x * shape->size;
  for (int32_t y = 0; y < r->height; y++, row += surface->desc.stride) {
    if (shape->bits == 0)
      memcpy(rgba, row, (size_t)r->width * shape->size);
    else
      widen(shape, row, (size_t)r->width, rgba);
    rgba += 4 * (size_t)r->width;
  }
}

/* own: the sentence that the fill function recorded, or "". */
static celspan_status fail_fill(celspan_context *context, const celspan_rectangle *r,
                                const char *own) {
  return cs_fail(context, CELSPAN_CALLBACK,
                 "surface: fill failed for the rectangle of %d x %d pixels at %d, %d%s%s",
                 (int)r->width, (int)r->height, (int)r->x, (int)r->y, *own ? ": " : "", own);
}

static celspan_status read_filled(celspan_context *context, const celspan_surface *surface,
                                  const celspan_rectangle *r, float *rgba) {
  const celspan_surface_desc *desc = &surface->desc;
  const layout *shape = layout_of(surface);
  size_t count = (size_t)r->width * (size_t)r->height;
  unsigned char *codes = (unsigned char *)rgba + count * (4 * sizeof *rgba - shape->size);
  int32_t rows = 0;
  context->error[0] = 0;
  celspan_status status =
      desc->fill(desc->user, context, r, codes, (size_t)r->width * shape->size, &rows);
  if (status != CELSPAN_OK && surface->is_reader)
    return status;
  if (status != CELSPAN_OK) {
    char own[sizeof context->error];
    snprintf(own, sizeof own, "%s", context->error);
    return fail_fill(context, r, own);
  }
  if (rows != r->height)
    return cs_fail(context, CELSPAN_CALLBACK,
                   "surface: fill gave %d of %d rows for the rectangle of %d x %d pixels at %d, %d",
                   (int)rows, (int)r->height, (int)r->width, (int)r->height, (int)r->x, (int)r->y);
  if (shape->bits)
    widen(shape, codes, count, rgba);
  return CELSPAN_OK;
}

celspan_status cs_surface_read(celspan_context *context, const celspan_surface *surface,
                               const celspan_rectangle *rectangle, float *rgba) {
  if (surface->desc.fill)
    return read_filled(context, surface, rectangle, rgba);
  read_buffer(surface, rectangle, rgba);
  return CELSPAN_OK;
}
