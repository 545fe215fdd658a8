/* One point of a film of linear light, in the form for tests. */
#pragma once

#include "celspan/celspan.h"

static inline CELSPAN_CHECKED celspan_status probe_film(celspan_context *context,
                                                        const celspan_exposure *exposures,
                                                        size_t count, double width, double height,
                                                        celspan_point point, double rgba[4]) {
  celspan_frame_desc desc = CELSPAN_FRAME_DESC;
  desc.exposures = exposures;
  desc.exposure_count = count;
  desc.film_width = width;
  desc.film_height = height;
  return celspan_probe(context, &desc, point, rgba);
}
