/* Pictures out and in: a written picture is read back as the same light, and broken files are
 * refused. One file, because formats differ little: painting, writing and reading back is
 * shared. */
#include <pthread.h>
#include <sys/stat.h>

#include "tests/support/memory.h"
#include "tests/support/picture.h"

static celspan_context *context;

/* ---------------------------------------------------------------- paints */

static void paint_waves(int x, int y, float rgba[4]) {
  float alpha = (float)(1 + (x * 7 + y * 3) % 16) / 16;
  rgba[0] = alpha * (float)(x % 32) / 31;
  rgba[1] = alpha * (float)(y % 16) / 15;
  rgba[2] = alpha * (float)((x + y) % 8) / 7;
  rgba[3] = alpha;
}

static void paint_opaque(int x, int y, float rgba[4]) {
  paint_waves(x, y, rgba);
  for (int c = 0; c < 3; c++)
    rgba[c] /= rgba[3];
  rgba[3] = 1;
}

static void paint_over_black(int x, int y, float rgba[4]) {
  paint_waves(x, y, rgba);
  rgba[3] = 1;
}

static void paint_smooth(int x, int y, float rgba[4]) {
  rgba[0] = (float)x / 200;
  rgba[1] = (float)y / 200;
  rgba[2] = 0.25f;
  rgba[3] = 1;
}

static void paint_bright(int x, int y, float rgba[4]) {
  rgba[0] = (float)(x + 1);
  rgba[1] = (float)(y + 1) / 64;
  rgba[2] = 0.5f;
  rgba[3] = 1;
}

/* ---------------------------------------------------------------- out and in again */

/* The greatest difference between the painted and the read picture. */
static double difference(const cs_picture *picture, int width, int height, picture_paint paint) {
  double worst = 0;
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++) {
      float wanted[4], got[4];
      paint(x, y, wanted);
      if (picture_texel(context, picture, 0, x, y, got) != CELSPAN_OK)
        return INFINITY;
      for (int c = 0; c < 4; c++)
        worst = fmax(worst, fabs((double)wanted[c] - (double)got[c]));
    }
  return worst;
}

typedef struct round_trip {
  const char *name;
  celspan_depth depth;
  picture_paint paint, expected;
  double tolerance;
  const char *format, *colour;
  bool has_alpha, is_float;
} round_trip;

static void test_round_trip(const round_trip *t) {
  const char *path = picture_path(t->name);
  celspan_coding coding = {.struct_size = sizeof coding, .depth = t->depth};
  cs_picture *picture;
  celspan_picture_info info = CELSPAN_PICTURE_INFO;
  if (!CHECK(picture_write(context, path, &coding, 150, 100, t->paint) == CELSPAN_OK) ||
      !CHECK(picture_open(context, path, &picture, &info) == CELSPAN_OK)) {
    fprintf(stderr, "%s: %s\n", t->name, celspan_context_error(context));
    return;
  }
  CHECK(info.width == 150 && info.height == 100);
  CHECK(info.has_alpha == t->has_alpha && info.is_float == t->is_float);
  CHECK_TEXT(info.format, t->format);
  CHECK_TEXT(info.colour, t->colour);
  if (!CHECK_NEAR(difference(picture, 150, 100, t->expected), 0, t->tolerance))
    fprintf(stderr, "  %s: %s\n", t->name, celspan_context_error(context));
  cs_picture_unref(picture);
  unlink(path);
}

static void test_round_trips(void) {
  const double byte = 0.006, fine = 3e-5;
  const round_trip trips[] = {
      {"a.png", CELSPAN_DEPTH_8, paint_waves, paint_waves, byte, "png", "srgb", true, false},
      {"b.png", CELSPAN_DEPTH_16, paint_waves, paint_waves, fine, "png", "srgb", true, false},
      {"a.tif", CELSPAN_DEPTH_DEFAULT, paint_waves, paint_waves, byte, "tiff", "srgb", true, false},
      {"b.tif", CELSPAN_DEPTH_16, paint_waves, paint_waves, fine, "tiff", "srgb", true, false},
      {"c.tif", CELSPAN_DEPTH_FLOAT, paint_waves, paint_waves, 1e-6, "tiff", "linear", true, true},
      {"a.exr", CELSPAN_DEPTH_DEFAULT, paint_waves, paint_waves, 3e-4, "openexr", "linear", true,
       true},
      {"b.exr", CELSPAN_DEPTH_FLOAT, paint_waves, paint_waves, 0, "openexr", "linear", true, true},
      {"a.tga", CELSPAN_DEPTH_8, paint_waves, paint_waves, byte, "targa", "srgb", true, false},
      {"a.webp", CELSPAN_DEPTH_8, paint_smooth, paint_smooth, 0.05, "webp", "srgb", false, false},
      {"a.bmp", CELSPAN_DEPTH_8, paint_waves, paint_over_black, byte, "bmp", "srgb", false, false},
      {"a.ppm", CELSPAN_DEPTH_8, paint_waves, paint_over_black, byte, "pnm", "srgb", false, false},
      {"a.hdr", CELSPAN_DEPTH_FLOAT, paint_waves, paint_over_black, 8e-3, "hdr", "linear", false,
       true},
      {"a.jpg", CELSPAN_DEPTH_8, paint_smooth, paint_smooth, 0.03, "jpeg", "srgb", false, false},
      {"a.jp2", CELSPAN_DEPTH_8, paint_smooth, paint_smooth, 0.03, "jpeg2000", "srgb", false,
       false},
      {"a.dpx", CELSPAN_DEPTH_DEFAULT, paint_waves, paint_over_black, 0.005, "dpx", "cineon", false,
       false},
      {"b.dpx", CELSPAN_DEPTH_16, paint_waves, paint_over_black, 1e-4, "dpx", "cineon", false,
       false},
  };
  for (size_t i = 0; i < sizeof trips / sizeof *trips; i++)
    test_round_trip(&trips[i]);
}

