#include "lua/module/mover.h"

#include <lauxlib.h>
#include <string.h>

#include "lua/bind/put.h"

#define METATABLE "celspan.mover"

static cs_svg_mover *self(lua_State *L) {
  const cs_mover *m = luaL_checkudata(L, 1, METATABLE);
  luaL_argcheck(L, m->mover, 1, "the drawing has been read");
  return m->mover;
}

/* Raises an error unless the status, with which the reading ends, is OK. Argument 1 is a mover. */
static int done(lua_State *L, celspan_status status) {
  ((cs_mover *)lua_touserdata(L, 1))->status = status;
  return status == CELSPAN_OK ? 0 : luaL_error(L, "the drawing cannot be moved");
}

/* The animation whose number is argument 2. */
static const cs_svg_animation *animation_at(lua_State *L) {
  const cs_svg_mover *mover = self(L);
  lua_Integer number = luaL_checkinteger(L, 2);
  luaL_argcheck(L, number >= 1 && (size_t)number <= mover->count, 2, "there is no such animation");
  return &mover->animations[number - 1];
}

/* The same, if it has a target and an attribute. */
static const cs_svg_animation *moving_at(lua_State *L) {
  const cs_svg_animation *it = animation_at(L);
  luaL_argcheck(L, it->target && it->name != CS_SVG_NAME_COUNT, 2, "it moves no attribute");
  return it;
}

/* ---------------------------------------------------------------- what the document says */

/* target: false: it has no effect. */
static int animation(lua_State *L) {
  if (luaL_checkinteger(L, 2) > (lua_Integer)self(L)->count)
    return 0;
  const cs_svg_animation *it = animation_at(L);
  bool is_motion = it->node->element == CS_SVG_ELEMENT_ANIMATE_MOTION;
  if (it->target && (is_motion || it->name != CS_SVG_NAME_COUNT))
    lua_pushinteger(L, it->target->number);
  else
    lua_pushboolean(L, false);
  lua_pushinteger(L, it->name);
  lua_pushstring(L, it->node->tag);
  return 3;
}

static int text(lua_State *L) {
  const cs_svg_cascade *styles = self(L)->styles;
  bool is_style = luaL_checkinteger(L, 2) == 0;
  const cs_svg_node *node = is_style ? NULL : animation_at(L)->node;
  int last = lua_gettop(L);
  luaL_argcheck(L, node || styles, 2, "no element is visited");
  luaL_checkstack(L, last, "many names");
  for (int i = 3; i <= last; i++) {
    cs_svg_name name = cs_svg_name_of(luaL_checkstring(L, i));
    luaL_argcheck(L, name != CS_SVG_NAME_COUNT, i, "no attribute");
    lua_pushstring(L, node ? cs_svg_node_value(node, name) : styles->values[name]);
  }
  return last - 2;
}

static int skip(lua_State *L) {
  const cs_svg_mover *mover = self(L);
  const char *what = luaL_checkstring(L, 3);
  if (luaL_checkinteger(L, 2) == 0)
    return done(L, cs_svg_skip(mover->reading, mover->node, "%s", what));
  const cs_svg_node *node = animation_at(L)->node;
  return done(L, cs_svg_skip(mover->reading, node, "%.40s: %s", node->tag, what));
}

static int refuse(lua_State *L) {
  celspan_context *context = self(L)->reading->context;
  return done(L, celspan_context_fail(context, CELSPAN_LIMIT, "%s", luaL_checkstring(L, 2)));
}

/* ---------------------------------------------------------------- elements that animate */

static cs_svg_end end_at(lua_State *L, int index) {
  lua_Integer how = luaL_checkinteger(L, index + 1);
  luaL_argcheck(L, how >= 0 && how <= CS_SVG_COMPOSITION_ACCUMULATE, index + 1, "no composition");
  return (cs_svg_end){luaL_optstring(L, index, NULL), (cs_svg_composition)how};
}

static int mix(lua_State *L) {
  cs_svg_animation it;
  const cs_svg_mixture mixture = {.share = luaL_checknumber(L, 4),
                                  .from = end_at(L, 5),
                                  .to = end_at(L, 7),
                                  .is_by = lua_toboolean(L, 9),
                                  .last = luaL_optstring(L, 10, NULL),
                                  .round = luaL_optnumber(L, 11, 0)};
  if (luaL_checkinteger(L, 2) > 0)
    it = *moving_at(L);
  else {
    it = (cs_svg_animation){self(L)->node, self(L)->node, cs_svg_name_of(luaL_checkstring(L, 3))};
    luaL_argcheck(L, self(L)->styles && it.name != CS_SVG_NAME_COUNT, 3, "no property");
  }
  return done(L, cs_svg_mover_mix(self(L), &it, &mixture));
}

static int distance(lua_State *L) {
  double found;
  bool mixes;
  done(L, cs_svg_mover_distance(self(L), moving_at(L), luaL_checkstring(L, 3),
                                luaL_checkstring(L, 4), &found, &mixes));
  if (!mixes)
    return 0;
  lua_pushnumber(L, found);
  return 1;
}

