/* A plane of alpha in one colour as a surface, which is turned and moved when it is read, by the
 * bicubic filter of Catmull and Rom: sharp, and what only moves by whole pixels is copied. Where
 * nothing is drawn nothing is summed. */
#pragma once

#include "inside/pictures.h"

typedef struct cs_layer_place {
  double turn;           /* radians clockwise */
  double x, y;           /* a place in the plane, in pixels */
  double to_x, to_y;     /* where it comes to lie */
  int32_t width, height; /* of the surface */
} cs_layer_place;

typedef struct cs_layer_desc {
  uint8_t *plane; /* taken over, even after a failure */
  int32_t width, height;
  unsigned char code[3];
  cs_layer_place place;
} cs_layer_desc;

/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_layer_create(celspan_context *context, const cs_layer_desc *desc,
                                               celspan_surface **out);
