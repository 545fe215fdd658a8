/* How the cull of a frame is made: the chains of each row of tiles, found and culled by workers. */
#include "base/thread_pool.h"
#include "engine/sweep/cull_grid.h"

#include <math.h>
#include <string.h>

#define TILE_ROWS_MOST 256
#define TILE_HEIGHT_LEAST 4
/* How far, in tiles, a chord may lie from the curve that it replaces. Fewer chords are quicker, but
 * a boundary that is treated as wider than it is leaves fewer tiles dead. */
#define SLACK_TILES 0.25
/* The chains of one job, and how many jobs the rows of tiles are divided into for each worker,
 * where there are several. A thread that is free takes the next job. */
#define JOB_CHAINS 256
#define JOBS_A_WORKER 4

/* ---------------------------------------------------------------- the grid */

static int32_t choose_rows(size_t layers, int32_t height) {
  int32_t rows = 16;
  while (rows < TILE_ROWS_MOST && (double)rows * rows < 64.0 * (double)layers)
    rows *= 2;
  while (rows > 1 && height / rows < TILE_HEIGHT_LEAST)
    rows /= 2;
  return rows;
}

/* Finds the rows of tiles that each chain crosses, and gives the chain a place for each row. */
static void find_rows(cs_cull_grid *grid) {
  cs_cull *cull = grid->cull;
  size_t places = 0;
  for (size_t i = 0; i < cull->chain_count; i++) {
    const cs_boundary_chain *chain = &grid->desc->set->chains[i];
    bool is_near = chain->y1 > -grid->margin && chain->y0 < grid->height + grid->margin;
    cull->first_rows[i] = is_near ? cs_cull_row(cull, chain->y0) : 0;
    grid->last_rows[i] = is_near ? cs_cull_row(cull, chain->y1) : -1;
    cull->places[i] = places;
    places += (size_t)(grid->last_rows[i] - cull->first_rows[i] + 1);
  }
  cull->kept_count = places;
}

static void find_columns_job(void *user, int worker, int32_t number) {
  const cs_cull_grid *grid = user;
  (void)worker;
  size_t first = (size_t)number * JOB_CHAINS, end = first + JOB_CHAINS;
  for (size_t chain = first; chain < end && chain < grid->cull->chain_count; chain++)
    cs_cull_columns_find(grid, (uint32_t)chain, grid->columns + grid->cull->places[chain]);
}

