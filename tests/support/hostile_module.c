/* A picture module for tests of what decodes pictures: it does what the names of files say.
 *
 *   others                       64 x 64 grey pixels
 *   crash, abort, leave          a fault, an abort or an exit in reading
 *   hang                         reading never ends
 *   eat                          memory is taken by reading until there is none, which is a failure
 *   choke                        likewise, but it is not noticed: a fault
 *   keep                         48 MiB are taken in reading, and never given back
 *   open-crash, open-hang, ...   the same in opening
 *   lie                          a header that no picture has
 *
 * With HOSTILE_IS_OLD in the environment it is of another version of celspan.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pictures/module.h"

enum { SIDE = 64, PIECE = 1 << 22, KEPT = 48 << 20 };

struct cs_picture_reader {
  char name[4096]; /* of the file, in its folder */
};

struct cs_picture_writer {
  char name[4096];
  cs_picture_output output;
};

static const volatile int *nowhere;

static celspan_status fail(cs_picture_failure *failure, celspan_status status, const char *name,
                           const char *text) {
  failure->status = status;
  snprintf(failure->text, sizeof failure->text, "%s: %s", name, text);
  return status;
}

/* The name that leads to the descriptor under which the file is known. */
static void find_name(const char *file, char out[4096]) {
  char path[4096];
  ssize_t size = readlink(file, path, sizeof path - 1);
  path[size < 0 ? 0 : size] = '\0';
  const char *from = size < 0 ? file : path, *slash = strrchr(from, '/');
  snprintf(out, 4096, "%s", slash ? slash + 1 : from);
}

/* Until there is no more. */
static void eat(void) {
  char *piece = malloc(PIECE);
  while (piece) {
    memset(piece, 1, PIECE);
    piece = malloc(PIECE);
  }
}

static celspan_status behave(const char *name, cs_picture_failure *failure) {
  if (strstr(name, "crash"))
    return (celspan_status)*nowhere;
  if (strstr(name, "abort"))
    abort();
  if (strstr(name, "leave"))
    exit(3);
  while (strstr(name, "hang"))
    pause();
  if (strstr(name, "eat") || strstr(name, "choke"))
    eat();
  if (strstr(name, "choke"))
    return (celspan_status)*nowhere;
  if (strstr(name, "eat"))
    return fail(failure, CELSPAN_NO_MEMORY, name, "out of memory");
  if (strstr(name, "keep")) {
    char *kept = malloc(KEPT);
    if (!kept)
      return fail(failure, CELSPAN_NO_MEMORY, name, "out of memory");
    memset(kept, 1, KEPT);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- reading */

static celspan_status open_file(const cs_picture_request *request, cs_picture_reader **out,
                                cs_picture_header *header, cs_picture_failure *failure) {
  cs_picture_reader *reader = malloc(sizeof *reader);
  celspan_status status = CELSPAN_OK;
  if (!reader)
    return fail(failure, CELSPAN_NO_MEMORY, request->file, "out of memory");
  find_name(request->file, reader->name);
  if (strstr(reader->name, "open-"))
    status = behave(reader->name, failure);
  if (status != CELSPAN_OK) {
    free(reader);
    return status;
  }
  *header = (cs_picture_header){.info = {.width = strstr(reader->name, "lie") ? -1 : SIDE,
                                         .height = SIDE,
                                         .channels = 3,
                                         .format = "faulty",
                                         .colour = "srgb"},
                                .alpha = CS_PICTURE_ALPHA_STRAIGHT,
                                .bits = 8};
  *out = reader;
  return CELSPAN_OK;
}

static celspan_status read_file(cs_picture_reader *reader, int32_t x, int32_t y, int32_t width,
                                int32_t height, float *rgba, cs_picture_failure *failure) {
  (void)x, (void)y;
  celspan_status status = strstr(reader->name, "open-") ? CELSPAN_OK : behave(reader->name, failure);
  for (size_t i = 0; i < 4 * (size_t)width * (size_t)height; i++)
    rgba[i] = i % 4 == 3 ? 1.0f : 0.5f;
  return status;
}

static void close_file(cs_picture_reader *reader) { free(reader); }

static celspan_status list_file(cs_picture_reader *reader,
                                bool (*put)(void *user, const cs_picture_part *part), void *user,
                                cs_picture_failure *failure) {
  (void)reader, (void)failure;
  cs_picture_part part = {.width = SIDE, .height = SIDE, .channels = 3, .depth = "8"};
  for (part.subimage = 0; part.subimage < 3 && put(user, &part); part.subimage++)
    continue;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- writing */

static celspan_status open_output(const cs_picture_output *output, cs_picture_writer **out,
                                  cs_picture_failure *failure) {
  cs_picture_writer *writer = malloc(sizeof *writer);
  if (!writer)
    return fail(failure, CELSPAN_NO_MEMORY, output->name, "out of memory");
  find_name(output->name, writer->name);
  writer->output = *output;
  *out = writer;
  return output->put(output->user, 0, "begun", 5) ? CELSPAN_OK
                                                   : fail(failure, CELSPAN_OUTPUT, output->name, "no");
}

static celspan_status write_output(cs_picture_writer *writer, int32_t y, int32_t count,
                                   const void *rows, cs_picture_failure *failure) {
  (void)y, (void)count, (void)rows;
  return behave(writer->name, failure);
}

static celspan_status complete_output(cs_picture_writer *writer, cs_picture_failure *failure) {
  (void)failure;
  free(writer);
  return CELSPAN_OK;
}

static void abandon_output(cs_picture_writer *writer) { free(writer); }

static void watch_memory(void) {}

CELSPAN_API const void *celspan_picture_module(void) {
  static const uint32_t old = CS_PICTURE_MODULE_VERSION - 1;
  static const cs_picture_module table = {CS_PICTURE_MODULE_VERSION,
                                          open_file,
                                          read_file,
                                          close_file,
                                          list_file,
                                          open_output,
                                          write_output,
                                          complete_output,
                                          abandon_output,
                                          watch_memory};
  return getenv("HOSTILE_IS_OLD") ? (const void *)&old : &table;
}
