/* Surfaces: pictures in memory equal the same pictures in files to the bit, and functions that fill
 * rectangles are called for the visible part, by the right threads, and may fail. One file, because
 * both kinds are compared with the same pictures. */
#include <pthread.h>

#include "model/pictures/surface.h"
#include "tests/support/memory.h"
#include "tests/support/picture.h"
#include "tests/support/probe.h"
#include "tests/support/scene.h"

#define WIDTH 261
#define HEIGHT 259

static celspan_surface_desc desc_of(celspan_surface_format format, const void *pixels) {
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  desc.width = WIDTH;
  desc.height = HEIGHT;
  desc.format = format;
  desc.pixels = pixels;
  return desc;
}

/* ---------------------------------------------------------------- content */

static float float_code(uint32_t code) {
  const float odd[] = {NAN, INFINITY, -INFINITY, 1e30f, -1e30f, 0, -0.0f, 1};
  return code % 97 == 0 ? odd[code / 97 % 8] : (float)(code % 4096) / 3000 - 0.1f;
}

/* All codes of 8 and of 16 bits, in every channel; floats that are not numbers too. */
static unsigned char *make_pixels(celspan_surface_format format) {
  size_t size = celspan_surface_pixel_size(format);
  size_t channels = format == CELSPAN_SURFACE_GREY8  ? 1
                    : format == CELSPAN_SURFACE_RGB8 ? 3
                                                     : 4,
         bytes = size / channels;
  unsigned char *pixels = malloc((size_t)WIDTH * HEIGHT * size);
  for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
    for (size_t c = 0; c < channels; c++) {
      uint32_t code = (uint32_t)(i * (c + 1) + 31 * c);
      float number = float_code(code);
      uint16_t wide = (uint16_t)(bytes == 1 ? code % 256 : code);
      if (c == 3 && i % 5 == 0) {
        wide = bytes == 1 ? 255 : 65535;
        number = 1;
      }
      unsigned char narrow = (unsigned char)wide;
      memcpy(pixels + i * size + c * bytes,
             bytes == 4   ? (const void *)&number
             : bytes == 2 ? (const void *)&wide
                          : (const void *)&narrow,
             bytes);
    }
  return pixels;
}

static void put(FILE *file, uint32_t value, size_t bytes) { fwrite(&value, 1, bytes, file); }

static void put_tag(FILE *file, uint32_t tag, uint32_t type, uint32_t count, uint32_t value) {
  put(file, tag, 2);
  put(file, type, 2);
  put(file, count, 4);
  put(file, value, 4);
}

/* An uncompressed TIFF of the pixels, in one strip: written here, read by an independent
 * library. */
static void write_tiff(const char *path, const celspan_surface_desc *desc) {
  size_t size = celspan_surface_pixel_size(desc->format);
  uint32_t channels = size == 1 ? 1 : size == 3 ? 3 : 4, bits = (uint32_t)(8 * size / channels);
  uint32_t sum = (uint32_t)(WIDTH * HEIGHT * size);
  bool is_float = desc->format == CELSPAN_SURFACE_RGBAF, has_alpha = channels == 4;
  bool is_multiplied = desc->alpha == CELSPAN_ALPHA_PREMULTIPLIED ||
                       (is_float && desc->alpha == CELSPAN_ALPHA_DEFAULT);
  FILE *file = fopen(path, "wb");
  fwrite("II*", 1, 4, file);
  put(file, 24, 4);
  for (uint32_t i = 0; i < 4; i++)
    put(file, bits, 2);
  for (uint32_t i = 0; i < 4; i++)
    put(file, is_float ? 3 : 1, 2);
  put(file, has_alpha ? 12 : 11, 2);
  put_tag(file, 256, 3, 1, WIDTH);
  put_tag(file, 257, 3, 1, HEIGHT);
  put_tag(file, 258, 3, channels, channels > 2 ? 8 : bits);
  put_tag(file, 259, 3, 1, 1);
  put_tag(file, 262, 3, 1, channels > 1 ? 2 : 1);
  put_tag(file, 273, 4, 1, 256);
  put_tag(file, 277, 3, 1, channels);
  put_tag(file, 278, 3, 1, HEIGHT);
  put_tag(file, 279, 4, 1, sum);
  put_tag(file, 284, 3, 1, 1);
  if (has_alpha)
    put_tag(file, 338, 3, 1, is_multiplied ? 1 : 2);
  put_tag(file, 339, 3, channels, channels > 2 ? 16 : 1);
  put(file, 0, 4);
  fseek(file, 256, SEEK_SET);
  fwrite(desc->pixels, 1, sum, file);
  fclose(file);
}

/* ---------------------------------------------------------------- as a file */