static void test_light_beyond_white(void) {
  const char *path = picture_path("bright.exr");
  cs_picture *picture;
  celspan_picture_info info = CELSPAN_PICTURE_INFO;
  float rgba[4];
  CHECK(picture_write(context, path, NULL, 70, 3, paint_bright) == CELSPAN_OK);
  if (!CHECK(picture_open(context, path, &picture, &info) == CELSPAN_OK))
    return;
  CHECK(picture_texel(context, picture, 0, 69, 2, rgba) == CELSPAN_OK);
  CHECK_NEAR(rgba[0], 70, 0);
  cs_picture_unref(picture);
  unlink(path);
}

/* ---------------------------------------------------------------- levels */

/* Every level compared with the mean computed in double over the picture's own pixels. */
static void check_levels(const cs_picture *picture, int width, int height, picture_paint paint) {
  double worst = 0;
  int level = 0;
  for (int w = width, h = height;; w = (w + 1) / 2, h = (h + 1) / 2, level++) {
    for (int y = 0; y < h; y += 3)
      for (int x = 0; x < w; x += (w > 5 ? 5 : 1)) {
        double sum[4] = {0}, count = 0;
        for (int j = y << level; j < (y + 1) << level && j < height; j++)
          for (int i = x << level; i < (x + 1) << level && i < width; i++, count++) {
            float pixel[4];
            paint(i, j, pixel);
            for (int c = 0; c < 4; c++)
              sum[c] += (double)pixel[c];
          }
        float got[4];
        if (!CHECK(picture_texel(context, picture, level, x, y, got) == CELSPAN_OK))
          return;
        for (int c = 0; c < 4; c++)
          worst = fmax(worst, fabs(sum[c] / count - (double)got[c]));
      }
    if (w == 1 && h == 1)
      break;
  }
  CHECK_NEAR(worst, 0, 2e-6);
}

static void test_levels(void) {
  const char *path = picture_path("levels.exr");
  celspan_coding coding = {.struct_size = sizeof coding, .depth = CELSPAN_DEPTH_FLOAT};
  cs_picture *picture;
  celspan_picture_info info = CELSPAN_PICTURE_INFO;
  CHECK(picture_write(context, path, &coding, 333, 157, paint_waves) == CELSPAN_OK);
  if (!CHECK(picture_open(context, path, &picture, &info) == CELSPAN_OK))
    return;
  check_levels(picture, 333, 157, paint_waves);
  cs_picture_unref(picture);
  unlink(path);
}

/* ---------------------------------------------------------------- budget and threads */

typedef struct reading {
  celspan_context *context;
  const cs_picture *picture;
  int width, height, direction;
  uint64_t digest;
  celspan_status status;
} reading;

static uint64_t digest_block(celspan_context *on, const cs_picture *picture, int level, int column,
                             int row, celspan_status *status) {
  cs_picture_block *block;
  *status = cs_load_block(on, picture, level, column, row, &block);
  if (*status != CELSPAN_OK)
    return 0;
  uint32_t words[4 * CS_PICTURE_BLOCK * CS_PICTURE_BLOCK];
  memcpy(words, block->texels, sizeof words);
  cs_store_release(block);
  uint64_t digest = (uint64_t)(level * 1000 + column * 100 + row);
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    digest = (digest ^ words[i]) * 0x100000001b3u;
  return digest;
}

/* All blocks of all levels; the sum does not depend on their order. */
static void *read_all(void *user) {
  reading *r = user;
  int w = r->width, h = r->height;
  for (int level = 0;; level++, w = (w + 1) / 2, h = (h + 1) / 2) {
    int columns = (w + 63) / 64, rows = (h + 63) / 64;
    for (int i = 0; i < columns * rows && r->status == CELSPAN_OK; i++) {
      int at = r->direction > 0 ? i : columns * rows - 1 - i;
      r->digest +=
          digest_block(r->context, r->picture, level, at % columns, at / columns, &r->status);
    }
    if (w == 1 && h == 1)
      return NULL;
  }
}

static uint64_t digest_with(const char *path, size_t budget, int threads) {
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  desc.picture_bytes = budget;
  celspan_context *own, branches[4];
  cs_picture *picture;
  celspan_picture_info info = CELSPAN_PICTURE_INFO;
  pthread_t ids[4];
  reading readings[4];
  CHECK(celspan_context_create(&desc, &own) == CELSPAN_OK);
  if (!CHECK(picture_open(own, path, &picture, &info) == CELSPAN_OK))
    return 0;
  for (int i = 0; i < threads; i++) {
    cs_context_branch(&branches[i], own);
    readings[i] = (reading){&branches[i], picture, info.width, info.height, i % 2 ? -1 : 1, 0, 0};
    pthread_create(&ids[i], NULL, read_all, &readings[i]);
  }
  for (int i = 0; i < threads; i++) {
    pthread_join(ids[i], NULL);
    CHECK(readings[i].status == CELSPAN_OK && readings[i].digest == readings[0].digest);
  }
  cs_picture_unref(picture);
  celspan_context_destroy(own);
  return readings[0].digest;
}

