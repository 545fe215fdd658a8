#include "pictures/inspection.h"

#include <string.h>

#include "pictures/store.h"
#include "pictures/surface.h"

enum { BATCH_BYTES = 4 << 20, TURNED_BATCH_BYTES = 64 << 20 };

/* ---------------------------------------------------------------- outcomes */

static void forget(cs_inspection *inspection) {
  cs_memory *memory = inspection->context->memory;
  for (size_t i = 0; i < inspection->count; i++)
    if (inspection->outcomes[i].message)
      cs_mem_free(memory, inspection->outcomes[i].message,
                  strlen(inspection->outcomes[i].message) + 1);
  inspection->count = 0;
  cs_hash_table_finish(&inspection->indices, inspection->context);
  inspection->indices = (cs_hash_table){.slots = NULL};
}

void cs_inspection_finish(cs_inspection *inspection) {
  forget(inspection);
  cs_mem_free(inspection->context->memory, inspection->outcomes,
              inspection->capacity * sizeof *inspection->outcomes);
  inspection->outcomes = NULL;
  inspection->capacity = 0;
}

static bool copy_text(cs_memory *memory, const char *text, char **out) {
  size_t size = strlen(text) + 1;
  char *copy = cs_mem_resize(memory, NULL, 0, size);
  if (copy)
    memcpy(copy, text, size);
  *out = copy;
  return copy != NULL;
}

/* Of a failure the sentence is in the context, and stays there. */
static celspan_status remember(cs_inspection *inspection, const cs_picture *picture,
                               celspan_status status) {
  celspan_context *context = inspection->context;
  cs_inspection_outcome outcome = {.status = status};
  if (inspection->count == CS_INSPECTION_MOST)
    forget(inspection);
  CS_TRY(cs_mem_reserve(context, (void **)&inspection->outcomes, &inspection->capacity,
                        inspection->count + 1, sizeof *inspection->outcomes));
  if (status != CELSPAN_OK &&
      !copy_text(context->memory, celspan_context_error(context), &outcome.message))
    return cs_fail_memory(context);
  inspection->outcomes[inspection->count++] = outcome;
  CS_TRY(cs_hash_table_add(&inspection->indices, context, picture->hash, inspection->count - 1));
  return status;
}

/* ---------------------------------------------------------------- reading */

static bool goes_on(const cs_inspection *inspection, int32_t done, int32_t total) {
  return !inspection->progress || inspection->progress(inspection->user, done, total);
}

/* Where pixels come from: a surface, or the reader of a file. */
typedef struct source {
  const celspan_surface *surface; /* NULL: a file */
  const cs_picture_module *module;
  cs_picture_reader *reader;
  cs_picture_header header;
} source;

static celspan_status read_rows(celspan_context *context, const source *from, int32_t y,
                                int32_t rows, float *rgba) {
  const celspan_rectangle rectangle = {0, y, from->header.info.width, rows};
  cs_picture_failure failure;
  if (from->surface)
    return cs_surface_read(context, from->surface, &rectangle, rgba);
  celspan_status status =
      from->module->read(from->reader, 0, y, rectangle.width, rows, rgba, &failure);
  return status == CELSPAN_OK ? status : cs_fail(context, status, "%s", failure.text);
}

/* A picture that is turned upright is best read in few batches: each may need all of the file. A
 * surface is never asked for more rows than blocks are made of. */
static int32_t rows_of_batch(const source *from) {
  const cs_picture_header *header = &from->header;
  int64_t row = (int64_t)header->info.width * 4 * (int64_t)sizeof(float);
  int64_t rows = (header->is_turned ? TURNED_BATCH_BYTES : BATCH_BYTES) / row;
  if (from->surface && rows > CS_PICTURE_BLOCK)
    rows = CS_PICTURE_BLOCK;
  return rows < 1 ? 1 : rows < header->info.height ? (int32_t)rows : header->info.height;
}

static celspan_status read_all(const cs_inspection *inspection, const source *from) {
  celspan_context *context = inspection->context;
  const celspan_picture_info *info = &from->header.info;
  int32_t rows = rows_of_batch(from);
  size_t size = (size_t)info->width * (size_t)rows * 4 * sizeof(float);
  float *batch = cs_mem_resize(context->memory, NULL, 0, size);
  celspan_status status = batch ? CELSPAN_OK : cs_fail_memory(context);
  for (int32_t y = 0; y < info->height && status == CELSPAN_OK; y += rows) {
    int32_t left = info->height - y;
    status = read_rows(context, from, y, left < rows ? left : rows, batch);
    if (status == CELSPAN_OK && !goes_on(inspection, y, info->height))
      status = CELSPAN_CANCELLED;
  }
  if (batch)
    cs_mem_free(context->memory, batch, size);
  return status;
}

static celspan_status open_file(celspan_context *context, const cs_picture *picture, source *out) {
  cs_picture_request request = cs_store_request(picture);
  cs_picture_failure failure;
  CS_TRY(cs_store_module(context, CELSPAN_INPUT, &out->module));
  celspan_status status = out->module->open(&request, &out->reader, &out->header, &failure);
  return status == CELSPAN_OK ? status : cs_fail(context, status, "%s", failure.text);
}

static celspan_status examine(const cs_inspection *inspection, const cs_picture *picture) {
  source from = {.surface = picture->surface};
  if (from.surface)
    cs_surface_describe(from.surface, &from.header);
  else
    CS_TRY(open_file(inspection->context, picture, &from));
  celspan_status status = inspection->is_deep ? read_all(inspection, &from) : CELSPAN_OK;
  if (from.reader)
    from.module->close(from.reader);
  return status;
}

celspan_status cs_inspection_examine(cs_inspection *inspection, const cs_picture *picture) {
  size_t index;
  if (cs_hash_table_find(&inspection->indices, picture->hash, &index)) {
    const cs_inspection_outcome *known = &inspection->outcomes[index];
    return known->message ? cs_fail(inspection->context, known->status, "%s", known->message)
                          : CELSPAN_OK;
  }
  celspan_status status = examine(inspection, picture);
  bool is_told = status != CELSPAN_NO_MEMORY && status != CELSPAN_CANCELLED;
  return is_told ? remember(inspection, picture, status) : status;
}
