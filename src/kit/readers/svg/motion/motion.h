/* Drawings that move: their animations at a time.
 *
 *   times      when animations run: intervals      values    values that can be mixed
 *   clocks     begin, end, dur, ...                easing    timing functions
 *   lists      keyTimes, keySplines, ...           matrices  transforms of different kinds
 *        \         |                                /
 *   smil: animate, set, path: animateMotion        keyframes: @keyframes
 *        \         |                                /
 *         targets: elements with the values of that time, as attributes, cs_svg_node.moved and
 *         .motion. After this, the document is drawn like any other.
 *
 * Events of users, and scripts, are not run: there is a note for each.
 */
#pragma once

#include "readers/svg/document/reading.h"
#include "readers/svg/motion/motion_times.h"

/* Sets the document to its time, reading->seconds; below 0: it remains as it is written. *seconds:
 * how long it moves; 0: it does not. Called before anything else is made from the document. Errors:
 * NO_MEMORY, LIMIT, INPUT for unfit numbers. */
CELSPAN_CHECKED celspan_status cs_svg_move(cs_svg_reading *reading, double *seconds);

/* Runs all animation elements of a document, or the animations of its styles (@keyframes, and the
 * properties that begin with `animation`), and adds them to *extent. Errors: as cs_svg_move.
 * Sources: CSS Animations Level 1, Web Animations Level 1. */
CELSPAN_CHECKED celspan_status cs_svg_smil_run(cs_svg_reading *reading, cs_svg_extent *extent);
CELSPAN_CHECKED celspan_status cs_svg_keyframes_run(cs_svg_reading *reading, cs_svg_extent *extent);
