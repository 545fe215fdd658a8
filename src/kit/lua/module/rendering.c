/* celspan.render: a film or a rostrum into files. */

#include "inside/films.h"
#include "lua/bind/caller.h"
#include "lua/bind/host.h"
#include "lua/bind/lua_error.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"
#include "lua/nouns/lua_film.h"
#include "lua/nouns/options.h"

/* One run, in a userdata that frees the sequence. */
typedef struct job {
  lua_State *L;
  celspan_context *context;
  int film;     /* index on the stack */
  int progress; /* index on the stack; 0: none */
  cs_film_info info;
  cs_options options;
  celspan_file_desc file;
  const char *pattern;
  cs_sequence sequence;
  size_t done;
  double share;   /* reported last */
  bool has_error; /* the progress function raised an error, whose message is on top of the stack */
} job;

static int finish_job(lua_State *L) {
  cs_sequence_finish(&((job *)lua_touserdata(L, 1))->sequence);
  return 0;
}

static job *push_job(lua_State *L) {
  job *j = cs_userdata_push_holder(L, "celspan.job", sizeof *j, finish_job);
  j->L = L;
  j->context = cs_host_context(L);
  return j;
}

/* Reports which share of the whole job is done, and the first frame that is not done, or the last
 * frame. */
static bool report_progress(void *user, double share) {
  job *j = user;
  lua_State *L = j->L;
  size_t last = j->sequence.count - 1;
  share = ((double)j->done + share) / (double)j->sequence.count;
  j->share =
      /* the share never decreases, even if frames are given up */
      share > j->share ? share : j->share;
  if (!lua_checkstack(L, 8))
    return false;
  cs_lua_error_push_handler(L, "", cs_render_make);
  int handler = lua_gettop(L);
  lua_pushvalue(L, j->progress);
  lua_pushnumber(L, j->share);
  lua_pushinteger(L, j->sequence.frames[j->done < last ? j->done : last]);
  int outcome = lua_pcall(L, 2, 1, handler);
  lua_remove(L, handler);
  if (outcome != LUA_OK) {
    j->has_error = true;
    return false;
  }
  bool goes_on = !lua_isboolean(L, -1) || lua_toboolean(L, -1);
  lua_pop(L, 1);
  return goes_on;
}

static void read_progress(const cs_form *form, job *j) {
  int type = cs_form_get(form, "progress");
  if (type != LUA_TNIL && type != LUA_TFUNCTION)
    cs_form_fail(form, "field 'progress' must be a function, got %s",
                 cs_userdata_type(form->L, -1));
  if (type == LUA_TFUNCTION)
    j->progress = lua_gettop(form->L);
}

/* Pushes the film of argument 1. A rostrum becomes a film as large as the options say. */
static void read_film(lua_State *L, job *j) {
  const celspan_frame_desc *desc = &j->options.desc;
  bool is_film = cs_userdata_test(L, 1, &cs_kind_film) != NULL;
  if (is_film)
    lua_pushvalue(L, 1);
  else if (cs_userdata_test(L, 1, &cs_kind_rostrum))
    cs_lua_film_push_still(L, 1, desc->width, desc->height);
  else
    cs_caller_error(L, "render: argument 1 must be a film or a rostrum, got %s",
                    cs_userdata_type(L, 1));
  j->film = lua_gettop(L);
  cs_lua_film_read(L, j->film, &j->info);
  cs_options_use_film(&j->options, &j->info);
}

static celspan_status read_frames(const cs_form *form, job *j) {
  lua_State *L = form->L;
  int type = cs_form_get(form, "frames");
  if (type != LUA_TNIL && type != LUA_TSTRING && !lua_isinteger(L, -1))
    cs_form_fail(form,
                 "field 'frames' must be a list like \"1-10,20-30:2\", a mark or a whole number, "
                 "got %s",
                 cs_userdata_type(L, -1));
  celspan_status status =
      type == LUA_TNIL ? cs_sequence_count(j->context, j->info.first, j->info.count, &j->sequence)
                       : cs_sequence_parse(j->context, lua_tostring(L, -1), &j->info, &j->sequence);
  if (status == CELSPAN_OK)
    status = cs_sequence_within(j->context, &j->sequence, j->info.first, j->info.count);
  if (status == CELSPAN_OK && j->sequence.count > 1 && !cs_sequence_has_number(j->pattern))
    status = celspan_context_fail(j->context, CELSPAN_BAD_ARGUMENT,
                                  "\"%.200s\" has no place for a frame number, and there are "
                                  "%zu frames; write it like shot.####.png",
                                  j->pattern, j->sequence.count);
  return status;
}

static celspan_status build(void *user, int64_t number, cs_film_frame *out) {
  const job *j = user;
  return cs_lua_film_build(j->L, j->film, number, out);
}

static celspan_status finished(void *user, const cs_shoot_frame *frame, celspan_status status) {
  job *j = user;
  (void)frame;
  j->done += status == CELSPAN_OK;
  return status;
}

static celspan_status write_frames(job *j) {
  const cs_shoot shoot = {.context = j->context,
                          .film = j->info,
                          .frames = &j->sequence,
                          .pattern = j->pattern,
                          .frame = j->options.desc,
                          .file = j->file,
                          .user = j,
                          .build = build,
                          .finished = finished,
                          .tick = j->progress ? report_progress : NULL};
  return cs_shoot_run(&shoot);
}

int cs_render_make(lua_State *L) {
  lua_settop(L, 3);
  if (lua_type(L, 2) != LUA_TSTRING)
    return cs_caller_error(L,
                           "render: argument 2 must be a file name like \"shot.####.png\", got %s",
                           cs_userdata_type(L, 2));
  if (!cs_host_may_write(L, lua_tostring(L, 2)))
    return cs_host_fail(L, CELSPAN_CALLBACK);
  job *j = push_job(L);
  cs_options_read(L, &cs_noun_render, 3, &j->options);
  j->pattern = lua_tostring(L, 2);
  j->file = CELSPAN_FILE_DESC;
  j->file.coding = &j->options.coding;
  j->file.format = j->options.format;
  read_progress(&j->options.form, j);
  read_film(L, j);
  celspan_status status = read_frames(&j->options.form, j);
  lua_State *before = cs_host_enter(L);
  if (status == CELSPAN_OK)
    status = write_frames(j);
  cs_host_leave(L, before);
  if (status == CELSPAN_OK) {
    lua_pushboolean(L, true);
    return 1;
  }
  if (!j->has_error)
    return cs_host_fail(L, status);
  luaL_pushfail(L);
  lua_insert(L, -2);
  return 2;
}
