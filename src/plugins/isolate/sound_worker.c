#include "plugins/isolate/sound_worker.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SOUND = 3, ARGUMENTS = 40, NUMBER = 16, FILTER = 256 };

/* ---------------------------------------------------------------- the program */

/* The path of ffmpeg, with links resolved, because the kernel's rules need this. false: there is
 * none. */
static bool find_ffmpeg(char out[PATH_MAX]) {
  const char *folders = getenv("PATH");
  char path[PATH_MAX];
  while (folders) {
    const char *end = strchr(folders, ':');
    int length = (int)(end ? end - folders : (ptrdiff_t)strlen(folders));
    int size = snprintf(path, sizeof path, "%.*s%sffmpeg", length, folders, length ? "/" : "");
    if (size > 0 && size < (int)sizeof path && access(path, X_OK) == 0 && realpath(path, out))
      return true;
    folders = end ? end + 1 : NULL;
  }
  return false;
}

/* ---------------------------------------------------------------- its files */

/* The sound is the descriptor of the request. */
static cs_message receive(const cs_worker_desc *desc, int *sound) {
  cs_message message;
  cs_message_arrival arrival;
  do
    arrival = cs_message_receive(desc->socket, &message, sound);
  while (arrival == CS_MESSAGE_LATE);
  if (arrival != CS_MESSAGE_ARRIVED || message.kind != CS_MESSAGE_OPEN || *sound < 0)
    _exit(0);
  return message;
}

/* Each descriptor has its source, a number from 3 on. The sound is moved last, because its number
 * may be one of sources that are no longer needed then. */
static void set_files(const cs_worker_desc *desc, int sound) {
  bool is_set = dup2(desc->memory, STDOUT_FILENO) >= 0 && dup2(desc->socket, STDERR_FILENO) >= 0;
  is_set = is_set && (sound == SOUND ? fcntl(SOUND, F_SETFD, 0) == 0 : dup2(sound, SOUND) >= 0);
  if (!is_set)
    _exit(CS_SOUND_WORKER_NOT_STARTED);
}

/* ---------------------------------------------------------------- its arguments */

static void add_number(const char **arguments, const char *option, int32_t number,
                       char text[NUMBER]) {
  while (*arguments)
    arguments++;
  if (number > 0) {
    snprintf(text, NUMBER, "%d", (int)number);
    *arguments++ = option;
    *arguments = text;
  }
}

/* Samples get new times in the order in which they arrive, so that ffmpeg neither adds nor drops
 * any because of their times. One filter can halve the tempo at most, and sounds best if it doubles
 * the tempo at most. */
static void write_filter(double speed, char out[FILTER]) {
  int size = snprintf(out, FILTER, "asetpts=N/SR/TB");
  while (speed > 0 && speed != 1 && size < FILTER) {
    double step = fmin(2, fmax(0.5, speed));
    size += snprintf(out + size, FILTER - (size_t)size, ",atempo=%.9f", step);
    speed = speed / step;
  }
}

/* One thread is enough, because decoding is much faster than playing. */
static void start_ffmpeg(const char *path, const cs_message *message) {
  char rate[NUMBER], channels[NUMBER], filter[FILTER];
  const char *arguments[ARGUMENTS] = {"ffmpeg",
                                      "-nostdin",
                                      "-hide_banner",
                                      "-loglevel",
                                      "error",
                                      "-xerror",
                                      "-filter_threads",
                                      "1",
                                      "-threads",
                                      "1",
                                      "-protocol_whitelist",
                                      "file",
                                      "-f",
                                      message->text,
                                      "-i",
                                      CS_SOUND_WORKER_FILE,
                                      "-map",
                                      "0:a:0",
                                      "-af",
                                      filter,
                                      "-c:a",
                                      "pcm_f32le",
                                      "-bitexact",
                                      "-f",
                                      "wav"};
  size_t count = 0;
  write_filter(message->sound.speed, filter);
  add_number(arguments, "-ar", message->sound.rate, rate);
  add_number(arguments, "-ac", message->sound.channels, channels);
  while (arguments[count])
    count++;
  arguments[count] = "pipe:1";
  execv(path, (char *const *)(size_t)arguments);
}

void cs_sound_worker_run(const cs_worker_desc *desc) {
  char path[PATH_MAX];
  int sound = -1;
  setpgid(0, 0);
  const cs_message message = receive(desc, &sound);
  if (!find_ffmpeg(path))
    _exit(CS_SOUND_WORKER_MISSING);
  set_files(desc, sound);
  cs_worker_loop_confine(desc, &(cs_strict_rights){.program = path, .file = CS_SOUND_WORKER_FILE});
  start_ffmpeg(path, &message);
  dprintf(STDERR_FILENO, "%s cannot be started: %s", path, strerror(errno));
  _exit(CS_SOUND_WORKER_NOT_STARTED);
}
