#include "program/film/service.h"

#include <inttypes.h>
#include <string.h>

#include "inside/context.h"
#include "lua/bind/host.h"
#include "lua/bind/suggest.h"
#include "lua/sandbox/library.h"
#include "process/interrupt.h"
#include "program/film/confine.h"
#include "program/film/script.h"
#include "program/report/verb_text.h"

/* ---------------------------------------------------------------- ends */

cs_session *cs_service_session(lua_State *L) { return lua_touserdata(L, lua_upvalueindex(1)); }

int cs_service_end(lua_State *L, cs_exit outcome) {
  cs_service_session(L)->outcome = outcome;
  return luaL_error(L, "the verb has ended");
}

void cs_service_require(lua_State *L, cs_exit outcome) {
  if (outcome != CS_EXIT_OK)
    cs_service_end(L, outcome);
}

void cs_service_try(lua_State *L, celspan_status status) {
  cs_service_require(L, cs_report_failure(cs_service_session(L)->context, status, NULL));
}

void cs_service_add(lua_State *L, const luaL_Reg *functions) {
  lua_pushlightuserdata(L, cs_service_session(L));
  luaL_setfuncs(L, functions, 1);
}

bool cs_service_find(lua_State *L, const luaL_Reg *const *lists) {
  const char *name = luaL_checkstring(L, 2);
  for (; *lists; lists++)
    for (const luaL_Reg *one = *lists; one->name; one++)
      if (one->name[0] == *name && strcmp(one->name, name) == 0) {
        lua_pushlightuserdata(L, cs_service_session(L));
        lua_pushcclosure(L, one->func, 1);
        lua_pushvalue(L, 2);
        lua_pushvalue(L, -2);
        lua_rawset(L, 1);
        return true;
      }
  return false;
}

void *cs_service_opened(lua_State *L) {
  lua_getfield(L, 1, "open");
  void *opened = lua_touserdata(L, -1);
  lua_pop(L, 1);
  return opened;
}

const char *cs_service_text(lua_State *L, const char *name) {
  lua_getfield(L, 2, name);
  const char *text = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
  lua_pop(L, 1);
  return text;
}

void cs_service_push_hash(lua_State *L, cs_hash hash) {
  char digits[33];
  snprintf(digits, sizeof digits, "%016" PRIx64 "%016" PRIx64, hash.a, hash.b);
  lua_pushstring(L, digits);
}

const char **cs_service_push_words(lua_State *L, int index) {
  luaL_checktype(L, index, LUA_TTABLE);
  size_t count = lua_rawlen(L, index);
  const char **words = lua_newuserdatauv(L, (count + 2) * sizeof *words, 0);
  words[0] = "celspan";
  for (size_t i = 1; i <= count; i++, lua_pop(L, 1)) {
    bool is_text = lua_rawgeti(L, index, (lua_Integer)i) == LUA_TSTRING;
    luaL_argcheck(L, is_text, index, "not a list of strings");
    words[i] = lua_tostring(L, -1);
  }
  words[count + 1] = NULL;
  return words;
}

/* ---------------------------------------------------------------- reports */

/* The sentence at an index, with the values after it as string.format puts them. A zero byte would
 * end it, so it is replaced in the same way as controls in report.c. */
static const char *sentence_at(lua_State *L, int index) {
  size_t size;
  luaL_checktype(L, index, LUA_TSTRING);
  lua_getfield(L, index, "format");
  lua_insert(L, index);
  lua_call(L, lua_gettop(L) - index, 1);
  const char *text = luaL_checklstring(L, index, &size);
  if (strlen(text) == size)
    return text;
  luaL_Buffer shown;
  luaL_buffinit(L, &shown);
  for (const char *at = text; at < text + size; at++)
    if (*at)
      luaL_addchar(&shown, *at);
    else
      luaL_addstring(&shown, "\\x00");
  luaL_pushresult(&shown);
  lua_replace(L, index);
  return lua_tostring(L, index);
}

/* note(sentence, ...): "celspan: ..." on standard error */
static int note(lua_State *L) {
  cs_report_note("%s", sentence_at(L, 1));
  return 0;
}

/* error(sentence, ...): "celspan: error: ..."; the verb continues. */
static int report_error(lua_State *L) {
  cs_report_error("%s", sentence_at(L, 1));
  return 0;
}

