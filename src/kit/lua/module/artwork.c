#include "lua/module/artwork.h"
#include "lua/bind/require.h"

#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "inside/files.h"
#include "inside/films.h"

enum { HEAD = 64 };

/* The first sign after white space and a byte order mark: '<' of an XML document, '{' or '[' of
 * JSON. No script begins with these. */
static char first_sign(const char *head) {
  const char *start = strncmp(head, "\xEF\xBB\xBF", 3) == 0 ? head + 3 : head;
  return start[strspn(start, " \t\r\n")];
}

/* Whether an archive is a dotLottie file. Those of paintings begin with the member `mimetype`. */
static bool is_lottie(const char *head, const char *path) {
  enum { NAME = 30 };
  static const char mimetype[] = "mimetype";
  const char *dot = strrchr(path, '.');
  return memcmp(head + NAME, mimetype, sizeof mimetype - 1) != 0 && dot &&
         strcasecmp(dot, ".lottie") == 0;
}

/* Whether a file is JSON by its name or its first sign. The reader says what is wrong with it. */
static bool is_json(const char *head, const char *path) {
  const char *dot = strrchr(path, '.');
  bool is_named = dot && (strcasecmp(dot, ".json") == 0 || strcasecmp(dot, ".lottie") == 0);
  return first_sign(head) == '{' || first_sign(head) == '[' ||
         (is_named && access(path, F_OK) == 0);
}

/* The start of a regular file, as a text; "" if it is not one. Returns whether it is a folder. */
static bool read_head(const char *path, char head[HEAD + 1]) {
  struct stat facts;
  head[0] = '\0';
  int descriptor = cs_open_to_read(path);
  if (descriptor < 0)
    return false;
  bool is_known = fstat(descriptor, &facts) == 0;
  if (is_known && S_ISREG(facts.st_mode)) {
    ssize_t size = read(descriptor, head, HEAD);
    head[size > 0 ? size : 0] = '\0';
  }
  close(descriptor);
  return is_known && S_ISDIR(facts.st_mode);
}

/* Whether the folder of a path exists. */
static bool has_folder(const char *path) {
  char folder[PATH_MAX];
  const char *slash = strrchr(path, '/');
  int size = slash ? snprintf(folder, sizeof folder, "%.*s/", (int)(slash - path), path) : 0;
  return size == 0 || (size > 0 && (size_t)size < sizeof folder && access(folder, F_OK) == 0);
}

static bool is_pattern(const char *path) {
  return cs_sequence_has_number(path) && access(path, F_OK) != 0 && has_folder(path);
}

cs_artwork cs_artwork_of(const char *path) {
  char head[HEAD + 1] = {0};
  if (is_pattern(path))
    return CS_ARTWORK_FILES;
  return read_head(path, head) ? CS_ARTWORK_FOLDER
         : strncmp(head, "PK\3\4", 4) == 0
             ? is_lottie(head, path) ? CS_ARTWORK_LOTTIE : CS_ARTWORK_ARCHIVE
         : strncmp(head, "8BPS", 4) == 0 ? CS_ARTWORK_PSD
         : first_sign(head) == '<'       ? CS_ARTWORK_SVG
         : is_json(head, path)           ? CS_ARTWORK_LOTTIE
                                         : CS_ARTWORK_NONE;
}

/* The script's folder is the folder of the file, so the name without a path is enough. */
void cs_artwork_push_film(lua_State *L, const char *path, cs_artwork kind) {
  const char *slash = strrchr(path, '/');
  cs_require_module(L, "celspan.artwork");
  lua_getfield(L, -1, "film");
  lua_pushstring(L, slash ? slash + 1 : path);
  lua_pushstring(L, kind == CS_ARTWORK_SVG      ? "svg"
                    : kind == CS_ARTWORK_LOTTIE ? "lottie"
                    : kind == CS_ARTWORK_FILES  ? "files"
                    : kind == CS_ARTWORK_MOVIE  ? "movie"
                                                : "painting");
  lua_getglobal(L, "print");
  lua_call(L, 3, 1);
  lua_remove(L, -2);
}
