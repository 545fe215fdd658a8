#include "plugins/isolate/isolate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "inside/context.h"
#include "plugins/isolate/reader.h"

/* A writer of pictures. Each has a worker of its own, without limits, because the pictures are our
 * own.
 *
 *   rows --shared memory--> module --bytes--> shared memory --> put --> the core's file
 *
 * INVARIANT: a failure of the worker is reported as a failure of the file. The file itself belongs
 * to the core, which removes it if it is incomplete. */
struct cs_picture_writer {
  bool (*put)(void *user, uint64_t offset, const void *bytes, size_t size);
  void *user;
  size_t row; /* bytes */
  cs_worker *worker;
  char name[]; /* the name of the file */
};

/* ---------------------------------------------------------------- asking */

static bool put_bytes(void *user, const cs_message *message) {
  const cs_picture_writer *writer = user;
  return message->kind == CS_MESSAGE_PUT && message->put.size <= CS_SHARED - CS_SHARED_PUT &&
         writer->put(writer->user, message->put.offset, writer->worker->shared + CS_SHARED_PUT,
                     (size_t)message->put.size);
}

/* The outcome of the worker as a failure of the writer. Sentences of the module already contain the
 * file's name. */
static celspan_status ask(cs_picture_writer *writer, cs_message *message,
                          cs_picture_failure *failure) {
  cs_picture_failure reason;
  cs_worker_outcome outcome = CS_WORKER_DIED;
  if (writer->worker->socket >= 0)
    outcome = cs_worker_ask(writer->worker, &(cs_worker_request){message, -1, put_bytes, writer});
  if (outcome == CS_WORKER_ANSWERED && message->status != CELSPAN_NO_MEMORY) {
    failure->status = (celspan_status)message->status;
    snprintf(failure->text, sizeof failure->text, "%s", message->text);
    return failure->status;
  }
  celspan_status status = cs_worker_explain(writer->worker, outcome, CELSPAN_OUTPUT, &reason);
  return cs_worker_fail(failure, status, writer->name, reason.text);
}

static void destroy(cs_picture_writer *writer) {
  cs_worker_leave(writer->worker);
  free(writer);
}

/* ---------------------------------------------------------------- writing */

static size_t value_size(celspan_depth depth) {
  return depth == CELSPAN_DEPTH_8 ? 1 : depth == CELSPAN_DEPTH_FLOAT ? 4 : 2;
}

static cs_picture_writer *create(const cs_picture_output *output) {
  size_t size = strlen(output->name) + 1;
  cs_picture_writer *writer = malloc(sizeof *writer + size);
  if (!writer)
    return NULL;
  writer->put = output->put;
  writer->user = output->user;
  writer->row = (size_t)output->width * (size_t)output->channels * value_size(output->depth);
  memcpy(writer->name, output->name, size);
  return writer;
}

static celspan_status begin(cs_picture_writer *writer, const cs_picture_output *output,
                            cs_picture_failure *failure) {
  const char *texts[4 + CS_PICTURE_CHANNELS] = {output->name, output->format, output->colour,
                                                output->title};
  size_t name_count = output->names ? (size_t)output->channels : 0;
  for (size_t i = 0; i < name_count; i++)
    texts[4 + i] = output->names[i];
  cs_message message = {.kind = CS_MESSAGE_WRITE,
                        .output = {.width = output->width,
                                   .height = output->height,
                                   .channels = output->channels,
                                   .depth = (int32_t)output->depth,
                                   .bits = output->bits,
                                   .is_straight = output->is_straight,
                                   .frame = output->frame,
                                   .has_primaries = output->has_primaries,
                                   .has_title = output->title != NULL,
                                   .has_names = output->names != NULL,
                                   .frames_second = output->frames_second,
                                   .moving = output->moving}};
  memcpy(message.output.software, output->software, sizeof message.output.software);
  memcpy(message.output.primaries, output->primaries, sizeof message.output.primaries);
  if (!cs_worker_put_texts(writer->worker, texts, 4 + name_count))
    return cs_worker_fail(failure, CELSPAN_OUTPUT, writer->name, "its title is too long");
  return ask(writer, &message, failure);
}

