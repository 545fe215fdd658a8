/* program.script(): the film of a script, for verbs in Lua.
 *
 *   script's state                        program's state
 *   frame function --> scene of the core --> { { rostrum, weight }, ... }
 *
 * The exposures say nothing of the size and the space of the film: program.still makes a film of
 * them for celspan's own functions, celspan.probe and celspan.pixels. What is asked of a frame's
 * scene alone is asked of the one that was built last, in scene_service.c; shooting.c writes frames
 * into files, and program/stage shows them.
 */
#include "celspan/lua.h"
#include "inside/colour.h"
#include "inside/scene.h"
#include "lua/bind/host.h"
#include "lua/bind/lua_error.h"
#include "lua/bind/named.h"
#include "lua/bind/put.h"
#include "lua/bind/require.h"
#include "lua/bind/userdata.h"
#include "lua/bind/warnings.h"
#include "lua/module/film_table.h"
#include "lua/module/native.h"
#include "lua/module/subtitles.h"
#include "process/interrupt.h"
#include "program/film/change.h"
#include "program/film/service.h"
#include "program/film/soundtrack.h"
#include "program/film/view.h"
#include "program/options/verbs.h"
#include "program/outputs/outputs.h"
#include "program/stage/stage.h"

typedef struct opened {
  cs_script script;       /* the first field, which the methods of other files take */
  cs_inspection pictures; /* the pictures that were examined */
  celspan_rostrum *held;  /* whose camera others are seen with; NULL: none. A reference */
} opened;

static int close_film(lua_State *L) {
  opened *f = lua_touserdata(L, 1);
  celspan_rostrum_unref(f->held);
  f->held = NULL;
  cs_script_close(&f->script);
  cs_inspection_finish(&f->pictures);
  return 0;
}

/* The film that is argument 1. */
static opened *self(lua_State *L) { return cs_service_opened(L); }

/* ---------------------------------------------------------------- frames */

/* Pushes the frame that was built last. */
static int push_frame(lua_State *L, const cs_film_frame *frame) {
  return cs_film_table_push_frame(L, frame->exposures, frame->count);
}

/* script:build(number): builds a frame; ends the verb if this fails. */
static int build(lua_State *L) {
  cs_service_try(L, cs_script_try(&self(L)->script, luaL_checkinteger(L, 2)));
  return 0;
}

/* Pushes true; if a frame could not be built, false, the message and the exit code. */
static int push_outcome(lua_State *L, const opened *f, celspan_status status) {
  lua_pushboolean(L, status == CELSPAN_OK);
  if (status == CELSPAN_OK)
    return 1;
  lua_pushstring(L, celspan_context_error(f->script.context));
  lua_pushinteger(L, cs_report_exit(status));
  return 3;
}

/* script:try(number) -> true | false, message, exit code */
static int try_frame(lua_State *L) {
  opened *f = self(L);
  return push_outcome(L, f, cs_script_try(&f->script, luaL_checkinteger(L, 2)));
}

/* script:at(number) -> its exposures */
static int at(lua_State *L) {
  opened *f = self(L);
  cs_service_try(L, cs_script_try(&f->script, luaL_checkinteger(L, 2)));
  return push_frame(L, &f->script.frame);
}

/* script:exposures() -> the exposures of the frame that was built last */
static int exposures(lua_State *L) { return push_frame(L, &self(L)->script.frame); }

/* script:chosen() -> the exposures of the frame of --frame, or of the first frame; and its number
 * */
static int chosen(lua_State *L) {
  opened *f = self(L);
  celspan_frame_desc desc;
  cs_service_require(L, cs_script_frame(&f->script, cs_service_session(L)->request, &desc));
  push_frame(L, &f->script.frame);
  lua_pushinteger(L, f->script.number);
  return 2;
}

CS_HOLDER_FINISH(release_numbers, cs_sequence_finish)

/* script:numbers(output or nil) -> the numbers of --frames, or of all frames; each must have its
 * own name in the output */
