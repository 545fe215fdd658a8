#include "plugins/isolate/media_arguments.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* ---------------------------------------------------------------- lists */

static void add(cs_media_arguments *out, const char *argument) {
  if (out->count < CS_MEDIA_ARGUMENTS - 1)
    out->list[out->count++] = argument;
}

#define ADD(out, ...)                                                                              \
  add_all(out, (const char *const[]){__VA_ARGS__},                                                 \
          sizeof((const char *const[]){__VA_ARGS__}) / sizeof(const char *))

static void add_all(cs_media_arguments *out, const char *const *arguments, size_t count) {
  for (size_t i = 0; i < count; i++)
    add(out, arguments[i]);
}

/* Adds an option and its value, which has numbers. */
__attribute__((format(printf, 3, 4))) static void
add_value(cs_media_arguments *out, const char *option, const char *format, ...) {
  va_list values;
  char *text = out->texts + out->size;
  va_start(values, format);
  int size = vsnprintf(text, sizeof out->texts - out->size, format, values);
  va_end(values);
  if (size < 0 || (size_t)size >= sizeof out->texts - out->size)
    return;
  out->size += (size_t)size + 1;
  ADD(out, option, text);
}

/* The beginning that all command lines share. Words that are the same as the last ones are said,
 * too, because what matters of them may be when. */
static void begin(cs_media_arguments *out, const char *program) {
  *out = (cs_media_arguments){.count = 0};
  ADD(out, program, "-hide_banner", "-loglevel", "repeat+error", "-protocol_whitelist", "file");
}

static void add_input(cs_media_arguments *out, const char *kind, const char *file) {
  ADD(out, "-f", kind, "-i", file);
}

/* ---------------------------------------------------------------- sounds */

/* Samples get new times in the order in which they arrive, so that ffmpeg neither adds nor drops
 * any because of their times. One filter can halve the tempo at most, and sounds best if it doubles
 * the tempo at most. */
static void add_tempo(cs_media_arguments *out, double speed) {
  enum { FILTER = 256 };
  char text[FILTER];
  int size = snprintf(text, FILTER, "asetpts=N/SR/TB");
  while (speed > 0 && speed != 1 && size < FILTER) {
    double step = fmin(2, fmax(0.5, speed));
    size += snprintf(text + size, FILTER - (size_t)size, ",atempo=%.9f", step);
    speed = speed / step;
  }
  add_value(out, "-af", "%s", text);
}

/* One thread is enough, because decoding is much faster than playing. */
static void make_sound(const cs_message *message, const char *file, cs_media_arguments *out) {
  begin(out, "ffmpeg");
  ADD(out, "-nostdin", "-xerror", "-filter_threads", "1", "-threads", "1");
  add_input(out, message->text, file);
  ADD(out, "-map", "0:a:0");
  add_tempo(out, message->sound.speed);
  ADD(out, "-c:a", "pcm_f32le", "-bitexact", "-f", "wav");
  if (message->sound.rate > 0)
    add_value(out, "-ar", "%d", (int)message->sound.rate);
  if (message->sound.channels > 0)
    add_value(out, "-ac", "%d", (int)message->sound.channels);
  add(out, "pipe:1");
}

/* ---------------------------------------------------------------- movies */

/* A line for each packet, then one for each stream. */
static void make_listing(const cs_message *message, const char *file, cs_media_arguments *out) {
  begin(out, "ffprobe");
  ADD(out, "-of", "compact", "-show_entries",
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
static void add_pictures(const cs_message_movie *movie, cs_media_arguments *out) {
  ADD(out, "-map", "0:V:0");
  add_value(out, "-vf",
            "scale=%d:%d:flags=bicubic+accurate_rnd+full_chroma_int+bitexact,format=%s,"
            "metadata=add:key=t:value=1,metadata=print:file='pipe\\:2':direct=1",
            (int)movie->width, (int)movie->height, movie->pixels);
  ADD(out, "-c:v", "rawvideo", "-threads", "1", "-vsync", "passthrough", "-f", "rawvideo",
      "pipe:1");
}

/* Times are those of the file, and a start between two key pictures is at the first of them. */
static void make_movie(const cs_message *message, const char *file, cs_media_arguments *out) {
  const cs_message_movie *movie = &message->movie;
  begin(out, "ffmpeg");
  ADD(out, "-nostdin", "-filter_threads", "1", "-copyts", "-noautorotate", "-max_error_rate", "1",
      "-threads", movie->is_careful ? "1" : "2");
  if (movie->decoder[0])
    ADD(out, "-c:v", movie->decoder);
  if (movie->has_from) {
    ADD(out, "-seek_timestamp", "1", "-noaccurate_seek");
    add_value(out, "-ss", "%.6f", movie->from);
  }
  add_input(out, message->text, file);
  add_pictures(movie, out);
}

void cs_media_arguments_make(cs_worker_task task, const cs_message *message, const char *file,
                             cs_media_arguments *out) {
  if (task == CS_WORKER_LISTENS)
    make_sound(message, file, out);
  else if (task == CS_WORKER_LISTS)
    make_listing(message, file, out);
  else
    make_movie(message, file, out);
}
