#include "tools/trace/drawn_lines.h"

#include <math.h>
#include <string.h>

#include "inside/number.h"
#include "inside/sort.h"
#include "tools/trace/colours.h"
#include "tools/trace/spline.h"
#include "tools/trace/thinning.h"

enum { THIRDS = 3, EVENING = 3 };
/* Pixels between the places where shares are measured across a line. */
#define STEP 0.25
/* A share that is noise. */
#define NOTHING 0.06
/* The distance to which shares are measured, as a multiple of a line's depth. */
#define BEYOND 1.5
/* The tolerance of splines, pixels, at smooth 1. */
#define TOLERANCE 0.2

typedef struct liner {
  celspan_context *context;
  const cs_material *material;
  const cs_regions *regions;
  double tolerance;
  unsigned char ground;
  cs_thin thin;
  cs_branches branches;
  celspan_trace *out;
} liner;

/* ---------------------------------------------------------------- the ground */

/* The most frequent label along the rim; the first one, if several labels are equally frequent. */
static unsigned char ground_of(const cs_labels *labels) {
  size_t counts[256] = {0}, best = 0;
  for (int32_t x = 0; x < labels->width; x++) {
    counts[*cs_labels_at(labels, x, 0)]++;
    counts[*cs_labels_at(labels, x, labels->height - 1)]++;
  }
  for (int32_t y = 0; y < labels->height; y++) {
    counts[*cs_labels_at(labels, 0, y)]++;
    counts[*cs_labels_at(labels, labels->width - 1, y)]++;
  }
  for (size_t i = 1; i < 256; i++)
    best = counts[i] > counts[best] ? i : best;
  return (unsigned char)best;
}

/* ---------------------------------------------------------------- across a line */

/* The share of a pixel that the line covers: relative to the ground, or to nothing. */
static double share_of(const liner *l, int32_t x, int32_t y, unsigned char label) {
  const cs_labels *labels = l->material->labels;
  if (x < 0 || y < 0 || x >= labels->width || y >= labels->height)
    return 0;
  unsigned char here = *cs_labels_at(labels, x, y);
  if (here != label && here != l->ground)
    return 0;
  const cs_flat_colour *list = l->material->colours->list;
  cs_light4 light = cs_scan_light(l->material->scan, x, y);
  return (double)cs_labels_share(&light, &list[l->ground].light, &list[label].light);
}

/* The share at a place between the middles of four pixels. */
static double share_at(const liner *l, double x, double y, unsigned char label) {
  double fx = floor(x - 0.5), fy = floor(y - 0.5), u = x - 0.5 - fx, v = y - 0.5 - fy;
  int32_t ix = (int32_t)fx, iy = (int32_t)fy;
  return (1 - v) * ((1 - u) * share_of(l, ix, iy, label) + u * share_of(l, ix + 1, iy, label)) +
         v * ((1 - u) * share_of(l, ix, iy + 1, label) + u * share_of(l, ix + 1, iy + 1, label));
}

/* The sum of the shares from a place along a direction, up to the first share that is noise.
 * Negative if the line does not end in time, as at forks. */
static double extent(const liner *l, const cs_station *from, double nx, double ny, double most,
                     unsigned char label) {
  double sum = 0;
  for (double way = 0.5 * STEP; way < most; way += STEP) {
    double share = share_at(l, from->v[0] + way * nx, from->v[1] + way * ny, label);
    if (share < NOTHING)
      return sum;
    sum += STEP * share;
  }
  return -1;
}

/* Moves a place to the middle of its line, and sets the width; false: the middle cannot be
 * found. */
static bool centre(const liner *l, cs_station *place, celspan_point along, double depth,
                   unsigned char label) {
  double most = BEYOND * depth + 2;
  double left = extent(l, place, along.y, -along.x, most, label);
  double right = extent(l, place, -along.y, along.x, most, label);
  if (left < 0 || right < 0)
    return false;
  place->v[0] += 0.5 * (left - right) * along.y;
  place->v[1] += 0.5 * (right - left) * along.x;
  place->v[2] = left + right;
  return true;
}

/* ---------------------------------------------------------------- one branch */

typedef struct line {
  CS_ARRAY(cs_station, places);
  CS_ARRAY(unsigned char, is_told); /* by place: its width was measured */
  size_t count;
  bool is_closed;
  unsigned char label;
} line;

