/* The stops of a gradient: read from the file, refined, repeated. */
#ifndef CS_SVG_STOPS_H
#define CS_SVG_STOPS_H

#include "svg/reading.h"

typedef struct cs_svg_stop {
  double at; /* 0..1, ascending */
  cs_svg_colour colour;
} cs_svg_stop;

/* All zero is an empty list. */
typedef struct cs_svg_stops {
  celspan_stop *items;
  size_t count, capacity;
} cs_svg_stops;

typedef enum cs_svg_spread {
  CS_SVG_SPREAD_PAD,
  CS_SVG_SPREAD_REFLECT,
  CS_SVG_SPREAD_REPEAT
} cs_svg_spread;

/* Appends the stops of a gradient's element, refined. opacity multiplies alpha. */
CELSPAN_CHECKED celspan_status cs_svg_stops_read(cs_svg_reading *reading, const cs_svg_node *owner,
                                                 double opacity, cs_svg_stops *out);
/* Stops for the periods [first, last), last > first, in place of those of one period; places then
 * go from 0 at the begin of the first to 1 at the end of the last. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_stops_spread(cs_svg_reading *reading, cs_svg_spread spread,
                                                   int first, int last, cs_svg_stops *stops);
void cs_svg_stops_finish(cs_svg_stops *stops, cs_memory *memory);

#endif
