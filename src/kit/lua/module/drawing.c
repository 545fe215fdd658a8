/* Drawings read from SVG: the functions behind lua/celspan/read/svg.lua.
 *
 *   native.read_svg(path, fonts, space, move) -> drawing | nil, message
 *   native.parse_svg(text, name) -> drawing | nil, message
 *   fonts: nil, or a list of { family, file, where it was looked for in vain }
 *   drawing:object(), :seconds(), :size(), :parts(), :skipped(), :key(), :with(functions by name),
 *   :at(seconds, move) -> drawing | nil, message
 *   move: moves the drawing to a time (mover.h)
 *
 * INVARIANT: functions of the script run protected, so that memory of the core is released when
 * they raise errors.
 */
#include "lua/module/native.h"

#include <lauxlib.h>
#include <stdlib.h>
#include <string.h>

#include "celspan/svg.h"
#include "inside/colour.h"
#include "lua/bind/bare.h"
#include "lua/bind/form.h"
#include "lua/bind/host.h"
#include "lua/bind/named.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "lua/module/mover.h"
#include "lua/nouns/shape.h"
#include "readers/svg/document/art.h"
#include "readers/svg/read.h"

#define METATABLE "celspan.drawing"

typedef struct drawing {
  celspan_svg *svg; /* NULL: closed */
} drawing;

/* ---------------------------------------------------------------- objects of drawings */

static const cs_noun object_noun = {.name = "drawing", .kind = &cs_kind_object, CS_BARE};

/* Pushes a value that keeps the object. */
static void push_object(lua_State *L, celspan_object *object) {
  cs_bare_push(L, &object_noun)->handle = celspan_object_ref(object);
}

/* ---------------------------------------------------------------- drawings */

static drawing *push_drawing(lua_State *L) {
  drawing *made = lua_newuserdatauv(L, sizeof *made, 0);
  made->svg = NULL;
  luaL_setmetatable(L, METATABLE);
  return made;
}

/* The drawing as the result of a call; or nil, and the message of the failure. Raises the error of
 * the function that moves the drawing. */
static int answer(lua_State *L, const drawing *made, const cs_mover *mover, celspan_status status) {
  if (status == CELSPAN_CALLBACK && mover->failure > 0) {
    lua_pushvalue(L, mover->failure);
    return lua_error(L);
  }
  if (status != CELSPAN_OK)
    return cs_host_fail_input(L, status);
  for (const cs_svg_named *one = made->svg->named; one; one = one->next)
    cs_host_remember(L, one->path);
  return 1;
}

static celspan_svg *self(lua_State *L) {
  return ((drawing *)luaL_checkudata(L, 1, METATABLE))->svg;
}

static int release(lua_State *L) {
  drawing *value = luaL_checkudata(L, 1, METATABLE);
  celspan_svg_unref(value->svg);
  value->svg = NULL;
  return 0;
}

/* A drawing that is kept has its own key as long as it lives. */
static int key(lua_State *L) {
  lua_pushlightuserdata(L, self(L));
  return 1;
}

static int object(lua_State *L) {
  push_object(L, celspan_svg_object(self(L)));
  return 1;
}

static int size(lua_State *L) {
  celspan_point corner = celspan_svg_size(self(L));
  lua_pushnumber(L, corner.x);
  lua_pushnumber(L, corner.y);
  return 2;
}

/* nil: it does not move. */
static int seconds(lua_State *L) {
  double whole = self(L)->seconds;
  if (whole > 0)
    lua_pushnumber(L, whole);
  else
    lua_pushnil(L);
  return 1;
}

/* drawing, seconds, move -> drawing | nil, message */
static int at(lua_State *L) {
  celspan_svg *svg = self(L);
  double time = luaL_checknumber(L, 2);
  lua_settop(L, 3);
  const cs_svg_clock clock = {cs_mover_run, cs_mover_push(L, 3)};
  celspan_context *context = cs_host_context(L);
  drawing *made = push_drawing(L);
  cs_named_begin(L, context);
  celspan_status status = cs_svg_at(context, svg, &clock, time, &made->svg);
  cs_named_end(context);
  return answer(L, made, clock.user, status);
}

static int parts(lua_State *L) {
  const celspan_svg *svg = self(L);
  size_t count = celspan_svg_part_count(svg);
  lua_createtable(L, 0, (int)count);
  for (size_t i = 0; i < count; i++) {
    const char *name;
    celspan_object *part = celspan_svg_part(svg, i, &name);
    push_object(L, part);
    lua_setfield(L, -2, name);
  }
  return 1;
}

