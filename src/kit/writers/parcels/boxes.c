#include "writers/parcels/boxes.h"

#include <stdbool.h>

static bool touches(const cs_box *a, const cs_box *b) {
  return a->x0 <= b->x1 && b->x0 <= a->x1 && a->y0 <= b->y1 && b->y0 <= a->y1;
}

static cs_box around(const cs_box *a, const cs_box *b) {
  return (cs_box){a->x0 < b->x0 ? a->x0 : b->x0, a->y0 < b->y0 ? a->y0 : b->y0,
                  a->x1 > b->x1 ? a->x1 : b->x1, a->y1 > b->y1 ? a->y1 : b->y1};
}

static double area(const cs_box *box) {
  return ((double)box->x1 - box->x0) * ((double)box->y1 - box->y0);
}

/* The box that a new one becomes one with: one that it touches, or, without room, the one that
 * grows least. The count: none. */
static size_t find_partner(const cs_boxes *boxes, const cs_box *box) {
  size_t best = boxes->count;
  double least = 0;
  for (size_t i = 0; i < boxes->count; i++) {
    const cs_box both = around(&boxes->all[i], box);
    const double growth = area(&both) - area(&boxes->all[i]);
    if (touches(&boxes->all[i], box))
      return i;
    if (boxes->count == CS_BOXES && (best == boxes->count || growth < least)) {
      best = i;
      least = growth;
    }
  }
  return best;
}

void cs_boxes_add(cs_boxes *boxes, cs_box box) {
  for (size_t i; (i = find_partner(boxes, &box)) < boxes->count;) {
    box = around(&boxes->all[i], &box);
    boxes->all[i] = boxes->all[--boxes->count];
  }
  boxes->all[boxes->count++] = box;
}
