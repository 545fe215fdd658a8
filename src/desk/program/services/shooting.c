/* Methods of script_service.c for the frames of a film: into files, digests, or one file or stream.
 *
 *   target (a row of outputs.c) --> shoot (frames/film/shoot.h: build, make, copy) --> finished
 *
 * Which frames these are, which of them are kept, and what is reported of them is decided in Lua
 * (verbs/render.lua). Its functions are called by the thread that builds the frames, in order. An
 * error that they raise ends the run, and is raised again when the run has ended.
 */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "inside/context.h"
#include "inside/scene.h"
#include "inside/sinks.h"
#include "lua/bind/put.h"
#include "plugins/sound/wave_file.h"
#include "program/film/change.h"
#include "program/film/script.h"
#include "program/film/service.h"
#include "program/film/soundtrack.h"
#include "program/film/spaces.h"
#include "program/film/view.h"
#include "program/outputs/outlets.h"
#include "program/outputs/outputs.h"
#include "program/outputs/target.h"
#include "program/outputs/video_target.h"
#include "writers/apart/apart.h"

enum {
  TARGET = 2,     /* the index of the table that describes a run */
  KEY_SIZE = 1024 /* bytes */
};

/* A run, while its frames are made. */
typedef struct run {
  cs_into into; /* the first field: see outlets.h */
  lua_State *L;
  cs_session *session;
  const cs_output *row;
  const cs_outlet *outlet; /* NULL: frames are files, or are only hashed or built */
  cs_sequence frames, played;
  celspan_frame_desc view;
  celspan_coding coding;
  cs_frame_change change;
  cs_file_contents contents; /* what the file of the outlet holds */
  bool asks, tells;          /* the table has the functions `keep`, `finished` */
  bool has_digests, has_noted, has_raised;
  int ended; /* the exit code with which `finished` ended the run; 0: it did not */
} run;

/* ---------------------------------------------------------------- calls into Lua */

/* A frame that the table of the run is asked about. */
typedef struct question {
  cs_shoot_frame *frame;
  int code;    /* how the frame failed, for the report */
  bool answer; /* what `keep` has answered */
  int end;     /* what `finished` gives: -1: good; 0: failed; or the run's end */
} question;

static const char *const ways[] = {
    [CS_SHOOT_MADE] = "made", [CS_SHOOT_COPIED] = "copied", [CS_SHOOT_KEPT] = "kept"};

static int ask_keep(lua_State *L) {
  question *q = lua_touserdata(L, 2);
  cs_shoot_frame *frame = q->frame;
  lua_getfield(L, 1, "keep");
  lua_pushinteger(L, frame->number);
  lua_pushstring(L, frame->path);
  if (frame->is_named)
    cs_service_push_hash(L, frame->scene);
  else
    lua_pushnil(L);
  cs_service_push_hash(L, frame->inputs);
  lua_call(L, 4, 3);
  q->answer = lua_toboolean(L, -3);
  if (q->answer) {
    frame->is_named = lua_toboolean(L, -2);
    if (lua_isstring(L, -1))
      sscanf(lua_tostring(L, -1), "%16" SCNx64 "%16" SCNx64, &frame->digest[0], &frame->digest[1]);
  }
  return 0;
}

static int ask_finished(lua_State *L) {
  question *q = lua_touserdata(L, 2);
  const cs_shoot_frame *frame = q->frame;
  lua_getfield(L, 1, "finished");
  lua_pushinteger(L, frame->number);
  lua_pushinteger(L, q->code);
  lua_pushstring(L, ways[frame->way]);
  lua_pushnumber(L, frame->seconds);
  lua_pushinteger(L, (lua_Integer)frame->contents.bytes);
  cs_service_push_hash(L, frame->contents.hash);
  cs_service_push_hash(L, (cs_hash){frame->digest[0], frame->digest[1]});
  lua_call(L, 7, 1);
  q->end = lua_isnil(L, -1) ? -1 : (int)lua_tointeger(L, -1);
  return 0;
}

