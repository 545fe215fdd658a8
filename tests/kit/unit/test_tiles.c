/* Pyramids of tiles: whatever part of one is made, by a crop or by continuing a run that was
 * stopped, each tile shows what a render of its level shows, or, on the small levels, what the mean
 * over the larger level is. The tiles are Targa files, which are easy to read.
 *
 * A plain run tries SAMPLE of the PYRAMIDS pyramids, which the seed selects, and damages the
 * records at one byte in SAMPLE_BYTES. CELSPAN_PYRAMIDS=n tries n with all their bytes; CASE=n
 * tries only that one.
 */
#include <ftw.h>
#include <sys/stat.h>
#include <unistd.h>

#include "output/sinks/pixels.h"
#include "output/sinks/sink.h"
#include "tests/support/random.h"
#include "tests/support/scene.h"
#include "writers/tiles/log.h"
#include "writers/tiles/tile_render.h"

enum {
  PYRAMIDS = 120, /* 40 sizes in three layouts */
  SAMPLE = 4,
  SAMPLE_BYTES = 16,
  LEVELS = 32,
  PATH_SIZE = 4096,
  MEAN_BASE = 1024, /* what docs/tiles.md says of small levels */
  MEAN_SIDE = 255,
  RECORD_SIZE = 1 << 16
};

/* One pyramid, and the right pixels of its levels. */
typedef struct subject {
  studio studio;
  celspan_exposure exposure;
  celspan_frame_desc frame; /* all of it */
  cs_pyramid pyramid;
  int32_t levels[2];
  bool is_whole;                /* tries every byte of its records */
  unsigned char *right[LEVELS]; /* RGBA, 8 bits, straight */
  char folder[64];
} subject;

/* ---------------------------------------------------------------- the right pixels */

/* Two gradients across each other, so that no two tiles are equal, and edges. */
static celspan_rostrum *build(studio *s, double width, double height) {
  const celspan_stop stops[] = {{0, celspan_paint_rgb(0.9f, 0.2f, 0.1f, 1)},
                                {1, celspan_paint_rgb(0, 0.4f, 0.9f, 1)}};
  celspan_texture *across =
      studio_linear(s, (celspan_point){0, 0}, (celspan_point){width, height * 0.4}, stops, 2);
  celspan_texture *round =
      studio_radial(s, (celspan_point){width * 0.4, height * 0.9}, height * 0.8, stops, 2);
  celspan_object *objects[] = {studio_circle(s, width * 0.4, height * 0.6, width * 0.35, round),
                               studio_rect(s, 0, 0, width, height * 0.97, across)};
  celspan_cel *cel = studio_cel(s, CELSPAN_CEL_DESC, objects, 2);
  return studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1);
}

static void *array(size_t count, size_t size) {
  void *made = calloc(count ? count : 1, size);
  if (!made)
    abort();
  return made;
}

/* A whole level as `celspan render` makes it. */
static void *render_level(subject *s, int32_t level, const celspan_coding *coding, size_t pixel) {
  celspan_frame_desc frame = s->frame;
  celspan_sink sink;
  cs_pyramid_size(&s->pyramid, level, &frame.width, &frame.height);
  void *pixels = array((size_t)frame.width * (size_t)frame.height, pixel);
  studio_check(&s->studio, cs_sink_memory(s->studio.context, coding, pixels,
                                          (size_t)frame.width * pixel, &sink));
  studio_check(&s->studio, celspan_frame_render(s->studio.context, &frame, &sink, NULL));
  return pixels;
}

/* The part of [at, at + 1) inside [low, high). */
static double part(int32_t at, double low, double high) {
  return fmax(0, fmin(at + 1, high) - fmax(at, low));
}

static void mean(const float *base, int32_t width, int32_t height, const double box[4],
                 float out[4]) {
  double sum[4] = {0}, area = 0;
  for (int32_t y = (int32_t)box[1]; y < height && y < box[3]; y++)
    for (int32_t x = (int32_t)box[0]; x < width && x < box[2]; x++) {
      double weight = part(x, box[0], box[2]) * part(y, box[1], box[3]);
      area += weight;
      for (int c = 0; c < 4; c++)
        sum[c] += weight * (double)base[4 * ((size_t)y * (size_t)width + (size_t)x) + (size_t)c];
    }
  for (int c = 0; c < 4; c++)
    out[c] = (float)(sum[c] / area);
}

