#include "output/sinks/picture_file.h"

#include <stdio.h>
#include <string.h>

#include "model/pictures/store.h"

#define MOST_THREADS 16 /* an encoder has no use for more */

/* If writing the file failed, its own error is more precise than the module's. */
static celspan_status report(const cs_picture_file *file, celspan_context *context,
                             celspan_status status, const cs_picture_failure *failure) {
  if (status == CELSPAN_OK || file->put_status != CELSPAN_OK)
    return file->put_status == CELSPAN_OK ? status : file->put_status;
  return cs_fail(context, status, "%s", failure->text);
}

static bool put(void *user, uint64_t offset, const void *bytes, size_t size) {
  cs_picture_file *file = user;
  if (file->is_abandoned || file->put_status != CELSPAN_OK)
    return false;
  file->put_status = offset == cs_file_size(file->file)
                         ? cs_file_write(file->file, file->context, bytes, size)
                         : cs_file_write_at(file->file, file->context, offset, bytes, size);
  return file->put_status == CELSPAN_OK;
}

celspan_status cs_picture_file_open(celspan_context *context, const cs_picture_output *output,
                                    cs_picture_file *out) {
  cs_picture_failure failure;
  *out = (cs_picture_file){.context = context, .output = *output};
  out->output.put = put;
  out->output.user = out;
  snprintf(out->output.software, sizeof out->output.software, "%s", cs_context_maker(context));
  out->output.moving.threads = cs_context_workers(context, 0, MOST_THREADS);
  CS_TRY(cs_store_module(context, CELSPAN_OUTPUT, &out->module));
  CS_TRY(cs_file_create(context, NULL, output->name, &out->file));
  celspan_status status = out->module->write_open(&out->output, &out->writer, &failure);
  status = report(out, context, status, &failure);
  if (status != CELSPAN_OK)
    cs_picture_file_discard(out, context);
  return status;
}

celspan_status cs_picture_file_rows(cs_picture_file *file, celspan_context *context, int32_t y,
                                    int32_t count, const void *rows) {
  cs_picture_failure failure;
  file->context = context;
  return report(file, context, file->module->write_rows(file->writer, y, count, rows, &failure),
                &failure);
}

/* Some writers report success for a file that cannot be read. That of AVIF checks its files itself,
 * because the module reads none; of a film, the module reads one picture at most. */
static celspan_status check_file(const cs_picture_file *file, celspan_context *context) {
  const cs_picture_output *output = &file->output;
  if (strcmp(output->format, CS_PICTURE_AVIF) == 0 || strcmp(output->format, CS_PICTURE_WEBP) == 0)
    return CELSPAN_OK;
  cs_picture_request request = {0};
  CS_TRY(cs_file_temporary(file->file, context, &request.file));
  cs_picture_header header;
  cs_picture_failure failure;
  cs_picture_reader *reader;
  celspan_status status = file->module->open(&request, &reader, &header, &failure);
  if (status == CELSPAN_OK) {
    file->module->close(reader);
    if (header.info.width == output->width && header.info.height == output->height)
      return CELSPAN_OK;
  }
  if (status == CELSPAN_NO_MEMORY || status == CELSPAN_CANCELLED)
    return cs_fail(context, status, "%s: reading it back: %s", output->name, failure.text);
  return cs_fail(context, CELSPAN_OUTPUT,
                 "%s: what was written as %s cannot be read back, so it is not kept (%s)",
                 output->name, output->format,
                 status == CELSPAN_OK ? "its size is wrong" : failure.text);
}

static celspan_status complete(cs_picture_file *file, celspan_context *context) {
  cs_picture_failure failure;
  file->context = context;
  cs_picture_writer *writer = file->writer;
  file->writer = NULL;
  CS_TRY(report(file, context, file->module->write_close(writer, &failure), &failure));
  CS_TRY(check_file(file, context));
  cs_file *made = file->file;
  file->file = NULL;
  return cs_file_commit(made, context);
}

celspan_status cs_picture_file_close(cs_picture_file *file, celspan_context *context) {
  celspan_status status = complete(file, context);
  cs_picture_file_discard(file, context);
  return status;
}

void cs_picture_file_discard(cs_picture_file *file, celspan_context *context) {
  file->is_abandoned = true;
  if (file->writer)
    file->module->write_abandon(file->writer);
  cs_file_discard(file->file, context);
  file->writer = NULL;
  file->file = NULL;
}
