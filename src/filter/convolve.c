#include "filter/convolve.h"

#include "base/number.h"

#include <math.h>

#define NARROW 1e-4 /* of the radius: pieces that cross less stand upright */
#define RAMP 8      /* columns; slices that are longer are ramps to pieces that cross little of them */
#define NOTHING 1e-9 /* weights and colours below this are rounding */

/* ---------------------------------------------------------------- life */

static size_t word_count(int32_t width) { return (size_t)width / 64 + 1; }

celspan_status cs_convolve_init(cs_convolve *convolve, celspan_context *context,
                                const cs_kernel *kernel, int32_t width) {
  cs_memory *memory = context->memory;
  size_t columns = (size_t)width;
  *convolve = (cs_convolve){.kernel = kernel, .width = width};
  convolve->changes = cs_mem_array(memory, columns, sizeof *convolve->changes);
  convolve->touched = cs_mem_array(memory, word_count(width), sizeof *convolve->touched);
  convolve->shifts_at = cs_mem_array(memory, columns, sizeof *convolve->shifts_at);
  bool is_whole = convolve->changes && convolve->touched && convolve->shifts_at;
  if (kernel->shape != CS_KERNEL_SEPARABLE) {
    convolve->slopes = cs_mem_array(memory, columns, sizeof *convolve->slopes);
    is_whole = is_whole && convolve->slopes;
  }
  if (kernel->is_signed) {
    convolve->passages_at = cs_mem_array(memory, columns, sizeof *convolve->passages_at);
    convolve->least = cs_mem_array(memory, columns, sizeof *convolve->least);
    convolve->most = cs_mem_array(memory, columns, sizeof *convolve->most);
    is_whole = is_whole && convolve->passages_at && convolve->least && convolve->most;
  }
  return is_whole ? CELSPAN_OK : cs_fail_memory(context);
}

void cs_convolve_finish(cs_convolve *convolve, cs_memory *memory) {
  size_t columns = (size_t)convolve->width;
  cs_mem_free(memory, convolve->changes, columns * sizeof *convolve->changes);
  cs_mem_free(memory, convolve->slopes, columns * sizeof *convolve->slopes);
  cs_mem_free(memory, convolve->touched, word_count(convolve->width) * sizeof(uint64_t));
  cs_mem_free(memory, convolve->shifts_at, columns * sizeof(uint32_t));
  cs_mem_free(memory, convolve->passages_at, columns * sizeof(uint32_t));
  cs_mem_free(memory, convolve->least, columns * sizeof(cs_v4));
  cs_mem_free(memory, convolve->most, columns * sizeof(cs_v4));
  cs_mem_free(memory, convolve->looks, convolve->look_capacity * sizeof *convolve->looks);
  cs_mem_free(memory, convolve->shifts, convolve->shift_capacity * sizeof *convolve->shifts);
  cs_mem_free(memory, convolve->passages,
              convolve->passage_capacity * sizeof *convolve->passages);
  cs_mem_free(memory, convolve->slabs, convolve->slab_capacity * sizeof *convolve->slabs);
  cs_mem_free(memory, convolve->ranges, convolve->range_capacity * sizeof *convolve->ranges);
  *convolve = (cs_convolve){0};
}

/* ---------------------------------------------------------------- gathering
 *
 * One row's worth of work: where its pieces' steps go. */

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
    convolve->least[p] = cs_v4_all(INFINITY);
    convolve->most[p] = cs_v4_all(-INFINITY);
  }
}

static cs_v4 lesser(cs_v4 a, cs_v4 b) {
  for (int c = 0; c < 4; c++)
    a[c] = b[c] < a[c] ? b[c] : a[c];
  return a;
}

static cs_v4 greater(cs_v4 a, cs_v4 b) {
  for (int c = 0; c < 4; c++)
    a[c] = b[c] > a[c] ? b[c] : a[c];
  return a;
}

static void widen(cs_v4 *least, cs_v4 *most, cs_v4 colour) {
  *least = lesser(*least, colour);
  *most = greater(*most, colour);
}

