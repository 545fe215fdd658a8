/* Objects under a map: the tree of an object stays as it is, and every outline in it is bent. Data
 * whose colour varies become the triangles of a mesh, inside the bent outline.
 *
 *     union{ a, b }          union{ a bent, b bent }
 *     a, of one colour       its outline, bent
 *     a, of many colours     clip(union{ triangles }, its outline, bent)
 *
 * All transforms are multiplied into the points, since the map takes points in the units around the
 * whole object; fades, modes, names and lines stay.
 */
#include <math.h>

#include "base/description.h"
#include "model/scene/bounds.h"
#include "model/scene/check.h"
#include "model/scene/primitive_data.h"
#include "model/scene/texture.h"
#include "model/stroke/outliner.h"
#include "model/warp/bend.h"
#include "model/warp/mesh.h"

/* ---------------------------------------------------------------- the triangles of a mesh */

typedef struct cutter {
  celspan_context *context;
  const cs_warp_mesh *mesh;
  celspan_texture *texture; /* placed */
  celspan_object **objects;
  size_t count;
} cutter;

/* The affine map that takes three points to three others, as the identity plus a change. If nothing
 * changes, it is exactly the identity, to the bit. */
static celspan_matrix affine(const celspan_point from[3], const celspan_point to[3]) {
  double ux = from[1].x - from[0].x, uy = from[1].y - from[0].y;
  double vx = from[2].x - from[0].x, vy = from[2].y - from[0].y;
  double area = ux * vy - uy * vx, m[4], moved[3][2];
  for (int i = 0; i < 3; i++) {
    moved[i][0] = to[i].x - from[i].x;
    moved[i][1] = to[i].y - from[i].y;
  }
  for (int k = 0; k < 2; k++) {
    double u = moved[1][k] - moved[0][k], v = moved[2][k] - moved[0][k];
    m[2 * k] = (u * vy - v * uy) / area;
    m[2 * k + 1] = (v * ux - u * vx) / area;
  }
  return (celspan_matrix){{1 + m[0], m[1], moved[0][0] - (m[0] * from[0].x + m[1] * from[0].y),
                           m[2], 1 + m[3], moved[0][1] - (m[2] * from[0].x + m[3] * from[0].y), 0,
                           0, 1}};
}

static celspan_status cut_triangle(cutter *c, size_t i, size_t j, size_t k) {
  const celspan_point *from = c->mesh->from, *to = c->mesh->to;
  const celspan_point before[3] = {from[i], from[j], from[k]}, after[3] = {to[i], to[j], to[k]};
  const celspan_matrix matrix = affine(before, after);
  celspan_texture *texture;
  CS_TRY(celspan_texture_with_matrix(c->context, c->texture, &matrix, &texture));
  const celspan_triangle_desc desc = {sizeof desc, {after[0], after[1], after[2]}, texture};
  celspan_status status = celspan_object_create_triangle(c->context, &desc, &c->objects[c->count]);
  celspan_texture_unref(texture);
  if (status == CELSPAN_OK)
    c->count++;
  return status;
}

/* Cells of the rim come first: the others lie over them if a map bends strongly. */
static celspan_status cut_triangles(cutter *c, bool is_rim) {
  const cs_warp_mesh *mesh = c->mesh;
  for (size_t j = 0; j < mesh->rows; j++)
    for (size_t i = 0; i < mesh->columns; i++) {
      size_t at = j * (mesh->columns + 1) + i, below = at + mesh->columns + 1;
      bool is_outer = i == 0 || j == 0 || i + 1 == mesh->columns || j + 1 == mesh->rows;
      if (is_outer != is_rim)
        continue;
      CS_TRY(cut_triangle(c, at, at + 1, below));
      CS_TRY(cut_triangle(c, at + 1, below + 1, below));
    }
  return CELSPAN_OK;
}

static celspan_status cut(cutter *c, celspan_object **out) {
  size_t most = 2 * c->mesh->columns * c->mesh->rows;
  CS_TRY(CS_MAKE(c->context, c->objects, most));
  celspan_status status = cut_triangles(c, true);
  if (status == CELSPAN_OK)
    status = cut_triangles(c, false);
  if (status == CELSPAN_OK)
    status = celspan_object_create_boolean(c->context, CELSPAN_OPERATOR_UNION, c->objects, c->count,
                                           out);
  for (size_t i = 0; i < c->count; i++)
    celspan_object_unref(c->objects[i]);
  cs_mem_free(c->context->memory, c->objects, most * sizeof *c->objects);
  return status;
}

/* The texture that was given, not the unrolled one; a picture is placed in its box. */
static celspan_status place(celspan_context *context, celspan_texture *texture,
                            const celspan_box *box, const celspan_matrix *matrix,
                            celspan_texture **out) {
  celspan_texture *given = texture->variation->origin ? texture->variation->origin : texture;
  celspan_texture *boxed;
  CS_TRY(cs_texture_boxed(context, given, box, &boxed));
  celspan_status status = celspan_texture_with_matrix(context, boxed, matrix, out);
  celspan_texture_unref(boxed);
  return status;
}