static int spot(lua_State *L) {
  cs_svg_spot found;
  done(L, cs_svg_mover_spot(self(L), animation_at(L), luaL_checknumber(L, 3), &found));
  const double numbers[] = {found.point.x, found.point.y, found.degrees, found.end.x, found.end.y};
  lua_pushboolean(L, found.has_line);
  for (int i = 0; found.is_there && i < 5; i++)
    lua_pushnumber(L, numbers[i]);
  return found.is_there ? 6 : 1;
}

static int place(lua_State *L) {
  const celspan_point point = {luaL_checknumber(L, 3), luaL_checknumber(L, 4)};
  const cs_svg_animation *it = animation_at(L);
  luaL_argcheck(L, it->target, 2, "it moves nothing");
  return done(L,
              cs_svg_mover_place(self(L), it, point, luaL_checknumber(L, 5), lua_toboolean(L, 6)));
}

/* ---------------------------------------------------------------- styles */

static celspan_status call_visited(void *user) {
  lua_State *L = user;
  lua_pushvalue(L, 2);
  lua_call(L, 0, 0);
  return CELSPAN_OK;
}

static int visit(lua_State *L) {
  luaL_checktype(L, 2, LUA_TFUNCTION);
  return done(L, cs_svg_mover_visit(self(L), call_visited, L));
}

static void push_frame(lua_State *L, const cs_css_frame *frame) {
  lua_Integer size = 0;
  lua_newtable(L);
  cs_put_number(L, "at", frame->at);
  for (size_t i = 0; i < frame->declarations.count; i++) {
    const cs_css_declaration *it = &frame->declarations.items[i];
    if (it->custom || it->is_important)
      continue;
    lua_pushstring(L, cs_svg_name_text(it->name));
    lua_rawseti(L, -2, ++size);
    lua_pushstring(L, it->value);
    lua_rawseti(L, -2, ++size);
  }
}

static int count(lua_State *L) {
  const cs_svg_mover *mover = self(L);
  luaL_argcheck(L, mover->node, 1, "no element is visited");
  return done(L, cs_svg_motion_count(mover->reading, mover->node, (size_t)luaL_checknumber(L, 2)));
}

/* Of frames with the same name the later ones win. */
static int frames(lua_State *L) {
  const cs_svg_mover *mover = self(L);
  const cs_css_sheet *sheet = &mover->reading->document->sheet;
  size_t rule = sheet->frames_count;
  luaL_argcheck(L, mover->styles, 1, "no element is visited");
  while (rule > 0 && strcmp(sheet->frames[rule - 1].name, luaL_checkstring(L, 2)) != 0)
    rule--;
  if (rule == 0)
    return 0;
  const cs_css_frames *found = &sheet->frames[rule - 1];
  done(L, cs_svg_motion_count(mover->reading, mover->node, found->size));
  lua_newtable(L);
  for (size_t i = 0; i < found->count; i++) {
    push_frame(L, &found->items[i]);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  lua_pushinteger(L, (lua_Integer)found->size);
  return 2;
}

/* ---------------------------------------------------------------- the clock */

void cs_mover_open(lua_State *L) {
  static const luaL_Reg methods[] = {
      {"animation", animation}, {"text", text},     {"skip", skip},
      {"refuse", refuse},       {"mix", mix},       {"distance", distance},
      {"spot", spot},           {"place", place},   {"visit", visit},
      {"count", count},         {"frames", frames}, {NULL, NULL}};
  /* Even if it exists already: without memory it may be incomplete. */
  luaL_newmetatable(L, METATABLE);
  luaL_newlib(L, methods);
  lua_setfield(L, -2, "__index");
  lua_pushliteral(L, METATABLE);
  lua_setfield(L, -2, "__metatable");
  lua_pop(L, 1);
}

cs_mover *cs_mover_push(lua_State *L, int function) {
  cs_mover *made = lua_newuserdatauv(L, sizeof *made, 0);
  *made = (cs_mover){.L = L, .function = function, .self = lua_gettop(L), .status = CELSPAN_OK};
  luaL_setmetatable(L, METATABLE);
  return made;
}

celspan_status cs_mover_run(void *user, cs_svg_mover *mover, double *seconds) {
  cs_mover *by = user;
  lua_State *L = by->L;
  celspan_context *context = mover->reading->context;
  if (!lua_checkstack(L, 8))
    return celspan_context_fail(context, CELSPAN_LIMIT, "svg: Lua's stack is full");
  by->mover = mover;
  by->status = CELSPAN_OK;
  lua_pushvalue(L, by->function);
  lua_pushvalue(L, by->self);
  if (mover->reading->seconds >= 0)
    lua_pushnumber(L, mover->reading->seconds);
  else
    lua_pushnil(L);
  lua_pushinteger(L, (lua_Integer)mover->reading->document->key.a);
  int outcome = lua_pcall(L, 3, 1, 0);
  by->mover = NULL;
  if (outcome == LUA_OK || by->status != CELSPAN_OK) {
    *seconds = lua_tonumber(L, -1);
    lua_pop(L, 1);
    return by->status;
  }
  by->failure = lua_gettop(L);
  return celspan_context_fail(context, CELSPAN_CALLBACK, "svg: the drawing cannot be moved");
}
