/* The state of one thread that makes the rows of a frame of drawings. */
#pragma once

#include "engine/map/exact.h"
#include "engine/map/swept.h"

typedef struct cs_map_maker {
  celspan_context *context;  /* borrowed: the worker's branch */
  const cs_map_frame *frame; /* borrowed */
  cs_map_sums sums;
  cs_map_rows *rows;     /* one for each sheet */
  cs_map_brush *brushes; /* one for each sheet */
  cs_map_swept *swept;   /* one for each sheet, used by the swept sheets */
  int32_t row;           /* the first row of the swath that is in `rows`; -1: none is */
  cs_map_exact exact;
  cs_row painted; /* a run of the only sheet that varies */
  bool varies;    /* a cell of a sheet varies, or a sheet is coloured */
} cs_map_maker;

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
