#include "frames/film/sequence.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/open.h"
#include "output/sinks/file.h"

#define MOST_FRAMES 10000000 /* frames of one list; 80 MB of numbers */
#define MOST_NUMBER 1000000000000
#define MOST_WIDTH 20

/* ---------------------------------------------------------------- lists */

typedef struct reader {
  celspan_context *context;
  const char *list, *at;
  const cs_film_info *film; /* NULL: none */
} reader;

static celspan_status refuse(const reader *r, const char *what) {
  return celspan_context_fail(
      r->context, CELSPAN_BAD_ARGUMENT,
      "frames \"%.200s\": %s at character %d; write it like 1-10,20-30:2,45", r->list, what,
      (int)(r->at - r->list) + 1);
}

static void skip_spaces(reader *r) { r->at += strspn(r->at, " \t"); }

static bool skip(reader *r, char sign) {
  skip_spaces(r);
  if (*r->at != sign)
    return false;
  r->at++;
  skip_spaces(r);
  return true;
}

static celspan_status read_number(reader *r, int64_t *out) {
  skip_spaces(r);
  bool is_negative = *r->at == '-';
  const char *digit = r->at + is_negative;
  if (*digit < '0' || *digit > '9')
    return refuse(r, "a whole number is missing");
  int64_t number = 0;
  for (; *digit >= '0' && *digit <= '9'; digit++) {
    number = number * 10 + (*digit - '0');
    if (number > MOST_NUMBER)
      return refuse(r, "the number is too large");
  }
  r->at = digit;
  *out = is_negative ? -number : number;
  return CELSPAN_OK;
}

static celspan_status append(reader *r, cs_sequence *out, int64_t from, int64_t to, int64_t step) {
  size_t added = (size_t)((to - from) / step) + 1;
  if (added > MOST_FRAMES || out->count + added > MOST_FRAMES)
    return celspan_context_fail(r->context, CELSPAN_LIMIT,
                                "frames \"%.200s\": more than %d frames in one list", r->list,
                                MOST_FRAMES);
  CS_TRY(CS_RESERVE(r->context, out->frames, out->capacity, out->count + added));
  for (size_t i = 0; i < added; i++)
    out->frames[out->count++] = from + (int64_t)i * step;
  return CELSPAN_OK;
}

/* Reads ":step", if there is one, and appends the range. */
static celspan_status append_steps(reader *r, cs_sequence *out, int64_t from, int64_t to) {
  int64_t step = 1;
  if (skip(r, ':'))
    CS_TRY(read_number(r, &step));
  if (step == 0)
    return refuse(r, "the step is 0");
  if (to != from && (to < from) != (step < 0))
    return refuse(r, to < from ? "a range that goes down needs a step below 0"
                               : "a range that goes up needs a step above 0");
  return append(r, out, from, to, step);
}

static celspan_status read_numbers(reader *r, cs_sequence *out) {
  int64_t from, to;
  CS_TRY(read_number(r, &from));
  to = from;
  if (skip(r, '-'))
    CS_TRY(read_number(r, &to));
  return append_steps(r, out, from, to);
}

/* ---------------------------------------------------------------- times */

/* The length of "2s" or "2.5s"; 0: there is no time. */
static size_t match_time(const char *text) {
  static const char digits[] = "0123456789";
  size_t length = strspn(text, digits);
  if (length > 0 && text[length] == '.')
    length += 1 + strspn(text + length + 1, digits);
  return length > 0 && text[length] == 's' && !isalnum((unsigned char)text[length + 1]) ? length + 1
                                                                                        : 0;
}

/* The seconds of a time. The digits are read here and not by strtod, which depends on the host's
 * language. */
static double seconds_of(const char *time) {
  double seconds = 0, place = 1;
  for (; *time != '.' && *time != 's'; time++)
    seconds = seconds * 10 + (*time - '0');
  for (time += *time == '.'; *time != 's'; time++)
    seconds += (*time - '0') * (place /= 10);
  return seconds;
}

