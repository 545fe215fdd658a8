/* A picture module and a colour module for tests of the code that decodes pictures: they do what
 * the names of files and the bytes of colour profiles say.
 *
 *   others                       64 x 64 grey pixels
 *   crash, abort, leave          a fault, an abort or an exit while reading
 *   hang                         reading never ends
 *   stick                        likewise, after an allocation that failed
 *   eat                          reading uses memory until none is left, and fails then
 *   choke                        likewise, but does not notice the failure: a fault
 *   keep                         reading allocates 48 MiB, and never frees them
 *   babble, endless, odd, tell   an invalid message is sent to the program: other bytes, a text
 *                                without an end, an unknown status, or one that was not requested
 *   touch                        the modification time of the file changes
 *   open-crash, open-hang, ...   the same while opening
 *   lie, lie-height, ...         an impossible header; of a profile an impossible table
 *   greedy, confused             while writing: more bytes than the shared memory has are put, or
 *                                another message is sent
 *
 * With HOSTILE_IS_OLD in the environment it belongs to another version of celspan; while it is
 * loaded it does what HOSTILE_LOADING names.
 */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "plugins/isolate/message.h"

enum { SIDE = 64, PIECE = 1 << 22, KEPT = 48 << 20, DESCRIPTORS = 256 };

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
  snprintf(failure->text, sizeof failure->text, "%.255s: %s", name, text);
  return status;
}

/* The name of the file that is opened by a descriptor. */
static void find_name(const char *file, char out[4096]) {
  char path[4096];
  ssize_t size = readlink(file, path, sizeof path - 1);
  path[size < 0 ? 0 : size] = '\0';
  const char *from = size < 0 ? file : path, *slash = strrchr(from, '/');
  snprintf(out, 4096, "%s", slash ? slash + 1 : from);
}

/* Allocates until no memory is left. */
static void eat(void) {
  char *piece = malloc(PIECE);
  while (piece) {
    memset(piece, 1, PIECE);
    piece = malloc(PIECE);
  }
}

/* The connection to the program. A malicious picture could find it in the same way after taking
 * over its decoder. */
static int find_socket(void) {
  for (int found = 3; found < DESCRIPTORS; found++) {
    int type = 0;
    socklen_t size = sizeof type;
    if (getsockopt(found, SOL_SOCKET, SO_TYPE, &type, &size) == 0 && type == SOCK_SEQPACKET)
      return found;
  }
  return -1;
}

static void say(const void *bytes, size_t size) {
  (void)!send(find_socket(), bytes, size, MSG_NOSIGNAL);
}

static void misspeak(const char *name) {
  cs_message message = {.kind = CS_MESSAGE_DONE};
  if (strstr(name, "babble"))
    say(name, strlen(name));
  if (strstr(name, "endless"))
    memset(message.text, 'x', sizeof message.text);
  if (strstr(name, "odd"))
    message.status = 99;
  if (strstr(name, "tell"))
    message.kind = CS_MESSAGE_PART;
  say(&message, sizeof message);
}

/* Sends a message that the program must not accept. Returns whether the program accepted it. */
static bool put_wrongly(const char *name) {
  cs_message message = {.kind = strstr(name, "confused") ? CS_MESSAGE_PART : CS_MESSAGE_PUT,
                        .put = {.size = strstr(name, "greedy") ? CS_SHARED : 0}};
  say(&message, sizeof message);
  return recv(find_socket(), &message, sizeof message, 0) > 0 && message.status == CELSPAN_OK;
}