static size_t wrap(const line *n, ptrdiff_t i) {
  ptrdiff_t count = (ptrdiff_t)n->count;
  if (n->is_closed)
    return (size_t)((i % count + count) % count);
  return (size_t)(i < 0 ? 0 : i >= count ? count - 1 : i);
}

static void make_even(line *n, int values, int rounds) {
  for (int round = 0; round < rounds; round++) {
    cs_station first = n->places[0], before = n->places[wrap(n, -1)];
    for (size_t i = 0; i < n->count; i++) {
      cs_station own = n->places[i];
      bool is_end = !n->is_closed && (i == 0 || i + 1 == n->count);
      const cs_station *after = i + 1 == n->count ? &first : &n->places[i + 1];
      for (int c = 0; c < values && !is_end; c++)
        n->places[i].v[c] = 0.25 * before.v[c] + 0.5 * own.v[c] + 0.25 * after->v[c];
      before = own;
    }
  }
}

static celspan_point along_at(const line *n, size_t i) {
  const double *a = n->places[wrap(n, (ptrdiff_t)i - 3)].v;
  const double *b = n->places[wrap(n, (ptrdiff_t)i + 3)].v;
  double dx = b[0] - a[0], dy = b[1] - a[1], length = cs_number_length(dx, dy);
  return length > 0 ? (celspan_point){dx / length, dy / length} : (celspan_point){1, 0};
}

/* The number of places next to an end that were not found. 0: more than a fork can have disturbed,
 * so they are not changed. */
static size_t spoilt_at(const line *n, bool at_last) {
  size_t count = 0, most = (size_t)n->places[at_last ? n->count - 1 : 0].v[2] + 4;
  while (count < n->count && !n->is_told[at_last ? n->count - 1 - count : count])
    count++;
  return count < n->count && count <= most ? count : 0;
}

/* Thinned lines are drawn towards each other near a fork. Places there that were not found are put
 * on the straight line from the end to the first place that was found. */
static void straighten_end(line *n, bool at_last) {
  size_t count = n->is_closed ? 0 : spoilt_at(n, at_last);
  size_t end = at_last ? n->count - 1 : 0, told = at_last ? end - count : count;
  for (size_t k = 1; k < count; k++) {
    double *place = n->places[at_last ? end - k : k].v;
    double share = (double)k / (double)count;
    for (int c = 0; c < 2; c++)
      place[c] = n->places[end].v[c] + share * (n->places[told].v[c] - n->places[end].v[c]);
  }
}

/* A place without a measured width gets the width of the last measured place before it; places
 * before the first measured one get the width of that one. If no width was measured, all places
 * keep their depths. */
static void fill_widths(line *n) {
  size_t known = n->count;
  for (size_t pass = 0; pass < 2; pass++)
    for (size_t k = 0; k < n->count; k++) {
      size_t i = pass == 0 ? k : n->count - 1 - k;
      if (n->is_told[i] == 1)
        known = i;
      else if (known < n->count && (pass == 0 || !n->is_told[i]))
        n->places[i].v[2] = n->places[known].v[2], n->is_told[i] = 2;
    }
}

static void measure(const liner *l, line *n) {
  make_even(n, 2, EVENING);
  /* The directions are found before the places are moved. */
  for (size_t i = 0; i < n->count; i++) {
    cs_station place = n->places[i];
    double depth = 0.5 * place.v[2];
    n->is_told[i] = centre(l, &place, along_at(n, i), depth, n->label);
    if (n->is_told[i] && fabs(place.v[2] - n->places[i].v[2]) < depth + 1)
      n->places[i] = place;
    else
      n->is_told[i] = 0;
  }
  straighten_end(n, false);
  straighten_end(n, true);
  fill_widths(n);
  make_even(n, 3, 1);
}

/* ---------------------------------------------------------------- strokes */

static celspan_status set_points(const liner *l, const cs_spline *spline, cs_shape *shape) {
  shape->point_count = spline->count;
  CS_TRY(CS_MAKE(l->context, shape->points, spline->count));
  CS_TRY(CS_MAKE(l->context, shape->widths, spline->count));
  for (size_t i = 0; i < spline->count; i++) {
    const double *v = spline->controls[i].v;
    shape->points[i] =
        (celspan_point){floor(v[0] * 1000 + 0.5) / 1000, floor(v[1] * 1000 + 0.5) / 1000};
    shape->widths[i] = v[2] > 0 ? floor(v[2] * 1000 + 0.5) / 1000 : 0;
  }
  return CELSPAN_OK;
}

