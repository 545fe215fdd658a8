/* Processes for verbs in Lua: runs of this program beside it, several at a time.
 *
 *   start --> celspan ...      what it prints goes to a file, its descriptor 3 is another
 *   wait  <-- the one that ended
 *
 * A signal that asks to stop ends them, and they do not outlive this program, however it ends.
 */
#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "inside/clock.h"
#include "inside/context.h"
#include "inside/module.h"
#include "lua/bind/put.h"
#include "process/child.h"
#include "process/interrupt.h"
#include "process/spawn.h"
#include "program/commit.h"
#include "program/film/confine.h"
#include "program/film/service.h"
#include "program/report/log.h"

#define ANSWER_SECONDS 5.0 /* for ffmpeg to say its version */

enum { CHILDREN_MOST = 1024 };

/* The running processes; 0: a free place. */
static volatile pid_t children[CHILDREN_MOST];

/* Runs in the signal handler: kill(2) is safe there. */
static void stop_children(void) {
  for (size_t i = 0; i < CHILDREN_MOST; i++)
    if (children[i] > 0)
      kill(children[i], SIGTERM);
}

static void replace_child(pid_t from, pid_t to) {
  for (size_t i = 0; i < CHILDREN_MOST; i++)
    if (children[i] == from) {
      children[i] = to;
      return;
    }
}

static int descriptor_at(lua_State *L, int index) {
  return fileno(((luaL_Stream *)luaL_checkudata(L, index, LUA_FILEHANDLE))->f);
}

/* start(words, printed, other) -> the number of a process | nil, message
 *
 * The process runs this program with the words. Without `other` it has no descriptor 3. At most
 * 1024 processes at a time. */
static int start(lua_State *L) {
  bool has_other = !lua_isnoneornil(L, 3);
  int printed = descriptor_at(L, 2);
  const int files[] = {CS_SPAWN_SAME, printed, printed, has_other ? descriptor_at(L, 3) : -1};
  const char **words = cs_service_push_words(L, 1);
  pid_t process;
  cs_interrupt_call(stop_children);
  const cs_spawn_desc desc = {.path = cs_program_path(),
                              .arguments = words,
                              .files = files,
                              .file_count = has_other ? 4 : 3,
                              .bound_by = SIGTERM};
  int error = cs_spawn(&process, &desc);
  errno = error;
  if (error)
    return luaL_fileresult(L, 0, NULL);
  replace_child(0, process);
  lua_pushinteger(L, process);
  return 1;
}

/* wait() -> the number of a process that has ended, with its exit code, or with nil, the number of
 * the signal that ended it and the signal's name; or nil if there is no process. Children of an
 * earlier program that were inherited by exec are returned, too. */
static int wait_for_one(lua_State *L) {
  int status;
  pid_t ended;
  do
    ended = waitpid(-1, &status, 0);
  while (ended < 0 && errno == EINTR);
  if (ended < 0)
    return 0;
  replace_child(ended, 0);
  lua_pushinteger(L, ended);
  if (WIFEXITED(status)) {
    lua_pushinteger(L, WEXITSTATUS(status));
    return 2;
  }
  luaL_pushfail(L);
  lua_pushinteger(L, WTERMSIG(status));
  lua_pushstring(L, strsignal(WTERMSIG(status)));
  return 4;
}

/* launch(words, is_silent) -> the number of a process | nil, message: starts the program of the
 * first word, which is found through PATH, without a shell. It may outlive this process. is_silent:
 * its output is not shown. */
static int launch(lua_State *L) {
  const int errors = lua_toboolean(L, 2) ? CS_SPAWN_NULL : CS_SPAWN_SAME;
  const char **words = cs_service_push_words(L, 1);
  const int files[] = {CS_SPAWN_NULL, CS_SPAWN_NULL, errors};
  pid_t process;
  const cs_spawn_desc desc = {.arguments = words + 1, .files = files, .file_count = 3};
  int error = words[1] ? cs_spawn(&process, &desc) : EINVAL;
  errno = error;
  if (error)
    return luaL_fileresult(L, 0, words[1]);
  lua_pushinteger(L, process);
  return 1;
}