static cs_picture *make_picture(celspan_context *context, const celspan_surface_desc *desc,
                                const char *colour) {
  celspan_surface *surface = NULL;
  cs_picture *picture = NULL;
  CHECK(celspan_surface_create(context, desc, &surface) == CELSPAN_OK);
  celspan_picture_desc shown = {.struct_size = sizeof shown, .surface = surface, .colour = colour};
  if (!CHECK(cs_picture_create(context, &shown, &picture) == CELSPAN_OK))
    fprintf(stderr, "  %s\n", celspan_context_error(context));
  celspan_surface_unref(surface);
  return picture;
}

static bool is_same_block(const cs_picture_block *a, const cs_picture_block *b) {
  return memcmp(a->texels, b->texels, CS_PICTURE_TEXELS_BYTES) == 0 && !a->codes == !b->codes &&
         (!a->codes || memcmp(a->codes, b->codes, CS_PICTURE_CODES_BYTES) == 0) &&
         a->opacity == b->opacity && a->is_coded == b->is_coded;
}

/* The number of blocks that differ, on all levels. */
static int count_different(celspan_context *context, const cs_picture *a, const cs_picture *b) {
  int different = 0;
  for (int level = 0; level < cs_mip_levels_count(WIDTH, HEIGHT); level++)
    for (int32_t row = 0; row * 64 < cs_mip_levels_size(HEIGHT, level); row++)
      for (int32_t column = 0; column * 64 < cs_mip_levels_size(WIDTH, level); column++) {
        cs_picture_block *p = NULL, *q = NULL;
        if (!CHECK(cs_load_block(context, a, level, column, row, &p) == CELSPAN_OK) ||
            !CHECK(cs_load_block(context, b, level, column, row, &q) == CELSPAN_OK)) {
          fprintf(stderr, "  %s\n", celspan_context_error(context));
          return -1;
        }
        different += !is_same_block(p, q);
        cs_store_release(p);
        cs_store_release(q);
      }
  return different;
}

static void check_info(celspan_context *context, const cs_picture *a, const cs_picture *b) {
  celspan_picture_info p, q;
  CHECK(cs_store_info(context, a, &p) == CELSPAN_OK && cs_store_info(context, b, &q) == CELSPAN_OK);
  CHECK(p.width == q.width && p.height == q.height && p.channels == q.channels);
  CHECK(p.has_alpha == q.has_alpha && p.is_float == q.is_float);
  CHECK_TEXT(p.colour, q.colour);
  CHECK_TEXT(p.format, "memory");
}

static void check_file(celspan_context *context, celspan_surface_desc desc, const char *colour) {
  const char *path = picture_path("surface.tif");
  write_tiff(path, &desc);
  cs_picture *memory = make_picture(context, &desc, colour), *file = NULL;
  CHECK(cs_picture_create(context,
                          &(celspan_picture_desc){.struct_size = sizeof(celspan_picture_desc),
                                                  .file = path,
                                                  .colour = colour},
                          &file) == CELSPAN_OK);
  if (memory && file) {
    check_info(context, memory, file);
    if (!CHECK(count_different(context, memory, file) == 0))
      fprintf(stderr, "  format %d, alpha %d, %s\n", desc.format, desc.alpha, colour);
  }
  cs_picture_unref(memory);
  cs_picture_unref(file);
  unlink(path);
}

/* budget: bytes of pictures; a small one makes other levels from the file than a large one. */
static void test_files(size_t budget) {
  static const char *const colours[] = {NULL, "srgb", "linear", "rec709", "cineon"};
  for (int format = 0; format <= CELSPAN_SURFACE_RGBAF; format++) {
    unsigned char *pixels = make_pixels((celspan_surface_format)format);
    for (int alpha = 0; alpha <= CELSPAN_ALPHA_PREMULTIPLIED; alpha++)
      for (int colour = 0; colour < (budget ? 1 : 5); colour++) {
        celspan_context *context = NULL;
        celspan_context_desc own = CELSPAN_CONTEXT_DESC;
        own.picture_bytes = budget;
        CHECK(celspan_context_create(&own, &context) == CELSPAN_OK);
        celspan_surface_desc desc = desc_of((celspan_surface_format)format, pixels);
        desc.alpha = (celspan_alpha)alpha;
        check_file(context, desc, colours[colour]);
        celspan_context_destroy(context);
      }
    free(pixels);
  }
}

/* ---------------------------------------------------------------- a host that fills */

typedef struct host {
  celspan_surface_desc buffer; /* the pixels it returns, without gaps */
  pthread_t thread;            /* that made it */
  pthread_mutex_t lock;
  int calls, foreign_calls, releases, bad_rectangles;
  int64_t pixels;
  int32_t bottom; /* the last row requested, plus one */
  /* Faults. */
  int32_t fail_row, missing; /* missing: the number of missing rows */
  bool has_sentence;
} host;

