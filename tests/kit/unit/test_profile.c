/* Colour profiles (readers/layered/profile_table.h): what a table makes of codes, compared with
 * what Little CMS itself makes of them; and every allocation of the library failing. This program's
 * malloc is that of all libraries in it.
 */
#include "readers/layered/profile_table.h"

#include <errno.h>
#include <lcms2.h>

#include "model/colour/transfer.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

enum { PIXELS = 5000 };

static celspan_context *context;
static test_random numbers = {23};

/* ---------------------------------------------------------------- allocations that fail */

#ifdef TEST_ALLOCATOR
/* The allocator that this one calls; declared nowhere. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);

static long left; /* allocations until one fails; 0: none does */

static bool fails(void) {
  if (left == 0 || --left > 0)
    return false;
  errno = ENOMEM;
  return true;
}

void *malloc(size_t size) { return fails() ? NULL : __libc_malloc(size); }

void *calloc(size_t count, size_t size) { return fails() ? NULL : __libc_calloc(count, size); }

void *realloc(void *block, size_t size) {
  return size > 0 && fails() ? NULL : __libc_realloc(block, size);
}
#endif

/* ---------------------------------------------------------------- profiles */

/* A profile as a file has it; closed. */
typedef struct file {
  cmsUInt32Number size;
  unsigned char *bytes;
} file;

static file save(cmsHPROFILE profile) {
  file saved = {0, NULL};
  CHECK(profile && cmsSaveProfileToMem(profile, NULL, &saved.size));
  saved.bytes = malloc(saved.size);
  CHECK(cmsSaveProfileToMem(profile, saved.bytes, &saved.size));
  cmsCloseProfile(profile);
  return saved;
}

static file of_primaries(const cmsCIExyYTRIPLE *primaries, cmsCIExyY white, cmsToneCurve *curve) {
  cmsToneCurve *const curves[] = {curve, curve, curve};
  file saved = save(cmsCreateRGBProfile(&white, primaries, curves));
  cmsFreeToneCurve(curve);
  return saved;
}

static const cmsCIExyY d50 = {0.34567, 0.35850, 1}, d65 = {0.3127, 0.3290, 1};
static const cmsCIExyYTRIPLE adobe = {{0.64, 0.33, 1}, {0.21, 0.71, 1}, {0.15, 0.06, 1}};
static const cmsCIExyYTRIPLE prophoto = {
    {0.7347, 0.2653, 1}, {0.1596, 0.8404, 1}, {0.0366, 0.0001, 1}};
static const cmsCIExyYTRIPLE srgb = {{0.64, 0.33, 1}, {0.30, 0.60, 1}, {0.15, 0.06, 1}};

static cmsToneCurve *srgb_curve(void) {
  const double parameters[] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
  return cmsBuildParametricToneCurve(NULL, 4, parameters);
}

static file grey_of(double power) {
  cmsToneCurve *curve = cmsBuildGamma(NULL, power);
  file saved = save(cmsCreateGrayProfile(&d50, curve));
  cmsFreeToneCurve(curve);
  return saved;
}

/* Lab of a device whose colours darken each other, as paints do. */
static cmsInt32Number mix_paints(const cmsUInt16Number in[], cmsUInt16Number out[], void *user) {
  (void)user;
  double r = in[0] / 65535.0, g = in[1] / 65535.0, b = in[2] / 65535.0;
  double light = 0.2 * r + 0.6 * g + 0.2 * b;
  const cmsCIELab lab = {100 * light * (1.2 - 0.2 * light), 60 * (r - g) * (1 - 0.4 * b),
                         50 * (0.5 * (r + g) - b)};
  cmsFloat2LabEncoded(out, &lab);
  return TRUE;
}

