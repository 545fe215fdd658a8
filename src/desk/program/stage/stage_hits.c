/* The objects at a point of a watched frame. */
#include <lauxlib.h>

#include "common/hits.h"
#include "lua/bind/named.h"
#include "lua/bind/put.h"
#include "program/stage/stage.h"

/* The function that is called is argument 4. */
typedef struct listener {
  lua_State *L;
  lua_State *script;
} listener;

/* Pushes the callers of the line where a value was made, or "". */
static void push_callers(const listener *t, cs_mark mark) {
  cs_named_push_callers(t->script, mark.callers);
  lua_pushstring(t->L, lua_tostring(t->script, -1));
  lua_pop(t->script, 1);
}

/* Pushes a light: its red, green and blue, or "texture". */
static void push_light(lua_State *L, const cs_light *light) {
  const double channels[] = {light->flat.r, light->flat.g, light->flat.b};
  if (light->texture) {
    lua_pushliteral(L, "texture");
    return;
  }
  cs_push_numbers(L, channels, 3);
}

static void add_hit(void *user, const cs_hit *hit) {
  const listener *t = user;
  lua_State *L = t->L;
  const celspan_object *object = hit->object;
  celspan_origin origin = cs_mark_origin(hit->mark);
  lua_pushvalue(L, 4);
  lua_createtable(L, 0, 13);
  cs_put_text(L, "kind", object ? "object" : "cel");
  cs_put_integer(L, "depth", hit->depth);
  if (object && object->data->kind == CS_PRIMITIVE_DATA_OUTLINE)
    cs_put_text(L, "form", object->data->stroke ? "stroke" : "fill");
  cs_put_text(L, "shot", hit->part && hit->part[0] ? hit->part : NULL);
  cs_put_number(L, "share", hit->share);
  cs_put_text(L, "name", cs_mark_name(hit->mark));
  cs_put_text(L, "file", origin.line > 0 ? origin.source : NULL);
  if (origin.line > 0)
    cs_put_integer(L, "line", origin.line);
  cs_put_number(L, "opacity", hit->opacity);
  push_callers(t, hit->mark);
  lua_setfield(L, -2, "callers");
  push_light(L, hit->light);
  lua_setfield(L, -2, object ? "paint" : "light");
  lua_call(L, 1, 0);
}

/* film:hits(x, y, add, is_cut) -> nil | message: calls add({ kind =, depth =, name =, shot =,
 * share =, file =, line =, callers =, opacity =, light =, form =, paint = }) for each object and
 * cel that covers the point in the frame that was built last, from front to back; of a cut for one
 * shot after the other. Each follows its own parts, which are deeper. shot: its shot; nil: none.
 * share: of its shot in the frame. file and line: nil if they are not known. light: of a cel, red,
 * green and blue, or "texture". paint: of an object at the point, in white light; form: "fill" or
 * "stroke" of an outline. x, y: film units. */
int cs_stage_hits(lua_State *L) {
  cs_script *script = cs_service_opened(L);
  listener t = {L, script->L};
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  cs_film_expose(&script->film, &script->frame, &frame);
  const cs_hits_wanted wanted = {.context = script->context,
                                 .frame = &frame,
                                 .point = {luaL_checknumber(L, 2), luaL_checknumber(L, 3)},
                                 .is_cut = lua_toboolean(L, 5),
                                 .found = add_hit,
                                 .user = &t};
  luaL_checkstack(L, 8, "too many objects");
  if (cs_hits_find(&wanted) == CELSPAN_OK)
    return 0;
  lua_pushstring(L, celspan_context_error(script->context));
  return 1;
}
