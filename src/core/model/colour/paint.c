#include "model/colour/paint.h"

#include <string.h>

#include "base/hex.h"
#include "base/number.h"
#include "model/colour/transfer.h"

/* ---------------------------------------------------------------- straight values */

celspan_paint celspan_paint_rgb(float r, float g, float b, float alpha) {
  return (celspan_paint){{r, g, b}, {1, 1, 1}, alpha};
}

celspan_paint celspan_paint_gel(float r, float g, float b) {
  return (celspan_paint){{0, 0, 0}, {r, g, b}, 0};
}

celspan_paint celspan_paint_clear(void) { return celspan_paint_gel(1, 1, 1); }

/* The mean of a and b with weights p and q. If both weights are 0 the value has no effect, and the
 * plain mix keeps it between a and b. */
static float weighted_mean(float a, float p, float b, float q, float u) {
  return p + q > 0 ? (p * a + q * b) / (p + q) : (1 - u) * a + u * b;
}

celspan_paint celspan_paint_mix(celspan_paint p, celspan_paint q, float u) {
  u = u > 0 ? cs_number_clampf(u, 0, 1) : 0;
  celspan_paint mix = {.beta = (1 - u) * p.beta + u * q.beta};
  for (int c = 0; c < 3; c++) {
    mix.pigment[c] = weighted_mean(p.pigment[c], (1 - u) * p.beta, q.pigment[c], u * q.beta, u);
    mix.medium[c] =
        weighted_mean(p.medium[c], (1 - u) * (1 - p.beta), q.medium[c], u * (1 - q.beta), u);
  }
  return mix;
}

bool celspan_paint_parse(const char *text, celspan_paint *out) {
  size_t length = text && text[0] == '#' ? strlen(text + 1) : 0;
  bool is_short = length == 3 || length == 4, has_alpha = length == 4 || length == 8;
  if (!is_short && length != 6 && length != 8)
    return false;
  int digits[8];
  for (size_t i = 0; i < length; i++)
    if ((digits[i] = cs_hex_digit(text[1 + i])) < 0)
      return false;
  int codes[4] = {0, 0, 0, 255};
  for (size_t i = 0; i < (has_alpha ? 4u : 3u); i++)
    codes[i] = is_short ? 17 * digits[i] : 16 * digits[2 * i] + digits[2 * i + 1];
  float rgb[3];
  for (int c = 0; c < 3; c++)
    rgb[c] = cs_transfer_decode(CELSPAN_TRANSFER_SRGB, (float)codes[c] / 255);
  *out = celspan_paint_rgb(rgb[0], rgb[1], rgb[2], (float)codes[3] / 255);
  return true;
}

/* ---------------------------------------------------------------- premultiplied */

bool cs_paint_is_valid(const celspan_paint *paint) {
  bool valid = paint->beta >= 0 && paint->beta <= 1;
  for (int c = 0; c < 3; c++)
    valid = valid && paint->pigment[c] >= 0 && paint->pigment[c] <= 1 && paint->medium[c] >= 0 &&
            paint->medium[c] <= 1;
  return valid;
}

cs_paint cs_paint_from_straight(const celspan_paint *paint) {
  cs_paint result = {.beta = paint->beta};
  for (int c = 0; c < 3; c++) {
    result.s[c] = paint->beta * paint->pigment[c];
    result.t[c] = (1 - paint->beta) * paint->medium[c];
  }
  return result;
}

cs_paint cs_paint_from_picture(const float rgba[4], celspan_picture_use use) {
  bool is_gel = use == CELSPAN_PICTURE_GEL;
  float alpha = cs_number_clampf(rgba[3], 0, 1);
  cs_paint paint = {.beta = is_gel ? 0 : alpha};
  for (int c = 0; c < 3; c++) {
    paint.s[c] = is_gel ? 0 : rgba[c];
    paint.t[c] = is_gel ? cs_number_clampf(1 - alpha + rgba[c], 0, 1) : 1 - alpha;
  }
  return paint;
}

cs_paint cs_paint_fade(cs_paint paint, float weight) {
  if (weight == 1) /* because 1 - (1 - t) would lose bits of a small t */
    return paint;
  for (int c = 0; c < 3; c++) {
    paint.s[c] *= weight;
    paint.t[c] = 1 - weight * (1 - paint.t[c]);
  }
  paint.beta *= weight;
  return paint;
}

cs_paint cs_paint_mix(const cs_paint *p, const cs_paint *q, float u) {
  cs_paint paint = {.beta = p->beta + u * (q->beta - p->beta)};
  for (int c = 0; c < 3; c++) {
    paint.s[c] = p->s[c] + u * (q->s[c] - p->s[c]);
    paint.t[c] = p->t[c] + u * (q->t[c] - p->t[c]);
  }
  return paint;
}
