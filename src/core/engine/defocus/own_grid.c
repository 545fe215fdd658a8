#include "engine/defocus/own_grid.h"

#include "base/number.h"
#include "model/scene/bounds.h"

#include <math.h>

/* Nodes in a radius: for a Gaussian, enough so that the cubics between the nodes (regrid.h) differ
 * from it by at most 3/4 of an 8-bit code; for the other kernels, as on the grids of frames
 * (defocus.c). */
#define NODES_GAUSSIAN 6
#define NODES_DISC 28
#define NODES_BOX 64
/* The most and the fewest samples of pictures in the radius of a Gaussian. */
#define SAMPLES_FINE 18
#define SAMPLES_LEAST 4
#define WIDE 12        /* pixels: the least radius at which pictures are sampled between nodes */
#define LEAST_RADIUS 3 /* pixels: smaller radii would need many nodes for each pixel */
#define BEYOND 4       /* nodes of the part beyond the visible area */
/* nodes from the cel's origin, where the axes are wrong by 1/100 */
#define FARTHEST (1 << 17)
#define PARTS 8       /* the part is rounded to this share of the frame's nodes */
#define LEAST_STEP 16 /* but at least to this number of nodes */

/* The values of the grid along an axis that follow from the frame. Those of single precision are
 * equal in frames that differ only in the last bits of a product of matrices. */
typedef struct grid_axis {
  double scale;   /* pixels for one of the cel's units */
  double turn[2]; /* the direction of the axis in the cel, of length 1; of single precision */
  double radius;  /* in the cel's units; of single precision */
  double density; /* nodes for one of the cel's units */
} grid_axis;

/* ---------------------------------------------------------------- density */

/* The least class that is not less than a scale: the powers of the fourth root of 2. Scales within
 * 1e-6 of a class are of that class, because products of matrices are rounded. */
static double class_of(double scale) {
  const double classes[4] = {0.59460355750136054, 0.70710678118654752, 0.84089641525371454, 1};
  int exponent, k = 0;
  double share = frexp(scale * (1 - 1e-6), &exponent); /* 1/2 .. 1 */
  while (classes[k] < share)
    k++;
  return ldexp(classes[k], exponent);
}

static double nodes_in_radius(celspan_defocus_kernel kernel) {
  return kernel == CELSPAN_DEFOCUS_GAUSSIAN ? NODES_GAUSSIAN
         : kernel == CELSPAN_DEFOCUS_DISC   ? NODES_DISC
                                            : NODES_BOX;
}

/* Pictures under a Gaussian that is not wide are sampled at the nodes, about once for each pixel;
 * under a wide Gaussian there are half as many nodes along each axis or fewer, and samples between
 * them. */
static void choose_density(const cs_blur *blur, bool varies, grid_axis axes[2], double *samples) {
  bool is_gaussian = blur->kind == CELSPAN_DEFOCUS_GAUSSIAN;
  bool is_wide = fmin(blur->radius_x, blur->radius_y) >= WIDE;
  bool is_sampled = varies && is_gaussian && !is_wide;
  *samples = is_wide ? SAMPLES_FINE : SAMPLES_LEAST;
  for (int k = 0; k < 2; k++) {
    grid_axis *a = &axes[k];
    double least = nodes_in_radius(blur->kind) / a->radius;
    double most = SAMPLES_FINE / a->radius;
    a->density = is_sampled ? cs_number_clamp(class_of(a->scale), least, most) : least;
  }
}

/* ---------------------------------------------------------------- axes */

static bool find_axis(const celspan_matrix *matrix, const cs_blur *blur, int k, grid_axis *out) {
  const double *m = matrix->m + 3 * k;
  double radius = cs_defocus_radius(blur, k), least = LEAST_RADIUS;
  out->scale = cs_number_length(m[0], m[1]);
  out->turn[0] = cs_number_single(m[0] / out->scale);
  out->turn[1] = cs_number_single(m[1] / out->scale);
  out->radius = cs_number_single(radius / out->scale);
  if (blur->kind != CELSPAN_DEFOCUS_GAUSSIAN)
    least = blur->kind == CELSPAN_DEFOCUS_DISC ? NODES_DISC : NODES_BOX;
  return cs_number_is_sane(out->scale) && out->scale > 1 / CS_NUMBER_LIMIT && radius >= least;
}

/* The blur on the grid: nodes for numbers of single precision. */
static cs_blur blur_on(const cs_blur *blur, const grid_axis axes[2]) {
  cs_blur out = {.kind = blur->kind,
                 .radius_x = axes[0].radius * axes[0].density,
                 .radius_y = axes[1].radius * axes[1].density};
  for (int k = 0; k < 4; k++) {
    const grid_axis *a = &axes[k % 2];
    out.edges[k / 2][k % 2] = cs_number_single(blur->edges[k / 2][k % 2] / a->scale) * a->density;
  }
  return out;
}

/* ---------------------------------------------------------------- the part */

/* The step to which a part is rounded: a power of two. */
static double step_of(double nodes) {
  double step = LEAST_STEP;
  while (2 * step <= nodes)
    step *= 2;
  return step;
}

/* The part of an axis: the blurred artwork that is visible in the frame, [low, high) in nodes of
 * the whole grid. size: of the frame, pixels. */
static bool find_part(cs_own_grid *grid, int k, int32_t size, double low, double high) {
  double far = cs_defocus_extent(&grid->blur, k) + BEYOND, nodes = size * grid->scale[k];
  double step = step_of(k == 0 ? nodes / PARTS : nodes); /* rows are made when they are needed */
  /* the nodes at the border of the frame's own grid lie outside the frame */
  double margin = BEYOND + far;
  double first = step * floor((grid->offset[k] - margin) / step);
  double end = step * ceil((grid->offset[k] + nodes + margin) / step);
  first = fmax(first, floor(low - far));
  end = fmin(end, ceil(high + far));
  if (!(first < end && first > -FARTHEST && end < FARTHEST))
    return false;
  grid->matrix.m[3 * k + 2] = -first;
  grid->size[k] = (int32_t)(end - first);
  grid->offset[k] -= first;
  return true;
}

/* The matrix, up to the origin of the part, and the mapping from the frame. */
static void find_matrix(const celspan_matrix *placement, const grid_axis axes[2],
                        cs_own_grid *out) {
  out->matrix = celspan_matrix_identity();
  for (int k = 0; k < 2; k++) {
    const grid_axis *a = &axes[k];
    out->matrix.m[3 * k] = a->density * a->turn[0];
    out->matrix.m[3 * k + 1] = a->density * a->turn[1];
    out->scale[k] = a->density / a->scale;
    out->offset[k] = -placement->m[3 * k + 2] * out->scale[k];
  }
}

bool cs_own_grid_find(const cs_defocus_cel *place, const cs_blur *blur, bool varies,
                      cs_own_grid *out) {
  const celspan_cel *cel = place->cel;
  celspan_matrix facing = cs_matrix_facing(&place->matrix);
  const double *m = facing.m;
  grid_axis axes[2];
  celspan_box art;
  if (m[6] != 0 || m[7] != 0 || m[8] != 1 || !find_axis(&facing, blur, 0, &axes[0]) ||
      !find_axis(&facing, blur, 1, &axes[1]))
    return false;
  choose_density(blur, varies, axes, &out->samples);
  out->blur = blur_on(blur, axes);
  find_matrix(&facing, axes, out);
  return cs_bounds_around(cel->objects, cel->object_count, &out->matrix, &art) &&
         find_part(out, 0, place->width, art.x, art.x + art.width) &&
         find_part(out, 1, place->height, art.y, art.y + art.height);
}
