/* How a block is made. base: the first level of which all blocks fit into memory together.
 *
 *   level <= base: in a pass over the rows of the file, from top to bottom
 *
 *      row 2k of level n, which waits --\
 *                                        +--mean--> row k of level n + 1, and so on up to `level`
 *      row 2k + 1 of level n -----------/
 *
 *   Level 0 is read from the file, or the surface, in batches of rows. A pass fills the blocks of a
 *   window of columns together.
 *
 *   level > base: from the four blocks of the level below; in tiles, from these
 *   (model/pictures/tiled.h), as far as the level has some
 *
 *      +---+---+
 *      |   |   |          +---+
 *      +---+---+ --mean-> |   |
 *      |   |   |          +---+
 *      +---+---+
 */
#include "model/pictures/load.h"

#include <string.h>

#include "model/colour/srgb8_lanes.h"
#include "model/pictures/surface.h"
#include "model/pictures/tiled.h"

#define BATCH_BYTES ((size_t)4 << 20)
#define LEVELS 24
#define SURFACE_COLUMNS 16

typedef struct file_pass {
  celspan_context *context;
  cs_picture_entry *entry;
  int level;                          /* the level of the blocks that are filled */
  int32_t column, row, columns, rows; /* the rectangle of its blocks */
  cs_picture_block **blocks;          /* row-major; NULL once the block is in the store */
  int32_t x0, x1, y0, y1;             /* pixels */
  float *batch;                       /* decoded rows of the file */
  int32_t batch_rows;
  /* for each level, an even row of the level below that waits for the row under it */
  float *waiting[LEVELS];
} file_pass;

static int32_t blocks_of(int32_t texels) {
  return (int32_t)(((int64_t)texels + CS_PICTURE_BLOCK - 1) / CS_PICTURE_BLOCK);
}

static int32_t columns_of(const cs_picture_entry *entry, int level) {
  return blocks_of(cs_mip_levels_size(entry->header.info.width, level));
}

static int32_t rows_of(const cs_picture_entry *entry, int level) {
  return blocks_of(cs_mip_levels_size(entry->header.info.height, level));
}

static int32_t least(int64_t a, int64_t b) { return (int32_t)(a < b ? a : b); }

/* ---------------------------------------------------------------- what a pass covers */

/* The picture fits into memory: whole rows of blocks. In a sequential format all rows between the
 * last row that was read and this one must be decoded anyway, so they are kept. A picture is read
 * as a whole if its rows must be rearranged, or if its reader decodes it as a whole. */
static void cover_fitting(file_pass *pass, int32_t row) {
  const cs_picture_entry *entry = pass->entry;
  pass->columns = columns_of(entry, 0);
  pass->row = row;
  pass->rows = 1;
  if (entry->header.is_turned || entry->header.is_whole) {
    pass->row = 0;
    pass->rows = rows_of(entry, 0);
  } else if (entry->header.is_sequential) {
    pass->row = row >= entry->next_strip ? entry->next_strip : 0;
    pass->rows = row + 1 - pass->row;
  }
}

/* The picture does not fit: a window is as wide as one pass may be. Any part of a surface can be
 * requested at no extra cost, so the windows of a surface are narrow, unless it is a reader. */
static void cover_window(file_pass *pass, int32_t column, int32_t row) {
  const cs_picture_entry *entry = pass->entry;
  int32_t columns = columns_of(entry, pass->level);
  bool is_narrow = entry->surface && !entry->header.is_sequential;
  size_t share = is_narrow && entry->share > SURFACE_COLUMNS ? SURFACE_COLUMNS : entry->share;
  int32_t window = least(columns, share < 1 ? 1 : (int64_t)share);
  pass->column = column / window * window;
  pass->columns = least(window, columns - pass->column);
  pass->row = row;
  pass->rows = 1;
}

static void cover(file_pass *pass, int level, int32_t column, int32_t row) {
  const celspan_picture_info *info = &pass->entry->header.info;
  int64_t side = (int64_t)CS_PICTURE_BLOCK << level;
  pass->level = level;
  if (pass->entry->base == 0)
    cover_fitting(pass, row);
  else
    cover_window(pass, column, row);
  pass->x0 = (int32_t)(pass->column * side);
  pass->x1 = least((pass->column + pass->columns) * side, info->width);
  pass->y0 = (int32_t)(pass->row * side);
  pass->y1 = least((pass->row + pass->rows) * side, info->height);
}

