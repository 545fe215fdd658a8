/* The elements that gradients and patterns paint, and the resulting textures. */
#pragma once

#include "readers/svg/reading.h"

typedef enum cs_svg_server_kind {
  CS_SVG_SERVER_NOTHING, /* nothing is painted */
  CS_SVG_SERVER_FLAT,    /* one paint; the matrix is the identity */
  CS_SVG_SERVER_TEXTURE  /* a gradient or a pattern, in units of its own */
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
  celspan_box box;     /* of its outline, in its user units */
  celspan_box painted; /* around all of it that is painted, in the same */
  double opacity;
  const celspan_matrix *matrix; /* the same units to the drawing's */
  const cs_svg_open *open;      /* the element itself and the open elements around it */
} cs_svg_painted;
