#include "plugins/raster/write.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "plugins/moving/moving.h"

struct cs_picture_writer {
  cs_moving *moving; /* NULL: the rest is used */
  const cs_write_format *format;
  cs_write_target target;
  cs_picture_output output; /* with copies of the texts */
  char *names[CS_PICTURE_CHANNELS];
  char *name, *title, *colour;
  void *self;
};

bool cs_write_put(cs_write_target *target, const void *bytes, size_t size) {
  target->has_failed = target->has_failed || !target->put(target->user, target->at, bytes, size);
  target->at += size;
  target->size = target->at > target->size ? target->at : target->size;
  return !target->has_failed;
}

size_t cs_write_row(const cs_picture_output *output) {
  size_t value = output->depth == CELSPAN_DEPTH_8       ? 1
                 : output->depth == CELSPAN_DEPTH_FLOAT ? 4
                                                        : 2;
  return (size_t)output->width * (size_t)output->channels * value;
}

static void destroy(cs_picture_writer *writer) {
  if (writer->moving)
    cs_moving_abandon(writer->moving);
  if (writer->self)
    writer->format->destroy(writer->self);
  for (int i = 0; i < CS_PICTURE_CHANNELS; i++)
    free(writer->names[i]);
  free(writer->name);
  free(writer->title);
  free(writer->colour);
  free(writer);
}

static const cs_write_format *find(const char *name) {
  static const cs_write_format *const all[] = {&cs_write_jpeg, &cs_write_webp, &cs_write_tiff,
                                               &cs_write_exr};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    if (strcmp(all[i]->name, name) == 0)
      return all[i];
  return NULL;
}

static bool copy(const char *text, char **out) {
  *out = text ? strdup(text) : NULL;
  return *out || !text;
}

static bool copy_output(cs_picture_writer *writer, const cs_picture_output *output) {
  writer->output = *output;
  bool is_good = copy(output->name, &writer->name) && copy(output->title, &writer->title) &&
                 copy(output->colour, &writer->colour);
  for (int i = 0; output->names && i < output->channels && is_good; i++)
    is_good = copy(output->names[i], &writer->names[i]);
  writer->output.name = writer->name;
  writer->output.title = writer->title;
  writer->output.colour = writer->colour;
  writer->output.names = output->names ? (const char *const *)writer->names : NULL;
  return is_good;
}

static celspan_status open_moving(const cs_picture_output *output, cs_picture_writer **out,
                                  cs_picture_failure *failure) {
  cs_picture_writer *writer = calloc(1, sizeof *writer);
  if (!writer)
    return cs_raster_fail(failure, CELSPAN_NO_MEMORY, "%s: out of memory", output->name);
  celspan_status status = cs_moving_open(output, &writer->moving, failure);
  return CS_GIVE(status, writer, destroy, out);
}

celspan_status cs_write_open(const cs_picture_output *output, cs_picture_writer **out,
                             cs_picture_failure *failure) {
  if (cs_moving_has(output))
    return open_moving(output, out, failure);
  const cs_write_format *format = find(output->format);
  if (!format)
    return cs_raster_fail(failure, CELSPAN_OUTPUT,
                          "%s: the format %s is written by OpenImageIO alone, which is missing",
                          output->name, output->format);
  if ((uint64_t)output->width * (uint64_t)output->height > CS_RASTER_PIXELS)
    return cs_raster_fail(failure, CELSPAN_LIMIT,
                          "%s: at most 268435456 pixels are written without OpenImageIO",
                          output->name);
  cs_picture_writer *writer = calloc(1, sizeof *writer);
  bool is_good = writer && copy_output(writer, output);
  if (is_good) {
    writer->format = format;
    writer->target = (cs_write_target){.put = output->put, .user = output->user};
    writer->self = format->begin(&writer->output, &writer->target);
  }
  if (is_good && writer->self) {
    *out = writer;
    return CELSPAN_OK;
  }
  if (writer)
    destroy(writer);
  return cs_raster_fail(failure, CELSPAN_NO_MEMORY, "%s: out of memory", output->name);
}

static celspan_status judge(const cs_picture_writer *writer, bool is_good,
                            cs_picture_failure *failure) {
  if (is_good && !writer->target.has_failed)
    return CELSPAN_OK;
  if (writer->target.lacks_memory)
    return cs_raster_fail(failure, CELSPAN_NO_MEMORY, "%s: out of memory", writer->output.name);
  return cs_raster_fail(failure, CELSPAN_OUTPUT, "%s: cannot be written", writer->output.name);
}

celspan_status cs_write_rows(cs_picture_writer *writer, int32_t y, int32_t count, const void *rows,
                             cs_picture_failure *failure) {
  (void)y;
  if (writer->moving)
    return cs_moving_rows(writer->moving, count, rows, failure);
  return judge(writer, writer->format->rows(writer->self, count, rows), failure);
}

static celspan_status close_moving(cs_picture_writer *writer, cs_picture_failure *failure) {
  celspan_status status = cs_moving_close(writer->moving, failure);
  writer->moving = NULL;
  return status;
}

celspan_status cs_write_close(cs_picture_writer *writer, cs_picture_failure *failure) {
  celspan_status status = writer->moving
                              ? close_moving(writer, failure)
                              : judge(writer, writer->format->end(writer->self), failure);
  destroy(writer);
  return status;
}

void cs_write_abandon(cs_picture_writer *writer) {
  writer->target.has_failed = true; /* a library may still try to complete its file */
  destroy(writer);
}
