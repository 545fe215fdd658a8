/* From a film's size and the request to the description of what is rendered: size, crop,
 * antialiasing, workers. One rule for every verb that makes rows.
 */
#pragma once

#include "frames/still/still.h"
#include "program/request.h"

/* Fills everything of *out except the exposures; the film's size is in film units. OK, or reported
 * and CS_EXIT_USAGE or CS_EXIT_LIMIT. */
cs_exit cs_view_frame(const cs_request *request, double film_width, double film_height,
                      celspan_frame_desc *out);
/* Opens the picture of a verb that reads a FILE. OK, and *out new; or reported. */
cs_exit cs_view_open_still(celspan_context *context, const cs_request *request, const char *path,
                           cs_still *out);
/* The same as cs_view_frame for a picture, with its exposures. */
cs_exit cs_view_still(const cs_request *request, const cs_still *still, celspan_frame_desc *out);
