/* Methods of script_service.c for the scene of the frame that was built last: what names it, and
 * what it has. */
#include "inside/scene.h"
#include "lua/bind/named.h"
#include "lua/module/film_table.h"
#include "program/film/script.h"
#include "program/film/service.h"

static const cs_film_frame *frame_of(lua_State *L) {
  const cs_script *script = cs_service_opened(L);
  return &script->frame;
}

/* script:scene() -> 16 bytes, equal for equal scenes; nil if a procedure draws */
static int scene(lua_State *L) {
  const cs_film_frame *frame = frame_of(L);
  return cs_film_table_push_scene(L, frame->exposures, frame->count);
}

/* script:pictures_key() -> 16 bytes, equal while the files of the pictures of the scene are as they
 * are now */
static int pictures_key(lua_State *L) {
  const cs_film_frame *frame = frame_of(L);
  cs_hash hash = cs_walk_hash_files(frame->exposures, frame->count);
  lua_pushlstring(L, (const char *)&hash, sizeof hash);
  return 1;
}

/* script:cels() -> the names of the cels that the camera sees and that have one */
static int cels(lua_State *L) {
  const cs_film_frame *frame = frame_of(L);
  lua_Integer count = 0;
  lua_newtable(L);
  for (size_t e = 0; e < frame->count; e++) {
    const celspan_rostrum *rostrum = frame->exposures[e].rostrum;
    for (size_t i = 0; i < rostrum->cel_count; i++)
      if (rostrum->cels[i]->mark.name) {
        lua_pushstring(L, cs_mark_name(rostrum->cels[i]->mark));
        lua_rawseti(L, -2, ++count);
      }
  }
  return 1;
}

/* script:counts() -> cels, primitives, pictures */
static int counts(lua_State *L) {
  const cs_film_frame *frame = frame_of(L);
  celspan_rostrum_counts all = {0, 0, 0};
  for (size_t i = 0; i < frame->count; i++) {
    celspan_rostrum_counts one;
    celspan_rostrum_count(frame->exposures[i].rostrum, &one);
    all.cels += one.cels;
    all.primitives += one.primitives;
    all.pictures += one.pictures;
  }
  lua_pushinteger(L, (lua_Integer)all.cels);
  lua_pushinteger(L, (lua_Integer)all.primitives);
  lua_pushinteger(L, (lua_Integer)all.pictures);
  return 3;
}

/* Calls the function that is argument 2 with a name, the kind of the value with this name, and the
 * place where it was made. */
static void add_name(lua_State *L, const char *kind, cs_mark mark) {
  if (!mark.name)
    return;
  celspan_origin origin = cs_mark_origin(mark);
  lua_pushvalue(L, 2);
  lua_pushstring(L, kind);
  lua_pushstring(L, cs_mark_name(mark));
  lua_pushstring(L, origin.line > 0 ? origin.source : NULL);
  lua_pushinteger(L, origin.line);
  lua_call(L, 4, 0);
}

static void add_rostrum(lua_State *L, const celspan_rostrum *rostrum);

/* Recursion ends: nesting is at most CS_SCENE_DEPTH. */
static void add_objects(lua_State *L, celspan_object *const *objects, size_t count) {
  for (size_t i = 0; i < count; i++) {
    const cs_primitive_data *data = objects[i]->data;
    add_name(L, "object", objects[i]->mark);
    if (data->texture)
      add_name(L, "texture", data->texture->mark);
    if (data->kind == CS_PRIMITIVE_DATA_ROSTRUM)
      add_rostrum(L, data->rostrum);
    else if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
      add_objects(L, data->boolean->operands, data->boolean->operand_count);
  }
}

static void add_rostrum(lua_State *L, const celspan_rostrum *rostrum) {
  add_name(L, "rostrum", rostrum->mark);
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    const celspan_cel *cel = rostrum->cels[i];
    add_name(L, "cel", cel->mark);
    add_objects(L, cel->objects, cel->object_count);
  }
}

/* script:names(add): calls add(kind, name, source or nil, line) for each value that has a name. */
static int names(lua_State *L) {
  const cs_film_frame *frame = frame_of(L);
  luaL_checkstack(L, 8, "too many names");
  for (size_t i = 0; i < frame->count; i++)
    add_rostrum(L, frame->exposures[i].rostrum);
  return 0;
}

/* script:words(number) -> the words of a text with this number (core.parts), its em, and whether
 * the value is a letter of them; nil */
static int words(lua_State *L) {
  lua_State *script = ((cs_script *)cs_service_opened(L))->L;
  cs_named_words found;
  bool is_there = cs_named_push_words(script, (uint32_t)luaL_checkinteger(L, 2), &found);
  if (is_there) {
    lua_pushlstring(L, found.text, found.size);
    lua_pushnumber(L, found.em);
    lua_pushboolean(L, found.has_letters);
  }
  lua_pop(script, 1);
  return is_there ? 3 : 0;
}

const luaL_Reg cs_methods_scene[] = {
    CS_SERVICE(scene), CS_SERVICE(pictures_key), CS_SERVICE(cels), CS_SERVICE(counts),
    CS_SERVICE(names), CS_SERVICE(words),        {NULL, NULL}};
