/* A picture as a scene of its own: one image rectangle at the picture's size, lit white, sampled
 * at pixel centres, so that every pixel comes out as it went in.
 */
#ifndef CS_CLI_STILL_H
#define CS_CLI_STILL_H

#include "cli/request.h"

typedef struct cs_still {
  celspan_picture_info info;
  celspan_exposure exposure; /* its rostrum is owned */
} cs_still;

/* OK, and *out new; or reported. */
cs_exit cs_still_open(celspan_context *context, const char *path, cs_still *out);
/* One that was never opened, but zeroed, may be closed too. */
void cs_still_close(cs_still *still);
/* The description of its frame under the options. OK, or reported. */
cs_exit cs_still_frame(const cs_still *still, const cs_request *request, celspan_frame_desc *out);

#endif