static celspan_status read_time(reader *r, double *out) {
  skip_spaces(r);
  size_t length = match_time(r->at);
  if (length == 0)
    return refuse(r, "a time such as 4s is missing");
  double seconds = *out = seconds_of(r->at);
  r->at += length;
  return seconds * r->film->frames_second <= (double)MOST_NUMBER
             ? CELSPAN_OK
             : refuse(r, "the time is too late");
}

/* The index of the first frame that begins at this time or later; times are those that the frame
 * function gets. */
static int64_t find_index(const cs_film_info *film, double seconds) {
  int64_t index = (int64_t)ceil(seconds * film->frames_second);
  while (index > 0 && (double)(index - 1) / film->frames_second >= seconds)
    index--;
  while ((double)index / film->frames_second < seconds)
    index++;
  return index;
}

/* The index of the frame that is seen at this time. */
static int64_t find_visible(const cs_film_info *film, double seconds) {
  int64_t index = find_index(film, seconds);
  return index - ((double)index / film->frames_second > seconds);
}

bool cs_sequence_at_time(const cs_film_info *film, const char *time, int64_t *out) {
  size_t length = match_time(time);
  double seconds = length > 0 && time[length] == '\0' ? seconds_of(time) : INFINITY;
  if (!(seconds * film->frames_second <= (double)MOST_NUMBER))
    return false;
  int64_t index = find_visible(film, seconds);
  *out = film->first + index;
  return index < film->count;
}

static celspan_status read_times(reader *r, cs_sequence *out) {
  double from, to;
  CS_TRY(read_time(r, &from));
  int64_t first = find_visible(r->film, from), last = first;
  if (skip(r, '-')) {
    CS_TRY(read_time(r, &to));
    first = find_index(r->film, from);
    last = find_index(r->film, to) - 1;
    if (last < first)
      return refuse(r, "no frame begins between the two times");
  }
  return append_steps(r, out, r->film->first + first, r->film->first + last);
}

/* ---------------------------------------------------------------- marks */

static celspan_status refuse_mark(const reader *r, size_t length) {
  char names[200];
  size_t used = 0;
  names[0] = '\0';
  for (size_t i = 0; i < r->film->mark_count && used < sizeof names; i++)
    used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", i ? ", " : "",
                             r->film->marks[i].name);
  return celspan_context_fail(
      r->context, CELSPAN_BAD_ARGUMENT, "frames \"%.200s\": the film has no mark \"%.*s\"%s%s%s",
      r->list, (int)(length < 100 ? length : 100), r->at,
      names[0] ? "; its marks are " : "; write numbers like 1-10,20-30:2, or seconds like 2s-4s",
      names, used < sizeof names ? "" : " ...");
}

static celspan_status read_mark(reader *r, cs_sequence *out) {
  size_t length = strcspn(r->at, ",:");
  while (length > 0 && strchr(" \t", r->at[length - 1]))
    length--;
  for (size_t i = 0; i < r->film->mark_count; i++) {
    const cs_film_mark *mark = &r->film->marks[i];
    if (strlen(mark->name) != length || memcmp(mark->name, r->at, length) != 0)
      continue;
    r->at += length;
    return append_steps(r, out, mark->frame, cs_film_mark_last(r->film, i));
  }
  return refuse_mark(r, length);
}

static celspan_status read_element(reader *r, cs_sequence *out) {
  skip_spaces(r);
  if (r->film && match_time(r->at) > 0)
    return read_times(r, out);
  if (r->film && *r->at && !strchr("-,:0123456789", *r->at))
    return read_mark(r, out);
  return read_numbers(r, out);
}

/* ---------------------------------------------------------------- whole lists */

static int compare(const void *a, const void *b) {
  int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
  return (x > y) - (x < y);
}

