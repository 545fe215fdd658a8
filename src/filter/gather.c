/* Gathering: where the steps of the pieces under a kernel go, column by column. */
#include "filter/convolve.h"

#include "base/number.h"

#include <math.h>

#define NARROW 1e-4  /* of the radius: pieces that cross less stand upright */
#define NOTHING 1e-9 /* slices that are shorter have no weight to speak of */
#define RAMP 8       /* columns; longer slices are ramps to pieces that cross little of them */

/* One row's worth of work. */
typedef struct gather {
  cs_convolve *convolve;
  celspan_context *context;
  double centre;         /* of the row that is made */
  const cs_trace *trace; /* of the row that is read, */
  uint32_t row;          /* its place among those under the kernel */
  int32_t *looks;        /* of the trace's programs */
} gather;

/* A part of a piece, and the share of the kernel at its heights. */
typedef struct part {
  double low, high; /* x */
  double from, to;  /* the kernel at its heights, about the centre of a pixel */
  double weight;
  int32_t first, end; /* columns that it parts; from `end` on it is passed */
  int slab, slab_end;
} part;

static void touch(cs_convolve *convolve, int32_t p) {
  uint64_t bit = (uint64_t)1 << (p % 64), *word = &convolve->touched[p / 64];
  if (*word & bit)
    return;
  *word |= bit;
  memset(convolve->changes[p], 0, sizeof convolve->changes[p]);
  if (convolve->slopes)
    memset(convolve->slopes[p], 0, sizeof convolve->slopes[p]);
  convolve->shifts_at[p] = 0;
  if (convolve->kernel->is_signed) {
    convolve->passages_at[p] = 0;
    convolve->near[p] = cs_convolve_nothing();
  }
}

static celspan_status shift_look(gather *g, int32_t p, int32_t program, double weight) {
  cs_convolve *convolve = g->convolve;
  if (program < 0)
    return CELSPAN_OK;
  CS_TRY(cs_mem_reserve(g->context, (void **)&convolve->shifts, &convolve->shift_capacity,
                        convolve->shift_count + 1, sizeof *convolve->shifts));
  convolve->shifts[convolve->shift_count++] =
      (cs_convolve_shift){convolve->shifts_at[p], (uint32_t)g->looks[program], weight};
  convolve->shifts_at[p] = (uint32_t)convolve->shift_count;
  return CELSPAN_OK;
}

/* From column p on, `weight` more of what is seen is what lies right of the piece. */
static celspan_status change(gather *g, const cs_trace_piece *piece, int32_t p, double weight) {
  double *sum = g->convolve->changes[p];
  for (int c = 0; c < 4; c++)
    sum[c] += weight * ((double)piece->right.colour[c] - (double)piece->left.colour[c]);
  CS_TRY(shift_look(g, p, piece->left.program, -weight));
  return shift_look(g, p, piece->right.program, weight);
}

static celspan_status pass(gather *g, const cs_trace_piece *piece, const part *t) {
  cs_convolve *convolve = g->convolve;
  int32_t p = t->end < 0 ? 0 : t->end;
  if (!convolve->kernel->is_signed || p >= convolve->width || t->slab == t->slab_end)
    return CELSPAN_OK;
  CS_TRY(cs_mem_reserve(g->context, (void **)&convolve->passages, &convolve->passage_capacity,
                        convolve->passage_count + 1, sizeof *convolve->passages));
  cs_convolve_passage *passage = &convolve->passages[convolve->passage_count++];
  *passage =
      (cs_convolve_passage){.next = convolve->passages_at[p],
                            .row = g->row,
                            .slab = t->slab,
                            .slab_end = t->slab_end,
                            .varies = (piece->right.program >= 0) - (piece->left.program >= 0)};
  for (int c = 0; c < 4; c++)
    passage->step[c] = (double)piece->right.colour[c] - (double)piece->left.colour[c];
  convolve->passages_at[p] = (uint32_t)convolve->passage_count;
  return CELSPAN_OK;
}

