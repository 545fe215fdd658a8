/* What puts the parts of a drawing into a file: as the text of SVG, or through Cairo as PDF.
 *
 *     begin_page -> gradients -> groups -> end_page      once for SVG, for each page of a PDF
 *     group:   [a CLIP path] -> begin_group -> paths, a picture, groups -> end_group
 *     path:    begin_path -> (move -> line, curve... -> [close])... -> end_path
 *     picture: begin_picture -> bytes... -> end_picture
 *     close                                              in any case
 *
 * Invariant: a failure sticks: what follows it is ignored, and end_page and close return it.
 */
#pragma once

#include <stdbool.h>

#include "writers/parcels/parcels.h"

typedef struct cs_plotter_page {
  double width, height; /* film units */
  double across, down;  /* the size of the page: pixels of SVG, points of PDF */
} cs_plotter_page;

typedef enum cs_plotter_kind {
  CS_PLOTTER_AREA,   /* filled by the even-odd rule */
  CS_PLOTTER_STROKE, /* with round ends, as thick as its group says */
  CS_PLOTTER_CLIP    /* cuts the group that begins after it; by the even-odd rule */
} cs_plotter_kind;

typedef struct cs_plotter_path {
  cs_plotter_kind kind;
  const char *name;          /* the name of a clip; the rest is for the others */
  uint32_t number;           /* the number of the fill */
  const cs_fill *fill;       /* FLAT, LINEAR or RADIAL */
  const cs_fill_stop *stops; /* the stops of this fill */
} cs_plotter_path;

typedef struct cs_plotter_group {
  const char *clip; /* the name of the clip path before it; NULL: there is none */
  double stroke;    /* how thick its lines are, in units; 0: it has none */
} cs_plotter_group;

/* A picture over a part of the film, in units; its bytes are those of a PNG file. All pieces but
 * the last are a multiple of 3 bytes. */
typedef struct cs_plotter_picture {
  double x, y, width, height;
  int32_t columns, rows;
} cs_plotter_picture;

typedef struct cs_plotter {
  void *user;
  void (*begin_page)(void *user, const cs_plotter_page *page);
  void (*gradients)(void *user, const cs_parcels *parcels);
  void (*begin_group)(void *user, const cs_plotter_group *group);
  void (*end_group)(void *user, const cs_plotter_group *group);
  void (*begin_path)(void *user, const cs_plotter_path *path);
  void (*move)(void *user, celspan_point to);
  void (*line)(void *user, celspan_point to);
  void (*curve)(void *user, const celspan_point points[3]);
  void (*close_path)(void *user);
  void (*end_path)(void *user, const cs_plotter_path *path);
  void (*begin_picture)(void *user, const cs_plotter_picture *picture);
  void (*bytes)(void *user, const unsigned char *bytes, size_t size);
  void (*end_picture)(void *user);
  /* *reason: set if the status is not OK. */
  celspan_status (*end_page)(void *user, const char **reason);
  celspan_status (*close)(void *user, const char **reason);
} cs_plotter;

/* The plotter of a file of C whose functions have the names of the members. */
#define CS_PLOTTER(state)                                                                          \
  (cs_plotter) {                                                                                   \
    .user = (state), .begin_page = begin_page, .gradients = gradients, .begin_group = begin_group, \
    .end_group = end_group, .begin_path = begin_path, .move = move, .line = line, .curve = curve,  \
    .close_path = close_path, .end_path = end_path, .begin_picture = begin_picture,                \
    .bytes = bytes, .end_picture = end_picture, .end_page = end_page, .close = close_file          \
  }

/* ---------------------------------------------------------------- the PDF module */

#define CS_PDF_MODULE_VERSION 2u
#define CS_PDF_SIDE 14400 /* points, at most: more is beyond what programs show */

typedef struct cs_pdf_output {
  const char *maker; /* the program, for the head of the file; copied */
  const char *title; /* the title of the film, likewise; NULL: none */
  /* Appends bytes to the file; false: that failed. */
  bool (*put)(void *user, const void *bytes, size_t size);
  void *user;
} cs_pdf_output;

typedef struct cs_pdf_module {
  uint32_t version;
  /* Errors: NO_MEMORY. Any thread; a file belongs to one at a time. */
  celspan_status (*open)(const cs_pdf_output *output, cs_plotter *out);
} cs_pdf_module;

/* The only function that the module exports: a const cs_pdf_module *. */
CELSPAN_API const void *celspan_pdf_module(void);