static void test_budget_and_threads(void) {
  const char *names[] = {"budget.png", "budget.exr", "budget.tif"};
  for (int i = 0; i < 3; i++) {
    const char *path = picture_path(names[i]);
    CHECK(picture_write(context, path, NULL, 701, 403, paint_waves) == CELSPAN_OK);
    uint64_t ample = digest_with(path, (size_t)64 << 20, 1);
    CHECK(ample == digest_with(path, (size_t)64 << 20, 2));
    CHECK(ample == digest_with(path, (size_t)3 << 20, 2));
    CHECK(ample == digest_with(path, (size_t)1 << 19, 2));
    CHECK(ample == digest_with(path, 1, 2));
    unlink(path);
  }
}

/* ---------------------------------------------------------------- what is refused */

static void write_bytes(const char *path, const void *bytes, size_t size) {
  FILE *file = fopen(path, "wb");
  CHECK(file && fwrite(bytes, 1, size, file) == size);
  if (file)
    fclose(file);
}

/* The status of reading every block of a file. */
static celspan_status read_file(const char *path) {
  celspan_context *own;
  cs_picture *picture;
  celspan_picture_info info = CELSPAN_PICTURE_INFO;
  if (celspan_context_create(NULL, &own) != CELSPAN_OK)
    return CELSPAN_NO_MEMORY;
  celspan_status status = picture_open(own, path, &picture, &info);
  if (status == CELSPAN_OK) {
    float rgba[4];
    for (int y = 0; y < info.height && status == CELSPAN_OK; y += 64)
      for (int x = 0; x < info.width && status == CELSPAN_OK; x += 64)
        status = picture_texel(own, picture, 0, x, y, rgba);
    cs_picture_unref(picture);
  }
  if (status != CELSPAN_OK) {
    CHECK(strstr(celspan_context_error(own), path));
    celspan_context_fail(context, status, "%s", celspan_context_error(own));
  }
  celspan_context_destroy(own);
  return status;
}

static void test_missing(void) {
  const char *path = picture_path("none.png");
  CHECK(read_file(path) == CELSPAN_INPUT);
  CHECK(strstr(celspan_context_error(context), "No such file"));
  CHECK(read_file("/tmp") == CELSPAN_INPUT);
  write_bytes(path, "", 0);
  CHECK(read_file(path) == CELSPAN_INPUT && strstr(celspan_context_error(context), "empty"));
  write_bytes(path, "these are not the pixels", 24);
  CHECK(read_file(path) == CELSPAN_INPUT);
  write_bytes(path, "FOR4 and so on, an iff file", 27);
  CHECK(read_file(path) == CELSPAN_INPUT && strstr(celspan_context_error(context), "IFF"));
  unlink(path);
}

static void test_truncated(void) {
  static const char *const names[] = {"t.png", "t.tif", "t.exr", "t.tga",  "t.dpx", "t.jpg",
                                      "t.bmp", "t.ppm", "t.hdr", "t.webp", "t.gif", "t.jp2"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    const char *path = picture_path(names[i]);
    struct stat status;
    if (!CHECK(picture_write(context, path, NULL, 300, 200, paint_opaque) == CELSPAN_OK)) {
      fprintf(stderr, "  %s: %s\n", names[i], celspan_context_error(context));
      continue;
    }
    CHECK(read_file(path) == CELSPAN_OK);
    CHECK(stat(path, &status) == 0 && truncate(path, status.st_size * 6 / 10) == 0);
    if (!CHECK(read_file(path) == CELSPAN_INPUT))
      fprintf(stderr, "  %s cut to %lld bytes\n", names[i], (long long)status.st_size * 6 / 10);
    CHECK(truncate(path, 30) == 0);
    CHECK(read_file(path) != CELSPAN_OK);
    unlink(path);
  }
}

/* ---------------------------------------------------------------- where a JPEG ends */

