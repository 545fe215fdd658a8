#include "lua/bind/names.h"

#include <lauxlib.h>
#include <stdlib.h>
#include <string.h>

#include "lua/bind/require.h"
#include "lua/bind/suggest.h"

/* Functions of celspan that are written in Lua; each is loaded at its first use. And modules whose
 * names scripts do not use for things of their own: these have no function here. */
typedef struct known {
  const char *name, *module, *function;
} known;
static const known rows[] = {{"read", "celspan.files", "text"},
                             {"parameters", "celspan.parameters", "declare"},
                             {"row", "celspan.layout", "row"},
                             {"column", "celspan.layout", "column"},
                             {"grid", "celspan.layout", "grid"},
                             {"align", "celspan.layout", "align"},
                             {"around", "celspan.layout", "around"},
                             {"letters", "celspan.layout", "letters"},
                             {"fit", "celspan.layout", "fit"},
                             {"count", "celspan.count", "written"},
                             {"morph", "celspan.morph", "between"},
                             {"brush", "celspan.brush", "line"},
                             {"echo", "celspan.echo", "trail"},
                             {"timecode", "celspan.count", "timecode"},
                             {"footage", "celspan.footage", "open"},
                             {"trim", "celspan.operators", "trim"},
                             {"round_corners", "celspan.operators", "round_corners"},
                             {"zigzag", "celspan.operators", "zigzag"},
                             {"pucker", "celspan.operators", "pucker"},
                             {"twist", "celspan.operators", "twist"},
                             {"offset", "celspan.operators", "offset"},
                             {"repeater", "celspan.repeater", "copies"},
                             {"star", "celspan.star", "outline"},
                             {"merge", "celspan.merge", "merged"},
                             {"composite", "celspan.composite", "of"},
                             {"dissolve", "celspan.dissolve", "by_chance"},
                             {"chart", "celspan.chart", NULL},
                             {"color", "celspan.colour", NULL},
                             {"colour", "celspan.colour", NULL},
                             {"cut", "celspan.cut", NULL},
                             {"ease", "celspan.ease", NULL},
                             {"keys", "celspan.keys", NULL},
                             {"lips", "celspan.lips", NULL},
                             {"motion", "celspan.motion", NULL},
                             {"multiplane", "celspan.multiplane", NULL},
                             {"particles", "celspan.particles", NULL},
                             {"puppet", "celspan.puppet", NULL},
                             {"shutter", "celspan.shutter", NULL},
                             {"svg", "celspan.svg", NULL},
                             {"typewriter", "celspan.typewriter", NULL}};

#define ROWS (sizeof rows / sizeof *rows)

static const known *find_row(const char *name) {
  for (size_t i = 0; i < ROWS; i++)
    if (rows[i].name[0] == name[0] && strcmp(rows[i].name, name) == 0)
      return &rows[i];
  return NULL;
}

/* ---------------------------------------------------------------- values */

bool cs_names_push_written(lua_State *L, int module, const char *name) {
  const known *row = find_row(name);
  if (!row || !row->function)
    return false;
  cs_require_module(L, row->module);
  lua_getfield(L, -1, row->function);
  lua_remove(L, -2);
  lua_pushvalue(L, -1);
  lua_setfield(L, module, name);
  return true;
}

/* Pushes what the table of a module has by this name, which may be nil. */
static bool push_field(lua_State *L, int module, const char *name) {
  lua_pushstring(L, name[0] == '_' ? "" : name);
  return lua_rawget(L, module) != LUA_TNIL;
}

bool cs_names_push(lua_State *L, const char *name) {
  const known *row = find_row(name);
  bool is_module = row && !row->function;
  int place = lua_gettop(L) + 1;
  if (is_module)
    cs_require_module(L, row->module);
  else
    cs_require_public(L, "celspan");
  if (is_module || strcmp(name, "celspan") == 0)
    return true;
  bool is_there = push_field(L, place, name) || cs_names_push_written(L, place, name);
  if (is_there)
    lua_replace(L, place);
  lua_settop(L, is_there ? place : place - 1);
  return is_there;
}

