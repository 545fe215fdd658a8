#include "tools/scan/blots.h"

#include <string.h>

/* While runs are joined, `blot` is the index of an earlier run of the same blot, or its own. */
static uint32_t root_of(cs_blot_run *runs, uint32_t i) {
  while (runs[i].blot != i) {
    runs[i].blot = runs[runs[i].blot].blot;
    i = runs[i].blot;
  }
  return i;
}

static void join(cs_blot_run *runs, uint32_t a, uint32_t b) {
  a = root_of(runs, a);
  b = root_of(runs, b);
  if (a < b)
    runs[b].blot = a;
  else
    runs[a].blot = b;
}

/* Appends the runs of row y. */
static celspan_status add_row(celspan_context *context, const uint8_t *row, int32_t width,
                              int32_t y, cs_blots *out) {
  for (int32_t x = 0; x < width; x++) {
    uint64_t eight = 1;
    if (x + 8 <= width)
      memcpy(&eight, row + x, sizeof eight);
    if (eight == 0)
      x += 7;
    if (eight == 0 || row[x] == 0)
      continue;
    cs_blot_run run = {y, x, x, (uint32_t)out->run_count};
    while (x < width && row[x] != 0)
      x++;
    run.x1 = x;
    CS_TRY(CS_APPEND(context, out->runs, out->run_count, out->run_capacity, run));
  }
  return CELSPAN_OK;
}

/* Joins the runs from `above` on with those from `first` on, one row below. */
static void join_rows(cs_blots *blots, size_t above, size_t first) {
  cs_blot_run *runs = blots->runs;
  for (size_t i = first; i < blots->run_count; i++) {
    while (above < first && runs[above].x1 < runs[i].x0)
      above++;
    for (size_t j = above; j < first && runs[j].x0 <= runs[i].x1; j++)
      join(runs, (uint32_t)j, (uint32_t)i);
  }
}

static void add_run(cs_blot *blot, const cs_blot_run *run) {
  blot->area += (uint32_t)(run->x1 - run->x0);
  blot->x0 = run->x0 < blot->x0 ? run->x0 : blot->x0;
  blot->x1 = run->x1 > blot->x1 ? run->x1 : blot->x1;
  blot->y1 = run->y + 1;
}

/* Numbers the blots. A root comes before all other runs of its blot. */
static celspan_status number(celspan_context *context, cs_blots *out) {
  for (size_t i = 0; i < out->run_count; i++) {
    cs_blot_run *run = &out->runs[i];
    if (run->blot == i) {
      cs_blot blot = {0, run->x0, run->y, run->x1, run->y};
      run->blot = (uint32_t)out->count;
      CS_TRY(CS_APPEND(context, out->list, out->count, out->capacity, blot));
    } else {
      run->blot = out->runs[run->blot].blot;
    }
    add_run(&out->list[run->blot], run);
  }
  return CELSPAN_OK;
}

celspan_status cs_blots_find(celspan_context *context, const uint8_t *plane, int32_t width,
                             int32_t height, cs_blots *out) {
  *out = (cs_blots){0};
  celspan_status status = CELSPAN_OK;
  size_t above = 0;
  for (int32_t y = 0; y < height && status == CELSPAN_OK; y++) {
    size_t first = out->run_count;
    status = add_row(context, plane + (size_t)y * (size_t)width, width, y, out);
    join_rows(out, above, first);
    above = first;
  }
  if (status == CELSPAN_OK)
    status = number(context, out);
  if (status != CELSPAN_OK)
    cs_blots_finish(out, context);
  return status;
}

void cs_blots_finish(cs_blots *blots, celspan_context *context) {
  cs_mem_free(context->memory, blots->runs, blots->run_capacity * sizeof *blots->runs);
  cs_mem_free(context->memory, blots->list, blots->capacity * sizeof *blots->list);
  *blots = (cs_blots){0};
}
