/* A plane of alpha turned and moved, by the bicubic filter of Catmull and Rom: sharp, and a plane
 * that only moves by whole pixels is copied. Where nothing is drawn nothing is summed. */
#pragma once

#include <stdint.h>

typedef struct cs_turn {
  double turn;           /* radians clockwise */
  double x, y;           /* a place in the plane, in pixels */
  double to_x, to_y;     /* where it comes to lie */
  int32_t width, height; /* of the plane */
} cs_turn;

/* Fills row y of the turned plane, `width` pixels. */
void cs_turn_row(const cs_turn *turn, const uint8_t *plane, int32_t y, int32_t width, uint8_t *row);
