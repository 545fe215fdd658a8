/* Shifts from C: what is refused, and the sums of a line, which every instruction set makes
 * alike. spec/displace compares frames with a second implementation. */
#include <math.h>
#include <string.h>

#include "engine/defocus/shifted.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

#define NODES 37

static celspan_context *context;
static test_random random_state = {1};

/* ---------------------------------------------------------------- sums */

static void add(cs_isa isa, const float *upper, const float *lower, const float shares[2],
                int32_t count, float *sums) {
  CS_WIDE_CHOOSE(isa, cs_shifted_add)(upper, lower, shares, count, sums);
}

static void test_sums(void) {
  float rows[2][4 * (NODES + 1)], sums[3][4 * NODES];
  const float shares[2] = {0.3125f, 0.7f};
  for (int i = 0; i < 4 * (NODES + 1); i++)
    for (int k = 0; k < 2; k++)
      rows[k][i] = (float)random_between(&random_state, 0, 2);
  for (int count = 1; count <= NODES; count++) {
    for (cs_isa isa = CS_ISA_ANY; isa <= cs_isa_best(); isa++) {
      for (int i = 0; i < 4 * NODES; i++)
        sums[isa][i] = (float)i;
      add(isa, rows[0], rows[1], shares, count, sums[isa]);
      CHECK(memcmp(sums[isa], sums[CS_ISA_ANY], sizeof *sums) == 0);
    }
    for (int i = 0; i < 4 * NODES; i++) {
      float a = rows[0][i] + shares[0] * (rows[0][i + 4] - rows[0][i]);
      float b = rows[1][i] + shares[0] * (rows[1][i + 4] - rows[1][i]);
      float want = i < 4 * count ? (float)i + (a + shares[1] * (b - a)) : (float)i;
      CHECK(sums[CS_ISA_ANY][i] == want);
    }
  }
}

/* ---------------------------------------------------------------- refused */

static celspan_object *square(void) {
  const celspan_rect_desc desc = {sizeof desc, 0, 0, 10, 10, 0, NULL};
  celspan_object *out;
  CHECK(celspan_object_create_rect(context, &desc, &out) == CELSPAN_OK);
  return out;
}

static celspan_status displaced(celspan_displace_desc desc, bool has_by) {
  celspan_object *art = square(), *out = NULL;
  desc.by = has_by ? art : NULL;
  celspan_status status = celspan_object_displace(context, art, &desc, &out);
  celspan_object_unref(out);
  celspan_object_unref(art);
  return status;
}

static celspan_status blurred(celspan_blur_desc desc) {
  celspan_object *art = square(), *out = NULL;
  celspan_status status = celspan_object_blur(context, art, &desc, &out);
  celspan_object_unref(out);
  celspan_object_unref(art);
  return status;
}

static void test_displacement_refused(void) {
  const celspan_displace_desc good = CELSPAN_DISPLACE_DESC;
  const double wrong[] = {NAN, INFINITY, 1.1e6, -1.1e6};
  celspan_displace_desc desc = good;
  CHECK(displaced(good, true) == CELSPAN_OK);
  CHECK(displaced(good, false) == CELSPAN_BAD_ARGUMENT);
  for (int i = 0; i < 4; i++) {
    desc.scale = wrong[i];
    CHECK(displaced(desc, true) == CELSPAN_BAD_ARGUMENT);
  }
  desc = good;
  desc.y = (celspan_channel)4;
  CHECK(displaced(desc, true) == CELSPAN_BAD_ARGUMENT);
  desc = good;
  desc.space = (celspan_space)3;
  CHECK(displaced(desc, true) == CELSPAN_BAD_ARGUMENT);
}

static void test_blur_refused(void) {
  const double most[] = {0, CELSPAN_BLUR_MOST, 90, 180};
  for (int along = CELSPAN_BLUR_LINE; along <= CELSPAN_BLUR_SPIN; along++) {
    celspan_blur_desc good = CELSPAN_BLUR_DESC, desc;
    good.along = (celspan_blur_along)along;
    good.radius = most[along];
    CHECK(blurred(good) == CELSPAN_OK);
    desc = good;
    desc.radius = nextafter(most[along], INFINITY);
    CHECK(blurred(desc) == CELSPAN_BAD_ARGUMENT);
    desc.radius = NAN;
    CHECK(blurred(desc) == CELSPAN_BAD_ARGUMENT);
    desc = good;
    desc.angle = INFINITY;
    CHECK(blurred(desc) == CELSPAN_BAD_ARGUMENT);
    desc = good;
    desc.centre.y = NAN;
    CHECK(blurred(desc) == CELSPAN_BAD_ARGUMENT);
    desc = good;
    desc.kernel = CELSPAN_DEFOCUS_DISC;
    CHECK(blurred(desc) == CELSPAN_BAD_ARGUMENT);
  }
  celspan_blur_desc unknown = CELSPAN_BLUR_DESC;
  unknown.along = (celspan_blur_along)4;
  CHECK(blurred(unknown) == CELSPAN_BAD_ARGUMENT);
}

int main(void) {
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  test_sums();
  test_displacement_refused();
  test_blur_refused();
  celspan_context_destroy(context);
  return check_done();
}