static void note(host *h, const celspan_rectangle *r) {
  pthread_mutex_lock(&h->lock);
  h->calls++;
  h->foreign_calls += !pthread_equal(pthread_self(), h->thread);
  h->pixels += (int64_t)r->width * r->height;
  h->bottom = r->y + r->height > h->bottom ? r->y + r->height : h->bottom;
  h->bad_rectangles += r->x < 0 || r->y < 0 || r->width < 1 || r->height < 1 ||
                       r->x + r->width > h->buffer.width || r->y + r->height > h->buffer.height;
  pthread_mutex_unlock(&h->lock);
}

static celspan_status fill(void *user, celspan_context *context, const celspan_rectangle *r,
                           void *destination, size_t stride, int32_t *rows) {
  host *h = user;
  size_t size = celspan_surface_pixel_size(h->buffer.format);
  note(h, r);
  if (h->fail_row >= r->y && h->fail_row < r->y + r->height)
    return h->has_sentence ? celspan_context_fail(context, CELSPAN_INPUT, "the camera is unplugged")
                           : CELSPAN_CALLBACK;
  for (int32_t y = 0; y < r->height; y++)
    memcpy((unsigned char *)destination + (size_t)y * stride,
           (const unsigned char *)h->buffer.pixels +
               ((size_t)(r->y + y) * (size_t)h->buffer.width + (size_t)r->x) * size,
           (size_t)r->width * size);
  *rows = r->height - h->missing;
  return CELSPAN_OK;
}

static void release(void *user) { ((host *)user)->releases++; }

static host *host_init(host *h, celspan_surface_format format, const void *pixels) {
  *h = (host){.buffer = desc_of(format, pixels), .thread = pthread_self(), .fail_row = -1};
  pthread_mutex_init(&h->lock, NULL);
  return h;
}

static celspan_surface_desc filled_by(host *h, uint64_t key) {
  celspan_surface_desc desc = h->buffer;
  desc.pixels = NULL;
  desc.fill = fill;
  desc.user = h;
  desc.release = release;
  desc.has_key = true;
  desc.key[0] = key;
  return desc;
}

/* ---------------------------------------------------------------- frames of surfaces */

/* One surface, turned and shrunk, as the only thing of the frame. The reference is the
 * texture's. */
static celspan_object *show(studio *s, const celspan_surface_desc *desc, double degrees,
                            double scale) {
  celspan_surface *surface = NULL;
  studio_check(s, celspan_surface_create(s->context, desc, &surface));
  const celspan_picture_desc picture = {.struct_size = sizeof picture, .surface = surface};
  celspan_image_desc image = {.struct_size = sizeof image, .picture = &picture};
  celspan_object *object = NULL;
  studio_check(s, celspan_object_create_image(s->context, &image, &object));
  celspan_surface_unref(surface);
  if (!object)
    return NULL;
  s->objects[s->object_count++] = object;
  celspan_matrix turn =
      celspan_matrix_rotation(degrees * 0.017453292519943295, (celspan_point){WIDTH / 2.0, 100});
  return studio_transform(s, object,
                          celspan_matrix_then(turn, celspan_matrix_scaling(scale, scale)));
}

static celspan_frame_desc frame_of(const celspan_exposure *exposure, int workers) {
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  frame.exposures = exposure;
  frame.exposure_count = 1;
  frame.width = 200;
  frame.height = 160;
  frame.workers = workers;
  return frame;
}

static celspan_status digest_of(studio *s, celspan_object *object, int workers, uint64_t out[2]) {
  celspan_exposure exposure = {studio_show(s, object), 1};
  celspan_frame_desc frame = frame_of(&exposure, workers);
  return celspan_frame_digest(s->context, &frame, NULL, out);
}

/* The same pixels as a buffer with gaps and as a function, on several workers, with much memory and
 * with little. */
static void test_ways(celspan_surface_format format, size_t budget) {
  unsigned char *pixels = make_pixels(format);
  size_t row = WIDTH * celspan_surface_pixel_size(format);
  unsigned char *apart = calloc(HEIGHT, row + 13);
  for (size_t y = 0; y < HEIGHT; y++)
    memcpy(apart + y * (row + 13), pixels + y * row, row);
  for (int i = 0; i < 6; i++) {
    host h;
    celspan_context_desc own = CELSPAN_CONTEXT_DESC;
    own.picture_bytes = budget;
    studio s = {0};
    CHECK(celspan_context_create(&own, &s.context) == CELSPAN_OK);
    celspan_surface_desc buffer = desc_of(format, apart);
    buffer.stride = row + 13;
    celspan_surface_desc filled = filled_by(host_init(&h, format, pixels), 7);
    filled.any_thread = i % 2;
    double degrees = i < 2 ? 0 : 25, scale = i < 4 ? 1 : 0.45;
    uint64_t expected[2] = {1, 0}, got[2] = {2, 0};
    studio_check(&s, digest_of(&s, show(&s, &buffer, degrees, scale), 1, expected));
    studio_check(&s, digest_of(&s, show(&s, &filled, degrees, scale), 3, got));
    CHECK(expected[0] == got[0] && expected[1] == got[1]);
    CHECK(h.calls > 0 && h.bad_rectangles == 0);
    CHECK(filled.any_thread || h.foreign_calls == 0);
    studio_finish(&s);
    CHECK(h.releases == 1);
    celspan_context_destroy(s.context);
  }
  free(apart);
  free(pixels);
}

