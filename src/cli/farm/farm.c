/* celspan farm SCRIPT -o OUT --slurm|--openjd: a job for a render farm.
 *
 *   what render would refuse --> how many tasks --farm.lua--> a text on standard output
 *
 * INVARIANT: the tasks of a job run `celspan render` with the options of the request as they were
 * given, and a part of the frames, or of the frame, each; so all that can be known to fail on a farm
 * fails here.
 */
#include <errno.h>
#include <lauxlib.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/context.h"
#include "bind/lua_error.h"
#include "cli/desk/desk.h"
#include "cli/script.h"
#include "cli/target.h"
#include "cli/verbs.h"
#include "cli/video/video.h"
#include "cli/view.h"

enum {
  CHUNK = 10,         /* frames of a task */
  STRIPS_MOST = 1000, /* which one command can join */
  ARRAY_MOST = 1000   /* the tasks of an array that Slurm takes, unless it is told otherwise */
};

typedef struct farm_job {
  const cs_request *request;
  char folder[4096];
  char output[4096];
  size_t frames, tasks;
  cs_exit outcome;
} farm_job;

/* ---------------------------------------------------------------- what is asked for */

static cs_exit refuse_engine(const cs_request *request) {
  if (request->slurm == request->openjd)
    return cs_report_usage("for which farm? give --slurm or --openjd, one of them");
  if (request->chunk.is_given && request->strips.is_given)
    return cs_report_usage("--chunk divides a film and --strips a frame: give one of them");
  if (request->strips.is_given && request->strips.value > STRIPS_MOST)
    return cs_report_usage("--strips %d: at most %d strips can be joined at once",
                           request->strips.value, STRIPS_MOST);
  return CS_EXIT_OK;
}

/* The request of a task. */
static cs_request request_of_task(const cs_request *request) {
  cs_request task = *request;
  if (request->strips.is_given)
    task.strip[0] = task.strip[1] = request->strips.value;
  return task;
}

static cs_exit refuse(celspan_context *context, const cs_request *request) {
  if (!request->output)
    return cs_report_usage("where to? give -o shot.####.png, as for render");
  cs_exit outcome = refuse_engine(request);
  if (outcome != CS_EXIT_OK)
    return outcome;
  if (cs_target_is_stream(request->output) || cs_video_is_wanted(request, 1))
    return cs_report_usage("a farm makes files of frames: give -o shot.####.png (and make a video "
                           "of them)");
  cs_request task = request_of_task(request);
  return cs_target_refuse(context, request->output, &task);
}

/* ---------------------------------------------------------------- the tasks */

static cs_exit count_strips(cs_script *script, farm_job *job, const cs_sequence *frames) {
  celspan_frame_desc frame;
  cs_request task = request_of_task(job->request);
  if (frames->count != 1)
    return cs_report_usage("--strips divides one frame, and there are %zu: name it with --frames",
                           frames->count);
  job->tasks = (size_t)job->request->strips.value;
  celspan_status status = cs_sequence_name(script->context, job->request->output, frames->frames[0],
                                           job->output, sizeof job->output);
  cs_exit outcome = cs_report_failure(script->context, status, NULL);
  return outcome == CS_EXIT_OK
             ? cs_view_frame(&task, script->film.width, script->film.height, &frame)
             : outcome;
}

static cs_exit count_chunks(cs_script *script, farm_job *job, const cs_sequence *frames) {
  celspan_frame_desc frame;
  const cs_request *request = job->request;
  size_t chunk = request->chunk.is_given ? (size_t)request->chunk.value : CHUNK;
  job->tasks = (frames->count + chunk - 1) / chunk;
  int length = snprintf(job->output, sizeof job->output, "%s", request->output);
  if (length >= (int)sizeof job->output)
    return cs_report_usage("%.80s...: the name is too long", request->output);
  return cs_view_frame(request, script->film.width, script->film.height, &frame);
}

static cs_exit count_tasks(cs_script *script, farm_job *job) {
  cs_sequence frames = {0};
  cs_exit outcome = cs_target_frames(script, job->request, &frames);
  job->frames = frames.count;
  if (outcome == CS_EXIT_OK)
    outcome = job->request->strips.is_given ? count_strips(script, job, &frames)
                                            : count_chunks(script, job, &frames);
  cs_sequence_finish(&frames);
  return outcome;
}

