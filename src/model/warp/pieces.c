#include "model/warp/pieces.h"

#include "model/geometry/matrix.h"
#include "model/scene/primitive_data.h"
#include "model/scene/texture.h"

typedef struct cutter {
  celspan_context *context;
  const cs_warp_mesh *mesh;
  celspan_texture *texture; /* placed */
  celspan_object **objects;
  size_t count;
} cutter;

/* The affine map that takes three points to three others, as the identity plus a change, so that it
 * is the identity, to the bit, where nothing changes. */
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

/* Cells of the rim first: the others lie over them where a map bends strongly. */
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

/* The texture that was given, not as it was unrolled; a picture in its box. */
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

/* A mesh is one shape for those who ask whether a drawing is worth being kept. */
static void count_as_one(const celspan_object *mesh) {
  mesh->data->shape_count = 1;
  mesh->data->cut_count = 0;
}

celspan_status cs_warp_pieces(celspan_context *context, const cs_warp_mesh *mesh,
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
