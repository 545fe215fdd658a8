#include "model/warp/mesh.h"

#include <math.h>

#include "model/scene/inside.h"

/* The least width of the rim in cells, and the factor of its width. */
#define RIM_LEAST 0x1p-20
#define RIM_MORE 1.5

/* ---------------------------------------------------------------- the grid */

/* The index of point (i, j); the first and the last i and j belong to the rim. */
static size_t place(const cs_warp_mesh *mesh, size_t i, size_t j) {
  return j * (mesh->columns + 1) + i;
}

/* Cells of about the same width and height, n along the longer side, without the rim. */
static void divide(const celspan_box *box, size_t n, size_t *columns, size_t *rows) {
  double longer = fmax(box->width, box->height);
  *columns = (size_t)fmax(1, floor((double)n * box->width / longer + 0.5));
  *rows = (size_t)fmax(1, floor((double)n * box->height / longer + 0.5));
}

static size_t triangles(const celspan_box *box, size_t n) {
  size_t columns, rows;
  divide(box, n, &columns, &rows);
  return 2 * (columns + 2) * (rows + 2);
}

/* The points inside the rim. */
static celspan_status fill(const cs_warp_map *map, const celspan_box *box, cs_warp_mesh *mesh) {
  size_t columns = mesh->columns - 2, rows = mesh->rows - 2;
  for (size_t j = 0; j <= rows; j++)
    for (size_t i = 0; i <= columns; i++) {
      size_t at = place(mesh, i + 1, j + 1);
      mesh->from[at] = (celspan_point){box->x + box->width * ((double)i / (double)columns),
                                       box->y + box->height * ((double)j / (double)rows)};
      CS_TRY(cs_warp_at(map, mesh->from[at], &mesh->to[at]));
    }
  return CELSPAN_OK;
}

