/* The loops over the samples and the pixels of a raw picture. Every product and sum is written out
 * in its order. */
#include "plugins/footage/raw_row.h"

static void widen_bytes(const unsigned char *restrict a, const unsigned char *restrict b,
                        float share, int32_t count, float *restrict out) {
  for (int32_t i = 0; i < count; i++)
    out[i] = (float)a[i] + (float)(b[i] - a[i]) * share;
}

/* Samples of two bytes, the low one first. */
static void widen_words(const unsigned char *restrict a, const unsigned char *restrict b,
                        float share, int32_t count, float *restrict out) {
  for (int32_t i = 0; i < count; i++) {
    int32_t upper = a[2 * i] | a[2 * i + 1] << 8, lower = b[2 * i] | b[2 * i + 1] << 8;
    out[i] = (float)upper + (float)(lower - upper) * share;
  }
}

void CS_WIDE(cs_raw_widen)(const unsigned char *a, const unsigned char *b, float share, int bytes,
                           int32_t count, float *out) {
  if (bytes == 1)
    widen_bytes(a, b, share, count, out);
  else
    widen_words(a, b, share, count, out);
}

void CS_WIDE(cs_raw_spread)(const float *restrict samples, const float shares[2], int32_t count,
                            float *restrict out) {
  const float even = shares[0], odd = shares[1];
  for (int32_t i = 0; i < count; i++) {
    float before = samples[i], at = samples[i + 1], after = samples[i + 2];
    out[2 * i] = before + (at - before) * even;
    out[2 * i + 1] = at + (after - at) * odd;
  }
}

void CS_WIDE(cs_raw_scale)(float black, float scale, int32_t count, float *values) {
  for (int32_t i = 0; i < count; i++)
    values[i] = (values[i] - black) * scale;
}

void CS_WIDE(cs_raw_mix)(const cs_raw_shares *by, int32_t count, float *restrict red,
                         float *restrict green, float *restrict blue) {
  const cs_raw_shares s = *by;
  for (int32_t i = 0; i < count; i++) {
    float y = red[i], cb = green[i], cr = blue[i];
    red[i] = y + s.red_cr * cr;
    blue[i] = y + s.blue_cb * cb;
    green[i] = y - s.green_cb * cb - s.green_cr * cr;
  }
}

static inline int32_t code(float value, float most) {
  value = value < 0 ? 0 : value;
  value = value > 1 ? 1 : value;
  return (int32_t)(value * most + .5f);
}

static void put_bytes(const float *restrict red, const float *restrict green,
                      const float *restrict blue, const float *restrict alpha, int32_t count,
                      unsigned char *restrict out) {
  for (int32_t i = 0; i < count; i++) {
    out[4 * i] = (unsigned char)code(red[i], 255);
    out[4 * i + 1] = (unsigned char)code(green[i], 255);
    out[4 * i + 2] = (unsigned char)code(blue[i], 255);
    out[4 * i + 3] = (unsigned char)code(alpha[i], 255);
  }
}

static void put_words(const float *restrict red, const float *restrict green,
                      const float *restrict blue, const float *restrict alpha, int32_t count,
                      uint16_t *restrict out) {
  for (int32_t i = 0; i < count; i++) {
    out[4 * i] = (uint16_t)code(red[i], 65535);
    out[4 * i + 1] = (uint16_t)code(green[i], 65535);
    out[4 * i + 2] = (uint16_t)code(blue[i], 65535);
    out[4 * i + 3] = (uint16_t)code(alpha[i], 65535);
  }
}

void CS_WIDE(cs_raw_put)(float *const rows[4], int32_t count, bool is_deep, void *out) {
  if (is_deep)
    put_words(rows[0], rows[1], rows[2], rows[3], count, out);
  else
    put_bytes(rows[0], rows[1], rows[2], rows[3], count, out);
}
