#include "tools/trace/regions.h"

#include <string.h>

#include "inside/context.h"

static size_t run_count(const cs_regions *regions) { return regions->rows[regions->height]; }

/* ---------------------------------------------------------------- runs */

static unsigned char label_at(const cs_region_source *source, int32_t x, int32_t y) {
  const unsigned char byte = source->first[(size_t)y * source->stride + (size_t)x];
  return source->is_mask ? byte != 0 : byte;
}

/* The first x, from `x` on, at which another label begins; eight are compared at a time. */
static int32_t end_of_run(const cs_region_source *source, int32_t x, int32_t y) {
  const unsigned char *row = source->first + (size_t)y * source->stride;
  const int32_t width = source->width;
  for (;;) {
    for (; x + 8 <= width; x += 8) {
      uint64_t here, before;
      memcpy(&here, row + x, sizeof here);
      memcpy(&before, row + x - 1, sizeof before);
      if (here != before)
        break;
    }
    while (x < width && row[x] == row[x - 1])
      x++;
    if (x == width || !source->is_mask || !row[x] != !row[x - 1])
      return x;
    x++;
  }
}

/* Finds the runs of a row; with out NULL they are only counted. */
static size_t find_runs(const cs_region_source *source, int32_t y, cs_region_run *out) {
  size_t count = 0;
  for (int32_t x = 0; x < source->width; x = end_of_run(source, x + 1, y)) {
    if (out)
      out[count].x0 = x;
    count++;
  }
  return count;
}

