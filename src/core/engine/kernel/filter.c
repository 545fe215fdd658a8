#include "engine/kernel/filter.h"

#include <math.h>

#include "base/number.h"
#include "engine/kernel/convolve_parts.h"
#include "engine/paint/colours.h"
#include "engine/paint/run.h"

/* ---------------------------------------------------------------- a filtered row */

/* Rows through a filter kernel: the retained edges of the rows around a row, each weighted by the
 * share of the kernel that lies right of it.
 *
 *   rows y - 1 .. y + 1     |     /          retained edges
 *                     ______|____/_____
 *   kernel of pixel p  (    |   / )          the edges divide it: this share is left of them
 *                     ------|--/-------
 *   row y   [ flat ][ changes ][ flat ]      changes by column --sum--> spans
 *
 * An edge at x with the colour step d adds d times its height's share of the kernel to every pixel
 * right of it, and to those within the radius the share of that which lies right of x. So the cost
 * follows the edges, and stretches that no edge comes near remain one span.
 *
 * Layers that vary along a row are not filtered: a program is one more colour with some weight,
 * sampled at the centre of the pixel that is made.
 *
 * Invariant: a row is a function of the retained rows around it, added in order of their rows.
 */

#define NOTHING 1e-9 /* weights and colours below this are rounding */

/* ---------------------------------------------------------------- life */

/* Columns of the sums of one stretch of an edge: twice the columns of the kernel, plus some
 * room. */
static size_t sum_count(const cs_kernel *kernel) { return 2 * (size_t)kernel->stride + 8; }

/* Errors: NO_MEMORY. */
static CELSPAN_CHECKED celspan_status init_convolve(cs_convolve *convolve, celspan_context *context,
                                                    const cs_kernel *kernel, int32_t width) {
  size_t columns = (size_t)width;
  *convolve = (cs_convolve){.kernel = kernel, .width = width};
  CS_TRY(CS_ARRAY_MAKE(context, convolve->changes, columns));
  CS_TRY(CS_ARRAY_MAKE(context, convolve->touched, cs_convolve_words(width)));
  CS_TRY(CS_ARRAY_MAKE(context, convolve->shifts_at, columns));
  CS_TRY(CS_ARRAY_MAKE(context, convolve->values, columns));
  if (kernel->is_signed) {
    CS_TRY(CS_ARRAY_MAKE(context, convolve->passed_at, columns));
    CS_TRY(CS_ARRAY_MAKE(context, convolve->near, columns));
  }
  return kernel->shape == CS_KERNEL_SEPARABLE
             ? CS_ARRAY_MAKE(context, convolve->sums, sum_count(kernel))
             : CS_ARRAY_MAKE(context, convolve->slopes, columns);
}

/* ---------------------------------------------------------------- summing */

/* Signed kernels: every sub-row under the kernel begins with the colour of the base. Sub-rows
 * outside the kernel are marked as varying, so that their colours do not count. */
static celspan_status begin_sub_rows(cs_convolve *convolve, celspan_context *context,
                                     const cs_retained_row *const *retained_rows, size_t rows,
                                     int32_t y) {
  size_t count = convolve->kernel->is_signed ? rows * CS_CONVOLVE_SUB_ROWS : 0;
  CS_TRY(CS_ARRAY_RESERVE(context, convolve->sub_rows, count));
  CS_TRY(CS_ARRAY_RESERVE(context, convolve->ranges, count / CS_CONVOLVE_SUB_ROWS));
  for (size_t i = 0; i < count / CS_CONVOLVE_SUB_ROWS; i++)
    convolve->ranges[i] = (cs_convolve_range){retained_rows[0]->base, retained_rows[0]->base};
  for (size_t i = 0; i < count; i++) {
    double height = retained_rows[i / CS_CONVOLVE_SUB_ROWS]->row +
                    ((double)(i % CS_CONVOLVE_SUB_ROWS) + 0.5) / CS_CONVOLVE_SUB_ROWS;
    cs_convolve_sub_row *sub_row = &convolve->sub_rows[i];
    sub_row->varies = fabs(height - (y + 0.5)) >= convolve->kernel->radius_y;
    sub_row->colour = cs_v4_wide(retained_rows[0]->base);
  }
  return CELSPAN_OK;
}

#define MIXED 64 /* columns mixed at a time */

