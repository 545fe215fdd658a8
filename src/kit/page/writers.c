/* What celspan-whole.wasm has beyond celspan.wasm: films as the files of `celspan render`, SVG,
 * Lottie and planes.
 *
 *   write --> writers.lua --> svg, plane: a cs_file --> memory --commit--> save of engine.mjs
 *                 \---------> lottie.lua of the program -----------------> save
 *
 * INVARIANT: the linker replaces cs_file_create, cs_file_commit and cs_file_again by those below
 * (packaging/page/build.sh). A file that is opened while another one is written ends before it.
 */
#include <errno.h>
#include <lauxlib.h>
#include <limits.h>
#include <lualib.h>
#include <stdlib.h>
#include <string.h>

#include "inside/files.h"
#include "inside/scene.h"
#include "lua/bind/lua_error.h"
#include "lua/module/film_table.h"
#include "lua/module/visit.h"
#include "lua/nouns/lua_film.h"
#include "page/page.h"
#include "page/picture.h"
#include "writers/parcels/plot.h"
#include "writers/plane/plane.h"

enum { BEAT_STEPS = 200000 }; /* of Lua between two beats */

FROM_PAGE(beat) void cs_page_beat(double share);
FROM_PAGE(note) void cs_page_note(const char *sentence);
FROM_PAGE(save) void cs_page_save(const void *bytes, size_t size);

/* ---------------------------------------------------------------- files in memory */

static struct {
  unsigned char *bytes;
  size_t size, room;
} files[2]; /* a drawing, and a picture in it */
static int open_count;

static int open_memory(const char *path, int flags, mode_t mode) {
  (void)path, (void)flags, (void)mode;
  if (open_count == sizeof files / sizeof *files) {
    errno = EMFILE;
    return -1;
  }
  memset(&files[open_count], 0, sizeof *files);
  return INT_MAX - open_count++; /* none of files.c */
}

static ssize_t write_memory(int descriptor, const void *bytes, size_t size, off_t offset) {
  const int i = INT_MAX - descriptor;
  const size_t end = (size_t)offset + size;
  if (end > files[i].room) {
    unsigned char *all = realloc(files[i].bytes, 2 * end);
    errno = ENOMEM;
    if (!all)
      return -1;
    files[i].bytes = all, files[i].room = 2 * end;
  }
  memcpy(files[i].bytes + offset, bytes, size);
  files[i].size = end > files[i].size ? end : files[i].size;
  return (ssize_t)size;
}

static int close_memory(int descriptor) {
  open_count = INT_MAX - descriptor;
  free(files[open_count].bytes);
  return 0;
}

static int forget_name(const char *path) { return path ? 0 : -1; }

celspan_status __real_cs_file_create(celspan_context *, const cs_file_system *, const char *,
                                     cs_file **);
celspan_status __wrap_cs_file_create(celspan_context *context, const cs_file_system *system,
                                     const char *path, cs_file **out) {
  static const cs_file_system memory = {
      .open = open_memory, .pwrite = write_memory, .close = close_memory, .unlink = forget_name};
  return __real_cs_file_create(context, system ? system : &memory, path, out);
}

celspan_status __wrap_cs_file_commit(cs_file *file, celspan_context *context) {
  const char *name;
  celspan_status status = cs_file_temporary(file, context, &name); /* all of it is written then */
  if (status == CELSPAN_OK)
    cs_page_save(files[open_count - 1].bytes, files[open_count - 1].size);
  cs_file_discard(file, context);
  return status;
}

celspan_status __wrap_cs_file_again(cs_file *file, celspan_context *context,
                                    celspan_status (*take)(void *, const void *, size_t),
                                    void *user) {
  const char *name;
  CS_TRY(cs_file_temporary(file, context, &name));
  return take(user, files[open_count - 1].bytes, files[open_count - 1].size);
}

/* ---------------------------------------------------------------- for writers.lua */

static page *page_of(lua_State *L) { return lua_touserdata(L, lua_upvalueindex(1)); }

/* Raises the sentence of a failure. */
static void try(lua_State *L, celspan_status status) {
  if (status == CELSPAN_OK)
    return;
  lua_pushstring(L, celspan_context_error(page_of(L)->context));
  lua_error(L);
}

static double share; /* of the film that is done */

static celspan_status build(page *p, int64_t number) {
  share = (double)(number - p->film.first) / (double)p->film.count;
  cs_page_beat(share);
  return cs_page_frame(p, (double)number);
}

/* svg(path, width, height): of the frame that was built last */
static int svg(lua_State *L) {
  page *p = page_of(L);
  cs_plot *plot;
  cs_plot_facts facts;
  char text[CS_PLOT_SAID];
  const char *path = luaL_checkstring(L, 1);
  const cs_plot_desc desc = {.precision = CS_PLOT_PRECISION,
                             .scale = CS_PLOT_SCALE,
                             .width = (int32_t)luaL_checkinteger(L, 2),
                             .height = (int32_t)luaL_checkinteger(L, 3),
                             .title = p->film.title};
  try(L, cs_plot_begin(p->context, path, &desc, &plot));
  try(L, cs_plot_end(plot, cs_plot_add_frame(plot, &p->frame, &facts)));
  if (cs_plot_say(p->context, path, &desc, &facts, text))
    cs_page_note(text);
  return 0;
}

