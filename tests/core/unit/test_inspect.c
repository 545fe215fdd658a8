/* Inspecting the pictures of a rostrum: which faults are reported, where, and what is cached of
 * them.
 */
#include <sys/stat.h>

#include "model/scene/inspect.h"
#include "tests/support/picture.h"
#include "tests/support/scene.h"

static studio s;
static char good[600], cut[600], missing[600];

static void paint(int x, int y, float rgba[4]) {
  rgba[0] = (float)x / 200;
  rgba[1] = (float)y / 100;
  rgba[2] = (float)((x * 7 + y * y) % 13) / 12;
  rgba[3] = 1;
}

static celspan_texture *slide_texture(const char *path) {
  celspan_picture_desc desc = {.struct_size = sizeof desc, .file = path};
  celspan_texture *texture = NULL;
  studio_check(&s, celspan_texture_create_picture(s.context, &desc, &texture));
  return texture;
}

static celspan_object *slide(const char *path) {
  celspan_texture *texture = slide_texture(path);
  celspan_object *rect = studio_rect(&s, 0, 0, 20, 20, texture);
  celspan_texture_unref(texture);
  return rect;
}

/* Cel 1: a good picture; of a difference, a missing one and a cut one. Cel 2: a plain shape, and
 * the missing one again. */
static celspan_rostrum *rostrum_of_faults(void) {
  celspan_object *plain = studio_circle(&s, 5, 5, 4, NULL);
  celspan_object *first[] = {
      slide(good), studio_pair(&s, CELSPAN_OPERATOR_DIFFERENCE, slide(missing), slide(cut))};
  celspan_object *second[] = {plain, slide(missing)};
  celspan_cel *cels[] = {studio_cel(&s, CELSPAN_CEL_DESC, first, 2),
                         studio_cel(&s, CELSPAN_CEL_DESC, second, 2)};
  return studio_rostrum(&s, CELSPAN_ROSTRUM_DESC, cels, 2);
}

typedef struct faults {
  char places[256];
  int count, most;
  int asked, patience; /* of progress */
} faults;

static bool tell(void *user, const celspan_fault *fault) {
  faults *to = user;
  size_t length = strlen(to->places);
  bool is_cut = strncmp(fault->message, cut, strlen(cut)) == 0;
  CHECK(fault->status == CELSPAN_INPUT);
  CHECK(is_cut || strncmp(fault->message, missing, strlen(missing)) == 0);
  snprintf(to->places + length, sizeof to->places - length, "%zu.%zu %s; ", fault->cel,
           fault->primitive, is_cut ? "cut" : "missing");
  return ++to->count < to->most;
}

static bool ask(void *user, int32_t rows_done, int32_t rows_total) {
  faults *to = user;
  CHECK(rows_done >= 0 && rows_done < rows_total);
  return ++to->asked < to->patience;
}

static celspan_status inspect(const celspan_rostrum *rostrum, bool is_deep, faults *to) {
  celspan_inspect_desc desc = CELSPAN_INSPECT_DESC;
  desc.is_deep = is_deep;
  desc.report = tell;
  desc.progress = ask;
  desc.user = to;
  return celspan_rostrum_inspect(s.context, rostrum, &desc);
}

static void test_all_are_reported(const celspan_rostrum *rostrum) {
  faults headers = {.most = 9, .patience = 99}, whole = headers;
  CHECK(inspect(rostrum, false, &headers) == CELSPAN_INPUT);
  CHECK_TEXT(headers.places, "1.2 missing; 2.2 missing; ");
  CHECK(headers.asked == 0);
  CHECK(strncmp(celspan_context_error(s.context), "cel 1, primitive 2: ", 20) == 0);
  CHECK(strstr(celspan_context_error(s.context), missing));
  CHECK(inspect(rostrum, true, &whole) == CELSPAN_INPUT);
  CHECK_TEXT(whole.places, "1.2 missing; 1.3 cut; 2.2 missing; ");
  CHECK(whole.asked > 0);
}

static void test_enough(const celspan_rostrum *rostrum) {
  faults one = {.most = 1, .patience = 99}, hasty = {.most = 9, .patience = 1};
  CHECK(inspect(rostrum, true, &one) == CELSPAN_INPUT);
  CHECK_TEXT(one.places, "1.2 missing; ");
  CHECK(inspect(rostrum, true, &hasty) == CELSPAN_CANCELLED && hasty.count == 0);
  celspan_inspect_desc quiet = CELSPAN_INSPECT_DESC;
  CHECK(celspan_rostrum_inspect(s.context, rostrum, &quiet) == CELSPAN_INPUT);
  quiet.struct_size = 3;
  CHECK(celspan_rostrum_inspect(s.context, rostrum, &quiet) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_rostrum_inspect(s.context, rostrum, NULL) == CELSPAN_BAD_ARGUMENT);
}

static void test_good(void) {
  celspan_object *object = slide(good);
  celspan_cel *cel = studio_cel(&s, CELSPAN_CEL_DESC, &object, 1);
  celspan_rostrum *rostrum = studio_rostrum(&s, CELSPAN_ROSTRUM_DESC, &cel, 1);
  faults to = {.most = 9, .patience = 99};
  CHECK(inspect(rostrum, true, &to) == CELSPAN_OK && to.count == 0 && to.asked > 0);
}

