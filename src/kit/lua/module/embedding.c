/* The functions for hosts that embed Lua: celspan/lua.h.
 *
 * INVARIANT: everything that may raise errors runs protected, which is nearly every call into Lua,
 * because a call may need memory; the stack does not change.
 */
#include <lauxlib.h>

#include "celspan/lua.h"
#include "inside/description.h"
#include "lua/bind/host.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"
#include "lua/module/visit.h"
#include "lua/nouns/lua_film.h"

/* ---------------------------------------------------------------- opening */

typedef struct opening {
  celspan_context *context;
  celspan_status status;
} opening;

/* light userdata: an opening. Runs protected. */
static int open_celspan(lua_State *L) {
  opening *o = lua_touserdata(L, 1);
  cs_host_open(L, o->context);
  if (o->context && cs_host_context(L) != o->context) {
    o->status = celspan_context_fail(o->context, CELSPAN_BAD_ARGUMENT,
                                     "celspan is open in this Lua state with another context");
    return 0;
  }
  luaL_requiref(L, "celspan", luaopen_celspan, 0);
  cs_beside_open(L);
  return 0;
}

celspan_status celspan_lua_open(lua_State *L, celspan_context *context) {
  opening o = {context, CELSPAN_OK};
  if (!lua_checkstack(L, 2))
    return context ? cs_fail(context, CELSPAN_LIMIT, "Lua's stack is full") : CELSPAN_LIMIT;
  lua_pushcfunction(L, open_celspan);
  lua_pushlightuserdata(L, &o);
  if (lua_pcall(L, 1, 0, 0) == LUA_OK)
    return o.status;
  const char *message = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "no message";
  if (context)
    cs_fail(context, CELSPAN_NO_MEMORY, "celspan could not be opened: %s", message);
  lua_pop(L, 1);
  return CELSPAN_NO_MEMORY;
}

celspan_context *celspan_lua_context(lua_State *L) {
  const cs_host *host = lua_checkstack(L, 1) ? cs_host_find(L) : NULL;
  return host ? host->context : NULL;
}

/* ---------------------------------------------------------------- values */

/* value, light userdata: where the rostrum goes */
static int read_rostrum(lua_State *L) {
  const cs_userdata *value = cs_userdata_test(L, 1, &cs_kind_rostrum);
  if (!value)
    return luaL_error(L, "a rostrum is needed, got %s", cs_userdata_type(L, 1));
  *(celspan_rostrum **)lua_touserdata(L, 2) = value->handle;
  return 0;
}

celspan_rostrum *celspan_lua_rostrum(lua_State *L, int index) {
  celspan_rostrum *rostrum = NULL;
  return cs_visit(L, index, read_rostrum, &rostrum, 0) == CELSPAN_OK ? rostrum : NULL;
}

celspan_status celspan_lua_film(lua_State *L, int index, celspan_film *out) {
  cs_film_info info;
  CS_TRY(cs_visit_film(L, index, &info));
  lua_pop(L, 1);
  const celspan_film film = {.struct_size = sizeof film,
                             .width = info.width,
                             .height = info.height,
                             .frames_second = info.frames_second,
                             .first = info.first,
                             .count = info.count,
                             .title = info.title,
                             .mark_count = info.mark_count};
  return CS_RESULT(celspan_lua_context(L), "film", celspan_film, &film, out);
}

celspan_status celspan_lua_mark(lua_State *L, int index, size_t place, celspan_mark *out) {
  cs_film_info info;
  CS_TRY(cs_visit_film(L, index, &info));
  lua_pop(L, 1);
  celspan_context *context = celspan_lua_context(L);
  if (place >= info.mark_count)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "mark %zu: the film has %zu", place,
                   info.mark_count);
  const celspan_mark mark = {.struct_size = sizeof mark,
                             .name = info.marks[place].name,
                             .first = info.marks[place].frame,
                             .last = cs_film_mark_last(&info, place)};
  return CS_RESULT(context, "mark", celspan_mark, &mark, out);
}

/* ---------------------------------------------------------------- frames */

/* The frame of the film on top of the stack. */
static celspan_status build(lua_State *L, const cs_film_info *film, int64_t number,
                            celspan_frame_desc *out) {
  cs_film_frame frame;
  if (number < film->first || number > film->first + film->count - 1)
    return cs_fail(cs_host_context(L), CELSPAN_BAD_ARGUMENT,
                   "frame %lld: the film has frames %lld to %lld", (long long)number,
                   (long long)film->first, (long long)(film->first + film->count - 1));
  CS_TRY(cs_lua_film_build(L, -1, number, &frame));
  celspan_frame_desc desc = CELSPAN_FRAME_DESC;
  cs_film_expose(film, &frame, &desc);
  desc.width = film->width;
  desc.height = film->height;
  cs_description_write(&cs_celspan_frame_desc_description, &desc, out, out->struct_size);
  return CELSPAN_OK;
}

celspan_status celspan_lua_frame(lua_State *L, int index, int64_t number, celspan_frame_desc *out) {
  cs_film_info film;
  celspan_frame_desc given;
  CS_TRY(cs_description_read(celspan_lua_context(L), "frame", &cs_celspan_frame_desc_description,
                             out, &given));
  CS_TRY(cs_visit_film(L, index, &film));
  celspan_status status = build(L, &film, number, out);
  lua_pop(L, 1);
  return status;
}

void celspan_lua_frame_drop(celspan_frame_desc *frame) {
  cs_film_frame built = {.exposures = (celspan_exposure *)frame->exposures,
                         .count = frame->exposure_count};
  cs_film_frame_finish(&built);
  frame->exposures = NULL;
  frame->exposure_count = 0;
}