static int numbers(lua_State *L) {
  const cs_request *request = cs_service_session(L)->request;
  const char *output = luaL_optstring(L, 2, NULL);
  cs_sequence *list =
      cs_userdata_push_holder(L, "celspan.program.numbers", sizeof *list, release_numbers);
  cs_service_require(L, cs_output_frames(&self(L)->script, request, output, list));
  lua_createtable(L, (int)list->count, 0);
  for (size_t i = 0; i < list->count; i++) {
    lua_pushinteger(L, list->frames[i]);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  return 1;
}

/* script:view_size() -> the size of a frame in pixels under the request; ends the verb if the
 * request is not possible for this film */
static int view_size(lua_State *L) {
  const cs_film_info *info = &self(L)->script.film;
  celspan_frame_desc desc;
  cs_service_require(
      L, cs_view_frame(cs_service_session(L)->request, info->width, info->height, &desc));
  lua_pushinteger(L, desc.width);
  lua_pushinteger(L, desc.height);
  return 2;
}

/* script:refuse(words, is_whole): ends the verb if `render` would refuse these words for the film;
 * is_whole: for its size and its rate, too */
static int refuse(lua_State *L) {
  const cs_session *session = cs_service_session(L);
  const cs_script *script = &self(L)->script;
  const char **words = cs_service_push_words(L, 2) + 1;
  cs_request request;
  cs_service_require(L, cs_request_parse(cs_verb_named("render"), lua_rawlen(L, 2),
                                         (char *const *)words, &request));
  request.spaces = session->request->spaces;
  request.output = cs_output_own(&request);
  cs_service_require(L, cs_output_refuse_early(session->context, &request));
  if (lua_toboolean(L, 3))
    cs_service_require(L, cs_output_refuse_film(script, &request));
  return 0;
}

/* script:lay_onion(width, height): replaces the film by the one that --onion makes, with skins of
 * this size. */
static int lay_onion(lua_State *L) {
  const celspan_frame_desc frame = {.width = (int32_t)luaL_checkinteger(L, 2),
                                    .height = (int32_t)luaL_checkinteger(L, 3)};
  cs_service_require(L,
                     cs_change_lay_onion(&self(L)->script, cs_service_session(L)->request, &frame));
  return 0;
}

/* script:onion(number, before, after, width, height, labels): as script:try, with skins of this
 * size of that many frames before and after. labels: of the cels that they are made of, for
 * onion.lua. */
static int try_onion(lua_State *L) {
  opened *f = self(L);
  const cs_onion onion = {
      .counts = {(int32_t)luaL_checkinteger(L, 3), (int32_t)luaL_checkinteger(L, 4)},
      .width = (int32_t)luaL_checkinteger(L, 5),
      .height = (int32_t)luaL_checkinteger(L, 6),
      .labels = luaL_checkstring(L, 7)};
  return push_outcome(L, f, cs_change_try_onion(&f->script, &onion, luaL_checkinteger(L, 2)));
}

/* Pushes the captions of these seconds onto the stack of the script. Nothing is pushed if it
 * fails. */
static celspan_status push_captions(cs_script *script, const char *form, double first,
                                    double seconds) {
  if (script->film.has_captions)
    return cs_subtitles_push(script->L, CS_SCRIPT_FILM, form, first, seconds);
  lua_pushliteral(script->L, "");
  return CELSPAN_OK;
}

static double seconds_of(const cs_film_info *info) {
  return (double)info->count / info->frames_second;
}

static celspan_status read_captions(cs_script *script) {
  celspan_status status = push_captions(script, "srt", 0, seconds_of(&script->film));
  if (status == CELSPAN_OK)
    lua_pop(script->L, 1);
  return status;
}

/* script:captions(form, first, seconds) -> the captions of these seconds, without arguments of the
 * whole film, as the text of a file of the form "srt" or "webvtt"; "": there are none */
static int captions(lua_State *L) {
  cs_script *script = &self(L)->script;
  cs_service_try(L, push_captions(script, luaL_optstring(L, 2, "srt"), luaL_optnumber(L, 3, 0),
                                  luaL_optnumber(L, 4, seconds_of(&script->film))));
  lua_pushstring(L, lua_tostring(script->L, -1));
  lua_pop(script->L, 1);
  return 1;
}

/* script:check_tracks(is_silent) -> 0, or the exit code for a fault of the sound or else of the
 * captions, both of which are read; it is reported unless is_silent */
static int check_tracks(lua_State *L) {
  opened *f = self(L);
  const celspan_context *context = f->script.context;
  bool is_silent = lua_toboolean(L, 2);
  celspan_status sound = cs_soundtrack_check(&f->script, f->pictures.is_deep);
  cs_exit outcome = is_silent ? cs_report_exit(sound) : cs_report_failure(context, sound, NULL);
  celspan_status captions = read_captions(&f->script);
  if (outcome == CS_EXIT_OK && !is_silent)
    outcome = cs_report_failure(context, captions, NULL);
  lua_pushinteger(L, outcome != CS_EXIT_OK ? outcome : cs_report_exit(captions));
  return 1;
}

/* ---------------------------------------------------------------- the state of the script */

/* Runs protected. The names of a module and of a function in it, an argument and the film -> the
 * result of the function for these two */
static int ask_module(lua_State *L) {
  cs_require_module(L, lua_touserdata(L, 1));
  lua_getfield(L, -1, lua_touserdata(L, 2));
  lua_pushstring(L, lua_touserdata(L, 3));
  lua_pushvalue(L, 4);
  lua_call(L, 2, 1);
  return 1;
}

/* The same; "" if the module has not been loaded. */
static int ask_loaded_module(lua_State *L) {
  if (cs_require_is_loaded(L, lua_touserdata(L, 1)))
    return ask_module(L);
  lua_pushliteral(L, "");
  return 1;
}

static int ask_by(lua_State *L, lua_CFunction asking) {
  lua_State *script = self(L)->script.L;
  lua_pushcfunction(script, asking);
  for (int i = 2; i <= 4; i++)
    lua_pushlightuserdata(script, (void *)luaL_checkstring(L, i));
  lua_pushvalue(script, CS_SCRIPT_FILM);
  int outcome = lua_pcall(script, 4, 1, 0);
  if (outcome != LUA_OK)
    cs_service_try(L, cs_lua_error_report(script, outcome));
  size_t size;
  const char *text = lua_tolstring(script, -1, &size);
  lua_pushlstring(L, text, size);
  lua_pop(script, 1);
  return 1;
}

/* script:ask(module, what, text) -> a text: calls a function of one of celspan's modules in the
 * state of the script. */
static int ask(lua_State *L) { return ask_by(L, ask_module); }

/* script:kept(module, what, text): the same for what a private module keeps of the script; "": the
 * script does not use the module, which is not loaded for this. */
static int kept(lua_State *L) { return ask_by(L, ask_loaded_module); }

/* ---------------------------------------------------------------- pictures */

/* function, where, message, exit code. Runs protected, because the core is at work. */
static int call_with_fault(lua_State *L) {
  const celspan_fault *found = lua_touserdata(L, 2);
  char where[CS_INSPECT_PLACE];
  cs_inspect_place(found, where);
  lua_settop(L, 1);
  lua_pushstring(L, where);
  lua_pushstring(L, found->message);
  lua_pushinteger(L, cs_report_exit(found->status));
  lua_call(L, 3, 0);
  return 0;
}

static bool add_fault(void *user, const celspan_fault *found) {
  lua_State *L = user;
  lua_pushcfunction(L, call_with_fault);
  lua_pushvalue(L, 2);
  lua_pushlightuserdata(L, (void *)(size_t)found);
  bool is_added = lua_pcall(L, 2, 0, 0) == LUA_OK;
  if (!is_added)
    lua_pop(L, 1);
  return is_added && cs_interrupt_signal() == 0;
}

/* Runs protected: pushes the warnings since the last time as texts, and their number. */
static int take_warnings(lua_State *L) {
  cs_warnings_push(L);
  const int count = (int)lua_rawlen(L, 1);
  luaL_checkstack(L, count + 1, "too many warnings");
  for (int i = 1; i <= count; i++)
    lua_rawgeti(L, 1, i);
  return count;
}

/* Pushes the warnings of the script on its own stack. If the script is being stopped, there are
 * none: the verb ends with its results so far. */
static void push_warnings(lua_State *L, lua_State *script) {
  lua_pushcfunction(script, take_warnings);
  int outcome = lua_pcall(script, 0, LUA_MULTRET, 0);
  if (outcome != LUA_OK && cs_interrupt_signal() != 0)
    lua_pop(script, 1);
  else if (outcome != LUA_OK)
    cs_service_try(L, cs_lua_error_report(script, outcome));
}

/* Calls the function at index 2 for each warning of the script, in the same way as for a fault. */
static void add_warnings(lua_State *L, lua_State *script) {
  const int before = lua_gettop(script);
  push_warnings(L, script);
  for (int i = before + 1; i <= lua_gettop(script); i++) {
    lua_pushvalue(L, 2);
    lua_pushliteral(L, "");
    lua_pushstring(L, lua_tostring(script, i));
    lua_pushinteger(L, CS_EXIT_SCRIPT);
    lua_call(L, 3, 0);
  }
  lua_settop(script, before);
}

/* script:drop_warnings(): forgets the warnings of frames that were built before. */
static int drop_warnings(lua_State *L) {
  lua_State *script = self(L)->script.L;
  const int before = lua_gettop(script);
  push_warnings(L, script);
  lua_settop(script, before);
  return 0;
}

/* script:faults(add): examines the pictures, and calls add(where, message, exit code) for each that
 * cannot be read, and for each warning of the script. */
static int faults(lua_State *L) {
  opened *f = self(L);
  const cs_film_frame *frame = &f->script.frame;
  luaL_checkstack(L, 8, "too many faults");
  for (size_t i = 0; i < frame->count; i++) {
    celspan_status status =
        cs_inspect_rostrum(&f->pictures, frame->exposures[i].rostrum, add_fault, L);
    if (status == CELSPAN_NO_MEMORY)
      cs_service_try(L, status);
  }
  add_warnings(L, f->script.L);
  return 0;
}

/* ---------------------------------------------------------------- watched films */

/* script:use_camera(rostrum or nil): see stage/stage_change.c; nil: the one of hold_camera. */
static int use_camera(lua_State *L) {
  opened *f = self(L);
  const cs_userdata *by = cs_userdata_test(L, 2, &cs_kind_rostrum);
  return cs_stage_use_camera(L, &f->script, by ? by->handle : f->held);
}

/* script:hold_camera(): keeps the camera of the frame that was built last, for use_camera. */
static int hold_camera(lua_State *L) {
  opened *f = self(L);
  const cs_film_frame *frame = &f->script.frame;
  celspan_rostrum_unref(f->held);
  f->held = frame->count ? celspan_rostrum_ref(frame->exposures[0].rostrum) : NULL;
  return 0;
}

/* script:keep_callers(is_kept): see lua/bind/named.h */
static int keep_callers(lua_State *L) {
  cs_named_keep_callers(self(L)->script.L, lua_toboolean(L, 2));
  return 0;
}

/* script:silence(is_silent): whether the text that a script in the sandbox prints is hidden from
 * now on */
static int silence(lua_State *L) {
  cs_sandbox *sandbox = self(L)->script.sandbox;
  if (sandbox)
    sandbox->guard.limits.printed = lua_toboolean(L, 2) ? NULL : cs_report_printed;
  return 0;
}

/* ---------------------------------------------------------------- the film */

static int describe(lua_State *L) {
  lua_pushliteral(L, "film of a script");
  return 1;
}

static const luaL_Reg methods[] = {
    CS_SERVICE(build),        {"try", try_frame},        {"onion", try_onion},
    CS_SERVICE(at),           CS_SERVICE(chosen),        CS_SERVICE(exposures),
    CS_SERVICE(numbers),      CS_SERVICE(view_size),     CS_SERVICE(lay_onion),
    CS_SERVICE(check_tracks), CS_SERVICE(ask),           CS_SERVICE(kept),
    CS_SERVICE(faults),       CS_SERVICE(drop_warnings), CS_SERVICE(keep_callers),
    CS_SERVICE(silence),      CS_SERVICE(hold_camera),   CS_SERVICE(use_camera),
    CS_SERVICE(refuse),       CS_SERVICE(captions),      {NULL, NULL}};

static const luaL_Reg stage_methods[] = {{"files", cs_stage_files},
                                         {"draw", cs_stage_draw},
                                         {"hits", cs_stage_hits},
                                         {"alter", cs_stage_alter},
                                         {"keep_line", cs_stage_keep_line},
                                         {"costs", cs_stage_costs},
                                         {"camera", cs_stage_camera},
                                         {"sound", cs_stage_sound},
                                         {"wave", cs_stage_wave},
                                         {"tree", cs_stage_tree},
                                         {NULL, NULL}};

static int find_method(lua_State *L) {
  static const luaL_Reg *const lists[] = {methods, stage_methods, cs_methods_scene,
                                          cs_methods_shooting, NULL};
  return cs_service_find(L, lists);
}

/* Sets the methods of the film on top of the stack; each is made when it is called first. */
static void set_methods(lua_State *L) {
  static const luaL_Reg finding[] = {
      {"__index", find_method}, {"__tostring", describe}, {NULL, NULL}};
  lua_createtable(L, 0, 2);
  cs_service_add(L, finding);
  lua_setmetatable(L, -2);
}

/* script(path or nil, is_silent) -> the film of that script, or of the request's script; is_silent:
 * it was run before, and must print nothing now */
static int open_script(lua_State *L) {
  const cs_session *session = cs_service_session(L);
  const cs_request *request = session->request;
  const char *path = luaL_optstring(L, 1, request->operands[0]);
  const bool is_silent = lua_toboolean(L, 2);
  lua_createtable(L, 0, 9);
  opened *f = cs_userdata_push_holder(L, "celspan.program.script", sizeof *f, close_film);
  f->pictures.context = session->context;
  f->pictures.progress = cs_interrupt_progress;
  f->pictures.is_deep = cs_request_has(request, "--deep");
  cs_service_require(L, cs_script_open(session->context, request, path, is_silent, &f->script));
  lua_setfield(L, -2, "open");
  cs_film_table_put(L, &f->script.film);
  set_methods(L);
  return 1;
}

/* give_settings(): the scripts that this verb itself runs get the values of --set and --set-from */
static int give_settings(lua_State *L) {
  const cs_session *session = cs_service_session(L);
  luaL_requiref(L, "celspan", luaopen_celspan, 0);
  cs_service_require(L, cs_script_give_settings(session->context, session->request, L));
  return 0;
}

const luaL_Reg cs_services_script[] = {
    {"script", open_script}, CS_SERVICE(give_settings), {NULL, NULL}};
