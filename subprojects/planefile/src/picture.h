/* Pictures of cells that vary: their code, and their colours at pixels of the frame.
 *
 *     frame: a pixel        picture: its footprint, a parallelogram
 *     +-------+                  ________
 *     |   o   |  --axis-->      /   o   /
 *     +-------+                /_______/
 *
 *     level 0   +--+--+--+--+--+     a texel of a level is the mean of two by two of the one below,
 *     level 1   +-----+-----+--+     those of the last row and column of what is left
 *
 * Where a pixel covers less than a texel, texels are mixed about its centre; where it covers more,
 * it shows the mean of its footprint: the exact mean where the picture's edges lie along the
 * frame's, otherwise the mean of taps spread over the footprint.
 *
 * INVARIANT: a colour is a function of the picture, the axis and the place of the pixel in the
 * frame. Nothing outside the picture's texels is read, whatever the axis.
 */
#pragma once

#include "coder.h"

enum { PF_BATCH = 64, PF_CURVE = 4096, PF_LEVELS = 21 };

/* Light of sRGB codes, at even steps from 0 to 1, and one more; and of all 8-bit codes. */
typedef struct pf_light_curve {
  float light[PF_CURVE + 2], codes[256];
} pf_light_curve;

/* Neighbouring pixels of one row. */
typedef struct pf_pixels {
  uint32_t width, height; /* the width and height of the frame */
  uint32_t x, y, count;   /* at most BATCH */
} pf_pixels;

/* Colours, WHITE is 1. */
typedef struct pf_colours {
  float channels[4][PF_BATCH];
} pf_colours;

/* Whether it lies flat: its w is 1 everywhere. */
static inline bool pf_axis_is_affine(const planefile_axis *axis) {
  return axis->w[0] == 0 && axis->w[1] == 0 && axis->w[2] == 1;
}

/* A pixel of a picture: as it is coded; as it is drawn. */
typedef union pf_texel {
  int32_t coded[4];
  float light[4];
} pf_texel;

typedef struct pf_picture {
  uint32_t width, height;
  pf_texel *texels; /* level by level */
  size_t texel_count;
  size_t starts[PF_LEVELS + 1]; /* the starts of each level */
  int level_count;
} pf_picture;

/* Whether a picture is as planefile.h says. */
bool pf_picture_is_good(const planefile_picture *picture);
/* The payload of its record. */
planefile_status pf_picture_encode(const pf_memory *memory, const planefile_picture *picture,
                                   pf_encoder *out);

/* The payload of a record. */
typedef struct pf_picture_code {
  const unsigned char *bytes;
  size_t size;
} pf_picture_code;
/* out: empty; must be freed whatever happens. Returns why it is refused, or NULL. */
const char *pf_picture_decode(const planefile_source *source, const pf_memory *memory,
                              const pf_light_curve *curve, pf_picture_code code, pf_picture *out);
extern const char pf_no_memory[]; /* such a reason, too */
static inline void pf_picture_free(const pf_memory *memory, pf_picture *picture) {
  pf_free(memory, picture->texels, sizeof *picture->texels, picture->texel_count);
}

/* Room for all levels of a picture that has a size. False: no memory. */
bool pf_picture_make(const pf_memory *memory, pf_picture *picture);
/* Fills the levels from level 0. */
void pf_picture_fill(pf_picture *picture);
/* The colours at the middles of pixels. */
void pf_picture_colours(const pf_picture *picture, const planefile_axis *axis,
                        const pf_pixels *pixels, pf_colours *out);
