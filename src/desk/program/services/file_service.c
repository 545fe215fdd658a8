/* Files for verbs in Lua: kinds of files, folders, and writing. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/resolve.h"
#include "inside/files.h"
#include "inside/hash.h"
#include "inside/sinks.h"
#include "lua/bind/userdata.h"
#include "lua/module/artwork.h"
#include "lua/module/lua_script.h"
#include "process/journal.h"
#include "program/film/movies.h"
#include "program/film/service.h"
#include "program/outputs/outputs.h"
#include "program/report/sha256.h"
#include "writers/archive/archive.h"
#include "writers/join/join.h"
#include "writers/plane/plane.h"
#include "writers/still/span_reader.h"

/* ---------------------------------------------------------------- kinds */

/* kind(path) -> the kind of a file, by its first bytes: "folder", "archive", "psd", "svg",
 * "lottie", "files" (a pattern of numbered pictures), "span", "plane", "script" or "picture" */
static int kind(lua_State *L) {
  static const char *const artworks[] = {
      [CS_ARTWORK_FOLDER] = "folder", [CS_ARTWORK_ARCHIVE] = "archive",
      [CS_ARTWORK_PSD] = "psd",       [CS_ARTWORK_SVG] = "svg",
      [CS_ARTWORK_LOTTIE] = "lottie", [CS_ARTWORK_FILES] = "files",
  };
  const char *path = luaL_checkstring(L, 1);
  if (cs_service_session(L)->request->script && strcmp(path, "-") == 0) {
    lua_pushliteral(L, "script");
    return 1;
  }
  cs_artwork artwork = cs_artwork_of(path);
  lua_pushstring(L, artwork != CS_ARTWORK_NONE     ? artworks[artwork]
                    : cs_span_reader_accepts(path) ? "span"
                    : cs_plane_accepts(path)       ? "plane"
                    : cs_lua_script_accepts(path)  ? "script"
                                                   : "picture");
  return 1;
}

/* ---------------------------------------------------------------- contents */

/* Adds the whole file. Returns false and errno if it cannot be read. */
static bool add_file(int descriptor, cs_sha256 *sum) {
  uint8_t part[1 << 14];
  ssize_t got;
  while ((got = cs_open_read_at(descriptor, part, sizeof part, (off_t)sum->size)) > 0)
    cs_sha256_add(sum, part, (size_t)got);
  return got == 0;
}

/* sha256(path) -> the SHA-256 of a file, in hexadecimal digits, and its size; nil: it cannot be
 * read */
static int sha256(lua_State *L) {
  cs_sha256 sum;
  int descriptor = cs_open_to_read(luaL_checkstring(L, 1));
  cs_sha256_begin(&sum);
  bool is_read = descriptor >= 0 && add_file(descriptor, &sum);
  if (descriptor >= 0)
    close(descriptor);
  if (!is_read)
    return 0;
  lua_Integer size = (lua_Integer)sum.size;
  uint8_t digest[CS_SHA256_SIZE];
  char text[2 * CS_SHA256_SIZE + 1];
  cs_sha256_end(&sum, digest);
  for (size_t i = 0; i < sizeof digest; i++)
    snprintf(text + 2 * i, 3, "%02x", digest[i]);
  lua_pushstring(L, text);
  lua_pushinteger(L, size);
  return 2;
}

/* hash(text) -> 32 hexadecimal digits */
static int hash(lua_State *L) {
  size_t size;
  const char *text = luaL_checklstring(L, 1, &size);
  cs_hash sum = cs_hash_begin(size);
  cs_hash_bytes(&sum, text, size);
  cs_service_push_hash(L, cs_hash_end(sum));
  return 1;
}

/* contents(path) -> the bytes of a file, and their hash as script:shoot gives it | nothing: it
 * cannot be read */
static int contents(lua_State *L) {
  cs_file_contents found;
  int descriptor = cs_open_to_read(luaL_checkstring(L, 1));
  bool is_read = descriptor >= 0 && cs_file_contents_read(descriptor, &found);
  if (descriptor >= 0)
    close(descriptor);
  if (!is_read)
    return 0;
  lua_pushinteger(L, (lua_Integer)found.bytes);
  cs_service_push_hash(L, found.hash);
  return 2;
}

/* ---------------------------------------------------------------- journals */

/* Opens a journal with this first line; a file with another one is emptied. -1: errno has the
 * reason. */
static int open_journal(const char *path, const char *head, size_t size) {
  char found[64] = "";
  int file = cs_journal_open(path);
  ssize_t got = file < 0 ? -1 : cs_open_read_at(file, found, size, 0);
  bool is_same = got == (ssize_t)size && memcmp(found, head, size) == 0;
  bool is_good = got >= 0 && (is_same ? cs_journal_end_last(file)
                                      : ftruncate(file, 0) == 0 && cs_journal_add(file, head));
  int error = errno;
  if (!is_good && file >= 0)
    close(file);
  errno = error;
  return is_good ? file : -1;
}