/* Asks about a frame; false: an error was raised, now or before. The error stays on the stack. */
static bool ask(run *r, lua_CFunction asking, question *q) {
  if (r->has_raised)
    return false;
  lua_pushcfunction(r->L, asking);
  lua_pushvalue(r->L, TARGET);
  lua_pushlightuserdata(r->L, q);
  r->has_raised = lua_pcall(r->L, 2, 0, 0) != LUA_OK;
  return !r->has_raised;
}

/* ---------------------------------------------------------------- frames */

/* Says once in a run that layers over each other are not the frame. */
static void tell_layers(run *r, int64_t number, const cs_film_frame *built) {
  char why[CS_APART_WHY];
  if (!cs_request_has(r->into.request, "--layers") || r->has_noted ||
      cs_apart_sums(built->exposures, built->count, r->row->layers, &r->coding,
                    r->into.script->film.space, why))
    return;
  cs_report_note("frame %" PRId64 ": its layers over each other are not the frame: %s", number,
                 why);
  r->has_noted = true;
}

static celspan_status build(void *user, int64_t number, cs_film_frame *out) {
  run *r = user;
  cs_film_frame built;
  CS_TRY(cs_lua_film_build(r->into.script->L, CS_SCRIPT_FILM, number, &built));
  celspan_status status = cs_change_frame(r->into.script->context, &r->change, &built);
  if (status == CELSPAN_OK)
    tell_layers(r, number, &built);
  if (status == CELSPAN_OK)
    *out = built;
  else
    cs_film_frame_finish(&built);
  return status;
}

static bool keep(void *user, cs_shoot_frame *frame) {
  question q = {.frame = frame};
  return ask(user, ask_keep, &q) && q.answer;
}

static celspan_status write_file(void *user, celspan_context *context,
                                 const celspan_frame_desc *desc, const char *path,
                                 const celspan_file_desc *file) {
  const run *r = user;
  const cs_page page = {.frame = desc, .path = path, .file = file};
  return r->row->write(context, r->into.request, r->row, &page);
}

static bool tick(void *user, double share) {
  const run *r = user;
  return cs_progress_tick(&r->session->progress, share);
}

static void report_frame(const run *r, const cs_shoot_frame *frame) {
  const char *path = r->into.path;
  const char *destination = !path                             ? "hashed"
                            : r->outlet && r->outlet->is_file ? path
                            : r->outlet                       ? "standard output"
                                                              : frame->path;
  if (r->has_digests)
    printf("%" PRId64 " %016" PRIx64 "%016" PRIx64 "\n", frame->number, frame->digest[0],
           frame->digest[1]);
  cs_progress_frame(&r->session->progress, frame->number, destination, ways[frame->way]);
}

static celspan_status finished(void *user, const cs_shoot_frame *frame, celspan_status status) {
  run *r = user;
  question q = {.frame = (void *)(uintptr_t)frame};
  if (!r->tells)
    return status;
  q.code = (int)cs_report_frame_failure(r->into.script->context, status, frame->number);
  if (!ask(r, ask_finished, &q))
    return CELSPAN_CANCELLED;
  if (q.end < 0)
    report_frame(r, frame);
  r->ended = q.end > 0 ? q.end : 0;
  return r->ended == 0 ? CELSPAN_OK : status == CELSPAN_OK ? CELSPAN_CANCELLED : status;
}

/* ---------------------------------------------------------------- the run */

static celspan_file_desc describe_file(run *r) {
  celspan_file_desc file = cs_target_file(r->into.request, &r->coding);
  bool is_strip = cs_request_has(r->into.request, "--strip");
  file.strip_row = is_strip ? r->view.crop_y : 0;
  file.strip_height = is_strip ? r->view.height : 0;
  return file;
}