/* 40 x 24, grey, progressive, with restart markers. */
static const unsigned char progressive[] = {
    0xff, 0xd8, 0xff, 0xdb, 0x00, 0x43, 0x00, 0x28, 0x1c, 0x1e, 0x23, 0x1e, 0x19, 0x28, 0x23, 0x21,
    0x23, 0x2d, 0x2b, 0x28, 0x30, 0x3c, 0x64, 0x41, 0x3c, 0x37, 0x37, 0x3c, 0x7b, 0x58, 0x5d, 0x49,
    0x64, 0x91, 0x80, 0x99, 0x96, 0x8f, 0x80, 0x8c, 0x8a, 0xa0, 0xb4, 0xe6, 0xc3, 0xa0, 0xaa, 0xda,
    0xad, 0x8a, 0x8c, 0xc8, 0xff, 0xcb, 0xda, 0xee, 0xf5, 0xff, 0xff, 0xff, 0x9b, 0xc1, 0xff, 0xff,
    0xff, 0xfa, 0xff, 0xe6, 0xfd, 0xff, 0xf8, 0xff, 0xc2, 0x00, 0x0b, 0x08, 0x00, 0x18, 0x00, 0x28,
    0x01, 0x01, 0x11, 0x00, 0xff, 0xc4, 0x00, 0x19, 0x00, 0x00, 0x02, 0x03, 0x01, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x03, 0x04, 0x00, 0x01, 0x02, 0x05, 0xff,
    0xdd, 0x00, 0x04, 0x00, 0x02, 0xff, 0xda, 0x00, 0x08, 0x01, 0x01, 0x00, 0x00, 0x00, 0x01, 0x54,
    0xdf, 0xff, 0xd0, 0x86, 0xff, 0xd1, 0x67, 0x9d, 0xff, 0xd2, 0xd4, 0xff, 0xd3, 0xdd, 0xff, 0x00,
    0xff, 0xd4, 0x13, 0xbf, 0xff, 0xd5, 0x2a, 0x3f, 0xff, 0xd6, 0x07, 0xff, 0xc4, 0x00, 0x19, 0x10,
    0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x01, 0x00, 0x02, 0x12, 0x03, 0x11, 0xff, 0xda, 0x00, 0x08, 0x01, 0x01, 0x00, 0x01, 0x05, 0x02,
    0x20, 0xbf, 0xff, 0xd0, 0x20, 0xbf, 0xff, 0xd1, 0x22, 0xff, 0xd2, 0x08, 0xbf, 0xff, 0xd3, 0xde,
    0xf9, 0xbd, 0x75, 0xf3, 0x3f, 0xff, 0xd4, 0x20, 0xbf, 0xff, 0xd5, 0x20, 0xbf, 0xff, 0xd6, 0xde,
    0xba, 0xd7, 0xff, 0xc4, 0x00, 0x19, 0x10, 0x01, 0x00, 0x02, 0x03, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x10, 0x00, 0x11, 0x01, 0x31, 0x51, 0xff, 0xda, 0x00,
    0x08, 0x01, 0x01, 0x00, 0x06, 0x3f, 0x02, 0x3f, 0xff, 0xd0, 0x3f, 0xff, 0xd1, 0x3f, 0xff, 0xd2,
    0x3f, 0xff, 0xd3, 0xac, 0x6e, 0x57, 0x67, 0xff, 0xd4, 0x3f, 0xff, 0xd5, 0x3f, 0xff, 0xd6, 0xb9,
    0xff, 0xc4, 0x00, 0x1b, 0x10, 0x00, 0x02, 0x02, 0x03, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x01, 0x10, 0x11, 0x21, 0x31, 0x41, 0xf1, 0xff, 0xda, 0x00,
    0x08, 0x01, 0x01, 0x00, 0x01, 0x3f, 0x21, 0x48, 0x3f, 0xff, 0xd0, 0x48, 0x3f, 0xff, 0xd1, 0x41,
    0x0f, 0xff, 0xd2, 0x04, 0x3f, 0xff, 0xd3, 0xaf, 0xe1, 0x30, 0x6d, 0xe0, 0x7f, 0xff, 0xd4, 0x48,
    0x3f, 0xff, 0xd5, 0x48, 0x3f, 0xff, 0xd6, 0xb3, 0xe3, 0x48, 0xff, 0xda, 0x00, 0x08, 0x01, 0x01,
    0x00, 0x00, 0x00, 0x10, 0xff, 0x00, 0xff, 0xd0, 0x3f, 0xff, 0xd1, 0xff, 0x00, 0xff, 0xd2, 0x7f,
    0xff, 0xd3, 0xbf, 0xff, 0xd4, 0x3f, 0xff, 0xd5, 0x7f, 0xff, 0xd6, 0xff, 0x00, 0xff, 0xc4, 0x00,
    0x1f, 0x10, 0x00, 0x01, 0x03, 0x03, 0x05, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x10, 0x00, 0x01, 0x71, 0x11, 0x21, 0xf0, 0x31, 0x41, 0x81, 0x91, 0xd1, 0xff, 0xda,
    0x00, 0x08, 0x01, 0x01, 0x00, 0x01, 0x3f, 0x10, 0x01, 0xff, 0xd0, 0x01, 0xff, 0xd1, 0x01, 0xff,
    0xd2, 0x01, 0xff, 0xd3, 0x6a, 0xc6, 0xee, 0x6c, 0x4a, 0x8b, 0x34, 0x6f, 0xe7, 0x2b, 0xff, 0xd4,
    0x01, 0xff, 0xd5, 0x01, 0xff, 0xd6, 0xa4, 0x9a, 0x7a, 0x5b, 0x2a, 0xbf, 0xff, 0xd9,
};

/* A buffer of bytes put together from parts. */
typedef struct joined {
  unsigned char bytes[1 << 17];
  size_t size;
} joined;

static void join(joined *to, const void *bytes, size_t size) {
  if (!CHECK(size <= sizeof to->bytes - to->size))
    return;
  memcpy(to->bytes + to->size, bytes, size);
  to->size += size;
}

static joined painted_jpeg(int width, int height) {
  const char *path = picture_path("painted.jpg");
  joined out = {.size = 0};
  CHECK(picture_write(context, path, NULL, width, height, paint_opaque) == CELSPAN_OK);
  FILE *file = fopen(path, "rb");
  out.size = file ? fread(out.bytes, 1, sizeof out.bytes, file) : 0;
  if (file)
    fclose(file);
  unlink(path);
  CHECK(out.size > 1000 && out.size < 50000);
  return out;
}

/* The picture with, after its first marker, a segment that contains another complete picture. */
static joined with_thumbnail(const joined *picture, const joined *thumbnail) {
  size_t length = thumbnail->size + 8;
  const unsigned char head[] = {
      0xff, 0xe1, (unsigned char)(length >> 8), (unsigned char)length, 'E', 'x', 'i', 'f', 0, 0};
  joined out = {.size = 0};
  join(&out, picture->bytes, 2);
  join(&out, head, sizeof head);
  join(&out, thumbnail->bytes, thumbnail->size);
  join(&out, picture->bytes + 2, picture->size - 2);
  return out;
}

static celspan_status read_bytes(const void *bytes, size_t size) {
  const char *path = picture_path("end.jpg");
  write_bytes(path, bytes, size);
  celspan_status status = read_file(path);
  unlink(path);
  return status;
}

static void check_cut(const joined *file, size_t size) {
  if (!CHECK(read_bytes(file->bytes, size) == CELSPAN_INPUT) ||
      !CHECK(strstr(celspan_context_error(context), "is truncated")))
    fprintf(stderr, "  %zu of %zu bytes: %s\n", size, file->size, celspan_context_error(context));
}

