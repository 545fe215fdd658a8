/* program.stage(): the requests to a film that is watched (celspan watch), and its pictures, which
 * are drawn while the next frame is built.
 *
 *   standard input --> next() --request--> the verb builds a frame --> script:draw()
 *           \--given up--> is_given_up                                   | any thread
 *                                    standard output <--picture-- ring <-/
 *
 * A message on standard input begins with four bytes. ASKED, and the size of the request that
 * follows; or GIVEN_UP, and the number of a request, counted from 1, whose picture is not wanted
 * any more. Numbers have three bytes, the highest first, and are counted modulo 2^24. Answers are
 * described in program/verbs/stage.lua.
 *
 * INVARIANT: only the thread of the verb reads standard input. It alone uses the ring, except for
 * the pictures that other threads draw. A thread answers with its picture at once, so that a frame
 * that is never built holds no picture back. A frame with procedures is drawn by the thread of the
 * verb before script:draw() returns, because procedures run in the state of the script; its picture
 * is put at the next call of next().
 */
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "inside/clock.h"
#include "inside/frames.h"
#include "inside/scene.h"
#include "inside/threads.h"
#include "lua/bind/userdata.h"
#include "process/interrupt.h"
#include "process/spawn.h"
#include "program/film/service.h"
#include "program/report/json.h"
#include "program/stage/stage.h"

enum { HEAD = 4, ASKED = 0, GIVEN_UP = 1, REQUEST_MOST = 32768 };

/* The most threads, as in program/verbs/watch/renderers.lua, and the places of the ring. A place is
 * free again when all pictures before it are answered, too: a slow one leaves many to others. */
enum { THREADS_MOST = 4, PLACES = 64 };

typedef struct stage stage;

/* A picture on its way. */
typedef struct drawn {
  stage *stage;
  size_t item;     /* in the pipeline */
  uint32_t number; /* the number of its request */
  int64_t frame;
  bool is_here; /* the thread of the verb draws it */
  atomic_bool is_given_up;
  cs_film_frame built; /* owned */
  celspan_frame_desc desc;
  cs_stage_kind kind;
  cs_stage_picture picture; /* owned */
  double seconds;           /* how long drawing took */
} drawn;

struct stage {
  celspan_context *context;
  unsigned char bytes[HEAD + REQUEST_MOST]; /* the message that is being read */
  size_t size;
  uint32_t taken;   /* the number of the request that was taken last */
  bool is_given_up; /* that request is given up */
  bool is_over;     /* no more messages will arrive */
  int wake[2];      /* a pipe: a byte for each picture that another thread has drawn */
  drawn *ring;      /* picture i lies at i % PLACES; owned */
  size_t added, given;
  cs_pipeline *pipeline; /* NULL: there was no picture yet */
};

static drawn *drawn_of(const stage *s, size_t item) { return &s->ring[item % PLACES]; }

/* ---------------------------------------------------------------- messages */

static uint32_t number_of(const unsigned char *head) {
  return (uint32_t)head[1] << 16 | (uint32_t)head[2] << 8 | head[3];
}

/* The number of missing bytes of the message; more than there is room for: it is too long. */
static size_t missing(const stage *s) {
  if (s->size < HEAD)
    return HEAD - s->size;
  return HEAD + (s->bytes[0] == ASKED ? number_of(s->bytes) : 0) - s->size;
}

static bool has_request(const stage *s) { return s->size >= HEAD && missing(s) == 0; }

static void give_up(stage *s, uint32_t number) {
  s->is_given_up = s->is_given_up || number == s->taken;
  for (size_t i = s->given; i < s->added; i++)
    if (drawn_of(s, i)->number == number)
      atomic_store(&drawn_of(s, i)->is_given_up, true);
}

/* Reads what has arrived of a message. */
static void read_some(stage *s) {
  size_t wanted = missing(s);
  ssize_t got =
      wanted > sizeof s->bytes - s->size ? 0 : read(STDIN_FILENO, s->bytes + s->size, wanted);
  s->is_over = got <= 0;
  s->size += got > 0 ? (size_t)got : 0;
  if (s->size < HEAD || s->bytes[0] != GIVEN_UP)
    return;
  give_up(s, number_of(s->bytes));
  s->size = 0;
}

/* Waits for a message or a picture; a request that nobody has taken yet stays the last message. */
static void hear(stage *s, int milliseconds) {
  char bytes[64];
  struct pollfd sources[] = {{.fd = s->wake[0], .events = POLLIN},
                             {.fd = STDIN_FILENO, .events = POLLIN}};
  cs_interrupt_wait(sources, s->is_over || has_request(s) ? 1 : 2, milliseconds);
  if (sources[0].revents)
    (void)!read(s->wake[0], bytes, sizeof bytes); /* one byte says no less than several */
  if (sources[1].revents)
    read_some(s);
}

