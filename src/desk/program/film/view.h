/* From a film's size and the request to the description of what is rendered: size, crop,
 * antialiasing, workers. One rule for every verb that makes rows.
 */
#pragma once

#include "celspan/celspan.h"
#include "program/options/request.h"

/* Fills everything of *out except the exposures; the film's size is in film units. OK, or reported
 * and CS_EXIT_USAGE or CS_EXIT_LIMIT. */
cs_exit cs_view_frame(const cs_request *request, double film_width, double film_height,
                      celspan_frame_desc *out);
