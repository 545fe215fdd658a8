/* The parts of a frame, for exposure sheets; where the size of the film is given also their boxes,
 * and its texts, for tools that say what is seen of it.
 *
 *   rostrum --view--> cel --matrix--> object --matrix--> operand, text     `around` at each step
 */
#include <lauxlib.h>
#include <math.h>
#include <stdio.h>

#include "inside/scene.h"
#include "lua/bind/host.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"
#include "lua/nouns/shown.h"

enum { PLACE_SIZE = 64, PATH_SIZE = 512 };

typedef struct list {
  lua_State *L;
  celspan_context *context;
  bool has_boxes;
  int table; /* index of the list on the stack */
  lua_Integer count;
  const char *owner; /* for a sheet, the name of the rostrum around what is searched, or "" */
  const celspan_rostrum *rostrum; /* of the exposure; and the cel of it that is being searched */
  size_t place;
  /* the index of the cels before this cel, as a rostrum; nil until a text of the cel needs it */
  int over;
} list;

/* The surroundings of a value: the matrix from its units to those of the film, and how much of it
 * is visible. */
typedef struct around {
  celspan_matrix matrix;
  double fade;
  double width, height; /* size of the film, or of the composition around the value */
  bool is_inner;        /* inside a composition that lies in the frame's */
  bool is_text;         /* inside a text, where only the letters together are listed */
  /* the letters of this text, if they are an object of their own; otherwise NULL */
  const celspan_object *letters;
} around;

typedef struct part {
  const char *kind, *name;
  bool is_known; /* false: it contains a procedure */
  uint64_t drawing[2], placement[2];
} part;

static void set_hash(lua_State *L, const char *field, const uint64_t hash[2]) {
  lua_pushlstring(L, (const char *)hash, 2 * sizeof hash[0]);
  lua_setfield(L, -2, field);
}

static void add(list *to, const part *one) {
  lua_State *L = to->L;
  lua_createtable(L, 0, 5);
  cs_put_text(L, "kind", one->kind);
  lua_pushfstring(L, "%s%s%s", to->owner, to->owner[0] ? "/" : "", one->name);
  lua_setfield(L, -2, "name");
  set_hash(L, "drawing", one->drawing);
  set_hash(L, "placement", one->placement);
  if (!one->is_known) {
    cs_put_flag(L, "procedure", true);
  }
  lua_pushvalue(L, -1);
  lua_rawseti(L, to->table, ++to->count);
}

/* ---------------------------------------------------------------- boxes */

/* Sets where the part on top of the stack is visible, and where it was made. */
static void set_place(list *to, cs_mark mark, double fade, bool is_there, const celspan_box *box) {
  lua_State *L = to->L;
  celspan_origin origin = cs_mark_origin(mark);
  if (origin.line > 0) {
    cs_put_text(L, "file", origin.source);
    cs_put_integer(L, "line", origin.line);
  }
  cs_put_number(L, "fade", fade);
  if (!is_there)
    return;
  const double sides[4] = {box->x, box->y, box->width, box->height};
  cs_put_numbers(L, "box", sides, 4);
}

/* Pushes a holder for a rostrum, which is NULL at first. */
static celspan_rostrum **push_rostrum(lua_State *L) {
  cs_userdata *value = cs_userdata_push(L, &cs_noun_rostrum);
  lua_newtable(L);
  lua_setiuservalue(L, -2, 1);
  return (celspan_rostrum **)&value->handle;
}

/* Sets the appearance of a text alone in its place, and the cels before it, if there are any. */
static celspan_status set_text(list *to, celspan_object *placed, uint32_t words) {
  lua_State *L = to->L;
  const celspan_rostrum *all = to->rostrum;
  const size_t after = to->place + 1;
  cs_put_integer(L, "words", words);
  CS_TRY(cs_rostrum_alone(to->context, placed, push_rostrum(L)));
  lua_setfield(L, -2, "alone");
  if (after == all->cel_count)
    return CELSPAN_OK;
  if (lua_isnil(L, to->over)) {
    CS_TRY(cs_rostrum_change(to->context, all, all->cels + after, all->cel_count - after,
                             (cs_light){0}, push_rostrum(L)));
    lua_replace(L, to->over);
  }
  lua_pushvalue(L, to->over);
  lua_setfield(L, -2, "over");
  return CELSPAN_OK;
}

/* The factor by which lines become longer. */
static double growth(const celspan_matrix *matrix) {
  const double *m = matrix->m;
  return sqrt(fabs(m[0] * m[4] - m[1] * m[3]));
}

/* Sets where the object of the part on top of the stack is visible. */
static void set_object(list *to, const celspan_object *object, const around *at, bool is_text) {
  celspan_object *one = (celspan_object *)object, *placed;
  const celspan_matrix whole = celspan_matrix_then(*object->matrix, at->matrix);
  celspan_box box;
  bool is_there = cs_bounds_around(&one, 1, &at->matrix, &box);
  set_place(to, object->mark, at->fade * object->fade, is_there, &box);
  cs_put_number(to->L, "scale", growth(&whole));
  if (!is_text)
    return;
  cs_host_try(to->L, "parts", celspan_object_transform(to->context, one, &at->matrix, &placed));
  celspan_status status = set_text(to, placed, object->mark.callers);
  celspan_object_unref(placed);
  cs_host_try(to->L, "parts", status);
}

/* ---------------------------------------------------------------- the walk */

static void add_rostrum(list *to, const celspan_rostrum *rostrum, const around *at,
                        const char *path);

/* A text with a shadow, a glow or an outline has the words of its letters, which are one of its
 * operands. NULL: the object is the whole text. */
