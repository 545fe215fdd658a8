#include "program/outputs/record.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "inside/context.h"
#include "inside/files.h"
#include "inside/sort.h"
#include "process/journal.h"
#include "program/commit.h"
#include "program/film/spaces.h"
#include "program/outputs/target.h"
#include "writers/apart/apart.h"

enum { LINE_SIZE = 256 };

static const char HEAD[] = "celspan frames 1\n";

static celspan_status fail(const cs_record *record, const char *what) {
  return cs_fail(record->context, CELSPAN_OUTPUT, "%s: %s: %s", record->path, what,
                 strerror(errno));
}

/* ---------------------------------------------------------------- keys */

static cs_hash hash_options(const cs_script *script, const cs_request *request,
                            const celspan_frame_desc *frame) {
  const celspan_filter_desc none = CELSPAN_FILTER_DESC;
  const celspan_filter_desc *filter = frame->filter ? frame->filter : &none;
  const int32_t numbers[] = {frame->width,  frame->height,     frame->crop_x,
                             frame->crop_y, frame->crop_width, frame->crop_height,
                             filter->rows,  filter->has_radius};
  const celspan_coding asked = cs_target_coding(request), *coding = &asked;
  cs_hash hash = cs_hash_begin(1);
  cs_hash_text(&hash, celspan_version());
  cs_hash_text(&hash, CS_COMMIT);
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
    cs_hash_word(&hash, (uint64_t)numbers[i]);
  cs_hash_number(&hash, frame->film_width);
  cs_hash_number(&hash, frame->film_height);
  cs_hash_word(&hash, frame->space);
  cs_hash_word(&hash, frame->has_antialias ? 1 + (uint64_t)frame->antialias : 0);
  cs_hash_word(&hash, (uint64_t)filter->kernel);
  cs_hash_number(&hash, filter->radius);
  cs_hash_word(&hash, (uint64_t)coding->depth);
  cs_hash_word(&hash, (uint64_t)coding->transfer);
  cs_hash_word(&hash, (uint64_t)coding->alpha);
  if (request->spaces)
    cs_hash_text(&hash, request->spaces->digest);
  cs_hash_text(&hash, cs_request_text(request, "--format"));
  if (cs_request_has(request, "--strip"))
    cs_hash_text(&hash, "strip");
  if (cs_request_has(request, "--layers"))
    cs_hash_text(&hash, "layers");
  cs_apart_mattes mattes;
  if (cs_request_read(request, "--cryptomatte", &mattes))
    cs_hash_word(&hash, mattes);
  cs_hash_text(&hash, script->film.title);
  cs_hash_number(&hash, script->film.frames_second);
  cs_hash_word(&hash, script->film.count > 1);
  return cs_hash_end(hash);
}

static cs_hash key_of(const cs_record *record, const cs_shoot_frame *frame) {
  cs_hash hash = record->options;
  cs_hash_hash(&hash, frame->scene);
  cs_hash_hash(&hash, frame->inputs);
  return cs_hash_end(hash);
}

static bool equals(cs_hash a, cs_hash b) { return a.a == b.a && a.b == b.b; }

/* The contents of an existing file; false if it cannot be read. */
static bool read_contents(const char *path, cs_file_contents *out) {
  int descriptor = cs_open_to_read(path);
  if (descriptor < 0)
    return false;
  bool is_read = cs_file_contents_read(descriptor, out);
  close(descriptor);
  return is_read;
}

/* ---------------------------------------------------------------- reading */

static bool read_line(const char *text, cs_record_line *out) {
  char pixels[40], end;
  *out = (cs_record_line){0};
  if (sscanf(text,
             "frame %" SCNd64 " %16" SCNx64 "%16" SCNx64 " %" SCNu64 " %16" SCNx64 "%16" SCNx64
             " %33s%c",
             &out->number, &out->key.a, &out->key.b, &out->bytes, &out->contents.a,
             &out->contents.b, pixels, &end) != 8 ||
      end != '\n')
    return false;
  return strcmp(pixels, "-") == 0 ||
         sscanf(pixels, "%16" SCNx64 "%16" SCNx64, &out->pixels.a, &out->pixels.b) == 2;
}

static int compare(const void *a, const void *b) {
  const cs_record_line *x = a, *y = b;
  int order = CS_SORT_ORDER(x->number, y->number);
  return order ? order : CS_SORT_ORDER(x->order, y->order);
}

static celspan_status read_lines(cs_record *record, FILE *file) {
  char text[LINE_SIZE];
  cs_record_line line;
  while (fgets(text, sizeof text, file)) {
    if (!read_line(text, &line))
      continue;
    CS_TRY(CS_RESERVE(record->context, record->lines, record->capacity, record->count + 1));
    line.order = record->count;
    record->lines[record->count++] = line;
  }
  if (ferror(file))
    return fail(record, "cannot read");
  if (record->count > 1)
    qsort(record->lines, record->count, sizeof *record->lines, compare);
  return CELSPAN_OK;
}

