/* Build tool: files in Lua as bytecode of the Lua that it is linked with, or what they print.
 *
 *   compile FOLDER CHUNK FILE ...   base/json.lua as CHUNK becomes FOLDER/json.luac
 *   compile FILE                    runs it; LUA_PATH is where it requires from
 *
 * A file begins with the release of Lua and a zero. Nothing is stripped, so that errors have the
 * same lines and names as the text.
 */
#include <lauxlib.h>
#include <lualib.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_MOST = 4096, PIECE = 4096 };

static void stop(const char *what, const char *about) {
  fprintf(stderr, "compile: %s %s\n", what, about);
  exit(1);
}

/* lua_Reader; file: a FILE */
static const char *read_piece(lua_State *L, void *file, size_t *size) {
  static char piece[PIECE];
  (void)L;
  *size = fread(piece, 1, sizeof piece, file);
  return piece;
}

/* lua_Writer; file: a FILE */
static int write_piece(lua_State *L, const void *bytes, size_t size, void *file) {
  (void)L;
  return fwrite(bytes, 1, size, file) != size;
}

static void load(lua_State *L, const char *chunk, const char *path) {
  FILE *in = fopen(path, "rb");
  if (!in)
    stop("cannot open", path);
  if (lua_load(L, read_piece, in, lua_pushfstring(L, "@celspan/%s", chunk), "t") != LUA_OK)
    stop("cannot compile", lua_tostring(L, -1));
  if (ferror(in))
    stop("cannot read", path);
  fclose(in);
}

/* Writes the function on top of the stack. */
static void dump(lua_State *L, const char *folder, const char *chunk) {
  const char *slash = strrchr(chunk, '/');
  char path[PATH_MOST];
  snprintf(path, sizeof path, "%s/%sc", folder, slash ? slash + 1 : chunk);
  FILE *out = fopen(path, "wb");
  if (!out)
    stop("cannot open", path);
  if (write_piece(L, lua_ident, strlen(lua_ident) + 1, out) || lua_dump(L, write_piece, out, 0) ||
      fclose(out) != 0)
    stop("cannot write", path);
}

static void run(lua_State *L, const char *path) {
  luaL_openlibs(L);
  if (luaL_dofile(L, path) != LUA_OK)
    stop("cannot run", lua_tostring(L, -1));
}

int main(int argument_count, char **arguments) {
  lua_State *L = luaL_newstate();
  if (!L || argument_count % 2)
    stop("usage:", "compile FOLDER CHUNK FILE ..., or compile FILE");
  if (argument_count == 2)
    run(L, arguments[1]);
  for (int i = 2; i < argument_count; i += 2) {
    load(L, arguments[i], arguments[i + 1]);
    dump(L, arguments[1], arguments[i]);
    lua_settop(L, 0);
  }
  lua_close(L);
  return 0;
}