static double area_of(const line *n) {
  double sum = 0;
  for (size_t i = 0; i + 1 < n->count; i++) {
    const double *a = n->places[i].v, *b = n->places[i + 1].v;
    sum += a[2] * cs_number_length(a[0] - b[0], a[1] - b[1]);
  }
  return sum;
}

static celspan_status add_stroke(const liner *l, const line *n) {
  const cs_flat_colour *colour = &l->material->colours->list[n->label];
  cs_shape shape = {.x = (int32_t)n->places[0].v[0],
                    .y = (int32_t)n->places[0].v[1],
                    .area = round(area_of(n)),
                    .is_closed = n->is_closed};
  cs_spline spline;
  memcpy(shape.colour, colour->code, sizeof shape.colour);
  CS_TRY(cs_spline_fit(l->context, n->places, n->count, n->is_closed, l->tolerance, &spline));
  celspan_status status = set_points(l, &spline, &shape);
  cs_mem_free(l->context->memory, spline.controls, spline.count * sizeof *spline.controls);
  if (status == CELSPAN_OK)
    return cs_result_add(l->context, l->out, &shape);
  cs_result_finish_shape(l->context->memory, &shape);
  return status;
}

/* A single pixel is what remains of a dot: it becomes a disc of the same area, around its
 * middle. */
static void set_dot(const liner *l, const cs_branch *branch, line *n) {
  size_t place = l->branches.places[branch->first];
  int32_t x = (int32_t)(place % l->thin.stride) - 1, y = (int32_t)(place / l->thin.stride) - 1;
  const cs_region *region = &l->regions->list[cs_regions_at(l->regions, x, y)];
  n->places[0].v[2] = 2 * sqrt(region->area / 3.141592653589793);
}

static void set_places(const liner *l, const cs_branch *branch, line *n) {
  for (size_t i = 0; i < n->count; i++) {
    size_t place = l->branches.places[branch->first + i];
    double depth = (double)l->thin.depths[place] / THIRDS;
    n->places[i] = (cs_station){{(double)(place % l->thin.stride) - 0.5,
                                 (double)(place / l->thin.stride) - 0.5, 2 * depth - 1}};
  }
}

static celspan_status add_branch(const liner *l, const cs_branch *branch) {
  line n = {.count = branch->count, .is_closed = branch->is_closed};
  n.label = (unsigned char)((l->thin.plane[l->branches.places[branch->first]] & 127) - 1);
  celspan_status status = CS_ARRAY_MAKE(l->context, n.places, n.count);
  if (status == CELSPAN_OK)
    status = CS_ARRAY_MAKE(l->context, n.is_told, n.count);
  if (status == CELSPAN_OK) {
    set_places(l, branch, &n);
    if (n.count == 1)
      set_dot(l, branch, &n);
    else
      measure(l, &n);
    status = add_stroke(l, &n);
  }
  CS_ARRAYS_FREE(l->context->memory, &n, places, is_told);
  return status;
}

static inline bool is_before(const cs_branch *a, const cs_branch *b) {
  return a->count != b->count ? a->count > b->count : a->first < b->first;
}
CS_SORT_DEFINE(sort_branches, cs_branch, is_before)

static celspan_status add_branches(liner *l) {
  CS_TRY(cs_branches_find(l->context, &l->thin, &l->branches));
  sort_branches(l->branches.list, l->branches.count);
  for (size_t i = 0; i < l->branches.count; i++)
    CS_TRY(add_branch(l, &l->branches.list[i]));
  return CELSPAN_OK;
}

celspan_status cs_lines_make(celspan_context *context, const cs_material *material,
                             const cs_regions *regions, double smooth, celspan_trace *out) {
  liner l = {.context = context, .material = material, .regions = regions, .out = out};
  l.tolerance = TOLERANCE * (smooth > 0.25 ? smooth : 0.25);
  l.ground = ground_of(material->labels);
  CS_TRY(cs_thin_make(context, material, l.ground, &l.thin));
  celspan_status status = add_branches(&l);
  cs_branches_finish(&l.branches, context);
  cs_thin_finish(&l.thin, context);
  return status;
}

celspan_stroke_desc cs_lines_stroke(const cs_shape *shape) {
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  desc.points = shape->points;
  desc.widths = shape->widths;
  desc.point_count = shape->point_count;
  desc.degree = 3;
  desc.closed = shape->is_closed;
  desc.cap = CELSPAN_STROKE_CAP_ROUND;
  desc.join = CELSPAN_STROKE_JOIN_ROUND;
  return desc;
}
