#include "frames/video/sound.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "frames/process/child.h"
#include "frames/video/format.h"

celspan_status cs_sound_find(celspan_context *context, const char *path, const char *tried) {
  struct stat there;
  int error = access(path, R_OK) != 0 || stat(path, &there) != 0 ? errno
              : S_ISDIR(there.st_mode)                           ? EISDIR
                                                                 : 0;
  if (error == 0)
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_INPUT, "the sound %s cannot be opened: %s%s%s", path,
                 strerror(error), tried ? "; also looked for at " : "", tried ? tried : "");
}

celspan_status cs_sound_listen(celspan_context *context, const char *path) {
  cs_video_command command;
  cs_child process;
  char how[CS_CHILD_ERROR + 64];
  cs_video_command_listen(&command, path);
  if (cs_child_start(&process, command.arguments) != 0)
    return CELSPAN_OK;
  close(process.input);
  bool is_over = cs_child_end(&process, INFINITY);
  if (!is_over)
    return cs_fail(context, CELSPAN_CANCELLED, "%s: stopped", path);
  if (process.exit_code == 0)
    return CELSPAN_OK;
  cs_child_describe(&process, how, sizeof how);
  return cs_fail(context, CELSPAN_INPUT, "the sound %s cannot be read: ffmpeg %s", path, how);
}
