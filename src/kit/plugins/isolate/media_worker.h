/* A worker that decodes one sound or one movie: it becomes ffmpeg, or ffprobe, which may read that
 * file and nothing else.
 *
 *   file --descriptor--> ffmpeg --pipe--> samples, raw pictures, or what ffprobe lists
 *                           `---socket--> its messages, and the times of the pictures
 *
 * INVARIANT: the format is given, so that ffmpeg does not guess: a list of files or an address in
 * the file is not followed. The kernel lets the process read the file and the libraries, start no
 * program but this one, and write to the pipe and the socket alone; only a kernel that cannot
 * confine a process leaves it at the first sentence, and never with --strict.
 */
#pragma once

#include "plugins/isolate/worker_loop.h"

#define CS_MEDIA_WORKER_FILE "/proc/self/fd/3" /* the name of the file in messages of ffmpeg */
/* Bytes of memory for the libraries of ffmpeg, which do not count against its limit. */
#define CS_MEDIA_WORKER_LOADED ((uint64_t)64 << 20)
/* The exit code if the program is not in PATH, and the one if it cannot be started. */
#define CS_MEDIA_WORKER_MISSING 125
#define CS_MEDIA_WORKER_NOT_STARTED 126

/* desc->memory: the pipe. */
_Noreturn void cs_media_worker_run(const cs_worker_desc *desc);
