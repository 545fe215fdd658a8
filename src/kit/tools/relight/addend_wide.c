/* Loops over columns. Each number is computed by itself, so it does not depend on the set of
 * instructions. */
#include "tools/relight/addend.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

void CS_WIDE(cs_addend_split)(const float *restrict rgba, int32_t count, float *restrict red,
                              float *restrict green, float *restrict blue) {
  for (int32_t i = 0; i < count; i++) {
    red[i] = rgba[4 * i];
    green[i] = rgba[4 * i + 1];
    blue[i] = rgba[4 * i + 2];
  }
}

void CS_WIDE(cs_addend_through)(const float *restrict rgba, int32_t count,
                                float *restrict through) {
  for (int32_t i = 0; i < count; i++)
    through[i] = 1 - rgba[4 * i + 3];
}

/* Bytes: how far ahead numbers are fetched into the cache while others are added. The rows of an
 * addend are too short for a processor to predict the next addresses. */
#define AHEAD 2048

static inline void ask_ahead(const void *numbers, size_t bytes) {
  for (size_t i = 0; i < bytes; i += CS_WIDE_LINE)
    __builtin_prefetch((const char *)numbers + AHEAD + i);
}

static inline void add_constant(float *out, float value, int32_t count) {
  for (int32_t i = 0; i < count; i++)
    out[i] += value;
}

/* Adds weight * (colour + slope * (first + k)) to column k. */
static inline void add_line(float *out, float weight, float colour, float slope, int32_t first,
                            int32_t count) {
  for (int32_t i = 0; i < count; i++)
    out[i] += weight * (colour + slope * (float)(first + i));
}

static inline void add_floats(float *restrict out, const float *restrict in, float weight,
                              int32_t count) {
  ask_ahead(in, (size_t)count * sizeof *in);
  for (int32_t i = 0; i < count; i++)
    out[i] += weight * in[i];
}

static inline void add_codes(float *restrict out, const uint16_t *restrict in, float least,
                             float step, int32_t count) {
  ask_ahead(in, (size_t)count * sizeof *in);
  for (int32_t i = 0; i < count; i++)
    out[i] += least + step * (float)in[i];
}

/* Most pieces are complete: the compiler knows their length. */
static inline void add_piece(float *restrict out, const uint16_t *restrict in, float least,
                             float step, int32_t count) {
  if (count == CS_ADDEND_PIECE)
    add_codes(out, in, least, step, CS_ADDEND_PIECE);
  else
    add_codes(out, in, least, step, count);
}

/* One channel of a span. */
static inline void add_channel(const cs_addend_span *span, const float *values, int c, float weight,
                               float *out) {
  int32_t count = span->x1 - span->x0;
  int plane = span->plane_count == 1 ? 0 : c;
  size_t column = (size_t)plane * (size_t)count;
  const float *scale = values + 2 * plane; /* of CODES */
  switch ((cs_addend_kind)span->kind) {
  case CS_ADDEND_SINGLE:
    add_constant(out, weight * values[c], count);
    return;
  case CS_ADDEND_GRADIENT:
    add_line(out, weight, values[c], values[3 + c], span->x0 - span->origin, count);
    return;
  case CS_ADDEND_FLOATS:
    add_floats(out, values + column, weight, count);
    return;
  case CS_ADDEND_CODES:
    add_piece(out, (const uint16_t *)(const void *)(values + 2 * span->plane_count) + column,
              weight * scale[0], weight * scale[1], count);
    return;
  }
}

void CS_WIDE(cs_addend_add)(const cs_addend *addend, int32_t y, const float weights[3],
                            size_t stride, float *planes) {
  for (size_t i = addend->rows[y]; i < addend->rows[y + 1]; i++) {
    const cs_addend_span *span = &addend->spans[i];
    for (int c = 0; c < 3; c++)
      if (weights[c] != 0)
        add_channel(span, addend->values + span->first, c, weights[c],
                    planes + (size_t)c * stride + span->x0);
  }
}

typedef float quad __attribute__((vector_size(16)));

static inline quad load_quad(const float *from) {
  quad v;
  memcpy(&v, from, sizeof v);
  return v;
}

/* Stores without using the caches, if possible: a frame is larger than they are. */
static inline void put_quad(float *to, quad v) {
#ifdef __SSE2__
  if ((uintptr_t)to % sizeof v == 0) {
    _mm_stream_ps(to, (__m128)v);
    return;
  }
#endif
  memcpy(to, &v, sizeof v);
}

/* Four numbers of each plane, as four pixels. */
static inline void put_pixels(float *rgba, const float *planes, size_t stride, float keep) {
  quad r = load_quad(planes), g = load_quad(planes + stride), b = load_quad(planes + 2 * stride);
  quad a = 1 - keep * load_quad(planes + 3 * stride);
  quad rb = __builtin_shufflevector(r, b, 0, 4, 1, 5),
       ga = __builtin_shufflevector(g, a, 0, 4, 1, 5);
  put_quad(rgba, __builtin_shufflevector(rb, ga, 0, 4, 1, 5));
  put_quad(rgba + 4, __builtin_shufflevector(rb, ga, 2, 6, 3, 7));
  rb = __builtin_shufflevector(r, b, 2, 6, 3, 7);
  ga = __builtin_shufflevector(g, a, 2, 6, 3, 7);
  put_quad(rgba + 8, __builtin_shufflevector(rb, ga, 0, 4, 1, 5));
  put_quad(rgba + 12, __builtin_shufflevector(rb, ga, 2, 6, 3, 7));
}

void CS_WIDE(cs_addend_pixels)(const float *planes, size_t stride, float keep, int32_t count,
                               float *rgba) {
  int32_t quads = count / 4 * 4;
  for (int32_t i = 0; i < quads; i += 4)
    put_pixels(rgba + 4 * (size_t)i, planes + i, stride, keep);
  for (int32_t i = quads; i < count; i++) {
    for (int c = 0; c < 3; c++)
      rgba[4 * (size_t)i + (size_t)c] = planes[(size_t)c * stride + (size_t)i];
    rgba[4 * (size_t)i + 3] = 1 - keep * planes[3 * stride + (size_t)i];
  }
#ifdef __SSE2__
  _mm_sfence();
#endif
}
