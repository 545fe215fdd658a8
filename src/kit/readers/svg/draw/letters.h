/* The places of the letters of a text: its characters are shaped, and placed as the file says.
 *
 *   runs of characters with the same fonts, shaped one by one (readers/text/layout.h)
 *   |  side by side on one line
 *   v
 *   letters at (advance, 0) --textLength--> --x, y, dx, dy--> --text-anchor--> --textPath--> in
 *                                                                                       user units
 *
 * A chunk reaches from one absolute position to the next; it is anchored as a whole.
 *
 *        x=10             x=60, text-anchor="middle"
 *        v                   v
 *        |F i r s t|      |S e c|
 *
 * Source: SVG 2, 11.5, except that dx and dy are added to x and y, as in browsers.
 */
#pragma once

#include "inside/geometry.h"
#include "readers/svg/document/written.h"
#include "readers/text/layout.h"

typedef struct cs_svg_letter {
  size_t run;
  size_t first, count;       /* glyphs of the run's layout */
  size_t character;          /* the first character of the text that the letter shows */
  double origin_x, origin_y; /* where the letter is in the layout */
  double x, y, advance;      /* the letter's left end on the baseline, in user units */
  double scale;              /* the factor of its width */
  double turn;               /* the direction of the line that it follows, in degrees */
} cs_svg_letter;

typedef struct cs_svg_run {
  size_t begin, end; /* characters */
  double size;       /* the em */
  double width;
  cs_layout layout;
} cs_svg_run;

typedef struct cs_svg_letters {
  celspan_context *context;
  CS_ARRAY(cs_svg_run, runs);
  CS_ARRAY(cs_svg_letter, letters); /* in the order on the page, from left to right */
  CS_ARRAY(uint32_t, order); /* by character: the letter that begins with it, from 1; 0: none */
  size_t run_count, count, order_count;
} cs_svg_letters;

/* Notes parts that cannot be drawn. node: the text element. *out must be finished, also after a
 * failure. Errors: NO_MEMORY; INPUT for a font that is missing, cut off or not a font. */
CELSPAN_CHECKED celspan_status cs_svg_letters_make(cs_svg_reading *reading, const cs_svg_node *node,
                                                   const cs_svg_written *written,
                                                   cs_svg_letters *out);
void cs_svg_letters_finish(cs_svg_letters *letters);

/* Appends the outlines of the letters that begin with characters begin .. end - 1. Errors:
 * NO_MEMORY, LIMIT; INPUT for outlines that make no sense. */
CELSPAN_CHECKED celspan_status cs_svg_letters_outline(const cs_svg_letters *letters,
                                                      const cs_svg_written *written, size_t begin,
                                                      size_t end, cs_outline *outline);
/* The box around all letters, each as wide as its advance and as high as its font's lines, in user
 * units; false: there is none. */
bool cs_svg_letters_box(const cs_svg_letters *letters, const cs_svg_written *written,
                        celspan_box *out);

/* ---------------------------------------------------------------- fonts */

/* The fonts of a text: from the caller's fonts, first the fonts that font-family names, then the
 * font for all families.
 *
 *   font-family: Arial, "Gill Sans"; font-weight: bold
 *   tried: "Arial Bold", "Arial", "Gill Sans Bold", "Gill Sans", "default"
 */
typedef struct cs_svg_faces {
  /* borrowed from the source; each font is used for letters that all fonts before it lack */
  const char *fonts[CS_TEXT_FONTS];
  size_t count;  /* 0: no font was given */
  bool is_plain; /* the first font lacks the bold or italic that is asked for */
} cs_svg_faces;

void cs_svg_faces_find(const cs_svg_source *source, const cs_svg_style *style, cs_svg_faces *out);
/* Whether two styles have the same fonts, of one size and spacing. */
bool cs_svg_faces_are_same(const cs_svg_style *a, const cs_svg_style *b);
