#include "plugins/footage/listing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "plugins/isolate/media.h"

enum {
  LINE = 2048,
  PART = 65536,
  STREAMS = 64,
  SHARE = 64 << 20 /* bytes of a file that may be listed within the time limit of a picture */
};

/* A packet of any stream. Which streams there are is said after the packets. */
typedef struct packet {
  int64_t time, duration;
  int16_t stream;
  bool is_key;
} packet;

typedef struct reading {
  celspan_context *context;
  const char *path;
  cs_listing *out;
  packet *packets;
  size_t count, capacity;
  bool lacks_time[STREAMS]; /* whether a packet of the stream has no time */
  int64_t listed[STREAMS];  /* packets of streams, also of pictures that an edit list leaves out */
  int video;                /* the stream of the movie; -1: not found yet */
  int64_t promised, length; /* of it: pictures, and ticks of all that are shown; 0: not given */
  char line[LINE];
  size_t size; /* the size of the line */
  bool is_long;
} reading;

/* ---------------------------------------------------------------- fields */

/* The text of a field of a line, up to the next one; false: the line has no such field. */
static bool find_text(const char *line, const char *name, char *out, size_t size) {
  char key[64];
  snprintf(key, sizeof key, "|%s=", name);
  const char *at = strstr(line, key);
  if (!at)
    return false;
  at += strlen(key);
  snprintf(out, size, "%.*s", (int)strcspn(at, "|"), at);
  return true;
}

/* The same for a whole number; *out is unchanged if it is not a number. */
static bool find_number(const char *line, const char *name, int64_t *out) {
  char text[32], *end;
  if (!find_text(line, name, text, sizeof text) || !*text)
    return false;
  long long number = strtoll(text, &end, 10);
  if (*end || number < -(INT64_C(1) << 52) || number > INT64_C(1) << 52)
    return false;
  *out = number;
  return true;
}

/* Two whole numbers above 0, with a sign between them; else {0, 0}. */
static void find_fraction(const char *line, const char *name, int32_t out[2]) {
  char text[32], sign;
  int a = 0, b = 0;
  bool is_there = find_text(line, name, text, sizeof text) &&
                  sscanf(text, "%9d%c%9d", &a, &sign, &b) == 3 && a > 0 && b > 0;
  out[0] = is_there ? a : 0;
  out[1] = is_there ? b : 0;
}

/* ---------------------------------------------------------------- lines */

static celspan_status fail_long(const reading *r, const char *what, int most) {
  return cs_fail(r->context, CELSPAN_LIMIT,
                 "the movie %s cannot be read: it has more than %d %s: cut it into shorter ones",
                 r->path, most, what);
}

static celspan_status add_packet(reading *r, const char *line) {
  packet found = {0};
  int64_t stream = -1;
  char flags[8] = "";
  if (!find_number(line, "stream_index", &stream) || stream < 0 || stream >= STREAMS)
    return CELSPAN_OK;
  r->listed[stream]++;
  find_text(line, "flags", flags, sizeof flags);
  if (strchr(flags, 'D'))
    return CELSPAN_OK;
  if (!find_number(line, "pts", &found.time)) {
    r->lacks_time[stream] = true;
    return CELSPAN_OK;
  }
  find_number(line, "duration", &found.duration);
  found.stream = (int16_t)stream;
  found.is_key = strchr(flags, 'K');
  if (r->count == 8 * (size_t)CS_LISTING_PICTURES)
    return fail_long(r, "parts", 8 * CS_LISTING_PICTURES);
  CS_TRY(CS_RESERVE(r->context, r->packets, r->capacity, r->count + 1));
  r->packets[r->count++] = found;
  return CELSPAN_OK;
}

/* ffprobe reports by how much the picture was turned, anticlockwise. */
static int turns_of(const char *line) {
  int64_t degrees = 0;
  find_number(line, "rotation", &degrees);
  return degrees % 90 == 0 ? (int)(((-degrees / 90) % 4 + 4) % 4) : 0;
}

