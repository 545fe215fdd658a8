/* program.renderer(): a run of this program that answers requests, so that a script that hangs or
 * ends by a limit does not take the verb with it.
 *
 *   verb --request--> standard input  | renderer | standard output --answers--> verb
 *                                                | standard error  --words----> verb
 *
 * An answer is its size, four bytes with the highest first, and that many bytes. What requests are
 * is said in program/services/stage_service.c.
 *
 * INVARIANT: reading never waits. A renderer ends when its verb does, for whatever reason.
 */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/bytes.h"
#include "inside/context.h"
#include "inside/module.h"
#include "lua/bind/userdata.h"
#include "process/spawn.h"
#include "program/film/service.h"

#define MESSAGE_MOST ((size_t)1 << 30)

enum {
  HEAD = 4,
  PIECE = 65536,
  REQUESTS = 1 << 16, /* the bytes of a pipe for requests: twice the longest one */
  ANSWER = 1 << 20    /* the bytes of an answer that a renderer can write without waiting */
};

typedef struct renderer {
  celspan_context *context;
  pid_t id;   /* 0: the renderer has ended */
  int status; /* the status of waitpid, after it has ended */
  int requests, answers, words;
  char *bytes; /* the answer that is being read; owned */
  size_t size, capacity;
} renderer;

static void close_descriptor(int *descriptor) {
  if (*descriptor >= 0)
    close(*descriptor);
  *descriptor = -1;
}

/* Waits for the end of a renderer; with WNOHANG, asks for it. */
static void reap(renderer *r, int options) {
  if (r->id && waitpid(r->id, &r->status, options) == r->id)
    r->id = 0;
}

/* Ends the process group of a renderer, which includes processes that it has started. */
static void end_renderer(renderer *r) {
  if (r->id)
    kill(-r->id, SIGKILL);
  close_descriptor(&r->requests);
  close_descriptor(&r->answers);
  close_descriptor(&r->words);
}

static int close_renderer(lua_State *L) {
  renderer *r = lua_touserdata(L, 1);
  end_renderer(r);
  reap(r, 0);
  if (r->bytes)
    cs_mem_free(r->context->memory, r->bytes, r->capacity);
  r->bytes = NULL;
  return 0;
}

/* The renderer that is argument 1. */
static renderer *self(lua_State *L) { return cs_service_opened(L); }

/* ---------------------------------------------------------------- messages */

/* Pushes whether a message was sent. A renderer has read a request when it answers, and no other is
 * sent before, so that one always fits into the pipe, with the numbers of those that are given up.
 * kind, number: as in program/services/stage_service.c. */
static int put_message(lua_State *L, unsigned char kind, size_t number, const char *text,
                       size_t size) {
  const renderer *r = self(L);
  const unsigned char head[HEAD] = {kind, (unsigned char)(number >> 16),
                                    (unsigned char)(number >> 8), (unsigned char)number};
  bool is_sent = r->requests >= 0 && write(r->requests, head, HEAD) == HEAD &&
                 write(r->requests, text, size) == (ssize_t)size;
  lua_pushboolean(L, is_sent);
  return 1;
}

/* renderer:send(text) -> whether it was sent */
static int send(lua_State *L) {
  size_t size;
  const char *text = luaL_checklstring(L, 2, &size);
  luaL_argcheck(L, size < 32768, 2, "too long");
  return put_message(L, 0, size, text, size);
}

/* renderer:abandon(number) -> whether it was sent that the picture of this request, counted from 1,
 * is not wanted any more */
static int abandon(lua_State *L) {
  return put_message(L, 1, (size_t)luaL_checkinteger(L, 2), "", 0);
}

static size_t size_of(const renderer *r) {
  return HEAD + (size_t)cs_bytes_big32((const unsigned char *)r->bytes);
}

/* The number of missing bytes; MESSAGE_MOST: the message is too long. */
static size_t missing(const renderer *r) {
  size_t whole = r->size < HEAD ? HEAD : size_of(r);
  return whole > MESSAGE_MOST ? MESSAGE_MOST : whole - r->size;
}

/* Reads the bytes that have arrived. false: the renderer has ended, or its bytes are not an
 * answer. */
static bool read_answer(lua_State *L, renderer *r) {
  for (size_t wanted; (wanted = missing(r)) > 0;) {
    if (wanted == MESSAGE_MOST)
      return false;
    if (CS_RESERVE(r->context, r->bytes, r->capacity, r->size + wanted) != CELSPAN_OK)
      luaL_error(L, "not enough memory");
    ssize_t got = read(r->answers, r->bytes + r->size, wanted);
    if (got <= 0)
      return got < 0 && (errno == EAGAIN || errno == EINTR);
    r->size += (size_t)got;
  }
  return true;
}

/* renderer:take() -> the next answer | nil: it has not arrived | false: no more will arrive */
static int take(lua_State *L) {
  renderer *r = self(L);
  if (r->answers < 0 || !read_answer(L, r)) {
    lua_pushboolean(L, false);
    return 1;
  }
  if (missing(r) > 0)
    return 0;
  lua_pushlstring(L, r->bytes + HEAD, r->size - HEAD);
  r->size = 0;
  return 1;
}