/* has_ended(process) -> whether a launched process has ended; if so, the system forgets it */
static int has_ended(lua_State *L) {
  pid_t process = (pid_t)luaL_checkinteger(L, 1);
  lua_pushboolean(L, waitpid(process, NULL, WNOHANG) != 0);
  return 1;
}

/* default_signals(): from now on signals end this process, and programs that it starts, at once. */
static int default_signals(lua_State *L) {
  static const int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ};
  (void)L;
  for (size_t i = 0; i < sizeof signals / sizeof *signals; i++)
    signal(signals[i], SIG_DFL);
  return 0;
}

/* processors() -> the number of processors that this process may use */
static int processors(lua_State *L) {
  lua_pushinteger(L, cs_context_workers(cs_service_session(L)->context, 0, INT_MAX));
  return 1;
}

/* divide_memory(parts): processes that are started from now on share the memory that this process
 * may hold */
static int divide_memory(lua_State *L) {
  lua_Integer parts = luaL_checkinteger(L, 1);
  cs_confine_divide(parts > 0 && parts < INT_MAX ? (unsigned)parts : 1);
  return 0;
}

/* clock() -> seconds since some moment, which never go back */
static int clock_now(lua_State *L) {
  lua_pushnumber(L, cs_clock_seconds());
  return 1;
}

/* ---------------------------------------------------------------- this run */

/* Linux counts kilobytes. */
static int64_t peak_of(int who) {
  struct rusage used = {0};
  getrusage(who, &used);
  return (int64_t)used.ru_maxrss * 1024;
}

/* run_facts() -> what a report says of this run: its host, the present time, the bytes of memory at
 * their most, and the versions of what the program is made of */
static int run_facts(lua_State *L) {
  char now[CS_LOG_TIME];
  cs_log_time(now);
  lua_newtable(L);
  cs_put_text(L, "host", cs_log_host());
  cs_put_text(L, "ended", now);
  cs_put_text(L, "celspan", celspan_version());
  cs_put_text(L, "commit", CS_COMMIT);
  cs_put_text(L, "openimageio", CELSPAN_OPENIMAGEIO[0] ? CELSPAN_OPENIMAGEIO : NULL);
  cs_put_text(L, "libavif", CELSPAN_LIBAVIF[0] ? CELSPAN_LIBAVIF : NULL);
  lua_newtable(L);
  cs_put_integer(L, "process", peak_of(RUSAGE_SELF));
  cs_put_integer(L, "children", peak_of(RUSAGE_CHILDREN));
  cs_put_integer(L, "celspan", (int64_t)atomic_load(&cs_service_session(L)->context->memory->peak));
  lua_setfield(L, -2, "memory");
  return 1;
}

/* ffmpeg_version() -> the version that ffmpeg prints | nil: there is none, or it does not answer in
 * time */
static int ffmpeg_version(lua_State *L) {
  static const char *const question[] = {"sh", "-c", "ffmpeg -version | head -n 1 >&2", NULL};
  cs_child child;
  char version[80];
  if (cs_child_start(&child, question, false) != 0)
    return 0;
  close(child.input);
  cs_child_end(&child, ANSWER_SECONDS);
  if (sscanf(child.words.text, "ffmpeg version %79s", version) != 1)
    return 0;
  lua_pushstring(L, version);
  return 1;
}

const luaL_Reg cs_services_processes[] = {CS_SERVICE(start),
                                          {"wait", wait_for_one},
                                          CS_SERVICE(default_signals),
                                          CS_SERVICE(launch),
                                          CS_SERVICE(has_ended),
                                          CS_SERVICE(processors),
                                          CS_SERVICE(divide_memory),
                                          {"clock", clock_now},
                                          CS_SERVICE(run_facts),
                                          CS_SERVICE(ffmpeg_version),
                                          {NULL, NULL}};
