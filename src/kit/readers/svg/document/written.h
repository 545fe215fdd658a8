/* A text as written: the characters of an element and of the elements inside it, with the positions
 * that the file gives them.
 *
 *   <text x="10 20">A <tspan dy="3"> b</tspan></text>
 *
 *   characters   A     ' '   b           spaces collapsed
 *   x            10    20    .           .: not said
 *   dy           .     .     3
 *   text nodes   |---------| |---|       each with the style of its element
 */
#pragma once

#include "readers/svg/document/reading.h"
#include "readers/svg/words/ways.h"

/* Lines that texts run along: textPath.
 *
 *          ,-B-.         x of a letter is counted along the line, y across it; the middle of the
 *        A       C       letter lies on the line, and the letter is turned as the line goes there.
 *       /         \      Letters whose middle is beyond an end are not drawn.
 *
 * Source: SVG 2, 11.8.3.
 */
typedef struct cs_svg_text_path {
  size_t begin, end; /* characters of the text */
  cs_svg_way way;    /* in the text's user units */
  double start;      /* the distance at which the first letter begins */
} cs_svg_text_path;

/* The line that a textPath element at `place` refers to. *is_there: false if there is no line, or
 * its length is 0. *out must be finished, also after a failure. Errors: NO_MEMORY, LIMIT; INPUT for
 * unfit numbers. */
CELSPAN_CHECKED celspan_status cs_svg_text_path_make(cs_svg_reading *reading,
                                                     const cs_svg_node *node,
                                                     const cs_svg_place *place,
                                                     cs_svg_text_path *out, bool *is_there);
/* The line of a path or a basic shape. For NULL or another element its length is 0.
 * is_placed: with its own transform. *out must be finished, also after a failure. Errors: as
 * above. */
CELSPAN_CHECKED celspan_status cs_svg_text_path_of(cs_svg_reading *reading, const cs_svg_node *path,
                                                   const cs_svg_measure *measure, bool is_placed,
                                                   cs_svg_text_path *out);
void cs_svg_text_path_finish(cs_svg_text_path *path, cs_memory *memory);

#define CS_SVG_TEXT_LENGTHS 64 /* the most lengths of one text */
#define CS_SVG_TEXT_PATHS 64   /* the most paths of one text */

typedef struct cs_svg_character {
  uint32_t byte; /* the byte where the character begins */
  /* NAN if the file does not give the value. User units; degrees. */
  double x, y, dx, dy, rotate;
} cs_svg_character;

typedef struct cs_svg_text_node {
  const cs_svg_node *node; /* the node of kind CHARACTERS */
  cs_svg_place place;
  size_t begin, end; /* characters */
} cs_svg_text_node;

/* The length that characters must have together: textLength. */
typedef struct cs_svg_text_length {
  size_t begin, end;
  double length;
  bool stretches_glyphs;
} cs_svg_text_length;

typedef struct cs_svg_written {
  cs_svg_reading *reading;
  CS_ARRAY(char, bytes); /* UTF-8 */
  CS_ARRAY(cs_svg_character, characters);
  CS_ARRAY(cs_svg_text_node, nodes); /* none is empty */
  size_t size, count, node_count;
  cs_svg_text_length lengths[CS_SVG_TEXT_LENGTHS]; /* lengths of inner elements come first */
  size_t length_count;
  cs_svg_text_path paths[CS_SVG_TEXT_PATHS]; /* ascending, without overlap; none is empty */
  size_t path_count;
  bool ends_in_space; /* a space at the end is joined with one that follows */
  bool is_too_long;
} cs_svg_written;

/* place: of the element, after it was entered. *out must be finished, also after a failure. Errors:
 * NO_MEMORY; INPUT for unfit numbers. */
CELSPAN_CHECKED celspan_status cs_svg_written_read(cs_svg_reading *reading, const cs_svg_node *node,
                                                   const cs_svg_place *place, cs_svg_written *out);
void cs_svg_written_finish(cs_svg_written *written);