static const celspan_coding LIGHT = {.struct_size = sizeof LIGHT,
                                     .depth = CELSPAN_DEPTH_FLOAT,
                                     .transfer = CELSPAN_TRANSFER_LINEAR,
                                     .alpha = CELSPAN_ALPHA_PREMULTIPLIED};
static const celspan_coding CODES = {.struct_size = sizeof CODES,
                                     .depth = CELSPAN_DEPTH_8,
                                     .transfer = CELSPAN_TRANSFER_SRGB,
                                     .alpha = CELSPAN_ALPHA_STRAIGHT};

/* The small levels, from the largest level within MEAN_BASE pixels. */
static void set_means(subject *s, int32_t base_level) {
  int32_t base_width, base_height, width, height;
  float *base = render_level(s, base_level, &LIGHT, 4 * sizeof *base), light[4];
  cs_pyramid_size(&s->pyramid, base_level, &base_width, &base_height);
  for (int32_t level = 0; level < base_level; level++) {
    cs_pyramid_size(&s->pyramid, level, &width, &height);
    if (width > MEAN_SIDE || height > MEAN_SIDE)
      break;
    s->right[level] = array((size_t)width * (size_t)height, 4);
    for (int32_t y = 0; y < height; y++)
      for (int32_t x = 0; x < width; x++) {
        double across = (double)base_width / width, down = (double)base_height / height;
        const double box[4] = {x * across, y * down, (x + 1) * across, (y + 1) * down};
        mean(base, base_width, base_height, box, light);
        cs_pixels_code(&CODES, light,
                       s->right[level] + 4 * ((size_t)y * (size_t)width + (size_t)x));
      }
  }
  free(base);
}

static void set_right(subject *s) {
  int32_t base = cs_pyramid_within(&s->pyramid, MEAN_BASE), top = cs_pyramid_top(&s->pyramid);
  set_means(s, base);
  for (int32_t level = 0; level <= top; level++)
    if (!s->right[level])
      s->right[level] = render_level(s, level, &CODES, 4);
}

/* ---------------------------------------------------------------- files */

static int remove_one(const char *path, const struct stat *found, int kind, struct FTW *where) {
  (void)found, (void)kind, (void)where;
  return remove(path);
}

static void remove_all(const char *folder) { nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS); }

static size_t read_file(const char *path, unsigned char *bytes, size_t size) {
  FILE *file = fopen(path, "rb");
  size_t count = file ? fread(bytes, 1, size, file) : 0;
  if (file)
    fclose(file);
  return count;
}

static void write_file(const char *path, const void *bytes, size_t size) {
  FILE *file = fopen(path, "wb");
  CHECK(file && fwrite(bytes, 1, size, file) == size);
  if (file)
    fclose(file);
}

/* Decodes the packets of a Targa file to RGBA. false: the file has another size. */
static bool decode(const unsigned char *file, size_t size, int32_t width, int32_t height,
                   unsigned char *out) {
  if (size < 18 || file[12] + 256 * file[13] != width || file[14] + 256 * file[15] != height)
    return false;
  size_t left = (size_t)width * (size_t)height, pixel = file[16] / 8u;
  for (const unsigned char *at = file + 18; left > 0;) {
    size_t count = (*at & 0x7fu) + 1, is_run = *at++ & 0x80u;
    if (count > left)
      return false;
    left -= count;
    for (size_t i = 0; i < count; i++, at += is_run ? 0 : pixel, out += 4) {
      const unsigned char rgba[4] = {at[2], at[1], at[0], pixel == 4 ? at[3] : 255};
      memcpy(out, rgba, 4);
    }
    at += is_run ? pixel : 0;
  }
  return true;
}

