/* Pictures in tiles: each block is read from the tiles that it needs and from no others, within
 * the budget; its texels are a function of the files, whatever was read before. The tiles are made
 * by a module of the test, which counts how often it opens one. */
#include <sys/stat.h>
#include <unistd.h>

#include "base/context.h"
#include "engine/sample/sampler.h"
#include "model/pictures/load.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"

#define SIDE 1000000
#define TOP 20 /* the level of SIDE pixels */
#define TILE 256

/* ---------------------------------------------------------------- the module */

struct cs_picture_reader {
  int level, column, row;
};

static int opened;
static int32_t wrong; /* added to the width of a tile */

static int32_t side_of(int level, int place) {
  int32_t whole = cs_mip_levels_size(SIDE, TOP - level), left = whole - place * TILE;
  return left < TILE ? left : TILE;
}

static celspan_status open_tile(const cs_picture_request *request, cs_picture_reader **out,
                                cs_picture_header *header, cs_picture_failure *failure) {
  cs_picture_reader at;
  const char *folder = strstr(request->file, "_files/");
  if (!folder || sscanf(folder, "_files/%d/%d_%d.png", &at.level, &at.column, &at.row) != 3) {
    snprintf(failure->text, sizeof failure->text, "%s: is no tile", request->file);
    return CELSPAN_INPUT;
  }
  *header = (cs_picture_header){.bits = 8, .is_sequential = true};
  header->info.width = side_of(at.level, at.column) + wrong;
  header->info.height = side_of(at.level, at.row);
  header->info.channels = 3;
  strcpy(header->info.colour, "srgb");
  *out = malloc(sizeof **out);
  **out = at;
  opened++;
  return CELSPAN_OK;
}

static float code_of(int level, int32_t x, int32_t y) {
  return (float)((x * 7 + y * 13 + level * 5) % 256) / 255;
}

static celspan_status read_tile(cs_picture_reader *at, int32_t x, int32_t y, int32_t width,
                                int32_t height, float *rgba, cs_picture_failure *failure) {
  (void)failure;
  for (int32_t i = 0; i < width * height; i++, rgba += 4) {
    rgba[0] = rgba[1] = rgba[2] =
        code_of(at->level, at->column * TILE + x + i % width, at->row * TILE + y + i / width);
    rgba[3] = 1;
  }
  return CELSPAN_OK;
}

static void close_tile(cs_picture_reader *reader) { free(reader); }

static const cs_picture_module module = {.version = CS_PICTURE_MODULE_VERSION,
                                         .open = open_tile,
                                         .read = read_tile,
                                         .close = close_tile};

/* ---------------------------------------------------------------- the tiles */

static char folder[64];

static void touch(int level, int column, int row) {
  char path[128];
  snprintf(path, sizeof path, "%s/a_files/%d", folder, level);
  mkdir(path, 0700);
  snprintf(path, sizeof path, "%s/a_files/%d/%d_%d.png", folder, level, column, row);
  FILE *file = fopen(path, "w");
  CHECK(file != NULL);
  if (file)
    fclose(file);
}

/* All levels of one tile, and around the middle all deeper ones, except one tile. */
static void make_tiles(void) {
  snprintf(folder, sizeof folder, "/tmp/celspan-pieces-XXXXXX");
  CHECK(mkdtemp(folder) != NULL);
  char path[128];
  snprintf(path, sizeof path, "%s/a_files", folder);
  mkdir(path, 0700);
  for (int level = 0; level <= TOP; level++) {
    int middle = cs_mip_levels_size(SIDE / 2, TOP - level) / TILE;
    for (int column = middle - 2; column <= middle + 2; column++)
      for (int row = middle - 2; row <= middle + 2; row++)
        if (column >= 0 && row >= 0 && side_of(level, column) > 0 && side_of(level, row) > 0 &&
            !(level == TOP && column == middle && row == middle))
          touch(level, column, row);
  }
}

static void remove_tiles(void) {
  char command[128];
  snprintf(command, sizeof command, "rm -rf %s", folder);
  CHECK(system(command) == 0);
}