/* A column in which layers that vary have some weight. */
typedef struct mixed_column {
  cs_v4 colour;            /* the colour of the flat colours; then of all */
  cs_convolve_range range; /* the range of the colours under the kernel */
} mixed_column;

typedef struct summing {
  cs_convolve *convolve;
  cs_painter *painter;
  cs_row *out;
  double y;                /* centre */
  size_t rows;             /* under the kernel */
  int32_t at;              /* the current column */
  cs_v4d sum;              /* at this column: the weighted sum of the flat colours */
  cs_v4d slope;            /* by how much the sum grows from each column to the next */
  cs_v4 here;              /* added at the current column only */
  size_t varying;          /* terms whose weight is more than NOTHING */
  cs_convolve_range range; /* the range of the colours under the kernel, except near edges */
  /* Columns that are mixed, side by side, but not yet written. */
  int32_t mixed_from;
  size_t mixed_count;
  mixed_column *mixed; /* MIXED */
} summing;

/* Rounds a sum of colours times weights, where the weights sum to 1. Bits beyond the 40th are
 * errors of rounding. Without them, the mean of a single colour is this colour to the bit. */
static double tidy(double value) { return rint(value * 0x1p40) * 0x1p-40; }

static cs_v4 tidy_colour(cs_v4d sum) {
  return cs_v4_narrow(
      (cs_v4d){{tidy(sum.low[0]), tidy(sum.low[1])}, {tidy(sum.high[0]), tidy(sum.high[1])}});
}

/* Finds the range of the colours at the heights of a row. */
static void find_range(cs_convolve *convolve, size_t row) {
  cs_convolve_range range = cs_convolve_nothing();
  const cs_convolve_sub_row *sub_row = &convolve->sub_rows[row * CS_CONVOLVE_SUB_ROWS];
  for (int i = 0; i < CS_CONVOLVE_SUB_ROWS; i++)
    if (sub_row[i].varies <= 0)
      cs_convolve_widen(&range, cs_v4_narrow(sub_row[i].colour));
  convolve->ranges[row] = range;
}

static void join_ranges(summing *s) {
  s->range = s->convolve->ranges[0];
  for (size_t row = 1; row < s->rows; row++)
    s->range = cs_convolve_both(s->range, s->convolve->ranges[row]);
}

static void apply_passed(cs_convolve *convolve, const cs_convolve_passed *passed) {
  for (int k = passed->sub_row; k < passed->sub_row_end; k++) {
    cs_convolve_sub_row *sub_row =
        &convolve->sub_rows[passed->row * CS_CONVOLVE_SUB_ROWS + (size_t)k];
    sub_row->varies += passed->varies;
    sub_row->colour = cs_v4d_add(sub_row->colour, passed->step);
  }
}

/* Applies the passed events at column p. In the list, the events of one retained row are
 * neighbours, so the range of a row is found once. */
static void apply_passed_events(summing *s, int32_t p) {
  cs_convolve *convolve = s->convolve;
  for (uint32_t at = convolve->passed_at[p]; at != 0;) {
    const cs_convolve_passed *passed = &convolve->passed[at - 1];
    apply_passed(convolve, passed);
    at = passed->next;
    if (at == 0 || convolve->passed[at - 1].row != passed->row)
      find_range(convolve, passed->row);
  }
  join_ranges(s);
}

static void advance_to(summing *s, int32_t p) {
  cs_convolve *convolve = s->convolve;
  s->sum = cs_v4d_add(s->sum, cs_v4d_add(cs_v4d_scale(p - s->at, s->slope), convolve->changes[p]));
  if (convolve->slopes)
    s->slope = cs_v4d_add(s->slope, convolve->slopes[p]);
  s->here = convolve->values[p];
  s->at = p;
  for (uint32_t at = convolve->shifts_at[p]; at != 0; at = convolve->shifts[at - 1].next) {
    const cs_convolve_shift *shift = &convolve->shifts[at - 1];
    double *weight = &convolve->terms[shift->term].weight;
    s->varying -= fabs(*weight) > NOTHING;
    *weight += shift->weight;
    s->varying += fabs(*weight) > NOTHING;
  }
  if (convolve->kernel->is_signed && convolve->passed_at[p] != 0)
    apply_passed_events(s, p);
}

static cs_v4 clamp(cs_v4 colour, cs_convolve_range range) {
  for (int c = 0; c < 4; c++)
    colour[c] = cs_number_clampf(colour[c], range.least[c], range.most[c]);
  return colour;
}

