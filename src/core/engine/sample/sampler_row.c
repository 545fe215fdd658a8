#include "engine/sample/sampler_row.h"

#define WIDE(run, name) CS_WIDE_CHOOSE((run)->sampler->isa, name)
#define LINE 1024 /* texels */

/* The line under some pixels: texels [first, first + count) of a level, in the picture or beyond
 * its edges. */
typedef struct line {
  int32_t first, count;
  float texels[LINE][4];
} line;

/* The next texels of a line that lie side by side in one block. */
typedef struct neighbours {
  int32_t x, count;
} neighbours;

static neighbours next_neighbours(const cs_sampler *s, const line *under, int32_t done) {
  int32_t width = cs_mip_levels_size(s->width, s->level), at = under->first + done;
  int32_t x = cs_sampler_wrap(at, width, s->wrap), count = under->count - done;
  int32_t in_block = CS_PICTURE_BLOCK - x % CS_PICTURE_BLOCK;
  count = count < in_block ? count : in_block;
  count = count < width - x ? count : width - x;
  if (x != at && s->wrap != CELSPAN_WRAP_REPEAT)
    count = 1; /* beyond an edge the texel at the edge is repeated */
  return (neighbours){x, count};
}

static int32_t wrap_row(const cs_sampler *s, int32_t y) {
  return cs_sampler_wrap(y, cs_mip_levels_size(s->height, s->level), s->wrap);
}

/* Row y of texels, in the picture or beyond its edges. */
static void fetch_row(const cs_sampling *run, int32_t y, const line *like, float (*out)[4]) {
  const cs_sampler *s = run->sampler;
  y = wrap_row(s, y);
  for (int32_t done = 0; done < like->count;) {
    neighbours p = next_neighbours(s, like, done);
    memcpy(out + done, cs_block_cache_at(run->blocks, &s->source, s->level, p.x, y),
           (size_t)p.count * sizeof *out);
    done += p.count;
  }
}

/* Rows y and y + 1, which the same blocks hold. */
static void mix_in_blocks(const cs_sampling *run, int32_t y, float down, line *out) {
  const cs_sampler *s = run->sampler;
  for (int32_t done = 0; done < out->count;) {
    neighbours p = next_neighbours(s, out, done);
    const float(*above)[4] =
        (const float(*)[4])cs_block_cache_at(run->blocks, &s->source, s->level, p.x, y);
    WIDE(run, cs_sampler_mix_rows)
    (above, above + CS_PICTURE_BLOCK, down, p.count, out->texels + done);
    done += p.count;
  }
}

static void mix_line(const cs_sampling *run, double v, line *out) {
  float down, below[LINE][4];
  int32_t y = cs_sampler_split(v, &down), last = run->sampler->height - 1;
  if (y >= 0 && y < last && y % CS_PICTURE_BLOCK != CS_PICTURE_BLOCK - 1) {
    mix_in_blocks(run, y, down, out);
    return;
  }
  fetch_row(run, y, out, out->texels);
  fetch_row(run, y + 1, out, below);
  WIDE(run, cs_sampler_mix_rows)
  ((const float(*)[4])out->texels, (const float(*)[4])below, down, out->count, out->texels);
}

static void average_line(const cs_sampling *run, const cs_sampler_axis *high,
                         const cs_sampler_extent *down, line *out) {
  float first[LINE][4], next[LINE][4], total = down->head;
  fetch_row(run, down->first, out, first);
  memset(out->texels, 0, (size_t)out->count * sizeof *out->texels);
  for (int32_t j = 1; j < down->count; j++) {
    float weight = cs_sampler_weight(high, down, j);
    fetch_row(run, down->first + j, out, next);
    WIDE(run, cs_sampler_add_row)
    ((const float(*)[4])next, (const float(*)[4])first, weight, out->count, out->texels);
    total += weight;
  }
  WIDE(run, cs_sampler_end_sum)((const float(*)[4])first, total, out->count, out->texels);
}

/* ---------------------------------------------------------------- nearest and linear */

static bool fits_line(line *out, int32_t low, int32_t high, int32_t texels) {
  if ((int64_t)high - low + texels > LINE)
    return false;
  out->first = low;
  out->count = high - low + texels;
  return true;
}

/* How many pixels from i on fit into one line, if each needs `texels` texels from at[] on. */
static int32_t extend_line(const cs_sampling *run, const int32_t *at, int32_t i, int32_t count,
                           int32_t texels, line *out) {
  int32_t low = at[i], high = at[count - 1], end = i + 1;
  bool is_ordered = run->sampler->wrap != CELSPAN_WRAP_REPEAT;
  if (is_ordered && fits_line(out, low < high ? low : high, low < high ? high : low, texels))
    return count;
  fits_line(out, low, low, texels);
  for (high = low; end < count; end++) {
    low = at[end] < low ? at[end] : low;
    high = at[end] > high ? at[end] : high;
    if (!fits_line(out, low, high, texels))
      break;
  }
  return end;
}

static void resample_nearest(const cs_sampling *run, double v, int32_t count, const double *u,
                             float (*rgba)[4]) {
  int32_t at[CS_SAMPLER_BATCH], y = cs_sampler_floor(v + CS_SAMPLER_SAME);
  line under;
  WIDE(run, cs_sampler_floor_row)(u, count, at);
  for (int32_t i = 0, end; i < count; i = end) {
    end = extend_line(run, at, i, count, 1, &under);
    fetch_row(run, y, &under, under.texels);
    for (int32_t k = i; k < end; k++)
      memcpy(rgba[k], under.texels[at[k] - under.first], sizeof *rgba);
  }
}

