#include "output/sinks/ycbcr.h"

#include "model/colour/primaries.h"

/* The bytes of a pixel, for both byte orders of machines. */
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define BYTE(pixel, i) (int32_t)((pixel) >> (24 - 8 * (i)) & 255)
#else
#define BYTE(pixel, i) (int32_t)((pixel) >> 8 * (i)&255)
#endif

#define RED CS_LUMA_RED
#define GREEN CS_LUMA_GREEN
#define BLUE CS_LUMA_BLUE
#define LUMA (219 / 255.0)
#define CB (224 / 255.0 / (2 - 2 * BLUE))
#define CR (224 / 255.0 / (2 - 2 * RED))

/* The amount that a code of each channel adds to the sum. */
static const float LUMA_OF[3] = {(float)(LUMA * RED), (float)(LUMA *GREEN), (float)(LUMA *BLUE)};
static const float CB_OF[3] = {(float)(-CB * RED), (float)(-CB *GREEN), (float)(CB *(1 - BLUE))};
static const float CR_OF[3] = {(float)(CR * (1 - RED)), (float)(-CR *GREEN), (float)(-CR *BLUE)};

/* The sums are above 0, so cutting off the fraction rounds them. */
static inline unsigned char mixed(const float of[3], float base, float r, float g, float b) {
  return (unsigned char)(int32_t)(base + (of[0] * r + of[1] * g + of[2] * b));
}

void CS_WIDE(cs_ycbcr_luma)(const uint32_t *restrict pixels, int32_t count,
                            unsigned char *restrict luma) {
#pragma omp simd
  for (int32_t i = 0; i < count; i++) {
    uint32_t pixel = pixels[i];
    luma[i] =
        mixed(LUMA_OF, 16.5f, (float)BYTE(pixel, 0), (float)BYTE(pixel, 1), (float)BYTE(pixel, 2));
  }
}

void CS_WIDE(cs_ycbcr_chroma)(const uint32_t *restrict pixels, int32_t count,
                              unsigned char *restrict cb, unsigned char *restrict cr) {
#pragma omp simd
  for (int32_t i = 0; i < count; i++) {
    uint32_t pixel = pixels[i];
    float r = (float)BYTE(pixel, 0), g = (float)BYTE(pixel, 1), b = (float)BYTE(pixel, 2);
    cb[i] = mixed(CB_OF, 128.5f, r, g, b);
    cr[i] = mixed(CR_OF, 128.5f, r, g, b);
  }
}

void CS_WIDE(cs_ycbcr_halved)(const uint32_t *restrict upper, const uint32_t *restrict lower,
                              int32_t count, unsigned char *restrict cb,
                              unsigned char *restrict cr) {
#pragma omp simd
  for (int32_t i = 0; i < count; i++) {
    uint32_t p = upper[2 * i], q = upper[2 * i + 1], s = lower[2 * i], t = lower[2 * i + 1];
    float r = 0.25f * (float)(BYTE(p, 0) + BYTE(q, 0) + BYTE(s, 0) + BYTE(t, 0));
    float g = 0.25f * (float)(BYTE(p, 1) + BYTE(q, 1) + BYTE(s, 1) + BYTE(t, 1));
    float b = 0.25f * (float)(BYTE(p, 2) + BYTE(q, 2) + BYTE(s, 2) + BYTE(t, 2));
    cb[i] = mixed(CB_OF, 128.5f, r, g, b);
    cr[i] = mixed(CR_OF, 128.5f, r, g, b);
  }
}
