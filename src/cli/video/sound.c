#include "cli/video/sound.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/context.h"
#include "cli/video/command.h"
#include "cli/video/process.h"

static celspan_status check_file(celspan_context *context, const char *path, const char *tried) {
  struct stat there;
  int error = access(path, R_OK) != 0 || stat(path, &there) != 0 ? errno
              : S_ISDIR(there.st_mode)                           ? EISDIR
                                                                 : 0;
  if (error == 0)
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_INPUT, "the sound %s cannot be opened: %s%s%s", path,
                 strerror(error), tried ? "; nor is it there: " : "", tried ? tried : "");
}

celspan_status cs_sound_listen(celspan_context *context, const char *path) {
  cs_video_command command;
  cs_process process;
  char how[CS_PROCESS_WORDS + 64];
  cs_video_command_listen(&command, path);
  if (cs_process_start(&process, command.arguments) != 0)
    return CELSPAN_OK;
  close(process.input);
  bool is_over = cs_process_end(&process, INFINITY);
  if (!is_over)
    return cs_fail(context, CELSPAN_CANCELLED, "%s: stopped", path);
  if (process.exit_code == 0)
    return CELSPAN_OK;
  cs_process_describe(&process, how, sizeof how);
  return cs_fail(context, CELSPAN_INPUT, "the sound %s cannot be read: ffmpeg %s", path, how);
}

celspan_status cs_sound_find(cs_script *script, const char **path) {
  CS_TRY(cs_lua_film_push_sound(script->L, CS_SCRIPT_FILM));
  *path = lua_tostring(script->L, -2);
  return *path ? check_file(script->context, *path, lua_tostring(script->L, -1)) : CELSPAN_OK;
}