/* A mesh counts as one shape when it is decided whether a drawing should be kept. */
static void count_as_one(const celspan_object *mesh) { mesh->data->piece_count = CS_SHAPE_PIECES; }

/* *out: the union of all triangles, new, each with the texture moved by the map. texture: placed by
 * a matrix in the units around the object; box: where a picture without a box lies, in its own
 * units. Errors: NO_MEMORY, BAD_ARGUMENT, LIMIT. */
static celspan_status make_pieces(celspan_context *context, const cs_warp_mesh *mesh,
                                  celspan_texture *texture, const celspan_box *box,
                                  const celspan_matrix *matrix, celspan_object **out) {
  cutter c = {.context = context, .mesh = mesh};
  CS_TRY(place(context, texture, box, matrix, &c.texture));
  celspan_status status = cut(&c, out);
  if (status == CELSPAN_OK)
    count_as_one(*out);
  celspan_texture_unref(c.texture);
  return status;
}

#define PIECES 400
#define PIECES_LEAST 18
#define PIECES_MOST 20000
/* For a shape of one colour, whose mesh is only used to find folds. */
#define PIECES_FLAT 200
/* A hundredth of a pixel of an object that fills a frame of 2^20 pixels a side. */
#define WITHIN 0x1p-27

/* ---------------------------------------------------------------- primitives */

/* The outline of data, bent; outlines of strokes are made as exactly as is needed. */
static celspan_status bend_outline(const cs_warp_map *map, const cs_primitive_data *data,
                                   const celspan_matrix *matrix, cs_outline *out) {
  cs_outline_box room;
  if (!data->stroke)
    return cs_warp_bend(map, cs_primitive_data_outline(data, &room), matrix, out);
  cs_outline made;
  cs_outline_init(&made);
  celspan_status status = cs_stroke_outline_finely(map->context, data->stroke, &made);
  if (status == CELSPAN_OK)
    status = cs_warp_bend(map, &made, matrix, out);
  cs_outline_finish(&made, map->context->memory);
  return status;
}

static celspan_status bend_shape(const cs_warp_map *map, const cs_primitive_data *data,
                                 const celspan_matrix *matrix, celspan_texture *texture,
                                 celspan_object **out) {
  cs_outline outline;
  cs_outline_init(&outline);
  celspan_status status = bend_outline(map, data, matrix, &outline);
  if (status != CELSPAN_OK) {
    cs_outline_finish(&outline, map->context->memory);
    return status;
  }
  celspan_rule rule = data->stroke ? CELSPAN_RULE_NONZERO : data->rule;
  return cs_primitive_data_of_outline(map->context, &outline, rule, texture, out);
}

/* The triangles inside the shape. */
static celspan_status bend_texture(const cs_warp_map *map, const cs_primitive_data *data,
                                   const celspan_matrix *matrix, const cs_warp_mesh *mesh,
                                   celspan_object **out) {
  celspan_object *both[2] = {NULL, NULL};
  CS_TRY(bend_shape(map, data, matrix, NULL, &both[1]));
  celspan_status status =
      make_pieces(map->context, mesh, data->texture, &data->bounds, matrix, &both[0]);
  if (status == CELSPAN_OK)
    status = celspan_object_create_boolean(map->context, CELSPAN_OPERATOR_CLIP, both, 2, out);
  celspan_object_unref(both[0]);
  celspan_object_unref(both[1]);
  return status;
}

/* The tight box around the drawn part of data, in the units around the object. */
static celspan_status find_box(const cs_warp_map *map, const cs_primitive_data *data,
                               const celspan_matrix *matrix, bool *is_there, celspan_box *box) {
  cs_outline_box room;
  if (data->stroke)
    return cs_stroke_bounds(map->context, data->stroke, matrix, box, is_there);
  *is_there = cs_outline_bounds(cs_primitive_data_outline(data, &room), matrix, box);
  return CELSPAN_OK;
}

static bool is_box_sane(const celspan_box *box) {
  return cs_number_is_sane(box->x) && cs_number_is_sane(box->y) &&
         cs_number_is_sane(box->x + box->width) && cs_number_is_sane(box->y + box->height);
}

static celspan_status bend_in_mesh(const cs_warp_map *map, const cs_primitive_data *data,
                                   const celspan_matrix *matrix, const celspan_box *box,
                                   celspan_object **out) {
  bool is_flat = data->texture->kind == CS_TEXTURE_FLAT;
  cs_warp_map coarse = *map;
  if (is_flat && coarse.pieces > PIECES_FLAT)
    coarse.pieces = PIECES_FLAT;
  cs_warp_mesh mesh;
  celspan_status status = cs_warp_mesh_make(&coarse, box, &mesh);
  if (status == CELSPAN_OK)
    status = cs_warp_mesh_check(map, &mesh, data, matrix);
  if (status == CELSPAN_OK)
    status = is_flat ? bend_shape(map, data, matrix, data->texture, out)
                     : bend_texture(map, data, matrix, &mesh, out);
  cs_warp_mesh_finish(&mesh, map->context->memory);
  return status;
}