/* usage(sentence, ...): reports a wrong use and ends the verb. */
static int usage(lua_State *L) {
  return cs_service_end(L, cs_report_usage("%s", sentence_at(L, 1)));
}

/* fail(kind, sentence, ...): reports it and ends the verb. kind: "usage", "script", "input",
 * "output" or "limit". */
static int fail(lua_State *L) {
  static const char *const kinds[] = {"usage", "script", "input", "output", "limit", NULL};
  static const cs_exit codes[] = {CS_EXIT_USAGE, CS_EXIT_SCRIPT, CS_EXIT_INPUT, CS_EXIT_OUTPUT,
                                  CS_EXIT_LIMIT};
  int kind = luaL_checkoption(L, 1, NULL, kinds);
  cs_report_error("%s", sentence_at(L, 2));
  return cs_service_end(L, codes[kind]);
}

/* The exit code for a message that a function of celspan has returned. plain: the code for a
 * message that the core did not set. A library may have caught Lua's own sentence about memory. */
static cs_exit code_of(lua_State *L, const char *message, cs_exit plain) {
  celspan_status status = cs_host_blame(L, message);
  if (status == CELSPAN_NO_MEMORY || strstr(message, "not enough memory"))
    return CS_EXIT_MEMORY;
  return status == CELSPAN_CALLBACK ? plain : cs_report_exit(status);
}

/* The message that was given instead of a value. Ends the verb if it was stopped. */
static const char *given_message(lua_State *L) {
  if (cs_interrupt_signal())
    cs_service_end(L, CS_EXIT_SIGNAL);
  return luaL_checkstring(L, 2);
}

/* Similar to assert: if the arguments are nil and a message, reports the message and ends the
 * verb. */
static int check(lua_State *L) {
  if (lua_toboolean(L, 1))
    return lua_gettop(L);
  const char *message = given_message(L);
  cs_report_error("%s", message);
  return cs_service_end(L, code_of(L, message, CS_EXIT_SCRIPT));
}

/* Similar to assert, for a value that was read: a failure is a fault of the input. If there is a
 * third argument, it is returned instead, unless memory was missing. */
static int check_input(lua_State *L) {
  if (lua_toboolean(L, 1))
    return lua_gettop(L);
  const char *message = given_message(L);
  bool is_starved = code_of(L, message, CS_EXIT_INPUT) == CS_EXIT_MEMORY;
  if (lua_isstring(L, 3) && !is_starved)
    return 1;
  cs_report_error("%s", message);
  return cs_service_end(L, is_starved ? CS_EXIT_MEMORY : CS_EXIT_INPUT);
}

/* row(line, output): messages in JSON are about this row of a table; without arguments, about
 * none */
static int row(lua_State *L) {
  cs_report_row(luaL_optinteger(L, 1, 0), luaL_optstring(L, 2, ""));
  return 0;
}

/* count_frames(count, is_told, noun): the verb makes frames, or what the noun says, and reports
 * their progress if it is asked for; is_told: also if it is not. noun: "frame" or "sound" */
static int count_frames(lua_State *L) {
  static const char *const nouns[] = {"frame", "sound", NULL};
  cs_session *session = cs_service_session(L);
  cs_progress_start(&session->progress, session->request,
                    lua_toboolean(L, 2) ? CS_PROGRESS_AUTO : CS_PROGRESS_NONE,
                    (size_t)luaL_checkinteger(L, 1));
  session->progress.noun = nouns[luaL_checkoption(L, 3, "frame", nouns)];
  return 0;
}

/* made_frame(number, output, how): one of them is in this file. how: "made" unless it is given */
static int made_frame(lua_State *L) {
  cs_progress_frame(&cs_service_session(L)->progress, luaL_checkinteger(L, 1),
                    luaL_checkstring(L, 2), luaL_optstring(L, 3, "made"));
  return 0;
}

/* failed_frame(number, message) -> the exit code: reports that a file of the frame is not there. */
static int failed_frame(lua_State *L) {
  celspan_context *context = cs_service_session(L)->context;
  celspan_status status = cs_fail(context, CELSPAN_OUTPUT, "%s", luaL_checkstring(L, 2));
  lua_pushinteger(L, cs_report_frame_failure(context, status, luaL_checkinteger(L, 1)));
  return 1;
}

/* end_frames(failed, code): reports the end of the frames. failed: the numbers of those that
 * failed. Nothing is reported afterwards. */
