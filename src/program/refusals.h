/* What `render` refuses before the first frame. `farm` asks the same for the commands of a job. */
#pragma once

#include "program/script.h"

/* Refuses wrong requests as far as possible without running the script. */
cs_exit cs_refusals_early(celspan_context *context, const cs_request *request);
/* Refuses output that cannot be written. frame_count: 0 where it is not known yet. */
cs_exit cs_refusals_of_output(celspan_context *context, const cs_request *request,
                              size_t frame_count);
/* Refuses parts of a frame that the film does not have, and sizes and rates of videos. */
cs_exit cs_refusals_of_film(const cs_script *script, const cs_request *request);
