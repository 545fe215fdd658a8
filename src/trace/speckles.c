#include "trace/speckles.h"

#include <string.h>

#include "trace/regions.h"

/* How often what is left is tried again. */
#define ROUNDS 8
#define NO_RUN UINT32_MAX

typedef struct sweeper {
  const cs_material *material;
  cs_regions regions;
  uint32_t most;
  uint32_t *first, *next; /* a region's runs as a list: by region, by run */
  int32_t *run_rows;      /* by run */
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

/* The label of most of its border, the first of those; its own where it borders on speckles alone. */
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

/* Speckles ask what is none, which does not change in a round: so their order does not matter. */
static bool drop_once(sweeper *s) {
  bool has_changed = false;
  list_runs(s);
  for (uint32_t i = 0; i < s->regions.count; i++) {
    unsigned char label = is_speckle(s, i) ? neighbour(s, i) : s->regions.list[i].label;
    if (label == s->regions.list[i].label)
      continue;
    relabel(s, i, label);
    has_changed = true;
  }
  return has_changed;
}

static celspan_status drop_round(celspan_context *context, sweeper *s, bool *has_changed) {
  cs_memory *memory = context->memory;
  CS_TRY(cs_regions_make(context, s->material, CS_CORNERS_JOIN, &s->regions));
  size_t runs = s->regions.rows[s->regions.height], regions = s->regions.count;
  s->first = cs_mem_array(memory, regions, sizeof *s->first);
  s->next = cs_mem_array(memory, runs, sizeof *s->next);
  s->run_rows = cs_mem_array(memory, runs, sizeof *s->run_rows);
  bool is_made = s->first && s->next && s->run_rows;
  *has_changed = is_made && drop_once(s);
  cs_mem_free(memory, s->first, regions * sizeof *s->first);
  cs_mem_free(memory, s->next, runs * sizeof *s->next);
  cs_mem_free(memory, s->run_rows, runs * sizeof *s->run_rows);
  cs_regions_finish(&s->regions, context);
  return is_made ? CELSPAN_OK : cs_fail_memory(context);
}

celspan_status cs_speckles_drop(celspan_context *context, const cs_material *material,
                                uint32_t most) {
  sweeper s = {.material = material, .most = most};
  bool has_changed = most > 0;
  for (int round = 0; round < ROUNDS && has_changed; round++)
    CS_TRY(drop_round(context, &s, &has_changed));
  return CELSPAN_OK;
}
