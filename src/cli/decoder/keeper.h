/* The keeper: a process that loads the picture module, and forks decoders that have it.
 *
 *   program --spawn--> keeper --fork--> decoder
 *              |          `-----fork--> decoder        the module is loaded once, for all of them
 *              `- - - - - sockets - - - - -^
 *
 * It is this program, executed anew: the program has threads and a Lua state when the first picture is
 * opened, and a process that is forked of such a one may hardly do anything. Another memory layout and
 * no memory of the program's own are a gain besides. The keeper itself never looks at a picture, so
 * that what happens to a decoder costs a fork and no loading.
 *
 * INVARIANT: the keeper ends when the program's end of its socket is closed, however the program
 * ended, and ends its decoders before; while it loads the module, in the time that it has for that.
 */
#ifndef CS_CLI_DECODER_KEEPER_H
#define CS_CLI_DECODER_KEEPER_H

#include <stdbool.h>

#define CS_KEEPER_ARGUMENT "--keep-decoders" /* the first one; the others are what may be read */
#define CS_KEEPER_SOCKET 3

/* Whether this process was started as a keeper. */
bool cs_keeper_is_meant(int count, char **arguments);
_Noreturn void cs_keeper_run(int count, char **arguments);

#endif