static celspan_status bend_primitive(const cs_warp_map *map, const cs_primitive_data *data,
                                     const celspan_matrix *matrix, celspan_object **out) {
  bool is_there = false;
  celspan_box box;
  if (data->kind != CS_PRIMITIVE_DATA_OUTLINE)
    return cs_fail(map->context, CELSPAN_BAD_ARGUMENT,
                   "warp: %s cannot be bent; bend the objects that it is made of",
                   data->kind == CS_PRIMITIVE_DATA_SCANLINE
                       ? "a scan-line procedure"
                       : "a rostrum, or what is blurred, has a soft shadow or a glow, or is "
                         "filled with a pattern,");
  if (!data->is_empty)
    CS_TRY(find_box(map, data, matrix, &is_there, &box));
  if (is_there && !is_box_sane(&box))
    return cs_warp_fail_at_horizon(map);
  if (is_there && box.width > 0 && box.height > 0)
    return bend_in_mesh(map, data, matrix, &box, out);
  return celspan_object_create_boolean(map->context, CELSPAN_OPERATOR_UNION, NULL, 0, out);
}

/* ---------------------------------------------------------------- objects */

static celspan_status bend_object(const cs_warp_map *map, const celspan_object *object,
                                  const celspan_matrix *around, celspan_object **out);

static celspan_status bend_boolean(const cs_warp_map *map, const cs_boolean *boolean,
                                   const celspan_matrix *matrix, celspan_object **out) {
  size_t count = boolean->operand_count, made = 0;
  celspan_object **operands = cs_mem_array(map->context->memory, count, sizeof *operands);
  if (!operands && count > 0)
    return cs_fail_memory(map->context);
  celspan_status status = CELSPAN_OK;
  for (; status == CELSPAN_OK && made < count; made++)
    status = bend_object(map, boolean->operands[made], matrix, &operands[made]);
  if (status == CELSPAN_OK)
    status = cs_boolean_like(map->context, boolean, operands, count, out);
  cs_primitive_data_list_free(map->context->memory, operands, count);
  return status;
}

/* Gives the result the fade, the name and the line of the object. */
static celspan_status finish(const cs_warp_map *map, const celspan_object *object,
                             celspan_object *made, celspan_object **out) {
  celspan_object *faded;
  celspan_status status = celspan_object_fade(map->context, made, object->fade, &faded);
  celspan_object_unref(made);
  CS_TRY(status);
  cs_mark_drop(faded->mark);
  faded->mark = cs_mark_keep(object->mark);
  *out = faded;
  return CELSPAN_OK;
}

/* Recursion ends: nesting is at most CS_SCENE_DEPTH. */
static celspan_status bend_object(const cs_warp_map *map, const celspan_object *object,
                                  const celspan_matrix *around, celspan_object **out) {
  const cs_primitive_data *data = object->data;
  const celspan_matrix whole = celspan_matrix_then(*object->matrix, *around);
  celspan_object *made;
  if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
    CS_TRY(bend_boolean(map, data->boolean, &whole, &made));
  else
    CS_TRY(bend_primitive(map, data, &whole, &made));
  return finish(map, object, made, out);
}

/* ---------------------------------------------------------------- the face */

static celspan_status check(celspan_context *context, const celspan_object *object,
                            const celspan_warp_desc *desc) {
  CS_TRY(cs_check_given(context, "warp", "the object", object));
  if (!desc->map)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "warp: map is missing");
  CS_TRY(cs_check_size(context, "warp", "within", desc->within));
  return cs_check_range(context, "warp", "pieces", (double)desc->pieces, PIECES_LEAST, PIECES_MOST);
}

celspan_status celspan_object_warp(celspan_context *context, celspan_object *object,
                                   const celspan_warp_desc *desc, celspan_object **out) {
  CS_READ(context, "warp", celspan_warp_desc, desc);
  CS_TRY(check(context, object, desc));
  const celspan_matrix identity = celspan_matrix_identity();
  celspan_box box = {0};
  bool is_there;
  CS_TRY(cs_bounds_object(context, object, &is_there, &box));
  const double extent = fmax(box.width, box.height);
  if (!is_there || !(extent > 0)) {
    *out = celspan_object_ref(object);
    return CELSPAN_OK;
  }
  const cs_warp_map map = {.context = context,
                           .call = desc->map,
                           .user = desc->user,
                           .within = desc->within > 0 ? desc->within : WITHIN * extent,
                           .extent = extent,
                           .pieces = desc->pieces};
  return bend_object(&map, object, &identity, out);
}
