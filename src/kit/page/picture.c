/* The sink of PNG writes a cs_file, whose system calls are here memory.
 *
 *   celspan_frame_desc -> sink -> cs_file -> write_memory -> written
 */
#include "page/picture.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "inside/frames.h"
#include "inside/sinks.h"

/* No file has this name, which engine.mjs is asked for, and does not note as missing. */
#define PATH "/dev/png"

enum { DESCRIPTOR = INT_MAX }; /* none of files.c */

/* A cs_file_system has no pointer of its user. */
static struct {
  unsigned char *bytes;
  size_t size, room;
} written;

static int open_memory(const char *path, int flags, mode_t mode) {
  (void)path, (void)flags, (void)mode;
  return DESCRIPTOR;
}

/* A PNG is only appended to. */
static ssize_t write_memory(int descriptor, const void *bytes, size_t size, off_t offset) {
  size_t end = (size_t)offset + size, room = end > written.room ? 2 * end : written.room;
  unsigned char *all = room > written.room ? realloc(written.bytes, room) : written.bytes;
  (void)descriptor;
  if (!all) {
    errno = ENOMEM;
    return -1;
  }
  memcpy(all + offset, bytes, size);
  written.bytes = all, written.size = end, written.room = room;
  return (ssize_t)size;
}

static int close_memory(int descriptor) { return descriptor == DESCRIPTOR ? 0 : -1; }
static int forget_name(const char *path) { return path ? 0 : -1; }

/* The file is never committed, so these calls are all. */
static const cs_file_system memory = {
    .open = open_memory, .pwrite = write_memory, .close = close_memory, .unlink = forget_name};

static celspan_status draw(celspan_context *context, const celspan_frame_desc *frame,
                           const char *title, cs_file *into) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coding = CELSPAN_CODING;
  celspan_sink sink;
  const char *name;
  coding.space = frame->space;
  file.coding = &coding;
  file.title = title;
  file.is_opaque = celspan_frame_is_opaque(frame);
  file.workers = 1;
  CS_TRY(cs_sink_png_part(context, PATH, into, &file, &sink));
  CS_TRY(cs_frame_render_own(context, frame, &sink, NULL));
  return cs_file_temporary(into, context, &name); /* all of it is written then */
}

celspan_status cs_picture_png(celspan_context *context, const celspan_frame_desc *frame,
                              const char *title, unsigned char **bytes, size_t *size) {
  cs_file *file;
  free(*bytes);
  *bytes = NULL;
  CS_TRY(cs_file_create(context, &memory, PATH, &file));
  celspan_status status = draw(context, frame, title, file);
  cs_file_discard(file, context);
  *bytes = written.bytes;
  *size = written.size;
  memset(&written, 0, sizeof written);
  return status;
}