static celspan_status check_overlaps(const reader *r, const cs_sequence *sequence) {
  int64_t *sorted;
  CS_TRY(CS_MAKE(r->context, sorted, sequence->count));
  memcpy(sorted, sequence->frames, sequence->count * sizeof *sorted);
  qsort(sorted, sequence->count, sizeof *sorted, compare);
  celspan_status status = CELSPAN_OK;
  for (size_t i = 1; i < sequence->count && status == CELSPAN_OK; i++)
    if (sorted[i] == sorted[i - 1])
      status = celspan_context_fail(r->context, CELSPAN_BAD_ARGUMENT,
                                    "frames \"%.200s\": frame %lld is listed twice", r->list,
                                    (long long)sorted[i]);
  cs_mem_free(r->context->memory, sorted, sequence->count * sizeof *sorted);
  return status;
}

celspan_status cs_sequence_parse(celspan_context *context, const char *list,
                                 const cs_film_info *film, cs_sequence *out) {
  reader r = {context, list, list, film};
  cs_sequence sequence = {.memory = context->memory};
  celspan_status status;
  do
    status = read_element(&r, &sequence);
  while (status == CELSPAN_OK && skip(&r, ','));
  if (status == CELSPAN_OK && *r.at)
    status = refuse(&r, "there is an unexpected character");
  if (status == CELSPAN_OK)
    status = check_overlaps(&r, &sequence);
  if (status != CELSPAN_OK)
    cs_sequence_finish(&sequence);
  else
    *out = sequence;
  return status;
}

celspan_status cs_sequence_count(celspan_context *context, int64_t first, int64_t count,
                                 cs_sequence *out) {
  reader r = {context, "all", "all", NULL};
  cs_sequence sequence = {.memory = context->memory};
  celspan_status status = append(&r, &sequence, first, first + count - 1, 1);
  if (status == CELSPAN_OK)
    *out = sequence;
  return status;
}

bool cs_sequence_is_run(const cs_sequence *sequence) {
  for (size_t i = 1; i < sequence->count; i++)
    if (sequence->frames[i] != sequence->frames[i - 1] + 1)
      return false;
  return true;
}

void cs_sequence_finish(cs_sequence *sequence) {
  cs_mem_free(sequence->memory, sequence->frames, sequence->capacity * sizeof *sequence->frames);
  *sequence = (cs_sequence){0};
}

