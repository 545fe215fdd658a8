/* The zygote: a process that loads the picture module and the colour module, each when it is first
 * needed, and forks workers, which then have them.
 *
 *   program --spawn--> zygote --fork--> worker
 *              |          `-----fork--> worker        a module is loaded once, for all of them
 *              `- - - - - sockets - - - - -^
 *
 * It is this program, executed again: the program has threads and a Lua state when the first
 * picture is opened, and after a fork of such a process only few functions are safe to call. Two
 * further advantages are a different memory layout and that the program's memory is not copied. The
 * zygote itself never reads a picture, so that a worker that was lost costs a fork and no loading.
 *
 * INVARIANT: the zygote ends when the program's end of its socket is closed, for whatever reason
 * the program ended, and ends its workers first. While it loads a module, it ends after the time
 * limit of loading at the latest.
 */
#pragma once

#include <stdbool.h>

/* The first argument of a zygote; the others are the folders that workers may read. */
#define CS_ZYGOTE_ARGUMENT "--zygote"
#define CS_ZYGOTE_SOCKET 3

/* Whether this process was started as a zygote. */
bool cs_zygote_is_meant(int count, char **arguments);
_Noreturn void cs_zygote_run(int count, char **arguments);