/* The end of a thumbnail, or of a picture that follows, is not the end of the picture. */
static void test_jpeg_ends(void) {
  joined picture = painted_jpeg(200, 150), small = painted_jpeg(60, 40);
  joined file = with_thumbnail(&picture, &small);
  CHECK(read_bytes(file.bytes, file.size) == CELSPAN_OK);
  for (size_t i = 1; i < 10; i++) /* the first cuts are in the thumbnail */
    check_cut(&file, file.size * i / 10);
  check_cut(&file, file.size - 1);
  joined cut = {.size = 0}, filled = {.size = 0};
  join(&cut, picture.bytes, picture.size * 7 / 10);
  join(&cut, small.bytes, small.size);
  check_cut(&cut, cut.size);
  join(&file, small.bytes, small.size); /* as phones append further pictures */
  join(&file, "and notes", 9);
  CHECK(read_bytes(file.bytes, file.size) == CELSPAN_OK);
  join(&filled, picture.bytes, 2);
  join(&filled, "\xff\xff\xff", 3); /* fill bytes before a marker are allowed */
  join(&filled, picture.bytes + 2, picture.size - 2);
  CHECK(read_bytes(filled.bytes, filled.size) == CELSPAN_OK);
  CHECK(read_bytes(progressive, sizeof progressive) == CELSPAN_OK);
  for (size_t size = 1; size < sizeof progressive; size++)
    CHECK(read_bytes(progressive, size) != CELSPAN_OK);
}

/* Every byte of small files is changed: any result is right except a crash or a hang. */
static void test_corrupt(void) {
  static const char *const names[] = {"c.png", "c.tga", "c.exr", "c.gif"};
  static unsigned char bytes[1 << 16];
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    const char *path = picture_path(names[i]);
    CHECK(picture_write(context, path, NULL, 9, 7, paint_opaque) == CELSPAN_OK);
    FILE *file = fopen(path, "rb");
    size_t size = file ? fread(bytes, 1, sizeof bytes, file) : 0;
    if (file)
      fclose(file);
    size_t refused = 0;
    for (size_t at = 0; at < size; at += 1 + size / 100) {
      unsigned char kept = bytes[at];
      bytes[at] ^= 0xa5;
      write_bytes(path, bytes, size);
      refused += read_file(path) != CELSPAN_OK;
      bytes[at] = kept;
    }
    CHECK(refused > 0);
    unlink(path);
  }
}

static void test_huge_headers(void) {
  const char *path = picture_path("huge.tga");
  unsigned char tga[18] = {0, 0, 2, [12] = 0xff, 0xff, 0xff, 0xff, 32, 8};
  write_bytes(path, tga, sizeof tga);
  CHECK(read_file(path) == CELSPAN_LIMIT);
  CHECK(strstr(celspan_context_error(context), "65535 x 65535"));
  unsigned char gif[13] = {'G', 'I', 'F', '8', '9', 'a', 0xff, 0xff, 0xff, 0xff};
  write_bytes(path, gif, sizeof gif);
  CHECK(read_file(path) == CELSPAN_LIMIT);
  unsigned char psd[26] = {'8', 'B',  'P', 'S', 0, 1, [13] = 3, 0x7f, 0, 0,
                           1,   0x7f, 0,   0,   1, 0, 8,        0,    3};
  write_bytes(path, psd, sizeof psd);
  CHECK(read_file(path) == CELSPAN_LIMIT);
  unlink(path);
}

/* A Photoshop document of 16 x 16 pixels whose layer and mask declare `rows` and `mask_rows` rows;
 * no bytes follow. */
static void check_rows(int32_t rows, int32_t mask_rows, celspan_status status) {
  const char *path = picture_path("rows.psd");
  unsigned char psd[26 + 8 + 8 + 2 + 18 + 6 + 12 + 4 + 24] = {
      '8', 'B', 'P', 'S', 0, 1, [13] = 3, [17] = 16, [21] = 16, [23] = 8, 0, 3};
  unsigned char *record = psd + 44;
  psd[37] = 4 + 2 + 64;
  psd[41] = 2 + 64;
  psd[43] = 1;
  record[17] = 1; /* a channel */
  record[18] = mask_rows ? 0xff : 0;
  record[19] = mask_rows ? 0xfe : 0;
  record[23] = 9; /* its bytes */
  memcpy(record + 24, "8BIMnorm", 8);
  record[39] = 24;
  record[43] = 20;
  for (int i = 0; i < 4; i++) {
    record[8 + i] = (unsigned char)(rows >> (24 - 8 * i));
    record[52 + i] = (unsigned char)(mask_rows >> (24 - 8 * i));
  }
  write_bytes(path, psd, sizeof psd);
  CHECK(read_file(path) == status);
  bool is_told = strstr(celspan_context_error(context), "have more rows than the file has bytes");
  CHECK(is_told == (rows > (int32_t)sizeof psd || mask_rows > (int32_t)sizeof psd));
  unlink(path);
}

static void test_rows_of_layers(void) {
  check_rows(3, 0, CELSPAN_INPUT); /* cut off */
  check_rows(400000000, 0, CELSPAN_INPUT);
  check_rows(0, 400000000, CELSPAN_INPUT);
}