static celspan_status run_shoot(run *r) {
  const cs_outlet *outlet = r->outlet;
  cs_shoot shoot = {.context = r->into.script->context,
                    .film = r->into.script->film,
                    .frames = &r->frames,
                    .pattern = outlet ? NULL : r->into.path,
                    .frame = r->view,
                    .file = describe_file(r),
                    .has_digests = r->has_digests,
                    .keeps_going = cs_request_has(r->into.request, "--keep-going"),
                    .keeps_nothing = r->into.keeps_nothing,
                    .user = r,
                    .write = r->row->write ? write_file : NULL,
                    .hash = r->row->layers ? cs_apart_hash : NULL,
                    .keep = r->asks ? keep : NULL,
                    .build = build,
                    .finished = finished,
                    .tick = tick};
  if (outlet)
    shoot.put = outlet->put;
  if (outlet && outlet->slots)
    shoot.slots = outlet->slots(&r->into);
  if (shoot.slots > 0) {
    shoot.give = outlet->give;
    shoot.repeat = outlet->repeat;
  }
  return cs_shoot_run(&shoot);
}

/* Shoots, and gives the file of an outlet its name. */
static cs_exit shoot_into(run *r) {
  celspan_context *context = r->into.script->context;
  celspan_status status = run_shoot(r);
  cs_exit outcome = r->ended ? (cs_exit)r->ended : cs_report_failure(context, status, NULL);
  if (!r->outlet)
    return outcome;
  if (status != CELSPAN_OK) {
    r->outlet->discard(&r->into);
    return outcome;
  }
  context->contents = r->asks ? &r->contents : NULL;
  outcome = cs_report_failure(context, r->outlet->commit(&r->into), NULL);
  context->contents = NULL;
  return outcome;
}

static cs_exit shoot_all(run *r) {
  if (r->outlet)
    cs_service_require(r->L, r->outlet->open(&r->into));
  cs_progress_start(&r->session->progress, r->into.request, CS_PROGRESS_AUTO, r->frames.count);
  return shoot_into(r);
}

/* ---------------------------------------------------------------- opening */

/* The list of numbers that is a field of the table of the run, or none; it stays on the stack. */
static cs_sequence frames_of(lua_State *L, const char *name) {
  if (lua_getfield(L, TARGET, name) != LUA_TTABLE)
    return (cs_sequence){.count = 0};
  size_t count = lua_rawlen(L, -1);
  int64_t *frames = lua_newuserdatauv(L, (count + 1) * sizeof *frames, 0);
  for (size_t i = 0; i < count; i++, lua_pop(L, 1)) {
    lua_rawgeti(L, -2, (lua_Integer)i + 1);
    frames[i] = lua_tointeger(L, -1);
  }
  return (cs_sequence){.frames = frames, .count = count};
}

static bool has(lua_State *L, const char *name) {
  bool is_there = lua_getfield(L, TARGET, name) != LUA_TNIL;
  lua_pop(L, 1);
  return is_there;
}

static void *pointer_of(lua_State *L, const char *name) {
  lua_getfield(L, TARGET, name);
  void *pointer = lua_touserdata(L, -1);
  lua_pop(L, 1);
  return pointer;
}

/* Describes the frames, without their exposures. */
static cs_exit view_film(const cs_script *script, const cs_request *request,
                         celspan_frame_desc *out) {
  const cs_film_frame unknown = {0};
  CS_TRY_EXIT(cs_view_frame(request, script->film.width, script->film.height, out));
  cs_film_expose(&script->film, &unknown, out);
  return CS_EXIT_OK;
}

static bool keeps_nothing(const cs_request *request) {
  int32_t memory = 1;
  return cs_request_read(request, "--memory", &memory) && memory == 0;
}

static void open_run(lua_State *L, cs_script *script, run *r) {
  const cs_request *request = cs_service_session(L)->request;
  *r = (run){.L = L,
             .session = cs_service_session(L),
             .row = pointer_of(L, "row"),
             .outlet = pointer_of(L, "outlet"),
             .frames = frames_of(L, "numbers"),
             .played = frames_of(L, "played"),
             .asks = has(L, "keep"),
             .tells = has(L, "finished"),
             .change = cs_change_read(request),
             .has_digests = cs_request_has(request, "--hash"),
             .into = {.script = script,
                      .request = request,
                      .path = cs_service_text(L, "path"),
                      .chapters = cs_service_text(L, "chapters"),
                      .captions = cs_service_text(L, "captions"),
                      .keeps_nothing = keeps_nothing(request)}};
  r->into.frame = &r->view;
  r->into.frames = &r->frames;
  r->into.played = r->played.count ? &r->played : &r->frames;
  cs_service_require(L, view_film(script, request, &r->view));
}

