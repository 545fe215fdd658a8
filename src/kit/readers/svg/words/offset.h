/* Elements on a path of their style: offset-path, and how far along it they are.
 *
 *           ,-*-.       The anchor, by default the origin of the element's transforms, lies on the
 *         /       \     path at the offset-distance; the element is turned about it as the path
 *                       goes there, or as offset-rotate says.
 *
 * Source: Motion Path Module Level 1. Of the forms of a path, path("...") is read.
 */
#pragma once

#include "inside/cache.h"
#include "inside/context.h"
#include "readers/svg/words/names.h"
#include "readers/svg/words/values.h"

/* All zero: there is no path. */
typedef struct cs_svg_offset {
  bool is_there;
  celspan_point at; /* where the path begins */
  double degrees;
  const char *anchor; /* as written; NULL: the origin of the transforms */
} cs_svg_offset;

/* none: *size is 0. Otherwise *data, of *size bytes, is what path("...") contains. */
bool cs_svg_parse_way(const char *text, const char **data, size_t *size);
/* auto, reverse, and an angle, one of the words or both. follows: the path's direction counts. */
bool cs_svg_parse_heading(const char *text, bool *follows, double *degrees);

/* Reads the properties of an element, the winning values by name. line: of the element. measure:
 * for lengths. tests: the bytes of the path count against them. Errors: NO_MEMORY; LIMIT when the
 * tests are used up. */
CELSPAN_CHECKED celspan_status cs_svg_offset_read(celspan_context *context, cs_arena *arena,
                                                  uint32_t line, const char *const *values,
                                                  const cs_svg_measure *measure, uint64_t *tests,
                                                  cs_svg_offset *out);