/* The record of another version of celspan has another head, and is ignored. */
static celspan_status read_record(cs_record *record) {
  char head[sizeof HEAD];
  FILE *file = fopen(record->path, "re");
  if (!file)
    return errno == ENOENT || errno == ENOTDIR ? CELSPAN_OK : fail(record, "cannot read");
  celspan_status status = CELSPAN_OK;
  if (fgets(head, sizeof head, file) && strcmp(head, HEAD) == 0)
    status = read_lines(record, file);
  fclose(file);
  return status;
}

celspan_status cs_record_open(cs_record *record, const cs_script *script, const cs_request *request,
                              const celspan_frame_desc *frame) {
  const char *output = cs_request_text(request, "-o"), *slash = strrchr(output, '/');
  int folder = slash ? (int)(slash + 1 - output) : 0;
  *record = (cs_record){.context = script->context,
                        .options = hash_options(script, request, frame),
                        .is_forced = cs_request_has(request, "--force"),
                        .needs_pixels = cs_request_has(request, "--hash"),
                        .descriptor = -1};
  int length = snprintf(record->path, sizeof record->path, "%.*s.%s.frames", folder, output,
                        output + folder);
  if (length >= (int)sizeof record->path)
    return cs_fail(record->context, CELSPAN_OUTPUT, "%.80s...: the name is too long", output);
  return read_record(record);
}

/* ---------------------------------------------------------------- asking */

/* The last line of a frame, or NULL. */
static const cs_record_line *find(const cs_record *record, int64_t number) {
  size_t low = 0, high = record->count;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (record->lines[middle].number <= number)
      low = middle + 1;
    else
      high = middle;
  }
  return low > 0 && record->lines[low - 1].number == number ? &record->lines[low - 1] : NULL;
}

bool cs_record_knows(const cs_record *record, int64_t number) {
  return find(record, number) != NULL;
}

static bool is_whole(const cs_record_line *line, const char *path) {
  cs_file_contents contents;
  return read_contents(path, &contents) && contents.bytes == line->bytes &&
         equals(contents.hash, line->contents);
}

bool cs_record_has(const cs_record *record, cs_shoot_frame *frame) {
  const cs_record_line *line = find(record, frame->number);
  cs_file_stamp there;
  bool is_same = line && frame->is_named && equals(line->key, key_of(record, frame));
  if (!is_same && !record->is_forced)
    return false;
  if (record->needs_pixels && !(line && (line->pixels.a || line->pixels.b)))
    return false;
  if (line ? !is_whole(line, frame->path)
           : !cs_file_stamp_read(frame->path, &there) || there.size == 0)
    return false;
  frame->is_named = is_same;
  if (line) {
    frame->digest[0] = line->pixels.a;
    frame->digest[1] = line->pixels.b;
  }
  return true;
}

/* ---------------------------------------------------------------- writing */

static celspan_status append(const cs_record *record, const char *text) {
  return cs_journal_add(record->descriptor, text) ? CELSPAN_OK : fail(record, "cannot write");
}

static celspan_status open_file(cs_record *record) {
  char head[sizeof HEAD] = "";
  record->descriptor = cs_journal_open(record->path);
  if (record->descriptor < 0)
    return fail(record, "cannot write");
  ssize_t size = cs_open_read_at(record->descriptor, head, sizeof HEAD - 1, 0);
  if (size < 0)
    return fail(record, "cannot read");
  if (size > 0 && strcmp(head, HEAD) == 0)
    return cs_journal_end_last(record->descriptor) ? CELSPAN_OK : fail(record, "cannot write");
  if (size > 0 && ftruncate(record->descriptor, 0) != 0) /* the file was of another version */
    return fail(record, "cannot write");
  return append(record, HEAD);
}

/* Called only for the first line, because the folder exists after a frame has been written. */
static celspan_status open_for_lines(cs_record *record) {
  char text[LINE_SIZE];
  CS_TRY(open_file(record));
  snprintf(text, sizeof text, "by %s\n", cs_context_maker(record->context));
  return append(record, text);
}

celspan_status cs_record_add(cs_record *record, const cs_shoot_frame *frame) {
  char text[LINE_SIZE], pixels[40] = "-";
  cs_hash contents = frame->contents.hash, key = key_of(record, frame);
  if (frame->way == CS_SHOOT_KEPT)
    return CELSPAN_OK;
  if (record->descriptor < 0)
    CS_TRY(open_for_lines(record));
  if (record->needs_pixels)
    snprintf(pixels, sizeof pixels, "%016" PRIx64 "%016" PRIx64, frame->digest[0],
             frame->digest[1]);
  snprintf(text, sizeof text,
           "frame %" PRId64 " %016" PRIx64 "%016" PRIx64 " %" PRIu64 " %016" PRIx64 "%016" PRIx64
           " %s\n",
           frame->number, key.a, key.b, frame->contents.bytes, contents.a, contents.b, pixels);
  return append(record, text);
}

void cs_record_close(cs_record *record) {
  if (record->descriptor >= 0)
    close(record->descriptor);
  record->descriptor = -1;
  cs_mem_free(record->context->memory, record->lines, record->capacity * sizeof *record->lines);
  record->lines = NULL;
  record->count = record->capacity = 0;
}