/* light userdata: an element; then the list. Runs protected. */
static int add_element(lua_State *L) {
  const celspan_svg_element *element = lua_touserdata(L, 1);
  lua_createtable(L, 0, 9);
  cs_put_text(L, "name", element->name);
  cs_put_text(L, "tag", element->tag);
  cs_put_text(L, "id", element->id);
  cs_put_text(L, "label", element->label);
  cs_put_text(L, "class", element->classes);
  cs_put_text(L, "fill", element->fill);
  cs_put_integer(L, "line", element->line);
  cs_put_integer(L, "depth", element->depth);
  push_object(L, element->object);
  lua_setfield(L, -2, "object");
  lua_rawseti(L, 2, (lua_Integer)lua_rawlen(L, 2) + 1);
  return 0;
}

static celspan_status visit(void *user, const celspan_svg_element *element) {
  lua_State *L = user;
  lua_pushcfunction(L, add_element);
  lua_pushlightuserdata(L, (void *)(size_t)element);
  lua_pushvalue(L, 2);
  if (lua_pcall(L, 2, 0, 0) == LUA_OK)
    return CELSPAN_OK;
  lua_pop(L, 1); /* memory is missing */
  return CELSPAN_NO_MEMORY;
}

/* elements() -> { { name =, tag =, id =, label =, class =, fill =, line =, depth =, object = },
 * ... } */
static int elements(lua_State *L) {
  const celspan_svg *svg = self(L);
  lua_settop(L, 1);
  lua_newtable(L);
  luaL_checkstack(L, 8, "elements");
  cs_host_try(L, "svg", celspan_svg_elements(cs_host_context(L), svg, visit, L));
  return 1;
}