static const celspan_object *letters_of(const celspan_object *object) {
  const celspan_object *letters = NULL;
  if (object->data->kind != CS_PRIMITIVE_DATA_BOOLEAN)
    return NULL;
  const cs_boolean *all = object->data->boolean;
  for (size_t i = 0; i < all->operand_count; i++)
    if (all->operands[i]->mark.callers == object->mark.callers) {
      if (letters)
        return NULL; /* a text of several parts */
      letters = all->operands[i];
    }
  return letters;
}

/* Sets the surroundings of the object's parts. Returns whether the object is a whole text. */
static bool enter(const celspan_object *object, const around *at, around *inner) {
  const bool has_words = object->mark.callers > 0 && (!at->is_text || object == at->letters);
  *inner = *at;
  inner->matrix = celspan_matrix_then(*object->matrix, at->matrix);
  inner->fade *= object->fade;
  inner->is_text = at->is_text || has_words;
  inner->letters = has_words ? letters_of(object) : NULL;
  return has_words && !inner->letters;
}

/* Adds the object by its name, and as a text. */
static void add_object(list *to, const celspan_object *object, const around *at, bool is_text) {
  part one = {.kind = "object", .name = cs_mark_name(object->mark)};
  one.is_known =
      (one.name[0] || is_text) && celspan_object_hash(object, one.drawing, one.placement);
  for (int i = one.name[0] ? 0 : 1; i < (is_text ? 2 : 1); i++) {
    one.kind = i ? "text" : "object";
    add(to, &one);
    if (to->has_boxes)
      set_object(to, object, at, i);
    lua_pop(to->L, 1);
  }
}

/* path: of the cel that contains them. Recursion ends: nesting is at most CS_SCENE_DEPTH. */
static void add_objects(list *to, celspan_object *const *objects, size_t count, const around *at,
                        const char *path) {
  for (size_t i = 0; i < count; i++) {
    const celspan_object *object = objects[i];
    const cs_primitive_data *data = object->data;
    around inner;
    const bool is_text = enter(object, at, &inner) && to->has_boxes;
    add_object(to, object, at, is_text);
    if (data->kind == CS_PRIMITIVE_DATA_ROSTRUM) {
      inner.width = data->rostrum->width;
      inner.height = data->rostrum->height;
      inner.is_inner = true;
      add_rostrum(to, data->rostrum, &inner, path);
    } else if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
      add_objects(to, data->boolean->operands, data->boolean->operand_count, &inner, path);
  }
}

/* A cel without a name in a nested composition is identified by the path of indices that leads to
 * it. In a sheet it is no part of its own: what changes in it changes the cel around it. */
static void add_cel(list *to, const celspan_cel *cel, const around *at, const char *path,
                    size_t place) {
  char own[PATH_SIZE];
  snprintf(own, sizeof own, "%s%scel %zu", path, path[0] ? "/" : "", place);
  const char *name = cs_mark_name(cel->mark);
  part one = {.kind = "cel", .name = name[0] ? name : own};
  if (!to->has_boxes && at->is_inner && path[0] && !name[0]) {
    add_objects(to, cel->objects, cel->object_count, at, path);
    return;
  }
  one.is_known = celspan_cel_hash(cel, one.drawing, one.placement);
  add(to, &one);
  if (to->has_boxes) {
    celspan_box box;
    bool is_there = cs_bounds_around(cel->objects, cel->object_count, &at->matrix, &box);
    set_place(to, cel->mark, at->fade, is_there, &box);
    if (at->is_inner && !name[0])
      cs_put_flag(to->L, "unnamed", true);
  }
  lua_pop(to->L, 1);
  add_objects(to, cel->objects, cel->object_count, at, one.name);
}

static void add_rostrum(list *to, const celspan_rostrum *rostrum, const around *at,
                        const char *path) {
  const char *owner = to->owner, *name = cs_mark_name(rostrum->mark);
  if (!to->has_boxes && name[0]) {
    to->owner = name;
    path = "";
  }
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    around inner = *at;
    celspan_matrix placed;
    if (to->has_boxes) {
      cs_host_try(to->L, "parts",
                  cs_scene_cel_matrix(to->context, rostrum, i, at->width, at->height, &placed));
      inner.matrix = celspan_matrix_then(placed, at->matrix);
    }
    inner.fade *= rostrum->cels[i]->opacity;
    if (rostrum == to->rostrum) {
      to->place = i;
      lua_pushnil(to->L);
      lua_replace(to->L, to->over);
    }
    add_cel(to, rostrum->cels[i], &inner, path, i + 1);
  }
  to->owner = owner;
}

/* (exposures [, width, height of the film]) */
int cs_parts_list(lua_State *L) {
  celspan_frame_desc desc;
  lua_settop(L, 3);
  list to = {.L = L, .context = cs_host_context(L), .has_boxes = !lua_isnil(L, 2), .owner = ""};
  around at = {.matrix = celspan_matrix_identity(),
               .fade = 1,
               .width = luaL_optnumber(L, 2, 0),
               .height = luaL_optnumber(L, 3, 0)};
  cs_shown_read(L, 1, "parts: argument 1", &desc);
  lua_pushnil(L);
  to.over = lua_gettop(L);
  lua_newtable(L);
  to.table = lua_gettop(L);
  luaL_checkstack(L, 16, "too many parts");
  for (size_t e = 0; e < desc.exposure_count; e++) {
    char path[PLACE_SIZE] = "";
    if (e > 0)
      snprintf(path, sizeof path, "exposure %zu", e + 1);
    to.rostrum = desc.exposures[e].rostrum;
    add_rostrum(&to, to.rostrum, &at, path);
  }
  lua_settop(L, to.table);
  return 1;
}