/* A profile of a table of 17 x 17 x 17 places, in Lab. */
static file of_table(void) {
  cmsHPROFILE profile = cmsCreateProfilePlaceholder(NULL);
  cmsPipeline *pipeline = cmsPipelineAlloc(NULL, 3, 3);
  cmsStage *places = cmsStageAllocCLut16bit(NULL, 17, 3, 3, NULL);
  cmsSetProfileVersion(profile, 4.3);
  cmsSetDeviceClass(profile, cmsSigDisplayClass);
  cmsSetColorSpace(profile, cmsSigRgbData);
  cmsSetPCS(profile, cmsSigLabData);
  CHECK(cmsStageSampleCLut16bit(places, mix_paints, NULL, 0));
  CHECK(cmsPipelineInsertStage(pipeline, cmsAT_END, cmsStageAllocToneCurves(NULL, 3, NULL)));
  CHECK(cmsPipelineInsertStage(pipeline, cmsAT_END, places));
  CHECK(cmsPipelineInsertStage(pipeline, cmsAT_END, cmsStageAllocToneCurves(NULL, 3, NULL)));
  CHECK(cmsWriteTag(profile, cmsSigAToB0Tag, pipeline));
  CHECK(cmsWriteTag(profile, cmsSigMediaWhitePointTag, cmsD50_XYZ()));
  cmsPipelineFree(pipeline);
  return save(profile);
}

/* ---------------------------------------------------------------- light */

static celspan_status make_table(const file *of, cs_profile_table **out) {
  const cs_input input = {.path = "a painting"};
  return cs_profile_table_create(context, &input,
                                 &(cs_colour_request){.bytes = of->bytes, .size = of->size}, out);
}

/* The library's own answer, without anything between. */
static void ask_library(const file *of, const float (*codes)[3], float (*light)[3]) {
  cmsToneCurve *curve = cmsBuildGamma(NULL, 1);
  cmsToneCurve *const curves[] = {curve, curve, curve};
  cmsHPROFILE profile = cmsOpenProfileFromMem(of->bytes, of->size);
  cmsHPROFILE linear = cmsCreateRGBProfile(&d65, &srgb, curves);
  bool is_grey = cmsGetColorSpace(profile) == cmsSigGrayData;
  cmsHTRANSFORM transform =
      cmsCreateTransform(profile, is_grey ? TYPE_GRAY_FLT : TYPE_RGB_FLT, linear, TYPE_RGB_FLT,
                         INTENT_PERCEPTUAL, cmsFLAGS_BLACKPOINTCOMPENSATION | cmsFLAGS_NOOPTIMIZE);
  for (int i = 0; i < PIXELS; i++)
    cmsDoTransform(transform, codes[i], light[i], 1);
  cmsDeleteTransform(transform);
  cmsCloseProfile(linear);
  cmsCloseProfile(profile);
  cmsFreeToneCurve(curve);
}

/* The greatest difference of light, as codes of sRGB see it. */
static double compare(const file *of, const cs_profile_table *table, int bits) {
  static uint16_t wide[PIXELS][4];
  static unsigned char narrow[PIXELS][4];
  static float codes[PIXELS][3], expected[PIXELS][3], found[PIXELS][4];
  bool is_grey = of->bytes[16] == 'G';
  for (int i = 0; i < PIXELS; i++)
    for (int c = 0; c < 4; c++) {
      bool is_copied = is_grey && c > 0 && c < 3;
      wide[i][c] = is_copied ? wide[i][0] : (uint16_t)random_below(&numbers, 65536);
      narrow[i][c] = (unsigned char)(wide[i][c] >> 8);
      if (c < 3)
        codes[i][c] = bits == 16 ? wide[i][c] / 65535.0f : narrow[i][c] / 255.0f;
    }
  ask_library(of, (const float(*)[3])codes, expected);
  cs_profile_table_convert(table, bits, bits == 16 ? (void *)wide : (void *)narrow, PIXELS,
                           found[0]);
  double most = 0;
  for (int i = 0; i < PIXELS; i++) {
    CHECK_NEAR(found[i][3], bits == 16 ? wide[i][3] / 65535.0 : narrow[i][3] / 255.0, 1e-6);
    for (int c = 0; c < 3; c++)
      most = fmax(most, fabs((double)cs_transfer_encode(CELSPAN_TRANSFER_SRGB, found[i][c]) -
                             (double)cs_transfer_encode(CELSPAN_TRANSFER_SRGB, expected[i][c])));
  }
  return most;
}

static void check_profile(const char *name, file of, cs_colour_form form, double tolerance) {
  cs_profile_table *table = NULL;
  if (!CHECK(make_table(&of, &table) == CELSPAN_OK))
    return;
  CHECK(table->codes == CS_PROFILE_CONVERTED && table->light.form == (int32_t)form);
  double narrow = compare(&of, table, 8), wide = compare(&of, table, 16);
  printf("%s: differs by %.2g of a code of 8 bits, by %.2g of one of 16\n", name, 255 * narrow,
         65535 * wide);
  CHECK(narrow < tolerance && wide < tolerance);
  cs_profile_table_unref(table);
  free(of.bytes);
}

