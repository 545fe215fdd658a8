/* Changes of a watched frame: it can be shown by the camera of another frame, without some cels,
 * without lights or defocus, or only with the objects that one line of the script made. And the
 * costs of each cel of the frame.
 *
 * INVARIANT: only the frame that was built last is changed; the next built frame is whole.
 */
#include <stdio.h>
#include <string.h>

#include "common/made.h"
#include "inside/clock.h"
#include "inside/scene.h"
#include "lua/bind/put.h"
#include "program/stage/stage.h"

enum { CELS_MOST = 256 };

static int fail(lua_State *L, const cs_script *script) {
  luaL_pushfail(L);
  lua_pushstring(L, celspan_context_error(script->context));
  return 2;
}

/* ---------------------------------------------------------------- cels in another way */

typedef struct alteration {
  lua_State *L; /* argument 2: letters by the labels of cels */
  celspan_context *context;
  bool is_cut;
} alteration;

/* The letters for a cel: in a shot of a cut from "shot/label", otherwise from its label.
 * Pushes them; "" if there are none. */
static const char *push_letters(const alteration *a, const celspan_rostrum *from, size_t i) {
  char room[CS_STAGE_LABEL];
  const char *label = cs_stage_label(from, i, room), *shot = cs_mark_name(from->mark);
  bool is_in_shot = a->is_cut && shot[0];
  if (is_in_shot) {
    lua_pushfstring(a->L, "%s/%s", shot, label);
    is_in_shot = lua_gettable(a->L, 2) == LUA_TSTRING;
    if (!is_in_shot)
      lua_pop(a->L, 1);
  }
  if (!is_in_shot && lua_getfield(a->L, 2, label) != LUA_TSTRING) {
    lua_pop(a->L, 1);
    lua_pushliteral(a->L, "");
  }
  return lua_tostring(a->L, -1);
}

static celspan_status alter_cel(void *user, const celspan_rostrum *from, size_t i,
                                celspan_cel **out);

/* *out: new; the cel with its shot altered. */
static celspan_status alter_part(alteration *a, const celspan_cel *cel, celspan_cel **out) {
  const celspan_object *whole = cel->objects[0];
  celspan_rostrum *part;
  celspan_object *plain = NULL, *placed = NULL, *faded = NULL;
  CS_TRY(cs_remake(a->context, whole->data->rostrum, alter_cel, a, &part));
  celspan_status status = celspan_object_create_rostrum(a->context, part, &plain);
  if (status == CELSPAN_OK)
    status = celspan_object_transform(a->context, plain, whole->matrix, &placed);
  if (status == CELSPAN_OK)
    status = celspan_object_fade(a->context, placed, whole->fade, &faded);
  if (status == CELSPAN_OK)
    status = cs_cel_with(a->context, cel, &faded, 1, out);
  celspan_object_unref(faded);
  celspan_object_unref(placed);
  celspan_object_unref(plain);
  celspan_rostrum_unref(part);
  return status;
}

/* Recursion ends: a shot is not looked for in a shot. */
static celspan_status alter_cel(void *user, const celspan_rostrum *from, size_t i,
                                celspan_cel **out) {
  alteration *a = user;
  *out = NULL;
  if (a->is_cut && !cs_mark_name(from->mark)[0] && cs_stage_part(from->cels[i]))
    return alter_part(a, from->cels[i], out);
  const char *letters = push_letters(a, from, i);
  const cs_cel_without without = {.lights = strchr(letters, 'l'), .defocus = strchr(letters, 'f')};
  bool is_hidden = strchr(letters, 'h');
  lua_pop(a->L, 1);
  return is_hidden ? CELSPAN_OK : cs_cel_bare(a->context, from->cels[i], without, out);
}

/* film:alter(letters, is_cut) -> true | nil, message. letters.ground, for example, changes the cel
 * with this label (stage_tree.c): h: the cel is hidden; l: its lights are replaced by white light;
 * f: it is in focus */
int cs_stage_alter(lua_State *L) {
  cs_script *script = cs_service_opened(L);
  alteration a = {L, script->context, lua_toboolean(L, 3)};
  luaL_checktype(L, 2, LUA_TTABLE);
  luaL_checkstack(L, 4, "too many values");
  if (cs_remake_exposures(script->context, script->frame.exposures, script->frame.count, alter_cel,
                          &a) != CELSPAN_OK)
    return fail(L, script);
  lua_pushboolean(L, true);
  return 1;
}

/* ---------------------------------------------------------------- cameras */

/* film:camera() -> the camera of the frame that was built last, as a text that is equal for equal
 * cameras; "none" without a camera */
int cs_stage_camera(lua_State *L) {
  cs_script *script = cs_service_opened(L);
  char text[128] = "none";
  const celspan_rostrum *r = script->frame.count ? script->frame.exposures[0].rostrum : NULL;
  if (r && (r->has_camera_centre || r->has_camera_width || r->camera_radians != 0))
    snprintf(text, sizeof text, "%d,%d,%.17g,%.17g,%.17g,%.17g", r->has_camera_centre,
             r->has_camera_width, r->camera_centre.x, r->camera_centre.y, r->camera_width,
             r->camera_radians);
  lua_pushstring(L, text);
  return 1;
}

/* film:use_camera() -> true | nil, message: shows the frame that was built last with the camera
 * that was kept. */
