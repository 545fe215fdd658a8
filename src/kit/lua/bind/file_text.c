/* The whole text of a file. All except regular files are refused at once, so that nobody waits for
 * a pipe to which nothing is written. */
#include <lauxlib.h>
#include <string.h>
#include <sys/stat.h>

#include "inside/files.h"
#include "lua/bind/files.h"
#include "lua/bind/host.h"
#include "lua/bind/userdata.h"

enum { PIECE = 65536 };

static void close_file(int *file) {
  if (*file >= 0)
    close(*file);
  *file = -1;
}

/* Closes a file that an error has left open. */
CS_HOLDER_FINISH(release_file, close_file)

static int fail_text(lua_State *L, const char *path, const char *reason) {
  luaL_pushfail(L);
  lua_pushfstring(L, "%s: %s", path, reason);
  return 2;
}

static int fail_length(lua_State *L, const char *path, lua_Integer most) {
  return cs_host_fail(L, cs_fail(cs_host_context(L), CELSPAN_INPUT,
                                 "%s: it has more than %lld bytes, which is the limit", path,
                                 (long long)most));
}

/* Pushes the text. size: the size of the file if it is known; files in /proc have none. */
static int read_text(lua_State *L, int file, const char *path, size_t size, lua_Integer most) {
  luaL_Buffer text;
  ssize_t got;
  size_t piece = size > 0 ? size + 1 : PIECE; /* nothing is left after a file of that size */
  lua_Integer count = 0;
  luaL_buffinitsize(L, &text, piece);
  do {
    got = cs_open_read_at(file, luaL_prepbuffsize(&text, piece), piece, (off_t)count);
    if (got < 0)
      return fail_text(L, path, strerror(errno));
    luaL_addsize(&text, (size_t)got);
    count += got;
  } while ((size_t)got == piece && count <= most);
  if (count > most)
    return fail_length(L, path, most);
  luaL_pushresult(&text);
  return 1;
}

static int read_file(lua_State *L, int file, const char *path, lua_Integer most) {
  struct stat found;
  if (file < 0 || fstat(file, &found) != 0)
    return fail_text(L, path, strerror(errno));
  if (!S_ISREG(found.st_mode))
    return fail_text(L, path, "is not a file; a text must be one");
  if (found.st_size > most)
    return fail_length(L, path, most);
  return read_text(L, file, path, (size_t)found.st_size, most);
}

/* The file is closed at once: if the garbage collector closed it, too many files could be open by
 * then. */
int cs_file_text(lua_State *L) {
  const char *path = luaL_checkstring(L, 1);
  lua_Integer most = luaL_checkinteger(L, 2);
  cs_host_admit(L, path);
  int *file = cs_userdata_push_holder(L, "celspan.file", sizeof *file, release_file);
  *file = cs_open_to_read(path);
  int results = read_file(L, *file, path, most);
  close_file(file);
  return results;
}
