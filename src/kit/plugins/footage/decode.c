#include "plugins/footage/decode.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "inside/clock.h"

enum { AHEAD = 24 /* pictures that are decoded rather than that another worker starts */ };

/* Marks: decoding began here; it got stuck on the way to the next place where it can begin; and the
 * picture did not come of a worker that began at the place before it where this is possible, at the
 * one before that, or at the beginning. It is lost if it came of none. */
enum { BEGUN = 1, STUCK = 2, MISSED = 4, MISSED_EARLIER = 8, MISSED_WHOLE = 16 };
enum { LOST = MISSED | MISSED_EARLIER | MISSED_WHOLE };

/* ---------------------------------------------------------------- the cache */

static void clear(cs_cache_entry *entry, cs_memory *memory) {
  cs_decode_picture *picture = (cs_decode_picture *)entry;
  cs_mem_free(memory, picture->planes, picture->size);
}

static celspan_status create_cache(celspan_context *context, cs_service **out) {
  return cs_cache_service_create(context, sizeof(cs_decode_picture), clear,
                                 context->root->picture_bytes / 4, out);
}

static const cs_service_kind cache_kind = {create_cache, cs_cache_service_destroy,
                                           cs_cache_service_trim};

static celspan_status get_cache(celspan_context *context, cs_cache **out) {
  cs_service *service;
  CS_TRY(cs_context_service(context, &cache_kind, &service));
  *out = cs_cache_of(service);
  return CELSPAN_OK;
}

static cs_cache_key key_of(const cs_decode *d, size_t place) {
  return (cs_cache_key){d->key.a, d->key.b, d->key.c + place};
}

void cs_decode_release(celspan_context *context, cs_decode_picture *picture) {
  cs_cache *cache;
  if (get_cache(context, &cache) == CELSPAN_OK)
    cs_cache_unpin(cache, &picture->cached);
}

/* ---------------------------------------------------------------- what the worker says */

/* Keeps the first line of what is said first, for a message. */
static void keep_words(cs_decode *d, const char *bytes, size_t size) {
  for (size_t i = 0; i < size && !d->is_said; i++) {
    d->is_said = bytes[i] == '\n' || d->said.size == CS_WORDS;
    if (!d->is_said)
      cs_words_add(&d->said, bytes + i, 1);
  }
}

/* Each message of the socket is what ffmpeg wrote at once. "frame:0 pts:512 pts_time:0.04" is the
 * time of a picture, which may be missing; "t=1" comes after each. All others are words, also parts
 * of a line, which other threads of ffmpeg may write between two messages. */
static bool hear(void *user, const char *bytes, size_t size) {
  cs_decode *d = user;
  char line[128];
  long long time = INT64_MIN;
  snprintf(line, sizeof line, "%.*s", (int)size, bytes);
  d->heard++;
  if (strcmp(line, "t=1\n") == 0)
    return true;
  const char *at = strncmp(line, "frame:", 6) == 0 ? strstr(line, " pts:") : NULL;
  if (!at || d->time_count == CS_DECODE_TIMES) {
    d->has_erred = true;
    d->is_sound = d->is_sound && !d->has_shown;
    keep_words(d, bytes, size);
    return false;
  }
  d->has_shown = true;
  (void)!sscanf(at, " pts:%lld", &time);
  d->times[(d->first_time + d->time_count++) % CS_DECODE_TIMES] = time;
  return true;
}

/* ---------------------------------------------------------------- beginning */

/* The last picture up to a place at which decoding can begin. */
static size_t key_before(const cs_decode *d, size_t place) {
  while (place > 0 && !d->listing->pictures[place].is_key)
    place--;
  return place;
}

/* Where the worker must begin that may have the picture: earlier than those that had it not. */
static size_t start_of(const cs_decode *d, size_t place) {
  size_t key = key_before(d, place);
  unsigned marks = d->marks[place];
  if (!(marks & MISSED) || key == 0)
    return key;
  return marks & MISSED_EARLIER ? 0 : key_before(d, key - 1);
}