static celspan_status shift_look(gather *g, int32_t p, int32_t program, double weight) {
  cs_convolve *convolve = g->convolve;
  if (program < 0)
    return CELSPAN_OK;
  CS_TRY(cs_mem_reserve(g->context, (void **)&convolve->shifts, &convolve->shift_capacity,
                        convolve->shift_count + 1, sizeof *convolve->shifts));
  convolve->shifts[convolve->shift_count++] = (cs_convolve_shift){
      convolve->shifts_at[p], (uint32_t)g->looks[program], weight};
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
  *passage = (cs_convolve_passage){
      .next = convolve->passages_at[p],
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
    widen(&convolve->least[p], &convolve->most[p], piece->left.colour);
  if (piece->right.program < 0)
    widen(&convolve->least[p], &convolve->most[p], piece->right.colour);
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
    g->looks = cs_arena_take(g->context, &composer->scratch,
                             trace->program_count * sizeof *g->looks);
    if (!g->looks)
      return CELSPAN_NO_MEMORY;
  }
  for (size_t i = 0; i < trace->program_count; i++)
    CS_TRY(find_look(g, composer, &trace->programs[i].program, &g->looks[i]));
  for (size_t i = 0; i < trace->piece_count; i++)
    CS_TRY(add_piece(g, &trace->pieces[i]));
  return CELSPAN_OK;
}

