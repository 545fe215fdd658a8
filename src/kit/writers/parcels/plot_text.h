/* The text of SVG drawings: numbers and paths; and the bytes of any drawing's file.
 *
 * Invariant: coordinates are rounded once, to a grid of the precision; what follows a point is a
 * difference on the grid, so that equal points remain equal.
 */
#pragma once

#include "celspan/celspan.h"
#include "inside/sinks.h"
#include "writers/parcels/plotter.h"

typedef struct cs_plot_text {
  celspan_context *context;
  cs_file *file;
  const char *title; /* the title of the film; NULL: none; borrowed */
  int precision;
  double grid;              /* steps in a unit */
  int64_t x, y;             /* where the path is */
  int64_t begin_x, begin_y; /* where it began */
  char command;             /* the last command of the text; 0: none */
  celspan_status status;    /* the first failure: nothing is written after it */
} cs_plot_text;

void cs_plot_put(cs_plot_text *out, const char *format, ...) __attribute__((format(printf, 2, 3)));
void cs_plot_put_bytes(cs_plot_text *out, const void *bytes, size_t size);
/* All bytes of a group but the last are a multiple of 3. */
void cs_plot_put_base64(cs_plot_text *out, const unsigned char *bytes, size_t size);
/* A number with so many digits after the point at most, and none that say nothing. */
void cs_plot_put_number(cs_plot_text *out, double number, int digits);
int64_t cs_plot_round(const cs_plot_text *out, double coordinate);

/* A path is begun, and moves, lines and curves follow. What leads to where the path is, is left
 * out. */
void cs_plot_begin_path(cs_plot_text *out);
void cs_plot_move(cs_plot_text *out, celspan_point to);
void cs_plot_line(cs_plot_text *out, celspan_point to);
/* points: after the one where the path is. */
void cs_plot_curve(cs_plot_text *out, const celspan_point points[3]);
void cs_plot_close(cs_plot_text *out);

/* The plotter of SVG, over the text of a file. */
void cs_plot_svg_open(cs_plot_text *text, cs_plotter *out);
/* The plotter of PDF, which a module has; it puts bytes into the file of a text. Errors: OUTPUT if
 * there is no module, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_plot_pdf_open(cs_plot_text *text, cs_plotter *out);