static void test_changed(void) {
  const char *path = picture_path("changed.tif");
  cs_picture *picture;
  celspan_picture_info info = CELSPAN_PICTURE_INFO;
  float rgba[4];
  CHECK(picture_write(context, path, NULL, 65, 40, paint_opaque) == CELSPAN_OK);
  if (!CHECK(picture_open(context, path, &picture, &info) == CELSPAN_OK))
    return;
  CHECK(picture_write(context, path, NULL, 65, 41, paint_waves) == CELSPAN_OK);
  CHECK(picture_texel(context, picture, 0, 0, 0, rgba) == CELSPAN_INPUT);
  CHECK(strstr(celspan_context_error(context), "changed"));
  cs_picture_unref(picture);
  unlink(path);
}

static void test_arguments(void) {
  celspan_picture_info info = CELSPAN_PICTURE_INFO;
  celspan_picture_desc desc = {.struct_size = sizeof desc, .file = ""};
  unsetenv("OCIO");
  CHECK(celspan_picture_inspect(context, &desc, &info) == CELSPAN_BAD_ARGUMENT);
  desc = (celspan_picture_desc){
      .struct_size = sizeof(celspan_picture_desc), .file = "a.png", .colour = "mauve"};
  CHECK(celspan_picture_inspect(context, &desc, &info) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "mauve"));
  desc = (celspan_picture_desc){
      .struct_size = sizeof(celspan_picture_desc), .file = "a.png", .subimage = -1};
  CHECK(celspan_picture_inspect(context, &desc, &info) == CELSPAN_BAD_ARGUMENT);
}

static void test_hash(void) {
  const celspan_picture_desc descs[] = {
      {.struct_size = sizeof *descs, .file = "a"},
      {.struct_size = sizeof *descs, .file = "b"},
      {.struct_size = sizeof *descs, .file = "a", .colour = "srgb"},
      {.struct_size = sizeof *descs, .file = "a", .layer = "srgb"},
      {.struct_size = sizeof *descs, .file = "a", .subimage = 1},
      {.struct_size = sizeof *descs, .file = "a", .has_source = true, .source = {0, 0, 2, 3}},
      {.struct_size = sizeof *descs, .file = "a", .has_source = true, .source = {0, 0, 3, 2}},
      {.struct_size = sizeof *descs, .file = "a", .has_source = true, .source = {1, 0, 2, 3}},
      {.struct_size = sizeof *descs, .file = "b", .has_source = true, .source = {0, 0, 2, 3}}};
  cs_hash hashes[9];
  for (int i = 0; i < 9; i++) {
    cs_picture *picture;
    CHECK(cs_picture_create(context, &descs[i], &picture) == CELSPAN_OK);
    hashes[i] = cs_picture_hash(picture);
    for (int j = 0; j < i; j++)
      CHECK(hashes[i].a != hashes[j].a || hashes[i].b != hashes[j].b);
    cs_picture_unref(picture);
  }
}

static void test_part_in_memory(const char *path, celspan_context *own, size_t *status_count) {
  const celspan_picture_desc desc = {
      .struct_size = sizeof desc, .file = path, .has_source = true, .source = {50, 3, 40, 66}};
  cs_picture *part = NULL;
  float rgba[4], whole[4];
  celspan_status status = cs_picture_create(own, &desc, &part);
  if (status == CELSPAN_OK)
    status = picture_texel(own, part, 0, 20, 65, rgba);
  if (status == CELSPAN_OK) {
    CHECK(picture_texel(own, part->whole, 0, 70, 68, whole) == CELSPAN_OK);
    CHECK(memcmp(rgba, whole, sizeof rgba) == 0);
  }
  CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
  *status_count += status == CELSPAN_OK;
  cs_picture_unref(part);
}

/* A part is made of the blocks of its whole, and every allocation may fail. */
static void test_parts(void) {
  const char *path = picture_path("part.png");
  size_t good = 0;
  CHECK(picture_write(context, path, NULL, 100, 70, paint_waves) == CELSPAN_OK);
  for (size_t n = 1; n < 100 && good == 0; n++) {
    memory_watch watch = {0};
    celspan_context *own = memory_watch_context(&watch);
    watch.fail_at = watch.allocations + n;
    test_part_in_memory(path, own, &good);
    celspan_context_destroy(own);
    CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  }
  CHECK(good == 1);
  celspan_picture_info info = CELSPAN_PICTURE_INFO;
  celspan_picture_desc desc = {
      .struct_size = sizeof desc, .file = path, .has_source = true, .source = {90, 60, 10, 10}};
  CHECK(celspan_picture_inspect(context, &desc, &info) == CELSPAN_OK);
  CHECK(info.width == 10 && info.height == 10);
  info.struct_size = 0;
  CHECK(celspan_picture_inspect(context, &desc, &info) == CELSPAN_BAD_ARGUMENT);
  info = CELSPAN_PICTURE_INFO;
  desc.source.height = 11;
  CHECK(celspan_picture_inspect(context, &desc, &info) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "source {90, 60, 10, 11} is not inside"));
  desc.source.height = NAN;
  CHECK(celspan_picture_inspect(context, &desc, &info) == CELSPAN_BAD_ARGUMENT);
  unlink(path);
}

/* Every allocation fails once: nothing leaks, the next try succeeds. */
static void test_memory(void) {
  const char *path = picture_path("memory.png");
  CHECK(picture_write(context, path, NULL, 100, 70, paint_waves) == CELSPAN_OK);
  for (size_t n = 1;; n++) {
    memory_watch watch = {0};
    celspan_context *own = memory_watch_context(&watch);
    cs_picture *picture;
    celspan_picture_info info = CELSPAN_PICTURE_INFO;
    float rgba[4];
    watch.fail_at = watch.allocations + n;
    celspan_status status = picture_open(own, path, &picture, &info);
    if (status == CELSPAN_OK) {
      status = picture_texel(own, picture, 1, 3, 3, rgba);
      if (status == CELSPAN_NO_MEMORY)
        CHECK(picture_texel(own, picture, 1, 3, 3, rgba) == CELSPAN_OK);
      cs_picture_unref(picture);
    }
    CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
    bool is_done = watch.allocations < watch.fail_at;
    celspan_context_destroy(own);
    CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
    if (is_done)
      break;
  }
  unlink(path);
}