/* Rows below the frame are not requested, hidden pictures not at all, and nothing twice. */
static void test_demand(void) {
  unsigned char *pixels = make_pixels(CELSPAN_SURFACE_RGB8);
  host seen, hidden;
  studio s = {0};
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  celspan_surface_desc desc = filled_by(host_init(&seen, CELSPAN_SURFACE_RGB8, pixels), 1);
  celspan_surface_desc below = filled_by(host_init(&hidden, CELSPAN_SURFACE_RGB8, pixels), 2);
  celspan_object *objects[] = {show(&s, &below, 0, 1), show(&s, &desc, 0, 1)};
  celspan_cel *cel = studio_cel(&s, CELSPAN_CEL_DESC, objects, 2);
  celspan_exposure exposure = {studio_rostrum(&s, CELSPAN_ROSTRUM_DESC, &cel, 1), 1};
  celspan_frame_desc frame = frame_of(&exposure, 2);
  frame.height = 60;
  uint64_t digest[2];
  CHECK(celspan_rostrum_check(s.context, exposure.rostrum) == CELSPAN_OK);
  CHECK(seen.calls == 0);
  studio_check(&s, celspan_frame_digest(s.context, &frame, NULL, digest));
  CHECK(hidden.calls == 0 && seen.bottom == 64);
  CHECK(seen.pixels == 64 * WIDTH);
  studio_check(&s, celspan_frame_digest(s.context, &frame, NULL, digest));
  CHECK(seen.pixels == 64 * WIDTH);
  celspan_rostrum_counts counts;
  celspan_rostrum_count(exposure.rostrum, &counts);
  CHECK(counts.pictures == 2);
  studio_finish(&s);
  celspan_context_destroy(s.context);
  free(pixels);
}

static celspan_texture *shown_by(studio *s, host *h, uint64_t key) {
  celspan_surface_desc desc = filled_by(h, key);
  celspan_surface *surface = NULL;
  celspan_texture *texture = NULL;
  celspan_picture_desc shown = {
      .struct_size = sizeof shown, .has_box = true, .box = {0, 0, 200, 160}};
  studio_check(s, celspan_surface_create(s->context, &desc, &surface));
  shown.surface = surface;
  studio_check(s, celspan_texture_create_picture(s->context, &shown, &texture));
  celspan_surface_unref(surface);
  if (texture)
    s->textures[s->texture_count++] = texture;
  return texture;
}

/* As the light of a cel, inside another composition, and out of focus: wherever a surface is used,
 * its function is called by the rendering thread alone. */
static void test_places(void) {
  unsigned char *pixels = make_pixels(CELSPAN_SURFACE_RGBA8);
  for (int place = 0; place < 3; place++) {
    host h;
    studio s = {0};
    uint64_t digest[2];
    CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
    celspan_texture *live = shown_by(&s, host_init(&h, CELSPAN_SURFACE_RGBA8, pixels), 3);
    celspan_object *art = studio_rect(&s, 0, 0, 200, 160, place == 0 ? NULL : live);
    celspan_cel_desc desc = CELSPAN_CEL_DESC;
    desc.back_texture.texture = place == 0 ? live : NULL;
    desc.defocus_radius = place == 2 ? 3 : 0;
    if (place == 0)
      art = studio_fade(&s, art, 0.5);
    celspan_cel *cel = studio_cel(&s, desc, &art, 1);
    celspan_rostrum_desc inner = CELSPAN_ROSTRUM_DESC;
    inner.has_size = place == 1;
    inner.width = 200;
    inner.height = 160;
    celspan_exposure exposure = {studio_rostrum(&s, inner, &cel, 1), 1};
    celspan_object *composition = NULL;
    if (place == 1) {
      studio_check(&s, celspan_object_create_rostrum(s.context, exposure.rostrum, &composition));
      s.objects[s.object_count++] = composition;
      exposure.rostrum = studio_show(&s, composition);
    }
    celspan_frame_desc frame = frame_of(&exposure, 3);
    studio_check(&s, celspan_frame_digest(s.context, &frame, NULL, digest));
    CHECK(h.calls > 0 && h.foreign_calls == 0);
    studio_finish(&s);
    CHECK(h.releases == 1);
    celspan_context_destroy(s.context);
  }
  free(pixels);
}

static celspan_status fill_map(void *user, celspan_context *context, const celspan_rectangle *r,
                               void *destination, size_t stride, int32_t *rows) {
  (void)context;
  *(int64_t *)user += (int64_t)r->width * r->height;
  for (int32_t y = 0; y < r->height; y++)
    for (int32_t x = 0; x < r->width; x++)
      ((unsigned char *)destination)[(size_t)y * stride + (size_t)x] =
          (unsigned char)((r->x + x) * 7 ^ (r->y + y) * 13);
  *rows = r->height;
  return CELSPAN_OK;
}

