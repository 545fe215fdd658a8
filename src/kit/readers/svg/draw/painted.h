/* Gradients and patterns: from an element of the file to a texture for the shape that is painted.
 *
 *      gradient's own units --gradientTransform--> --objectBoundingBox--> user units of the shape
 *
 * The texture stays in the gradient's own units, where a circle is a circle; so the shape is
 * brought there and taken back as an object. SVG interpolates colours as they are coded and with
 * straight alpha; stops are added until what lies between two of them differs from that by less
 * than 1/255.
 *
 *      contents --viewBox or patternContentUnits--> the pattern's units --patternTransform--> user
 *                                                   x, y, width, height: the box that repeats
 */
#pragma once

#include "readers/svg/document/reading.h"

#define CS_SVG_STOPS 4096 /* the most stops of one texture */

typedef enum cs_svg_server_kind {
  CS_SVG_SERVER_NOTHING, /* nothing is painted */
  CS_SVG_SERVER_FLAT,    /* one paint; the matrix is the identity */
  CS_SVG_SERVER_TEXTURE  /* a gradient or a pattern, in its own units */
} cs_svg_server_kind;

typedef struct cs_svg_server {
  cs_svg_server_kind kind;
  celspan_texture *texture; /* new; NULL with NOTHING */
  celspan_matrix matrix;    /* the texture's units to the shape's; not singular */
} cs_svg_server;

/* The shape that is painted. */
typedef struct cs_svg_painted {
  const cs_svg_node *node;
  const cs_svg_measure *measure;
  celspan_box box;     /* the box of the shape's outline, in the user units of the shape */
  celspan_box painted; /* the box around everything that is painted, in the same units */
  double opacity;
  const celspan_matrix *matrix; /* from the same units to the drawing's */
  const cs_svg_open *open;      /* the element itself and the open elements around it */
} cs_svg_painted;

static inline bool cs_svg_is_gradient(const cs_svg_node *node) {
  return node->element == CS_SVG_ELEMENT_LINEAR_GRADIENT ||
         node->element == CS_SVG_ELEMENT_RADIAL_GRADIENT;
}

/* The texture of a gradient, or of a pattern. *is_missing: nothing is painted, since units are
 * shares of a box without a size, or the repeated box has no size. Errors: NO_MEMORY, LIMIT (of
 * patterns: too deep inside each other), INPUT. */
CELSPAN_CHECKED celspan_status cs_svg_gradient_make(cs_svg_reading *reading,
                                                    const cs_svg_node *node,
                                                    const cs_svg_painted *shape, bool *is_missing,
                                                    cs_svg_server *out);
CELSPAN_CHECKED celspan_status cs_svg_pattern_make(cs_svg_reading *reading, const cs_svg_node *node,
                                                   const cs_svg_painted *shape, bool *is_missing,
                                                   cs_svg_server *out);