static void read_video(reading *r, const char *line) {
  cs_listing *out = r->out;
  int64_t width = 0, height = 0, alpha = 0;
  find_number(line, "width", &width);
  find_number(line, "height", &height);
  find_number(line, "tag:alpha_mode", &alpha);
  out->width = width > 0 && width <= CS_LISTING_SIDE ? (int32_t)width : 0;
  out->height = height > 0 && height <= CS_LISTING_SIDE ? (int32_t)height : 0;
  find_fraction(line, "sample_aspect_ratio", out->aspect);
  find_fraction(line, "time_base", out->tick);
  find_fraction(line, "avg_frame_rate", out->rate);
  find_text(line, "codec_name", out->codec, sizeof out->codec);
  find_text(line, "pix_fmt", out->pixels, sizeof out->pixels);
  find_text(line, "color_primaries", out->primaries, sizeof out->primaries);
  find_text(line, "color_space", out->matrix, sizeof out->matrix);
  find_text(line, "color_transfer", out->transfer, sizeof out->transfer);
  find_text(line, "chroma_location", out->site, sizeof out->site);
  find_text(line, "color_range", out->range, sizeof out->range);
  find_number(line, "nb_frames", &r->promised);
  find_number(line, "duration_ts", &r->length);
  out->has_alpha = alpha == 1;
  out->turns = turns_of(line);
}

static void read_stream(reading *r, const char *line) {
  char type[16] = "";
  int64_t index = -1, is_attached = 0;
  find_number(line, "index", &index);
  find_number(line, "disposition:attached_pic", &is_attached);
  find_text(line, "codec_type", type, sizeof type);
  if (strcmp(type, "audio") == 0)
    r->out->has_sound = true;
  if (strcmp(type, "video") != 0 || is_attached || r->video >= 0 || index < 0 || index >= STREAMS)
    return;
  r->video = (int)index;
  read_video(r, line);
}

static celspan_status read_line(reading *r, const char *line) {
  if (strncmp(line, "packet|", 7) == 0)
    return add_packet(r, line);
  if (strncmp(line, "stream|", 7) == 0)
    read_stream(r, line);
  return CELSPAN_OK;
}

/* Longer lines are ignored: ffprobe's own have fewer than a thousand bytes. */
static celspan_status add_bytes(reading *r, const unsigned char *bytes, size_t size) {
  for (size_t i = 0; i < size; i++) {
    if (bytes[i] != '\n') {
      r->is_long = r->size == LINE - 1;
      r->line[r->size] = (char)bytes[i];
      r->size += r->is_long ? 0 : 1;
      continue;
    }
    r->line[r->size] = 0;
    r->size = 0;
    if (!r->is_long)
      CS_TRY(read_line(r, r->line));
    r->is_long = false;
  }
  return CELSPAN_OK;
}

static celspan_status read_all(reading *r, cs_media *media) {
  static const size_t part = PART;
  unsigned char *bytes;
  size_t got = part;
  CS_TRY(CS_MAKE(r->context, bytes, part));
  celspan_status status = CELSPAN_OK;
  while (status == CELSPAN_OK && got == part) {
    status = cs_media_read(media, r->context, bytes, part, &got);
    if (status == CELSPAN_OK)
      status = add_bytes(r, bytes, got);
  }
  cs_mem_free(r->context->memory, bytes, part);
  return status == CELSPAN_OK ? cs_media_conclude(media, r->context) : status;
}

/* ---------------------------------------------------------------- pictures */

static int compare(const void *a, const void *b) {
  const cs_listing_picture *left = a, *right = b;
  int order = (left->time > right->time) - (left->time < right->time);
  return order ? order : right->is_key - left->is_key;
}

/* Sorts the pictures by their times, and drops those whose time has occurred. */
static void sort(cs_listing *out) {
  size_t count = 0;
  if (out->count > 0) /* else there is no array */
    qsort(out->pictures, out->count, sizeof *out->pictures, compare);
  for (size_t i = 0; i < out->count; i++)
    if (i == 0 || out->pictures[i].time != out->pictures[count - 1].time)
      out->pictures[count++] = out->pictures[i];
  out->count = count;
}