/* A map of a million by a million pixels, of which 200 x 100 are seen. */
static void test_map(void) {
  int64_t asked = 0;
  studio s = {0};
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  desc.width = desc.height = 1048576;
  desc.format = CELSPAN_SURFACE_GREY8;
  desc.fill = fill_map;
  desc.user = &asked;
  desc.has_key = true;
  celspan_matrix away = celspan_matrix_translation(-777000, -500000);
  celspan_object *object = studio_transform(&s, show(&s, &desc, 0, 1), away);
  celspan_exposure exposure = {studio_show(&s, object), 1};
  celspan_frame_desc frame = frame_of(&exposure, 1);
  unsigned char pixels[160][200][4];
  const celspan_coding coding = {.struct_size = sizeof coding,
                                 .depth = CELSPAN_DEPTH_8,
                                 .transfer = CELSPAN_TRANSFER_SRGB,
                                 .alpha = CELSPAN_ALPHA_STRAIGHT};
  studio_check(&s,
               celspan_frame_pixels(s.context, &frame, &coding, pixels, sizeof pixels[0], NULL));
  int wrong = 0;
  for (int y = 0; y < 160; y++)
    for (int x = 0; x < 200; x++)
      wrong += pixels[y][x][1] != (unsigned char)((777000 + x) * 7 ^ (500000 + y) * 13);
  CHECK(wrong == 0);
  CHECK(asked <= 2 * 1024 * 4 * 64);
  studio_finish(&s);
  celspan_context_destroy(s.context);
}

/* ---------------------------------------------------------------- failures */

static void check_failure(studio *s, celspan_object *object, const char *sentence) {
  uint64_t digest[2];
  for (int workers = 1; workers < 4; workers++) {
    CHECK(digest_of(s, object, workers, digest) == CELSPAN_CALLBACK);
    CHECK_TEXT(celspan_context_error(s->context), sentence);
  }
}

static void test_failures(void) {
  unsigned char *pixels = make_pixels(CELSPAN_SURFACE_RGBA8);
  host h;
  studio s = {0};
  double rgba[4];
  uint64_t digest[2];
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  celspan_surface_desc desc = filled_by(host_init(&h, CELSPAN_SURFACE_RGBA8, pixels), 1);
  celspan_object *object = show(&s, &desc, 0, 1);
  h.fail_row = 70;
  check_failure(&s, object, "surface: fill failed for the rectangle of 261 x 64 pixels at 0, 64");
  h.has_sentence = true;
  check_failure(&s, object,
                "surface: fill failed for the rectangle of 261 x 64 pixels at 0, 64: "
                "the camera is unplugged");
  celspan_exposure exposure = {studio_show(&s, object), 1};
  CHECK(probe_film(s.context, &exposure, 1, 200, 160, (celspan_point){9.5, 80.5}, rgba) ==
        CELSPAN_CALLBACK);
  h.fail_row = -1;
  h.missing = 3;
  check_failure(&s, object,
                "surface: fill gave 61 of 64 rows for the rectangle of 261 x 64 pixels "
                "at 0, 64");
  h.missing = 0;
  studio_check(&s, digest_of(&s, object, 1, digest));
  studio_finish(&s);
  celspan_context_destroy(s.context);
  free(pixels);
}

/* Coded rows of an opaque picture are copied. If the picture cannot be read nothing is written
 * beyond them: these rows fill a whole piece of the row's memory, behind which the heap checks for
 * writes. */
static void test_wide_failure(void) {
  enum { WIDE = 16384, HIGH = 4 };
  const celspan_coding coding = {.struct_size = sizeof coding,
                                 .depth = CELSPAN_DEPTH_8,
                                 .transfer = CELSPAN_TRANSFER_SRGB,
                                 .alpha = CELSPAN_ALPHA_STRAIGHT};
  unsigned char *pixels = malloc((size_t)WIDE * HIGH * 4);
  host h;
  studio s = {0};
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  celspan_surface_desc desc = filled_by(host_init(&h, CELSPAN_SURFACE_RGB8, pixels), 1);
  desc.width = WIDE;
  desc.height = HIGH;
  h.fail_row = 0;
  celspan_exposure exposure = {studio_show(&s, show(&s, &desc, 0, 1)), 1};
  celspan_frame_desc frame = frame_of(&exposure, 1);
  frame.width = WIDE;
  frame.height = HIGH;
  CHECK(celspan_frame_pixels(s.context, &frame, &coding, pixels, (size_t)WIDE * 4, NULL) ==
        CELSPAN_CALLBACK);
  studio_finish(&s);
  celspan_context_destroy(s.context);
  free(pixels);
}

