/* Drawings that move. When animations run, and between which values they are at a time, is known to
 * a clock, which is Lua (lua/celspan/read/svg_smil.lua, svg_styles.lua):
 *
 *   the document --> mover --- texts of begin, dur, values, animation, ... ---> clock
 *                      ^                                                          |
 *                      '------- two values, the share between them, ... <---------'
 *
 *   values: values that can be mixed         matrices: transforms of different kinds
 *   compose: values that are added           mix: attributes and properties of elements
 *   path: animateMotion
 *   targets: elements with the values of that time, as attributes, cs_svg_node.moved and .motion.
 *   After this, the document is drawn like any other.
 *
 * Events of users, and scripts, are not run: there is a note for each.
 */
#pragma once

#include "readers/svg/document/cascade.h"
#include "readers/svg/document/reading.h"
#include "readers/svg/motion/motion_targets.h"
#include "readers/svg/motion/motion_values.h"

/* The document of one reading while its clock runs. */
typedef struct cs_svg_mover {
  cs_svg_reading *reading;
  const cs_svg_animation *animations; /* in the order of the document */
  size_t count;
  cs_svg_node *node;            /* the element that is visited, */
  const cs_svg_cascade *styles; /* and its styles; NULL: none is visited */
} cs_svg_mover;

/* Moves a document to reading->seconds; below 0: it stays, and *seconds is how long it would move;
 * 0: it does not. Errors: those of the mover's functions; CALLBACK of its own. */
typedef struct cs_svg_clock {
  celspan_status (*run)(void *user, cs_svg_mover *mover, double *seconds);
  void *user;
} cs_svg_clock;

/* Has the clock of the reading move the document, if it has animations. Called before anything else
 * is made from the document. Errors: as the clock's, NO_MEMORY, LIMIT, INPUT for unfit numbers. All
 * functions of a mover have the last three. */
CELSPAN_CHECKED celspan_status cs_svg_move(cs_svg_reading *reading, double *seconds);

/* ---------------------------------------------------------------- elements that animate */

/* An end of the way between two values. */
typedef struct cs_svg_end {
  const char *text; /* NULL: the value without this animation */
  cs_svg_composition composition;
} cs_svg_end;

typedef struct cs_svg_mixture {
  cs_svg_end from, to;
  bool is_by; /* `to` says what is added to `from` */
  double share;
  const char *last; /* what is added to both ends, `round` times; NULL: what `to` is */
  double round;
} cs_svg_mixture;

/* Gives the attribute of the target a value between two others; those that do not mix change in the
 * middle. Beyond 1e12 it has no effect. */
CELSPAN_CHECKED celspan_status cs_svg_mover_mix(cs_svg_mover *mover,
                                                const cs_svg_animation *animation,
                                                const cs_svg_mixture *mixture);
/* The distance of two values; 0: of those that do not fit each other. *mixes: whether `b` is a
 * value that can be mixed. */
CELSPAN_CHECKED celspan_status cs_svg_mover_distance(cs_svg_mover *mover,
                                                     const cs_svg_animation *animation,
                                                     const char *a, const char *b, double *out,
                                                     bool *mixes);

/* A place on the line of an animateMotion, and the direction there. */
typedef struct cs_svg_spot {
  bool has_line, is_there; /* is_there: the line has a length */
  celspan_point point, end;
  double degrees;
} cs_svg_spot;

CELSPAN_CHECKED celspan_status cs_svg_mover_spot(cs_svg_mover *mover,
                                                 const cs_svg_animation *animation, double share,
                                                 cs_svg_spot *out);
/* Gives the target a turn and then a shift, after the motion that it has so far if `adds`. Beyond
 * 1e12 it has no effect. */
CELSPAN_CHECKED celspan_status cs_svg_mover_place(cs_svg_mover *mover,
                                                  const cs_svg_animation *animation,
                                                  celspan_point point, double degrees, bool adds);

/* ---------------------------------------------------------------- styles */

/* Visits the elements whose styles name animations, parents first. While one is visited, values are
 * those of its styles, with variables, and colours are mixed by their alpha. */
typedef celspan_status (*cs_svg_mover_visited)(void *user);
CELSPAN_CHECKED celspan_status cs_svg_mover_visit(cs_svg_mover *mover, cs_svg_mover_visited visited,
                                                  void *user);
