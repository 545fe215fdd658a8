/* The parts of a frame, for exposure sheets. */
#include <lauxlib.h>
#include <stdio.h>

#include "lua/bind/put.h"
#include "lua/module/core.h"
#include "lua/nouns/options.h"
#include "model/scene/scene.h"

enum { PLACE_SIZE = 64, PATH_SIZE = 512 };

typedef struct list {
  lua_State *L;
  int table; /* index of the list on the stack */
  lua_Integer count;
} list;

typedef struct part {
  const char *kind, *name;
  bool is_known; /* false: it holds a procedure */
  uint64_t drawing[2], placement[2];
} part;

static void set_hash(lua_State *L, const char *field, const uint64_t hash[2]) {
  lua_pushlstring(L, (const char *)hash, 2 * sizeof hash[0]);
  lua_setfield(L, -2, field);
}

static void add(list *to, const part *one) {
  lua_State *L = to->L;
  lua_createtable(L, 0, 5);
  cs_put_text(L, "kind", one->kind);
  cs_put_text(L, "name", one->name);
  set_hash(L, "drawing", one->drawing);
  set_hash(L, "placement", one->placement);
  if (!one->is_known) {
    cs_put_flag(L, "procedure", true);
  }
  lua_rawseti(L, to->table, ++to->count);
}

static void add_rostrum(list *to, const celspan_rostrum *rostrum, const char *path);

/* path: of the cel that they are in. Recursion ends: nesting is at most CS_SCENE_DEPTH. */
static void add_objects(list *to, celspan_object *const *objects, size_t count, const char *path) {
  for (size_t i = 0; i < count; i++) {
    const celspan_object *object = objects[i];
    part one = {.kind = "object", .name = cs_mark_name(object->mark)};
    if (one.name[0]) {
      one.is_known = celspan_object_hash(object, one.drawing, one.placement);
      add(to, &one);
    }
    const cs_primitive_data *data = object->data;
    if (data->kind == CS_PRIMITIVE_DATA_ROSTRUM)
      add_rostrum(to, data->rostrum, path);
    else if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
      add_objects(to, data->boolean->operands, data->boolean->operand_count, path);
  }
}

/* A cel without a name in a composition inside another is found by the path of places to it. */
static void add_cel(list *to, const celspan_cel *cel, const char *path, size_t place) {
  char own[PATH_SIZE];
  snprintf(own, sizeof own, "%s%scel %zu", path, path[0] ? "/" : "", place);
  const char *name = cs_mark_name(cel->mark);
  part one = {.kind = "cel", .name = name[0] ? name : own};
  one.is_known = celspan_cel_hash(cel, one.drawing, one.placement);
  add(to, &one);
  add_objects(to, cel->objects, cel->object_count, one.name);
}

static void add_rostrum(list *to, const celspan_rostrum *rostrum, const char *path) {
  for (size_t i = 0; i < rostrum->cel_count; i++)
    add_cel(to, rostrum->cels[i], path, i + 1);
}

int cs_parts_list(lua_State *L) {
  celspan_frame_desc desc;
  lua_settop(L, 1);
  cs_options_exposures(L, 1, "parts: argument 1", &desc);
  lua_newtable(L);
  list to = {L, lua_gettop(L), 0};
  luaL_checkstack(L, 8, "too many parts");
  for (size_t e = 0; e < desc.exposure_count; e++) {
    char path[PLACE_SIZE] = "";
    if (e > 0)
      snprintf(path, sizeof path, "exposure %zu", e + 1);
    add_rostrum(&to, desc.exposures[e].rostrum, path);
  }
  lua_settop(L, to.table);
  return 1;
}