static void test_refusals(void) {
  static const unsigned char pixel[16];
  host h;
  celspan_context *context = NULL;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  const celspan_surface_desc good = {
      .struct_size = sizeof good, .width = 1, .height = 1, .pixels = pixel};
  const celspan_surface_desc filled = filled_by(host_init(&h, CELSPAN_SURFACE_RGBA8, pixel), 1);
  celspan_surface_desc bad[10];
  for (int i = 0; i < 10; i++)
    bad[i] = i < 7 ? good : filled;
  bad[0].struct_size = 8;
  bad[1].width = 0;
  bad[2].height = 1048577;
  bad[3].format = (celspan_surface_format)5;
  bad[4].alpha = (celspan_alpha)3;
  bad[5].stride = 3;
  bad[6].pixels = NULL;
  bad[7].pixels = pixel;
  bad[8].has_key = false;
  bad[9].width = -1;
  const char *const sentences[10] = {
      "surface: struct_size is 8, so that fields are missing that it needs",
      "surface: its size is 0 x 1; it must be 1 to 1048576 pixels a side",
      "surface: its size is 1 x 1048577",
      "surface: format is 5; it must be 0 to 4",
      "surface: alpha is 3; it must be 0 to 2",
      "surface: stride is 3; it must be 0, or 4 or more for 1 pixels",
      "surface: give pixels or a fill function",
      "surface: give pixels or a fill function, not both",
      "surface: a fill function needs a key",
      "surface: its size is -1 x 259",
  };
  for (int i = 0; i < 10; i++) {
    celspan_surface *surface = NULL;
    CHECK(celspan_surface_create(context, &bad[i], &surface) == CELSPAN_BAD_ARGUMENT && !surface);
    if (!CHECK(strncmp(celspan_context_error(context), sentences[i], strlen(sentences[i])) == 0))
      fprintf(stderr, "  %s\n", celspan_context_error(context));
  }
  CHECK(celspan_surface_create(context, NULL, NULL) == CELSPAN_BAD_ARGUMENT);
  CHECK(h.releases == 0);
  celspan_context_destroy(context);
}

static void test_pictures_refused(void) {
  static const unsigned char pixel[4];
  celspan_context *context = NULL;
  celspan_surface *surface = NULL;
  celspan_picture_info info = CELSPAN_PICTURE_INFO;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  celspan_surface_desc desc = {
      .struct_size = sizeof desc, .width = 1, .height = 1, .pixels = pixel};
  CHECK(celspan_surface_create(context, &desc, &surface) == CELSPAN_OK);
  const celspan_picture_desc good = {.struct_size = sizeof good, .surface = surface};
  celspan_picture_desc bad[4] = {good, good, good, good};
  bad[0].file = "a.png";
  bad[1].layer = "ink";
  bad[2].subimage = 1;
  bad[3].colour = "ACEScg";
  for (int i = 0; i < 4; i++)
    CHECK(celspan_picture_inspect(context, &bad[i], &info) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_picture_inspect(context, &good, &info) == CELSPAN_OK && info.width == 1);
  CHECK(celspan_surface_pixel_size((celspan_surface_format)7) == 0);
  celspan_surface_unref(surface);
  celspan_surface_unref(NULL);
  celspan_context_destroy(context);
}

/* ---------------------------------------------------------------- names and copies */

static cs_hash hash_of(celspan_context *context, const celspan_surface_desc *desc) {
  cs_picture *picture = make_picture(context, desc, NULL);
  cs_hash hash = cs_picture_hash(picture);
  cs_picture_unref(picture);
  return hash;
}

static bool is_equal(cs_hash a, cs_hash b) { return a.a == b.a && a.b == b.b; }

static void test_hashes(void) {
  unsigned char *pixels = make_pixels(CELSPAN_SURFACE_RGBA8),
                *again = make_pixels(CELSPAN_SURFACE_RGBA8);
  celspan_context *context = NULL;
  host h, other;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  celspan_surface_desc a = desc_of(CELSPAN_SURFACE_RGBA8, pixels), b = a;
  b.pixels = again;
  CHECK(is_equal(hash_of(context, &a), hash_of(context, &b)));
  b.alpha = CELSPAN_ALPHA_STRAIGHT; /* what it is by default */
  CHECK(is_equal(hash_of(context, &a), hash_of(context, &b)));
  b.alpha = CELSPAN_ALPHA_PREMULTIPLIED;
  CHECK(!is_equal(hash_of(context, &a), hash_of(context, &b)));
  b = a;
  b.pixels = again;
  again[WIDTH * HEIGHT * 4 - 1] ^= 1;
  CHECK(!is_equal(hash_of(context, &a), hash_of(context, &b)));
  b = a;
  b.height--;
  CHECK(!is_equal(hash_of(context, &a), hash_of(context, &b)));
  a = filled_by(host_init(&h, CELSPAN_SURFACE_RGBA8, pixels), 1);
  b = filled_by(host_init(&other, CELSPAN_SURFACE_RGBA8, again), 1);
  CHECK(is_equal(hash_of(context, &a), hash_of(context, &b)));
  b.key[1] = 1;
  CHECK(!is_equal(hash_of(context, &a), hash_of(context, &b)));
  b.key[1] = 0;
  b.format = CELSPAN_SURFACE_RGBAF;
  CHECK(!is_equal(hash_of(context, &a), hash_of(context, &b)));
  CHECK(h.calls == 0 && h.releases == 3 && other.releases == 3);
  celspan_context_destroy(context);
  free(pixels);
  free(again);
}

