/* The rows of a frame of drawings, made by one thread. */
#pragma once

#include "engine/map/folding.h"

/* Errors: NO_MEMORY; cs_map_maker_finish must be called then, too. */
CELSPAN_CHECKED celspan_status cs_map_maker_init(cs_map_maker *maker, celspan_context *context,
                                                 const cs_map_frame *frame);
void cs_map_maker_finish(cs_map_maker *maker);
/* The number of pixels whose colour was computed because they vary. */
uint64_t cs_map_maker_evaluations(const cs_map_maker *maker);
/* Whether row y can be made: no map lacks a zone that shows in its swath. */
bool cs_map_frame_has(const cs_map_frame *frame, int32_t y);
/* The spans of row y, 0 <= y < height, which can be made. The contents of `out` are replaced.
 * Errors: NO_MEMORY, and those of reading pictures. */
CELSPAN_CHECKED celspan_status cs_map_maker_row(cs_map_maker *maker, int32_t y, cs_row *out);
