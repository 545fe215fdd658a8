#include "trace/material.h"

/* How much of b the four pixels hold; half of them: neither is favoured. */
static float share_about(const cs_material *material, int32_t x, int32_t y, size_t a, size_t b) {
  float sum = 0;
  for (int i = 0; i < 4; i++) {
    cs_light4 light = cs_scan_light(material->scan, x - 1 + i % 2, y - 1 + i / 2);
    sum += cs_labels_share(&light, &material->colours->list[a].light,
                           &material->colours->list[b].light);
  }
  return sum;
}

/* Whether b is in the minority among the 4 x 4 pixels about the corner; a line more often than the
 * ground. Where both have as many, the later colour. */
static bool is_minority(const cs_labels *labels, int32_t x, int32_t y, unsigned char a,
                        unsigned char b) {
  int excess = 0;
  for (int32_t row = y - 2; row < y + 2; row++)
    for (int32_t column = x - 2; column < x + 2; column++) {
      if (row < 0 || row >= labels->height || column < 0 || column >= labels->width)
        continue;
      unsigned char label = *cs_labels_at(labels, column, row);
      excess += (label == b) - (label == a);
    }
  return excess != 0 ? excess < 0 : b > a;
}

cs_join cs_material_join(const cs_material *material, int32_t x, int32_t y) {
  const cs_labels *labels = material->labels;
  unsigned char a = *cs_labels_at(labels, x - 1, y - 1), b = *cs_labels_at(labels, x, y - 1);
  unsigned char c = *cs_labels_at(labels, x - 1, y), d = *cs_labels_at(labels, x, y);
  if (a != d || b != c)
    return a == d ? CS_JOIN_NW_SE : b == c ? CS_JOIN_NE_SW : CS_JOIN_NONE;
  float share = share_about(material, x, y, a, b);
  if (share > 2.05f || share < 1.95f)
    return share > 2 ? CS_JOIN_NE_SW : CS_JOIN_NW_SE;
  return is_minority(labels, x, y, a, b) ? CS_JOIN_NE_SW : CS_JOIN_NW_SE;
}
