/* The structure of an object, for celspan.morph: the tree of an object as tables, and back.
 *
 * A node: name, fade, and
 *   kind "boolean"  op, object, filled (its operands are the plane of a pattern and the shape that
 *                   it fills), and the nodes of its operands as a list
 *   kind "outline"  object, rule, paint or texture, and contours as celspan.path takes them; of an
 *                   even line also line, whose width, cap, join and miter are those of a stroke
 *   kind "other"    object, as it is placed
 * All points and textures are placed in the units around the whole object.
 */
#include <math.h>

#include "inside/context.h"
#include "inside/geometry.h"
#include "inside/number.h"
#include "inside/scene.h"
#include "lua/bind/bare.h"
#include "lua/bind/caller.h"
#include "lua/bind/host.h"
#include "lua/bind/put.h"
#include "lua/nouns/nouns.h"
#include "lua/nouns/shape.h"

/* How far cubics may lie from a curve of another kind, as a share of its longer side. */
#define WITHIN 0x1p-19
/* Lua stack slots of one level of nodes. */
#define SLOTS 16

static const cs_noun noun_object = {.name = "morphed", .kind = &cs_kind_object, CS_BARE};
static const cs_noun noun_texture = {.name = "texture", .kind = &cs_kind_texture, CS_BARE};

/* Puts an object, moved by a matrix, into the field `object` of the node on top of the stack. */
static void put_object(lua_State *L, celspan_object *object, const celspan_matrix *matrix) {
  celspan_object *placed = NULL;
  cs_userdata *value = cs_bare_push(L, &noun_object);
  cs_host_try(L, "morph", celspan_object_transform(cs_host_context(L), object, matrix, &placed));
  value->handle = placed;
  lua_setfield(L, -2, "object");
}

/* ---------------------------------------------------------------- contours */

/* An outline that is released with the Lua value that holds it. */
typedef struct held {
  cs_outline outline;
  cs_memory *memory;
} held;

static int release(lua_State *L) {
  held *of = lua_touserdata(L, 1);
  if (of->memory)
    cs_outline_finish(&of->outline, of->memory);
  of->memory = NULL;
  return 0;
}

/* Pushes an empty outline. */
static cs_outline *push_held(lua_State *L) {
  held *of = cs_userdata_push_holder(L, "celspan.anatomy", sizeof *of, release);
  cs_outline_init(&of->outline);
  of->memory = cs_host_context(L)->memory;
  return &of->outline;
}

static void add_number(lua_State *L, lua_Integer *count, double number) {
  lua_pushnumber(L, number);
  lua_rawseti(L, -2, ++*count);
}

/* Appends the points of a piece after its first one. */
static void add_piece(lua_State *L, const cs_outline *outline, size_t i, lua_Integer *count) {
  static const int of_line[] = {0, 1, 1}, of_cubic[] = {1, 2, 3};
  const cs_hpoint *p = outline->points + outline->starts[i];
  for (int k = 0; k < 3; k++) {
    const cs_hpoint *at = &p[outline->degrees[i] == 3 ? of_cubic[k] : of_line[k]];
    add_number(L, count, at->x);
    add_number(L, count, at->y);
  }
}

static bool is_point_same(cs_hpoint a, cs_hpoint b) { return a.x == b.x && a.y == b.y; }

/* Pushes a contour of the pieces from begin to end. */
static void push_contour(lua_State *L, const cs_outline *outline, size_t begin, size_t end,
                         bool is_closed) {
  lua_Integer count = 0;
  lua_createtable(L, (int)(6 * (end - begin) + 2), 1);
  add_number(L, &count, outline->points[outline->starts[begin]].x);
  add_number(L, &count, outline->points[outline->starts[begin]].y);
  for (size_t i = begin; i < end; i++)
    add_piece(L, outline, i, &count);
  cs_put_flag(L, "closed", is_closed);
}

/* Whether a contour of a line is open, and its end differs from its beginning. */
static bool is_parted(const cs_stroke *stroke, size_t contour) {
  size_t begin, end;
  cs_stroke_contour(&stroke->line, contour, &begin, &end);
  const cs_hpoint *points = stroke->line.points;
  return !is_point_same(points[stroke->line.starts[begin]],
                        points[stroke->line.starts[end - 1] + stroke->line.degrees[end - 1]]);
}

static bool is_closed(const cs_stroke *stroke, size_t contour) {
  for (size_t i = 0; i < stroke->part_count; i++)
    if (stroke->parts[i].contour == contour && stroke->parts[i].is_closed)
      return true;
  return false;
}