/* Pictures of lights, and those of a composition inside a cel, are found too. */
static void test_lights(void) {
  celspan_texture *gone = slide_texture(missing), *half = slide_texture(cut);
  celspan_object *inner = slide(missing), *nested = NULL;
  celspan_cel_desc lit = CELSPAN_CEL_DESC;
  lit.front_texture.texture = half;
  celspan_cel *inside = studio_cel(&s, lit, &inner, 1);
  celspan_rostrum_desc small = CELSPAN_ROSTRUM_DESC;
  small.has_size = true;
  small.width = small.height = 20;
  studio_check(
      &s, celspan_object_create_rostrum(s.context, studio_rostrum(&s, small, &inside, 1), &nested));
  celspan_object *objects[] = {studio_circle(&s, 5, 5, 4, NULL), nested};
  celspan_cel *cel = studio_cel(&s, CELSPAN_CEL_DESC, objects, 2);
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.back_texture.texture = gone;
  celspan_rostrum *rostrum = studio_rostrum(&s, desc, &cel, 1);
  faults to = {.most = 9, .patience = 99};
  CHECK(inspect(rostrum, true, &to) == CELSPAN_INPUT);
  CHECK_TEXT(to.places, "0.0 missing; 1.0 cut; 1.2 missing; ");
  CHECK(strncmp(celspan_context_error(s.context), "a light of the rostrum: ", 24) == 0);
  celspan_object_unref(nested);
  celspan_texture_unref(half);
  celspan_texture_unref(gone);
}

/* The lower half is missing. */
static celspan_status fill_half(void *user, celspan_context *context,
                                const celspan_rectangle *rectangle, void *destination,
                                size_t stride, int32_t *rows) {
  (void)user;
  CHECK(rectangle->height <= 64);
  if (rectangle->y + rectangle->height > 100)
    return celspan_context_fail(context, CELSPAN_CALLBACK, "no lower half");
  for (int32_t y = 0; y < rectangle->height; y++)
    memset((char *)destination + (size_t)y * stride, 0, (size_t)rectangle->width * 4);
  *rows = rectangle->height;
  return CELSPAN_OK;
}

/* The functions of pictures in memory are called if whole pictures are read. */
static void test_surface(void) {
  celspan_surface_desc memory = CELSPAN_SURFACE_DESC;
  memory.width = 300;
  memory.height = 200;
  memory.fill = fill_half;
  memory.has_key = true;
  celspan_surface *surface = NULL;
  studio_check(&s, celspan_surface_create(s.context, &memory, &surface));
  celspan_picture_desc desc = {.struct_size = sizeof desc, .surface = surface};
  celspan_texture *texture = NULL;
  studio_check(&s, celspan_texture_create_picture(s.context, &desc, &texture));
  celspan_object *rect = studio_rect(&s, 0, 0, 20, 20, texture);
  celspan_cel *cel = studio_cel(&s, CELSPAN_CEL_DESC, &rect, 1);
  celspan_rostrum *rostrum = studio_rostrum(&s, CELSPAN_ROSTRUM_DESC, &cel, 1);
  celspan_inspect_desc look = CELSPAN_INSPECT_DESC;
  CHECK(celspan_rostrum_inspect(s.context, rostrum, &look) == CELSPAN_OK);
  look.is_deep = true;
  CHECK(celspan_rostrum_inspect(s.context, rostrum, &look) == CELSPAN_CALLBACK);
  CHECK(strstr(celspan_context_error(s.context), "no lower half"));
  celspan_texture_unref(texture);
  celspan_surface_unref(surface);
}

/* However many pictures are inspected, memory use is bounded, and in the end nothing is kept. */
static void test_memory(void) {
  cs_inspection inspection = {.context = s.context};
  size_t before, most = 0, bytes, peak;
  uint64_t allocations;
  celspan_context_memory(s.context, &before, &peak, &allocations);
  for (int i = 0; i < 3 * CS_INSPECTION_MOST; i++) {
    char name[64];
    snprintf(name, sizeof name, "/nonexistent/%d.png", i);
    cs_picture *picture = NULL;
    studio_check(
        &s, cs_picture_create(
                s.context,
                &(celspan_picture_desc){.struct_size = sizeof(celspan_picture_desc), .file = name},
                &picture));
    CHECK(cs_inspection_examine(&inspection, picture) == CELSPAN_INPUT);
    CHECK(i % 1000 || (cs_inspection_examine(&inspection, picture) == CELSPAN_INPUT &&
                       strstr(celspan_context_error(s.context), name)));
    cs_picture_unref(picture);
    celspan_context_memory(s.context, &bytes, &peak, &allocations);
    most = bytes - before > most ? bytes - before : most;
  }
  CHECK(most < 256 * (size_t)CS_INSPECTION_MOST);
  cs_inspection_finish(&inspection);
  celspan_context_memory(s.context, &bytes, &peak, &allocations);
  CHECK(bytes == before);
}

int main(void) {
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  if (picture_module_or_skip(s.context)) {
    struct stat status;
    snprintf(good, sizeof good, "%s", picture_path("good.png"));
    snprintf(cut, sizeof cut, "%s", picture_path("cut.tif"));
    snprintf(missing, sizeof missing, "%s", picture_path("missing.png"));
    CHECK(picture_write(s.context, good, NULL, 200, 100, paint) == CELSPAN_OK);
    CHECK(picture_write(s.context, cut, NULL, 200, 100, paint) == CELSPAN_OK);
    CHECK(stat(cut, &status) == 0);
    celspan_rostrum *rostrum = rostrum_of_faults();
    test_good();
    if (CHECK(truncate(cut, status.st_size * 9 / 10) == 0))
      test_all_are_reported(rostrum);
    test_enough(rostrum);
    test_lights();
    test_surface();
    test_memory();
    unlink(good);
    unlink(cut);
  }
  studio_finish(&s);
  celspan_context_destroy(s.context);
  return check_done();
}
