/* Pixels of one label that hang together: regions, kept as runs of rows. Of a traced picture, of a
 * scan's ink and dust, of what lies between walls.
 *
 *      row 0   |0 0 0|1 1 1 1|0 0|        runs: x0 and the region, to the x0 of the next
 *      row 1   |0 0|1 1 1 1 1 1|0|
 *
 * INVARIANT: regions are numbered in the order of their first pixels, from the top left. Pixels
 * hang together by their sides, and by their corners as the caller says.
 */
#pragma once

#include "tools/trace/labels.h"

#define CS_REGION_OUTSIDE UINT32_MAX

typedef enum cs_corners {
  CS_CORNERS_JOIN,      /* all */
  CS_CORNERS_PART,      /* none */
  CS_CORNERS_AS_BORDERS /* in the way that cs_material_join says */
} cs_corners;

typedef struct cs_region_source {
  const unsigned char *first; /* the label of the first pixel */
  size_t stride;
  int32_t width, height;
  bool is_mask; /* all bytes but 0 are label 1 */
  cs_corners corners;
  const cs_material *material; /* of CS_CORNERS_AS_BORDERS */
} cs_region_source;

static inline cs_region_source cs_region_source_mask(const unsigned char *plane, int32_t width,
                                                     int32_t height, cs_corners corners) {
  return (cs_region_source){plane, (size_t)width, width, height, true, corners, NULL};
}
cs_region_source cs_region_source_of(const cs_material *material, cs_corners corners);

typedef struct cs_region_run {
  int32_t x0;
  uint32_t region;
} cs_region_run;

typedef struct cs_region {
  int32_t x;              /* of its first pixel, in row y0 */
  int32_t x0, y0, x1, y1; /* x1, y1: not counted */
  uint32_t area;
  unsigned char label;
} cs_region;

typedef struct cs_regions {
  int32_t width, height;
  size_t *rows; /* height + 1: where the runs of each row begin */
  cs_region_run *runs;
  cs_region *list;
  size_t count;
} cs_regions;

/* Errors: NO_MEMORY. After a failure nothing must be finished. */
CELSPAN_CHECKED celspan_status cs_regions_make(celspan_context *context,
                                               const cs_region_source *source, cs_regions *out);
void cs_regions_finish(cs_regions *regions, celspan_context *context);
/* The region of a pixel; CS_REGION_OUTSIDE beyond the picture. */
uint32_t cs_regions_at(const cs_regions *regions, int32_t x, int32_t y);
/* Where a run of row y ends. */
static inline int32_t cs_regions_end(const cs_regions *regions, int32_t y, size_t run) {
  return run + 1 < regions->rows[y + 1] ? regions->runs[run + 1].x0 : regions->width;
}

/* Speckles: regions of few pixels, which get the label that is most frequent along their border.
 *
 * INVARIANT: only labels of speckles change. A speckle whose neighbours are all speckles does not
 * change until one of them is no longer a speckle. If there are only speckles, nothing changes.
 */

/* Removes regions of at most `most` pixels, which are connected by sides or corners. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_speckles_drop(celspan_context *context,
                                                const cs_material *material, uint32_t most);
