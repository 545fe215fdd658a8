/* The objects at a point of a watched frame. */
#include <lauxlib.h>
#include <string.h>

#include "celspan/celspan.h"
#include "lua/bind/named.h"
#include "lua/bind/put.h"
#include "program/stage/stage.h"

/* A search from front to back. */
typedef struct search {
  lua_State *L; /* the function that is called is argument 4 */
  celspan_context *context;
  const cs_script *script;
  celspan_point point;
  size_t count;     /* the count of the items found */
  int depth;        /* the depth of the items that are searched */
  double share;     /* the share of the exposures of what is searched */
  const char *part; /* the shot of a cut in which the search is; "": none. NULL: it is no cut */
} search;

/* *paint: new; the colour of an object at the point in white light, straight; 0 where nothing
 * is. */
static celspan_status probe_object(const search *s, celspan_object *object,
                                   const celspan_matrix *matrix, cs_light *paint) {
  celspan_object *placed;
  celspan_exposure exposure = {NULL, 1};
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  double rgba[4];
  CS_TRY(celspan_object_transform(s->context, object, matrix, &placed));
  celspan_status status = cs_rostrum_alone(s->context, placed, &exposure.rostrum);
  celspan_object_unref(placed);
  CS_TRY(status);
  const cs_film_frame alone = {.exposures = &exposure, .count = 1};
  cs_film_expose(&s->script->film, &alone, &frame);
  status = celspan_probe(s->context, &frame, s->point, rgba);
  *paint = (cs_light){0};
  if (status == CELSPAN_OK && rgba[3] > 0)
    paint->flat = (celspan_light){(float)(rgba[0] / rgba[3]), (float)(rgba[1] / rgba[3]),
                                  (float)(rgba[2] / rgba[3]), (float)rgba[3]};
  celspan_rostrum_unref(exposure.rostrum);
  return status;
}

/* Pushes the callers of the line where a value was made, or "". */
static void push_callers(const search *s, cs_mark mark) {
  lua_State *script = s->script->L;
  cs_named_push_callers(script, mark.callers);
  lua_pushstring(s->L, lua_tostring(script, -1));
  lua_pop(script, 1);
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

/* light: the front light of a cel. object: with its paint at the point. The other one is NULL. */
static void add_hit(search *s, cs_mark mark, double opacity, const cs_light *light,
                    const celspan_object *object, const cs_light *paint) {
  celspan_origin origin = cs_mark_origin(mark);
  s->count++;
  lua_pushvalue(s->L, 4);
  lua_createtable(s->L, 0, 13);
  cs_put_text(s->L, "kind", light ? "cel" : "object");
  cs_put_integer(s->L, "depth", s->depth);
  if (object && object->data->kind == CS_PRIMITIVE_DATA_OUTLINE)
    cs_put_text(s->L, "form", object->data->stroke ? "stroke" : "fill");
  cs_put_text(s->L, "shot", s->part && s->part[0] ? s->part : NULL);
  cs_put_number(s->L, "share", s->share);
  cs_put_text(s->L, "name", cs_mark_name(mark));
  cs_put_text(s->L, "file", origin.line > 0 ? origin.source : NULL);
  if (origin.line > 0)
    cs_put_integer(s->L, "line", origin.line);
  cs_put_number(s->L, "opacity", opacity);
  push_callers(s, mark);
  lua_setfield(s->L, -2, "callers");
  push_light(s->L, light ? light : paint);
  lua_setfield(s->L, -2, light ? "light" : "paint");
  lua_call(s->L, 1, 0);
}

/* The size of the film of a rostrum: a nested rostrum has its own. */
typedef struct extent {
  double width, height;
} extent;

static celspan_status search_rostrum(search *s, const celspan_rostrum *rostrum, extent film,
                                     const celspan_matrix *matrix);

/* Recursion ends: nesting is at most CS_SCENE_DEPTH. */
static celspan_status search_objects(search *s, celspan_object *const *objects, size_t count,
                                     const celspan_matrix *matrix) {
  for (size_t i = count; i-- > 0;) {
    const cs_primitive_data *data = objects[i]->data;
    cs_light paint;
    CS_TRY(probe_object(s, objects[i], matrix, &paint));
    if (!(paint.flat.a > 0))
      continue;
    celspan_matrix inner = celspan_matrix_then(*objects[i]->matrix, *matrix);
    s->depth++;
    if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
      CS_TRY(search_objects(s, data->boolean->operands, data->boolean->operand_count, &inner));
    if (data->kind == CS_PRIMITIVE_DATA_ROSTRUM)
      CS_TRY(search_rostrum(s, data->rostrum, (extent){data->rostrum->width, data->rostrum->height},
                            &inner));
    s->depth--;
    add_hit(s, objects[i]->mark, objects[i]->fade, NULL, objects[i], &paint);
  }
  return CELSPAN_OK;
}

static celspan_status search_rostrum(search *s, const celspan_rostrum *rostrum, extent film,
                                     const celspan_matrix *matrix) {
  const char *outer = s->part;
  if (outer && !outer[0])
    s->part = cs_mark_name(rostrum->mark);
  for (size_t i = rostrum->cel_count; i-- > 0;) {
    const celspan_cel *cel = rostrum->cels[i];
    celspan_matrix placed;
    CS_TRY(cs_scene_cel_matrix(s->context, rostrum, i, film.width, film.height, &placed));
    celspan_matrix inner = celspan_matrix_then(placed, *matrix);
    size_t before = s->count;
    s->depth++;
    CS_TRY(search_objects(s, cel->objects, cel->object_count, &inner));
    s->depth--;
    const cs_light light = cs_scene_front(rostrum, cel);
    if (s->count > before)
      add_hit(s, cel->mark, cel->opacity, &light, NULL, NULL);
  }
  s->part = outer;
  return CELSPAN_OK;
}

/* Whether two exposures show the same at two moments: of a cut the same shot. */
static bool is_same(const search *s, const celspan_exposure *a, const celspan_exposure *b) {
  const char *name = cs_mark_name(a->rostrum->mark);
  return a == b || !s->part || (name[0] && strcmp(name, cs_mark_name(b->rostrum->mark)) == 0);
}

/* Searches an exposure, if none before it shows the same. */
static celspan_status search_exposure(search *s, size_t i) {
  const cs_film_frame *frame = &s->script->frame;
  const celspan_matrix none = celspan_matrix_identity();
  s->share = 0;
  for (size_t j = frame->count; j-- > 0;)
    if (is_same(s, &frame->exposures[i], &frame->exposures[j])) {
      if (j < i)
        return CELSPAN_OK;
      s->share += frame->exposures[j].weight;
    }
  return search_rostrum(s, frame->exposures[i].rostrum,
                        (extent){s->script->film.width, s->script->film.height}, &none);
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
  search s = {.L = L,
              .context = script->context,
              .script = script,
              .point = {luaL_checknumber(L, 2), luaL_checknumber(L, 3)},
              .part = lua_toboolean(L, 5) ? "" : NULL};
  luaL_checkstack(L, 8, "too many objects");
  celspan_status status = CELSPAN_OK;
  for (size_t i = 0; i < script->frame.count && status == CELSPAN_OK; i++)
    status = search_exposure(&s, i);
  if (status == CELSPAN_OK)
    return 0;
  lua_pushstring(L, celspan_context_error(script->context));
  return 1;
}