static void see_looks(cs_convolve *convolve, const cs_trace_piece *piece, int32_t p) {
  if (piece->left.program < 0)
    cs_convolve_widen(&convolve->near[p], piece->left.colour);
  if (piece->right.program < 0)
    cs_convolve_widen(&convolve->near[p], piece->right.colour);
}

static double half_square(double v) { return v > 0 ? 0.5 * v * v : 0; }

/* The share of an even slice of the kernel about c that lies right of the part. */
static double even_right(const part *t, double c) {
  double length = t->to - t->from, across = t->high - t->low;
  if (across < NARROW * length)
    return cs_number_clamp((c + t->to - 0.5 * (t->low + t->high)) / length, 0, 1);
  return (half_square(c + t->to - t->low) - half_square(c + t->from - t->low) -
          half_square(c + t->to - t->high) + half_square(c + t->from - t->high)) /
         (length * across);
}

/* The share of the kernel at column p that lies right of the part. */
static double share_right(const cs_kernel *kernel, const part *t, int32_t p) {
  double scale = 1 / kernel->radius_x, centre = p + 0.5;
  double across = (t->high - t->low) * scale;
  if (kernel->shape != CS_KERNEL_SEPARABLE)
    return even_right(t, centre);
  if (across < NARROW)
    return cs_kernel_left(kernel, (centre - 0.5 * (t->low + t->high)) * scale);
  return (cs_kernel_sum(kernel, (centre - t->low) * scale) -
          cs_kernel_sum(kernel, (centre - t->high) * scale)) /
         across;
}

static celspan_status spread(gather *g, const cs_trace_piece *piece, const part *t) {
  cs_convolve *convolve = g->convolve;
  double before = 0;
  int32_t stop = t->end < convolve->width ? t->end : convolve->width;
  for (int32_t p = t->first > 0 ? t->first : 0; p < stop; p++) {
    double now = share_right(convolve->kernel, t, p);
    touch(convolve, p);
    CS_TRY(change(g, piece, p, t->weight * (now - before)));
    if (convolve->kernel->is_signed)
      see_looks(convolve, piece, p);
    before = now;
  }
  if (t->end >= convolve->width)
    return CELSPAN_OK;
  int32_t rest = t->end > 0 ? t->end : 0;
  touch(convolve, rest);
  CS_TRY(change(g, piece, rest, t->weight * (1 - before)));
  return pass(g, piece, t);
}

static void tilt(gather *g, const cs_trace_piece *piece, int32_t p, double slope) {
  double *sum = g->convolve->slopes[p];
  for (int c = 0; c < 4; c++)
    sum[c] += slope * ((double)piece->right.colour[c] - (double)piece->left.colour[c]);
}

/* An upright edge under an even slice is a ramp: one change where it begins, one where it ends. */
static celspan_status spread_ramp(gather *g, const cs_trace_piece *piece, const part *t) {
  cs_convolve *convolve = g->convolve;
  double x = 0.5 * (t->low + t->high), slope = 1 / (t->to - t->from);
  int32_t first = cs_number_first_centre(x - t->to), end = cs_number_first_centre(x - t->from);
  first = first > 0 ? first : 0;
  if (first >= convolve->width)
    return CELSPAN_OK;
  double now = end > first ? (first + 0.5 + t->to - x) * slope : 1;
  touch(convolve, first);
  CS_TRY(change(g, piece, first, t->weight * now));
  if (end <= first)
    return CELSPAN_OK;
  tilt(g, piece, first, t->weight * slope);
  if (end >= convolve->width)
    return CELSPAN_OK;
  touch(convolve, end);
  tilt(g, piece, end, -t->weight * slope);
  return change(g, piece, end, t->weight * (1 - (now + (end - first) * slope)));
}