static void check_codes(file of, cs_profile_codes codes) {
  cs_profile_table *table = NULL;
  if (!CHECK(make_table(&of, &table) == CELSPAN_OK))
    return;
  CHECK(table->codes == codes);
  cs_profile_table_unref(table);
  free(of.bytes);
}

static void test_light(void) {
  check_profile("Adobe RGB", of_primaries(&adobe, d65, cmsBuildGamma(NULL, 2.19921875)),
                CS_COLOUR_CURVES, 1e-5);
  check_profile("ProPhoto", of_primaries(&prophoto, d50, cmsBuildGamma(NULL, 1.8)),
                CS_COLOUR_CURVES, 1e-5);
  check_profile("Adobe's primaries, the curve of sRGB", of_primaries(&adobe, d65, srgb_curve()),
                CS_COLOUR_CURVES, 1e-5);
  check_profile("wide and linear", of_primaries(&prophoto, d50, cmsBuildGamma(NULL, 1)),
                CS_COLOUR_CURVES, 1e-5);
  check_profile("grey", grey_of(2.2), CS_COLOUR_CURVES, 1e-5);
  check_profile("a table", of_table(), CS_COLOUR_GRID, 2.0 / 255);
  check_codes(of_primaries(&srgb, d65, srgb_curve()), CS_PROFILE_SRGB);
  check_codes(of_primaries(&srgb, d65, cmsBuildGamma(NULL, 1)), CS_PROFILE_LINEAR);
  check_codes(grey_of(1), CS_PROFILE_LINEAR);
  check_codes(save(cmsCreateLab4Profile(NULL)), CS_PROFILE_UNKNOWN);
}

/* ---------------------------------------------------------------- damage */

/* Whatever a byte is changed to, there is a table, of finite numbers where it is one to convert by.
 */
static void test_damage(void) {
  file of = of_table();
  for (int i = 0; i < 100; i++) {
    cs_profile_table *table = NULL;
    size_t at = (size_t)random_below(&numbers, i % 2 ? (int)of.size : 300);
    unsigned char before = of.bytes[at];
    of.bytes[at] = (unsigned char)random_below(&numbers, 256);
    CHECK(make_table(&of, &table) == CELSPAN_OK);
    float pixel[4] = {0};
    const unsigned char codes[4] = {17, 250, 99, 255};
    if (table->codes == CS_PROFILE_CONVERTED)
      cs_profile_table_convert(table, 8, codes, 1, pixel);
    CHECK(isfinite(pixel[0]) && isfinite(pixel[1]) && isfinite(pixel[2]));
    cs_profile_table_unref(table);
    of.bytes[at] = before;
  }
  free(of.bytes);
}

/* ---------------------------------------------------------------- memory */

#ifdef TEST_ALLOCATOR
/* Whether an allocation failed: then this is reported, or changed nothing. */
static bool try_allocation(long number, const file *of, const cs_profile_table *right) {
  cs_profile_table *table = NULL;
  left = number;
  celspan_status status = make_table(of, &table);
  bool has_failed = left == 0;
  left = 0;
  CHECK(status == CELSPAN_NO_MEMORY ||
        (status == CELSPAN_OK && memcmp(&table->light, &right->light, sizeof right->light) == 0));
  cs_profile_table_unref(table);
  return has_failed;
}

/* Every allocation, or one in `step`. */
static void test_memory(file of, int step) {
  cs_profile_table *right = NULL;
  CHECK(make_table(&of, &right) == CELSPAN_OK);
  long number = 1;
  while (try_allocation(number, &of, right))
    number += step;
  CHECK(number > 100);
  cs_profile_table_unref(right);
  free(of.bytes);
}
#endif

int main(void) {
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  test_light();
  test_damage();
#ifdef TEST_ALLOCATOR
  test_memory(of_primaries(&adobe, d65, cmsBuildGamma(NULL, 2.2)), 1);
  test_memory(of_table(), 11);
#endif
  celspan_context_destroy(context);
  return check_done();
}
