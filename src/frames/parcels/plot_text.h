/* The text of SVG drawings: numbers, paths and pictures.
 *
 * Invariant: coordinates are rounded once, to a grid of the precision; what follows a point is a
 * difference on the grid, so that equal points remain equal.
 */
#pragma once

#include "frames/parcels/parcels.h"
#include "output/sinks/file.h"

typedef struct cs_plot_text {
  celspan_context *context;
  const char *path;
  cs_file *file;
  int precision;
  double grid;           /* steps in a unit */
  int64_t x, y;          /* where the path is */
  char command;          /* its last one; 0: none */
  celspan_status status; /* the first failure: nothing is written after it */
} cs_plot_text;

void cs_plot_put(cs_plot_text *out, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* A number with so many digits after the point at most, and none that say nothing. */
void cs_plot_put_number(cs_plot_text *out, double number, int digits);
int64_t cs_plot_round(const cs_plot_text *out, double coordinate);

/* A path is begun, and moves, lines and arcs follow. A line to where the path is, is left out. */
void cs_plot_begin_path(cs_plot_text *out);
void cs_plot_move(cs_plot_text *out, celspan_point to);
void cs_plot_line(cs_plot_text *out, celspan_point to);
void cs_plot_arc(cs_plot_text *out, const cs_parcels *parcels, cs_parcel_walk walk);
/* Loops, closed. */
void cs_plot_loops(cs_plot_text *out, const cs_parcels *parcels, size_t first, size_t count);

/* A part of a picture of width x height pixels that stands for the whole film. */
typedef struct cs_plot_picture {
  int32_t width, height, x, y, columns, rows;
  bool is_opaque;
  celspan_status (*draw)(const struct cs_plot_picture *picture, celspan_context *context,
                         const celspan_sink *sink);
  const celspan_plane *plane;      /* what it shows: a plane, */
  const celspan_frame_desc *frame; /* or a frame */
} cs_plot_picture;
/* Puts an image with the bytes of a PNG file. film_width, film_height: in units. */
void cs_plot_put_picture(cs_plot_text *out, const cs_plot_picture *picture, double film_width,
                         double film_height);