celspan_status cs_sequence_within(celspan_context *context, const cs_sequence *sequence,
                                  int64_t first, int64_t count) {
  for (size_t i = 0; i < sequence->count; i++)
    if (sequence->frames[i] < first || sequence->frames[i] >= first + count)
      return celspan_context_fail(context, CELSPAN_BAD_ARGUMENT,
                                  "frame %lld is outside the film, whose frames are %lld to %lld",
                                  (long long)sequence->frames[i], (long long)first,
                                  (long long)(first + count - 1));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- names */

/* Where the number goes: pattern[start .. end) is replaced by it, padded to `width`. */
typedef struct number_field {
  size_t start, end;
  int width;
  bool is_found;
} number_field;

/* The length of "%d", "%4d" or "%04d" at the beginning of the text; 0 when there is none. */
static size_t match_percent(const char *text, int *width) {
  size_t digits = text[0] == '%' ? strspn(text + 1, "0123456789") : 0;
  if (text[0] != '%' || text[1 + digits] != 'd' || digits > 3)
    return 0;
  *width = atoi(text + 1);
  return digits + 2;
}

static number_field find_number_field(const char *pattern) {
  const char *slash = strrchr(pattern, '/');
  number_field found = {0};
  for (const char *at = slash ? slash + 1 : pattern; *at;) {
    int width = 0;
    size_t length = strspn(at, "#");
    if (length)
      width = (int)(length < MOST_WIDTH ? length : MOST_WIDTH);
    else
      length = match_percent(at, &width);
    size_t start = (size_t)(at - pattern);
    if (length)
      found = (number_field){start, start + length, width < MOST_WIDTH ? width : MOST_WIDTH, true};
    at += length ? length : 1;
  }
  return found;
}

size_t cs_sequence_place(const char *pattern) {
  number_field at = find_number_field(pattern);
  size_t ending = strlen(cs_file_ending(pattern));
  return at.is_found ? at.start : strlen(pattern) - ending;
}

bool cs_sequence_has_number(const char *pattern) { return find_number_field(pattern).is_found; }

bool cs_sequence_matches(const char *pattern, const char *name) {
  number_field at = find_number_field(pattern);
  if (!at.is_found)
    return strcmp(pattern, name) == 0;
  size_t tail = strlen(pattern + at.end), length = strlen(name);
  if (length < at.start + tail || strncmp(pattern, name, at.start) != 0 ||
      strcmp(pattern + at.end, name + length - tail) != 0)
    return false;
  return strspn(name + at.start, "-0123456789 ") >= length - tail - at.start;
}

celspan_status cs_sequence_name(celspan_context *context, const char *pattern, int64_t frame,
                                char *name, size_t size) {
  number_field at = find_number_field(pattern);
  int length = at.is_found ? snprintf(name, size, "%.*s%0*lld%s", (int)at.start, pattern, at.width,
                                      (long long)frame, pattern + at.end)
                           : snprintf(name, size, "%s", pattern);
  if (length < 0 || (size_t)length >= size)
    return celspan_context_fail(context, CELSPAN_BAD_ARGUMENT,
                                "the file name \"%.80s...\" is too long", pattern);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- files that are there */

enum { PATH_SIZE = 4096 };

/* Adds the number of a file if the pattern gives this name to that number. */
static celspan_status add_file(reader *r, const char *pattern, const char *name, cs_sequence *out) {
  char expected[PATH_SIZE];
  if (!cs_sequence_matches(pattern, name))
    return CELSPAN_OK;
  int64_t number = strtoll(name + find_number_field(pattern).start, NULL, 10);
  celspan_status status = cs_sequence_name(r->context, pattern, number, expected, sizeof expected);
  if (status != CELSPAN_OK || strcmp(expected, name) != 0)
    return status;
  return append(r, out, number, number, 1);
}

static celspan_status fail_folder(celspan_context *context, const char *pattern, int error) {
  if (error == ENOMEM)
    return celspan_context_fail(context, CELSPAN_NO_MEMORY,
                                "%.600s: its folder cannot be read: out of memory", pattern);
  return celspan_context_fail(context, CELSPAN_INPUT, "%.600s: its folder cannot be read: %s",
                              pattern, strerror(error));
}

celspan_status cs_sequence_list(celspan_context *context, const char *pattern, cs_sequence *out) {
  const char *slash = strrchr(pattern, '/'), *name = slash ? slash + 1 : pattern;
  char path[PATH_SIZE];
  int length = snprintf(path, sizeof path, "%.*s", (int)(name - pattern), pattern);
  DIR *folder = length < PATH_SIZE ? opendir(length ? path : ".") : NULL;
  if (!folder)
    return fail_folder(context, pattern, length < PATH_SIZE ? errno : ENAMETOOLONG);
  reader r = {context, pattern, pattern, NULL};
  cs_sequence sequence = {.memory = context->memory};
  celspan_status status = CELSPAN_OK;
  for (struct dirent *entry; status == CELSPAN_OK && (entry = cs_open_entry(folder));)
    status = add_file(&r, name, entry->d_name, &sequence);
  if (status == CELSPAN_OK && errno)
    status = fail_folder(context, pattern, errno);
  closedir(folder);
  if (sequence.count > 0)
    qsort(sequence.frames, sequence.count, sizeof *sequence.frames, compare);
  if (status == CELSPAN_OK)
    *out = sequence;
  else
    cs_sequence_finish(&sequence);
  return status;
}
