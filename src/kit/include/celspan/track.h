/* Following what moves in a film.
 * The conventions of celspan/celspan.h hold. */
#ifndef CELSPAN_TRACK_H
#define CELSPAN_TRACK_H

#include "celspan/celspan.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A tracker follows a region of a first frame through other frames: it finds the place of the
 * region from the motion of its corners. A tracker belongs to one thread, and keeps the data of the
 * first frame that it needs; it is not a scene value. */
typedef struct celspan_tracker celspan_tracker;

typedef enum celspan_motion {
  CELSPAN_MOTION_TRANSLATION = 0,
  CELSPAN_MOTION_SIMILARITY, /* also rotated and scaled */
  CELSPAN_MOTION_PERSPECTIVE /* as a plane moves in perspective */
} celspan_motion;

/* A grey picture: width x height values (at most 65,536 a side), rows from top to bottom without
 * gaps, of about 0..1. Coded values such as sRGB's serve better than linear light, because noise is
 * as large in the dark as in the light then. */
typedef struct celspan_luma {
  int32_t width, height;
  const float *values;
} celspan_luma;

typedef struct celspan_tracker_desc {
  size_t struct_size;
  celspan_motion model;
  celspan_box region;  /* pixels of the first frame; 18 x 18 or larger; cut to the frame */
  const uint8_t *mask; /* NULL, or a byte a pixel of the frame: 0 is not followed; borrowed */
} celspan_tracker_desc;

CELSPAN_DESCRIPTION(celspan_tracker_desc)
#define CELSPAN_TRACKER_DESC (celspan_tracker_desc_initial())

typedef struct celspan_sighting {
  size_t struct_size;
  bool is_found; /* false: lost, and the matrix has no meaning */
  /* maps places of the first frame to places of this one; the centre of the first pixel is (0,
   * 0) */
  celspan_matrix matrix;
  uint32_t corner_count; /* how many corners are followed, at most 240 */
  uint32_t agreeing_count;
  double error; /* pixels: the root mean square over the corners that agree */
} celspan_sighting;

CELSPAN_RESULT(celspan_sighting)
#define CELSPAN_SIGHTING (celspan_sighting_initial())

/* first, desc: borrowed      out: new
 * Errors: BAD_ARGUMENT for a region that is too small or has too little texture, and for values
 * that are not finite; NO_MEMORY. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_tracker_create(celspan_context *context,
                                                                  const celspan_luma *first,
                                                                  const celspan_tracker_desc *desc,
                                                                  celspan_tracker **out);
/* Finds the region in the next frame, which has the size of the first one. If the region was lost,
 * it is searched for at its last place. Errors: BAD_ARGUMENT, NO_MEMORY; a lost region is not an
 * error. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_tracker_follow(celspan_tracker *tracker,
                                                                  const celspan_luma *frame,
                                                                  celspan_sighting *out);
/* Begins again at the first frame, to follow the region in the other direction. */
CELSPAN_API void celspan_tracker_rewind(celspan_tracker *tracker);
CELSPAN_API void celspan_tracker_destroy(celspan_tracker *tracker); /* NULL is ignored */

#ifdef __cplusplus
}
#endif
#endif
