#include "cli/decoder/writer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/decoder/decoder.h"

struct cs_picture_writer {
  bool (*put)(void *user, uint64_t offset, const void *bytes, size_t size);
  void *user;
  size_t row; /* bytes */
  cs_decoder *decoder;
  char name[]; /* of the file */
};

/* ---------------------------------------------------------------- asking */

static bool put_bytes(void *user, const cs_message *message) {
  const cs_picture_writer *writer = user;
  return message->kind == CS_MESSAGE_PUT && message->put.size <= CS_SHARED - CS_SHARED_PUT &&
         writer->put(writer->user, message->put.offset, writer->decoder->shared + CS_SHARED_PUT,
                     (size_t)message->put.size);
}

/* The decoder's outcome as the writer's. What the module says names the file. */
static celspan_status ask(cs_picture_writer *writer, cs_message *message,
                          cs_picture_failure *failure) {
  cs_picture_failure reason;
  cs_decoder_outcome outcome = CS_DECODER_DIED;
  if (writer->decoder->socket >= 0)
    outcome =
        cs_decoder_ask(writer->decoder, &(cs_decoder_request){message, -1, put_bytes, writer});
  if (outcome == CS_DECODER_ANSWERED && message->status != CELSPAN_NO_MEMORY) {
    failure->status = (celspan_status)message->status;
    snprintf(failure->text, sizeof failure->text, "%s", message->text);
    return failure->status;
  }
  celspan_status status = cs_decoder_explain(writer->decoder, outcome, CELSPAN_OUTPUT, &reason);
  return cs_decoder_fail(failure, status, writer->name, reason.text);
}

static void destroy(cs_picture_writer *writer) {
  cs_decoder_leave(writer->decoder);
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
  const char *texts[3 + CS_PICTURE_CHANNELS] = {output->name, output->format, output->title};
  size_t name_count = output->names ? (size_t)output->channels : 0;
  for (size_t i = 0; i < name_count; i++)
    texts[3 + i] = output->names[i];
  cs_message message = {.kind = CS_MESSAGE_WRITE,
                        .output = {.width = output->width,
                                   .height = output->height,
                                   .channels = output->channels,
                                   .depth = (int32_t)output->depth,
                                   .bits = output->bits,
                                   .is_straight = output->is_straight,
                                   .transfer = (int32_t)output->transfer,
                                   .frame = output->frame,
                                   .has_title = output->title != NULL,
                                   .has_names = output->names != NULL,
                                   .frames_second = output->frames_second}};
  if (!cs_decoder_put_texts(writer->decoder, texts, 3 + name_count))
    return cs_decoder_fail(failure, CELSPAN_OUTPUT, writer->name, "its title is too long");
  return ask(writer, &message, failure);
}

celspan_status cs_writer_open(const cs_picture_output *output, cs_picture_writer **out,
                              cs_picture_failure *failure) {
  cs_picture_failure reason;
  cs_picture_writer *writer = create(output);
  if (!writer)
    return cs_decoder_fail(failure, CELSPAN_NO_MEMORY, output->name, "out of memory");
  celspan_status status = cs_decoder_take(true, false, &writer->decoder, &reason);
  if (status != CELSPAN_OK) {
    free(writer);
    return cs_decoder_fail(failure, status, output->name, reason.text);
  }
  status = begin(writer, output, failure);
  if (status == CELSPAN_OK)
    *out = writer;
  else
    destroy(writer);
  return status;
}

celspan_status cs_writer_rows(cs_picture_writer *writer, int32_t y, int32_t count, const void *rows,
                              cs_picture_failure *failure) {
  int32_t most =
      (int32_t)(CS_SHARED_PUT / writer->row); /* a row of seven floats at the widest fits */
  celspan_status status = CELSPAN_OK;
  for (int32_t done = 0; done < count && status == CELSPAN_OK; done += most) {
    int32_t part = count - done < most ? count - done : most;
    cs_message message = {.kind = CS_MESSAGE_ROWS, .rows = {y + done, part}};
    memcpy(writer->decoder->shared, (const char *)rows + (size_t)done * writer->row,
           (size_t)part * writer->row);
    status = ask(writer, &message, failure);
  }
  return status;
}

celspan_status cs_writer_complete(cs_picture_writer *writer, cs_picture_failure *failure) {
  cs_message message = {.kind = CS_MESSAGE_COMPLETE};
  celspan_status status = ask(writer, &message, failure);
  destroy(writer);
  return status;
}

/* The library is not asked what it would still do: its process is ended. */
void cs_writer_abandon(cs_picture_writer *writer) {
  if (writer->decoder->socket >= 0)
    cs_decoder_end(writer->decoder);
  destroy(writer);
}
