/* Reading drawings from files. */
#pragma once

#include "celspan/svg.h"
#include "readers/svg/document/reading.h"

/* How a drawing is read. */
typedef struct cs_svg_options {
  const celspan_svg_font *fonts;
  size_t font_count;
  celspan_space space;
  /* Runs the animations (motion.h), and a drawing that may move keeps its file for cs_svg_at; NULL:
   * none is run. */
  const struct cs_svg_clock *clock;
} cs_svg_options;

/* See celspan_svg_read. */
CELSPAN_CHECKED celspan_status cs_svg_read_file(celspan_context *context, const char *file,
                                                const cs_svg_options *options, celspan_svg **out);

/* The drawing of a file at a time, seconds from 0 on, without opening its file again; itself if it
 * does not move, or if its file was not kept. art: not a changed copy. *out: a new reference.
 * Errors: as for reading. */
CELSPAN_CHECKED celspan_status cs_svg_at(celspan_context *context, celspan_svg *art,
                                         const struct cs_svg_clock *clock, double seconds,
                                         celspan_svg **out);

/* ---- build.c */

/* Fills in the size and the items of *art. Errors: INPUT and LIMIT with the line, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_build(cs_svg_reading *reading, celspan_svg *art);