/* Whether the file of a tile shows the right pixels. */
static bool is_right(const subject *s, cs_pyramid_tile tile) {
  cs_pyramid_box tiles = {tile.column, tile.row, tile.column + 1, tile.row + 1};
  cs_pyramid_box box = cs_pyramid_pixels(&s->pyramid, tile.level, &tiles);
  int32_t width = box.x1 - box.x0, height = box.y1 - box.y0, level_width, level_height;
  size_t room = 5 * (size_t)width * (size_t)height + 1024;
  unsigned char *file = array(2, room), *pixels = file + room;
  char path[PATH_SIZE];
  cs_pyramid_size(&s->pyramid, tile.level, &level_width, &level_height);
  bool is_same = cs_pyramid_path(&s->pyramid, tile, false, path, sizeof path) &&
                 decode(file, read_file(path, file, room), width, height, pixels);
  for (int32_t y = box.y0; is_same && y < box.y1; y++)
    is_same = memcmp(pixels + 4 * (size_t)(y - box.y0) * (size_t)width,
                     s->right[tile.level] + 4 * ((size_t)y * (size_t)level_width + (size_t)box.x0),
                     4 * (size_t)width) == 0;
  free(file);
  return is_same;
}

/* The number of wrong or missing tiles. */
static int count_wrong(const subject *s, const cs_tile_render *render) {
  int wrong = 0;
  for (size_t i = 0; i < render->job_count; i++) {
    const cs_pyramid_box *box = &render->jobs[i].tiles;
    for (int32_t y = box->y0; y < box->y1; y++)
      for (int32_t x = box->x0; x < box->x1; x++)
        wrong += !is_right(s, (cs_pyramid_tile){render->jobs[i].level, x, y});
  }
  return wrong;
}

/* ---------------------------------------------------------------- runs */

static celspan_status draw(void *user, const celspan_frame_desc *frame, const celspan_sink *sink) {
  const subject *s = user;
  return celspan_frame_render(s->studio.context, frame, sink, NULL);
}

static void finished(void *user, cs_tile_row row) { (void)user, (void)row; }

static bool tick(void *user) { return user != NULL; }

/* crop: NULL for the whole frame. *rows: the rows of tiles that were made. */
static int run(subject *s, const cs_pyramid_box *crop, size_t *rows) {
  celspan_context *context = s->studio.context;
  cs_tile_inputs inputs = {.frame = &s->frame, .file = "", .is_script = true};
  cs_tile_log log = {.descriptor = -1};
  cs_tile_log_state state;
  cs_tile_job jobs[32];
  cs_tile_render render = {.context = context,
                           .frame = &s->frame,
                           .pyramid = &s->pyramid,
                           .jobs = jobs,
                           .log = &log,
                           .workers = 1,
                           .draw = draw,
                           .finished = finished,
                           .tick = tick,
                           .user = s};
  for (int32_t level = s->levels[0]; level <= s->levels[1]; level++)
    jobs[render.job_count++] = (cs_tile_job){level, cs_pyramid_tiles(&s->pyramid, level, crop)};
  studio_check(&s->studio, cs_tile_log_find(context, &s->pyramid, &inputs, &log, &state));
  if (state == CS_TILE_LOG_OTHER)
    studio_check(&s->studio, cs_tile_log_clear(context, &s->pyramid, &log));
  studio_check(&s->studio, cs_tile_log_open(context, &s->pyramid, &log));
  *rows = cs_tile_render_row_count(&render);
  studio_check(&s->studio, cs_tile_render_run(&render));
  cs_tile_log_close(context, &log);
  return count_wrong(s, &render);
}

/* ---------------------------------------------------------------- one pyramid */

/* Sides at which levels or tiles begin or end, and any others. */
static int32_t draw_side(test_random *random) {
  static const int32_t SIDES[] = {255, 256, 257, 508, 510, 511, 512, 513, 1020, 1021, 1024, 1025};
  if (random_below(random, 2))
    return SIDES[random_below(random, sizeof SIDES / sizeof *SIDES)];
  return 40 + random_below(random, 1200);
}

