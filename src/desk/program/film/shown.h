/* How a file is shown by the verbs for pictures: a picture, a span file or a plane directly; a
 * drawing or a layered painting as the frame of its film, in the same way as `celspan render`. For
 * a Photoshop document, the merged picture is used, and a note says so. */
#pragma once

#include "program/options/request.h"
#include "writers/still/still.h"

/* Whether a file is shown as the frame of its film: a drawing, or a painting that does not contain
 * a merged picture. */
bool cs_shown_is_film(const char *path);
/* has_frames: --frame means a frame of this file. OK, and *out is new; or reported. */
cs_exit cs_shown_open(celspan_context *context, const cs_request *request, const char *path,
                      bool has_frames, cs_still *out);
/* The same as cs_view_frame for a shown file, with its exposures. */
cs_exit cs_shown_frame(const cs_request *request, const cs_still *still, celspan_frame_desc *out);