static cs_exit read_film(celspan_context *context, farm_job *job) {
  cs_script script;
  cs_exit outcome = cs_script_open(context, job->request, &script);
  if (outcome == CS_EXIT_OK)
    outcome = count_tasks(&script, job);
  cs_script_close(&script);
  return outcome;
}

/* ---------------------------------------------------------------- the text */

static void set_text(lua_State *L, const char *name, const char *text) {
  lua_pushstring(L, text);
  lua_setfield(L, -2, name);
}

static void set_integer(lua_State *L, const char *name, bool is_given, int64_t number) {
  if (!is_given)
    return;
  lua_pushinteger(L, number);
  lua_setfield(L, -2, name);
}

static void set_options(lua_State *L, const cs_request *request) {
  lua_createtable(L, (int)request->passed_count, 0);
  for (size_t i = 0; i < request->passed_count; i++) {
    lua_createtable(L, 0, 2);
    set_text(L, "name", request->passed[i].name);
    set_text(L, "value", request->passed[i].value);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  lua_setfield(L, -2, "options");
  lua_createtable(L, (int)request->script_argument_count, 0);
  for (size_t i = 0; i < request->script_argument_count; i++) {
    lua_pushstring(L, request->script_arguments[i]);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  lua_setfield(L, -2, "arguments");
}

static void push_job(lua_State *L, const farm_job *job) {
  const cs_request *request = job->request;
  lua_newtable(L);
  set_text(L, "engine", request->slurm ? "slurm" : "openjd");
  set_text(L, "script", request->operands[0]);
  set_text(L, "output", job->output);
  set_text(L, "folder", job->folder);
  set_text(L, "name", request->name);
  set_text(L, "logs", request->logs);
  set_text(L, "version", celspan_version());
  set_integer(L, "tasks", true, (int64_t)job->tasks);
  set_integer(L, "frames", true, (int64_t)job->frames);
  set_integer(L, "workers", request->workers > 0, request->workers);
  set_integer(L, "memory", request->task_memory.is_given, request->task_memory.value);
  set_integer(L, "minutes", request->task_minutes.is_given, request->task_minutes.value);
  lua_pushboolean(L, request->strips.is_given);
  lua_setfield(L, -2, "strips");
  set_options(L, request);
}

/* Light userdata: the job. Runs protected. */
static int put(lua_State *L) {
  farm_job *job = lua_touserdata(L, 1);
  size_t size;
  push_job(L, job);
  cs_desk_call(L, cs_farm_text, "@celspan/farm/farm.lua", 1, 2);
  const char *text = lua_tolstring(L, -2, &size);
  if (text)
    fwrite(text, 1, size, stdout); /* failures are found when standard output is closed */
  else
    job->outcome = cs_report_usage("%s", lua_tostring(L, -1));
  return 0;
}

static cs_exit write_job(celspan_context *context, farm_job *job) {
  cs_script script;
  cs_exit outcome = cs_script_start(context, &script);
  if (outcome == CS_EXIT_OK) {
    lua_pushcfunction(script.L, put);
    lua_pushlightuserdata(script.L, job);
    int raised = cs_lua_error_call(script.L, 1, 0);
    outcome = raised == LUA_OK
                  ? job->outcome
                  : cs_report_failure(context, cs_lua_error_report(script.L, raised), NULL);
  }
  cs_script_close(&script);
  return outcome;
}

cs_exit cs_verb_farm(celspan_context *context, const cs_request *request) {
  farm_job job = {.request = request};
  cs_exit outcome = refuse(context, request);
  if (outcome == CS_EXIT_OK && !getcwd(job.folder, sizeof job.folder)) {
    cs_report_error("the current folder has no name: %s", strerror(errno));
    return CS_EXIT_INPUT;
  }
  if (outcome == CS_EXIT_OK)
    outcome = read_film(context, &job);
  if (outcome == CS_EXIT_OK)
    outcome = write_job(context, &job);
  if (outcome == CS_EXIT_OK && request->slurm && job.tasks > ARRAY_MOST)
    cs_report_note("%zu tasks: Slurm takes arrays of %d unless MaxArraySize is set higher; with "
                   "--chunk there are fewer",
                   job.tasks, ARRAY_MOST);
  return outcome;
}
