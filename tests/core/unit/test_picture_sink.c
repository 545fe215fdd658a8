/* Frames in the picture module's formats: what each can represent, and files that appear complete
 * or not at all.
 */
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>

#include "tests/support/memory.h"
#include "tests/support/picture.h"

static celspan_context *context;

static void paint(int x, int y, float rgba[4]) {
  rgba[0] = (float)((x * 37 + y * 11) % 97) / 97;
  rgba[1] = (float)((x * 5 + y * 71) % 89) / 89;
  rgba[2] = (float)((x * x + y * 3) % 83) / 83;
  rgba[3] = 1;
}

static const char *const all[] = {"s.exr", "s.tif", "s.tga", "s.dpx",  "s.jpg", "s.bmp",
                                  "s.hdr", "s.ppm", "s.gif", "s.webp", "s.jp2", "s.avif"};
#define ALL (sizeof all / sizeof *all)

/* The status of beginning a frame of that size; no file may be left. */
static celspan_status begin(const char *name, int32_t width, int32_t height) {
  const char *path = picture_path(name);
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_sink sink;
  if (!CHECK(cs_sink_file(context, path, &file, &sink) == CELSPAN_OK))
    return CELSPAN_INTERNAL;
  celspan_status status = sink.begin(sink.user, context, width, height);
  if (status == CELSPAN_OK)
    CHECK(sink.end(sink.user, context, CELSPAN_CANCELLED) == CELSPAN_CANCELLED);
  else
    cs_sink_discard(context, &sink);
  CHECK(access(path, F_OK) != 0);
  return status;
}

static void test_limits(void) {
  CHECK(begin("l.jpg", 65501, 10) == CELSPAN_LIMIT);
  CHECK(strstr(celspan_context_error(context), "65501 x 10"));
  CHECK(strstr(celspan_context_error(context), "65500"));
  CHECK(begin("l.jpg", 65500, 10) == CELSPAN_OK);
  CHECK(begin("l.tga", 10, 65536) == CELSPAN_LIMIT);
  CHECK(begin("l.tga", 10, 65535) == CELSPAN_OK);
  CHECK(begin("l.gif", 65536, 1) == CELSPAN_LIMIT);
  CHECK(begin("l.webp", 16384, 1) == CELSPAN_LIMIT);
  CHECK(begin("l.avif", 65537, 1) == CELSPAN_LIMIT);
  CHECK(begin("l.avif", 65535, 1) == CELSPAN_OK);
  CHECK(begin("l.avif", 16384, 16385) == CELSPAN_LIMIT);
  CHECK(begin("l.dpx", 100000, 100000) == CELSPAN_LIMIT);
  CHECK(begin("l.bmp", 100000, 100000) == CELSPAN_LIMIT);
  CHECK(begin("l.exr", 1048576, 1048576) == CELSPAN_OK);
}

static celspan_status create(const char *path, const char *format, celspan_depth depth,
                             celspan_alpha alpha) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coded = CELSPAN_CODING;
  file.coding = &coded;
  celspan_sink sink;
  file.format = format;
  coded.depth = depth;
  coded.alpha = alpha;
  celspan_status status = cs_sink_picture(context, path, &file, &sink);
  if (status == CELSPAN_OK)
    cs_sink_discard(context, &sink);
  return status;
}

static void test_codings(void) {
  CHECK(create("a.xyz", NULL, 0, 0) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "\"xyz\""));
  CHECK(create("folder.exr/a", NULL, 0, 0) == CELSPAN_BAD_ARGUMENT);
  CHECK(create("a.xyz", "EXR", 0, 0) == CELSPAN_OK);
  CHECK(create("a.TIFF", NULL, 0, 0) == CELSPAN_OK);
  CHECK(create("a.exr", NULL, CELSPAN_DEPTH_8, 0) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "half, float"));
  CHECK(create("a.exr", NULL, 0, CELSPAN_ALPHA_STRAIGHT) == CELSPAN_BAD_ARGUMENT);
  CHECK(create("a.jpg", NULL, CELSPAN_DEPTH_16, 0) == CELSPAN_BAD_ARGUMENT);
  CHECK(create("a.avif", NULL, CELSPAN_DEPTH_FLOAT, 0) == CELSPAN_BAD_ARGUMENT);
  CHECK(create("a.avif", NULL, CELSPAN_DEPTH_16, CELSPAN_ALPHA_PREMULTIPLIED) == CELSPAN_OK);
  CHECK(create("a.tif", NULL, CELSPAN_DEPTH_FLOAT, CELSPAN_ALPHA_STRAIGHT) == CELSPAN_OK);
}

