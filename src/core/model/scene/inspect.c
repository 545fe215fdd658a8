#include "model/scene/inspect.h"

#include <stdio.h>
#include <string.h>

#include "base/description.h"
#include "model/pictures/store.h"
#include "model/pictures/surface.h"
#include "model/scene/check.h"
#include "model/scene/walk.h"

typedef struct listener {
  cs_inspection *inspection;
  bool (*report)(void *user, const celspan_fault *fault);
  void *user;
  size_t cel, primitive;    /* the place that the walk has reached */
  const celspan_cel *named; /* the named cel that the walk has reached */
  celspan_status first;     /* the status of the first fault */
  char sentence[CS_ERROR_SIZE];
} listener;

/* As cs_mark_describe, for the value that a fault is about. */
static cs_mark_text describe(const char *name, celspan_origin origin) {
  cs_mark_text out = {""};
  int length = 0;
  if (name && name[0])
    length = snprintf(out.text, sizeof out.text, " '%.255s'", name);
  if (origin.line > 0)
    snprintf(out.text + length, sizeof out.text - (size_t)length, " (%.255s:%d)", origin.source,
             (int)origin.line);
  return out;
}

void cs_inspect_place(const celspan_fault *fault, char out[CS_INSPECT_PLACE]) {
  cs_mark_text cel = describe(fault->cel_name, fault->cel_origin);
  cs_mark_text primitive = describe(fault->name, fault->origin);
  if (fault->cel == 0)
    snprintf(out, CS_INSPECT_PLACE, "a light of the rostrum");
  else if (fault->primitive == 0)
    snprintf(out, CS_INSPECT_PLACE, "cel %zu%s, a light", fault->cel, cel.text);
  else
    snprintf(out, CS_INSPECT_PLACE, "cel %zu%s, primitive %zu%s", fault->cel, cel.text,
             fault->primitive, primitive.text);
}

static bool is_fault(celspan_status status) {
  return status != CELSPAN_OK && status != CELSPAN_NO_MEMORY && status != CELSPAN_CANCELLED;
}

static celspan_status report(listener *to, const celspan_fault *fault) {
  char place[CS_INSPECT_PLACE];
  cs_inspect_place(fault, place);
  if (to->first == CELSPAN_OK)
    snprintf(to->sentence, sizeof to->sentence, "%.500s: %.500s", place, fault->message);
  if (to->first == CELSPAN_OK)
    to->first = fault->status;
  return to->report(to->user, fault) ? CELSPAN_OK : CELSPAN_CANCELLED;
}

static celspan_status examine(const cs_walk *walk, const cs_primitive_data *primitive,
                              const celspan_texture *texture) {
  listener *to = walk->user;
  to->primitive += primitive != NULL;
  if (!texture || !texture->variation->picture)
    return CELSPAN_OK;
  celspan_status status = cs_inspection_examine(to->inspection, texture->variation->picture);
  if (status == CELSPAN_OK && texture->variation->medium)
    status = cs_inspection_examine(to->inspection, texture->variation->medium);
  celspan_fault fault = {.status = status,
                         .message = celspan_context_error(walk->context),
                         .cel = to->cel,
                         .primitive = primitive ? to->primitive : 0,
                         .cel_name = "",
                         .name = "",
                         .cel_origin = {"", 0},
                         .origin = {"", 0}};
  if (to->named) {
    fault.cel_name = celspan_cel_name(to->named);
    fault.cel_origin = celspan_cel_origin(to->named);
  }
  if (primitive) {
    fault.name = celspan_object_name(walk->object);
    fault.origin = celspan_object_origin(walk->object);
  }
  return is_fault(status) ? report(to, &fault) : status;
}

static celspan_status examine_all(listener *to, const celspan_rostrum *rostrum) {
  cs_walk walk = {.context = to->inspection->context, .call = examine, .user = to};
  CS_TRY(cs_walk_lights(&walk, &rostrum->front, &rostrum->back));
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    to->cel = i + 1;
    to->named = rostrum->cels[i];
    to->primitive = 0;
    CS_TRY(cs_walk_cel(&walk, rostrum->cels[i]));
  }
  return CELSPAN_OK;
}

celspan_status cs_inspect_rostrum(cs_inspection *inspection, const celspan_rostrum *rostrum,
                                  bool (*call)(void *user, const celspan_fault *fault),
                                  void *user) {
  listener to = {.inspection = inspection, .report = call, .user = user, .first = CELSPAN_OK};
  celspan_status status = examine_all(&to, rostrum);
  if (status == CELSPAN_NO_MEMORY || to.first == CELSPAN_OK)
    return status;
  return cs_fail(inspection->context, to.first, "%s", to.sentence);
}

static bool report_nobody(void *user, const celspan_fault *fault) {
  (void)user, (void)fault;
  return true;
}

celspan_status celspan_rostrum_inspect(celspan_context *context, const celspan_rostrum *rostrum,
                                       const celspan_inspect_desc *desc) {
  CS_READ(context, "inspect", celspan_inspect_desc, desc);
  CS_TRY(cs_check_given(context, "inspect", "rostrum", rostrum));
  cs_inspection inspection = {
      .context = context, .is_deep = desc->is_deep, .progress = desc->progress, .user = desc->user};
  celspan_status status = cs_inspect_rostrum(
      &inspection, rostrum, desc->report ? desc->report : report_nobody, desc->user);
  cs_inspection_finish(&inspection);
  return status;
}