static int skipped(lua_State *L) {
  const celspan_svg *svg = self(L);
  size_t count = celspan_svg_skipped_count(svg);
  lua_createtable(L, (int)count, 0);
  for (size_t i = 0; i < count; i++) {
    int32_t line;
    const char *what = celspan_svg_skipped(svg, i, &line);
    lua_createtable(L, 0, 2);
    cs_put_integer(L, "line", line);
    cs_put_text(L, "what", what);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  return 1;
}

/* ---------------------------------------------------------------- changed parts */

/* One function of the table of changes, and the state to call it in. */
typedef struct changer {
  lua_State *L;
  const char *name; /* the table keeps it alive */
  /* the index of the error that the function raised, which is left on the stack; 0: none */
  int failure;
} changer;

typedef struct call {
  changer *changer;
  celspan_object *part, *out; /* out: new */
} call;

/* Argument 1: a call, as light userdata; 2: the table of functions. Runs protected. */
static int call_function(lua_State *L) {
  call *c = lua_touserdata(L, 1);
  lua_getfield(L, 2, c->changer->name);
  push_object(L, c->part);
  lua_call(L, 1, 1);
  const cs_userdata *made = cs_shape_at(L, -1);
  if (!made)
    return luaL_error(L, "svg: the function of part '%s' must return an object, got %s",
                      c->changer->name, cs_userdata_type(L, -1));
  c->out = celspan_object_ref(made->handle);
  return 0;
}

static celspan_status change(void *user, celspan_context *context, celspan_object *part,
                             celspan_object **out) {
  changer *by = user;
  lua_State *L = by->L;
  call c = {by, part, NULL};
  if (!lua_checkstack(L, 8))
    return celspan_context_fail(context, CELSPAN_LIMIT, "svg: Lua's stack is full");
  lua_pushcfunction(L, call_function);
  lua_pushlightuserdata(L, &c);
  lua_pushvalue(L, 2);
  if (lua_pcall(L, 2, 0, 0) != LUA_OK) {
    by->failure = lua_gettop(L);
    return celspan_context_fail(context, CELSPAN_CALLBACK, "svg: the function of part '%s' failed",
                                by->name);
  }
  *out = c.out;
  return CELSPAN_OK;
}

static int compare_names(const void *a, const void *b) {
  return strcmp(((const changer *)a)->name, ((const changer *)b)->name);
}

/* The changes of the table at 2, in the order of their names. Scratch memory, left on the stack. */
static celspan_svg_changed *read_changes(lua_State *L, size_t *count) {
  *count = 0;
  for (lua_pushnil(L); lua_next(L, 2); lua_pop(L, 1))
    ++*count;
  changer *changers = cs_form_scratch(L, *count + 1, sizeof *changers);
  celspan_svg_changed *changes = cs_form_scratch(L, *count + 1, sizeof *changes);
  size_t i = 0;
  for (lua_pushnil(L); lua_next(L, 2); lua_pop(L, 1))
    changers[i++] = (changer){L, lua_tostring(L, -2), 0};
  qsort(changers, *count, sizeof *changers, compare_names);
  for (i = 0; i < *count; i++)
    changes[i] = (celspan_svg_changed){changers[i].name, change, &changers[i]};
  return changes;
}

/* drawing, functions by name -> drawing. svg.lua has checked that the names are strings and
 * parts. */
static int with(lua_State *L) {
  const celspan_svg *svg = self(L);
  lua_settop(L, 2);
  drawing *made = push_drawing(L);
  size_t count;
  const celspan_svg_changed *changes = read_changes(L, &count);
  celspan_status status = celspan_svg_with(cs_host_context(L), svg, changes, count, &made->svg);
  for (size_t i = 0; i < count && status == CELSPAN_CALLBACK; i++) {
    const changer *by = changes[i].user;
    if (by->failure > 0) {
      lua_pushvalue(L, by->failure);
      return lua_error(L);
    }
  }
  cs_host_try(L, "svg", status);
  lua_settop(L, 3);
  return 1;
}

/* ---------------------------------------------------------------- reading */

/* The string at `place` of the entry on top of the stack, which keeps it alive; NULL: none. */
static const char *entry_string(lua_State *L, int place) {
  lua_rawgeti(L, -1, place);
  const char *text = lua_tostring(L, -1);
  lua_pop(L, 1);
  return text;
}

/* The list at 2. svg.lua has checked that its entries are strings. Scratch memory, left on the
 * stack. */
static const celspan_svg_font *read_fonts(lua_State *L, size_t *count) {
  *count = lua_istable(L, 2) ? (size_t)lua_rawlen(L, 2) : 0;
  celspan_svg_font *fonts = cs_form_scratch(L, *count + 1, sizeof *fonts);
  for (size_t i = 0; i < *count; i++) {
    lua_rawgeti(L, 2, (lua_Integer)i + 1);
    fonts[i] = (celspan_svg_font){entry_string(L, 1), entry_string(L, 2)};
    lua_pop(L, 1);
  }
  return fonts;
}

static int read(lua_State *L) {
  const char *path = luaL_checkstring(L, 1);
  lua_settop(L, 4);
  const cs_svg_clock clock = {cs_mover_run, cs_mover_push(L, 4)};
  cs_svg_options options = {.clock = &clock};
  if (!lua_isnil(L, 3))
    options.space =
        (celspan_space)(CELSPAN_SPACE_LINEAR + luaL_checkoption(L, 3, NULL, cs_space_words));
  options.fonts = read_fonts(L, &options.font_count);
  celspan_context *context = cs_host_context(L);
  drawing *made = push_drawing(L);
  cs_named_begin(L, context);
  celspan_status status = cs_svg_read_file(context, path, &options, &made->svg);
  cs_named_end(context);
  return answer(L, made, clock.user, status);
}

/* A drawing that is a text, in "srgb", without fonts and as it is written. */
static int parse(lua_State *L) {
  celspan_svg_desc desc = CELSPAN_SVG_DESC;
  desc.bytes = luaL_checklstring(L, 1, &desc.size);
  desc.name = luaL_checkstring(L, 2);
  desc.space = CELSPAN_SPACE_SRGB;
  celspan_context *context = cs_host_context(L);
  drawing *made = push_drawing(L);
  cs_named_begin(L, context);
  celspan_status status = celspan_svg_read(context, &desc, &made->svg);
  cs_named_end(context);
  return status == CELSPAN_OK ? 1 : cs_host_fail_input(L, status);
}

void cs_drawing_open(lua_State *L) {
  static const luaL_Reg methods[] = {
      {"key", key},         {"object", object}, {"parts", parts},       {"size", size},
      {"skipped", skipped}, {"with", with},     {"elements", elements}, {"seconds", seconds},
      {"at", at},           {NULL, NULL}};
  /* Even if it exists already: without memory it may be incomplete. */
  cs_mover_open(L);
  luaL_newmetatable(L, METATABLE);
  lua_pushcfunction(L, release);
  lua_setfield(L, -2, "__gc");
  luaL_newlib(L, methods);
  lua_setfield(L, -2, "__index");
  lua_pushliteral(L, METATABLE);
  lua_setfield(L, -2, "__metatable");
  lua_pop(L, 1);
  lua_pushcfunction(L, read);
  lua_setfield(L, -2, "read_svg");
  lua_pushcfunction(L, parse);
  lua_setfield(L, -2, "parse_svg");
}
