/* A worker that decodes one sound: it becomes ffmpeg, which may read that file and nothing else.
 *
 *   sound --descriptor--> ffmpeg --pipe--> samples of 32 bits as a WAV file without an end
 *                            `---socket--> its messages
 *
 * INVARIANT: the format is given, so that ffmpeg does not guess: a list of files or an address in
 * the sound is not followed. The kernel lets the process read the sound and the libraries, start no
 * program but ffmpeg, and write to the pipe and the socket alone; only a kernel that cannot confine
 * a process leaves it at the first sentence, and never with --strict.
 */
#pragma once

#include "plugins/isolate/worker_loop.h"

#define CS_SOUND_WORKER_FILE "/proc/self/fd/3" /* the name of the sound in messages of ffmpeg */
/* Bytes of memory for the libraries of ffmpeg, which do not count against its limit. */
#define CS_SOUND_WORKER_LOADED ((uint64_t)64 << 20)
/* The exit code if ffmpeg is not in PATH, and the one if it cannot be started. */
#define CS_SOUND_WORKER_MISSING 125
#define CS_SOUND_WORKER_NOT_STARTED 126

/* desc->memory: the pipe. */
_Noreturn void cs_sound_worker_run(const cs_worker_desc *desc);