/* ---------------------------------------------------------------- its memory */

static size_t row_bytes(const file_pass *pass) {
  return (size_t)(pass->x1 - pass->x0) * 4 * sizeof(float);
}

/* A waiting row of a level: one texel more than half of the level below. */
static size_t waiting_bytes(const file_pass *pass, int level) {
  return ((size_t)cs_mip_levels_size(pass->x1 - pass->x0, level) + 1) * 4 * sizeof(float);
}

static bool make_buffers(file_pass *pass) {
  cs_memory *memory = pass->context->memory;
  int32_t rows = pass->y1 - pass->y0;
  size_t fitting = BATCH_BYTES / row_bytes(pass);
  if (!pass->entry->header.is_turned)
    rows = least(rows, fitting < 1 ? 1 : fitting > 64 ? 64 : (int64_t)fitting);
  pass->batch_rows = rows;
  pass->batch = cs_mem_array(memory, (size_t)rows, row_bytes(pass));
  bool is_made = pass->batch;
  for (int level = 0; level < pass->level && is_made; level++) {
    pass->waiting[level] = cs_mem_array(memory, 1, waiting_bytes(pass, level));
    is_made = pass->waiting[level];
  }
  return is_made;
}

static size_t block_count(const file_pass *pass) {
  return (size_t)pass->columns * (size_t)pass->rows;
}

