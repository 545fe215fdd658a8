/* A map of the plane, given by a host. Every point that the host returns is checked here.
 *
 * INVARIANT: the map is asked only for points of the object that is bent, in the units around the
 * object.
 */
#pragma once

#include "base/context.h"
#include "base/number.h"

typedef struct cs_warp_map {
  celspan_context *context;
  celspan_warp_map call;
  void *user;
  double within; /* units: how far outlines may lie from their place */
  double extent; /* the longer side of the whole object; above 0 */
  size_t pieces; /* the most triangles of a mesh */
} cs_warp_map;

/* The place to which the map moves a point. Errors: those of the host; BAD_ARGUMENT if the result
 * is not finite. */
static inline CELSPAN_CHECKED celspan_status cs_warp_at(const cs_warp_map *map, celspan_point from,
                                                        celspan_point *to) {
  CS_TRY(map->call(map->user, map->context, from, to));
  if (cs_number_is_sane(to->x) && cs_number_is_sane(to->y))
    return CELSPAN_OK;
  return cs_fail(map->context, CELSPAN_BAD_ARGUMENT,
                 "warp: the map must give finite numbers, got %g, %g for the point %g, %g", to->x,
                 to->y, from.x, from.y);
}

/* An object near the horizon of its perspective has points that no map can give finite places. */
static inline celspan_status cs_warp_fail_at_horizon(const cs_warp_map *map) {
  return cs_fail(map->context, CELSPAN_BAD_ARGUMENT,
                 "warp: the object reaches the horizon of its perspective; bend it before it is "
                 "put in perspective");
}