static bool open_subject(subject *s, celspan_context *context, int number) {
  test_random random = {0x7115 + (uint64_t)(number / 3)};
  int32_t width = draw_side(&random), height = draw_side(&random);
  int32_t tile = 64 + random_below(&random, 193);
  *s = (subject){.studio.context = context, .exposure.weight = 1, .frame = CELSPAN_FRAME_DESC};
  s->exposure.rostrum = build(&s->studio, width, height);
  s->frame.exposures = &s->exposure;
  s->frame.exposure_count = 1;
  s->frame.film_width = s->frame.width = width;
  s->frame.film_height = s->frame.height = height;
  s->frame.has_antialias = true;
  s->frame.antialias = CELSPAN_ANTIALIAS_NONE;
  s->frame.workers = 1;
  snprintf(s->folder, sizeof s->folder, "%s/celspan-tiles-XXXXXX",
           access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
  s->pyramid = (cs_pyramid){.layout = number % 3 == 1 ? CS_PYRAMID_IIIF : CS_PYRAMID_DZI,
                            .width = width,
                            .height = height,
                            .tile = tile,
                            .overlap = number % 3 == 0   ? 1
                                       : number % 3 == 1 ? 0
                                                         : tile / 2,
                            .folder = s->folder,
                            .name = "p",
                            .ending = "tga"};
  s->levels[0] = number % 3 == 1 ? cs_pyramid_single(&s->pyramid) : 0;
  s->levels[1] = cs_pyramid_top(&s->pyramid);
  return CHECK(mkdtemp(s->folder) != NULL);
}

static void close_subject(subject *s) {
  remove_all(s->folder);
  for (int level = 0; level < LEVELS; level++)
    free(s->right[level]);
  studio_finish(&s->studio);
}

/* Position i of those at which crops begin or end: the borders of tiles, and one pixel to either
 * side. */
static int32_t border(int32_t tile, int32_t side, int i) {
  int32_t at = (i / 3) * tile + i % 3 - 1;
  return at < 0 ? 0 : at > side ? side : at;
}

static int border_count(int32_t tile, int32_t side) { return 3 * ((side + tile - 1) / tile + 1); }

/* A part of [0, side) that begins at border i, or ends there. */
static void cut(test_random *random, int32_t tile, int32_t side, int i, int32_t out[2]) {
  int count = border_count(tile, side);
  int32_t a = border(tile, side, i % count);
  int32_t b = border(tile, side, random_below(random, count));
  if (a == b)
    b = a < side ? side : 0;
  out[0] = a < b ? a : b;
  out[1] = a < b ? b : a;
}

/* Crops by which each border of the tiles is a beginning or an end, in a folder that is empty. The
 * small levels alone, then all. */
static int try_crops(subject *s, test_random *random) {
  int wrong = 0, across = border_count(s->pyramid.tile, s->pyramid.width);
  int down = border_count(s->pyramid.tile, s->pyramid.height);
  for (int i = 0; i < across || i < down; i++) {
    int32_t x[2], y[2];
    size_t rows;
    cut(random, s->pyramid.tile, s->pyramid.width, i, x);
    cut(random, s->pyramid.tile, s->pyramid.height, i, y);
    const cs_pyramid_box crop = {x[0], y[0], x[1], y[1]};
    remove_all(s->folder);
    int bad = run(s, &crop, &rows);
    if (bad)
      fprintf(stderr, "  crop %d,%d,%d,%d: %d wrong tiles\n", x[0], y[0], x[1] - x[0], y[1] - y[0],
              bad);
    wrong += bad;
  }
  return wrong;
}

/* Removes the tiles of a line of the record, as if they had not been made. */
static void remove_tiles(const subject *s, const char *line) {
  cs_tile_row row;
  char path[PATH_SIZE];
  if (sscanf(line, "row %d %d %d %d", &row.level, &row.row, &row.first, &row.end) != 4)
    return;
  for (int32_t x = row.first; x < row.end; x++)
    if (cs_pyramid_path(&s->pyramid, (cs_pyramid_tile){row.level, x, row.row}, false, path,
                        sizeof path))
      unlink(path);
}

/* Continues a run whose record became `record`, of `size` bytes. Of the whole record only the lines
 * that end within the first `kept` bytes have tiles. */
static int go_on(subject *s, const char *whole, size_t kept, const char *record, size_t size) {
  char path[PATH_SIZE];
  size_t rows;
  snprintf(path, sizeof path, "%s/p.tiles", s->folder);
  write_file(path, record, size);
  while (kept > 0 && whole[kept - 1] != '\n')
    kept--;
  for (const char *line = whole + kept; *line; line = strchr(line, '\n') + 1)
    remove_tiles(s, line);
  int wrong = run(s, NULL, &rows);
  if (wrong)
    fprintf(stderr, "  continued after %zu of %zu bytes: %d wrong tiles\n", kept, strlen(whole),
            wrong);
  return wrong;
}

/* The record is cut after a byte; then that byte, if it is a digit, is another one. */
static int damage(subject *s, const char *record, size_t size, size_t at) {
  static char changed[RECORD_SIZE];
  int wrong = go_on(s, record, at, record, at);
  memcpy(changed, record, size);
  changed[at] = record[at] == '9' ? '0' : (char)(record[at] + 1);
  if (record[at] >= '0' && record[at] <= '9')
    wrong += go_on(s, record, at, changed, size);
  return wrong;
}

static int try_records(subject *s, test_random *random) {
  static char record[RECORD_SIZE];
  char path[PATH_SIZE];
  size_t rows;
  int wrong = 0;
  s->levels[1] = cs_pyramid_within(&s->pyramid, 2 * MEAN_SIDE);
  remove_all(s->folder);
  wrong += run(s, NULL, &rows);
  snprintf(path, sizeof path, "%s/p.tiles", s->folder);
  size_t size = read_file(path, (unsigned char *)record, sizeof record - 1);
  record[size] = '\0';
  for (size_t i = 0; i < size; i++)
    if (s->is_whole || random_below(random, SAMPLE_BYTES) == 0)
      wrong += damage(s, record, size, i);
  wrong += run(s, NULL, &rows);
  CHECK(rows == 0);
  return wrong;
}

static void try_pyramid(celspan_context *context, int number, bool is_whole) {
  subject s;
  test_random random = {(uint64_t)number};
  size_t rows;
  if (open_subject(&s, context, number)) {
    s.is_whole = is_whole;
    set_right(&s);
    int wrong = run(&s, NULL, &rows);
    wrong += try_crops(&s, &random);
    wrong += try_records(&s, &random);
    if (!CHECK(wrong == 0))
      fprintf(stderr, "CASE=%d: %d x %d, tiles of %d, overlap %d: %d wrong tiles\n", number,
              s.pyramid.width, s.pyramid.height, s.pyramid.tile, s.pyramid.overlap, wrong);
  }
  close_subject(&s);
}

/* A sink of tiles that gets another picture than the tiles asked for. */
static void test_size(celspan_context *context) {
  const cs_pyramid pyramid = {.width = 100, .height = 100, .tile = 50, .ending = "tga"};
  cs_tile_output output = {.context = context, .pyramid = &pyramid};
  cs_tile_rows rows = {.output = &output, .level = 7, .tiles = {1, 1, 2, 2}, .workers = 1};
  rows.pixels = cs_pyramid_pixels(&pyramid, 7, &rows.tiles);
  celspan_sink sink = cs_tile_rows_sink(&rows);
  CHECK(sink.begin(sink.user, context, 100, 100) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(context), "tiles of 50 x 50 pixels cannot show 100 x 100");
  CHECK(sink.end(sink.user, context, CELSPAN_BAD_ARGUMENT) == CELSPAN_BAD_ARGUMENT);
}

int main(void) {
  const char *only = getenv("CASE"), *asked = getenv("CELSPAN_PYRAMIDS");
  const char *seed = getenv("CELSPAN_SEED");
  test_random random = {seed ? strtoull(seed, NULL, 10) : 1};
  int count = only ? 1 : asked ? atoi(asked) : SAMPLE;
  celspan_context *context = NULL;
  if (!CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK))
    return check_done();
  for (int i = 0; i < count; i++) {
    int number = random_below(&random, PYRAMIDS);
    if (asked || only || check_is_drawn(i))
      try_pyramid(context, only ? atoi(only) : count < PYRAMIDS ? number : i, asked || only);
  }
  test_size(context);
  celspan_context_destroy(context);
  return check_done();
}
