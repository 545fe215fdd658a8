#include "plugins/isolate/media_worker.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "process/arguments.h"

enum { MEDIA = 3 };

/* ---------------------------------------------------------------- command lines */

/* The beginning that all command lines share. Words that are the same as the last ones are said,
 * too, because what matters of them may be when. */
static void begin(cs_arguments *out, const char *program) {
  *out = (cs_arguments){.count = 0};
  CS_ARGUMENTS(out, program, "-hide_banner", "-loglevel", "repeat+error", "-protocol_whitelist",
               "file");
}

static void add_input(cs_arguments *out, const char *kind, const char *file) {
  CS_ARGUMENTS(out, "-f", kind, "-i", file);
}

/* ---------------------------------------------------------------- sounds */

/* Samples get new times in the order in which they arrive, so that ffmpeg neither adds nor drops
 * any because of their times. One filter can halve the tempo at most, and sounds best if it doubles
 * the tempo at most. */
static void add_tempo(cs_arguments *out, double speed) {
  enum { FILTER = 256 };
  char text[FILTER];
  int size = snprintf(text, FILTER, "asetpts=N/SR/TB");
  while (speed > 0 && speed != 1 && size < FILTER) {
    double step = fmin(2, fmax(0.5, speed));
    size += snprintf(text + size, FILTER - (size_t)size, ",atempo=%.9f", step);
    speed = speed / step;
  }
  cs_arguments_value(out, "-af", "%s", text);
}

/* One thread is enough, because decoding is much faster than playing. */
static void make_sound(const cs_message *message, const char *file, cs_arguments *out) {
  begin(out, "ffmpeg");
  CS_ARGUMENTS(out, "-nostdin", "-xerror", "-filter_threads", "1", "-threads", "1");
  add_input(out, message->text, file);
  CS_ARGUMENTS(out, "-map", "0:a:0");
  add_tempo(out, message->sound.speed);
  CS_ARGUMENTS(out, "-c:a", "pcm_f32le", "-bitexact", "-f", "wav");
  if (message->sound.rate > 0)
    cs_arguments_value(out, "-ar", "%d", (int)message->sound.rate);
  if (message->sound.channels > 0)
    cs_arguments_value(out, "-ac", "%d", (int)message->sound.channels);
  CS_ARGUMENTS(out, "pipe:1");
}

/* ---------------------------------------------------------------- movies */

/* A line for each packet, then one for each stream. */
static void make_listing(const cs_message *message, const char *file, cs_arguments *out) {
  begin(out, "ffprobe");
  CS_ARGUMENTS(
      out, "-of", "compact", "-show_entries",
      "stream=index,codec_type,codec_name,width,height,pix_fmt,sample_aspect_ratio,color_range,"
      "color_space,color_transfer,color_primaries,chroma_location,time_base,avg_frame_rate,"
      "nb_frames,duration_ts:"
      "stream_disposition=attached_pic:stream_tags=alpha_mode:stream_side_data=rotation:"
      "packet=stream_index,pts,duration,flags");
  add_input(out, message->text, file);
}

/* Every picture goes to the pipe as raw planes, after a line with its time has gone to the socket:
 * the filter that prints it prints pictures with metadata alone, so all get some. A picture whose
 * size changes is scaled to the first size; all others pass the scaler as they are. */
static void add_pictures(const cs_message_movie *movie, cs_arguments *out) {
  CS_ARGUMENTS(out, "-map", "0:V:0");
  cs_arguments_value(out, "-vf",
                     "scale=%d:%d:flags=bicubic+accurate_rnd+full_chroma_int+bitexact,format=%s,"
                     "metadata=add:key=t:value=1,metadata=print:file='pipe\\:2':direct=1",
                     (int)movie->width, (int)movie->height, movie->pixels);
  CS_ARGUMENTS(out, "-c:v", "rawvideo", "-threads", "1", "-vsync", "passthrough", "-f", "rawvideo",
               "pipe:1");
}