/* Whether pictures of the worker look as they do whatever was decoded before, also in parts behind
 * the one where it has begun. */
static bool is_passing(const cs_decode *d) { return !d->is_careful || d->is_sound; }

static bool is_lost(const cs_decode *d, size_t place) { return (d->marks[place] & LOST) == LOST; }

static celspan_status open_again(const cs_decode *d, celspan_context *context, cs_kind_file *out) {
  CS_TRY(cs_kind_open(context, d->path, NULL, out));
  if (out->size == d->file.size && out->time == d->file.time && out->number == d->file.number)
    return CELSPAN_OK;
  close(out->descriptor);
  return cs_fail(context, CELSPAN_INPUT, "the movie %s has changed since it was opened", d->path);
}

static cs_message message_of(const cs_decode *d, size_t place) {
  const cs_listing *listing = d->listing;
  cs_message message = {.kind = CS_MESSAGE_OPEN,
                        .movie = {.has_from = place > 0,
                                  .width = listing->width,
                                  .height = listing->height,
                                  .is_careful = d->is_careful}};
  /* half a tick more, so that rounding does not lead to an earlier picture */
  double ticks = (double)listing->pictures[place].time + .5;
  message.movie.from = ticks * listing->tick[0] / listing->tick[1];
  snprintf(message.text, sizeof message.text, "%s", d->file.kind);
  memcpy(message.movie.pixels, d->pixels, sizeof d->pixels);
  memcpy(message.movie.decoder, d->decoder, sizeof d->decoder);
  return message;
}

/* Starts a worker at a picture where decoding can begin. */
static celspan_status begin(cs_decode *d, celspan_context *context, size_t place) {
  const cs_message message = message_of(d, place);
  cs_kind_file file;
  cs_decode_stop(d);
  CS_TRY(open_again(d, context, &file));
  d->media = (cs_media)CS_MEDIA("movie", "pictures", d->path);
  d->media.hear = hear;
  d->media.user = d;
  d->time_count = 0;
  d->next = d->begin = place;
  d->begun++;
  d->has_shown = false;
  d->is_sound = true;
  d->is_said = d->said.size > 0;
  celspan_status status =
      cs_media_start(&d->media, context, CS_WORKER_WATCHES, &message, file.descriptor);
  close(file.descriptor);
  if (status == CELSPAN_OK)
    cs_decode_note(d);
  else
    cs_media_close(&d->media);
  return status;
}

/* ---------------------------------------------------------------- the next picture */

/* The place of a time; false: no picture has it. */
static bool find_place(const cs_decode *d, int64_t time, size_t *place) {
  size_t low = 0, high = d->listing->count;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (d->listing->pictures[middle].time < time)
      low = middle + 1;
    else
      high = middle;
  }
  *place = low;
  return low < d->listing->count && d->listing->pictures[low].time == time;
}

/* Waits for the time of the next picture, which is said before its first byte is written.
 * *is_over: there are no more pictures, or there is one without a time. */
static celspan_status next_time(cs_decode *d, celspan_context *context, int64_t *time,
                                bool *is_over) {
  double since = cs_clock_seconds();
  bool is_readable = false;
  uint64_t heard;
  *is_over = false;
  do {
    heard = d->heard;
    if (d->time_count == 0)
      CS_TRY(cs_media_wait(&d->media, context, since, &is_readable));
  } while (d->time_count == 0 && (!is_readable || d->heard > heard));
  *is_over = d->time_count == 0;
  if (*is_over)
    return CELSPAN_OK;
  *time = d->times[d->first_time];
  d->first_time = (d->first_time + 1) % CS_DECODE_TIMES;
  d->time_count--;
  return CELSPAN_OK;
}

