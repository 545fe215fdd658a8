/* The tree of a watched frame, and the labels by which its cels are shown in another way.
 *
 *   frame                        row, depth                     label
 *   cel "ground"                 cel ground, 0                  ground
 *   the second cel               cel, 0                         cel 2
 *     circle "disc"              object disc, 1
 *   of the shot "evening" of a cut:
 *   cel "nell"                   cel nell, 0                    evening/nell
 *
 * In a cut the rostrum of a shot has the name of the shot (celspan.shots). Where something lies
 * over the shots, this rostrum is alone in a cel, which is left out of the tree.
 */
#include <lauxlib.h>
#include <stdio.h>

#include "program/stage/stage.h"

const char *cs_stage_label(const celspan_rostrum *rostrum, size_t i, char label[CS_STAGE_LABEL]) {
  const char *name = cs_mark_name(rostrum->cels[i]->mark);
  if (name[0])
    return name;
  snprintf(label, CS_STAGE_LABEL, "cel %zu", i + 1);
  return label;
}

celspan_rostrum *cs_stage_part(const celspan_cel *cel) {
  const cs_primitive_data *data = cel->object_count == 1 ? cel->objects[0]->data : NULL;
  bool is_part = data && data->kind == CS_PRIMITIVE_DATA_ROSTRUM && !data->repeat &&
                 cs_mark_name(data->rostrum->mark)[0] != '\0';
  return is_part ? data->rostrum : NULL;
}

/* ---------------------------------------------------------------- the walk */

/* A walk from front to back over what a frame has. */
typedef struct walk {
  lua_State *L;         /* the function that is called is argument 4 */
  lua_Integer left;     /* how many rows may still be added */
  lua_Integer exposure; /* the number of this one, from 1 */
  bool is_cut;
} walk;

/* What there is to know of a row, but its mark. label: NULL: it has none. */
typedef struct row {
  int depth;
  const char *kind, *part, *label;
} row;

/* is_new: whether its parts follow. false: no more rows are wanted. */
static bool add_row(walk *w, const row *r, cs_mark mark, bool *is_new) {
  celspan_origin origin = cs_mark_origin(mark);
  if (w->left <= 0)
    return false;
  lua_pushvalue(w->L, 4);
  lua_pushinteger(w->L, r->depth);
  lua_pushstring(w->L, r->kind);
  lua_pushstring(w->L, cs_mark_name(mark));
  lua_pushstring(w->L, origin.line > 0 ? origin.source : NULL);
  lua_pushinteger(w->L, origin.line);
  lua_pushstring(w->L, r->part);
  lua_pushstring(w->L, r->label);
  lua_pushinteger(w->L, w->exposure);
  lua_call(w->L, 8, 1);
  *is_new = lua_toboolean(w->L, -1);
  lua_pop(w->L, 1);
  w->left -= *is_new;
  return true;
}

static bool walk_inner(walk *w, const celspan_rostrum *rostrum, int depth);

/* The objects that have a name, and what has one in the others. Recursion ends: nesting is at most
 * CS_SCENE_DEPTH. */
static bool walk_objects(walk *w, celspan_object *const *objects, size_t count, int depth) {
  for (size_t i = count; i-- > 0;) {
    const cs_primitive_data *data = objects[i]->data;
    bool has_name = cs_mark_name(objects[i]->mark)[0] != '\0', is_new = true;
    bool goes_on = !has_name ||
                   add_row(w, &(row){.depth = depth, .kind = "object"}, objects[i]->mark, &is_new);
    if (goes_on && data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
      goes_on =
          walk_objects(w, data->boolean->operands, data->boolean->operand_count, depth + has_name);
    if (goes_on && data->kind == CS_PRIMITIVE_DATA_ROSTRUM)
      goes_on = walk_inner(w, data->rostrum, depth + has_name);
    if (!goes_on)
      return false;
  }
  return true;
}

static bool walk_cel(walk *w, const celspan_cel *cel, const row *r) {
  bool is_new;
  if (!add_row(w, r, cel->mark, &is_new))
    return false;
  return !is_new || walk_objects(w, cel->objects, cel->object_count, r->depth + 1);
}

/* The cels of a rostrum that is an object: they have no labels. */
static bool walk_inner(walk *w, const celspan_rostrum *rostrum, int depth) {
  for (size_t i = rostrum->cel_count; i-- > 0;)
    if (!walk_cel(w, rostrum->cels[i], &(row){.depth = depth, .kind = "cel"}))
      return false;
  return true;
}

/* The cels of an exposure, or of a shot in it. Recursion ends: a shot is not looked for in a
 * shot. */
static bool walk_outer(walk *w, const celspan_rostrum *rostrum) {
  const char *name = w->is_cut ? cs_mark_name(rostrum->mark) : "";
  for (size_t i = rostrum->cel_count; i-- > 0;) {
    char label[CS_STAGE_LABEL];
    const celspan_cel *cel = rostrum->cels[i];
    const celspan_rostrum *part = w->is_cut && !name[0] ? cs_stage_part(cel) : NULL;
    const row cel_row = {.kind = "cel", .part = name, .label = cs_stage_label(rostrum, i, label)};
    if (!(part ? walk_outer(w, part) : walk_cel(w, cel, &cel_row)))
      return false;
  }
  return true;
}

/* film:tree(most, is_cut, add): calls add(depth, kind, name, source or nil, line, shot or nil,
 * label or nil, exposure) for each cel of the frame that was built last, and for each object in it
 * that has a name, from front to back. If add returns true, the parts of the row follow, which are
 * one deeper. At most `most` rows. */
int cs_stage_tree(lua_State *L) {
  const cs_script *script = cs_service_opened(L);
  walk w = {.L = L, .left = luaL_checkinteger(L, 2), .is_cut = lua_toboolean(L, 3)};
  luaL_checkstack(L, 10, "too many objects");
  for (size_t i = 0; i < script->frame.count; i++) {
    w.exposure++;
    if (!walk_outer(&w, script->frame.exposures[i].rostrum))
      break;
  }
  return 0;
}