static celspan_status stay(void *user, celspan_context *context, celspan_point from,
                           celspan_point *to) {
  (void)user, (void)context;
  *to = from;
  return CELSPAN_OK;
}

/* Puts the contours of an outline. line: the stroke whose line it is, or NULL. Errors: those of
 * cs_warp_bend. */
static celspan_status put_contours(lua_State *L, const cs_outline *outline,
                                   const celspan_matrix *matrix, double extent,
                                   const cs_stroke *line) {
  celspan_context *context = cs_host_context(L);
  const cs_warp_map map = {
      .context = context, .call = stay, .within = WITHIN * extent, .extent = INFINITY};
  cs_outline *plain = push_held(L);
  const celspan_status status = cs_warp_bend(&map, outline, matrix, plain);
  if (status != CELSPAN_OK) {
    lua_pop(L, 1);
    return status;
  }
  lua_createtable(L, (int)plain->contour_count, 0);
  for (size_t c = 0; c < plain->contour_count; c++) {
    size_t begin, end;
    cs_stroke_contour(plain, c, &begin, &end);
    bool is_open = line && !is_closed(line, c);
    push_contour(L, plain, begin, is_open && is_parted(line, c) ? end - 1 : end, !is_open);
    lua_rawseti(L, -2, (lua_Integer)c + 1);
  }
  lua_setfield(L, -3, "contours");
  lua_pop(L, 1);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- paints */

static void put_triple(lua_State *L, const char *name, const float sum[3], float share,
                       double fallback) {
  double numbers[3];
  for (int c = 0; c < 3; c++)
    numbers[c] = share > 0 ? fmin(sum[c] / (double)share, 1) : fallback;
  cs_put_numbers(L, name, numbers, 3);
}

static void put_paint(lua_State *L, const cs_paint *paint) {
  lua_createtable(L, 0, 3);
  put_triple(L, "pigment", paint->s, paint->beta, 0);
  put_triple(L, "medium", paint->t, 1 - paint->beta, 1);
  cs_put_number(L, "beta", paint->beta);
  lua_setfield(L, -2, "paint");
}

/* Puts the field `paint` or `texture`, with the texture as it appears on the placed object. */
static void put_texture(lua_State *L, const cs_primitive_data *data, const celspan_matrix *matrix) {
  celspan_context *context = cs_host_context(L);
  celspan_texture *boxed = NULL, *placed = NULL;
  if (data->texture->kind == CS_TEXTURE_FLAT) {
    put_paint(L, &data->texture->flat);
    return;
  }
  cs_userdata *value = cs_bare_push(L, &noun_texture);
  celspan_status status = cs_texture_boxed(context, data->texture, &data->bounds, &boxed);
  if (status == CELSPAN_OK)
    status = celspan_texture_with_matrix(context, boxed, matrix, &placed);
  celspan_texture_unref(boxed);
  value->handle = placed;
  cs_host_try(L, "morph", status);
  lua_setfield(L, -2, "texture");
}

/* ---------------------------------------------------------------- nodes */

static void put_line(lua_State *L, const cs_stroke *stroke, const celspan_matrix *matrix) {
  const double *m = matrix->m;
  lua_createtable(L, 0, 4);
  cs_put_number(L, "width", 2 * stroke->largest * sqrt(fabs(m[0] * m[4] - m[1] * m[3])));
  cs_put_text(L, "cap", cs_nouns_caps[stroke->cap]);
  cs_put_text(L, "join", cs_nouns_joins[stroke->join]);
  cs_put_number(L, "miter", stroke->miter);
  lua_setfield(L, -2, "line");
}

/* Puts what is painted: the contours, and the rule that says which points are in them. */
static celspan_status put_filled(lua_State *L, const cs_primitive_data *data,
                                 const celspan_matrix *matrix, double extent) {
  cs_outline_box room;
  cs_put_text(L, "rule",
              data->rule == CELSPAN_RULE_EVENODD && !data->stroke ? "evenodd" : "nonzero");
  if (!data->stroke)
    return put_contours(L, cs_primitive_data_outline(data, &room), matrix, extent, NULL);
  cs_outline *made = push_held(L);
  cs_host_try(L, "morph", cs_stroke_outline_finely(cs_host_context(L), data->stroke, made));
  lua_insert(L, -2); /* moves the value below the node */
  const celspan_status status = put_contours(L, made, matrix, extent, NULL);
  lua_remove(L, -2);
  return status;
}

celspan_status cs_anatomy_put_filled(lua_State *L, const cs_primitive_data *data, double within) {
  const celspan_matrix identity = celspan_matrix_identity();
  const double extent = cs_number_length(data->bounds.width, data->bounds.height);
  if (extent > 0)
    return put_filled(L, data, &identity, within / WITHIN * extent);
  lua_newtable(L);
  lua_setfield(L, -2, "contours");
  return CELSPAN_OK;
}

static void put_outline(lua_State *L, const cs_primitive_data *data, const celspan_matrix *matrix,
                        bool is_filled) {
  double extent = cs_number_length(data->bounds.width, data->bounds.height) *
                  cs_number_length(matrix->m[0], matrix->m[3]);
  bool is_line =
      !is_filled && data->stroke && cs_stroke_is_plain(data->stroke) && cs_matrix_is_affine(matrix);
  cs_put_text(L, "kind", "outline");
  put_texture(L, data, matrix);
  if (!is_line) {
    cs_host_try(L, "morph", put_filled(L, data, matrix, extent));
    return;
  }
  cs_put_text(L, "rule", "nonzero");
  put_line(L, data->stroke, matrix);
  cs_host_try(L, "morph", put_contours(L, &data->stroke->line, matrix, extent, data->stroke));
}

static void push_node(lua_State *L, celspan_object *object, const celspan_matrix *around,
                      bool is_filled);

static void put_operands(lua_State *L, const cs_boolean *boolean, const celspan_matrix *matrix,
                         bool is_filled) {
  cs_put_text(L, "kind", "boolean");
  cs_put_text(L, "op", cs_boolean_words[boolean->op]);
  cs_put_flag(L, "filled", boolean->is_filled);
  for (size_t i = 0; i < boolean->operand_count; i++) {
    push_node(L, boolean->operands[i], matrix, is_filled);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

/* is_filled: strokes are shapes, too. Recursion ends: nesting is at most CS_SCENE_DEPTH. */
static void push_node(lua_State *L, celspan_object *object, const celspan_matrix *around,
                      bool is_filled) {
  const cs_primitive_data *data = object->data;
  const celspan_matrix whole = celspan_matrix_then(*object->matrix, *around);
  luaL_checkstack(L, SLOTS, "morph");
  lua_createtable(L, 0, 8);
  cs_put_text(L, "name", cs_mark_name(object->mark));
  cs_put_number(L, "fade", object->fade);
  put_object(L, object, around);
  if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
    put_operands(L, data->boolean, &whole, is_filled);
  else if (data->kind == CS_PRIMITIVE_DATA_OUTLINE)
    put_outline(L, data, &whole, is_filled);
  else
    cs_put_text(L, "kind", "other");
}

int cs_anatomy_of(lua_State *L) {
  const celspan_matrix identity = celspan_matrix_identity();
  const cs_userdata *object = cs_shape_at(L, 1);
  if (!object)
    return cs_caller_error(L, "morph: objects are needed, got %s", cs_userdata_type(L, 1));
  push_node(L, object->handle, &identity, lua_toboolean(L, 2));
  return 1;
}

/* ---------------------------------------------------------------- the way back */

/* (object, { operands }) -> a boolean like the object, with these operands */
int cs_anatomy_rebuild(lua_State *L) {
  static const cs_noun noun = {.name = "morph", .fields = cs_bare_fields};
  const cs_userdata *like = cs_userdata_test(L, 1, &cs_kind_object);
  const cs_form form = {.L = L, .noun = &noun, .table = 2};
  celspan_object *made = NULL;
  luaL_argcheck(L, like, 1, "an object is needed");
  const cs_boolean *boolean = ((celspan_object *)like->handle)->data->boolean;
  int count = (int)lua_rawlen(L, 2);
  celspan_object **operands = cs_shape_items(&form, count);
  cs_userdata *value = cs_bare_push(L, &noun_object);
  cs_host_try(L, "morph",
              cs_boolean_like(cs_host_context(L), boolean, operands, (size_t)count, &made));
  value->handle = made;
  return 1;
}

/* (texture, matrix of 9 numbers) -> the texture, moved */
int cs_anatomy_move(lua_State *L) {
  const cs_userdata *texture = cs_userdata_test(L, 1, &cs_kind_texture);
  celspan_matrix matrix;
  celspan_texture *moved = NULL;
  luaL_argcheck(L, texture, 1, "a texture is needed");
  luaL_checktype(L, 2, LUA_TTABLE);
  for (int i = 0; i < 9; i++) {
    lua_rawgeti(L, 2, i + 1);
    matrix.m[i] = luaL_checknumber(L, -1);
    lua_pop(L, 1);
  }
  cs_userdata *value = cs_bare_push(L, &noun_texture);
  cs_host_try(L, "morph",
              celspan_texture_with_matrix(cs_host_context(L), texture->handle, &matrix, &moved));
  value->handle = moved;
  return 1;
}