static void resample_linear(const cs_sampling *run, double v, int32_t count, const double *u,
                            float (*rgba)[4]) {
  int32_t at[CS_SAMPLER_BATCH];
  float across[CS_SAMPLER_BATCH];
  line under;
  WIDE(run, cs_sampler_split_row)(u, count, at, across);
  for (int32_t i = 0, end; i < count; i = end) {
    end = extend_line(run, at, i, count, 2, &under);
    mix_line(run, v, &under);
    WIDE(run, cs_sampler_mix_along)
    ((const float(*)[4])under.texels, under.first, at + i, across + i, end - i, rgba + i);
  }
}

/* ---------------------------------------------------------------- the box */

static void average_along(const line *under, const cs_sampler_axis *wide,
                          const cs_sampler_extent *across, float rgba[4]) {
  const float(*texels)[4] = (const float(*)[4])under->texels + (across->first - under->first);
  cs_v4 first = cs_v4_load(texels[0]), sum = {0};
  float total = across->head;
  for (int32_t i = 1; i < across->count; i++) {
    float weight = cs_sampler_weight(wide, across, i);
    sum += weight * (cs_v4_load(texels[i]) - first);
    total += weight;
  }
  cs_v4_store(rgba, first + sum / total);
}

/* How many boxes fit into one line. */
static int32_t extend_boxes(const cs_sampler_extent *boxes, int32_t count, line *out) {
  int32_t low = boxes[0].first, high = low + boxes[0].count, end = 1;
  for (; end < count; end++) {
    const cs_sampler_extent *box = &boxes[end];
    int32_t next_low = box->first < low ? box->first : low;
    int32_t next_high = box->first + box->count > high ? box->first + box->count : high;
    if ((int64_t)next_high - next_low > LINE)
      break;
    low = next_low;
    high = next_high;
  }
  out->first = low;
  out->count = high - low;
  return end;
}

static void resample_boxes(const cs_sampling *run, double v, int32_t count, const double *u,
                           float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  const cs_sampler_axis wide = cs_sampler_axis_of(s, s->wide, s->width);
  const cs_sampler_axis high = cs_sampler_axis_of(s, s->high, s->height);
  const cs_sampler_extent down = cs_sampler_cut(&high, v);
  cs_sampler_extent boxes[CS_SAMPLER_BATCH];
  line under;
  WIDE(run, cs_sampler_cut_row)(&wide, u, count, boxes);
  for (int32_t i = 0, end; i < count; i = end) {
    end = i + extend_boxes(boxes + i, count - i, &under);
    average_line(run, &high, &down, &under);
    for (int32_t k = i; k < end; k++)
      average_along(&under, &wide, &boxes[k], rgba[k]);
  }
}

/* ---------------------------------------------------------------- runs */

static void resample(const cs_sampling *run, double v, int32_t count, const double *u,
                     float (*rgba)[4]) {
  if (run->sampler->kernel == CS_SAMPLER_NEAREST)
    resample_nearest(run, v, count, u, rgba);
  else if (run->sampler->kernel == CS_SAMPLER_BILINEAR)
    resample_linear(run, v, count, u, rgba);
  else
    resample_boxes(run, v, count, u, rgba);
}

/* The pixels whose centres lie on the picture are neighbours, unless it repeats. */
static void resample_inside(const cs_sampling *run, double v, int32_t count, double *u,
                            float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  int32_t first = 0;
  while (first < count && cs_sampler_is_outside(u[first], s->width, s->wrap))
    memset(rgba[first++], 0, sizeof *rgba);
  while (count > first && cs_sampler_is_outside(u[count - 1], s->width, s->wrap))
    memset(rgba[--count], 0, sizeof *rgba);
  if (s->wrap != CELSPAN_WRAP_REPEAT)
    WIDE(run, cs_sampler_clamp_row)(count, u);
  for (int32_t i = first; i < count && s->wrap == CELSPAN_WRAP_REPEAT; i++)
    u[i] = cs_sampler_reduce(u[i], s->width, s->wrap);
  if (first < count)
    resample(run, v, count - first, u + first, rgba + first);
}

/* Pixels x0 .. x0+count-1, or those listed. */
static void row_run(const cs_sampling *run, const int32_t *columns, int32_t x0, int32_t count,
                    double y, float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  double u[CS_SAMPLER_BATCH], v = cs_sampler_row_v(s, y);
  if (cs_sampler_is_outside(v, s->height, s->wrap)) {
    memset(rgba, 0, (size_t)count * sizeof *rgba);
    return;
  }
  v = cs_sampler_reduce(v, s->height, s->wrap);
  for (int32_t done = 0; done < count; done += CS_SAMPLER_BATCH) {
    int32_t batch = count - done < CS_SAMPLER_BATCH ? count - done : CS_SAMPLER_BATCH;
    if (columns)
      WIDE(run, cs_sampler_place_columns)(s, columns + done, batch, y, u);
    else
      WIDE(run, cs_sampler_place_row)(s, x0 + done, batch, y, u);
    resample_inside(run, v, batch, u, rgba + done);
  }
}

void cs_sampler_row_run(const cs_sampling *run, cs_run pixels, float (*rgba)[4]) {
  row_run(run, NULL, pixels.x0, pixels.x1 - pixels.x0, pixels.y, rgba);
}

void cs_sampler_row_at(const cs_sampling *run, const int32_t *columns, int32_t count, double y,
                       float (*rgba)[4]) {
  row_run(run, columns, 0, count, y, rgba);
}