/* ---------------------------------------------------------------- orientation */

static void put16(unsigned char **at, unsigned value) {
  *(*at)++ = (unsigned char)value;
  *(*at)++ = (unsigned char)(value >> 8);
}

static void put_tag(unsigned char **at, unsigned tag, unsigned type, unsigned count,
                    unsigned value) {
  put16(at, tag);
  put16(at, type);
  put16(at, count);
  put16(at, 0);
  put16(at, value);
  put16(at, 0);
}

/* A grey TIFF of 3 x 2 pixels with values 10, 20, .. 60, and an orientation tag. */
static void write_oriented(const char *path, unsigned orientation) {
  unsigned char bytes[256] = {0}, *at = bytes;
  const unsigned tags[][3] = {{256, 3, 3}, {257, 3, 2}, {258, 3, 8}, {259, 3, 1}, {262, 3, 1},
                              {273, 4, 8}, {274, 3, 0}, {277, 3, 1}, {278, 3, 2}, {279, 4, 6}};
  memcpy(at, "II*\0\16\0\0\0", 8);
  at += 8;
  for (unsigned char v = 10; v <= 60; v = (unsigned char)(v + 10))
    *at++ = v;
  put16(&at, 10);
  for (int i = 0; i < 10; i++)
    put_tag(&at, tags[i][0], tags[i][1], 1, tags[i][0] == 274 ? orientation : tags[i][2]);
  write_bytes(path, bytes, (size_t)(at - bytes) + 4);
}

/* The corners as the tag's definition places them: the values top left, top right, bottom left. */
static void test_orientation(void) {
  static const int corners[8][3] = {{10, 30, 40}, {30, 10, 60}, {60, 40, 30}, {40, 60, 10},
                                    {10, 40, 30}, {40, 10, 60}, {60, 30, 40}, {30, 60, 10}};
  for (unsigned orientation = 1; orientation <= 8; orientation++) {
    const char *path = picture_path("turned.tif");
    write_oriented(path, orientation);
    celspan_picture_desc desc = {.struct_size = sizeof desc, .file = path, .colour = "linear"};
    celspan_context *own;
    cs_picture *picture;
    celspan_picture_info info = CELSPAN_PICTURE_INFO;
    float rgba[3][4];
    CHECK(celspan_context_create(NULL, &own) == CELSPAN_OK);
    CHECK(cs_picture_create(own, &desc, &picture) == CELSPAN_OK);
    if (CHECK(cs_store_info(own, picture, &info) == CELSPAN_OK) &&
        CHECK(info.width == (orientation < 5 ? 3 : 2) &&
              info.height == (orientation < 5 ? 2 : 3)) &&
        CHECK(picture_texel(own, picture, 0, 0, 0, rgba[0]) == CELSPAN_OK) &&
        CHECK(picture_texel(own, picture, 0, info.width - 1, 0, rgba[1]) == CELSPAN_OK) &&
        CHECK(picture_texel(own, picture, 0, 0, info.height - 1, rgba[2]) == CELSPAN_OK))
      for (int i = 0; i < 3; i++)
        CHECK_NEAR((double)rgba[i][0] * 255, corners[orientation - 1][i], 1e-4);
    else
      fprintf(stderr, "  orientation %u: %s\n", orientation, celspan_context_error(own));
    cs_picture_unref(picture);
    celspan_context_destroy(own);
    unlink(path);
  }
}

/* ---------------------------------------------------------------- pictures made by others */

static const char *material;

static const char *material_path(const char *name) {
  static char paths[2][1024];
  static int next;
  char *path = paths[next++ % 2];
  snprintf(path, sizeof paths[0], "%s/%s", material, name);
  if (access(path, R_OK) != 0) {
    check_skip(path);
    return NULL;
  }
  return path;
}

static void test_film_log(void) {
  const char *path = material_path("film-log/cannon_log10.dpx");
  const char *table = material_path("film-log/cannon_log10.samples.tsv");
  cs_picture *picture;
  celspan_picture_info info = CELSPAN_PICTURE_INFO;
  if (!path || !table)
    return;
  if (!CHECK(picture_open(context, path, &picture, &info) == CELSPAN_OK))
    return;
  CHECK_TEXT(info.colour, "cineon");
  CHECK(info.width == 780 && info.height == 566);
  FILE *file = fopen(table, "r");
  char line[256];
  int rows = 0;
  while (file && fgets(line, sizeof line, file)) {
    int x, y, code[3];
    double light[3];
    if (sscanf(line, "%d %d %d %d %d %lf %lf %lf", &x, &y, code, code + 1, code + 2, light,
               light + 1, light + 2) != 8)
      continue;
    float rgba[4];
    CHECK(picture_texel(context, picture, 0, x, y, rgba) == CELSPAN_OK);
    for (int c = 0; c < 3; c++)
      CHECK_NEAR((double)rgba[c], light[c], 1e-6);
    rows++;
  }
  if (file)
    fclose(file);
  CHECK(rows >= 16);
  cs_picture_unref(picture);
}

