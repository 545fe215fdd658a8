/* The sound of a film: the file that goes with its frames. */
#ifndef CS_CLI_VIDEO_SOUND_H
#define CS_CLI_VIDEO_SOUND_H

#include "cli/script.h"

/* Where the film's sound is; NULL where it has none. *path is left on the Lua stack, where it lives
 * as long as the script. Errors: INPUT, where there is no file that can be read. */
CELSPAN_CHECKED celspan_status cs_sound_find(cs_script *script, const char **path);
/* Has ffmpeg read the beginning of the sound. OK as well where there is no ffmpeg. Errors: INPUT,
 * with what ffmpeg said; CANCELLED. */
CELSPAN_CHECKED celspan_status cs_sound_listen(celspan_context *context, const char *path);

#endif