static celspan_status make_runs(celspan_context *context, const cs_region_source *source,
                                cs_regions *out) {
  CS_TRY(CS_MAKE(context, out->rows, (size_t)source->height + 1));
  for (int32_t y = 0; y < source->height; y++)
    out->rows[y + 1] = out->rows[y] + find_runs(source, y, NULL);
  CS_TRY(CS_MAKE(context, out->runs, run_count(out)));
  for (int32_t y = 0; y < source->height; y++)
    find_runs(source, y, out->runs + out->rows[y]);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- what hangs together */

/* While regions are being made, the region of a run is an earlier run of the region, or the run
 * itself if it is the first one. */
static uint32_t first_of(cs_region_run *runs, uint32_t run) {
  while (runs[run].region != run) {
    runs[run].region = runs[runs[run].region].region;
    run = runs[run].region;
  }
  return run;
}

static void unite(cs_region_run *runs, uint32_t a, uint32_t b) {
  a = first_of(runs, a);
  b = first_of(runs, b);
  if (a < b)
    runs[b].region = a;
  else
    runs[a].region = b;
}

typedef struct maker {
  const cs_region_source *source;
  cs_regions *regions;
} maker;

/* Whether a run of row y - 1 and a run of row y with the same label are connected. */
static bool are_joined(const maker *m, int32_t y, size_t upper, size_t lower) {
  int32_t upper_end = cs_regions_end(m->regions, y - 1, upper);
  int32_t lower_end = cs_regions_end(m->regions, y, lower);
  int32_t upper_x0 = m->regions->runs[upper].x0, lower_x0 = m->regions->runs[lower].x0;
  if (upper_x0 < lower_end && lower_x0 < upper_end)
    return true;
  if (m->source->corners != CS_CORNERS_AS_BORDERS)
    return m->source->corners == CS_CORNERS_JOIN;
  const cs_material *material = m->source->material;
  return upper_end == lower_x0 ? cs_material_join(material, lower_x0, y) == CS_JOIN_NW_SE
                               : cs_material_join(material, upper_x0, y) == CS_JOIN_NE_SW;
}

static unsigned char label_of(const maker *m, int32_t y, size_t run) {
  return label_at(m->source, m->regions->runs[run].x0, y);
}

/* Both rows are visited from left to right; runs that touch only at corners count as neighbours,
 * too. */
static void join_rows(const maker *m, int32_t y) {
  const cs_regions *regions = m->regions;
  size_t upper = regions->rows[y - 1], lower = regions->rows[y];
  size_t upper_last = lower, lower_last = regions->rows[y + 1];
  while (upper < upper_last && lower < lower_last) {
    int32_t upper_end = cs_regions_end(regions, y - 1, upper);
    int32_t lower_end = cs_regions_end(regions, y, lower);
    if (label_of(m, y - 1, upper) == label_of(m, y, lower) && are_joined(m, y, upper, lower))
      unite(regions->runs, (uint32_t)upper, (uint32_t)lower);
    /* if both end at the same corner, each touches the next run of the other row there */
    if (upper_end == lower_end) {
      if (upper + 1 < upper_last && label_of(m, y - 1, upper + 1) == label_of(m, y, lower) &&
          are_joined(m, y, upper + 1, lower))
        unite(regions->runs, (uint32_t)upper + 1, (uint32_t)lower);
      if (lower + 1 < lower_last && label_of(m, y - 1, upper) == label_of(m, y, lower + 1) &&
          are_joined(m, y, upper, lower + 1))
        unite(regions->runs, (uint32_t)upper, (uint32_t)lower + 1);
    }
    upper += upper_end <= lower_end;
    lower += lower_end <= upper_end;
  }
}

/* ---------------------------------------------------------------- numbers */

static size_t count_regions(const cs_regions *regions) {
  size_t count = 0;
  for (size_t i = 0; i < run_count(regions); i++)
    count += regions->runs[i].region == i;
  return count;
}

static void add_run(cs_region *region, int32_t x0, int32_t x1, int32_t y) {
  region->area += (uint32_t)(x1 - x0);
  region->x0 = x0 < region->x0 ? x0 : region->x0;
  region->x1 = x1 > region->x1 ? x1 : region->x1;
  region->y1 = y + 1;
}

/* Runs come in the order of pixels, and a run refers only to runs before it. */
static void number_regions(const cs_region_source *source, cs_regions *regions) {
  for (int32_t y = 0; y < regions->height; y++)
    for (size_t i = regions->rows[y]; i < regions->rows[y + 1]; i++) {
      cs_region_run *run = &regions->runs[i];
      if (run->region == i) {
        run->region = (uint32_t)regions->count;
        regions->list[regions->count++] =
            (cs_region){run->x0, run->x0, y, run->x0, y, 0, label_at(source, run->x0, y)};
      } else {
        run->region = regions->runs[run->region].region;
      }
      add_run(&regions->list[run->region], run->x0, cs_regions_end(regions, y, i), y);
    }
}

static celspan_status make(celspan_context *context, const cs_region_source *source,
                           cs_regions *out) {
  CS_TRY(make_runs(context, source, out));
  const maker m = {source, out};
  for (size_t i = 0; i < run_count(out); i++)
    out->runs[i].region = (uint32_t)i;
  for (int32_t y = 1; y < out->height; y++)
    join_rows(&m, y);
  CS_TRY(CS_MAKE(context, out->list, count_regions(out)));
  number_regions(source, out);
  return CELSPAN_OK;
}

cs_region_source cs_region_source_of(const cs_material *material, cs_corners corners) {
  const cs_labels *l = material->labels;
  const unsigned char *first = cs_labels_at(l, 0, 0);
  return (cs_region_source){first, l->stride, l->width, l->height, false, corners, material};
}

celspan_status cs_regions_make(celspan_context *context, const cs_region_source *source,
                               cs_regions *out) {
  *out = (cs_regions){.width = source->width, .height = source->height};
  celspan_status status = make(context, source, out);
  if (status != CELSPAN_OK)
    cs_regions_finish(out, context);
  return status;
}

void cs_regions_finish(cs_regions *regions, celspan_context *context) {
  cs_memory *memory = context->memory;
  cs_mem_free(memory, regions->list, regions->count * sizeof *regions->list);
  if (regions->runs) /* otherwise there may be no rows, which hold the count */
    cs_mem_free(memory, regions->runs, run_count(regions) * sizeof *regions->runs);
  cs_mem_free(memory, regions->rows, ((size_t)regions->height + 1) * sizeof *regions->rows);
  *regions = (cs_regions){.rows = NULL};
}

/* The last run of the row that begins at x or before. */
uint32_t cs_regions_at(const cs_regions *regions, int32_t x, int32_t y) {
  if (x < 0 || y < 0 || x >= regions->width || y >= regions->height)
    return CS_REGION_OUTSIDE;
  size_t low = regions->rows[y], high = regions->rows[y + 1];
  while (high - low > 1) {
    size_t middle = low + (high - low) / 2;
    if (regions->runs[middle].x0 <= x)
      low = middle;
    else
      high = middle;
  }
  return regions->runs[low].region;
}

/* ---------------------------------------------------------------- speckles */

/* How often the remaining speckles are tried again. */
#define ROUNDS 8
#define NO_RUN UINT32_MAX

typedef struct sweeper {
  const cs_material *material;
  cs_regions regions;
  uint32_t most;
  CS_ARRAY(uint32_t, first); /* a region's runs as a list: by region, and `next` by run */
  CS_ARRAY(uint32_t, next);
  CS_ARRAY(int32_t, run_rows); /* by run */
} sweeper;

static bool is_speckle(const sweeper *s, uint32_t region) {
  return s->regions.list[region].area <= s->most;
}

static void list_runs(sweeper *s) {
  for (size_t i = 0; i < s->regions.count; i++)
    s->first[i] = NO_RUN;
  for (int32_t y = 0; y < s->regions.height; y++)
    for (size_t i = s->regions.rows[y]; i < s->regions.rows[y + 1]; i++) {
      uint32_t *first = &s->first[s->regions.runs[i].region];
      s->run_rows[i] = y;
      s->next[i] = *first;
      *first = (uint32_t)i;
    }
}

static void vote(const sweeper *s, int32_t x, int32_t y, uint32_t votes[256]) {
  uint32_t region = cs_regions_at(&s->regions, x, y);
  if (region != CS_REGION_OUTSIDE && !is_speckle(s, region))
    votes[s->regions.list[region].label]++;
}

/* The most frequent label along the border of a speckle; of equally frequent ones, the first; its
 * own label if it only borders on speckles. */
static unsigned char neighbour(const sweeper *s, uint32_t region) {
  uint32_t votes[256] = {0};
  for (uint32_t run = s->first[region]; run != NO_RUN; run = s->next[run]) {
    int32_t y = s->run_rows[run], end = cs_regions_end(&s->regions, y, run);
    vote(s, s->regions.runs[run].x0 - 1, y, votes);
    vote(s, end, y, votes);
    for (int32_t x = s->regions.runs[run].x0; x < end; x++) {
      vote(s, x, y - 1, votes);
      vote(s, x, y + 1, votes);
    }
  }
  unsigned char best = s->regions.list[region].label;
  for (int label = 255; label >= 0; label--)
    if (votes[label] > 0 && votes[label] >= votes[best])
      best = (unsigned char)label;
  return best;
}

static void relabel(const sweeper *s, uint32_t region, unsigned char label) {
  for (uint32_t run = s->first[region]; run != NO_RUN; run = s->next[run]) {
    int32_t x0 = s->regions.runs[run].x0, y = s->run_rows[run];
    memset(cs_labels_at(s->material->labels, x0, y), label,
           (size_t)(cs_regions_end(&s->regions, y, run) - x0));
  }
}

/* The new label of a speckle depends only on neighbours that are not speckles. These do not change
 * during a pass, so the order does not matter. */
static celspan_status drop_once(celspan_context *context, sweeper *s, bool *has_changed) {
  size_t runs = s->regions.rows[s->regions.height];
  *has_changed = false;
  CS_TRY(CS_ARRAY_MAKE(context, s->first, s->regions.count));
  CS_TRY(CS_ARRAY_MAKE(context, s->next, runs));
  CS_TRY(CS_ARRAY_MAKE(context, s->run_rows, runs));
  list_runs(s);
  for (uint32_t i = 0; i < s->regions.count; i++) {
    unsigned char label = is_speckle(s, i) ? neighbour(s, i) : s->regions.list[i].label;
    if (label == s->regions.list[i].label)
      continue;
    relabel(s, i, label);
    *has_changed = true;
  }
  return CELSPAN_OK;
}

static celspan_status drop_round(celspan_context *context, sweeper *s, bool *has_changed) {
  const cs_region_source source = cs_region_source_of(s->material, CS_CORNERS_JOIN);
  CS_TRY(cs_regions_make(context, &source, &s->regions));
  celspan_status status = drop_once(context, s, has_changed);
  CS_ARRAYS_FREE(context->memory, s, first, run_rows);
  cs_regions_finish(&s->regions, context);
  return status;
}

celspan_status cs_speckles_drop(celspan_context *context, const cs_material *material,
                                uint32_t most) {
  sweeper s = {.material = material, .most = most};
  bool has_changed = most > 0;
  for (int round = 0; round < ROUNDS && has_changed; round++)
    CS_TRY(drop_round(context, &s, &has_changed));
  return CELSPAN_OK;
}