static int close_journal(lua_State *L) {
  int *file = lua_touserdata(L, 1);
  if (*file > 0)
    close(*file);
  *file = 0;
  return 0;
}

/* Upvalue: the journal. (text) -> true | nil, the reason of the system */
static int add_to_journal(lua_State *L) {
  const int *file = lua_touserdata(L, lua_upvalueindex(1));
  return luaL_fileresult(L, cs_journal_add(*file, luaL_checkstring(L, 1)), NULL);
}

/* journal(path, head) -> a function that adds a text to a file, to which several processes may add;
 * its first line is the head, of at most 64 bytes | nil, the reason of the system */
static int journal(lua_State *L) {
  size_t size;
  const char *path = luaL_checkstring(L, 1), *head = luaL_checklstring(L, 2, &size);
  luaL_argcheck(L, size <= 64, 2, "too long");
  int *file = cs_userdata_push_holder(L, "celspan.program.journal", sizeof *file, close_journal);
  *file = open_journal(path, head, size);
  if (*file < 0)
    return luaL_fileresult(L, 0, NULL);
  lua_pushcclosure(L, add_to_journal, 1);
  return 1;
}

/* ---------------------------------------------------------------- folders */

/* make_folders(path): creates the folders of a file before it is written. A failure is not reported
 * here, because writing the file then fails, too. */
static int make_folders(lua_State *L) {
  lua_pushboolean(L, cs_journal_make_folders_for(luaL_checkstring(L, 1)));
  return 1;
}

static int close_folder(lua_State *L) {
  DIR **folder = lua_touserdata(L, 1);
  if (*folder)
    closedir(*folder);
  *folder = NULL;
  return 0;
}

static int fail_system(lua_State *L, const char *how) {
  luaL_pushfail(L);
  lua_pushstring(L, strerror(errno));
  lua_pushstring(L, how);
  return 3;
}

/* entries(path) -> the names in a folder, including hidden ones; false for a file; nil, the
 * system's reason, and a word: "missing" if the path does not exist, "cut" if not all names could
 * be read, otherwise "closed" */
static int entries(lua_State *L) {
  const char *path = luaL_checkstring(L, 1);
  struct stat facts;
  DIR **folder = cs_userdata_push_holder(L, "celspan.program.folder", sizeof(DIR *), close_folder);
  if (stat(path, &facts) != 0)
    return fail_system(L, errno == ENOENT ? "missing" : "closed");
  lua_pushboolean(L, false);
  if (!S_ISDIR(facts.st_mode))
    return 1;
  *folder = opendir(path);
  if (!*folder)
    return fail_system(L, "closed");
  lua_newtable(L);
  lua_Integer count = 0;
  for (struct dirent *entry; (entry = cs_open_entry(*folder));)
    if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) {
      lua_pushstring(L, entry->d_name);
      lua_rawseti(L, -2, ++count);
    }
  return errno ? fail_system(L, "cut") : 1;
}

/* resolve(path) -> the path to which it leads (common/resolve.h) | nil, message */
static int resolve(lua_State *L) {
  char *resolved = cs_resolve_path(luaL_checkstring(L, 1));
  if (!resolved)
    return luaL_fileresult(L, 0, NULL);
  lua_pushstring(L, resolved);
  free(resolved);
  return 1;
}

/* working_folder() -> its path */
static int working_folder(lua_State *L) {
  char folder[4096];
  if (getcwd(folder, sizeof folder)) {
    lua_pushstring(L, folder);
    return 1;
  }
  cs_report_error("the current folder has no name: %s", strerror(errno));
  return cs_service_end(L, CS_EXIT_INPUT);
}

/* ---------------------------------------------------------------- outputs */

/* has_number(path) -> whether the path is a pattern with a place for a number */
static int has_number(lua_State *L) {
  lua_pushboolean(L, cs_sequence_has_number(luaL_checkstring(L, 1)));
  return 1;
}

/* output(path) -> the kind of the file that the verb makes of this name if there is one frame, such
 * as "videos"; nil: the verb makes no such file */
static int output(lua_State *L) {
  const cs_request *request = cs_service_session(L)->request;
  const cs_output *row = cs_output_of(request, luaL_checkstring(L, 1), 1);
  lua_pushstring(L, row ? row->kind : NULL);
  return 1;
}

/* sweep(path): removes what killed runs have left of files of this name or pattern. */
static int sweep(lua_State *L) {
  cs_temporary_sweep(luaL_checkstring(L, 1), cs_sequence_matches);
  return 0;
}

/* refuse_render(): ends the verb if the request is wrong, as far as it can be known without the
 * film. */
static int refuse_render(lua_State *L) {
  const cs_session *session = cs_service_session(L);
  cs_service_require(L, cs_output_refuse_early(session->context, session->request));
  return 0;
}

