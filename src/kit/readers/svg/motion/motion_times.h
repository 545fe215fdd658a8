/* When the animations of a document run: intervals from their begin and end, which may follow those
 * of other animations.
 *
 *   a: begin="0;c.end" dur="1"     a |--|     |--|        The next interval of each animation is
 *   b: begin="a.end" dur="1"       b    |--|     |--|     known before it begins. Each change of it
 *   c: begin="b.end" dur=".5"      c       |-|      |     moves those that wait for it, also back.
 *
 * Source: SMIL 3.0, 5.4, as far as no event of a user and no script takes part.
 */
#pragma once

#include "celspan/celspan.h"
#include "inside/cache.h"

/* The most beginnings, ends and messages between animations of a drawing up to a time. */
#define CS_SVG_MOTION_STEPS 4000000

/* One of the moments in begin or end: seconds, after the start or after a moment of another. */
typedef struct cs_svg_moment {
  double offset;
  int32_t after;  /* the animation; -1: the start of the document */
  bool after_end; /* after its end, not its beginning */
} cs_svg_moment;

typedef enum cs_svg_restart {
  CS_SVG_RESTART_ALWAYS,
  CS_SVG_RESTART_WHEN_NOT_ACTIVE,
  CS_SVG_RESTART_NEVER
} cs_svg_restart;

typedef struct cs_svg_timing {
  double simple;      /* dur; INFINITY: indefinite */
  double whole;       /* from the beginning, with repeats; INFINITY: for ever */
  double least, most; /* min and max of an interval */
  cs_svg_restart restart;
  cs_svg_moment *begins, *ends; /* those of the document first, sorted */
  size_t begin_count, end_count;
  bool end_is_open; /* an event or nothing at all ends it, if its other ends are over */
} cs_svg_timing;

/* The last interval of an animation that has begun. */
typedef struct cs_svg_interval {
  bool has_begun, is_active;
  double begin, end; /* end: INFINITY: it has none */
} cs_svg_interval;

/* How long a drawing moves. */
typedef struct cs_svg_extent {
  double end;    /* the end of the last interval that ends; 0: none does */
  double period; /* the longest of what repeats for ever; 0: none */
} cs_svg_extent;

/* The intervals at a time. out: as many as animations. Errors: NO_MEMORY; LIMIT for more than
 * CS_SVG_MOTION_STEPS. */
CELSPAN_CHECKED celspan_status cs_svg_times_run(celspan_context *context,
                                                const cs_svg_timing *timings, size_t count,
                                                double seconds, cs_svg_interval *out);
/* Adds all intervals to *out. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_times_measure(celspan_context *context,
                                                    const cs_svg_timing *timings, size_t count,
                                                    cs_svg_extent *out);
