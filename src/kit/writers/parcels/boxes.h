/* Boxes of pixels that neither overlap nor touch, each around things that do.
 *
 *     .---.              a box that is added becomes one with those that it overlaps or touches,
 *     | a |  .------.    until none is left; without room for it, it becomes one with the box that
 *     '---'  | b, c |    grows least
 *            '------'
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

enum { CS_BOXES = 64 /* at most */ };

/* Columns x0 to x1 - 1 and rows y0 to y1 - 1. */
typedef struct cs_box {
  int32_t x0, y0, x1, y1;
} cs_box;

typedef struct cs_boxes {
  cs_box all[CS_BOXES];
  size_t count;
} cs_boxes;

void cs_boxes_add(cs_boxes *boxes, cs_box box);