/* refuse_target(path): ends the verb if the request cannot write a file of this name. */
static int refuse_target(lua_State *L) {
  const cs_session *session = cs_service_session(L);
  cs_service_require(
      L, cs_output_refuse(session->context, session->request, luaL_checkstring(L, 1), 1));
  return 0;
}

static celspan_status save_text(celspan_context *context, const char *path, const char *text,
                                size_t size) {
  cs_file *file;
  CS_TRY(cs_file_create(context, NULL, path, &file));
  celspan_status status = cs_file_write(file, context, text, size);
  return cs_file_end(file, context, status);
}

/* save(path, text): writes a file that appears whole or not at all; creates its folders. */
static int save(lua_State *L) {
  size_t size;
  const char *path = luaL_checkstring(L, 1), *text = luaL_checklstring(L, 2, &size);
  cs_service_try(L, save_text(cs_service_session(L)->context, path, text, size));
  return 0;
}

/* Pictures are packed already. */
static celspan_status put_member(cs_archive *archive, const char *path, const char *name,
                                 const char *bytes, size_t size) {
  return strcmp(cs_file_ending(name), "png") == 0
             ? cs_archive_put(archive, path, name, bytes, size)
             : cs_archive_pack(archive, path, name, bytes, size);
}

/* The members { name, bytes } of the list at index 2 of the stack. */
static celspan_status put_members(lua_State *L, cs_archive *archive, const char *path) {
  const lua_Integer count = (lua_Integer)lua_rawlen(L, 2);
  for (lua_Integer i = 1; i <= count; i++) {
    size_t size;
    lua_rawgeti(L, 2, i);
    lua_rawgeti(L, -1, 1);
    lua_rawgeti(L, -2, 2);
    const char *bytes = lua_tolstring(L, -1, &size); /* the list keeps it alive */
    CS_TRY(put_member(archive, path, lua_tostring(L, -2), bytes, size));
    lua_pop(L, 3);
  }
  return cs_archive_complete(archive);
}

static celspan_status save_members(lua_State *L, celspan_context *context, const char *path) {
  cs_file *file;
  CS_TRY(cs_file_create(context, NULL, path, &file));
  cs_archive archive = {.context = context, .file = file};
  celspan_status status = put_members(L, &archive, path);
  cs_archive_finish(&archive);
  return cs_file_end(file, context, status);
}

/* save_archive(path, { { name, bytes }, ... }): a zip archive of deflated members, and of pictures
 * as they are, which appears whole or not at all. */
static int save_archive(lua_State *L) {
  const char *path = luaL_checkstring(L, 1);
  luaL_checktype(L, 2, LUA_TTABLE);
  cs_service_try(L, save_members(L, cs_service_session(L)->context, path));
  return 0;
}

static bool write_whole(const char *path, const char *text, size_t size) {
  int file = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0)
    return false;
  bool is_written = write(file, text, size) == (ssize_t)size;
  return close(file) == 0 && is_written;
}

/* save_private(folder, name, text) -> the path of a new file that only this user can read, in a new
 * folder that only this user can read | nil, message */
static int save_private(lua_State *L) {
  size_t size;
  const char *folder = luaL_checkstring(L, 1), *text = luaL_checklstring(L, 3, &size);
  const char *path = lua_pushfstring(L, "%s/%s", folder, luaL_checkstring(L, 2));
  if (mkdir(folder, 0700) == 0 && write_whole(path, text, size))
    return 1;
  return luaL_fileresult(L, 0, path);
}

/* join(paths, output): strips of a frame into one picture. */
static int join(lua_State *L) {
  celspan_context *context = cs_service_session(L)->context;
  size_t count = lua_rawlen(L, 1);
  const char **paths = lua_newuserdatauv(L, (count + 1) * sizeof *paths, 0);
  for (size_t i = 0; i < count; i++) {
    lua_rawgeti(L, 1, (lua_Integer)i + 1);
    paths[i] = luaL_checkstring(L, -1); /* the list keeps it alive */
    lua_pop(L, 1);
  }
  celspan_status status = cs_join(context, paths, count, luaL_checkstring(L, 2));
  if (status == CELSPAN_BAD_ARGUMENT)
    cs_service_end(L, cs_report_usage("%s", celspan_context_error(context)));
  cs_service_try(L, status);
  return 0;
}

const luaL_Reg cs_services_files[] = {CS_SERVICE(kind),           CS_SERVICE(make_folders),
                                      CS_SERVICE(entries),        CS_SERVICE(resolve),
                                      CS_SERVICE(working_folder), CS_SERVICE(has_number),
                                      CS_SERVICE(output),         CS_SERVICE(refuse_target),
                                      CS_SERVICE(refuse_render),  CS_SERVICE(sweep),
                                      CS_SERVICE(save),           CS_SERVICE(save_archive),
                                      CS_SERVICE(save_private),   CS_SERVICE(journal),
                                      CS_SERVICE(join),           CS_SERVICE(sha256),
                                      CS_SERVICE(hash),           CS_SERVICE(contents),
                                      {"is_movie", cs_movies_is}, {NULL, NULL}};