static cs_v4 flat_sum(const summing *s, int32_t x) {
  return tidy_colour(cs_v4d_add(s->sum, cs_v4d_scale(x - s->at, s->slope))) + s->here;
}

static cs_v4 clamp_alpha(cs_v4 colour) {
  colour[3] = cs_number_clampf(colour[3], 0, 1);
  return colour;
}

/* Adds a term, by its weights, to the mixed columns [from, end). */
static celspan_status add_term(summing *s, size_t term, size_t from, size_t end) {
  float rgba[MIXED][4];
  const double *weights = s->convolve->weights + term * MIXED;
  int32_t x = s->mixed_from;
  CS_TRY(cs_painter_program_colours(s->painter, &s->convolve->terms[term].program,
                                    (cs_run){x + (int32_t)from, x + (int32_t)end, s->y}, rgba));
  for (size_t k = from; k < end; k++) {
    cs_v4 colour = cs_v4_load(rgba[k - from]);
    s->mixed[k].colour += (float)weights[k] * colour;
    cs_convolve_widen(&s->mixed[k].range, colour);
  }
  return CELSPAN_OK;
}

/* Adds a term where it has some weight. */
static celspan_status add_term_parts(summing *s, size_t term) {
  const double *weights = s->convolve->weights + term * MIXED;
  for (size_t k = 0, end; k < s->mixed_count; k = end + 1) {
    for (end = k; end < s->mixed_count && fabs(weights[end]) > NOTHING;)
      end++;
    if (end > k)
      CS_TRY(add_term(s, term, k, end));
  }
  return CELSPAN_OK;
}

/* Writes the mixed columns. */
static celspan_status finish_mixed(summing *s) {
  float *colours;
  int32_t end = s->mixed_from + (int32_t)s->mixed_count;
  if (s->mixed_count == 0)
    return CELSPAN_OK;
  for (size_t i = 0; i < s->convolve->term_count; i++)
    CS_TRY(add_term_parts(s, i));
  CS_TRY(cs_row_array(s->painter->context, s->out, s->mixed_from, end, &colours));
  for (size_t k = 0; k < s->mixed_count; k++) {
    const mixed_column *m = &s->mixed[k];
    bool is_signed = s->convolve->kernel->is_signed;
    cs_v4_store(colours + 4 * k, clamp_alpha(is_signed ? clamp(m->colour, m->range) : m->colour));
  }
  s->mixed_count = 0;
  return CELSPAN_OK;
}

/* Mixes the columns [x0, x1), in which layers that vary have some weight, with those before them:
 * programs are cheaper in several columns at once. */
static celspan_status mix(summing *s, int32_t x0, int32_t x1, cs_convolve_range range) {
  cs_convolve *convolve = s->convolve;
  for (int32_t x = x0; x < x1; x++) {
    if (s->mixed_count == MIXED)
      CS_TRY(finish_mixed(s));
    if (s->mixed_count == 0)
      s->mixed_from = x;
    for (size_t i = 0; i < convolve->term_count; i++)
      convolve->weights[i * MIXED + s->mixed_count] = convolve->terms[i].weight;
    s->mixed[s->mixed_count++] = (mixed_column){flat_sum(s, x), range};
  }
  return CELSPAN_OK;
}

static bool is_nothing(cs_v4d v) {
  return fabs(v.low[0]) <= NOTHING && fabs(v.low[1]) <= NOTHING && fabs(v.high[0]) <= NOTHING &&
         fabs(v.high[1]) <= NOTHING;
}

/* The program that fills the kernel alone; NULL if another program or a flat colour is also visible
 * under the kernel. */
static const cs_program *lone_program(const summing *s) {
  if (s->varying != 1 || !is_nothing(s->sum) || !is_nothing(s->slope))
    return NULL;
  for (size_t i = 0; i < s->convolve->term_count; i++)
    if (fabs(s->convolve->terms[i].weight - 1) <= NOTHING)
      return &s->convolve->terms[i].program;
  return NULL;
}