/* ---------------------------------------------------------------- drawing */

/* The progress of a picture. */
static bool is_wanted(void *user, int32_t rows_done, int32_t rows_total) {
  const drawn *d = user;
  if (d->is_here)
    hear(d->stage, 0);
  return cs_interrupt_progress(NULL, rows_done, rows_total) && !atomic_load(&d->is_given_up) &&
         !(d->is_here && d->stage->is_over) && cs_pipeline_is_wanted(d->stage->pipeline, d->item);
}

static void put_number(uint32_t number) {
  const unsigned char bytes[] = {(unsigned char)(number >> 24), (unsigned char)(number >> 16),
                                 (unsigned char)(number >> 8), (unsigned char)number};
  fwrite(bytes, 1, sizeof bytes, stdout);
}

/* Answers with a picture, or with the context's sentence about it. Any thread: the answer is one
 * for the lock of standard output. If nobody reads it any more, no request will arrive either. */
static void answer(const drawn *d, const celspan_context *context, celspan_status status) {
  char message[CS_ERROR_SIZE + 32];
  cs_json head;
  size_t size = status == CELSPAN_OK ? d->picture.size : 0;
  cs_json_begin(&head);
  cs_json_integer(&head, "picture", d->number);
  cs_json_number(&head, "seconds", d->seconds);
  if (status != CELSPAN_OK) {
    snprintf(message, sizeof message, "frame %lld: %s", (long long)d->frame,
             celspan_context_error(context));
    cs_json_text(&head, "message", message);
  }
  const char *text = cs_json_end(&head);
  size_t head_size = strlen(text);
  flockfile(stdout);
  put_number((uint32_t)(sizeof(uint32_t) + head_size + size));
  put_number((uint32_t)head_size);
  fwrite(text, 1, head_size, stdout);
  if (size)
    fwrite(d->picture.bytes, 1, size, stdout);
  fflush(stdout);
  funlockfile(stdout);
}

static celspan_status make(void *user, celspan_context *context, int worker, size_t item) {
  const stage *s = user;
  drawn *d = drawn_of(s, item);
  double begun = cs_clock_seconds();
  d->is_here = worker == 0;
  celspan_status status = cs_stage_make(&d->picture, context, &d->desc, d->kind);
  d->picture.context = s->context; /* which has the same memory, and outlives the threads */
  d->seconds = cs_clock_seconds() - begun;
  if (!d->is_here) {
    answer(d, context, status);
    cs_stage_release(&d->picture);
    cs_film_frame_finish(&d->built);
  }
  return status;
}

static celspan_status deliver(void *user, celspan_context *context, size_t item,
                              celspan_status status) {
  stage *s = user;
  drawn *d = drawn_of(s, item);
  if (d->is_here)
    answer(d, context, status);
  cs_stage_release(&d->picture);
  cs_film_frame_finish(&d->built);
  s->given++;
  return CELSPAN_OK;
}

/* Waiting for a place, which is rare: the pictures before it may be given up. */
static celspan_status idle(void *user, celspan_context *context) {
  stage *s = user;
  hear(s, 0);
  return s->is_over ? cs_fail(context, CELSPAN_CANCELLED, "no more requests will arrive")
                    : CELSPAN_OK;
}

/* If the pipe is full, there are enough bytes in it. */
static void tell(void *user) {
  const stage *s = user;
  (void)!write(s->wake[1], "", 1);
}

/* Threads are started with the first picture: by then the script's process has been confined. */
static celspan_status begin(stage *s, int workers) {
  if (s->pipeline)
    return CELSPAN_OK;
  int threads = cs_frame_workers(s->context, workers);
  threads = threads < THREADS_MOST ? threads : THREADS_MOST;
  cs_pipeline_desc desc = {.count = SIZE_MAX,
                           .slots = PLACES,
                           .threads = threads,
                           .keeps_going = true,
                           .user = s,
                           .make = make,
                           .deliver = deliver,
                           .idle = idle,
                           .tell = tell};
  if (!s->ring)
    CS_TRY(CS_MAKE(s->context, s->ring, PLACES));
  return cs_pipeline_create(s->context, &desc, &s->pipeline);
}