static int end_frames(lua_State *L) {
  cs_session *session = cs_service_session(L);
  luaL_checktype(L, 1, LUA_TTABLE);
  const size_t count = lua_rawlen(L, 1);
  int64_t *frames = lua_newuserdatauv(L, (count + 1) * sizeof *frames, 0);
  for (size_t i = 0; i < count; i++, lua_pop(L, 1)) {
    lua_rawgeti(L, 1, (lua_Integer)i + 1);
    frames[i] = lua_tointeger(L, -1);
  }
  cs_progress_end(&session->progress, (cs_progress_failures){frames, count},
                  (int)luaL_checkinteger(L, 2));
  session->progress.noun = NULL;
  return 0;
}

/* flush(code) -> the exit code, after what was printed so far is on standard output */
static int flush(lua_State *L) {
  lua_pushinteger(L, cs_report_flush_output((cs_exit)luaL_checkinteger(L, 1)));
  return 1;
}

/* reported() -> the last error that was reported | nil */
static int reported(lua_State *L) {
  lua_pushstring(L, cs_report_last());
  return 1;
}

/* outcome() -> the exit code of a failed service, if the verb caught the failure */
static int outcome(lua_State *L) {
  lua_pushinteger(L, cs_service_session(L)->outcome);
  return 1;
}

/* is_stopped() -> the number of the signal that asked to stop, or false. A verb that calls
 * is_stopped ends by itself, so from the first call on, signals do not interrupt its Lua. */
static int is_stopped(lua_State *L) {
  cs_script_unwatch();
  if (cs_interrupt_signal())
    lua_pushinteger(L, cs_interrupt_signal());
  else
    lua_pushboolean(L, false);
  return 1;
}

/* refuse(option): reports that the verb does not accept the given value. */
static int refuse(lua_State *L) {
  const cs_request *request = cs_service_session(L)->request;
  return cs_service_end(L, cs_request_refuse(request, luaL_checkstring(L, 1)));
}

/* ---------------------------------------------------------------- the request */

/* task() -> the number of the task that --task names, from 1, and how many there are | nothing */
static int task(lua_State *L) {
  int32_t pair[2];
  if (!cs_request_read(cs_service_session(L)->request, "--task", pair))
    return 0;
  lua_pushinteger(L, pair[0]);
  lua_pushinteger(L, pair[1]);
  return 2;
}

/* Refuses the options of scripts, because this run has no script. */
static int refuse_rights(lua_State *L) {
  cs_service_require(L, cs_confine_refuse(cs_service_session(L)->request));
  return 0;
}

/* distance(word, other) -> how far apart they are, for guesses at what was meant */
static int distance(lua_State *L) {
  lua_pushinteger(L, cs_suggest_distance(luaL_checkstring(L, 1), luaL_checkstring(L, 2)));
  return 1;
}

/* text(name) -> a text of verbs/, or nil */
static int push_text(lua_State *L) {
  const cs_built_in *text = cs_built_in_find(cs_verb_texts, luaL_checkstring(L, 1));
  if (text)
    lua_pushlstring(L, text->bytes, text->size);
  else
    lua_pushnil(L);
  return 1;
}

/* part(name, ...): runs a file that verbs share with these arguments -> its results */
static int part(lua_State *L) {
  cs_built_in_load(L, cs_verb_texts, "", luaL_checkstring(L, 1));
  lua_replace(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

const luaL_Reg cs_services_reports[] = {CS_SERVICE(note),
                                        {"error", report_error},
                                        CS_SERVICE(fail),
                                        CS_SERVICE(usage),
                                        CS_SERVICE(part),
                                        CS_SERVICE(check),
                                        {"input", check_input},
                                        {"show", cs_script_show},
                                        CS_SERVICE(refuse),
                                        CS_SERVICE(refuse_rights),
                                        CS_SERVICE(outcome),
                                        CS_SERVICE(reported),
                                        CS_SERVICE(is_stopped),
                                        {"text", push_text},
                                        CS_SERVICE(task),
                                        CS_SERVICE(row),
                                        CS_SERVICE(distance),
                                        CS_SERVICE(count_frames),
                                        CS_SERVICE(made_frame),
                                        CS_SERVICE(failed_frame),
                                        CS_SERVICE(end_frames),
                                        CS_SERVICE(flush),
                                        {NULL, NULL}};
