/* Pictures in drawings. */
#pragma once

#include "writers/parcels/plotter.h"

/* A part of a picture of width x height pixels that stands for the whole film. */
typedef struct cs_plot_picture {
  int32_t width, height, x, y, columns, rows;
  bool is_opaque;
  celspan_status (*draw)(const struct cs_plot_picture *picture, celspan_context *context,
                         const celspan_sink *sink);
  const celspan_plane *plane;      /* what it shows: a plane, */
  const celspan_frame_desc *frame; /* or a frame */
} cs_plot_picture;

/* Puts a picture into the drawing of the file `path`. film: its size in units. Errors: those of
 * drawing it and of a file beside that of the drawing. */
CELSPAN_CHECKED celspan_status cs_plot_picture_put(celspan_context *context, const char *path,
                                                   const cs_plot_picture *picture,
                                                   celspan_point film, const cs_plotter *to);
