/* Files in Lua that are built in, and their bytecode: it does what the text does, and the text is
 * loaded where it does not fit. */
#include "lua/bind/built_in.h"

#include <lualib.h>
#include <stdlib.h>
#include <string.h>

#include "program/report/verb_text.h"
#include "tests/support/check.h"

extern const cs_built_in cs_module_texts[];

enum { MOST = 1 << 20, STEPS_MOST = 10000 };

/* ---------------------------------------------------------------- the files of celspan */

typedef struct bytes {
  char *at;
  size_t size;
} bytes;

static int append(lua_State *L, const void *piece, size_t size, void *user) {
  bytes *out = user;
  (void)L;
  if (size > MOST - out->size)
    return 1;
  memcpy(out->at + out->size, piece, size);
  out->size += size;
  return 0;
}

/* Writes bytecode as compile.c does: the release of Lua and a zero before it. */
static void dump(lua_State *L, bytes *out) {
  out->size = 0;
  CHECK(append(L, lua_ident, strlen(lua_ident) + 1, out) == 0);
  CHECK(lua_dump(L, append, out, 0) == 0);
}

/* The text of a file gives the very bytes that were built in, with all lines and names. */
static void check_same(lua_State *L, const cs_built_in *text, const cs_built_in *bytecode,
                       bytes *out) {
  const size_t head = strlen(lua_ident) + 1;
  lua_Debug info;
  CHECK(bytecode->size > head && memcmp(bytecode->bytes, lua_ident, head) == 0);
  CHECK(luaL_loadbufferx(L, bytecode->bytes + head, bytecode->size - head, "", "b") == LUA_OK);
  lua_getinfo(L, ">S", &info);
  CHECK(strncmp(info.source, "@celspan/", 9) == 0);
  CHECK_TEXT(strrchr(info.source, '/') + 1, text->name);
  CHECK(luaL_loadbufferx(L, text->bytes, text->size, info.source, "t") == LUA_OK);
  dump(L, out);
  CHECK(out->size == bytecode->size && memcmp(out->at, bytecode->bytes, out->size) == 0);
  lua_settop(L, 0);
}

static int check_all(const cs_built_in *files) {
  lua_State *L = luaL_newstate();
  bytes out = {malloc(MOST), 0};
  char name[64];
  int count = 0;
  for (const cs_built_in *file = files; file->name; file++) {
    snprintf(name, sizeof name, "%sc", file->name);
    const cs_built_in *bytecode = cs_built_in_find(files, name);
    if (bytecode)
      check_same(L, file, bytecode, &out);
    count += bytecode != NULL;
  }
  free(out.at);
  lua_close(L);
  return count;
}

/* ---------------------------------------------------------------- which of both is loaded */

/* The text returns 1, and this bytecode 2, so that the result says which was loaded. */
static cs_built_in make_bytecode(lua_State *L, bytes *out) {
  CHECK(luaL_loadbufferx(L, "return 2", 8, "@celspan/base/one.lua", "t") == LUA_OK);
  dump(L, out);
  lua_settop(L, 0);
  return (cs_built_in){"one.luac", out->at, out->size};
}

static lua_Integer loaded(lua_State *L, cs_built_in bytecode) {
  const cs_built_in files[] = {{"one.lua", "return 1", 8}, bytecode, {0}};
  cs_built_in_load(L, files, "base/", "one.lua");
  lua_call(L, 0, 1);
  lua_Integer result = lua_tointeger(L, -1);
  CHECK(lua_gettop(L) == 1);
  lua_settop(L, 0);
  return result;
}

