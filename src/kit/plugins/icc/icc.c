/* Profiles are converted with the perceptual intent and black point compensation, the defaults of
 * Krita.
 *
 * Without memory the library reports other failures, or crashes: it uses a mutex that it could not
 * allocate. Therefore it allocates through functions of this file, into a list that belongs to the
 * request. If an allocation fails, the request ends at once, and the list is freed. */
#include <lcms2.h>
#include <lcms2_plugin.h>
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#include "readers/layered/colour_module.h"

enum {
  CHECKED = 9, /* places on each side at which the sum of the curves is compared with the light */
  PLANE = CS_COLOUR_SIDE * CS_COLOUR_SIDE
};

/* The largest allocation: a larger request by a damaged profile counts as a failure of the library.
 */
#define LARGEST ((cmsUInt32Number)64 << 20)

typedef struct conversion {
  cmsHTRANSFORM transform;
  bool is_grey;
} conversion;

/* ITU-R BT.709: white D65 and the primaries of sRGB. */
static const cmsCIExyY white = {0.3127, 0.3290, 1};
static const cmsCIExyYTRIPLE primaries = {{0.64, 0.33, 1}, {0.30, 0.60, 1}, {0.15, 0.06, 1}};

/* ---------------------------------------------------------------- memory */

typedef union allocation {
  struct {
    union allocation *next, *previous;
  };
  max_align_t aligned;
} allocation;

/* The state of the request that this thread works on. */
static _Thread_local struct {
  allocation *first;
  jmp_buf failed;
  /* false: the library is being initialized, and its allocations belong to the process */
  bool is_open;
} request_memory;

static void link_allocation(allocation *of) {
  *of = (allocation){.next = request_memory.first};
  if (of->next)
    of->next->previous = of;
  request_memory.first = of;
}

static void unlink_allocation(allocation *of) {
  if (of->next)
    of->next->previous = of->previous;
  if (of->previous)
    of->previous->next = of->next;
  else if (request_memory.first == of)
    request_memory.first = of->next;
}

/* The memory of an allocation that is not in a list. */
static void *keep(allocation *of) {
  if (!of && request_memory.is_open)
    longjmp(request_memory.failed, 1);
  if (!of)
    return NULL;
  if (request_memory.is_open)
    link_allocation(of);
  else
    *of = (allocation){.next = NULL};
  return of + 1;
}

static void *take(cmsContext context, cmsUInt32Number size) {
  (void)context;
  return size <= LARGEST ? keep(malloc(sizeof(allocation) + size)) : NULL;
}

static void give_back(cmsContext context, void *memory) {
  (void)context;
  if (!memory)
    return;
  unlink_allocation((allocation *)memory - 1);
  free((allocation *)memory - 1);
}

/* The list is complete again before the request ends. */
static void *resize(cmsContext context, void *memory, cmsUInt32Number size) {
  if (!memory || size > LARGEST)
    return memory ? NULL : take(context, size);
  allocation *of = (allocation *)memory - 1;
  unlink_allocation(of);
  allocation *grown = realloc(of, sizeof(allocation) + size);
  if (!grown)
    keep(of);
  return keep(grown);
}

static void free_all(void) {
  while (request_memory.first)
    give_back(NULL, request_memory.first + 1);
}

static cmsContext library; /* NULL: it lacked memory, and the next request initializes it */

static bool set_up_library(void) {
  static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
  static cmsPluginMemHandler handler = {
      .base = {cmsPluginMagicNumber, 2000, cmsPluginMemHandlerSig, NULL},
      .MallocPtr = take,
      .FreePtr = give_back,
      .ReallocPtr = resize};
  pthread_mutex_lock(&lock);
  if (!library)
    library = cmsCreateContext(&handler, NULL);
  bool is_there = library;
  pthread_mutex_unlock(&lock);
  return is_there;
}

/* ---------------------------------------------------------------- profiles */

static cmsHPROFILE create_profile(double power, const cmsCIExyY *its_white,
                                  const cmsCIExyYTRIPLE *its_primaries) {
  cmsToneCurve *curve = cmsBuildGamma(library, power);
  cmsToneCurve *const curves[] = {curve, curve, curve};
  return curve ? cmsCreateRGBProfileTHR(library, its_white, its_primaries, curves) : NULL;
}

static cmsCIExyY place_of(const uint32_t *places) {
  return (cmsCIExyY){places[0] / 1e5, places[1] / 1e5, 1};
}

static cmsHPROFILE open_profile(const cs_colour_request *request) {
  if (request->bytes)
    return cmsOpenProfileFromMemTHR(library, request->bytes, (cmsUInt32Number)request->size);
  const uint32_t *places = request->places;
  for (int i = 0; request->has_places && i < 8; i++)
    if (places[i] == 0 || places[i] >= 100000)
      return NULL;
  const cmsCIExyY its_white = place_of(places);
  const cmsCIExyYTRIPLE its_primaries = {place_of(places + 2), place_of(places + 4),
                                         place_of(places + 6)};
  return create_profile(1e5 / request->power, request->has_places ? &its_white : &white,
                        request->has_places ? &its_primaries : &primaries);
}

static void read_name(cmsHPROFILE profile, char out[64]) {
  wchar_t name[64] = L"";
  cmsGetProfileInfo(profile, cmsInfoDescription, "en", "US", name, sizeof name);
  size_t size = 0;
  for (; size < 63 && name[size]; size++)
    out[size] = name[size] >= ' ' && name[size] < 127 ? (char)name[size] : '?';
  out[size] = 0;
}

