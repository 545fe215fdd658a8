/* Blocks that are not held: read from the file in one pass from top to bottom, or made from the
 * level below.
 *
 *   level <= base   a pass over the rows of the file that a row of blocks needs; means are taken on
 *                   the way, with one row waiting a level, and blocks of every column in a window
 *                   are filled at once, with those of the next level, which is wanted next
 *   level > base    from the four blocks below, all of which fit in memory together
 */
#include <string.h>

#include "scene/picture_store.h"

#define BATCH_BYTES ((size_t)4 << 20)
#define LEVELS 24

/* A rectangle of blocks of one level, being filled. */
typedef struct block_plane {
  int level;
  int32_t column, row, columns, rows;
  cs_picture_block **blocks; /* row-major */
} block_plane;

typedef struct file_pass {
  celspan_context *context;
  cs_picture_store *store;
  cs_picture_entry *entry;
  block_plane planes[2];
  int plane_count;
  int top;                /* the highest level that is filled */
  int32_t x0, x1, y0, y1; /* pixels */
  float *batch;           /* decoded rows of the file */
  int32_t batch_rows;
  float *waiting[LEVELS]; /* of each level below the top: a row whose lower half is to come */
} file_pass;

static int32_t blocks_of(int32_t texels) {
  return (int32_t)(((int64_t)texels + CS_PICTURE_BLOCK - 1) / CS_PICTURE_BLOCK);
}

static int32_t columns_of(const cs_picture_entry *entry, int level) {
  return blocks_of(cs_levels_size(entry->header.info.width, level));
}

static int32_t rows_of(const cs_picture_entry *entry, int level) {
  return blocks_of(cs_levels_size(entry->header.info.height, level));
}

static int32_t least(int64_t a, int64_t b) { return (int32_t)(a < b ? a : b); }

/* ---------------------------------------------------------------- what a pass covers */

/* The picture fits: whole rows of blocks. What lies between the last row read and this one has to
 * be decoded anyway in a sequential format; a turned picture is read at once. */
static void cover_fitting(file_pass *pass, int32_t row) {
  cs_picture_entry *entry = pass->entry;
  int32_t first = row, last = row + 1;
  if (entry->header.is_turned) {
    first = 0;
    last = rows_of(entry, 0);
  } else if (entry->header.is_sequential) {
    first = row >= entry->next_strip ? entry->next_strip : 0;
  }
  pass->planes[0] = (block_plane){.level = 0,
                            .row = first,
                            .columns = columns_of(entry, 0),
                            .rows = last - first};
  pass->plane_count = 1;
}

/* The picture does not fit: a window of columns as wide as half the budget, and the row of the
 * next level that lies over it. */
static void cover_window(file_pass *pass, int level, int32_t column, int32_t row) {
  const cs_picture_entry *entry = pass->entry;
  bool has_next = level < entry->base;
  int32_t window = least((int64_t)(pass->store->budget / 2 / sizeof(cs_picture_block)), 1 << 20);
  window = has_next ? window * 2 / 5 / 2 * 2 : window;
  window = window < 1 + has_next ? 1 + has_next : window;
  int32_t first = column / window * window, top_row = has_next ? row & ~1 : row;
  block_plane *low = &pass->planes[0];
  *low = (block_plane){.level = level,
                 .column = first,
                 .row = top_row,
                 .columns = least(window, columns_of(entry, level) - first),
                 .rows = least(1 + has_next, rows_of(entry, level) - top_row)};
  pass->planes[1] = (block_plane){.level = level + 1,
                            .column = first / 2,
                            .row = top_row / 2,
                            .columns = (low->columns + 1) / 2,
                            .rows = 1};
  pass->plane_count = 1 + has_next;
}

static void cover(file_pass *pass, int level, int32_t column, int32_t row) {
  const celspan_picture_info *info = &pass->entry->header.info;
  if (pass->entry->base == 0)
    cover_fitting(pass, row);
  else
    cover_window(pass, level, column, row);
  const block_plane *top = &pass->planes[pass->plane_count - 1];
  int64_t side = (int64_t)CS_PICTURE_BLOCK << top->level;
  pass->top = top->level;
  pass->x0 = (int32_t)(top->column * side);
  pass->x1 = least((top->column + top->columns) * side, info->width);
  pass->y0 = (int32_t)(top->row * side);
  pass->y1 = least((top->row + top->rows) * side, info->height);
}

/* ---------------------------------------------------------------- its memory */

static size_t row_bytes(const file_pass *pass) {
  return (size_t)(pass->x1 - pass->x0) * 4 * sizeof(float);
}

/* A waiting row of a level: one texel more than half of the level below. */
static size_t waiting_bytes(const file_pass *pass, int level) {
  return ((size_t)cs_levels_size(pass->x1 - pass->x0, level) + 1) * 4 * sizeof(float);
}