bool cs_names_has(lua_State *L, int module, const char *name) {
  bool is_there = push_field(L, module, name) || find_row(name);
  lua_pop(L, 1);
  return is_there;
}

/* ---------------------------------------------------------------- lists */

/* Lists of names have room for CS_NAMES_MOST. */

static size_t add_rows(const char **names, size_t count, bool are_modules) {
  for (size_t i = 0; i < ROWS; i++)
    if (are_modules == !rows[i].function)
      names[count++] = rows[i].name;
  return count;
}

/* Adds the names in a table, which keeps them alive. */
static size_t add_keys(lua_State *L, int table, const char **names, size_t count) {
  lua_pushnil(L);
  for (; count < CS_NAMES_MOST && lua_next(L, table); lua_pop(L, 1))
    if (lua_type(L, -2) == LUA_TSTRING)
      names[count++] = lua_tostring(L, -2);
  return count;
}

static int compare(const void *a, const void *b) {
  return strcmp(*(const char *const *)a, *(const char *const *)b);
}

size_t cs_names_list(lua_State *L, int module, const char **out) {
  size_t count = add_keys(L, module, out, add_rows(out, 0, false));
  qsort(out, count, sizeof *out, compare);
  return count;
}

int cs_names_all(lua_State *L) {
  const char *names[CS_NAMES_MOST];
  lua_Integer listed = 0;
  lua_settop(L, 0);
  cs_require_public(L, "celspan");
  size_t count = add_keys(L, 1, names, add_rows(names, add_rows(names, 0, false), true));
  qsort(names, count, sizeof *names, compare);
  lua_createtable(L, (int)count, 0);
  lua_newtable(L);
  for (size_t i = 0; i < count; i++) {
    const known *row = find_row(names[i]);
    if (names[i][0] == '_' || (i > 0 && strcmp(names[i], names[i - 1]) == 0))
      continue;
    lua_pushstring(L, names[i]);
    lua_rawseti(L, 2, ++listed);
    lua_pushstring(L, row && !row->function ? row->module : NULL);
    lua_setfield(L, 3, names[i]);
  }
  return 2;
}

/* ---------------------------------------------------------------- messages */

/* name -> celspan[name] */
static int read_name(lua_State *L) {
  cs_require_public(L, "celspan");
  lua_insert(L, 1);
  lua_gettable(L, 1);
  return 1;
}

/* Pushes the end of celspan's own message about the name, "; did you mean ..."; NULL: it has none.
 */
static const char *push_own_hint(lua_State *L, const char *name) {
  lua_pushcfunction(L, read_name);
  lua_pushstring(L, name);
  bool is_refused = lua_pcall(L, 1, 1, 0) != LUA_OK;
  const char *message = is_refused ? lua_tostring(L, -1) : NULL;
  const char *own = message ? strstr(message, "celspan has no '") : NULL;
  return own ? strchr(own, ';') : NULL;
}

/* What a frame function has, by the names under which it is looked for as a global. */
static const char *find_in_frame(const char *name) {
  static const char *const names[][2] = {
      {"f", "f"}, {"frame", "f"}, {"t", "f.time"}, {"time", "f.time"}, {"progress", "f.progress"}};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (strcmp(names[i][0], name) == 0)
      return names[i][1];
  return NULL;
}

const char *cs_names_push_hint(lua_State *L, const char *name) {
  const char *names[CS_NAMES_MOST], *in_frame = find_in_frame(name);
  if (lua_getfield(L, LUA_REGISTRYINDEX, CS_NAMES_FOUND) == LUA_TNIL)
    return "";
  if (in_frame)
    return lua_pushfstring(L, "; a frame function gets %s: write frame = function(f) ...",
                           in_frame);
  const char *hint = push_own_hint(L, name);
  if (hint)
    return hint;
  lua_pushglobaltable(L);
  size_t count = add_keys(L, lua_gettop(L), names, add_rows(names, 0, true));
  qsort(names, count, sizeof *names, compare);
  const char *nearest = cs_suggest_name(name, names, count);
  return nearest ? lua_pushfstring(L, "; did you mean '%s'?", nearest) : "";
}