static celspan_status find_columns(celspan_context *context, cs_cull_grid *grid) {
  cs_cull *cull = grid->cull;
  CS_TRY(CS_ARRAY_MAKE(context, grid->columns, cull->kept_count));
  CS_TRY(CS_ARRAY_MAKE(context, cull->kept, cull->kept_count));
  cs_thread_pool_run(grid->desc->workers,
                     (int32_t)((cull->chain_count + JOB_CHAINS - 1) / JOB_CHAINS), find_columns_job,
                     grid);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the chains of a row of tiles */

/* starts[i + 1] holds how many things belong to i; makes starts[i] where the first of them goes. */
static void sum_up(uint32_t *starts, size_t count) {
  for (size_t i = 0; i < count; i++)
    starts[i + 1] += starts[i];
}

/* Moves back starts that have been counted up while things were put in their places. */
static void move_back(uint32_t *starts, size_t count) {
  for (size_t i = count; i > 0; i--)
    starts[i] = starts[i - 1];
  starts[0] = 0;
}

/* Lists the chains by layer, from the camera to the rear. */
static void list_by_layer(const cs_cull_grid *grid, uint32_t *starts, uint32_t *by_layer) {
  const cs_boundary_set *set = grid->desc->set;
  size_t last = grid->desc->layer_count - 1;
  for (size_t i = 0; i < set->chain_count; i++)
    starts[last - set->chains[i].layer + 1]++;
  sum_up(starts, last + 1);
  for (size_t i = 0; i < set->chain_count; i++)
    by_layer[starts[last - set->chains[i].layer]++] = (uint32_t)i;
}

static void list_crossing(cs_cull_grid *grid, const uint32_t *by_layer) {
  const cs_cull *cull = grid->cull;
  uint32_t *starts = grid->crossing_starts;
  size_t rows = (size_t)cull->tile_rows;
  for (size_t i = 0; i < cull->chain_count; i++)
    for (int32_t row = cull->first_rows[i]; row <= grid->last_rows[i]; row++)
      starts[row + 1]++;
  sum_up(starts, rows);
  for (size_t k = 0; k < cull->chain_count; k++) {
    uint32_t chain = by_layer[k];
    uint32_t layer = grid->desc->set->chains[chain].layer;
    int32_t first = cull->first_rows[chain];
    for (int32_t row = first; row <= grid->last_rows[chain]; row++)
      grid->crossing[starts[row]++] =
          (cs_cull_crossing){chain, layer, cull->places[chain] + (size_t)(row - first)};
  }
  move_back(starts, rows);
}

static celspan_status find_crossing(celspan_context *context, cs_cull_grid *grid) {
  size_t chains = grid->cull->chain_count, layers = grid->desc->layer_count;
  struct {
    CS_ARRAY(uint32_t, starts);
    CS_ARRAY(uint32_t, by_layer);
  } lists = {0};
  CS_TRY(CS_ARRAY_MAKE(context, grid->crossing, grid->cull->kept_count));
  CS_TRY(CS_ARRAY_MAKE(context, lists.starts, layers + 1));
  celspan_status status = CS_ARRAY_MAKE(context, lists.by_layer, chains);
  if (status == CELSPAN_OK) {
    list_by_layer(grid, lists.starts, lists.by_layer);
    list_crossing(grid, lists.by_layer);
  }
  CS_ARRAYS_FREE(context->memory, &lists, starts, by_layer);
  return status;
}

/* ---------------------------------------------------------------- jobs */

typedef struct jobs {
  const cs_cull_grid *grid;
  cs_cull_job *list;
  int32_t count;
  cs_account_kind account; /* the account of the thread that starts the jobs */
} jobs;

static void run_job(void *user, int worker, int32_t number) {
  const jobs *all = user;
  (void)worker;
  cs_cull_job *job = &all->list[number];
  cs_account_set(job->context.memory, all->account);
  job->status = cs_cull_row_begin(all->grid, job);
  for (int32_t row = job->first; row < job->end && job->status == CELSPAN_OK; row++)
    job->status = cs_cull_row_walk(all->grid, job, row);
}

/* Culls all rows of tiles, divided into jobs. */
static celspan_status run_jobs(celspan_context *context, const cs_cull_grid *grid, jobs *all) {
  int workers = grid->desc->workers;
  int32_t rows = grid->cull->tile_rows, wanted = workers > 1 ? JOBS_A_WORKER * workers : 1;
  int32_t count = wanted < rows ? wanted : rows;
  *all = (jobs){.grid = grid, .account = cs_account_of(context->memory)};
  CS_TRY(CS_MAKE(context, all->list, (size_t)count));
  all->count = count;
  for (int32_t i = 0; i < count; i++) {
    cs_context_branch(&all->list[i].context, context);
    all->list[i].first = (int32_t)((int64_t)rows * i / count);
    all->list[i].end = (int32_t)((int64_t)rows * (i + 1) / count);
  }
  cs_thread_pool_run(workers, count, run_job, all);
  for (int32_t i = 0; i < count; i++)
    if (all->list[i].status != CELSPAN_OK)
      return cs_fail(context, all->list[i].status, "%s", all->list[i].context.error);
  return CELSPAN_OK;
}

static void free_jobs(jobs *all, cs_memory *memory) {
  for (int32_t i = 0; i < all->count; i++)
    CS_ARRAYS_FREE(memory, &all->list[i], deferred_list, scratch);
  cs_mem_free(memory, all->list, (size_t)all->count * sizeof *all->list);
}

/* ---------------------------------------------------------------- by row of tiles */

/* Sorts deferred changes of one row of tiles by column. Equal ones keep their order. */
static void sort_row(const cs_cull_grid *grid, const cs_deferred *from, uint32_t count,
                     cs_deferred *to) {
  uint32_t starts[CS_CULL_COLUMNS + 1] = {0};
  for (uint32_t i = 0; i < count; i++)
    starts[(int32_t)(from[i].x * grid->columns_a_pixel + 0.5) + 1]++;
  sum_up(starts, CS_CULL_COLUMNS);
  for (uint32_t i = 0; i < count; i++)
    to[starts[(int32_t)(from[i].x * grid->columns_a_pixel + 0.5)]++] = from[i];
}

/* Joins the deferred changes of all jobs. */
static celspan_status join_deferred(celspan_context *context, const cs_cull_grid *grid,
                                    const jobs *all) {
  cs_cull *cull = grid->cull;
  uint32_t *starts = cull->deferred_starts;
  sum_up(starts, (size_t)cull->tile_rows);
  cull->deferred_count = starts[cull->tile_rows];
  CS_TRY(CS_ARRAY_MAKE(context, cull->deferred_list, cull->deferred_count));
  for (int32_t i = 0; i < all->count; i++) {
    const cs_cull_job *job = &all->list[i];
    for (int32_t row = job->first; row < job->end; row++)
      if (starts[row] < starts[row + 1])
        sort_row(grid, job->deferred_list + (starts[row] - starts[job->first]),
                 starts[row + 1] - starts[row], cull->deferred_list + starts[row]);
  }
  return CELSPAN_OK;
}

/* Counts, or (enters) lists, by row of tiles the chains that are kept there but not in the row
 * above it. */
static void list_enters(const cs_cull_grid *grid, uint32_t *counts, uint32_t *enters) {
  const cs_cull *cull = grid->cull;
  for (uint32_t chain = 0; chain < cull->chain_count; chain++) {
    int32_t first = cull->first_rows[chain], last = grid->last_rows[chain];
    const bool *kept = cull->kept + cull->places[chain];
    for (int32_t k = 1; k <= last - first; k++)
      if (kept[k] && !kept[k - 1]) {
        if (enters)
          enters[counts[first + k]] = chain;
        counts[first + k]++;
      }
  }
}

static celspan_status find_enters(celspan_context *context, const cs_cull_grid *grid) {
  cs_cull *cull = grid->cull;
  size_t rows = (size_t)cull->tile_rows;
  list_enters(grid, cull->enter_starts + 1, NULL);
  sum_up(cull->enter_starts, rows);
  cull->enter_count = cull->enter_starts[rows];
  CS_TRY(CS_ARRAY_MAKE(context, cull->enters, cull->enter_count));
  list_enters(grid, cull->enter_starts, cull->enters);
  move_back(cull->enter_starts, rows);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- life */

static celspan_status make_room(celspan_context *context, cs_cull_grid *grid) {
  cs_cull *cull = grid->cull;
  size_t rows = (size_t)cull->tile_rows, chains = cull->chain_count;
  CS_TRY(CS_ARRAY_MAKE(context, cull->places, chains));
  CS_TRY(CS_ARRAY_MAKE(context, cull->first_rows, chains));
  CS_TRY(CS_ARRAY_MAKE(context, grid->last_rows, chains));
  CS_TRY(CS_ARRAY_MAKE(context, cull->deferred_starts, rows + 1));
  CS_TRY(CS_ARRAY_MAKE(context, cull->enter_starts, rows + 1));
  return CS_ARRAY_MAKE(context, grid->crossing_starts, rows + 1);
}

static celspan_status cull_rows(celspan_context *context, const cs_cull_grid *grid) {
  jobs all;
  celspan_status status = run_jobs(context, grid, &all);
  if (status == CELSPAN_OK)
    status = join_deferred(context, grid, &all);
  free_jobs(&all, context->memory);
  return status;
}

static celspan_status cull_all(celspan_context *context, cs_cull_grid *grid) {
  CS_TRY(make_room(context, grid));
  find_rows(grid);
  CS_TRY(find_columns(context, grid));
  CS_TRY(find_crossing(context, grid));
  CS_TRY(cull_rows(context, grid));
  return find_enters(context, grid);
}

celspan_status cs_cull_create(celspan_context *context, const cs_cull_desc *desc, cs_cull *out) {
  cs_cull cull = {.chain_count = desc->set->chain_count};
  *out = cull;
  if (cull.chain_count == 0)
    return CELSPAN_OK;
  int32_t rows = choose_rows(desc->layer_count, desc->height);
  cull.tile_height = (int32_t)(((int64_t)desc->height + rows - 1) / rows);
  cull.tile_rows = (int32_t)(((int64_t)desc->height + cull.tile_height - 1) / cull.tile_height);
  cs_cull_grid grid = {.desc = desc,
                       .width = desc->width,
                       .height = desc->height,
                       .margin = desc->margin,
                       .columns_a_pixel = CS_CULL_COLUMNS / (double)desc->width,
                       .cull = &cull};
  grid.slack = SLACK_TILES * fmin(grid.width / CS_CULL_COLUMNS, cull.tile_height);
  celspan_status status = cull_all(context, &grid);
  CS_ARRAYS_FREE(context->memory, &grid, last_rows, crossing_starts);
  if (status == CELSPAN_OK)
    *out = cull;
  else
    cs_cull_free(&cull, context->memory);
  return status;
}

void cs_cull_free(cs_cull *cull, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, cull, deferred_list, first_rows);
  *cull = (cs_cull){0};
}
