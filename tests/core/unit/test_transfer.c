/* model/colour/transfer.c against the formulas in long double; and its bits, which must be the same
 * with every compiler.
 */
#include "model/colour/transfer.h"

#include <math.h>

#include "base/hash.h"
#include "tests/support/check.h"

static long double srgb(long double x) {
  return x <= 0.0031308L ? 12.92L * x : 1.055L * powl(x, 1 / 2.4L) - 0.055L;
}

static long double rec709(long double x) {
  return x < 0.018L ? 4.5L * x : 1.099L * powl(x, 0.45L) - 0.099L;
}

static long double cineon(long double x) {
  long double black = powl(10, -590 / 300.0L);
  return (685 + 300 * log10l(x * (1 - black) + black)) / 1023;
}

static int nearest_code(float x) { return (int)floorl(srgb(x) * 255 + 0.5L); }

static void check_srgb8(void) {
  int wrong = 0;
  for (int i = 0; i <= 1000000; i++) {
    float x = (float)i / 1000000;
    wrong += cs_transfer_srgb8(x) != nearest_code(x);
  }
  for (int i = 0; i < 400000; i++) {
    float x = ldexpf(1 + (float)(i % 10000) / 10000, -1 - i / 10000);
    wrong += cs_transfer_srgb8(x) != nearest_code(x);
  }
  CHECK(wrong == 0);
  for (int code = 1; code <= 255; code++) {
    float low = 0, high = 1;
    while (nextafterf(low, 2) < high) {
      float middle = low + (high - low) / 2;
      *(nearest_code(middle) >= code ? &high : &low) = middle;
    }
    for (int step = -2; step <= 2; step++) {
      float x = high;
      for (int i = 0; i < 2 * (step < 0 ? -step : step); i++)
        x = nextafterf(x, step < 0 ? 0.0f : 2.0f);
      CHECK(cs_transfer_srgb8(x) == (x > 1 ? 255 : nearest_code(x)));
    }
    CHECK(cs_transfer_srgb8(low) == code - 1 && cs_transfer_srgb8(high) == code);
  }
  CHECK(cs_transfer_srgb8(NAN) == 0 && cs_transfer_srgb8(-1) == 0 && cs_transfer_srgb8(7) == 255);
  CHECK(cs_transfer_srgb8(HUGE_VALF) == 255 && cs_transfer_srgb8(-HUGE_VALF) == 0);
}

static void check_curve(celspan_transfer transfer, long double (*truth)(long double)) {
  double worst = 0, worst_back = 0;
  for (int i = 0; i <= 200000; i++) {
    float x = i < 100000 ? (float)i / 100000 : (float)(i - 100000) / 1000;
    float coded = cs_transfer_encode(transfer, x);
    double error = (double)fabsl(coded - truth(x)) / (fabs((double)coded) + 1e-30);
    worst = error > worst ? error : worst;
    double back = fabs((double)cs_transfer_decode(transfer, coded) - (double)x) / (x + 0.01);
    bool at_knee = fabs((double)x - 0.018) < 1e-6; /* the branches of Rec.709 do not quite meet */
    worst_back = back > worst_back && !at_knee ? back : worst_back;
  }
  CHECK_NEAR(worst, 0, 0x1p-24);
  CHECK_NEAR(worst_back, 0, 2e-6);
}

static void check_continuation(void) {
  CHECK(cs_transfer_encode(CELSPAN_TRANSFER_SRGB, -0.5f) ==
        -cs_transfer_encode(CELSPAN_TRANSFER_SRGB, 0.5f));
  CHECK(cs_transfer_decode(CELSPAN_TRANSFER_REC709, -0.5f) ==
        -cs_transfer_decode(CELSPAN_TRANSFER_REC709, 0.5f));
  CHECK(cs_transfer_encode(CELSPAN_TRANSFER_LINEAR, -3.25f) == -3.25f);
  CHECK(cs_transfer_encode(CELSPAN_TRANSFER_CINEON, -9) == 0);
  CHECK_NEAR((double)cs_transfer_encode(CELSPAN_TRANSFER_CINEON, 0.18f), 0.45731961, 1e-6);
  CHECK_NEAR((double)cs_transfer_decode(CELSPAN_TRANSFER_CINEON, 685 / 1023.0f), 1, 1e-6);
  CHECK_NEAR((double)cs_transfer_decode(CELSPAN_TRANSFER_CINEON, 95 / 1023.0f), 0, 1e-7);
  CHECK(cs_transfer_encode(CELSPAN_TRANSFER_SRGB, 1) == 1.0f);
  CHECK(cs_transfer_decode(CELSPAN_TRANSFER_SRGB, 1) == 1.0f);
}

static void check_names(void) {
  static const char *const names[] = {"linear", "srgb", "rec709", "cineon"};
  for (int i = 0; i < 4; i++) {
    celspan_transfer transfer = CELSPAN_TRANSFER_DEFAULT;
    CHECK(cs_transfer_parse(names[i], &transfer));
    CHECK((int)transfer == (int)CELSPAN_TRANSFER_LINEAR + (int)i);
  }
  celspan_transfer untouched = CELSPAN_TRANSFER_REC709;
  CHECK(!cs_transfer_parse("default", &untouched) && !cs_transfer_parse("sRGB", &untouched));
  CHECK(untouched == CELSPAN_TRANSFER_REC709);
}

/* The expected sum was computed once. */
static void check_bits(void) {
  cs_hash hash = cs_hash_begin(0);
  for (int transfer = CELSPAN_TRANSFER_SRGB; transfer <= CELSPAN_TRANSFER_CINEON; transfer++)
    for (int i = -1000; i < 5000; i++) {
      float x = (float)i / 3000;
      cs_hash_number(&hash, (double)cs_transfer_encode((celspan_transfer)transfer, x));
      cs_hash_number(&hash, (double)cs_transfer_decode((celspan_transfer)transfer, x));
    }
  CHECK(cs_hash_end(hash).a == 0xa968fa7f818b580fu);
}

int main(void) {
  check_srgb8();
  check_curve(CELSPAN_TRANSFER_SRGB, srgb);
  check_curve(CELSPAN_TRANSFER_REC709, rec709);
  check_curve(CELSPAN_TRANSFER_CINEON, cineon);
  check_continuation();
  check_names();
  check_bits();
  return check_done();
}