static celspan_status add_part(gather *g, const cs_trace_piece *piece, part *t) {
  const cs_kernel *kernel = g->convolve->kernel;
  if (t->weight == 0 && !kernel->is_signed)
    return CELSPAN_OK;
  t->first = cs_number_first_centre(t->low - t->to);
  t->end = cs_number_first_centre(t->high - t->from);
  bool is_ramp = kernel->shape != CS_KERNEL_SEPARABLE && t->end - t->first > RAMP &&
                 t->high - t->low <= (t->to - t->from) / RAMP && piece->left.program < 0 &&
                 piece->right.program < 0;
  return is_ramp ? spread_ramp(g, piece, t) : spread(g, piece, t);
}

/* In how many parts the kernel is even enough over a piece's heights: upright ones need no cut
 * under a separable kernel, nor slanted ones under an upright box. */
static int count_parts(const cs_kernel *kernel, const cs_trace_piece *piece) {
  double height = piece->yb - piece->ya, across = fabs(piece->xb - piece->xa);
  double slope = across / height, parts;
  if (kernel->shape == CS_KERNEL_SEPARABLE) {
    parts = ceil(height * kernel->rows * sqrt(slope < 1 ? slope : 1));
  } else {
    bool is_upright = kernel->shape == CS_KERNEL_PARALLELOGRAM && kernel->edges[0][1] == 0 &&
                      kernel->edges[1][0] == 0;
    parts = is_upright ? 1 : ceil(height * kernel->rows / kernel->radius_y);
    if (2 * kernel->radius_x > RAMP)
      parts = fmax(parts, ceil(across * RAMP / (2 * kernel->radius_x)));
  }
  return parts > 1 ? (int)parts : 1;
}

/* The first slab of the trace's row whose middle is at or below height y. */
static int first_slab(const gather *g, double y) {
  double slab = ceil((y - g->trace->row) * CS_CONVOLVE_SLABS - 0.5);
  return (int)cs_number_clamp(slab, 0, CS_CONVOLVE_SLABS);
}

/* The kernel at a part's heights. */
static bool slice_kernel(const cs_kernel *kernel, double d, part *t) {
  t->from = -kernel->radius_x;
  t->to = kernel->radius_x;
  if (kernel->shape == CS_KERNEL_SEPARABLE)
    return true;
  return cs_kernel_slice(kernel, d, &t->from, &t->to) && t->to - t->from > NOTHING;
}

/* A piece as a kernel `dx`, `dy` from the pixel's centre sees it, of `share` of the whole. */
static celspan_status add_piece_at(gather *g, const cs_trace_piece *piece, double dx, double dy,
                                   double share) {
  const cs_kernel *kernel = g->convolve->kernel;
  int count = count_parts(kernel, piece);
  double xa = piece->xa, ya = piece->ya, centre = g->centre + dy;
  double above = cs_kernel_above(kernel, ya - centre);
  for (int k = 1; k <= count; k++) {
    double u = (double)k / count;
    double xb = k == count ? piece->xb : piece->xa + u * (piece->xb - piece->xa);
    double yb = k == count ? piece->yb : piece->ya + u * (piece->yb - piece->ya);
    double below = cs_kernel_above(kernel, yb - centre);
    part t = {.low = (xa < xb ? xa : xb) - dx,
              .high = (xa < xb ? xb : xa) - dx,
              .weight = share * (below - above),
              .slab = first_slab(g, ya),
              .slab_end = first_slab(g, yb)};
    if (slice_kernel(kernel, 0.5 * (ya + yb) - centre, &t))
      CS_TRY(add_part(g, piece, &t));
    xa = xb;
    ya = yb;
    above = below;
  }
  return CELSPAN_OK;
}