/* Reads the picture into a new entry, which is counted, but not in the cache yet. */
static celspan_status read_picture(cs_decode *d, celspan_context *context, cs_cache *cache,
                                   size_t place, cs_decode_picture **out, bool *is_over) {
  size_t got = 0, size = cs_raw_size(&d->planes);
  cs_cache_entry *entry;
  CS_TRY(cs_cache_create(cache, context, key_of(d, place), sizeof **out + size, &entry));
  cs_decode_picture *picture = (cs_decode_picture *)entry;
  picture->size = size;
  picture->planes = cs_mem_resize(cache->memory, NULL, 0, size);
  celspan_status status = picture->planes ? CELSPAN_OK : cs_fail_memory(context);
  if (status == CELSPAN_OK)
    status = cs_media_read(&d->media, context, picture->planes, size, &got);
  *is_over = got < size;
  if (status == CELSPAN_OK && !*is_over) {
    d->decoded++;
    *out = picture;
    return CELSPAN_OK;
  }
  cs_cache_discard(cache, entry);
  return status;
}

/* Decoding is careful from now on if words were said, and all that is known begins again. Returns
 * whether this is new. */
static bool turn_careful(cs_decode *d) {
  bool is_new = d->has_erred && !d->is_careful;
  if (is_new)
    memset(d->marks, 0, d->listing->count);
  d->is_careful = d->is_careful || is_new;
  return is_new;
}

/* Notes that the pictures of some places did not come of the worker. What is true of one that began
 * early is true of a later one, unless words were said. */
static void miss(cs_decode *d, size_t first, size_t end) {
  const bool is_passed = is_passing(d);
  size_t key = first < end ? key_before(d, first) : 0;
  size_t earlier = key > 0 ? key_before(d, key - 1) : 0;
  for (size_t i = first; i < end; i++) {
    if (d->listing->pictures[i].is_key && i > key) {
      earlier = key;
      key = i;
    }
    const size_t starts[] = {key, earlier, 0};
    for (int s = 0; s < 3; s++)
      if (starts[s] == d->begin || (is_passed && starts[s] > d->begin))
        d->marks[i] |= (unsigned char)(MISSED << s);
  }
}

/* The place behind the part of a picture. */
static size_t end_of_part(const cs_decode *d, size_t place) {
  size_t end = place + 1;
  while (end < d->listing->count && !d->listing->pictures[end].is_key)
    end++;
  return end;
}

/* No more pictures come of the worker. What it says of the movie is no failure: other pictures may
 * be decoded by another one. */
static celspan_status conclude(cs_decode *d, celspan_context *context, size_t wanted) {
  celspan_context own;
  cs_context_branch(&own, context);
  cs_media_shut(&d->media);
  celspan_status status = cs_media_conclude(&d->media, &own);
  if (status != CELSPAN_OK && status != CELSPAN_INPUT)
    return cs_fail(context, status, "%s", own.error);
  if (!turn_careful(d))
    miss(d, d->next, end_of_part(d, wanted));
  return CELSPAN_OK;
}

/* Reads the next picture, and puts it into the cache; if its place is `wanted`, pins it there and
 * returns it in *out. *is_over: none comes, or decoding must be careful from now on. */
