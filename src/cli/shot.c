/* Scripts and their frames. */
#include "cli/shot.h"

#include <lauxlib.h>
#include <lualib.h>
#include <string.h>

#include "bind/host.h"
#include "celspan/lua.h"
#include "cli/interrupt.h"
#include "cli/view.h"

static lua_State *running; /* the state that a signal interrupts */

static void raise_interrupt(lua_State *L, lua_Debug *where) {
  (void)where;
  luaL_error(L, "interrupted");
}

/* Runs in the signal handler: lua_sethook is one of the few calls that are safe there. */
static void interrupt_script(void) {
  lua_sethook(running, raise_interrupt, LUA_MASKCALL | LUA_MASKRET | LUA_MASKLINE | LUA_MASKCOUNT,
              1);
}

/* Standard output is for what was asked for: what a script prints goes to standard error. And a
 * script cannot end the program, or a render that did nothing could look like one that did all. */
static const char HOUSE_RULES[] =
    "local stderr, pack, concat, tostring = io.stderr, table.pack, table.concat, tostring\n"
    "io.output(stderr)\n"
    "function print(...)\n"
    "  local words = pack(...)\n"
    "  for i = 1, words.n do words[i] = tostring(words[i]) end\n"
    "  stderr:write(concat(words, '\\t'), '\\n')\n"
    "end\n"
    "function os.exit() error('os.exit: a script cannot end celspan; raise an error', 2) end\n";

/* light userdata: the context. Runs protected. */
static int prepare(lua_State *L) {
  luaL_openlibs(L);
  if (luaL_dostring(L, HOUSE_RULES) != LUA_OK)
    return lua_error(L);
  cs_host_open(L, lua_touserdata(L, 1));
  luaL_requiref(L, "celspan", luaopen_celspan, 0);
  return 0;
}

static cs_exit open_state(cs_shot *shot) {
  shot->L = luaL_newstate();
  if (!shot->L) {
    cs_report_error("no memory for Lua");
    return CS_EXIT_MEMORY;
  }
  lua_pushcfunction(shot->L, prepare);
  lua_pushlightuserdata(shot->L, shot->context);
  if (lua_pcall(shot->L, 1, 0, 0) == LUA_OK)
    return CS_EXIT_OK;
  cs_report_error("Lua could not be started: %s", lua_tostring(shot->L, -1));
  return CS_EXIT_INTERNAL;
}

cs_exit cs_shot_open(celspan_context *context, const cs_request *request, cs_shot *out) {
  *out = (cs_shot){.context = context};
  cs_exit outcome = open_state(out);
  if (outcome != CS_EXIT_OK)
    return outcome;
  running = out->L;
  cs_interrupt_call(interrupt_script);
  celspan_status status =
      cs_film_load(out->L, request->operands[0], (int)request->script_argument_count,
                   (const char *const *)request->script_arguments);
  if (status != CELSPAN_OK)
    return cs_report_failure(context, status, NULL);
  cs_film_read(out->L, CS_SHOT_FILM, &out->film);
  return CS_EXIT_OK;
}

void cs_shot_close(cs_shot *shot) {
  cs_interrupt_call(NULL);
  cs_film_finish_frame(&shot->frame);
  if (shot->L)
    lua_close(shot->L);
  shot->L = NULL;
}

celspan_status cs_shot_try(cs_shot *shot, int64_t number) {
  running = shot->L;
  cs_film_finish_frame(&shot->frame);
  shot->number = number;
  return cs_film_build(shot->L, CS_SHOT_FILM, number, &shot->frame);
}

cs_exit cs_shot_build(cs_shot *shot, int64_t number) {
  return cs_report_failure(shot->context, cs_shot_try(shot, number), NULL);
}

cs_exit cs_shot_frame(cs_shot *shot, const cs_request *request, celspan_frame_desc *out) {
  int64_t first = shot->film.first, last = first + shot->film.count - 1;
  int64_t number = request->frame.is_given ? request->frame.value : first;
  if (number < first || number > last)
    return cs_report_usage("--frame %lld: the film has frames %lld to %lld", (long long)number,
                           (long long)first, (long long)last);
  cs_exit outcome = cs_view_frame(request, shot->film.width, shot->film.height, out);
  if (outcome == CS_EXIT_OK)
    outcome = cs_shot_build(shot, number);
  out->exposures = shot->frame.exposures;
  out->exposure_count = shot->frame.count;
  return outcome;
}

cs_exit cs_shot_failure(const cs_shot *shot, celspan_status status) {
  char where[32];
  snprintf(where, sizeof where, "frame %lld", (long long)shot->number);
  return cs_report_failure(shot->context, status, where);
}