/* Slabs beyond the kernel are left out as those that vary are. */
static celspan_status begin_slabs(cs_convolve *convolve, celspan_context *context,
                                  const cs_trace *const *traces, size_t rows, int32_t y) {
  size_t count = convolve->kernel->is_signed ? rows * CS_CONVOLVE_SLABS : 0;
  CS_TRY(cs_mem_reserve(context, (void **)&convolve->slabs, &convolve->slab_capacity, count,
                        sizeof *convolve->slabs));
  CS_TRY(cs_mem_reserve(context, (void **)&convolve->ranges, &convolve->range_capacity,
                        count / CS_CONVOLVE_SLABS, sizeof *convolve->ranges));
  for (size_t i = 0; i < count / CS_CONVOLVE_SLABS; i++)
    convolve->ranges[i] = (cs_convolve_range){traces[0]->base, traces[0]->base};
  for (size_t i = 0; i < count; i++) {
    double height = traces[i / CS_CONVOLVE_SLABS]->row +
                    ((double)(i % CS_CONVOLVE_SLABS) + 0.5) / CS_CONVOLVE_SLABS;
    cs_convolve_slab *slab = &convolve->slabs[i];
    slab->varies = fabs(height - (y + 0.5)) >= convolve->kernel->radius_y;
    for (int c = 0; c < 4; c++)
      slab->colour[c] = (double)traces[0]->base[c];
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- summing */

typedef struct summing {
  cs_convolve *convolve;
  cs_composer *composer;
  cs_row *out;
  double y;         /* centre */
  size_t rows;      /* under the kernel */
  int32_t at;       /* the column that was reached, */
  double sum[4];    /* the flat colours, weighed, there, */
  double slope[4];  /* and their change from column to column after it */
  size_t varying;   /* looks whose weight is not nothing */
  cs_convolve_range range; /* of what lies under the kernel, but near pieces */
} summing;

/* Sums of floats times weights that make 1: rounding beyond the 40th bit is dropped, so that what
 * began as one colour ends as that colour. */
static double tidy(double value) { return rint(value * 0x1p40) * 0x1p-40; }

/* The range of what is seen at the heights of a row. */
static void see_row(cs_convolve *convolve, size_t row) {
  cs_convolve_range range = {cs_v4_all(INFINITY), cs_v4_all(-INFINITY)};
  for (size_t i = row * CS_CONVOLVE_SLABS; i < (row + 1) * CS_CONVOLVE_SLABS; i++) {
    const cs_convolve_slab *slab = &convolve->slabs[i];
    if (slab->varies > 0)
      continue;
    cs_v4 colour;
    for (int c = 0; c < 4; c++)
      colour[c] = (float)slab->colour[c];
    range.least = lesser(range.least, colour);
    range.most = greater(range.most, colour);
  }
  convolve->ranges[row] = range;
}

static void see_rows(summing *s) {
  s->range = s->convolve->ranges[0];
  for (size_t row = 1; row < s->rows; row++) {
    s->range.least = lesser(s->range.least, s->convolve->ranges[row].least);
    s->range.most = greater(s->range.most, s->convolve->ranges[row].most);
  }
}

static void pass_piece(cs_convolve *convolve, const cs_convolve_passage *passage) {
  for (int k = passage->slab; k < passage->slab_end; k++) {
    cs_convolve_slab *slab = &convolve->slabs[passage->row * CS_CONVOLVE_SLABS + (size_t)k];
    slab->varies += passage->varies;
    for (int c = 0; c < 4; c++)
      slab->colour[c] += passage->step[c];
  }
}

/* Passages of a row stand together in a list. */
static void pass_pieces(summing *s, int32_t p) {
  cs_convolve *convolve = s->convolve;
  for (uint32_t at = convolve->passages_at[p]; at != 0;) {
    const cs_convolve_passage *passage = &convolve->passages[at - 1];
    pass_piece(convolve, passage);
    at = passage->next;
    if (at == 0 || convolve->passages[at - 1].row != passage->row)
      see_row(convolve, passage->row);
  }
  see_rows(s);
}

static void reach_column(summing *s, int32_t p) {
  cs_convolve *convolve = s->convolve;
  for (int c = 0; c < 4; c++) {
    s->sum[c] += s->slope[c] * (p - s->at) + convolve->changes[p][c];
    s->slope[c] += convolve->slopes ? convolve->slopes[p][c] : 0;
  }
  s->at = p;
  for (uint32_t at = convolve->shifts_at[p]; at != 0; at = convolve->shifts[at - 1].next) {
    const cs_convolve_shift *shift = &convolve->shifts[at - 1];
    double *weight = &convolve->looks[shift->look].weight;
    s->varying -= fabs(*weight) > NOTHING;
    *weight += shift->weight;
    s->varying += fabs(*weight) > NOTHING;
  }
  if (convolve->kernel->is_signed && convolve->passages_at[p] != 0)
    pass_pieces(s, p);
}

static cs_v4 hold(cs_v4 colour, cs_v4 least, cs_v4 most) {
  for (int c = 0; c < 4; c++)
    colour[c] = cs_number_clampf(colour[c], least[c], most[c]);
  return colour;
}

static cs_v4 flat_sum(const summing *s, int32_t x) {
  cs_v4 colour;
  for (int c = 0; c < 4; c++)
    colour[c] = (float)tidy(s->sum[c] + s->slope[c] * (x - s->at));
  return colour;
}

static cs_v4 flat_slope(const summing *s) {
  cs_v4 slope;
  for (int c = 0; c < 4; c++)
    slope[c] = (float)tidy(s->slope[c]);
  return slope;
}

static cs_v4 hold_alpha(cs_v4 colour) {
  colour[3] = cs_number_clampf(colour[3], 0, 1);
  return colour;
}

/* Adds a look, in its weight, to what the columns from x0 on have so far. */
static celspan_status add_look(summing *s, const cs_convolve_look *look, int32_t x0, int32_t x1,
                               cs_v4 *colours, cs_v4 *least, cs_v4 *most) {
  float rgba[64][4];
  for (int32_t x = x0; x < x1; x += 64) {
    int32_t end = x1 - x < 64 ? x1 : x + 64;
    CS_TRY(cs_composer_program_colours(s->composer, look->program, x, end, s->y, rgba));
    for (int32_t k = x; k < end; k++) {
      cs_v4 colour = cs_v4_load(rgba[k - x]);
      colours[k - x0] += (float)look->weight * colour;
      widen(&least[k - x0], &most[k - x0], colour);
    }
  }
  return CELSPAN_OK;
}

#define MIXED 64 /* columns mixed at a time */

/* Up to MIXED columns in which layers that vary are seen with some weight. */
static celspan_status mix_batch(summing *s, int32_t x0, int32_t x1, cs_v4 near_least,
                                cs_v4 near_most, float *out) {
  cs_convolve *convolve = s->convolve;
  cs_v4 colours[MIXED], least[MIXED], most[MIXED];
  for (int32_t k = 0; k < x1 - x0; k++) {
    colours[k] = flat_sum(s, x0 + k);
    least[k] = near_least;
    most[k] = near_most;
  }
  for (size_t i = 0; i < convolve->look_count; i++)
    if (fabs(convolve->looks[i].weight) > NOTHING)
      CS_TRY(add_look(s, &convolve->looks[i], x0, x1, colours, least, most));
  for (int32_t k = 0; k < x1 - x0; k++) {
    cs_v4 colour = convolve->kernel->is_signed ? hold(colours[k], least[k], most[k]) : colours[k];
    cs_v4_store(out + 4 * (size_t)k, hold_alpha(colour));
  }
  return CELSPAN_OK;
}

static celspan_status mix(summing *s, int32_t x0, int32_t x1, cs_v4 least, cs_v4 most) {
  float *colours;
  CS_TRY(cs_row_array(s->composer->context, s->out, x0, x1, &colours));
  for (int32_t x = x0; x < x1; x += MIXED) {
    int32_t end = x1 - x < MIXED ? x1 : x + MIXED;
    CS_TRY(mix_batch(s, x, end, least, most, colours + 4 * (size_t)(x - x0)));
  }
  return CELSPAN_OK;
}

/* The one program that is seen, and nothing else; or NULL. */
static const cs_program *lone_program(const summing *s) {
  if (s->varying != 1)
    return NULL;
  for (int c = 0; c < 4; c++)
    if (fabs(s->sum[c]) > NOTHING || fabs(s->slope[c]) > NOTHING)
      return NULL;
  for (size_t i = 0; i < s->convolve->look_count; i++)
    if (fabs(s->convolve->looks[i].weight - 1) <= NOTHING)
      return s->convolve->looks[i].program;
  return NULL;
}

/* The columns [x0, x1), after x0 nothing changes but by its slope. */
static celspan_status write(summing *s, int32_t x0, int32_t x1) {
  const cs_convolve *convolve = s->convolve;
  cs_v4 least = cs_v4_all(0), most = least;
  if (convolve->kernel->is_signed) {
    least = lesser(s->range.least, convolve->least[x0]);
    most = greater(s->range.most, convolve->most[x0]);
  }
  const cs_program *program = lone_program(s);
  if (program)
    return cs_composer_run_program(s->composer, program, x0, x1, s->y, s->out);
  if (s->varying > 0)
    return mix(s, x0, x1, least, most);
  cs_v4 colour = flat_sum(s, x0);
  if (convolve->kernel->is_signed)
    colour = hold(colour, least, most);
  return cs_row_gradient(s->composer->context, s->out, x0, x1, hold_alpha(colour), flat_slope(s));
}

static int32_t next_touched(const cs_convolve *convolve, int32_t p) {
  if (p >= convolve->width)
    return convolve->width;
  size_t word = (size_t)p / 64, words = word_count(convolve->width);
  uint64_t bits = convolve->touched[word] & (~(uint64_t)0 << (p % 64));
  while (bits == 0 && ++word < words)
    bits = convolve->touched[word];
  return bits == 0 ? convolve->width : (int32_t)(word * 64) + __builtin_ctzll(bits);
}

static celspan_status sum_row(summing *s) {
  int32_t width = s->convolve->width;
  for (int32_t p = 0; p < width;) {
    int32_t next = next_touched(s->convolve, p + 1);
    reach_column(s, p);
    CS_TRY(write(s, p, next));
    p = next;
  }
  return CELSPAN_OK;
}

celspan_status cs_convolve_row(cs_convolve *convolve, cs_composer *composer,
                               const cs_trace *const *traces, size_t count, int32_t y,
                               cs_row *out) {
  gather g = {.convolve = convolve, .context = composer->context, .centre = y + 0.5};
  convolve->look_count = convolve->shift_count = convolve->passage_count = 0;
  memset(convolve->touched, 0, word_count(convolve->width) * sizeof *convolve->touched);
  touch(convolve, 0);
  CS_TRY(begin_slabs(convolve, g.context, traces, count, y));
  for (size_t i = 0; i < count; i++) {
    g.trace = traces[i];
    g.row = (uint32_t)i;
    CS_TRY(add_trace(&g, composer));
  }
  summing s = {.convolve = convolve, .composer = composer, .out = out, .y = y + 0.5, .rows = count};
  for (int c = 0; c < 4; c++)
    s.sum[c] = (double)traces[0]->base[c];
  if (convolve->kernel->is_signed)
    see_rows(&s);
  return sum_row(&s);
}
