#include "writers/join/join.h"

#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "inside/files.h"
#include "inside/sinks.h"
#include "writers/join/format.h"

static const cs_join_format *const FORMATS[] = {&cs_join_png, &cs_join_tga, &cs_join_span};

enum { FORMAT_COUNT = sizeof FORMATS / sizeof FORMATS[0] };

typedef struct job {
  const char *const *paths;
  size_t count;
  const char *output;
  const cs_join_format *format; /* the format of the first part */
  cs_join_part first;           /* closed */
  int32_t row;                  /* the next row */
} job;

/* ---------------------------------------------------------------- the parts */

static const cs_join_format *format_of(const unsigned char start[CS_JOIN_START]) {
  for (size_t i = 0; i < FORMAT_COUNT; i++)
    if (FORMATS[i]->claims(start))
      return FORMATS[i];
  return NULL;
}

static celspan_status inspect(celspan_context *context, cs_join_part *part,
                              const cs_join_format **format) {
  unsigned char start[CS_JOIN_START];
  CS_TRY(cs_join_part_read(context, part, 0, start, sizeof start));
  *format = format_of(start);
  if (!*format)
    return cs_join_part_fail(context, part,
                             "is not a strip: 'celspan render --strip' makes strips, as PNG, "
                             "Targa or span files");
  CS_TRY((*format)->inspect(context, part));
  if (part->strip.height == 0)
    return cs_join_part_fail(context, part,
                             "is a complete picture: 'celspan render --strip' makes strips");
  if (!cs_strip_fits(part->strip, part->height))
    return cs_join_part_fail(context, part,
                             "declares a first row of %d and %d of %d rows, which is not "
                             "possible for a strip: render it again",
                             part->strip.row, part->height, part->strip.height);
  return CELSPAN_OK;
}

/* Whether a part continues the parts before it. */
static celspan_status check_next(celspan_context *context, const job *j, const cs_join_part *part,
                                 const cs_join_format *format) {
  if (j->row > 0 &&
      (format != j->format || part->form.a != j->first.form.a || part->form.b != j->first.form.b))
    return cs_join_part_fail(context, part,
                             "is not of the same picture as %s: render both with the same format, "
                             "size, depth and colours",
                             j->first.path);
  if (j->row > 0 && part->strip.height != j->first.strip.height)
    return cs_join_part_fail(context, part,
                             "belongs to a picture of %d rows, and %s to one of "
                             "%d: join strips of one picture",
                             part->strip.height, j->first.path, j->first.strip.height);
  if (part->strip.row != j->row)
    return cs_join_part_fail(context, part,
                             "begins at row %d, but the next row is %d: give every strip once, "
                             "from top to bottom",
                             part->strip.row, j->row);
  return CELSPAN_OK;
}

/* Opens a part and checks that it is the next one. On failure the part is closed. */
static celspan_status open_next(celspan_context *context, const job *j, const char *path,
                                cs_join_part *part, const cs_join_format **format) {
  CS_TRY(cs_join_part_open(context, path, part));
  celspan_status status = inspect(context, part, format);
  if (status == CELSPAN_OK)
    status = check_next(context, j, part, *format);
  if (status != CELSPAN_OK)
    cs_join_part_close(part);
  return status;
}

/* ---------------------------------------------------------------- before anything is written */

static celspan_status check_parts(celspan_context *context, job *j) {
  cs_join_part part = {.descriptor = -1};
  for (size_t i = 0; i < j->count; i++) {
    const cs_join_format *format = NULL;
    CS_TRY(open_next(context, j, j->paths[i], &part, &format));
    cs_join_part_close(&part);
    if (i == 0) {
      j->first = part;
      j->format = format;
    }
    j->row += part.height;
  }
  if (j->row == j->first.strip.height)
    return CELSPAN_OK;
  return cs_join_part_fail(context, &part,
                           "ends before row %d, but the picture has %d: give the "
                           "strips below it too",
                           j->row, j->first.strip.height);
}

static bool is_one_file(const char *a, const char *b) {
  struct stat first, second;
  return stat(a, &first) == 0 && stat(b, &second) == 0 && first.st_dev == second.st_dev &&
         first.st_ino == second.st_ino;
}

static celspan_status check_output(celspan_context *context, const job *j) {
  const char *ending = cs_file_ending(j->output);
  bool is_known = false;
  for (size_t i = 0; i < 3 && j->format->endings[i]; i++)
    is_known |= strcasecmp(ending, j->format->endings[i]) == 0;
  if (!is_known)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: the strips are %s files, and joining does not convert them: the name "
                   "must end in .%s",
                   j->output, j->format->name, j->format->endings[0]);
  for (size_t i = 0; i < j->count; i++)
    if (is_one_file(j->paths[i], j->output))
      return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s is one of the strips: give another name",
                     j->output);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the file */

static celspan_status add_part(celspan_context *context, job *j, size_t i, cs_joining *joining) {
  cs_join_part part = {.descriptor = -1};
  const cs_join_format *format = NULL;
  CS_TRY(open_next(context, j, j->paths[i], &part, &format));
  celspan_status status = CELSPAN_OK;
  if (i == 0)
    status = j->format->begin(joining, context, &part);
  if (status == CELSPAN_OK)
    status = j->format->add(joining, context, &part);
  cs_join_part_close(&part);
  j->row += part.height;
  return status;
}

static celspan_status write_parts(celspan_context *context, job *j, cs_joining *joining) {
  j->row = 0;
  for (size_t i = 0; i < j->count; i++)
    CS_TRY(add_part(context, j, i, joining));
  return j->format->end(joining, context);
}

static bool is_name(const char *wanted, const char *name) { return strcmp(wanted, name) == 0; }

/* Strips are large, and so are the incomplete files of a run that was killed: they are removed
 * first. */
static celspan_status write_file(celspan_context *context, job *j) {
  cs_temporary_sweep(j->output, is_name);
  cs_joining *joining;
  CS_TRY(CS_MAKE(context, joining, 1));
  celspan_status status = cs_file_create(context, NULL, j->output, &joining->file);
  if (status == CELSPAN_OK)
    status = write_parts(context, j, joining);
  status = cs_file_end(joining->file, context, status);
  spanfile_joiner_destroy(joining->spanfile);
  cs_mem_free(context->memory, joining, sizeof *joining);
  return status;
}

celspan_status cs_join(celspan_context *context, const char *const *paths, size_t count,
                       const char *output) {
  job j = {.paths = paths, .count = count, .output = output};
  CS_TRY(check_parts(context, &j));
  CS_TRY(check_output(context, &j));
  return write_file(context, &j);
}