static size_t read_bytes(const char *path, unsigned char *bytes, size_t room) {
  FILE *file = fopen(path, "rb");
  size_t size = file ? fread(bytes, 1, room, file) : 0;
  if (file)
    fclose(file);
  return size;
}

/* Equal frames give equal files, whenever they are made. */
static void test_same_bytes(void) {
  static unsigned char first[1 << 20], second[1 << 20];
  for (size_t i = 0; i < ALL; i++) {
    const char *path = picture_path(all[i]);
    CHECK(picture_write(context, path, NULL, 90, 70, paint) == CELSPAN_OK);
    size_t size = read_bytes(path, first, sizeof first);
    struct timespec pause = {.tv_sec = i == 0, .tv_nsec = 100000000};
    nanosleep(&pause, NULL);
    CHECK(picture_write(context, path, NULL, 90, 70, paint) == CELSPAN_OK);
    size_t again = read_bytes(path, second, sizeof second);
    if (!CHECK(size > 0 && size == again && memcmp(first, second, size) == 0))
      fprintf(stderr, "  %s\n", all[i]);
    unlink(path);
  }
}

/* The disk is full after a few bytes: OUTPUT, and the existing file is unchanged. */
static void test_full_disk(void) {
  struct rlimit kept, small;
  getrlimit(RLIMIT_FSIZE, &kept);
  signal(SIGXFSZ, SIG_IGN);
  for (size_t i = 0; i < ALL; i++) {
    const char *path = picture_path(all[i]);
    struct stat before, after;
    CHECK(picture_write(context, path, NULL, 64, 64, paint) == CELSPAN_OK);
    CHECK(stat(path, &before) == 0);
    small = kept;
    small.rlim_cur = 2100;
    setrlimit(RLIMIT_FSIZE, &small);
    celspan_status status = picture_write(context, path, NULL, 400, 300, paint);
    setrlimit(RLIMIT_FSIZE, &kept);
    if (!CHECK(status == CELSPAN_OUTPUT) || !CHECK(strstr(celspan_context_error(context), path)))
      fprintf(stderr, "  %s: %s\n", all[i], celspan_context_error(context));
    CHECK(stat(path, &after) == 0 && after.st_size == before.st_size &&
          after.st_ino == before.st_ino);
    unlink(path);
  }
  signal(SIGXFSZ, SIG_DFL);
}

/* A file where a folder should be: begin fails, and everything is released once. */
static void test_no_folder(void) {
  char path[512], below[600];
  snprintf(path, sizeof path, "%s", picture_path("taken"));
  CHECK(fclose(fopen(path, "w")) == 0);
  for (int format = 0; format < 2; format++) {
    snprintf(below, sizeof below, "%s/%s", path, format ? "a.exr" : "a.tif");
    memory_watch watch = {0};
    celspan_context *own = memory_watch_context(&watch);
    CHECK(picture_write(own, below, NULL, 10, 10, paint) == CELSPAN_OUTPUT);
    CHECK(strstr(celspan_context_error(own), below));
    celspan_context_destroy(own);
    CHECK(watch.blocks == 0);
  }
  unlink(path);
}

static void test_ten_bits(void) {
  static unsigned char bytes[1 << 16];
  const char *path = picture_path("film.dpx");
  CHECK(picture_write(context, path, NULL, 32, 8, paint) == CELSPAN_OK);
  CHECK(read_bytes(path, bytes, sizeof bytes) == 8192 + 32 * 8 * 4);
  CHECK(bytes[803] == 10); /* bits of an element */
  CHECK(bytes[801] == 3);  /* transfer: logarithmic */
  unlink(path);
}

/* Every allocation fails once. */
static void test_memory(void) {
  const char *path = picture_path("memory.exr");
  for (size_t n = 1;; n++) {
    memory_watch watch = {0};
    celspan_context *own = memory_watch_context(&watch);
    watch.fail_at = watch.allocations + n;
    celspan_status status = picture_write(own, path, NULL, 10, 10, paint);
    bool is_done = watch.allocations < watch.fail_at;
    CHECK(status == (is_done ? CELSPAN_OK : CELSPAN_NO_MEMORY));
    celspan_context_destroy(own);
    CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
    unlink(path);
    if (is_done)
      break;
  }
}

int main(void) {
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  test_codings();
  if (picture_module_or_skip(context)) {
    test_limits();
    test_same_bytes();
    test_full_disk();
    test_ten_bits();
    test_no_folder();
    test_memory();
  }
  celspan_context_destroy(context);
  return check_done();
}