static celspan_status step(cs_decode *d, celspan_context *context, cs_cache *cache, size_t wanted,
                           cs_decode_picture **out, bool *is_over) {
  cs_decode_picture *picture = NULL;
  int64_t time = 0;
  size_t place;
  CS_TRY(next_time(d, context, &time, is_over));
  if (*is_over)
    return conclude(d, context, wanted);
  *is_over = turn_careful(d);
  if (*is_over)
    return CELSPAN_OK;
  bool is_known = find_place(d, time, &place);
  CS_TRY(read_picture(d, context, cache, place, &picture, is_over));
  if (*is_over)
    return conclude(d, context, wanted);
  if (is_known) {
    miss(d, d->next, place);
    d->next = place + 1;
  }
  if (!is_known || (!is_passing(d) && start_of(d, place) != d->begin)) {
    cs_cache_discard(cache, &picture->cached);
    return CELSPAN_OK;
  }
  cs_cache_entry *kept = cs_cache_insert(cache, &picture->cached, place == wanted);
  if (place == wanted)
    *out = (cs_decode_picture *)kept;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- a picture */

/* Decodes up to a place. *out is NULL if the picture did not come. */
static celspan_status advance(cs_decode *d, celspan_context *context, cs_cache *cache, size_t place,
                              cs_decode_picture **out) {
  bool is_over = false;
  *out = NULL;
  celspan_status status = CELSPAN_OK;
  while (status == CELSPAN_OK && !*out && !is_over && d->next <= place)
    status = step(d, context, cache, place, out, &is_over);
  if (status != CELSPAN_OK || is_over)
    cs_decode_stop(d);
  return status;
}

/* Continues up to the next place where decoding can begin, if all this fits into the cache. A
 * picture for which the time is over was not asked for, and fails where it is: this is tried once,
 * so that no other picture waits for it again. */
static celspan_status complete(cs_decode *d, celspan_context *context, cs_cache *cache,
                               size_t place) {
  size_t key = key_before(d, place), end = end_of_part(d, place);
  size_t most = cache->budget / 2 / cs_raw_size(&d->planes);
  if (end - key > most || !d->is_running || d->next >= end || d->marks[key] & STUCK)
    return CELSPAN_OK;
  cs_decode_picture *none = NULL;
  celspan_context own;
  cs_context_branch(&own, context);
  celspan_status status = advance(d, &own, cache, end - 1, &none);
  if (none)
    cs_cache_unpin(cache, &none->cached);
  if (status == CELSPAN_LIMIT)
    d->marks[key] |= STUCK;
  return status == CELSPAN_OK || status == CELSPAN_LIMIT
             ? CELSPAN_OK
             : cs_fail(context, status, "%s", own.error);
}

/* Begins before a place, unless decoding is on its way to it. *is_again: it has begun at the same
 * picture before. */
static celspan_status approach(cs_decode *d, celspan_context *context, size_t place,
                               bool *is_again) {
  size_t key = key_before(d, place), start = start_of(d, place);
  bool is_near = key <= d->next || place - d->next <= AHEAD;
  bool is_fit = d->begin == start || (is_passing(d) && d->begin < start && is_near);
  *is_again = false;
  if (d->is_running && d->next <= place && is_fit)
    return CELSPAN_OK;
  *is_again = d->marks[start] & BEGUN;
  d->marks[start] |= BEGUN;
  return begin(d, context, start);
}

/* The picture that is shown at a place: the last one that can be decoded, or the first one. */
static bool find_shown(const cs_decode *d, size_t *place) {
  size_t before = *place, after = *place;
  while (before > 0 && is_lost(d, before))
    before--;
  while (after < d->listing->count && is_lost(d, after))
    after++;
  *place = is_lost(d, before) ? after : before;
  return *place < d->listing->count;
}

/* Each worker that does not have the picture adds a mark to its place, except the one whose words
 * make decoding careful. */
static celspan_status fetch(cs_decode *d, celspan_context *context, cs_cache *cache, size_t place,
                            cs_decode_picture **out) {
  bool is_again = false;
  while (!*out && !is_lost(d, place)) {
    CS_TRY(approach(d, context, place, &is_again));
    CS_TRY(advance(d, context, cache, place, out));
  }
  if (!*out || !is_again)
    return CELSPAN_OK;
  celspan_status status = complete(d, context, cache, place);
  if (status != CELSPAN_OK)
    cs_cache_unpin(cache, &(*out)->cached);
  return status;
}

static celspan_status find(cs_decode *d, celspan_context *context, cs_cache *cache, size_t place,
                           cs_decode_picture **out) {
  *out = NULL;
  while (find_shown(d, &place)) {
    *out = (cs_decode_picture *)cs_cache_pin(cache, key_of(d, place));
    if (!*out)
      CS_TRY(fetch(d, context, cache, place, out));
    if (*out)
      return CELSPAN_OK;
  }
  cs_words_join(&d->said);
  return cs_fail(context, CELSPAN_INPUT, "the movie %s: none of its pictures can be decoded%s%s",
                 d->path, d->said.size > 0 ? ": " : "", d->said.text);
}

celspan_status cs_decode_get(cs_decode *d, celspan_context *context, size_t place,
                             cs_decode_picture **out) {
  cs_cache *cache;
  CS_TRY(get_cache(context, &cache));
  size_t size = cs_raw_size(&d->planes), most = context->root->picture_bytes;
  cs_cache_raise_budget(cache, size < most / 4 ? 4 * size : most);
  pthread_mutex_lock(&d->lock);
  celspan_status status = find(d, context, cache, place, out);
  pthread_mutex_unlock(&d->lock);
  return status;
}

/* ---------------------------------------------------------------- life */

/* ffmpeg's own decoder of VP9 leaves out its alpha. */
static void choose_decoder(cs_decode *d) {
  const char *name = "";
  if (d->listing->has_alpha)
    name = strcmp(d->listing->codec, "vp9") == 0   ? "libvpx-vp9"
           : strcmp(d->listing->codec, "vp8") == 0 ? "libvpx"
                                                   : "";
  snprintf(d->decoder, sizeof d->decoder, "%s", name);
}

/* The size is what the file says: it must not decide how much memory is used. */
static celspan_status check_size(const cs_decode *d, celspan_context *context) {
  size_t size = cs_raw_size(&d->planes), most = context->root->picture_bytes;
  if (size <= most)
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_LIMIT,
                 "the movie %s cannot be read: a picture of %d x %d pixels takes %zu MiB, and the "
                 "memory for pictures is %zu MiB: give more by --memory, or make it smaller",
                 d->path, (int)d->planes.width, (int)d->planes.height, (size >> 20) + 1,
                 most >> 20);
}

