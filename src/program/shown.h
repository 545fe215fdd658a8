/* What a file shows to the verbs of pictures: a picture, a span file or a plane as it is, and a
 * drawing or a layered painting as the frame of its film, the same that `celspan render` makes. Of
 * a Photoshop document it is the merged picture, which a note says.
 */
#pragma once

#include "frames/still/still.h"
#include "program/request.h"

/* Whether a file is shown as the frame of its film: a drawing, or a painting that holds no picture
 * of the whole. */
bool cs_shown_is_film(const char *path);
/* has_frames: --frame is a frame of this file. OK, and *out new; or reported. */
cs_exit cs_shown_open(celspan_context *context, const cs_request *request, const char *path,
                      bool has_frames, cs_still *out);
/* The same as cs_view_frame for a shown file, with its exposures. */
cs_exit cs_shown_frame(const cs_request *request, const cs_still *still, celspan_frame_desc *out);
