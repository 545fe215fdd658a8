#include "cli/artwork_info.h"

#include <lauxlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/open.h"
#include "bind/host.h"
#include "cli/script.h"

enum { HEAD = 64 };

/* ---------------------------------------------------------------- what it is */

/* White space and a byte order mark may stand before a document of XML; no script begins so. */
static bool is_markup(const char *head) {
  const char *at = strncmp(head, "\xEF\xBB\xBF", 3) == 0 ? head + 3 : head;
  return at[strspn(at, " \t\r\n")] == '<';
}

/* The start of a regular file, as a text; "" where there is none. */
static void read_head(int descriptor, char head[HEAD + 1]) {
  ssize_t size = read(descriptor, head, HEAD);
  head[size > 0 ? size : 0] = '\0';
}

cs_artwork cs_artwork_info_kind(const char *path) {
  char head[HEAD + 1] = "";
  struct stat status;
  int descriptor = cs_open_to_read(path);
  if (descriptor < 0)
    return CS_ARTWORK_NONE;
  bool is_known = fstat(descriptor, &status) == 0;
  bool is_folder = is_known && S_ISDIR(status.st_mode);
  if (is_known && S_ISREG(status.st_mode))
    read_head(descriptor, head);
  close(descriptor);
  return is_folder                         ? CS_ARTWORK_FOLDER
         : strncmp(head, "PK\3\4", 4) == 0 ? CS_ARTWORK_ARCHIVE
         : strncmp(head, "8BPS", 4) == 0   ? CS_ARTWORK_PSD
         : is_markup(head)                 ? CS_ARTWORK_SVG
                                           : CS_ARTWORK_NONE;
}

/* ---------------------------------------------------------------- what is in it */

static const char *format_of(cs_artwork kind) {
  return kind == CS_ARTWORK_ARCHIVE  ? "format painting\n"
         : kind == CS_ARTWORK_FOLDER ? "format folder\n"
                                     : "";
}

typedef struct call {
  const char *path;
  cs_artwork kind;
} call;

/* light userdata: a call -> text, or nil and a message. Runs protected. */
static int describe(lua_State *L) {
  const call *c = lua_touserdata(L, 1);
  lua_getglobal(L, "require");
  lua_pushliteral(L, "celspan.inform");
  lua_call(L, 1, 1);
  lua_getfield(L, -1, c->kind == CS_ARTWORK_SVG ? "drawing" : "painting");
  lua_pushstring(L, c->path);
  lua_call(L, 1, 2);
  return 2;
}

/* Lua's own sentence may have come through a pcall of the library. */
static bool lacks_memory(lua_State *L, int outcome, const char *message) {
  return outcome == LUA_ERRMEM || (message && (cs_host_blame(L, message) == CELSPAN_NO_MEMORY ||
                                               strstr(message, "not enough memory")));
}

static cs_exit print(lua_State *L, const char *path, cs_artwork kind) {
  call c = {path, kind};
  lua_pushcfunction(L, describe);
  lua_pushlightuserdata(L, &c);
  int outcome = lua_pcall(L, 1, 2, 0);
  if (outcome == LUA_OK && lua_isstring(L, -2)) {
    fputs(format_of(kind), stdout);
    fputs(lua_tostring(L, -2), stdout);
    return CS_EXIT_OK;
  }
  const char *message = lua_tostring(L, -1);
  bool is_starved = lacks_memory(L, outcome, message);
  if (outcome == LUA_OK && kind == CS_ARTWORK_PSD && message && !is_starved) {
    printf("layers unread: %s\n", message); /* the picture that it is was told of */
    return CS_EXIT_OK;
  }
  cs_report_error("%s", message ? message : "no message");
  return is_starved ? CS_EXIT_MEMORY : CS_EXIT_INPUT;
}

cs_exit cs_artwork_info_print(celspan_context *context, const char *path, cs_artwork kind) {
  cs_script script;
  cs_exit outcome = cs_script_start(context, &script);
  if (outcome == CS_EXIT_OK)
    outcome = print(script.L, path, kind);
  cs_script_close(&script);
  return outcome;
}