int cs_stage_use_camera(lua_State *L, cs_script *script, const celspan_rostrum *by) {
  for (size_t i = 0; i < script->frame.count && by; i++) {
    celspan_exposure *exposure = &script->frame.exposures[i];
    celspan_rostrum *changed;
    if (cs_rostrum_by_camera(script->context, exposure->rostrum, by, &changed) != CELSPAN_OK)
      return fail(L, script);
    celspan_rostrum_unref(exposure->rostrum);
    exposure->rostrum = changed;
  }
  lua_pushboolean(L, true);
  return 1;
}

/* ---------------------------------------------------------------- what a line made */

typedef struct kept {
  const char *source, *name, *label; /* NULL: of any name; in any cel */
  int32_t line;
} kept;

static bool is_kept(void *user, cs_mark mark) {
  const kept *k = user;
  return mark.line == k->line && mark.source && strcmp(mark.source, k->source) == 0 &&
         (!k->name || strcmp(cs_mark_name(mark), k->name) == 0);
}

static bool is_searched(void *user, const celspan_rostrum *from, size_t i) {
  const kept *k = user;
  char room[CS_STAGE_LABEL];
  return !k->label || cs_stage_part(from->cels[i]) ||
         strcmp(cs_stage_label(from, i, room), k->label) == 0;
}

/* film:keep_line(source, line, name or nil, label or nil) -> whether the line made anything in the
 * frame that was built last, of that name and in the cel of that label, which then shows only these
 * objects, in white light | nil, message */
int cs_stage_keep_line(lua_State *L) {
  cs_script *script = cs_service_opened(L);
  kept k = {.source = luaL_checkstring(L, 2),
            .line = (int32_t)luaL_checkinteger(L, 3),
            .name = luaL_optstring(L, 4, NULL),
            .label = luaL_optstring(L, 5, NULL)};
  cs_made m = {
      .context = script->context, .is_made = is_kept, .is_searched = is_searched, .user = &k};
  if (cs_made_keep(&m, script->frame.exposures, script->frame.count) != CELSPAN_OK)
    return fail(L, script);
  lua_pushboolean(L, m.is_any);
  return 1;
}

/* ---------------------------------------------------------------- costs */

typedef struct cost {
  double seconds;
  celspan_statistics of;
} cost;

static celspan_status measure(celspan_context *context, const celspan_frame_desc *desc, cost *out) {
  const celspan_sink nowhere = {.struct_size = sizeof nowhere, .row = NULL};
  out->of = CELSPAN_STATISTICS;
  double began = cs_clock_seconds();
  CS_TRY(celspan_frame_render(context, desc, &nowhere, &out->of));
  out->seconds = cs_clock_seconds() - began;
  return CELSPAN_OK;
}

static celspan_status keep_one(void *user, const celspan_rostrum *from, size_t i,
                               celspan_cel **out) {
  const size_t *wanted = user;
  *out = i == *wanted ? celspan_cel_ref(from->cels[i]) : NULL;
  return CELSPAN_OK;
}

static celspan_status measure_cel(celspan_context *context, const celspan_frame_desc *whole,
                                  size_t i, cost *out) {
  celspan_exposure alone = whole->exposures[0];
  celspan_frame_desc desc = *whole;
  CS_TRY(cs_remake(context, whole->exposures[0].rostrum, keep_one, &i, &alone.rostrum));
  desc.exposures = &alone;
  desc.exposure_count = 1;
  celspan_status status = measure(context, &desc, out);
  celspan_rostrum_unref(alone.rostrum);
  return status;
}

/* Calls the function that is argument 8 with a table of costs. */
static void give_cost(lua_State *L, const char *name, cs_mark mark, const cost *c) {
  celspan_origin origin = cs_mark_origin(mark);
  lua_pushvalue(L, 8);
  lua_createtable(L, 0, 10);
  cs_put_text(L, "name", name);
  cs_put_text(L, "file", origin.line > 0 ? origin.source : NULL);
  cs_put_integer(L, "line", origin.line);
  cs_put_number(L, "seconds", c->seconds);
  cs_put_integer(L, "bytes", (lua_Integer)c->of.peak_bytes);
  cs_put_integer(L, "single", (lua_Integer)c->of.single);
  cs_put_integer(L, "gradient", (lua_Integer)c->of.gradient);
  cs_put_integer(L, "array", (lua_Integer)c->of.array);
  cs_put_integer(L, "evaluations", (lua_Integer)c->of.colour_evaluations);
  lua_call(L, 1, 0);
}

/* film:costs(width, height, x, y, w, h, add) -> true | nil, message: calls add with the costs of
 * this part of the whole frame, then with the costs of each cel of its first exposure alone, for at
 * most CELS_MOST cels. */
int cs_stage_costs(lua_State *L) {
  cs_script *script = cs_service_opened(L);
  celspan_frame_desc desc;
  cost c;
  if (!cs_stage_frame(L, script, &desc))
    return 2;
  luaL_checktype(L, 8, LUA_TFUNCTION);
  if (measure(script->context, &desc, &c) != CELSPAN_OK)
    return fail(L, script);
  give_cost(L, "", (cs_mark){NULL, NULL, 0, 0}, &c);
  const celspan_rostrum *rostrum = desc.exposure_count > 0 ? desc.exposures[0].rostrum : NULL;
  for (size_t i = 0; rostrum && i < rostrum->cel_count && i < CELS_MOST; i++) {
    char label[CS_STAGE_LABEL];
    if (measure_cel(script->context, &desc, i, &c) != CELSPAN_OK)
      return fail(L, script);
    give_cost(L, cs_stage_label(rostrum, i, label), rostrum->cels[i]->mark, &c);
  }
  lua_pushboolean(L, true);
  return 1;
}