static celspan_status take_pictures(reading *r) {
  cs_listing *out = r->out;
  int64_t latest = INT64_MIN;
  for (size_t i = 0; i < r->count; i++) {
    const packet *p = &r->packets[i];
    if (p->stream != r->video)
      continue;
    if (out->count == CS_LISTING_PICTURES)
      return fail_long(r, "pictures", CS_LISTING_PICTURES);
    CS_TRY(CS_RESERVE(r->context, out->pictures, out->capacity, out->count + 1));
    out->pictures[out->count++] = (cs_listing_picture){p->time, p->is_key};
    if (p->time > latest) {
      latest = p->time;
      out->last = p->duration > 0 ? p->duration : 0;
    }
  }
  sort(out);
  return CELSPAN_OK;
}

/* Whether the file lacks pictures that its container counts. Those that an edit list leaves out may
 * lack, too, but do not count in the length. The length of an avi is shortened with the file, and
 * its count is often wrong by one. */
static bool ends_early(const reading *r, const char *kind) {
  const cs_listing *out = r->out;
  const int64_t missing = r->promised - r->listed[r->video];
  if (strcmp(kind, "avi") == 0)
    return missing > 1;
  const int64_t shown = out->pictures[out->count - 1].time - out->pictures[0].time + out->last;
  return missing > 0 && shown < r->length && shown + out->last <= r->length;
}

static celspan_status check(reading *r, const char *kind) {
  const cs_listing *out = r->out;
  const char *path = r->path;
  if (r->video < 0)
    return cs_fail(r->context, CELSPAN_INPUT, "the movie %s has no moving pictures%s", path,
                   out->has_sound ? ", only sound" : "");
  if (out->width == 0 || out->height == 0)
    return cs_fail(r->context, CELSPAN_INPUT,
                   "the movie %s cannot be read: its size is missing, or beyond %d pixels a side",
                   path, CS_LISTING_SIDE);
  CS_TRY(take_pictures(r));
  if (out->count == 0 || out->tick[0] == 0 || r->lacks_time[r->video])
    return cs_fail(r->context, CELSPAN_INPUT, "the movie %s cannot be read: %s", path,
                   out->count > 0 || r->lacks_time[r->video]
                       ? "not all of its pictures have a time; pack it again: "
                         "ffmpeg -fflags +genpts -i FILE -c copy FILE.mkv"
                       : "it has no pictures; it ends before the first one");
  if (ends_early(r, kind))
    return cs_fail(r->context, CELSPAN_INPUT,
                   "the movie %s ends early: it has %lld of the %lld pictures that it counts; copy "
                   "the file again, or keep these: ffmpeg -i FILE -c copy FILE.mkv",
                   path, (long long)r->listed[r->video], (long long)r->promised);
  return CELSPAN_OK;
}

celspan_status cs_listing_read(celspan_context *context, const char *path, const cs_kind_file *file,
                               cs_listing *out) {
  cs_media media = CS_MEDIA("movie", "list of pictures", path);
  cs_message message = {.kind = CS_MESSAGE_OPEN};
  reading *r;
  *out = (cs_listing){.memory = context->memory};
  CS_TRY(CS_MAKE(context, r, 1));
  *r = (reading){.context = context, .path = path, .out = out, .video = -1};
  snprintf(message.text, sizeof message.text, "%s", file->kind);
  media.shares = 1 + (double)file->size / SHARE;
  celspan_status status =
      cs_media_start(&media, context, CS_WORKER_LISTS, &message, file->descriptor);
  if (status == CELSPAN_OK)
    status = read_all(r, &media);
  if (status == CELSPAN_OK)
    status = check(r, file->kind);
  cs_media_close(&media);
  cs_mem_free(context->memory, r->packets, r->capacity * sizeof *r->packets);
  cs_mem_free(context->memory, r, sizeof *r);
  return status;
}

void cs_listing_finish(cs_listing *listing) {
  cs_mem_free(listing->memory, listing->pictures, listing->capacity * sizeof *listing->pictures);
}