static celspan_status put_frames(page *p, cs_plane_film *film) {
  for (int64_t number = p->film.first; number < p->film.first + p->film.count; number++) {
    const celspan_frame_desc *frame = &p->frame;
    CS_TRY(build(p, number));
    bool is_named = !cs_scene_has_procedure(frame->exposures, frame->exposure_count);
    cs_hash scene = {0, 0};
    if (is_named)
      scene = cs_scene_hash(frame->exposures, frame->exposure_count);
    CS_TRY(cs_shoot_failure(p->context, number,
                            cs_plane_film_put(film, frame, is_named ? &scene : NULL)));
  }
  return CELSPAN_OK;
}

/* plane(path): of the film; of one frame it is a single plane */
static int plane(lua_State *L) {
  page *p = page_of(L);
  const cs_plane_film_desc desc = {.width = p->film.width,
                                   .height = p->film.height,
                                   .frames_second = p->film.count > 1 ? p->film.frames_second : 0,
                                   .depth = cs_plane_depth(CELSPAN_DEPTH_DEFAULT)};
  cs_plane_film *film;
  try(L, cs_plane_film_create(p->context, luaL_checkstring(L, 1), &desc, &film));
  celspan_status status = put_frames(p, film);
  if (status == CELSPAN_OK)
    status = cs_plane_film_commit(film);
  else
    cs_plane_film_discard(film);
  try(L, status);
  return 0;
}

/* at(number) -> the exposures of a frame, which is built */
static int at(lua_State *L) {
  page *p = page_of(L);
  try(L, build(p, luaL_checkinteger(L, 1)));
  return cs_film_table_push_frame(L, p->frame.exposures, p->frame.exposure_count);
}

/* scene() -> what names the frame that was built last; nil if a procedure draws */
static int scene(lua_State *L) {
  const page *p = page_of(L);
  return cs_film_table_push_scene(L, p->frame.exposures, p->frame.exposure_count);
}

/* png(film) -> its first frame as the bytes of a PNG, its width, its height */
static int png(lua_State *L) {
  page *p = page_of(L);
  cs_film_info film;
  cs_film_frame built;
  celspan_frame_desc desc = CELSPAN_FRAME_DESC;
  size_t size;
  cs_page_beat(share); /* the pictures of a film take long */
  cs_lua_film_read(L, 1, &film);
  desc.width = film.width;
  desc.height = film.height;
  try(L, cs_lua_film_build(L, 1, film.first, &built));
  cs_film_expose(&film, &built, &desc);
  celspan_status status = cs_picture_png(p->context, &desc, NULL, &p->png, &size);
  cs_film_frame_finish(&built);
  try(L, status);
  lua_pushlstring(L, (const char *)p->png, size);
  lua_pushinteger(L, film.width);
  lua_pushinteger(L, film.height);
  return 3;
}

/* note(sentence), save(bytes): for JavaScript */
static int note(lua_State *L) {
  cs_page_note(luaL_checkstring(L, 1));
  return 0;
}

static int save(lua_State *L) {
  size_t size;
  const char *bytes = luaL_checklstring(L, 1, &size);
  cs_page_save(bytes, size);
  return 0;
}

/* load(name) -> a file of the writers, as a function */
static int load(lua_State *L) {
  cs_built_in_load(L, cs_page_texts, "", luaL_checkstring(L, 1));
  return 1;
}

/* A worker without a sign of life would be ended. */
static void beat(lua_State *L, lua_Debug *event) {
  (void)L, (void)event;
  cs_page_beat(share);
}

/* page, path, width, height. Runs protected. */
static int run(lua_State *L) {
  static const luaL_Reg functions[] = {{"svg", svg},     {"plane", plane}, {"at", at},
                                       {"scene", scene}, {"png", png},     {"note", note},
                                       {"save", save},   {"load", load},   {NULL, NULL}};
  page *p = lua_touserdata(L, 1);
  cs_film_info film;
  lua_sethook(L, beat, LUA_MASKCOUNT, BEAT_STEPS);
  cs_built_in_load(L, cs_page_texts, "", "writers.lua");
  luaL_newlibtable(L, functions);
  lua_pushvalue(L, 1);
  luaL_setfuncs(L, functions, 1);
  lua_newtable(L);
  if (cs_visit_film(p->L, 1, &film) != CELSPAN_OK)
    return luaL_error(L, "%s", celspan_context_error(p->context));
  cs_film_table_put(L, &film);
  lua_settop(p->L, 1);
  for (int i = 2; i <= 4; i++)
    lua_pushvalue(L, i);
  lua_call(L, 5, 0);
  return 0;
}

/* path: "film.svg", of the frame that was built last, or "film.json" or "film.plane", of the film;
 * the frame is then another one. */
TO_PAGE(write) celspan_status cs_page_write(page *p, const char *path, int width, int height) {
  lua_State *L = luaL_newstate();
  if (!L)
    return celspan_context_fail(p->context, CELSPAN_NO_MEMORY, "there is no memory for a writer");
  luaL_openlibs(L);
  celspan_status status = celspan_lua_open(L, p->context);
  if (status == CELSPAN_OK) {
    lua_pushcfunction(L, run);
    lua_pushlightuserdata(L, p);
    lua_pushstring(L, path);
    lua_pushinteger(L, width);
    lua_pushinteger(L, height);
    int outcome = lua_pcall(L, 4, 0, 0);
    status = outcome == LUA_OK ? CELSPAN_OK : cs_lua_error_report(L, outcome);
  }
  lua_close(L);
  return status;
}
