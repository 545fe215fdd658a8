/* The sound file of a film. */
#pragma once

#include "base/context.h"

/* Checks that the file can be opened. tried: other paths that do not exist either, or NULL. Errors:
 * INPUT. */
CELSPAN_CHECKED celspan_status cs_sound_find(celspan_context *context, const char *path,
                                             const char *tried);
/* Checks that ffmpeg can read the beginning of the sound; OK if ffmpeg is missing. Errors: INPUT,
 * with the message of ffmpeg; CANCELLED. */
CELSPAN_CHECKED celspan_status cs_sound_listen(celspan_context *context, const char *path);
