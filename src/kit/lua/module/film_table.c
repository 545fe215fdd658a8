#include "lua/module/film_table.h"

#include <lauxlib.h>

#include "celspan/lua.h"
#include "inside/colour.h"
#include "inside/scene.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"

static void put_marks(lua_State *L, const cs_film_info *info) {
  lua_createtable(L, (int)info->mark_count, 0);
  for (size_t i = 0; i < info->mark_count; i++) {
    lua_createtable(L, 0, 2);
    cs_put_text(L, "name", info->marks[i].name);
    cs_put_integer(L, "frame", info->marks[i].frame);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  lua_setfield(L, -2, "marks");
}

void cs_film_table_put(lua_State *L, const cs_film_info *info) {
  cs_put_integer(L, "first", info->first);
  cs_put_integer(L, "poster", info->poster);
  cs_put_flag(L, "has_poster", info->has_poster);
  cs_put_integer(L, "frames", info->count);
  cs_put_number(L, "fps", info->frames_second);
  cs_put_text(L, "title", info->title);
  cs_put_flag(L, "has_sound", info->has_sound);
  cs_put_text(L, "space", cs_space_words[info->space - CELSPAN_SPACE_LINEAR]);
  cs_put_pair(L, "size", info->width, info->height);
  put_marks(L, info);
}

/* The module celspan knows the values. */
int cs_film_table_push_frame(lua_State *L, const celspan_exposure *exposures, size_t count) {
  luaL_requiref(L, "celspan", luaopen_celspan, 0);
  lua_createtable(L, (int)count, 0);
  for (size_t i = 0; i < count; i++) {
    lua_createtable(L, 2, 0);
    cs_userdata *rostrum = cs_userdata_push(L, &cs_noun_rostrum);
    lua_newtable(L);
    lua_setiuservalue(L, -2, 1);
    rostrum->handle = celspan_rostrum_ref(exposures[i].rostrum);
    lua_rawseti(L, -2, 1);
    lua_pushnumber(L, exposures[i].weight);
    lua_rawseti(L, -2, 2);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  return 1;
}

int cs_film_table_push_scene(lua_State *L, const celspan_exposure *exposures, size_t count) {
  if (cs_scene_has_procedure(exposures, count))
    return 0;
  cs_hash hash = cs_scene_hash(exposures, count);
  lua_pushlstring(L, (const char *)&hash, sizeof hash);
  return 1;
}
