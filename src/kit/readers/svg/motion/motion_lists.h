/* Lists between semicolons in animation elements: values, keyTimes, keySplines, keyPoints. */
#pragma once

#include "readers/svg/document/document.h"

/* The number of parts between semicolons, and part i, copied; NULL: there is no memory. */
size_t cs_svg_list_count(const char *text);
const char *cs_svg_list_part(const cs_css_place *place, const char *text, size_t i);

/* The place in a list of `count` values at a share 0..1 of the time, by keyTimes and keySplines of
 * the element: between value *first and the next one, at *share. mode: the value of calcMode.
 * distances: between the values, for paced; NULL: not paced. False: the lists are invalid. */
bool cs_svg_list_place(const cs_svg_node *node, const char *mode, double at, size_t count,
                       const double *distances, size_t *first, double *share);