/* script:shoot{ row =, outlet =, path =, numbers =, played =, chapters =, captions =, keep =,
 * finished = } -> the exit code of the run, whose failure is reported; the bytes and the hash of
 * the file of an outlet.
 *
 *   keep(number, path, scene, inputs)   -> whether the file of the frame is kept, whether it shows
 *                                       the same, its digest; scene: nil where a procedure draws
 *   finished(number, code, how, seconds, bytes, contents, digest)
 *                                       -> nil; 0: the frame failed, and the run continues; or the
 *                                       exit code of the run, which ends. code: 0, or the exit
 *                                       code of the frame, which has failed and is reported. how:
 *                                       "made", "copied" or "kept"
 *
 * Hashes and digests are texts of hexadecimal digits. Without `finished`, frames are only built for
 * `keep`, and nothing is reported. */
static int shoot(lua_State *L) {
  cs_script *script = cs_service_opened(L);
  run r;
  luaL_checktype(L, TARGET, LUA_TTABLE);
  open_run(L, script, &r);
  luaL_checkstack(L, 8, "too many frames");
  int outcome = r.tells ? (int)shoot_all(&r) : (int)cs_report_exit(run_shoot(&r));
  if (r.has_raised)
    return lua_error(L);
  lua_pushinteger(L, outcome);
  lua_pushinteger(L, (lua_Integer)r.contents.bytes);
  cs_service_push_hash(L, r.contents.hash);
  return 3;
}

/* ---------------------------------------------------------------- the target */

/* script:target(path or nil, count) -> { row =, outlet =, holds_all =, is_video = } for
 * script:shoot, and of a video { format =, captions_form =, poster = "attached" or "beside",
 * runs_ffmpeg = }. Ends the verb if that many frames cannot be written there. */
static int target(lua_State *L) {
  const cs_script *script = cs_service_opened(L);
  const cs_session *session = cs_service_session(L);
  const cs_request *request = session->request;
  const char *path = luaL_optstring(L, 2, NULL);
  const size_t count = (size_t)luaL_checkinteger(L, 3);
  celspan_frame_desc view;
  cs_service_require(L, cs_output_refuse(session->context, request, path, count));
  const cs_output *row = cs_output_of(request, path, count);
  bool is_file = row->holds == CS_HOLDS_EITHER && (count == 1 || !cs_output_is_whole(row, path));
  const cs_outlet *outlet = is_file ? NULL : row->outlet;
  lua_newtable(L);
  lua_pushlightuserdata(L, (void *)(uintptr_t)row);
  lua_setfield(L, -2, "row");
  if (outlet)
    lua_pushlightuserdata(L, (void *)(uintptr_t)outlet);
  else
    lua_pushnil(L);
  lua_setfield(L, -2, "outlet");
  cs_put_flag(L, "holds_all", outlet && outlet->is_file);
  cs_put_flag(L, "is_video", outlet == &cs_outlet_video);
  if (outlet == &cs_outlet_video) {
    cs_service_require(L, view_film(script, request, &view));
    cs_service_require(L, cs_video_target_refuse_frames(script, request, &view));
    cs_video_target_put(L, request);
  }
  return 1;
}

/* script:write_poster(path) -> the exit code: writes the frame that stands for the film. */
static int write_poster(lua_State *L) {
  cs_script *script = cs_service_opened(L);
  const cs_request *request = cs_service_session(L)->request;
  celspan_frame_desc view;
  cs_service_require(L, view_film(script, request, &view));
  lua_pushinteger(L, cs_video_target_write_poster(script, request, &view, luaL_checkstring(L, 2)));
  return 1;
}

/* ---------------------------------------------------------------- keys */

/* script:key(has_view) -> a text of all that the view and the coding of the request say of a frame.
 * has_view: frames are drawn */
