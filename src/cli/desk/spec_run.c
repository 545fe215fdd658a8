#include "cli/desk/spec_run.h"

#include <errno.h>
#include <lauxlib.h>
#include <lualib.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bind/host.h"
#include "celspan/lua.h"
#include "cli/desk/desk.h"
#include "cli/report.h"

#define CHUNK "@celspan/desk/test.lua"

/* ---------------------------------------------------------------- the child */

typedef struct child {
  celspan_context *context;
  const cs_spec_run *run;
  const char *only;
} child;

/* record(kind, text); upvalue: the file. */
static int record(lua_State *L) {
  FILE *records = lua_touserdata(L, lua_upvalueindex(1));
  size_t size;
  const char *kind = luaL_checkstring(L, 1), *text = luaL_checklstring(L, 2, &size);
  fprintf(records, "%s %zu\n", kind, size);
  fwrite(text, 1, size, records);
  if (fflush(records) != 0)
    return luaL_error(L, "what the tests came to cannot be written: %s", strerror(errno));
  return 0;
}

/* light userdata: a child. Runs protected. */
static int run_spec(lua_State *L) {
  const child *c = lua_touserdata(L, 1);
  luaL_openlibs(L);
  cs_host_open(L, c->context);
  luaL_requiref(L, "celspan", luaopen_celspan, 0);
  lua_settop(L, 0);
  lua_pushstring(L, c->run->path);
  lua_pushlightuserdata(L, c->run->records);
  lua_pushcclosure(L, record, 1);
  lua_pushstring(L, c->only);
  cs_desk_call(L, cs_desk_test, CHUNK, 3, 0);
  return 0;
}

static int with_traceback(lua_State *L) {
  luaL_traceback(L, L, luaL_tolstring(L, 1, NULL), 1);
  return 1;
}

static int call_spec(const child *c) {
  lua_State *L = luaL_newstate();
  if (!L)
    return CS_EXIT_MEMORY;
  lua_pushcfunction(L, with_traceback);
  lua_pushcfunction(L, run_spec);
  lua_pushlightuserdata(L, (void *)c);
  int outcome = lua_pcall(L, 1, 0, 1);
  if (outcome != LUA_OK)
    fprintf(stderr, "%s\n", lua_tostring(L, -1));
  lua_close(L);
  return outcome == LUA_OK ? 0 : CS_EXIT_SCRIPT;
}

/* Signals end a child as they end any program; its output goes to its file. */
static void be_child(const child *c) {
  signal(SIGINT, SIG_DFL);
  signal(SIGTERM, SIG_DFL);
  signal(SIGHUP, SIG_DFL);
  signal(SIGPIPE, SIG_DFL);
  int printed = fileno(c->run->printed);
  if (dup2(printed, STDOUT_FILENO) < 0 || dup2(printed, STDERR_FILENO) < 0)
    _exit(CS_EXIT_INTERNAL);
  int code = call_spec(c);
  fflush(NULL);
  _exit(code);
}

/* ---------------------------------------------------------------- the parent */

/* userdata: where the answer goes. Runs protected. */
static int find_busted(lua_State *L) {
  bool *is_there = lua_touserdata(L, 1);
  luaL_openlibs(L);
  cs_desk_call(L, cs_desk_test, CHUNK, 0, 1);
  *is_there = lua_toboolean(L, -1);
  return 0;
}

bool cs_spec_run_has_busted(void) {
  bool is_there = false;
  lua_State *L = luaL_newstate();
  if (!L)
    return false;
  lua_pushcfunction(L, find_busted);
  lua_pushlightuserdata(L, &is_there);
  bool is_answered = lua_pcall(L, 1, 0, 0) == LUA_OK;
  lua_close(L);
  return is_answered && is_there;
}

bool cs_spec_run_start(cs_spec_run *run, celspan_context *context, const char *only) {
  run->records = tmpfile();
  run->printed = tmpfile();
  fflush(NULL); /* or the child would write it again */
  run->process = run->records && run->printed ? fork() : -1;
  if (run->process == 0)
    be_child(&(child){context, run, only});
  if (run->process > 0)
    return true;
  cs_report_error("%s: no process for it: %s", run->path, strerror(errno));
  run->process = 0;
  cs_spec_run_drop(run);
  return false;
}

void cs_spec_run_drop(cs_spec_run *run) {
  if (run->records)
    fclose(run->records);
  if (run->printed)
    fclose(run->printed);
  run->records = run->printed = NULL;
}

static void copy_bytes(FILE *from, size_t size) {
  char bytes[4096];
  for (size_t got; size > 0; size -= got) {
    got = fread(bytes, 1, size < sizeof bytes ? size : sizeof bytes, from);
    if (got == 0)
      return;
    fwrite(bytes, 1, got, stdout);
  }
}

static void print_record(FILE *records, const char *what, size_t size) {
  printf("%s: ", what);
  copy_bytes(records, size);
  printf("\n");
}

/* Counts the records and prints those that are told. Whether the last one was "done". */
static bool read_records(cs_spec_run *run) {
  char kind[8];
  size_t size;
  bool is_done = false;
  rewind(run->records);
  while (fscanf(run->records, "%7s %zu", kind, &size) == 2 && fgetc(run->records) == '\n') {
    is_done = strcmp(kind, "done") == 0;
    run->passed += strcmp(kind, "pass") == 0;
    if (strcmp(kind, "skip") == 0) {
      run->skipped++;
      print_record(run->records, "skipped", size);
    } else if (strcmp(kind, "fail") == 0) {
      run->failed++;
      print_record(run->records, "failed", size);
    }
  }
  return is_done;
}

static void report_death(cs_spec_run *run, int status) {
  run->failed++;
  if (WIFSIGNALED(status))
    printf("failed: %s was ended by signal %d (%s)\n", run->path, WTERMSIG(status),
           strsignal(WTERMSIG(status)));
  else
    printf("failed: %s ended before its tests did, with exit code %d\n", run->path,
           WEXITSTATUS(status));
}

void cs_spec_run_collect(cs_spec_run *run, int status) {
  run->process = 0;
  if (!read_records(run))
    report_death(run, status);
  fseek(run->printed, 0, SEEK_END);
  long size = ftell(run->printed);
  rewind(run->printed);
  if (size > 0) {
    printf("printed by %s:\n", run->path);
    copy_bytes(run->printed, (size_t)size);
  }
  printf("%s: %zu passed, %zu failed, %zu skipped\n", run->path, run->passed, run->failed,
         run->skipped);
  fflush(stdout);
  cs_spec_run_drop(run);
}