static celspan_context *new_context(size_t picture_bytes) {
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  celspan_context *context;
  desc.picture_bytes = picture_bytes;
  CHECK(celspan_context_create(&desc, &context) == CELSPAN_OK);
  context->root->picture_module = &module;
  opened = 0;
  return context;
}

static cs_picture *new_picture(celspan_context *context) {
  char path[96];
  snprintf(path, sizeof path, "%s/a_files", folder);
  const celspan_picture_tiles tiles = {SIDE, SIDE, TILE, 0, "png"};
  celspan_picture_desc desc = CELSPAN_PICTURE_DESC;
  desc.file = path;
  desc.tiles = &tiles;
  cs_picture *picture = NULL;
  CHECK(cs_picture_create(context, &desc, &picture) == CELSPAN_OK);
  return picture;
}

/* ---------------------------------------------------------------- tests */

/* Samples a frame of 640 x 640 pixels around the middle, in which `pixels` of the picture lie under
 * one of its own. Returns a sum of all samples. */
static double look(celspan_context *context, const cs_picture *picture, double pixels) {
  cs_sampler sampler = {.picture = picture, .width = SIDE, .height = SIDE, .isa = cs_isa_best()};
  sampler.inverse = (celspan_matrix){
      {pixels, 0, SIDE / 2 - 320 * pixels, 0, pixels, SIDE / 2 - 320 * pixels, 0, 0, 1}};
  cs_sampler_prepare(&sampler);
  static cs_block_cache cache;
  float row[640][4];
  double sum = 0;
  cs_block_cache_init(&cache, context);
  for (int y = 0; y < 640; y++) {
    CHECK(cs_sampler_run(&cache, &sampler, (cs_run){.x0 = 0, .x1 = 640, .y = y + 0.5}, row) ==
          CELSPAN_OK);
    for (int x = 0; x < 640; x++)
      sum += (double)row[x][0] * (1 + x % 3);
  }
  cs_block_cache_finish(&cache);
  return sum;
}

/* A frame of 640 pixels has at most twice as many texels of its level a side, which touch at most
 * 6 x 6 tiles; some smaller ones are in place of missing ones. */
static void test_zoom_reads_few_tiles(void) {
  const size_t budgets[] = {(size_t)24 << 20, (size_t)96 << 20};
  for (int i = 0; i < 2; i++) {
    celspan_context *context = new_context(budgets[i]);
    cs_picture *picture = new_picture(context);
    for (double pixels = 1000; pixels > 0.5; pixels /= 3) {
      size_t held, most;
      uint64_t allocations;
      int before = opened;
      look(context, picture, pixels);
      CHECK(i == 0 || opened - before <= 45);
      celspan_context_memory(context, &held, &most, &allocations);
      CHECK(most < budgets[i] + ((size_t)16 << 20));
    }
    CHECK(opened > 100); /* every level was read */
    cs_picture_unref(picture);
    celspan_context_destroy(context);
  }
}

static void test_result_has_no_history(void) {
  const double scales[] = {700, 1, 0.3, 5.5, 90};
  double first[5];
  for (int turn = 0; turn < 2; turn++) {
    celspan_context *context = new_context(turn ? (size_t)4 << 20 : (size_t)256 << 20);
    cs_picture *picture = new_picture(context);
    for (int i = 0; i < 5; i++) {
      int at = turn ? 4 - i : i;
      double sum = look(context, picture, scales[at]);
      CHECK(sum > 0 && (turn == 0 || sum == first[at]));
      first[at] = sum;
    }
    cs_picture_unref(picture);
    celspan_context_destroy(context);
  }
}

static const float *texel(celspan_context *context, const cs_picture *picture, int level, int32_t x,
                          int32_t y) {
  static float light[4];
  cs_picture_block *block;
  CHECK(cs_load_block(context, picture, level, x / 64, y / 64, &block) == CELSPAN_OK);
  memcpy(light, block->texels + 4 * (y % 64 * 64 + x % 64), sizeof light);
  cs_store_release(block);
  return light;
}