static celspan_status behave(const char *name, cs_picture_failure *failure) {
  if (strstr(name, "crash"))
    return (celspan_status)*nowhere;
  if (strstr(name, "abort"))
    abort();
  if (strstr(name, "leave"))
    exit(3);
  if (strstr(name, "babble") || strstr(name, "endless") || strstr(name, "odd") ||
      strstr(name, "tell"))
    misspeak(name);
  if (strstr(name, "stick"))
    errno = ENOMEM;
  while (strstr(name, "hang") || strstr(name, "stick"))
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

static void falsify(const char *name, cs_picture_header *header) {
  if (strstr(name, "height"))
    header->info.height = 0;
  else if (strstr(name, "channels"))
    header->info.channels = CS_PICTURE_CHANNELS + 1;
  else if (strstr(name, "bits"))
    header->bits = 17;
  else if (strstr(name, "alpha"))
    header->alpha = (cs_picture_alpha)99;
  else if (strstr(name, "format"))
    memset(header->info.format, 'x', sizeof header->info.format);
  else if (strstr(name, "colour"))
    strcpy(header->info.colour, "s\nrgb");
  else if (strstr(name, "beyond"))
    strcpy(header->info.colour, "s\xc3\xa4");
  else
    header->info.width = -1;
}

static celspan_status open_file(const cs_picture_request *request, cs_picture_reader **out,
                                cs_picture_header *header, cs_picture_failure *failure) {
  cs_picture_reader *reader = malloc(sizeof *reader);
  celspan_status status = CELSPAN_OK;
  if (!reader)
    return fail(failure, CELSPAN_NO_MEMORY, request->file, "out of memory");
  find_name(request->file, reader->name);
  if (strstr(reader->name, "touch"))
    utimensat(AT_FDCWD, request->file, (struct timespec[2]){{.tv_sec = 1}, {.tv_sec = 1}}, 0);
  if (strstr(reader->name, "open-"))
    status = behave(reader->name, failure);
  if (status != CELSPAN_OK) {
    free(reader);
    return status;
  }
  *header = (cs_picture_header){
      .info = {.width = SIDE, .height = SIDE, .channels = 3, .format = "faulty", .colour = "srgb"},
      .alpha = CS_PICTURE_ALPHA_STRAIGHT,
      .bits = 8};
  if (strstr(reader->name, "lie"))
    falsify(reader->name, header);
  *out = reader;
  return CELSPAN_OK;
}

static celspan_status read_file(cs_picture_reader *reader, int32_t x, int32_t y, int32_t width,
                                int32_t height, float *rgba, cs_picture_failure *failure) {
  (void)x, (void)y;
  celspan_status status =
      strstr(reader->name, "open-") ? CELSPAN_OK : behave(reader->name, failure);
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
  return output->put(output->user, 0, "begun", 5)
             ? CELSPAN_OK
             : fail(failure, CELSPAN_OUTPUT, output->name, "no");
}

static celspan_status write_output(cs_picture_writer *writer, int32_t y, int32_t count,
                                   const void *rows, cs_picture_failure *failure) {
  (void)y, (void)count, (void)rows;
  if (strstr(writer->name, "greedy") || strstr(writer->name, "confused"))
    return put_wrongly(writer->name) ? CELSPAN_OK
                                     : fail(failure, CELSPAN_OUTPUT, writer->name, "not taken");
  return behave(writer->name, failure);
}

static celspan_status complete_output(cs_picture_writer *writer, cs_picture_failure *failure) {
  (void)failure;
  free(writer);
  return CELSPAN_OK;
}

static void abandon_output(cs_picture_writer *writer) { free(writer); }

static void watch_memory(void) {}

__attribute__((constructor)) static void load(void) {
  cs_picture_failure failure;
  const char *how = getenv("HOSTILE_LOADING");
  if (how)
    behave(how, &failure);
}

/* ---------------------------------------------------------------- colour profiles */

static celspan_status sample(const cs_colour_request *request, cs_colour_table *out,
                             cs_picture_failure *failure) {
  char name[64];
  snprintf(name, sizeof name, "%.*s", (int)request->size, (const char *)request->bytes);
  memset(out, 0, sizeof *out);
  out->form = strstr(name, "form") ? 77 : CS_COLOUR_GRID;
  memset(out->name, 'x', sizeof out->name);
  memset(out->grid, strstr(name, "number") ? 0xff : 0, sizeof out->grid);
  return behave(name, failure);
}

CELSPAN_API const void *celspan_colour_module(void) {
  static const cs_colour_module table = {CS_COLOUR_MODULE_VERSION, sample};
  return &table;
}

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
