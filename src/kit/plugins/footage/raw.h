/* Raw pictures: planes as ffmpeg writes them, one after the other without gaps, and their colours
 * as R'G'B' codes.
 *
 *   4:2:0   Y Y Y Y     samples of colour lie between or upon those of light: here on the left of
 *           C   C       each pair, half-way between two rows. Between two of them colour is
 *           Y Y Y Y     linear.
 *
 * INVARIANT: plain arithmetic of floats in one order, so that the codes are the same on every
 * machine. Samples beyond the edge repeat the edge.
 */
#pragma once

#include "inside/context.h"

/* What the planes of a raw picture hold, and what their codes mean. */
typedef struct cs_raw {
  int32_t width, height; /* pixels, as stored */
  int bits; /* the bits of a sample: 8 to 16; of more than 8 in two bytes, the low one first */
  bool has_colour, is_rgb; /* is_rgb: planes of G', B', R' instead of Y', Cb, Cr */
  bool has_alpha, is_full; /* is_full: codes use their whole range */
  bool is_made;            /* ffmpeg makes R'G'B' of another kind of colours, in the whole range */
  int32_t across, down;    /* pixels for a sample of colour: 1 or 2 */
  float site_x, site_y;    /* of the first sample of colour, in pixels right and down of the first
                               sample of light */
  float red, blue;         /* the shares of red and blue in light */
  int turns;               /* quarters clockwise, for the picture to be upright */
} cs_raw;

/* The shares of a matrix by ffmpeg's name of it; "unknown" depends on the height. NULL: it is of
 * another kind. */
const float *cs_raw_matrix(const char *name, int32_t height);
/* The name of the matrix by which these planes become R'G'B': "none" where they are, or are
 * grey. */
const char *cs_raw_matrix_taken(const cs_raw *planes, const char *name, int32_t height);
/* Whether a form of pixels holds other colours than R'G'B' and Y'CbCr, which are not read: X'Y'Z'
 * of digital cinema, and what a sensor has under its filters. */
bool cs_raw_is_foreign(const char *name);
/* Reads ffmpeg's name of a form of pixels. wanted: the form that ffmpeg shall write: the same; or,
 * where its planes are not read here, another one, to which `out` belongs. */
void cs_raw_parse(const char *name, cs_raw *out, char wanted[16]);
/* Sets the range by ffmpeg's name of it. Without one, R'G'B' have the whole range, and Y'CbCr the
 * limited one, unless their form says more. */
void cs_raw_set_range(cs_raw *planes, const char *name);
/* Sets the place of colour's samples by ffmpeg's name of it. */
void cs_raw_set_site(cs_raw *planes, const char *name);
/* Bytes of a picture. */
size_t cs_raw_size(const cs_raw *planes);
/* Bytes of an upright pixel: 4, or 8 where a sample has more than 8 bits. */
size_t cs_raw_pixel(const cs_raw *planes);
/* The upright size. */
void cs_raw_upright(const cs_raw *planes, int32_t *width, int32_t *height);
/* Writes a rectangle of the upright picture: R'G'B'A codes of 8 or 16 bits. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_raw_convert(const cs_raw *planes, celspan_context *context,
                                              const unsigned char *picture,
                                              const celspan_rectangle *rectangle,
                                              unsigned char *out, size_t stride);

/* ---- raw_row.c */

/* Floats of room for `count` columns of a row. */
size_t cs_raw_room(int32_t count);

/* Columns [x, x + count) of row y as stored: R'G'B'A codes of 8 or 16 bits. */
void cs_raw_row(const cs_raw *planes, const unsigned char *picture, int32_t x, int32_t y,
                int32_t count, float *room, void *out);