static celspan_status set_planes(cs_decode *d, celspan_context *context) {
  const cs_listing *listing = d->listing;
  if (cs_raw_is_foreign(listing->pixels))
    return cs_fail(context, CELSPAN_INPUT,
                   "the movie %s has pixels of the form %s, whose colours are not read: convert it "
                   "to R'G'B'",
                   d->path, listing->pixels);
  bool is_yuva = *d->decoder && strncmp(listing->pixels, "yuv4", 4) == 0;
  char name[40];
  snprintf(name, sizeof name, "%s%s", is_yuva ? "yuva" : "", listing->pixels + (is_yuva ? 3 : 0));
  cs_raw_parse(name, &d->planes, d->pixels);
  const float *shares = cs_raw_matrix(listing->matrix, listing->height);
  bool is_mixed = d->planes.has_colour && !d->planes.is_rgb;
  if (!shares && is_mixed)
    return cs_fail(context, CELSPAN_INPUT,
                   "the movie %s has colours by the matrix %s, which is not read: convert it to "
                   "BT.709",
                   d->path, listing->matrix);
  d->planes.red = shares ? shares[0] : 0;
  d->planes.blue = shares ? shares[1] : 0;
  d->planes.width = listing->width;
  d->planes.height = listing->height;
  d->planes.turns = listing->turns;
  cs_raw_set_range(&d->planes, listing->range);
  cs_raw_set_site(&d->planes, listing->site);
  return check_size(d, context);
}

void cs_decode_begin(cs_decode *d, const cs_listing *listing) {
  *d = (cs_decode){.listing = listing};
  pthread_mutex_init(&d->lock, NULL);
}

celspan_status cs_decode_init(cs_decode *d, celspan_context *context, const char *path,
                              const cs_kind_file *file) {
  d->file = *file;
  d->path = cs_mem_resize(context->memory, NULL, 0, strlen(path) + 1);
  d->marks = cs_mem_array(context->memory, d->listing->count, 1);
  if (!d->path || !d->marks)
    return cs_fail_memory(context);
  strcpy(d->path, path);
  choose_decoder(d);
  return set_planes(d, context);
}

void cs_decode_finish(cs_decode *d, cs_memory *memory) {
  pthread_mutex_lock(&d->lock); /* another movie may be ending its worker */
  cs_decode_stop(d);
  pthread_mutex_unlock(&d->lock);
  pthread_mutex_destroy(&d->lock);
  cs_mem_free(memory, d->path, d->path ? strlen(d->path) + 1 : 0);
  cs_mem_free(memory, d->marks, d->marks ? d->listing->count : 0);
}