/* Times are those of the file, and a start between two key pictures is at the first of them. */
static void make_movie(const cs_message *message, const char *file, cs_arguments *out) {
  const cs_message_movie *movie = &message->movie;
  begin(out, "ffmpeg");
  CS_ARGUMENTS(out, "-nostdin", "-filter_threads", "1", "-copyts", "-noautorotate",
               "-max_error_rate", "1", "-threads", movie->is_careful ? "1" : "2");
  if (movie->decoder[0])
    CS_ARGUMENTS(out, "-c:v", movie->decoder);
  if (movie->has_from) {
    CS_ARGUMENTS(out, "-seek_timestamp", "1", "-noaccurate_seek");
    cs_arguments_value(out, "-ss", "%.6f", movie->from);
  }
  add_input(out, message->text, file);
  add_pictures(movie, out);
}

/* file: the name of the file in the worker. message: its OPEN; it must live as long as *out. */
static void make_command_line(cs_worker_task task, const cs_message *message, const char *file,
                              cs_arguments *out) {
  if (task == CS_WORKER_LISTENS)
    make_sound(message, file, out);
  else if (task == CS_WORKER_LISTS)
    make_listing(message, file, out);
  else
    make_movie(message, file, out);
}

/* ---------------------------------------------------------------- the program */

/* The path of a program, with links resolved, because the kernel's rules need this. false: there is
 * none. */
static bool find_program(const char *name, char out[PATH_MAX]) {
  const char *folders = getenv("PATH");
  char path[PATH_MAX];
  while (folders) {
    const char *end = strchr(folders, ':');
    int length = (int)(end ? end - folders : (ptrdiff_t)strlen(folders));
    int size = snprintf(path, sizeof path, "%.*s%s%s", length, folders, length ? "/" : "", name);
    if (size > 0 && size < (int)sizeof path && access(path, X_OK) == 0 && realpath(path, out))
      return true;
    folders = end ? end + 1 : NULL;
  }
  return false;
}

/* ---------------------------------------------------------------- its files */

/* The file is the descriptor of the request. */
static cs_message receive(const cs_worker_desc *desc, int *file) {
  cs_message message;
  cs_message_arrival arrival;
  do
    arrival = cs_message_receive(desc->socket, &message, file);
  while (arrival == CS_MESSAGE_LATE);
  if (arrival != CS_MESSAGE_ARRIVED || message.kind != CS_MESSAGE_OPEN || *file < 0)
    _exit(0);
  return message;
}

/* Each descriptor has its source, a number from 3 on. The file is moved last, because its number
 * may be one of sources that are no longer needed then. */
static void set_files(const cs_worker_desc *desc, int file) {
  bool is_set = dup2(desc->memory, STDOUT_FILENO) >= 0 && dup2(desc->socket, STDERR_FILENO) >= 0;
  is_set = is_set && (file == MEDIA ? fcntl(file, F_SETFD, 0) == 0 : dup2(file, MEDIA) >= 0);
  if (!is_set)
    _exit(CS_MEDIA_WORKER_NOT_STARTED);
}

/* ---------------------------------------------------------------- the worker */

void cs_media_worker_run(const cs_worker_desc *desc) {
  const cs_worker_task task = (cs_worker_task)desc->start.task;
  char path[PATH_MAX];
  cs_arguments line;
  int file = -1;
  setpgid(0, 0);
  const cs_message message = receive(desc, &file);
  make_command_line(task, &message, CS_MEDIA_WORKER_FILE, &line);
  if (!find_program(line.list[0], path))
    _exit(CS_MEDIA_WORKER_MISSING);
  set_files(desc, file);
  cs_worker_loop_confine(desc, &(cs_strict_rights){.program = path, .file = CS_MEDIA_WORKER_FILE});
  execv(path, (char *const *)(size_t)line.list);
  dprintf(STDERR_FILENO, "%s cannot be started: %s", path, strerror(errno));
  _exit(CS_MEDIA_WORKER_NOT_STARTED);
}