static void check_choice(lua_State *L) {
  bytes out = {malloc(MOST), 0};
  const size_t head = strlen(lua_ident) + 1;
  cs_built_in fit = make_bytecode(L, &out);
  CHECK(loaded(L, fit) == 2);
  CHECK(loaded(L, (cs_built_in){0}) == 1);
  CHECK(loaded(L, (cs_built_in){"one.luac", fit.bytes, head - 1}) == 1);
  CHECK(loaded(L, (cs_built_in){"one.luac", fit.bytes, head}) == 1);
  CHECK(loaded(L, (cs_built_in){"one.luac", fit.bytes, fit.size - 1}) == 1);
  out.at[head - 3]++; /* another release */
  CHECK(loaded(L, fit) == 1);
  out.at[head - 3]--;
  CHECK(loaded(L, fit) == 2);
  out.at[head + 4]++; /* another version of bytecode */
  CHECK(loaded(L, fit) == 1);
  free(out.at);
}

/* upvalue: the text */
static int load_one(lua_State *L) {
  const char *text = lua_tostring(L, lua_upvalueindex(1));
  const cs_built_in files[] = {{"one.lua", text, strlen(text)}, {0}};
  cs_built_in_load(L, files, "base/", "one.lua");
  return 1;
}

static void check_faults(lua_State *L) {
  lua_pushliteral(L, "local none\nreturn (");
  lua_pushcclosure(L, load_one, 1);
  CHECK(lua_pcall(L, 0, 0, 0) == LUA_ERRRUN);
  CHECK(strncmp(lua_tostring(L, -1), "celspan/base/one.lua:2: ", 24) == 0);
  lua_settop(L, 0);
  lua_pushliteral(L, "local none\nreturn none.field");
  lua_pushcclosure(L, load_one, 1);
  lua_call(L, 0, 1);
  CHECK(lua_pcall(L, 0, 0, 0) == LUA_ERRRUN);
  CHECK(strncmp(lua_tostring(L, -1), "celspan/base/one.lua:2: ", 24) == 0);
  lua_settop(L, 0);
}

static void check_globals(lua_State *L) {
  lua_pushliteral(L, "return _ENV ~= ... and require and 3");
  lua_pushcclosure(L, load_one, 1);
  lua_call(L, 0, 1);
  lua_pushglobaltable(L);
  lua_call(L, 1, 1);
  CHECK(lua_tointeger(L, -1) == 3);
  lua_settop(L, 0);
}

/* ---------------------------------------------------------------- without memory */

/* lua_Alloc; user: after how many requests for memory there is no more. */
static void *allocate(void *user, void *block, size_t old_size, size_t new_size) {
  int *left = user;
  (void)old_size;
  if (new_size == 0) {
    free(block);
    return NULL;
  }
  return (*left)-- > 0 ? realloc(block, new_size) : NULL;
}

static int load_json(lua_State *L) {
  cs_built_in_load(L, cs_module_texts, "base/", "json.lua");
  return 1;
}

/* Loads a module with this many requests for memory after the start. Returns the status. */
static int load_with(int requests) {
  int left = MOST;
  lua_State *L = lua_newstate(allocate, &left);
  luaL_openlibs(L);
  lua_pushcfunction(L, load_json);
  left = requests;
  int status = lua_pcall(L, 0, 1, 0);
  CHECK(status == LUA_ERRMEM || (status == LUA_OK && lua_isfunction(L, -1)));
  lua_close(L);
  return status;
}

static void check_memory(void) {
  int requests = 0;
  while (requests < STEPS_MOST && load_with(requests) == LUA_ERRMEM)
    requests++;
  CHECK(requests > 100 && requests < STEPS_MOST);
}

int main(void) {
  lua_State *L = luaL_newstate();
  luaL_openlibs(L);
  int modules = check_all(cs_module_texts), verbs = check_all(cs_verb_texts);
  CHECK(TEST_BYTECODE ? modules > 100 && verbs > 20 : modules + verbs == 0);
  CHECK(!cs_built_in_find(cs_module_texts, "none.lua"));
  check_choice(L);
  check_faults(L);
  check_globals(L);
  lua_close(L);
  check_memory();
  return check_done();
}
