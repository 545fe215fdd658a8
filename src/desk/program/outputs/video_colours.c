#include "program/outputs/video_colours.h"

#include <ctype.h>
#include <math.h>
#include <string.h>
#include <strings.h>

#include "inside/colour.h"
#include "inside/elementary.h"
#include "program/film/spaces.h"

/* By how much a code may differ from the curve: half a step of 8 bits. */
#define SAME (0.5 / 255)

/* ---------------------------------------------------------------- spaces */

typedef struct curve {
  int32_t tag;
  celspan_transfer transfer; /* DEFAULT: the power */
  double power;
} curve;

/* Players show BT.709 with the power 2.4, as BT.1886 says. */
static const curve curves[] = {{CS_VIDEO_SRGB, CELSPAN_TRANSFER_SRGB, 0},
                               {CS_VIDEO_BT709, CELSPAN_TRANSFER_REC709, 0},
                               {CS_VIDEO_BT709, CELSPAN_TRANSFER_DEFAULT, 2.4},
                               {CS_VIDEO_POWER_22, CELSPAN_TRANSFER_DEFAULT, 2.2}};

static const struct {
  const char *name; /* in model/colour/primaries.h */
  int32_t tag;
} gamuts[] = {{"BT.709", CS_VIDEO_BT709}, {"BT.2020", CS_VIDEO_BT2020}, {"P3-D65", CS_VIDEO_P3}};

enum { PROBES = 8 };

/* Light that all of these primaries can have: greys and colours. */
static const float light[PROBES][4] = {{0, 0, 0, 1},
                                       {1, 1, 1, 1},
                                       {0.02F, 0.02F, 0.02F, 1},
                                       {0.18F, 0.18F, 0.18F, 1},
                                       {0.9F, 0.1F, 0.1F, 1},
                                       {0.1F, 0.8F, 0.2F, 1},
                                       {0.1F, 0.2F, 0.7F, 1},
                                       {0.5F, 0.4F, 0.05F, 1}};

static double coded(const curve *along, double x) {
  if (along->transfer != CELSPAN_TRANSFER_DEFAULT)
    return (double)cs_transfer_encode(along->transfer, (float)x);
  return x > 0 ? cs_elementary_pow(x, 1 / along->power) : 0;
}

static bool is_coded_so(float codes[PROBES][4], const curve *along, const double matrix[9]) {
  for (int i = 0; i < PROBES; i++)
    for (int c = 0; c < 3; c++) {
      double x = 0;
      for (int k = 0; k < 3; k++)
        x += matrix[3 * c + k] * (double)light[i][k];
      if (!(fabs(coded(along, x) - (double)codes[i][c]) <= SAME))
        return false;
    }
  return true;
}

static int32_t primaries_tag(const cs_known_primaries *known) {
  for (size_t i = 0; i < sizeof gamuts / sizeof *gamuts; i++)
    if (strcmp(gamuts[i].name, known->name) == 0)
      return gamuts[i].tag;
  return 0;
}

/* Sets the tags if the numbers are light of known primaries along a known curve. */
static bool find_tags(const cs_spaces *spaces, cs_video_options *options) {
  float codes[PROBES][4];
  double matrix[9];
  memcpy(codes, light, sizeof codes);
  spaces->module->convert(spaces->conversion, codes[0], PROBES);
  for (const cs_known_primaries *known = cs_primaries_known; known->name; known++) {
    options->primaries = primaries_tag(known);
    cs_primaries_from_bt709(known, matrix);
    for (size_t i = 0; options->primaries && i < sizeof curves / sizeof *curves; i++) {
      options->transfer = curves[i].tag;
      if (is_coded_so(codes, &curves[i], matrix))
        return true;
    }
  }
  return false;
}

/* ---------------------------------------------------------------- views */

/* Whether a name has a word, which may be followed or preceded by letters of no other one. */
static bool has_word(const char *name, const char *word) {
  size_t size = strlen(word);
  for (const char *at = name; *at; at++)
    if (strncasecmp(at, word, size) == 0 && (at == name || !isalnum((unsigned char)at[-1])) &&
        !isalnum((unsigned char)at[size]))
      return true;
  return false;
}

/* A view has tones of its own, so that only its name says for which display it is. */
static bool is_for_others(const char *name) {
  static const char *const words[] = {"P3",     "DCI",  "DCDM",      "XYZ",    "2020", "Rec2020",
                                      "BT2020", "2100", "Rec2100",   "BT2100", "PQ",   "ST2084",
                                      "2084",   "HLG",  "DisplayP3", "HDR",    "P3D65"};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (has_word(name, words[i]))
      return true;
  return false;
}

static cs_exit set_view(const cs_request *request, const char *name, cs_video_options *options) {
  if (is_for_others(name))
    return cs_report_usage(
        "%s: the view %s is for a display of other primaries or of high dynamic range, which "
        "celspan's videos do not say: give another --display, or write pictures",
        cs_request_text(request, "-o"), name);
  options->primaries = CS_VIDEO_BT709;
  options->transfer = has_word(name, "sRGB") ? CS_VIDEO_SRGB : CS_VIDEO_BT709;
  return CS_EXIT_OK;
}

/* ---------------------------------------------------------------- */

static cs_exit refuse(const cs_request *request, const char *name, const cs_video_codec *codec) {
  return cs_report_usage(
      codec->is_rgb ? "%s: such a file has no tags that say what the colours of \"%s\" are, and is "
                      "shown as sRGB: leave --colour out, or write .mp4"
                    : "%s: the tags of a video cannot say what the colours of \"%s\" are, only "
                      "sRGB, BT.709 or the power 2.2 or 2.4, with the primaries of BT.709, BT.2020 "
                      "or P3: give a --display, or write pictures",
      cs_request_text(request, "-o"), name);
}

cs_exit cs_video_colours_set(const cs_request *request, cs_video_options *options) {
  const cs_spaces *spaces = request->spaces;
  if (!spaces)
    return CS_EXIT_OK;
  const char *name = spaces->module->name(spaces->conversion);
  if (!cs_request_has(request, "--colour"))
    return set_view(request, name, options);
  bool has_tags = find_tags(spaces, options);
  bool is_shown = has_tags && (!options->codec->is_rgb || options->primaries == CS_VIDEO_BT709);
  return is_shown ? CS_EXIT_OK : refuse(request, name, options->codec);
}
