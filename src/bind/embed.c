/* Build tool: turns the Lua modules of the library into one C file.
 *
 *   embed OUT.c lua/celspan/ease.lua lua/celspan/keys.lua ...
 *
 * For each file NAME.lua it writes the source as bytes and a function luaopen_celspan_NAME, so that
 * one celspan.so serves `require "celspan.NAME"` too; cs_open_embedded puts them all into
 * package.preload. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void stop(const char *what, const char *path) {
  fprintf(stderr, "embed: %s %s\n", what, path);
  exit(1);
}

/* "lua/celspan/ease.lua" -> "ease" */
static void module_name(const char *path, char name[64]) {
  const char *slash = strrchr(path, '/');
  const char *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
  size_t length = dot ? (size_t)(dot - base) : strlen(base);
  if (length >= 64)
    stop("name too long:", path);
  memcpy(name, base, length);
  name[length] = 0;
}

static void write_bytes(FILE *out, const char *path, const char *name) {
  FILE *in = fopen(path, "rb");
  if (!in)
    stop("cannot read", path);
  fprintf(out, "static const unsigned char %s_source[] = {", name);
  long count = 0;
  for (int c; (c = getc(in)) != EOF; count++)
    fprintf(out, "%s%d,", count % 24 ? "" : "\n  ", c);
  fprintf(out, "\n};\n");
  if (ferror(in) || count == 0)
    stop("cannot read", path);
  fclose(in);
}

static void write_opener(FILE *out, const char *name) {
  fprintf(out,
          "CELSPAN_API int luaopen_celspan_%s(lua_State *L);\n"
          "int luaopen_celspan_%s(lua_State *L) {\n"
          "  return run(L, \"@celspan/%s.lua\", %s_source, sizeof %s_source);\n}\n\n",
          name, name, name, name, name);
}

static const char head[] =
    "/* Made by embed.c from lua/celspan; do not edit. */\n"
    "#include <lauxlib.h>\n\n"
    "#include \"bind/openers.h\"\n#include \"celspan/lua.h\"\n\n"
    "static int run(lua_State *L, const char *name, const unsigned char *source, size_t size) {\n"
    "  luaL_requiref(L, \"celspan\", luaopen_celspan, 0);\n"
    "  lua_pop(L, 1);\n"
    "  if (luaL_loadbufferx(L, (const char *)source, size, name, \"t\") != LUA_OK)\n"
    "    return lua_error(L);\n"
    "  lua_call(L, 0, 1);\n"
    "  return 1;\n}\n\n";

static const char tail[] = "  {\"celspan.core\", luaopen_celspan_core},\n  {NULL, NULL}};\n\n"
                           "void cs_open_embedded(lua_State *L) {\n"
                           "  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_PRELOAD_TABLE);\n"
                           "  luaL_setfuncs(L, modules, 0);\n"
                           "  lua_pop(L, 1);\n}\n";

int main(int argument_count, char **arguments) {
  if (argument_count < 2)
    stop("usage:", "embed OUT.c FILE.lua ...");
  FILE *out = fopen(arguments[1], "w");
  if (!out)
    stop("cannot write", arguments[1]);
  char name[64];
  fputs(head, out);
  for (int i = 2; i < argument_count; i++) {
    module_name(arguments[i], name);
    write_bytes(out, arguments[i], name);
    write_opener(out, name);
  }
  fputs("static const luaL_Reg modules[] = {\n", out);
  for (int i = 2; i < argument_count; i++) {
    module_name(arguments[i], name);
    fprintf(out, "  {\"celspan.%s\", luaopen_celspan_%s},\n", name, name);
  }
  fputs(tail, out);
  if (fclose(out) != 0)
    stop("cannot write", arguments[1]);
  return 0;
}