static bool make_buffers(file_pass *pass) {
  cs_memory *memory = pass->store->memory;
  int32_t rows = pass->y1 - pass->y0;
  size_t fitting = BATCH_BYTES / row_bytes(pass);
  if (!pass->entry->header.is_turned)
    rows = least(rows, fitting < 1 ? 1 : fitting > 64 ? 64 : (int64_t)fitting);
  pass->batch_rows = rows;
  pass->batch = cs_mem_array(memory, (size_t)rows, row_bytes(pass));
  bool is_made = pass->batch;
  for (int level = 0; level < pass->top && is_made; level++) {
    pass->waiting[level] = cs_mem_array(memory, 1, waiting_bytes(pass, level));
    is_made = pass->waiting[level];
  }
  return is_made;
}

static celspan_status make_blocks(file_pass *pass) {
  for (int p = 0; p < pass->plane_count; p++) {
    block_plane *plane = &pass->planes[p];
    plane->blocks = cs_mem_array(pass->store->memory, (size_t)plane->columns * (size_t)plane->rows,
                                 sizeof(cs_picture_block *));
    if (!plane->blocks)
      return cs_fail_memory(pass->context);
    for (int32_t row = 0; row < plane->rows; row++)
      for (int32_t column = 0; column < plane->columns; column++)
        CS_TRY(cs_store_make(pass->context, pass->store, pass->entry, plane->level,
                             plane->column + column, plane->row + row,
                             &plane->blocks[(size_t)row * (size_t)plane->columns + (size_t)column]));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- its rows */

static void fill_plane(const block_plane *plane, int32_t y, int32_t x, int32_t count,
                       const float *texels) {
  size_t row = (size_t)(y / CS_PICTURE_BLOCK - plane->row) * (size_t)plane->columns;
  int32_t inner = y % CS_PICTURE_BLOCK * CS_PICTURE_BLOCK;
  for (int32_t done = 0; done < count; done += CS_PICTURE_BLOCK) {
    int32_t part = least(count - done, CS_PICTURE_BLOCK);
    cs_picture_block *block =
        plane->blocks[row + (size_t)((x + done) / CS_PICTURE_BLOCK - plane->column)];
    memcpy(block->texels + 4 * (size_t)inner, texels + 4 * (size_t)done,
           (size_t)part * 4 * sizeof(float));
  }
}

/* A row of a level, complete: into the blocks, and on to the next level. */
static void take_row(file_pass *pass, int level, int32_t y, float *texels) {
  const celspan_picture_info *info = &pass->entry->header.info;
  int32_t x = pass->x0 >> level, count = cs_levels_size(pass->x1 - pass->x0, level);
  for (int p = 0; p < pass->plane_count; p++)
    if (pass->planes[p].level == level)
      fill_plane(&pass->planes[p], y, x, count, texels);
  if (level == pass->top)
    return;
  bool is_upper = y % 2 == 0, is_last = y + 1 == cs_levels_size(info->height, level);
  float *waiting = pass->waiting[level];
  if (is_upper)
    memcpy(waiting, texels, (size_t)count * 4 * sizeof(float));
  if (is_upper && !is_last)
    return;
  cs_levels_mean(info->width, info->height, level, x, y & ~1, count, waiting,
                 is_upper ? NULL : texels, waiting);
  take_row(pass, level + 1, y / 2, waiting);
}

static celspan_status read_rows(file_pass *pass) {
  cs_picture_failure failure;
  int32_t width = pass->x1 - pass->x0;
  for (int32_t y = pass->y0; y < pass->y1; y += pass->batch_rows) {
    int32_t rows = least(pass->y1 - y, pass->batch_rows);
    celspan_status status = pass->store->module->read(pass->entry->reader, pass->x0, y, width, rows,
                                                      pass->batch, &failure);
    if (status != CELSPAN_OK)
      return cs_fail(pass->context, status, "%s", failure.text);
    cs_levels_decode(&pass->entry->decoder, pass->batch, (size_t)width * (size_t)rows);
    for (int32_t i = 0; i < rows; i++)
      take_row(pass, 0, y + i, pass->batch + (size_t)i * (size_t)width * 4);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- a pass from start to end */

/* Hands the blocks to the store; the one that was asked for comes back with a pin. */
static cs_picture_block *hand_over(file_pass *pass, int level, int32_t column, int32_t row) {
  cs_picture_block *wanted = NULL;
  for (int p = 0; p < pass->plane_count; p++) {
    block_plane *plane = &pass->planes[p];
    size_t count = (size_t)plane->columns * (size_t)plane->rows;
    for (size_t i = 0; i < count; i++) {
      cs_picture_block *block = plane->blocks[i];
      bool is_wanted = block->level == level && block->column == column && block->row == row;
      plane->blocks[i] = NULL;
      block = cs_store_insert(pass->store, block, is_wanted);
      if (is_wanted)
        wanted = block;
    }
  }
  return wanted;
}

static void finish_pass(file_pass *pass) {
  cs_memory *memory = pass->store->memory;
  for (int p = 0; p < pass->plane_count; p++) {
    block_plane *plane = &pass->planes[p];
    size_t count = (size_t)plane->columns * (size_t)plane->rows;
    for (size_t i = 0; plane->blocks && i < count; i++)
      cs_store_discard(pass->store, plane->blocks[i]);
    cs_mem_free(memory, plane->blocks, count * sizeof *plane->blocks);
  }
  for (int level = 0; level < pass->top; level++)
    cs_mem_free(memory, pass->waiting[level], waiting_bytes(pass, level));
  cs_mem_free(memory, pass->batch, (size_t)pass->batch_rows * row_bytes(pass));
}

static celspan_status run_pass(celspan_context *context, cs_picture_store *store,
                               cs_picture_entry *entry, int level, int32_t column, int32_t row,
                               cs_picture_block **out) {
  CS_TRY(cs_store_reader(context, store, entry));
  file_pass pass = {.context = context, .store = store, .entry = entry};
  cover(&pass, level, column, row);
  celspan_status status = make_buffers(&pass) ? make_blocks(&pass) : cs_fail_memory(context);
  if (status == CELSPAN_OK)
    status = read_rows(&pass);
  if (status == CELSPAN_OK) {
    *out = hand_over(&pass, level, column, row);
    entry->next_strip = pass.planes[0].row + pass.planes[0].rows;
  }
  finish_pass(&pass);
  return status;
}

/* ---------------------------------------------------------------- from the level below */

static celspan_status find_or_load(celspan_context *context, cs_picture_store *store,
                                   cs_picture_entry *entry, int level, int32_t column, int32_t row,
                                   cs_picture_block **out) {
  *out = cs_store_pin(store, entry, level, column, row);
  return *out ? CELSPAN_OK : cs_load_block(context, store, entry, level, column, row, out);
}

/* A quarter of `block` from `from`, one of the four blocks below it. */
static void shrink_into(cs_picture_block *block, const cs_picture_block *from) {
  const celspan_picture_info *info = &block->entry->header.info;
  int level = from->level;
  int32_t x = from->column * CS_PICTURE_BLOCK, y = from->row * CS_PICTURE_BLOCK;
  int32_t count = least(cs_levels_size(info->width, level) - x, CS_PICTURE_BLOCK);
  int32_t rows = least(cs_levels_size(info->height, level) - y, CS_PICTURE_BLOCK);
  const int32_t half = CS_PICTURE_BLOCK / 2;
  int32_t to_x = from->column % 2 * half, to_y = from->row % 2 * half;
  for (int32_t i = 0; i < rows; i += 2) {
    const float *upper = from->texels + 4 * (size_t)(i * CS_PICTURE_BLOCK);
    cs_levels_mean(info->width, info->height, level, x, y + i, count, upper,
                   i + 1 < rows ? upper + 4 * CS_PICTURE_BLOCK : NULL,
                   block->texels + 4 * (size_t)((to_y + i / 2) * CS_PICTURE_BLOCK + to_x));
  }
}

static celspan_status fill_from_below(celspan_context *context, cs_picture_store *store,
                                      cs_picture_block *block) {
  cs_picture_entry *entry = block->entry;
  int level = block->level - 1;
  for (int i = 0; i < 4; i++) {
    int32_t column = 2 * block->column + i % 2, row = 2 * block->row + i / 2;
    if (column >= columns_of(entry, level) || row >= rows_of(entry, level))
      continue;
    cs_picture_block *below;
    CS_TRY(find_or_load(context, store, entry, level, column, row, &below));
    shrink_into(block, below);
    cs_store_unpin(store, below);
  }
  return CELSPAN_OK;
}

celspan_status cs_load_block(celspan_context *context, cs_picture_store *store,
                             cs_picture_entry *entry, int level, int32_t column, int32_t row,
                             cs_picture_block **out) {
  cs_picture_block *block = cs_store_pin(store, entry, level, column, row);
  if (block) {
    *out = block;
    return CELSPAN_OK;
  }
  if (level <= entry->base)
    return run_pass(context, store, entry, level, column, row, out);
  CS_TRY(cs_store_make(context, store, entry, level, column, row, &block));
  celspan_status status = fill_from_below(context, store, block);
  if (status != CELSPAN_OK) {
    cs_store_discard(store, block);
    return status;
  }
  *out = cs_store_insert(store, block, 1);
  return CELSPAN_OK;
}