static celspan_point middle(celspan_point a, celspan_point b) {
  return (celspan_point){0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
}

/* The distance between the map and the straight side between two points, at its middle. */
static celspan_status add_error(const cs_warp_map *map, const cs_warp_mesh *mesh, size_t a,
                                size_t b, double *most) {
  celspan_point is, ought = middle(mesh->to[a], mesh->to[b]);
  CS_TRY(cs_warp_at(map, middle(mesh->from[a], mesh->from[b]), &is));
  *most = fmax(*most, cs_number_length(is.x - ought.x, is.y - ought.y));
  return CELSPAN_OK;
}

/* The greatest distance at the diagonals and the sides of cells. */
static celspan_status find_error(const cs_warp_map *map, const cs_warp_mesh *mesh, double *most) {
  *most = 0;
  for (size_t j = 1; j < mesh->rows; j++)
    for (size_t i = 1; i < mesh->columns; i++) {
      size_t at = place(mesh, i, j), right = at + 1, below = place(mesh, i, j + 1);
      if (i + 1 < mesh->columns)
        CS_TRY(add_error(map, mesh, at, right, most));
      if (j + 1 < mesh->rows)
        CS_TRY(add_error(map, mesh, at, below, most));
      if (i + 1 < mesh->columns && j + 1 < mesh->rows)
        CS_TRY(add_error(map, mesh, right, below, most));
    }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the rim */

/* Places a point of the rim on the line from a point through its neighbour. */
static void continue_way(cs_warp_mesh *mesh, size_t rim, size_t border, size_t inner,
                         double share) {
  celspan_point *lists[] = {mesh->from, mesh->to};
  for (int k = 0; k < 2; k++) {
    celspan_point a = lists[k][inner], b = lists[k][border];
    lists[k][rim] = (celspan_point){b.x + share * (b.x - a.x), b.y + share * (b.y - a.y)};
  }
}

static void make_rim(cs_warp_mesh *mesh, double share) {
  size_t last = mesh->columns, end = mesh->rows;
  for (size_t j = 1; j < end; j++) {
    continue_way(mesh, place(mesh, 0, j), place(mesh, 1, j), place(mesh, 2, j), share);
    continue_way(mesh, place(mesh, last, j), place(mesh, last - 1, j), place(mesh, last - 2, j),
                 share);
  }
  for (size_t i = 0; i <= last; i++) {
    continue_way(mesh, place(mesh, i, 0), place(mesh, i, 1), place(mesh, i, 2), share);
    continue_way(mesh, place(mesh, i, end), place(mesh, i, end - 1), place(mesh, i, end - 2),
                 share);
  }
}

/* The share of a cell that covers an error, for the narrowest cell. */
static double rim_share(const cs_warp_mesh *mesh, double error) {
  double narrowest = HUGE_VAL;
  for (size_t j = 1; j + 1 < mesh->rows; j++)
    for (size_t i = 1; i + 1 < mesh->columns; i++) {
      celspan_point a = mesh->to[place(mesh, i, j)], b = mesh->to[place(mesh, i + 1, j + 1)];
      narrowest = fmin(narrowest, cs_number_length(a.x - b.x, a.y - b.y));
    }
  return fmin(1, fmax(RIM_LEAST, RIM_MORE * error / narrowest));
}

/* ---------------------------------------------------------------- making */

static celspan_status make(const cs_warp_map *map, const celspan_box *box, size_t n,
                           cs_warp_mesh *out, double *error) {
  cs_warp_mesh_finish(out, map->context->memory);
  divide(box, n, &out->columns, &out->rows);
  out->columns += 2;
  out->rows += 2;
  CS_TRY(CS_MAKE(map->context, out->from, cs_warp_mesh_points(out)));
  CS_TRY(CS_MAKE(map->context, out->to, cs_warp_mesh_points(out)));
  CS_TRY(fill(map, box, out));
  return find_error(map, out, error);
}

celspan_status cs_warp_mesh_make(const cs_warp_map *map, const celspan_box *box,
                                 cs_warp_mesh *out) {
  double error = HUGE_VAL, plain = CS_WARP_PLAIN * map->extent;
  *out = (cs_warp_mesh){0};
  size_t n = 1, most = 1;
  while (triangles(box, most + 1) <= map->pieces)
    most++;
  CS_TRY(make(map, box, n, out, &error));
  while (error > plain && n < most) {
    n = 2 * n <= most ? 2 * n : most;
    CS_TRY(make(map, box, n, out, &error));
  }
  make_rim(out, rim_share(out, error));
  return CELSPAN_OK;
}

void cs_warp_mesh_finish(cs_warp_mesh *mesh, cs_memory *memory) {
  size_t count = cs_warp_mesh_points(mesh);
  cs_mem_free(memory, mesh->from, mesh->from ? count * sizeof *mesh->from : 0);
  cs_mem_free(memory, mesh->to, mesh->to ? count * sizeof *mesh->to : 0);
  *mesh = (cs_warp_mesh){0};
}

/* ---------------------------------------------------------------- folds */

/* Twice the area of the triangle between three points, positive clockwise on screen. */
static double area(const celspan_point *points, size_t a, size_t b, size_t c) {
  celspan_point p = points[a], q = points[b], r = points[c];
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

typedef struct sheet {
  const cs_warp_map *map;
  const cs_warp_mesh *mesh;
  const cs_primitive_data *data;
  const celspan_matrix *matrix;
  bool is_turned; /* most triangles face the other way after the map than before */
} sheet;

static celspan_status check_triangle(const sheet *s, size_t a, size_t b, size_t c) {
  const celspan_point *from = s->mesh->from;
  double turned = area(s->mesh->to, a, b, c);
  if (s->is_turned ? turned <= 0 : turned >= 0)
    return CELSPAN_OK;
  celspan_point own,
      centre = {(from[a].x + from[b].x + from[c].x) / 3, (from[a].y + from[b].y + from[c].y) / 3};
  if (!cs_inside_own_point(s->matrix, centre, &own) || !cs_inside_primitive(s->data, own))
    return CELSPAN_OK;
  return cs_fail(s->map->context, CELSPAN_BAD_ARGUMENT,
                 "warp: the map folds the object near the point %g, %g; bend it less there, or "
                 "over a longer stretch",
                 centre.x, centre.y);
}

/* The sum of the areas of all triangles inside the rim: below 0 if the map mirrors. */
static double sum_areas(const cs_warp_mesh *mesh) {
  double sum = 0;
  for (size_t j = 1; j + 1 < mesh->rows; j++)
    for (size_t i = 1; i + 1 < mesh->columns; i++) {
      size_t at = place(mesh, i, j), below = place(mesh, i, j + 1);
      sum += area(mesh->to, at, at + 1, below) + area(mesh->to, at + 1, below + 1, below);
    }
  return sum;
}

celspan_status cs_warp_mesh_check(const cs_warp_map *map, const cs_warp_mesh *mesh,
                                  const cs_primitive_data *data, const celspan_matrix *matrix) {
  const sheet s = {map, mesh, data, matrix, sum_areas(mesh) < 0};
  for (size_t j = 1; j + 1 < mesh->rows; j++)
    for (size_t i = 1; i + 1 < mesh->columns; i++) {
      size_t at = place(mesh, i, j), below = place(mesh, i, j + 1);
      CS_TRY(check_triangle(&s, at, at + 1, below));
      CS_TRY(check_triangle(&s, at + 1, below + 1, below));
    }
  return CELSPAN_OK;
}