/* A buffer is copied once, or not at all. */
static void test_copies(void) {
  unsigned char *pixels = make_pixels(CELSPAN_SURFACE_RGBA8);
  host h;
  memory_watch watch = {0};
  celspan_context *context = memory_watch_context(&watch);
  celspan_surface_desc desc = desc_of(CELSPAN_SURFACE_RGBA8, pixels);
  celspan_surface *surface = NULL;
  float rgba[4];
  size_t before = watch.bytes;
  CHECK(celspan_surface_create(context, &desc, &surface) == CELSPAN_OK);
  CHECK(watch.bytes - before >= WIDTH * HEIGHT * 4 &&
        watch.bytes - before < WIDTH * HEIGHT * 4 + 500);
  pixels[0] = 200;
  CHECK(cs_surface_read(context, surface, &(celspan_rectangle){0, 0, 1, 1}, rgba) == CELSPAN_OK);
  CHECK(rgba[0] == 0);
  celspan_surface_unref(surface);
  host_init(&h, CELSPAN_SURFACE_RGBA8, pixels);
  desc.user = &h;
  desc.release = release;
  CHECK(celspan_surface_create(context, &desc, &surface) == CELSPAN_OK);
  CHECK(watch.bytes - before < 500 && h.releases == 0);
  celspan_surface_unref(celspan_surface_ref(surface));
  CHECK(h.releases == 0);
  celspan_surface_unref(surface);
  CHECK(h.releases == 1);
  celspan_context_destroy(context);
  CHECK(watch.bytes == 0 && watch.size_errors == 0);
  free(pixels);
}

/* A live surface: another key each frame. Memory for those no longer used does not grow. */
static void test_live(void) {
  unsigned char *pixels = make_pixels(CELSPAN_SURFACE_RGBA8);
  memory_watch watch = {0};
  celspan_context_desc own = CELSPAN_CONTEXT_DESC;
  own.resize = memory_watch_resize;
  own.resize_user = &watch;
  own.picture_bytes = 4 << 20;
  celspan_context *context = NULL;
  CHECK(celspan_context_create(&own, &context) == CELSPAN_OK);
  size_t blocks = 0;
  for (uint64_t i = 0; i < 3000; i++) {
    host h;
    celspan_surface_desc desc = filled_by(host_init(&h, CELSPAN_SURFACE_RGBA8, pixels), i);
    cs_picture *picture = make_picture(context, &desc, NULL);
    cs_picture_block *block;
    CHECK(cs_load_block(context, picture, 0, 1, 0, &block) == CELSPAN_OK);
    cs_store_release(block);
    cs_picture_unref(picture);
    CHECK(h.releases == 1);
    if (i == 1000)
      blocks = watch.blocks;
  }
  CHECK(watch.blocks < blocks + 300);
  celspan_context_destroy(context);
  CHECK(watch.blocks == 0 && watch.size_errors == 0);
  free(pixels);
}

/* ---------------------------------------------------------------- threads and memory */

/* Every thread makes surfaces of its own and uses shared ones; entries come and go. */
static void *use_surfaces(void *user) {
  celspan_context *context = user, branch;
  unsigned char *pixels = make_pixels(CELSPAN_SURFACE_GREY8);
  uintptr_t failures = 0;
  cs_context_branch(&branch, context);
  const int rounds = check_is_for_threads() ? 150 : 600;
  for (int i = 0; i < rounds; i++) {
    celspan_surface_desc desc = desc_of(CELSPAN_SURFACE_GREY8, pixels);
    desc.has_key = true;
    desc.key[0] = i % 3 == 0 ? 1 : (uint64_t)(uintptr_t)&branch + (uint64_t)i;
    celspan_surface *surface = NULL;
    cs_picture *picture = NULL;
    cs_picture_block *block = NULL;
    bool good =
        celspan_surface_create(&branch, &desc, &surface) == CELSPAN_OK &&
        cs_picture_create(&branch,
                          &(celspan_picture_desc){.struct_size = sizeof(celspan_picture_desc),
                                                  .surface = surface},
                          &picture) == CELSPAN_OK &&
        cs_load_block(&branch, picture, i % 2, 1, 0, &block) == CELSPAN_OK;
    failures += !good;
    if (block)
      cs_store_release(block);
    cs_picture_unref(picture);
    celspan_surface_unref(surface);
  }
  free(pixels);
  return (void *)failures;
}