/* Texels are the tile's own; where it is missing, a quarter of a texel away from those of the next
 * level; and clear nowhere, because a smaller level has a tile everywhere. */
static void test_texels(void) {
  celspan_context *context = new_context((size_t)64 << 20);
  cs_picture *picture = new_picture(context);
  const int32_t hole = SIDE / 2 / TILE * TILE;
  float own = cs_transfer_decode(CELSPAN_TRANSFER_SRGB, code_of(TOP, hole - 1, hole - 1));
  CHECK_NEAR(texel(context, picture, 0, hole - 1, hole - 1)[0], own, 1e-6);
  double mixed = 0;
  for (int corner = 0; corner < 4; corner++)
    mixed +=
        (corner % 2 ? 0.25 : 0.75) * (corner / 2 ? 0.25 : 0.75) *
        (double)texel(context, picture, 1, hole / 2 + 4 - corner % 2, hole / 2 + 4 - corner / 2)[0];
  CHECK_NEAR(texel(context, picture, 0, hole + 8, hole + 8)[0], mixed, 1e-6);
  CHECK(texel(context, picture, 0, SIDE - 1, 3)[3] == 1);
  cs_picture_unref(picture);
  celspan_context_destroy(context);
}

static void test_tile_of_wrong_size(void) {
  celspan_context *context = new_context((size_t)64 << 20);
  cs_picture *picture = new_picture(context);
  cs_picture_block *block;
  wrong = 1;
  CHECK(cs_load_block(context, picture, TOP, 0, 0, &block) == CELSPAN_INPUT);
  CHECK(strstr(celspan_context_error(context), "it has 2 x 1 pixels") != NULL);
  wrong = 0;
  cs_picture_unref(picture);
  celspan_context_destroy(context);
}

/* Every allocation of a block that is enlarged through many levels fails once: nothing leaks. */
static void test_memory(void) {
  celspan_status status = CELSPAN_NO_MEMORY;
  for (size_t n = 1; status != CELSPAN_OK && n < 1000; n++) {
    memory_watch watch = {0};
    celspan_context *context = memory_watch_context(&watch);
    context->root->picture_module = &module;
    cs_picture *picture = new_picture(context);
    cs_picture_block *block;
    watch.fail_at = watch.allocations + n;
    status = cs_load_block(context, picture, 0, 0, 0, &block);
    CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
    if (status == CELSPAN_OK)
      cs_store_release(block);
    cs_picture_unref(picture);
    celspan_context_destroy(context);
    CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  }
  CHECK(status == CELSPAN_OK);
}

static float first_texel(int level) {
  celspan_context *context = new_context((size_t)64 << 20);
  cs_picture *picture = new_picture(context);
  float light = texel(context, picture, level, 0, 0)[0];
  cs_picture_unref(picture);
  celspan_context_destroy(context);
  return light;
}

/* A tile that is a link to a file elsewhere counts as missing, as does one in a linked folder. */
static void test_links(void) {
  char path[128], other[128];
  snprintf(path, sizeof path, "%s/a_files/%d/0_0.png", folder, TOP - 8);
  snprintf(other, sizeof other, "%s/0_0.png", folder);
  fclose(fopen(other, "w"));
  float missing = first_texel(8);
  CHECK(symlink(other, path) == 0 && first_texel(8) == missing);
  CHECK(unlink(path) == 0 && link(other, path) == 0 && first_texel(8) != missing);
  snprintf(path, sizeof path, "%s/a_files/%d", folder, TOP - 8);
  snprintf(other, sizeof other, "%s/level", folder);
  CHECK(rename(path, other) == 0 && symlink(other, path) == 0 && first_texel(8) == missing);
}

int main(void) {
  make_tiles();
  test_zoom_reads_few_tiles();
  test_result_has_no_history();
  test_texels();
  test_tile_of_wrong_size();
  test_memory();
  test_links();
  remove_tiles();
  return check_done();
}