/* Writes the columns [x0, x1). Only the first is touched, so the sum then follows its slope. */
static celspan_status write(summing *s, int32_t x0, int32_t x1) {
  const cs_convolve *convolve = s->convolve;
  cs_convolve_range range = s->range;
  if (convolve->kernel->is_signed)
    range = cs_convolve_both(range, convolve->near[x0]);
  const cs_program *program = lone_program(s);
  if (!program && s->varying > 0)
    return mix(s, x0, x1, range);
  CS_TRY(finish_mixed(s));
  if (program)
    return cs_painter_run_program(s->painter, program, (cs_run){x0, x1, s->y}, s->out);
  cs_v4 colour = flat_sum(s, x0);
  if (convolve->kernel->is_signed)
    colour = clamp(colour, range);
  return cs_row_gradient(s->painter->context, s->out, x0, x1, clamp_alpha(colour),
                         tidy_colour(s->slope));
}

static int32_t next_touched(const cs_convolve *convolve, int32_t p) {
  if (p >= convolve->width)
    return convolve->width;
  size_t word = (size_t)p / 64, words = cs_convolve_words(convolve->width);
  uint64_t bits = convolve->touched[word] & (~(uint64_t)0 << (p % 64));
  while (bits == 0 && ++word < words)
    bits = convolve->touched[word];
  return bits == 0 ? convolve->width : (int32_t)(word * 64) + __builtin_ctzll(bits);
}

static celspan_status sum_row(summing *s) {
  int32_t width = s->convolve->width;
  for (int32_t p = 0; p < width;) {
    int32_t next = next_touched(s->convolve, p + 1);
    advance_to(s, p);
    CS_TRY(write(s, p, next));
    p = next;
  }
  return finish_mixed(s);
}

/* Row y from `count` retained rows, sealed, from the topmost under its kernel to the lowest.
 * Errors: NO_MEMORY and the errors of painting. */
static CELSPAN_CHECKED celspan_status convolve_row(cs_convolve *convolve, cs_painter *painter,
                                                   const cs_retained_row *const *retained_rows,
                                                   size_t count, int32_t y, cs_row *out) {
  CS_TRY(begin_sub_rows(convolve, painter->context, retained_rows, count, y));
  CS_TRY(cs_scatter_rows(convolve, painter, retained_rows, count, y));
  CS_TRY(CS_ARRAY_RESERVE(painter->context, convolve->weights, convolve->term_count * MIXED));
  mixed_column mixed[MIXED];
  summing s = {.convolve = convolve,
               .painter = painter,
               .out = out,
               .y = y + 0.5,
               .rows = count,
               .mixed = mixed,
               .range = cs_convolve_nothing(),
               .sum = cs_v4_wide(retained_rows[0]->base)};
  if (convolve->kernel->is_signed)
    join_ranges(&s);
  return sum_row(&s);
}

/* ---------------------------------------------------------------- the ring of rows */

celspan_status cs_filter_init(cs_filter *filter, const cs_kernel *kernel, cs_painter *painter,
                              int32_t width, cs_filter_retain *retain, void *user) {
  celspan_context *context = painter->context;
  size_t count = 2 * (size_t)cs_kernel_extent(kernel) + 1;
  *filter = (cs_filter){
      .kernel = kernel, .painter = painter, .retain = retain, .user = user, .row_count = count};
  CS_TRY(CS_ARRAY_MAKE(context, filter->rows, count));
  CS_TRY(CS_ARRAY_MAKE(context, filter->under, count));
  return init_convolve(&filter->convolve, context, kernel, width);
}

void cs_filter_finish(cs_filter *filter, cs_memory *memory) {
  for (size_t i = 0; filter->rows && i < filter->row_count; i++)
    cs_retained_finish(&filter->rows[i], memory);
  CS_ARRAYS_FREE(memory, filter, rows, under);
  CS_ARRAYS_FREE(memory, &filter->convolve, changes, ranges);
  *filter = (cs_filter){0};
}

static cs_retained_row *place_of(cs_filter *filter, int32_t y) {
  int32_t count = (int32_t)filter->row_count, place = y % count;
  return &filter->rows[place < 0 ? place + count : place];
}

celspan_status cs_filter_row(cs_filter *filter, int32_t y, cs_row *out) {
  double radius = filter->kernel->radius_y + 0.5 * filter->kernel->spread;
  int32_t first = cs_number_floor(y + 0.5 - radius), end = cs_number_ceil(y + 0.5 + radius);
  for (int32_t row = first; row < end; row++) {
    cs_retained_row *retained = place_of(filter, row);
    if (!retained->is_sealed || retained->row != row)
      CS_TRY(filter->retain(filter->user, row, retained));
    filter->under[row - first] = retained;
  }
  return convolve_row(&filter->convolve, filter->painter, filter->under, (size_t)(end - first), y,
                      out);
}
