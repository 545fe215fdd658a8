/* Following what moves in a film.
 * The conventions are those of celspan/celspan.h. */
#ifndef CELSPAN_TRACK_H
#define CELSPAN_TRACK_H

#include "celspan/celspan.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A tracker follows a region of a first frame through others: from the motion of its corners it
 * says where the region lies. A tracker belongs to one thread and keeps what it needs of the first
 * frame; it is no scene value. */
typedef struct celspan_tracker celspan_tracker;

typedef enum celspan_motion {
  CELSPAN_MOTION_TRANSLATION = 0,
  CELSPAN_MOTION_SIMILARITY, /* turned and scaled as well */
  CELSPAN_MOTION_PERSPECTIVE /* of a plane that is seen from elsewhere */
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
  bool is_found;         /* false: lost, and the matrix means nothing */
  celspan_matrix matrix; /* takes places of the first frame to places of this one; the centre of the
                            first pixel is (0, 0) */
  uint32_t corner_count; /* that are followed, at most 240 */
  uint32_t agreeing_count;
  double error; /* pixels, the root of the mean square over those that agree */
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
/* Finds the region in the next frame, of the size of the first one. Where it was lost it is sought
 * where it was last. Errors: BAD_ARGUMENT, NO_MEMORY; a region that is lost is no error. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_tracker_follow(celspan_tracker *tracker,
                                                                  const celspan_luma *frame,
                                                                  celspan_sighting *out);
/* Begins again at the first frame, to follow the region the other way. */
CELSPAN_API void celspan_tracker_rewind(celspan_tracker *tracker);
CELSPAN_API void celspan_tracker_destroy(celspan_tracker *tracker); /* NULL is ignored */

#ifdef __cplusplus
}
#endif
#endif
