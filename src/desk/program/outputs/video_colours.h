/* What the tags of a video say of its colours, where a space or a view of an OpenColorIO
 * configuration is written.
 *
 * INVARIANT: a video whose tags could not say what its numbers are is refused with a sentence.
 */
#pragma once

#include "program/options/request.h"
#include "video/video.h"

/* Sets the tags of the options, which have the coding of the request. */
cs_exit cs_video_colours_set(const cs_request *request, cs_video_options *options);