/* renderer:words() -> its output since the last call, at most as much as its pipe holds: of one
 * that has ended this is all */
static int words(lua_State *L) {
  const renderer *r = self(L);
  luaL_Buffer text;
  luaL_buffinit(L, &text);
  for (size_t left = ANSWER; left > 0 && r->words >= 0;) {
    ssize_t got = read(r->words, luaL_prepbuffsize(&text, PIECE), PIECE);
    if (got <= 0)
      break;
    luaL_addsize(&text, (size_t)got);
    left -= left < (size_t)got ? left : (size_t)got;
  }
  luaL_pushresult(&text);
  return 1;
}

/* renderer:descriptors() -> the descriptors of its answers and of its output */
static int descriptors(lua_State *L) {
  const renderer *r = self(L);
  lua_pushinteger(L, r->answers);
  lua_pushinteger(L, r->words);
  return 2;
}

/* ---------------------------------------------------------------- the process */

/* renderer:stop(milliseconds): asks it to end by itself, so that it removes what it has begun, and
 * waits for that, at most so long */
static int stop(lua_State *L) {
  const renderer *r = self(L);
  struct pollfd answers = {.fd = r->answers};
  int milliseconds = (int)luaL_checkinteger(L, 2);
  if (r->id) {
    kill(-r->id, SIGTERM);
    poll(&answers, 1, milliseconds);
  }
  return 0;
}

/* renderer:finish() -> its exit code, or nil and the name of the signal that ended it. If it still
 * runs and has not closed its answers, it is ended. */
static int finish(lua_State *L) {
  renderer *r = self(L);
  char byte;
  if (r->answers >= 0 && read(r->answers, &byte, 1) == 0)
    reap(r, 0);
  end_renderer(r);
  reap(r, 0);
  if (WIFEXITED(r->status)) {
    lua_pushinteger(L, WEXITSTATUS(r->status));
    return 1;
  }
  luaL_pushfail(L);
  lua_pushstring(L, strsignal(WTERMSIG(r->status)));
  return 2;
}

/* renderer:kill(): ends it. Nobody waits for that, which takes milliseconds in a large process. */
static int kill_renderer(lua_State *L) {
  end_renderer(self(L));
  return 0;
}

/* renderer:is_gone() -> whether a renderer that was killed has ended */
static int is_gone(lua_State *L) {
  reap(self(L), WNOHANG);
  lua_pushboolean(L, self(L)->id == 0);
  return 1;
}

/* Opens three pipes: [0] for the renderer, [1] for the verb. */
static int open_pipes(renderer *r, int files[3]) {
  int ends[2], error = cs_spawn_pipe(ends);
  files[0] = ends[0];
  r->requests = ends[1];
  (void)fcntl(ends[1], F_SETPIPE_SZ, REQUESTS); /* a user's limit may have made it smaller */
  int *const mine[] = {&r->answers, &r->words};
  for (int i = 0; i < 2; i++) {
    files[i + 1] = -1;
    if (error)
      continue;
    error = cs_spawn_pipe(ends);
    *mine[i] = ends[0];
    (void)fcntl(ends[0], F_SETPIPE_SZ, ANSWER); /* if this fails, the usual size is enough, too */
    files[i + 1] = ends[1];
    if (!error && fcntl(ends[0], F_SETFL, O_NONBLOCK) != 0)
      error = errno;
  }
  return error;
}

static int spawn(renderer *r, const char *const *arguments) {
  int files[3];
  int error = open_pipes(r, files);
  const cs_spawn_desc desc = {.path = cs_program_path(),
                              .arguments = arguments,
                              .files = files,
                              .file_count = 3,
                              .bound_by = SIGKILL};
  if (!error)
    error = cs_spawn(&r->id, &desc);
  if (error)
    r->id = 0;
  for (int i = 0; i < 3; i++)
    close_descriptor(&files[i]);
  return error;
}

/* renderer(words) -> a renderer | nil, message: this program with the words */
static int open_renderer(lua_State *L) {
  static const luaL_Reg methods[] = {
      CS_SERVICE(send),        CS_SERVICE(abandon), CS_SERVICE(take), CS_SERVICE(words),
      CS_SERVICE(descriptors), CS_SERVICE(finish),  CS_SERVICE(stop), {"kill", kill_renderer},
      CS_SERVICE(is_gone),     {NULL, NULL}};
  const char **arguments = cs_service_push_words(L, 1);
  lua_createtable(L, 0, 8);
  renderer *r = cs_userdata_push_holder(L, "celspan.program.renderer", sizeof *r, close_renderer);
  *r = (renderer){
      .context = cs_service_session(L)->context, .requests = -1, .answers = -1, .words = -1};
  int error = spawn(r, arguments);
  errno = error;
  if (error)
    return luaL_fileresult(L, 0, NULL);
  lua_setfield(L, -2, "open");
  cs_service_add(L, methods);
  return 1;
}

const luaL_Reg cs_services_renderers[] = {{"renderer", open_renderer}, {NULL, NULL}};