/* ---------------------------------------------------------------- pictures */

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
  CS_ARRAYS_FREE(inspection->context->memory, inspection, outcomes, outcomes);
}

static bool copy_text(cs_memory *memory, const char *text, char **out) {
  size_t size = strlen(text) + 1;
  char *copy = cs_mem_resize(memory, NULL, 0, size);
  if (copy)
    memcpy(copy, text, size);
  *out = copy;
  return copy != NULL;
}

/* The message of a failure is in the context, and stays there. */
static celspan_status remember(cs_inspection *inspection, const cs_picture *picture,
                               celspan_status status) {
  celspan_context *context = inspection->context;
  cs_inspection_outcome outcome = {.status = status};
  if (inspection->count == CS_INSPECTION_MOST)
    forget(inspection);
  CS_TRY(CS_ARRAY_RESERVE(context, inspection->outcomes, inspection->count + 1));
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

/* A picture that is turned upright is best read in few batches, because each batch may need the
 * whole file. A surface is never asked for more rows than blocks are made of. */
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

static celspan_status read_picture(const cs_inspection *inspection, const cs_picture *picture) {
  source from = {.surface = picture->surface};
  if (picture->tiles.size > 0) /* of its many files none is read */
    return cs_store_info(inspection->context, picture, &from.header.info);
  if (from.surface)
    cs_surface_describe(from.surface, &from.header);
  else
    CS_TRY(open_file(inspection->context, picture, &from));
  celspan_status status = CELSPAN_OK;
  if (!from.surface)
    status = cs_store_check_colours(inspection->context, picture, &from.header);
  if (status == CELSPAN_OK && inspection->is_deep)
    status = read_all(inspection, &from);
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
  celspan_status status = read_picture(inspection, picture);
  bool is_told = status != CELSPAN_NO_MEMORY && status != CELSPAN_CANCELLED;
  return is_told ? remember(inspection, picture, status) : status;
}

/* ---------------------------------------------------------------- the place of a message */

cs_blame_text cs_blame_cel(size_t number, cs_mark cel) {
  cs_blame_text out;
  snprintf(out.text, sizeof out.text, "cel %zu%s", number, cs_mark_describe(cel).text);
  return out;
}

cs_blame_text cs_blame_object(size_t number, cs_mark cel, const celspan_object *object) {
  cs_blame_text out = cs_blame_cel(number, cel);
  const cs_primitive_data *data = object->data;
  bool is_primitive =
      data->kind == CS_PRIMITIVE_DATA_OUTLINE || data->kind == CS_PRIMITIVE_DATA_SCANLINE;
  const char *noun = is_primitive ? "primitive" : "object";
  cs_mark mark = object->mark;
  if (!mark.name && data->texture && data->texture->mark.name)
    mark = data->texture->mark;
  size_t length = strlen(out.text);
  snprintf(out.text + length, sizeof out.text - length, ", %s%s", noun,
           cs_mark_describe(mark).text);
  return out;
}

/* ---------------------------------------------------------------- the picture of a failure */

static const celspan_object *find(celspan_object *const *objects, size_t count,
                                  const char *sentence);

static const celspan_object *find_in_rostrum(const celspan_rostrum *rostrum, const char *sentence) {
  const celspan_object *found = NULL;
  for (size_t i = 0; i < rostrum->cel_count && !found; i++)
    found = find(rostrum->cels[i]->objects, rostrum->cels[i]->object_count, sentence);
  return found;
}

/* picture: may be NULL. */
static bool is_about(const char *sentence, const cs_picture *picture) {
  size_t length = picture ? strlen(picture->file) : 0;
  return picture && strncmp(sentence, picture->file, length) == 0 && sentence[length] == ':';
}

/* The object that has the picture whose file name begins the sentence, in a list or at a deeper
 * level; NULL if there is none. Recursion ends: nesting is at most CS_SCENE_DEPTH. */
static const celspan_object *find(celspan_object *const *objects, size_t count,
                                  const char *sentence) {
  const celspan_object *found = NULL;
  for (size_t i = 0; i < count && !found; i++) {
    const cs_primitive_data *data = objects[i]->data;
    const cs_texture_variation *variation = data->texture ? data->texture->variation : NULL;
    if (variation &&
        (is_about(sentence, variation->picture) || is_about(sentence, variation->medium)))
      found = objects[i];
    else if (data->kind == CS_PRIMITIVE_DATA_ROSTRUM)
      found = find_in_rostrum(data->rostrum, sentence);
    else if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
      found = find(data->boolean->operands, data->boolean->operand_count, sentence);
  }
  return found;
}

static bool blame_rostrum(celspan_context *context, const celspan_rostrum *rostrum) {
  char sentence[CS_ERROR_SIZE];
  snprintf(sentence, sizeof sentence, "%s", context->error);
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    const celspan_cel *cel = rostrum->cels[i];
    const celspan_object *object = find(cel->objects, cel->object_count, sentence);
    if (!object)
      continue;
    (void)cs_fail(context, CELSPAN_INPUT, "%s: %s", cs_blame_object(i + 1, cel->mark, object).text,
                  sentence);
    return true;
  }
  return false;
}

celspan_status cs_blame_picture(celspan_context *context, const celspan_exposure *exposures,
                                size_t count, celspan_status status) {
  bool is_found = status != CELSPAN_INPUT;
  for (size_t i = 0; i < count && !is_found; i++)
    is_found = exposures[i].rostrum && blame_rostrum(context, exposures[i].rostrum);
  return status;
}