/* What of a piece lies at the heights of the kernel; false: nothing. */
static bool cut_piece(const cs_trace_piece *piece, double top, double foot, cs_trace_piece *out) {
  double slope = (piece->xb - piece->xa) / (piece->yb - piece->ya);
  *out = *piece;
  if (piece->yb <= top || piece->ya >= foot)
    return false;
  if (piece->ya < top) {
    out->ya = top;
    out->xa = piece->xa + (top - piece->ya) * slope;
  }
  if (piece->yb > foot) {
    out->yb = foot;
    out->xb = piece->xa + (foot - piece->ya) * slope;
  }
  return true;
}

static celspan_status add_piece_seen(gather *g, const cs_trace_piece *piece, double dx, double dy,
                                     double share) {
  double radius = g->convolve->kernel->radius_y, centre = g->centre + dy;
  cs_trace_piece cut;
  return cut_piece(piece, centre - radius, centre + radius, &cut)
             ? add_piece_at(g, &cut, dx, dy, share)
             : CELSPAN_OK;
}

static celspan_status add_piece(gather *g, const cs_trace_piece *piece) {
  const cs_kernel *kernel = g->convolve->kernel;
  int count = kernel->offsets;
  if (count <= 1)
    return add_piece_seen(g, piece, 0, 0, 1);
  for (int j = 0; j < count; j++)
    for (int i = 0; i < count; i++)
      CS_TRY(add_piece_seen(g, piece, ((i + 0.5) / count - 0.5) * kernel->spread,
                            ((j + 0.5) / count - 0.5) * kernel->spread, 1.0 / (count * count)));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- looks */

static bool are_alike(const cs_composer *composer, const cs_program *a, const cs_program *b) {
  if (a->length != b->length || memcmp(a->items, b->items, a->length * sizeof *a->items) != 0)
    return false;
  for (uint32_t i = 0; a->strips != b->strips && i < a->length; i++)
    if (composer->stack->leaves[a->items[i].leaf].kind == CS_LEAF_SCANLINE)
      return false; /* strips are named row by row */
  return true;
}

static celspan_status find_look(gather *g, const cs_composer *composer, const cs_program *program,
                                int32_t *out) {
  cs_convolve *convolve = g->convolve;
  for (size_t i = convolve->look_count; i-- > 0;)
    if (are_alike(composer, convolve->looks[i].program, program)) {
      *out = (int32_t)i;
      return CELSPAN_OK;
    }
  CS_TRY(cs_mem_reserve(g->context, (void **)&convolve->looks, &convolve->look_capacity,
                        convolve->look_count + 1, sizeof *convolve->looks));
  convolve->looks[convolve->look_count] = (cs_convolve_look){.program = program};
  *out = (int32_t)convolve->look_count++;
  return CELSPAN_OK;
}

static celspan_status add_trace(gather *g, cs_composer *composer) {
  const cs_trace *trace = g->trace;
  g->looks = NULL;
  if (trace->program_count > 0) {
    cs_arena_reset(&composer->scratch);
    g->looks =
        cs_arena_take(g->context, &composer->scratch, trace->program_count * sizeof *g->looks);
    if (!g->looks)
      return CELSPAN_NO_MEMORY;
  }
  for (size_t i = 0; i < trace->program_count; i++)
    CS_TRY(find_look(g, composer, &trace->programs[i].program, &g->looks[i]));
  for (size_t i = 0; i < trace->piece_count; i++)
    CS_TRY(add_piece(g, &trace->pieces[i]));
  return CELSPAN_OK;
}

celspan_status cs_convolve_gather(cs_convolve *convolve, cs_composer *composer,
                                  const cs_trace *const *traces, size_t count, int32_t y) {
  gather g = {.convolve = convolve, .context = composer->context, .centre = y + 0.5};
  convolve->look_count = convolve->shift_count = convolve->passage_count = 0;
  memset(convolve->touched, 0, cs_convolve_words(convolve->width) * sizeof *convolve->touched);
  touch(convolve, 0);
  for (size_t i = 0; i < count; i++) {
    g.trace = traces[i];
    g.row = (uint32_t)i;
    CS_TRY(add_trace(&g, composer));
  }
  return CELSPAN_OK;
}
