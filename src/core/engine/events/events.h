/* The sweep of a drawing by events: from its highest point to its lowest one, with work only where
 * a boundary begins or ends or two change places.
 *
 *          .                 begins: two courses at one height
 *         / \      |
 *        /   \     |         belts of rows: neighbours are compared ahead, and where two must
 *       /     \    |         change places, that is an event
 *      /       \   |
 *     /         \  |
 *    /           \ |
 *    |            x          intersection: the place between the two has other windings
 *    |           / \
 *    '----------'   '        ends
 *
 * The result is a list of parts: pieces of courses between two heights, with the windings on both
 * sides. Colours are not known here: visible colours are found afterwards, once for each of the
 * windings.
 *
 * Heights are whole units. Neighbours that meet between two heights change places at the lower one,
 * so a part may be wrong by a strip of one unit, which is 2^-16 of a pixel, and at no height is
 * there anything but a list of courses with the windings between them.
 *
 * Invariants
 *   - at any height, the parts that cross it lead from windings 0 to windings 0, each beginning
 *     with those with which the one before it has ended;
 *   - belts of rows depend on the drawing alone (order.h): a sweep of some rows finds what a sweep
 *     of all finds there.
 */
#pragma once

#include "engine/events/bundle.h"

typedef struct cs_events_part {
  uint32_t course;
  int32_t top, foot;    /* top < foot */
  uint32_t left, right; /* windings */
} cs_events_part;

typedef struct cs_events {
  cs_courses courses;
  cs_bundles bundles; /* their courses follow the courses of chains */
  cs_windings windings;
  CS_ARRAY(cs_events_part, parts); /* the parts of a course from the top down */
  size_t part_count;
  size_t intersections; /* how often two courses have changed places */
  uint64_t missing;     /* bit k: zone k has too many windings, and no parts */
} cs_events;

/* The swept rows of a drawing, in pixels from 0. height: at most 16384 and 64 zones. */
typedef struct cs_events_rows {
  int32_t first, end, height; /* first <= end <= height */
  int32_t zone; /* rows of a zone, which consists of whole belts; each zone is judged by itself */
} cs_events_rows;

/* A zone has too many windings if they are more than `most`, or more than `few` and than `each`
 * times its courses: so windings that multiply are found long before their number is `most`. */
typedef struct cs_events_limits {
  size_t most, few, each;
} cs_events_limits;

/* Sweeps boundaries that lie within 16384 pixels of the origin sideways, and are culled without a
 * margin, from the top of the belt in which the first row lies. The parts are those of the whole
 * drawing between there and the end; only their windings have other numbers. A zone that has too
 * many is missing, and costs what it takes to find that out. It depends on the zone alone. Errors:
 * NO_MEMORY; cs_events_finish must be called then, too. */
CELSPAN_CHECKED celspan_status cs_events_find(celspan_context *context, const cs_boundary_set *set,
                                              const cs_cull *cull, cs_events_rows rows,
                                              cs_events_limits limits, cs_events *out);
void cs_events_finish(cs_events *events, cs_memory *memory);
