#include "cli/names.h"

#include <inttypes.h>
#include <stdio.h>

static cs_name *find(const cs_names *names, cs_hash key) {
  for (size_t i = 0; i < names->count; i++)
    if (names->names[i].key.a == key.a && names->names[i].key.b == key.b)
      return &names->names[i];
  return NULL;
}

static celspan_status add(cs_names *names, const char *kind, cs_mark mark, int64_t frame) {
  if (!mark.name)
    return CELSPAN_OK;
  cs_hash key = cs_hash_begin((uint64_t)kind[0]);
  cs_hash_text(&key, cs_mark_name(mark));
  key = cs_hash_end(key);
  cs_name *name = find(names, key);
  if (!name && names->count == CS_NAMES_MOST) {
    names->has_more = true;
    return CELSPAN_OK;
  }
  if (!name) {
    CS_TRY(cs_mem_reserve(names->context, (void **)&names->names, &names->capacity,
                          names->count + 1, sizeof *names->names));
    name = &names->names[names->count++];
    *name = (cs_name){.key = key, .kind = kind, .mark = cs_mark_keep(mark)};
  }
  if (name->frames == 0 || name->last_frame != frame)
    name->frames++;
  name->last_frame = frame;
  return CELSPAN_OK;
}

static celspan_status add_rostrum(cs_names *names, const celspan_rostrum *rostrum, int64_t frame);

/* Recursion ends: nesting is at most CS_SCENE_DEPTH. */
static celspan_status add_objects(cs_names *names, celspan_object *const *objects, size_t count,
                                  int64_t frame) {
  for (size_t i = 0; i < count; i++) {
    const cs_primitive_data *data = objects[i]->data;
    CS_TRY(add(names, "object", objects[i]->mark, frame));
    if (data->texture)
      CS_TRY(add(names, "texture", data->texture->mark, frame));
    if (data->kind == CS_PRIMITIVE_DATA_ROSTRUM)
      CS_TRY(add_rostrum(names, data->rostrum, frame));
    else if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
      CS_TRY(add_objects(names, data->boolean->operands, data->boolean->operand_count, frame));
  }
  return CELSPAN_OK;
}

static celspan_status add_rostrum(cs_names *names, const celspan_rostrum *rostrum, int64_t frame) {
  CS_TRY(add(names, "rostrum", rostrum->mark, frame));
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    const celspan_cel *cel = rostrum->cels[i];
    CS_TRY(add(names, "cel", cel->mark, frame));
    CS_TRY(add_objects(names, cel->objects, cel->object_count, frame));
  }
  return CELSPAN_OK;
}

celspan_status cs_names_add(cs_names *names, const celspan_exposure *exposures, size_t count,
                            int64_t frame) {
  for (size_t e = 0; e < count; e++)
    CS_TRY(add_rostrum(names, exposures[e].rostrum, frame));
  return CELSPAN_OK;
}

void cs_names_print(const cs_names *names) {
  for (size_t i = 0; i < names->count; i++) {
    const cs_name *name = &names->names[i];
    celspan_origin origin = cs_mark_origin(name->mark);
    printf("named %s %" PRId64 " %s", name->kind, name->frames, cs_mark_name(name->mark));
    if (origin.line > 0)
      printf(" (%s:%d)", origin.source, (int)origin.line);
    printf("\n");
  }
  if (names->has_more)
    printf("named more\n");
}

void cs_names_finish(cs_names *names) {
  for (size_t i = 0; i < names->count; i++)
    cs_mark_drop(names->names[i].mark);
  cs_mem_free(names->context->memory, names->names, names->capacity * sizeof *names->names);
  *names = (cs_names){.context = names->context};
}