/* One texel of a file against a value known independently. */
static void check_texel(const char *name, const char *layer, int width, int height, int x, int y,
                        double r, double g, double b, double a, double tolerance) {
  const char *path = material_path(name);
  if (!path)
    return;
  celspan_picture_desc desc = {.struct_size = sizeof desc, .file = path, .layer = layer};
  cs_picture *picture;
  celspan_picture_info info = CELSPAN_PICTURE_INFO;
  float rgba[4] = {0};
  CHECK(cs_picture_create(context, &desc, &picture) == CELSPAN_OK);
  bool is_right =
      CHECK(cs_store_info(context, picture, &info) == CELSPAN_OK) &&
      CHECK(info.width == width && info.height == height) &&
      CHECK(picture_texel(context, picture, 0, x, y, rgba) == CELSPAN_OK) &
          CHECK_NEAR((double)rgba[0], r, tolerance) & CHECK_NEAR((double)rgba[1], g, tolerance) &
          CHECK_NEAR((double)rgba[2], b, tolerance) & CHECK_NEAR((double)rgba[3], a, tolerance);
  if (!is_right)
    fprintf(stderr, "  %s %d %d: %d x %d, %s\n", name, x, y, (int)info.width, (int)info.height,
            celspan_context_error(context));
  cs_picture_unref(picture);
}

static void test_windows(void) {
  /* The overscan lies outside the display window and is cropped. */
  check_texel("exr/grid-overscan.exr", NULL, 1000, 1000, 0, 0, 0.50049, 0.50049, 0.50049, 1, 1);
  check_texel("exr/DisplayWindow/t01.exr", NULL, 400, 300, 0, 0, 0.5, 0.5, 0.5, 1, 1);
  /* The data window is larger, smaller or elsewhere: the display window counts. */
  static const char *const names[] = {"t03", "t04", "t05", "t06", "t10", "t13", "t16"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    char name[64];
    snprintf(name, sizeof name, "exr/DisplayWindow/%s.exr", names[i]);
    const char *path = material_path(name);
    CHECK(!path || read_file(path) == CELSPAN_OK);
  }
}

/* The suite's good files are read, those that are corrupt on purpose are refused. */
static void test_png_suite(void) {
  static const char *const good[] = {
      "basi0g02", "basi2c16", "basi3p01", "basi3p02", "basi3p08", "basi4a08", "basi6a16",
      "basn0g08", "basn0g16", "basn2c16", "basn4a08", "basn6a08", "bgan6a16", "bgyn6a16",
      "ch1n3p04", "cs3n3p08", "exif2c08", "f04n2c08", "g03n2c08", "g25n0g16", "oi9n0g16",
      "pp0n6a08", "ps2n0g08", "s02i3p01", "s40n3p04", "tbbn2c16", "tbgn3p08", "tbrn2c08",
      "tm3n3p02", "tp0n2c08", "tp1n3p08", "z09n2c08"};
  static const char *const bad[] = {"xcrn0g04", "xcsn0g01", "xd0n2c08", "xd3n2c08", "xd9n2c08",
                                    "xhdn0g08", "xlfn0g04", "xs2n0g01", "xs4n0g01"};
  for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
    char name[64];
    snprintf(name, sizeof name, "pngsuite/png/%s.png", good[i]);
    const char *path = material_path(name);
    if (path && !CHECK(read_file(path) == CELSPAN_OK))
      fprintf(stderr, "  %s\n", celspan_context_error(context));
  }
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    char name[64];
    snprintf(name, sizeof name, "pngsuite/png/%s.png", bad[i]);
    const char *path = material_path(name);
    if (path && !CHECK(read_file(path) != CELSPAN_OK))
      fprintf(stderr, "  %s was read\n", name);
  }
}

/* The merged picture; a layer by its name; a file whose reader loops endlessly past its end when it
 * is given the file itself. */
static void test_psd(void) {
  check_texel("psd/blend-modes/hard-mix.psd", NULL, 64, 64, 0, 0, 0.5, 0.5, 0.5, 0.5, 0.5);
  /* The layer is 85 x 46 at (8, 4) of the picture's 101 x 55: clear around it. */
  check_texel("psd/2layers.psd", "\xd0\xa1\xd0\xbb\xd0\xbe\xd0\xb9", 101, 55, 3, 3, 0, 0, 0, 0, 0);
  check_texel("psd/2layers.psd", NULL, 101, 55, 0, 0, 1, 1, 1, 1, 0);
  const char *path = material_path("psd/group.psd");
  if (path) {
    CHECK(read_file(path) == CELSPAN_OK);
    celspan_picture_desc desc = {
        .struct_size = sizeof desc, .file = path, .layer = "no such layer"};
    celspan_picture_info info = CELSPAN_PICTURE_INFO;
    CHECK(celspan_picture_inspect(context, &desc, &info) == CELSPAN_INPUT);
    CHECK(strstr(celspan_context_error(context), "no such layer"));
  }
}

static void test_material(void) {
  material = getenv("CELSPAN_MATERIAL");
  if (!material) {
    check_skip("pictures of other programs, which are in the folder that CELSPAN_MATERIAL names");
    return;
  }
  test_film_log();
  test_windows();
  test_png_suite();
  test_psd();
}

int main(void) {
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  test_arguments();
  test_hash();
  if (picture_module_or_skip(context)) {
    test_budget_and_threads();
    test_missing();
    test_changed();
  }
  if (!check_is_for_threads() && picture_module_is_there(context)) {
    test_round_trips();
    test_light_beyond_white();
    test_levels();
    test_truncated();
    test_jpeg_ends();
    test_corrupt();
    test_huge_headers();
    test_rows_of_layers();
    test_memory();
    test_parts();
    test_orientation();
    test_material();
  }
  celspan_context_destroy(context);
  return check_done();
}