/* Moves the frame that was built last into the ring, and has it drawn. */
static void add(stage *s, cs_script *script, const celspan_frame_desc *desc, cs_stage_kind kind) {
  drawn *d = drawn_of(s, s->added);
  bool is_here = cs_pipeline_threads(s->pipeline) == 0 ||
                 cs_scene_has_procedure(script->frame.exposures, script->frame.count);
  *d = (drawn){.stage = s,
               .item = s->added++,
               .number = s->taken,
               .frame = script->number,
               .built = script->frame,
               .desc = *desc,
               .kind = kind};
  atomic_init(&d->is_given_up, s->is_given_up);
  script->frame = (cs_film_frame){0};
  cs_film_expose(&script->film, &d->built, &d->desc);
  d->desc.progress = is_wanted;
  d->desc.progress_user = d;
  cs_pipeline_add(s->pipeline, s->context, is_here ? CS_PIPELINE_HERE : CS_PIPELINE_ANYWHERE,
                  CELSPAN_OK);
}

/* script:draw(width, height, x, y, w, h, what, workers or nil, stage) -> true | nil, message:
 * begins to draw a part of the frame that was built last at this size: 8 bits, sRGB, straight
 * alpha, as "rgba", as a "png", or as "runs"; or as "spans", the kinds of its spans in RGBA. The
 * picture is the answer to the request that stage:next() has given last. The film has no frame
 * then. */
int cs_stage_draw(lua_State *L) {
  cs_script *script = cs_service_opened(L);
  static const char *const kinds[] = {"rgba", "png", "spans", "runs", NULL};
  celspan_frame_desc desc;
  cs_stage_kind kind = (cs_stage_kind)luaL_checkoption(L, 8, NULL, kinds);
  luaL_checktype(L, 10, LUA_TTABLE);
  lua_getfield(L, 10, "open");
  stage *s = lua_touserdata(L, -1);
  if (!cs_stage_frame(L, script, &desc))
    return 2;
  celspan_status status = begin(s, desc.workers);
  desc.workers = (int)luaL_optinteger(L, 9, desc.workers);
  if (status == CELSPAN_OK) /* waits while there is no room */
    status = cs_pipeline_deliver(s->pipeline, s->context, PLACES - 1);
  if (status == CELSPAN_OK)
    add(s, script, &desc, kind);
  lua_pushboolean(L, status == CELSPAN_OK);
  lua_pushstring(L, status == CELSPAN_OK ? NULL : celspan_context_error(s->context));
  return 2;
}

/* ---------------------------------------------------------------- requests */

static int take_request(lua_State *L, stage *s) {
  s->taken = (s->taken + 1) & 0xffffff;
  s->is_given_up = false;
  lua_pushlstring(L, (const char *)s->bytes + HEAD, s->size - HEAD);
  s->size = 0;
  return 1;
}

/* stage:next() -> the next request | nil: no more will arrive, or the program is to stop; pictures
 * that are still drawn are given up then */
static int next(lua_State *L) {
  stage *s = cs_service_opened(L);
  while (!cs_interrupt_signal()) {
    if (s->pipeline && cs_pipeline_is_ready(s->pipeline))
      cs_service_try(L, cs_pipeline_deliver(s->pipeline, s->context, s->added - s->given - 1));
    else if (has_request(s))
      return take_request(L, s);
    else if (s->is_over)
      break;
    else
      hear(s, -1);
  }
  return 0;
}

/* ---------------------------------------------------------------- the stage */

static int close_stage(lua_State *L) {
  stage *s = lua_touserdata(L, 1);
  cs_pipeline_destroy(s->pipeline);
  s->pipeline = NULL;
  for (size_t i = 0; s->ring && i < PLACES; i++) {
    cs_film_frame_finish(&s->ring[i].built);
    cs_stage_release(&s->ring[i].picture);
  }
  if (s->ring)
    cs_mem_free(s->context->memory, s->ring, PLACES * sizeof *s->ring);
  s->ring = NULL;
  for (int i = 0; i < 2; i++) {
    if (s->wake[i] >= 0)
      close(s->wake[i]);
    s->wake[i] = -1;
  }
  return 0;
}

/* stage() -> the requests and pictures of this process */
static int open_stage(lua_State *L) {
  static const luaL_Reg methods[] = {CS_SERVICE(next), {NULL, NULL}};
  lua_createtable(L, 0, 2);
  stage *s = cs_userdata_push_holder(L, "celspan.program.stage", sizeof *s, close_stage);
  s->context = cs_service_session(L)->context;
  s->wake[0] = s->wake[1] = -1;
  int error = cs_spawn_pipe(s->wake);
  for (int i = 0; i < 2 && !error; i++)
    error = fcntl(s->wake[i], F_SETFL, O_NONBLOCK) == 0 ? 0 : errno;
  if (error)
    return luaL_error(L, "no pipe can be made: %s", strerror(error));
  lua_setfield(L, -2, "open");
  cs_service_add(L, methods);
  return 1;
}

const luaL_Reg cs_services_stage[] = {{"stage", open_stage}, {NULL, NULL}};
