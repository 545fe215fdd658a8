#include "common/made.h"

static void drop_new(celspan_context *context, celspan_cel **cels, size_t count, size_t most) {
  for (size_t i = 0; i < count; i++)
    celspan_cel_unref(cels[i]);
  cs_mem_free(context->memory, cels, most * sizeof(celspan_cel *));
}

celspan_status cs_remake(celspan_context *context, const celspan_rostrum *from, cs_remaker make,
                         void *user, celspan_rostrum **out) {
  celspan_cel **cels;
  size_t count = 0, most = from->cel_count + 1;
  celspan_status status = CELSPAN_OK;
  CS_TRY(CS_MAKE(context, cels, most));
  for (size_t i = 0; i < from->cel_count && status == CELSPAN_OK; i++) {
    status = make(user, from, i, &cels[count]);
    count += status == CELSPAN_OK && cels[count];
  }
  if (status == CELSPAN_OK)
    status = cs_rostrum_with(context, from, cels, count, out);
  drop_new(context, cels, count, most);
  return status;
}

celspan_status cs_remake_exposures(celspan_context *context, celspan_exposure *exposures,
                                   size_t count, cs_remaker make, void *user) {
  for (size_t i = 0; i < count; i++) {
    celspan_rostrum *changed;
    CS_TRY(cs_remake(context, exposures[i].rostrum, make, user, &changed));
    celspan_rostrum_unref(exposures[i].rostrum);
    exposures[i].rostrum = changed;
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- what was made */

static celspan_status add_made(cs_made *m, celspan_object *object, const celspan_matrix *matrix) {
  CS_TRY(CS_ARRAY_RESERVE(m->context, m->objects, m->count + 1));
  CS_TRY(celspan_object_transform(m->context, object, matrix, &m->objects[m->count]));
  m->count++;
  m->is_any = true;
  return CELSPAN_OK;
}

static celspan_status find_in_rostrum(cs_made *m, const celspan_rostrum *rostrum,
                                      const celspan_matrix *matrix);

/* is_all: the object around them was made by the line, so all of them count. Recursion ends:
 * nesting is at most CS_SCENE_DEPTH. */
static celspan_status find_made(cs_made *m, celspan_object *const *objects, size_t count,
                                bool is_all, const celspan_matrix *matrix) {
  for (size_t i = 0; i < count; i++) {
    const cs_primitive_data *data = objects[i]->data;
    celspan_matrix inner = celspan_matrix_then(*objects[i]->matrix, *matrix);
    if (is_all || m->is_made(m->user, objects[i]->mark))
      CS_TRY(add_made(m, objects[i], matrix));
    else if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
      CS_TRY(find_made(m, data->boolean->operands, data->boolean->operand_count, false, &inner));
    else if (data->kind == CS_PRIMITIVE_DATA_ROSTRUM)
      CS_TRY(find_in_rostrum(m, data->rostrum, &inner));
  }
  return CELSPAN_OK;
}

static celspan_status find_in_rostrum(cs_made *m, const celspan_rostrum *rostrum,
                                      const celspan_matrix *matrix) {
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    const celspan_cel *cel = rostrum->cels[i];
    celspan_matrix placed;
    CS_TRY(cs_scene_cel_matrix(m->context, rostrum, i, rostrum->width, rostrum->height, &placed));
    placed = celspan_matrix_then(placed, *matrix);
    CS_TRY(find_made(m, cel->objects, cel->object_count, m->is_made(m->user, cel->mark), &placed));
  }
  return CELSPAN_OK;
}

static void drop_objects(cs_made *m) {
  while (m->count > 0)
    celspan_object_unref(m->objects[--m->count]);
}

/* A cel at the same place with only the objects in it that were made; no cel if there are none. */
static celspan_status keep_made(void *user, const celspan_rostrum *from, size_t i,
                                celspan_cel **out) {
  cs_made *m = user;
  const celspan_cel *cel = from->cels[i];
  const celspan_matrix none = celspan_matrix_identity();
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  celspan_cel *plain = NULL;
  *out = NULL;
  if (m->is_searched && !m->is_searched(m->user, from, i))
    return CELSPAN_OK;
  celspan_status status =
      find_made(m, cel->objects, cel->object_count, m->is_made(m->user, cel->mark), &none);
  desc.objects = m->objects;
  desc.object_count = m->count;
  desc.has_viewport = cel->has_viewport;
  desc.viewport = cel->viewport;
  if (status == CELSPAN_OK && m->count > 0)
    status = celspan_cel_create(m->context, &desc, &plain);
  if (status == CELSPAN_OK && plain)
    status = celspan_cel_transform(m->context, plain, &cel->matrix, out);
  celspan_cel_unref(plain);
  drop_objects(m);
  return status;
}

celspan_status cs_made_keep(cs_made *m, celspan_exposure *exposures, size_t count) {
  celspan_status status = cs_remake_exposures(m->context, exposures, count, keep_made, m);
  CS_ARRAYS_FREE(m->context->memory, m, objects, objects);
  return status;
}