static celspan_status make_blocks(file_pass *pass) {
  CS_TRY(CS_MAKE(pass->context, pass->blocks, block_count(pass)));
  for (size_t i = 0; i < block_count(pass); i++) {
    int32_t row = (int32_t)(i / (size_t)pass->columns),
            column = (int32_t)(i % (size_t)pass->columns);
    CS_TRY(cs_store_create_block(pass->context, pass->entry, pass->level, pass->column + column,
                                 pass->row + row, &pass->blocks[i]));
  }
  for (size_t i = 0; i < block_count(pass); i++)
    CS_TRY(cs_store_add_texels(pass->context, pass->blocks[i]));
  for (size_t i = 0; i < block_count(pass) && pass->level == 0; i++)
    CS_TRY(cs_store_add_codes(pass->context, pass->blocks[i]));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- its rows */

static void fill_blocks(const file_pass *pass, int32_t y, int32_t count, const float *texels) {
  size_t row = (size_t)(y / CS_PICTURE_BLOCK - pass->row) * (size_t)pass->columns;
  size_t inner = 4 * (size_t)(y % CS_PICTURE_BLOCK * CS_PICTURE_BLOCK);
  for (int32_t done = 0; done < count; done += CS_PICTURE_BLOCK)
    memcpy(pass->blocks[row + (size_t)(done / CS_PICTURE_BLOCK)]->texels + inner,
           texels + 4 * (size_t)done,
           (size_t)least(count - done, CS_PICTURE_BLOCK) * 4 * sizeof(float));
}

/* Puts a complete row of a level into the blocks, or into the rows of the next level. */
static void put_row(file_pass *pass, int level, int32_t y, const float *texels) {
  const celspan_picture_info *info = &pass->entry->header.info;
  int32_t count = cs_mip_levels_size(pass->x1 - pass->x0, level);
  if (level == pass->level) {
    fill_blocks(pass, y, count, texels);
    return;
  }
  bool is_upper = y % 2 == 0, is_last = y + 1 == cs_mip_levels_size(info->height, level);
  float *waiting = pass->waiting[level];
  if (is_upper)
    memcpy(waiting, texels, (size_t)count * 4 * sizeof(float));
  if (is_upper && !is_last)
    return;
  const cs_mip_level from = {info->width, info->height, level};
  const cs_mip_rows rows = {pass->x0 >> level, y & ~1, count, waiting, is_upper ? NULL : texels};
  cs_mip_levels_mean(&from, &rows, waiting);
  put_row(pass, level + 1, y / 2, waiting);
}

static celspan_status read_coded(const file_pass *pass, int32_t y, int32_t rows) {
  const cs_picture_entry *entry = pass->entry;
  const celspan_rectangle rectangle = {pass->x0, y, pass->x1 - pass->x0, rows};
  if (entry->surface)
    return cs_surface_read(pass->context, entry->surface, &rectangle, pass->batch);
  cs_picture_failure failure;
  celspan_status status = entry->store->module->read(entry->reader, pass->x0, y, rectangle.width,
                                                     rows, pass->batch, &failure);
  return status == CELSPAN_OK ? status : cs_fail(pass->context, status, "%s", failure.text);
}

/* Blocks are made only when there are rows for them, so that a damaged file that claims to be large
 * needs no memory. */
static celspan_status read_rows(file_pass *pass) {
  int32_t width = pass->x1 - pass->x0;
  for (int32_t y = pass->y0; y < pass->y1; y += pass->batch_rows) {
    int32_t rows = least(pass->y1 - y, pass->batch_rows);
    const celspan_rectangle area = {pass->x0, y, width, rows};
    const cs_part_reader reader = {pass->context, cs_load_block};
    CS_TRY(pass->entry->part ? cs_part_read(&reader, pass->entry->part, &pass->entry->header.info,
                                            &area, pass->batch)
                             : read_coded(pass, y, rows));
    if (!pass->blocks)
      CS_TRY(make_blocks(pass));
    if (!pass->entry->part)
      cs_mip_levels_decode(&pass->entry->decoder, pass->batch, (size_t)width * (size_t)rows);
    for (int32_t i = 0; i < rows; i++)
      put_row(pass, 0, y + i, pass->batch + (size_t)i * (size_t)width * 4);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- properties of a block */

/* Properties of a row of texels. Bit 0: all are opaque. Bit 1: all are clear. */
static int common_bits(const float *texels, int32_t count) {
  static const float clear[4];
  int bits = 3;
  for (int32_t i = 0; i < count && bits != 0; i++, texels += 4) {
    bits &= texels[3] == 1 ? ~0 : ~1;
    bits &= memcmp(texels, clear, sizeof clear) == 0 ? ~0 : ~2;
  }
  return bits;
}

static inline uint32_t bits_of(float number) {
  uint32_t bits;
  memcpy(&bits, &number, sizeof bits);
  return bits;
}

/* Whether codes give their texels to the bit. The numbers are compared one by one, because a
 * comparison of blocks of memory would wait until each number is stored. */
static bool are_exact(const cs_srgb8_curve *curve, const unsigned char *codes, const float *texels,
                      size_t count) {
  uint32_t difference = 0;
  for (size_t i = 0; i < count; i++, codes += 4, texels += 4) {
    float rgba[4];
    cs_srgb8_colour(curve, codes, rgba);
    for (int c = 0; c < 4; c++)
      difference |= bits_of(rgba[c]) ^ bits_of(texels[c]);
  }
  return difference == 0;
}

/* Sets the codes of a row: the first `count` are made, the others are copies of the first. Returns
 * whether they are exact; is_sure: this is known, and not examined. */
static bool set_codes(cs_picture_block *block, size_t y, size_t count, bool is_sure) {
  const float *texels = block->texels + 4 * y * CS_PICTURE_BLOCK;
  unsigned char *codes = block->codes[y];
  cs_srgb8_choose(cs_isa_best())(texels, count, codes);
  for (size_t x = count; x < CS_PICTURE_BLOCK; x++)
    memcpy(codes + 4 * x, codes, 4);
  return is_sure || are_exact(&block->store->curve, codes, texels, count);
}

/* Sets the opacity and the codes of a block whose texels are complete. Of a row of equal texels, as
 * on paper, the first one is examined; opaque ones that were codes of sRGB are exact. */
static void describe(const cs_picture_entry *entry, cs_picture_block *block) {
  const celspan_picture_info *info = &entry->header.info;
  bool is_srgb8 = !entry->part && cs_mip_levels_is_srgb8(&entry->decoder);
  int32_t width = cs_mip_levels_size(info->width, block->level) - block->column * CS_PICTURE_BLOCK;
  int32_t height = cs_mip_levels_size(info->height, block->level) - block->row * CS_PICTURE_BLOCK;
  int bits = 3;
  bool is_exact = true;
  for (int32_t y = 0; y < CS_PICTURE_BLOCK; y++) {
    const float *texels = block->texels + 4 * CS_PICTURE_BLOCK * (size_t)y;
    bool is_plain = memcmp(texels, texels + 4, 4 * sizeof(float) * (CS_PICTURE_BLOCK - 1)) == 0;
    int32_t count = is_plain ? 1 : CS_PICTURE_BLOCK;
    int row = y < height ? common_bits(texels, least(width, count)) : 3;
    bool is_sure = is_srgb8 && row == 1 && width >= CS_PICTURE_BLOCK;
    bits &= row;
    if (block->level == 0)
      is_exact = set_codes(block, (size_t)y, (size_t)count, is_sure) && is_exact;
  }
  block->opacity = bits & 1 ? CS_PICTURE_OPAQUE : bits & 2 ? CS_PICTURE_CLEAR : CS_PICTURE_MIXED;
  if (block->level == 0)
    block->is_coded = is_exact;
}

/* ---------------------------------------------------------------- a pass from start to end */

/* Appends to each row of codes the first code of the block on the right. */
static void join(const file_pass *pass, cs_picture_block *block, const cs_picture_block *right) {
  if (pass->level != 0 || block->column + 1 == columns_of(pass->entry, 0))
    return;
  block->is_coded = block->is_coded && right && right->is_coded;
  for (size_t y = 0; y < CS_PICTURE_BLOCK && block->is_coded; y++)
    memcpy(block->codes[y] + 4 * CS_PICTURE_BLOCK, right->codes[y], 4);
}

/* Puts the blocks into the store. Returns the block at (column, row), pinned. */
static cs_picture_block *insert_blocks(file_pass *pass, int32_t column, int32_t row) {
  cs_picture_block *wanted = NULL;
  for (size_t i = 0; i < block_count(pass); i++)
    describe(pass->entry, pass->blocks[i]);
  for (size_t i = 0; i < block_count(pass); i++) {
    cs_picture_block *block = pass->blocks[i];
    bool is_wanted = block->column == column && block->row == row;
    pass->blocks[i] = NULL;
    join(pass, block, (i + 1) % (size_t)pass->columns ? pass->blocks[i + 1] : NULL);
    block = cs_store_insert(block, is_wanted);
    if (is_wanted)
      wanted = block;
  }
  return wanted;
}

static void finish_pass(file_pass *pass) {
  cs_memory *memory = pass->context->memory;
  for (size_t i = 0; pass->blocks && i < block_count(pass); i++)
    cs_store_discard(pass->blocks[i]);
  cs_mem_free(memory, pass->blocks, block_count(pass) * sizeof *pass->blocks);
  for (int level = 0; level < pass->level; level++)
    cs_mem_free(memory, pass->waiting[level], waiting_bytes(pass, level));
  cs_mem_free(memory, pass->batch, (size_t)pass->batch_rows * row_bytes(pass));
}

static celspan_status run_pass(celspan_context *context, cs_picture_entry *entry, int level,
                               int32_t column, int32_t row, cs_picture_block **out) {
  if (!entry->surface && !entry->part)
    CS_TRY(cs_store_open_reader(context, entry));
  file_pass pass = {.context = context, .entry = entry};
  cover(&pass, level, column, row);
  celspan_status status = make_buffers(&pass) ? read_rows(&pass) : cs_fail_memory(context);
  if (status == CELSPAN_OK) {
    *out = insert_blocks(&pass, column, row);
    entry->next_strip = pass.row + pass.rows;
    /* All blocks are in the store: neither the file nor the memory of its reader is needed. */
    if (entry->base == 0 && entry->next_strip == rows_of(entry, 0))
      cs_store_close_reader(entry);
  }
  finish_pass(&pass);
  return status;
}

/* ---------------------------------------------------------------- from the level below */

static celspan_status load(celspan_context *context, cs_picture_entry *entry, int level,
                           int32_t column, int32_t row, cs_picture_block **out);

/* Fills a quarter of `block` with means of `from`, one of its four blocks of the level below. */
static void shrink_into(const celspan_picture_info *info, cs_picture_block *block,
                        const cs_picture_block *from) {
  int level = from->level;
  int32_t x = from->column * CS_PICTURE_BLOCK, y = from->row * CS_PICTURE_BLOCK;
  int32_t count = least(cs_mip_levels_size(info->width, level) - x, CS_PICTURE_BLOCK);
  int32_t rows = least(cs_mip_levels_size(info->height, level) - y, CS_PICTURE_BLOCK);
  const int32_t half = CS_PICTURE_BLOCK / 2;
  int32_t to_x = from->column % 2 * half, to_y = from->row % 2 * half;
  for (int32_t i = 0; i < rows; i += 2) {
    const float *upper = from->texels + 4 * (size_t)(i * CS_PICTURE_BLOCK);
    const float *lower = i + 1 < rows ? upper + 4 * CS_PICTURE_BLOCK : NULL;
    const cs_mip_rows pair = {x, y + i, count, upper, lower};
    float *out = block->texels + 4 * (size_t)((to_y + i / 2) * CS_PICTURE_BLOCK + to_x);
    cs_mip_levels_mean(&(cs_mip_level){info->width, info->height, level}, &pair, out);
  }
}

static celspan_status fill_from_below(celspan_context *context, cs_picture_entry *entry,
                                      cs_picture_block *block) {
  int level = block->level - 1;
  for (int i = 0; i < 4; i++) {
    int32_t column = 2 * block->column + i % 2, row = 2 * block->row + i / 2;
    if (column >= columns_of(entry, level) || row >= rows_of(entry, level))
      continue;
    cs_picture_block *below;
    CS_TRY(load(context, entry, level, column, row, &below));
    shrink_into(&entry->header.info, block, below);
    cs_store_release(below);
  }
  return CELSPAN_OK;
}

static celspan_status make_one(celspan_context *context, cs_picture_entry *entry, int level,
                               int32_t column, int32_t row, cs_picture_block **out) {
  cs_picture_block *block;
  CS_TRY(cs_store_create_block(context, entry, level, column, row, &block));
  celspan_status status = cs_store_add_texels(context, block);
  if (status == CELSPAN_OK && level == 0)
    status = cs_store_add_codes(context, block);
  if (status == CELSPAN_OK)
    status = level < entry->tiled_levels
                 ? cs_tiled_fill(&(cs_part_reader){context, cs_load_block}, entry, block)
                 : fill_from_below(context, entry, block);
  if (status != CELSPAN_OK) {
    cs_store_discard(block);
    return status;
  }
  describe(entry, block);
  /* It has no codes of the column on its right, because that block is not made with it. */
  block->is_coded = block->is_coded && block->column + 1 == columns_of(entry, 0);
  *out = cs_store_insert(block, true);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- a block of any level */

static celspan_status load(celspan_context *context, cs_picture_entry *entry, int level,
                           int32_t column, int32_t row, cs_picture_block **out) {
  *out = cs_store_pin(entry, level, column, row);
  if (*out)
    return CELSPAN_OK;
  bool is_read = level <= entry->base && entry->tiled_levels == 0;
  return is_read ? run_pass(context, entry, level, column, row, out)
                 : make_one(context, entry, level, column, row, out);
}

static bool is_inside(const cs_picture_entry *entry, int level, int32_t column, int32_t row) {
  return level >= 0 && level < entry->level_count && column >= 0 && row >= 0 &&
         column < columns_of(entry, level) && row < rows_of(entry, level);
}

static celspan_status load_locked(celspan_context *context, cs_picture_entry *entry,
                                  const cs_picture *picture, int level, int32_t column, int32_t row,
                                  cs_picture_block **out) {
  pthread_mutex_lock(&entry->reading); /* the lock of a part before the lock of its whole */
  const cs_picture *outer = entry->part;
  entry->part = picture->whole || picture->tiles.size > 0 ? picture : NULL;
  entry->surface = entry->part ? NULL : picture->surface;
  celspan_status status = load(context, entry, level, column, row, out);
  entry->surface = NULL;
  entry->part = outer;
  pthread_mutex_unlock(&entry->reading);
  return status;
}

celspan_status cs_load_block(celspan_context *context, const cs_picture *picture, int level,
                             int32_t column, int32_t row, cs_picture_block **out) {
  cs_picture_entry *entry;
  CS_TRY(cs_store_entry(context, picture, &entry));
  celspan_status status = CELSPAN_OK;
  cs_picture_block *block = NULL;
  if (is_inside(entry, level, column, row))
    block = cs_store_pin(entry, level, column, row);
  else
    status = cs_fail(context, CELSPAN_INTERNAL, "%s: block %d, %d of level %d does not exist",
                     cs_picture_name(picture), (int)column, (int)row, level);
  if (status == CELSPAN_OK && !block)
    status = load_locked(context, entry, picture, level, column, row, &block);
  cs_store_leave(entry);
  if (status == CELSPAN_OK)
    *out = block;
  return status;
}