/* ---------------------------------------------------------------- light */

/* The light of `count` colours of three codes. */
static void convert(const conversion *c, const float (*codes)[3], float (*light)[3],
                    uint32_t count) {
  cmsDoTransform(c->transform, codes, light, count);
}

/* The light of one channel's codes from 0 to 1, with the other two channels at 0; for grey, the
 * channel itself. */
static void sample_curve(const conversion *c, int channel, float (*out)[3]) {
  const cmsUInt32Number count = CS_COLOUR_STEPS + 1;
  float(*codes)[3] = take(library, count * (cmsUInt32Number)sizeof *codes);
  memset(codes, 0, count * sizeof *codes);
  for (int i = 0; i <= CS_COLOUR_STEPS; i++) {
    float code = (float)i / CS_COLOUR_STEPS;
    codes[c->is_grey ? i / 3 : i][c->is_grey ? i % 3 : channel] = code;
  }
  convert(c, (const float(*)[3])codes, out, count);
  give_back(library, codes);
  for (int i = 0; i <= CS_COLOUR_STEPS && c->is_grey; i++) {
    float light = out[i][1];
    memset(out[i], 0, sizeof out[i]);
    out[i][channel] = light;
  }
}

/* The light of black is counted once. */
static void sample_curves(const conversion *c, cs_colour_table *out) {
  out->form = CS_COLOUR_CURVES;
  for (int channel = 0; channel < 3; channel++) {
    sample_curve(c, channel, out->curves[channel]);
    const float black[3] = {out->curves[channel][0][0], out->curves[channel][0][1],
                            out->curves[channel][0][2]};
    for (int i = 0; i <= CS_COLOUR_STEPS && channel > 0 && !c->is_grey; i++)
      for (int k = 0; k < 3; k++)
        out->curves[channel][i][k] -= black[k];
  }
}

/* Whether the light is the sum of the curves. */
static bool is_sum(const conversion *c, const cs_colour_table *table) {
  for (int place = 0; place < CHECKED * CHECKED * CHECKED; place++) {
    const int at[3] = {place / (CHECKED * CHECKED), place / CHECKED % CHECKED, place % CHECKED};
    float codes[1][3], light[1][3];
    for (int k = 0; k < 3; k++)
      codes[0][k] = (float)at[k] / (CHECKED - 1);
    convert(c, (const float(*)[3])codes, light, 1);
    for (int k = 0; k < 3; k++) {
      float sum = 0;
      for (int channel = 0; channel < 3; channel++)
        sum += table->curves[channel][at[channel] * CS_COLOUR_STEPS / (CHECKED - 1)][k];
      if (!(fabsf(sum - light[0][k]) < 1e-4f))
        return false;
    }
  }
  return true;
}

static void sample_grid(const conversion *c, cs_colour_table *out) {
  float codes[CS_COLOUR_SIDE * CS_COLOUR_SIDE][3];
  out->form = CS_COLOUR_GRID;
  for (int red = 0; red < CS_COLOUR_SIDE; red++) {
    for (int i = 0; i < PLANE; i++) {
      codes[i][0] = (float)red / (CS_COLOUR_SIDE - 1);
      codes[i][1] = (float)(i / CS_COLOUR_SIDE) / (CS_COLOUR_SIDE - 1);
      codes[i][2] = (float)(i % CS_COLOUR_SIDE) / (CS_COLOUR_SIDE - 1);
    }
    convert(c, (const float(*)[3])codes, out->grid[red][0], PLANE);
  }
}

/* ---------------------------------------------------------------- tables */

static cmsHTRANSFORM create_transform(cmsHPROFILE profile, bool is_grey) {
  const cmsUInt32Number flags =
      cmsFLAGS_BLACKPOINTCOMPENSATION | cmsFLAGS_NOOPTIMIZE | cmsFLAGS_NOCACHE;
  cmsHPROFILE light = create_profile(1, &white, &primaries);
  return light ? cmsCreateTransformTHR(library, profile, is_grey ? TYPE_GRAY_FLT : TYPE_RGB_FLT,
                                       light, TYPE_RGB_FLT, INTENT_PERCEPTUAL, flags)
               : NULL;
}

static void sample_profile(cmsHPROFILE profile, cs_colour_table *out) {
  cmsColorSpaceSignature space = cmsGetColorSpace(profile);
  conversion c = {.is_grey = space == cmsSigGrayData};
  read_name(profile, out->name);
  if (space == cmsSigRgbData || c.is_grey)
    c.transform = create_transform(profile, c.is_grey);
  if (!c.transform)
    return;
  sample_curves(&c, out);
  if (!c.is_grey && !is_sum(&c, out))
    sample_grid(&c, out);
}

static celspan_status sample(const cs_colour_request *request, cs_colour_table *out,
                             cs_picture_failure *failure) {
  *failure = (cs_picture_failure){CELSPAN_NO_MEMORY, "out of memory"};
  memset(out, 0, sizeof *out);
  if (!set_up_library())
    return CELSPAN_NO_MEMORY;
  celspan_status status = CELSPAN_NO_MEMORY;
  request_memory.is_open = true;
  if (setjmp(request_memory.failed) == 0) {
    cmsHPROFILE profile = open_profile(request);
    if (profile)
      sample_profile(profile, out);
    status = CELSPAN_OK;
  }
  free_all();
  request_memory.is_open = false;
  return status;
}

const void *celspan_colour_module(void) {
  static const cs_colour_module table = {CS_COLOUR_MODULE_VERSION, sample};
  return &table;
}