static void test_threads(void) {
  celspan_context_desc own = CELSPAN_CONTEXT_DESC;
  own.picture_bytes = 2 << 20;
  celspan_context *context = NULL;
  pthread_t threads[4];
  CHECK(celspan_context_create(&own, &context) == CELSPAN_OK);
  for (int i = 0; i < 4; i++)
    CHECK(pthread_create(&threads[i], NULL, use_surfaces, context) == 0);
  for (int i = 0; i < 4; i++) {
    void *failures = NULL;
    pthread_join(threads[i], &failures);
    CHECK(!failures);
  }
  celspan_context_destroy(context);
}

static celspan_status render(celspan_context *context, host *h, bool is_filled,
                             uint64_t digest[2]) {
  celspan_surface_desc desc = is_filled ? filled_by(h, 5) : h->buffer;
  celspan_surface *surface = NULL;
  celspan_object *object = NULL;
  celspan_cel *cel = NULL;
  celspan_rostrum *rostrum = NULL;
  celspan_status status = celspan_surface_create(context, &desc, &surface);
  const celspan_picture_desc picture = {.struct_size = sizeof picture, .surface = surface};
  celspan_image_desc image = {.struct_size = sizeof image, .picture = &picture, .width = 90};
  if (status == CELSPAN_OK)
    status = celspan_object_create_image(context, &image, &object);
  celspan_surface_unref(surface);
  celspan_cel_desc cel_desc = CELSPAN_CEL_DESC;
  cel_desc.objects = &object;
  cel_desc.object_count = 1;
  if (status == CELSPAN_OK)
    status = celspan_cel_create(context, &cel_desc, &cel);
  celspan_rostrum_desc rostrum_desc = CELSPAN_ROSTRUM_DESC;
  rostrum_desc.cels = &cel;
  rostrum_desc.cel_count = 1;
  if (status == CELSPAN_OK)
    status = celspan_rostrum_create(context, &rostrum_desc, &rostrum);
  celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc frame = frame_of(&exposure, 1);
  if (status == CELSPAN_OK)
    status = celspan_frame_digest(context, &frame, NULL, digest);
  celspan_rostrum_unref(rostrum);
  celspan_cel_unref(cel);
  celspan_object_unref(object);
  return status;
}

/* Whichever allocation fails, nothing leaks, and the release function is called for every surface
 * that was made. */
static void test_memory(bool is_filled) {
  unsigned char *pixels = make_pixels(CELSPAN_SURFACE_RGBA16);
  uint64_t expected[2] = {0}, digest[2];
  size_t failures = 0;
  for (celspan_status status = CELSPAN_NO_MEMORY; status != CELSPAN_OK; failures++) {
    if (!check_is_drawn((int)failures))
      continue;
    memory_watch watch = {0};
    celspan_context *context = memory_watch_context(&watch);
    host h;
    host_init(&h, CELSPAN_SURFACE_RGBA16, pixels);
    watch.fail_at = watch.allocations + failures + 1;
    size_t made = watch.allocations;
    status = render(context, &h, is_filled, digest);
    bool has_surface = watch.allocations > made + 1;
    watch.fail_at = 0;
    CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
    CHECK(!is_filled || h.releases == has_surface);
    CHECK(render(context, &h, is_filled, expected) == CELSPAN_OK);
    celspan_context_destroy(context);
    CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  }
  CHECK(failures > 20);
  CHECK(digest[0] == expected[0] && digest[1] == expected[1]);
  free(pixels);
}

/* ---------------------------------------------------------------- without a module */

static bool has_module(bool (*ask)(celspan_context *context)) {
  celspan_context *context = NULL;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  bool is_there = ask(context);
  celspan_context_destroy(context);
  return is_there;
}

int main(void) {
  if (check_is_for_threads()) {
    test_ways(CELSPAN_SURFACE_RGBA8, 300 << 10);
    test_threads();
    return check_done();
  }
  if (has_module(picture_module_or_skip)) {
    test_files(0);
    test_files(300 << 10);
  }
  /* From here on no picture module can be loaded. */
  setenv("CELSPAN_PICTURE_MODULE", "/nonexistent/module.so", 1);
  CHECK(!has_module(picture_module_is_there));
  for (int format = 0; format <= CELSPAN_SURFACE_RGBAF; format++) {
    if (check_is_drawn(format))
      test_ways((celspan_surface_format)format, 0);
    if (check_is_drawn(format + 1))
      test_ways((celspan_surface_format)format, 300 << 10);
  }
  test_demand();
  test_places();
  test_map();
  test_failures();
  test_wide_failure();
  test_refusals();
  test_pictures_refused();
  test_hashes();
  test_copies();
  test_threads();
  test_live();
  test_memory(false);
  test_memory(true);
  return check_done();
}
