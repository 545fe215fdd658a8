/* A scanned drawing in memory: its pixels, how bright its paper is, and where the paper ends.
 *
 *   picture --trace/colours.h--> codes --> spots, the mean brightness of side x side pixels
 *     |--> edges: a straight line along each side
 *     |--> field: the paper's brightness, at posts
 *     '--> spots / field: 1 is paper
 *
 * The field follows the shadow of a binding and the lamp of a scanner, but neither what is drawn
 * nor holes: what is narrower than about 20 millimetres on A4 is filled in, dark or bright.
 *
 * INVARIANT: brightness is that of sRGB's codes, 0..1. Everything is a function of the pixels.
 */
#pragma once

#include "tools/trace/colours.h"

#define CS_ROUGH_HOLES 16
#define CS_ROUGH_PAD 4 /* posts around those of the page */

typedef struct cs_rough {
  celspan_context *context;
  cs_scan scan;
  int32_t side;          /* of a spot, in pixels */
  int32_t width, height; /* in spots */
  float *spots;          /* row-major, as shares of the field; beside the paper 1 */
  float code[3];         /* of the paper, 0..1 */
  float paper;           /* its brightness */
  /* Left, top, right, bottom: how many pixels a side of the paper lies inside of the picture, at
   * the beginning of the picture's side, and how many more with each pixel along it. */
  double edges[4][2];
  bool has_edge[4];                  /* the paper ends inside of the picture */
  int32_t across, down;              /* posts of the field, with the pads */
  float *field, *row;                /* row-major; scratch for cs_rough_field */
  celspan_box holes[CS_ROUGH_HOLES]; /* in pixels: what was found of holes.h */
  size_t hole_count;
} cs_rough;

/* How the paper lies, by its four sides. */
typedef struct cs_rough_place {
  double turn;  /* radians clockwise */
  double x, y;  /* of its middle, in pixels */
  double error; /* radians: how far a side is from its direction, at most */
} cs_rough_place;

static inline float cs_rough_brightness(const unsigned char *code) {
  return (float)(77 * code[0] + 150 * code[1] + 29 * code[2]) * (1.0f / (255 * 256));
}

/* Errors: those of pictures; LIMIT; NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_rough_create(celspan_context *context, const cs_picture *picture,
                                               cs_rough **out);
void cs_rough_destroy(cs_rough *page); /* NULL is ignored */
/* The columns first .. end - 1 of row y that lie on the paper, `margin` spots from its ends. */
void cs_rough_row(const cs_rough *page, int32_t y, double margin, int32_t *first, int32_t *end);
/* The field at the middles of the pixels of row y, until the next call. */
const float *cs_rough_field(const cs_rough *page, int32_t y);
/* False if a side of the paper is not in the picture. */
bool cs_rough_paper(const cs_rough *page, cs_rough_place *out);