static int key(lua_State *L) {
  const cs_script *script = cs_service_opened(L);
  const cs_request *request = cs_service_session(L)->request;
  const celspan_coding coding = cs_target_coding(request);
  const celspan_filter_desc none = CELSPAN_FILTER_DESC;
  celspan_frame_desc view = CELSPAN_FRAME_DESC;
  char text[KEY_SIZE];
  if (lua_toboolean(L, 2))
    cs_service_require(L, view_film(script, request, &view));
  const celspan_filter_desc *filter = view.filter ? view.filter : &none;
  snprintf(text, sizeof text,
           "%d %d of %.17g %.17g, %d %d %d %d, space %d, antialias %d %d, filter %d %d %d %.17g, "
           "coding %d %d %d %s",
           view.width, view.height, view.film_width, view.film_height, view.crop_x, view.crop_y,
           view.crop_width, view.crop_height, (int)view.space, view.has_antialias,
           (int)view.antialias, (int)filter->kernel, filter->rows, filter->has_radius,
           filter->radius, (int)coding.depth, (int)coding.transfer, (int)coding.alpha,
           request->spaces ? request->spaces->digest : "");
  lua_pushstring(L, text);
  return 1;
}

/* script:sounds_key() -> the hash of the sounds of the film, and of their files as they are now */
static int sounds_key(lua_State *L) {
  cs_script *script = cs_service_opened(L);
  cs_hash hash = cs_hash_begin(0);
  cs_service_try(L, cs_soundtrack_hash(script, &hash));
  cs_service_push_hash(L, cs_hash_end(hash));
  return 1;
}

/* ---------------------------------------------------------------- the sound */

/* script:stems() -> for each sound the name of the part of the mix that it belongs to */
static int stems(lua_State *L) {
  cs_script *script = cs_service_opened(L);
  cs_heard track;
  cs_service_try(L, cs_soundtrack_read(script, &track));
  lua_createtable(L, (int)track.count, 0);
  for (size_t i = 0; i < track.count; i++) {
    lua_pushstring(L, track.sounds[i].stem);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  return 1;
}

/* Writes the samples, and closes their stream. */
static celspan_status write_wave(celspan_context *context, const char *path,
                                 cs_sound_stream *samples, int64_t moments, bool is_float,
                                 double *peak) {
  celspan_status status = cs_wave_file_write(context, path, samples, moments, is_float, peak);
  context->contents = NULL;
  cs_sound_stream_close(samples);
  return status;
}

/* script:write_sound{ path =, numbers =, depth = "16" or "float", stem =, gain = } -> the greatest
 * magnitude of a sample, the gain of --loudness, the bytes of the file and their hash. Without
 * `stem`, all sounds are heard; without `gain` it is found. Ends the verb if it fails. */
static int write_sound(lua_State *L) {
  cs_script *script = cs_service_opened(L);
  const cs_request *request = cs_service_session(L)->request;
  const char *path = cs_service_text(L, "path"), *stem = cs_service_text(L, "stem");
  bool is_float = strcmp(cs_service_text(L, "depth"), "float") == 0;
  const cs_sequence frames = frames_of(L, "numbers");
  cs_file_contents contents = {.bytes = 0};
  cs_sound_stream samples;
  int64_t moments;
  lua_getfield(L, TARGET, "gain");
  double peak = 0, gain = luaL_optnumber(L, -1, -1);
  const cs_stem part = {stem, &gain};
  cs_service_require(
      L, cs_soundtrack_open(script, request, &frames, stem ? &part : NULL, &samples, &moments));
  script->context->contents = cs_request_has(request, "--resume") ? &contents : NULL;
  cs_service_try(L, write_wave(script->context, path, &samples, moments, is_float, &peak));
  lua_pushnumber(L, peak);
  lua_pushnumber(L, gain);
  lua_pushinteger(L, (lua_Integer)contents.bytes);
  cs_service_push_hash(L, contents.hash);
  return 4;
}

const luaL_Reg cs_methods_shooting[] = {
    CS_SERVICE(target),     CS_SERVICE(shoot), CS_SERVICE(write_poster), CS_SERVICE(key),
    CS_SERVICE(sounds_key), CS_SERVICE(stems), CS_SERVICE(write_sound),  {NULL, NULL}};