static celspan_status open_writer(const cs_picture_output *output, cs_picture_writer **out,
                                  cs_picture_failure *failure) {
  cs_picture_failure reason;
  cs_picture_writer *writer = create(output);
  if (!writer)
    return cs_worker_fail(failure, CELSPAN_NO_MEMORY, output->name, "out of memory");
  celspan_status status = cs_worker_take(CS_WORKER_WRITES, false, &writer->worker, &reason);
  if (status != CELSPAN_OK) {
    free(writer);
    return cs_worker_fail(failure, status, output->name, reason.text);
  }
  status = begin(writer, output, failure);
  return CS_GIVE(status, writer, destroy, out);
}

static celspan_status write_rows(cs_picture_writer *writer, int32_t y, int32_t count,
                                 const void *rows, cs_picture_failure *failure) {
  int32_t most = (int32_t)(CS_SHARED_PUT / writer->row); /* the widest row of seven floats fits */
  celspan_status status = CELSPAN_OK;
  for (int32_t done = 0; done < count && status == CELSPAN_OK; done += most) {
    int32_t part = count - done < most ? count - done : most;
    cs_message message = {.kind = CS_MESSAGE_ROWS, .rows = {y + done, part}};
    memcpy(writer->worker->shared, (const char *)rows + (size_t)done * writer->row,
           (size_t)part * writer->row);
    status = ask(writer, &message, failure);
  }
  return status;
}

static celspan_status complete_writer(cs_picture_writer *writer, cs_picture_failure *failure) {
  cs_message message = {.kind = CS_MESSAGE_COMPLETE};
  celspan_status status = ask(writer, &message, failure);
  destroy(writer);
  return status;
}

/* Ends the process without letting the library finish its work. */
static void abandon_writer(cs_picture_writer *writer) {
  if (writer->worker->socket >= 0)
    cs_worker_end(writer->worker);
  destroy(writer);
}

/* ---------------------------------------------------------------- colour profiles */

/* The caller has locked the worker. */
static celspan_status ask_for_table(cs_worker *worker, const cs_colour_request *request,
                                    cs_colour_table *out, cs_picture_failure *failure) {
  cs_message message = {.kind = CS_MESSAGE_PROFILE,
                        .profile = {.size = request->bytes ? request->size : 0,
                                    .power = request->power,
                                    .has_places = request->has_places}};
  memcpy(message.profile.places, request->places, sizeof request->places);
  if (request->bytes)
    memcpy(worker->shared, request->bytes, request->size);
  cs_worker_outcome outcome = CS_WORKER_DIED;
  if (worker->socket >= 0)
    outcome = cs_worker_ask(worker, &(cs_worker_request){&message, -1, NULL, NULL});
  if (outcome != CS_WORKER_ANSWERED || message.status != CELSPAN_OK)
    return cs_worker_explain(worker, outcome, CELSPAN_INPUT, failure);
  memcpy(out, worker->shared + CS_SHARED_PUT, sizeof *out);
  return CELSPAN_OK;
}

static celspan_status sample_profile(const cs_colour_request *request, cs_colour_table *out,
                                     cs_picture_failure *failure) {
  cs_worker *worker;
  celspan_status status = cs_worker_take(CS_WORKER_SAMPLES, false, &worker, failure);
  if (status != CELSPAN_OK)
    return status;
  cs_worker_lock(worker);
  status = ask_for_table(worker, request, out, failure);
  cs_worker_unlock(worker);
  cs_worker_leave(worker);
  return status;
}

/* ---------------------------------------------------------------- the modules */

static const cs_picture_module module = {.version = CS_PICTURE_MODULE_VERSION,
                                         .open = cs_reader_open,
                                         .read = cs_reader_read,
                                         .close = cs_reader_close,
                                         .list = cs_reader_list,
                                         .write_open = open_writer,
                                         .write_rows = write_rows,
                                         .write_close = complete_writer,
                                         .write_abandon = abandon_writer};

static const cs_colour_module colour_module = {CS_COLOUR_MODULE_VERSION, sample_profile};

void cs_isolate_begin(celspan_context *context, const cs_worker_limits *limits) {
  cs_worker_limit(limits, cs_context_workers(context, 0, CS_WORKERS_MOST));
  context->picture_module = &module;
  context->colour_module = &colour_module;
}

void cs_isolate_finish(void) { cs_worker_finish(); }
