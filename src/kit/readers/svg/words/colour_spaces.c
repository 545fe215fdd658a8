/* Colours of color spaces other than sRGB, as CSS writes them. */
#include "readers/svg/words/colours.h"

#include <math.h>
#include <string.h>

#include "inside/colour.h"
#include "inside/elementary.h"
#include "inside/number.h"
#include "readers/svg/words/transforms.h"

#define PI 3.14159265358979323846

/* ---------------------------------------------------------------- arguments */

/* A number, a percentage of `whole`, or none, which is 0. */
static bool take_component(const char **text, double whole, double *out) {
  *text = cs_svg_skip_space(*text);
  *out = 0;
  if (cs_svg_take_word(text, "none"))
    return true;
  if (!cs_svg_take_number(text, out))
    return false;
  if (**text == '%') {
    *out *= whole / 100;
    ++*text;
  }
  return true;
}

static bool take_hue(const char **text, double *degrees) {
  *text = cs_svg_skip_space(*text);
  *degrees = 0;
  return cs_svg_take_word(text, "none") || cs_svg_take_angle(text, degrees);
}

/* An alpha after a slash, and the closing parenthesis. */
static bool take_end(const char **text, double *alpha) {
  *alpha = 1;
  *text = cs_svg_skip_space(*text);
  if (**text == '/') {
    ++*text;
    if (!take_component(text, 1, alpha))
      return false;
    *alpha = cs_number_clamp(*alpha, 0, 1);
    *text = cs_svg_skip_space(*text);
  }
  bool is_closed = **text == ')';
  *text += is_closed;
  return is_closed;
}

/* ---------------------------------------------------------------- conversions */

/* One channel. Source: CSS Color Module Level 4, 7.1. */
static double hue_channel(double hue, double saturation, double lightness, double n) {
  double k = fmod(n + hue / 30, 12), a = saturation * fmin(lightness, 1 - lightness);
  return lightness - a * fmax(-1, fmin(fmin(k - 3, 9 - k), 1));
}

void cs_svg_colour_of_hue(double hue, double saturation, double lightness, cs_svg_colour *out) {
  hue -= 360 * floor(hue / 360);
  for (int c = 0; c < 3; c++)
    out->rgb[c] = hue_channel(hue, saturation, lightness, c == 0 ? 0 : c == 1 ? 8 : 4);
}

typedef double matrix3[3][3];

static void apply(const matrix3 m, const double in[3], double out[3]) {
  for (int i = 0; i < 3; i++)
    out[i] = m[i][0] * in[0] + m[i][1] * in[1] + m[i][2] * in[2];
}

/* Matrices: CSS Color Module Level 4, 18. */
static const matrix3 xyz_to_srgb = {{3.2409699419045213, -1.5373831775700935, -0.4986107602930033},
                                    {-0.9692436362808798, 1.8759675015077206, 0.0415550574071756},
                                    {0.0556300796969936, -0.2039769588889765, 1.0569715142428785}};
static const matrix3 d50_to_d65 = {
    {0.955473421488075, -0.02309845494876471, 0.06325924320057072},
    {-0.0283697093338637, 1.0099953980813041, 0.021041441191917323},
    {0.012314014864481998, -0.020507649298898964, 1.330365926242124}};
static const matrix3 p3_to_xyz = {{0.4865709486482162, 0.26566769316909306, 0.1982172852343625},
                                  {0.2289745640697488, 0.6917385218365064, 0.079286914093745},
                                  {0, 0.04511338185890264, 1.043944368900976}};
static const matrix3 oklab_to_lms = {{1, 0.3963377773761749, 0.2158037573099136},
                                     {1, -0.1055613458156586, -0.0638541728258133},
                                     {1, -0.0894841775298119, -1.2914855480194092}};
static const matrix3 lms_to_srgb = {{4.0767416360759583, -3.3077115392580629, 0.2309699031821043},
                                    {-1.2684379732850315, 2.6097573492876882, -0.341319376002657},
                                    {-0.0041960761386756, -0.7034186179359362, 1.7076146940746117}};

static void set_light(const double light[3], cs_svg_colour *out) {
  for (int c = 0; c < 3; c++)
    out->rgb[c] =
        (double)cs_transfer_encode(CELSPAN_TRANSFER_SRGB, (float)cs_number_clamp(light[c], 0, 1));
}

static void set_xyz(const double xyz[3], cs_svg_colour *out) {
  double light[3];
  apply(xyz_to_srgb, xyz, light);
  set_light(light, out);
}

/* Sets a colour from lightness and two axes of CIE Lab under D50. */
static void set_lab(const double lab[3], cs_svg_colour *out) {
  static const double white[3] = {0.9642956764295677, 1, 0.8251046025104602};
  const double kappa = 24389.0 / 27, epsilon = 216.0 / 24389;
  double middle = (lab[0] + 16) / 116;
  const double f[3] = {middle + lab[1] / 500, middle, middle - lab[2] / 200};
  double d50[3], xyz[3];
  for (int c = 0; c < 3; c++) {
    double cube = f[c] * f[c] * f[c];
    d50[c] = white[c] * (cube > epsilon ? cube : (116 * f[c] - 16) / kappa);
  }
  d50[1] = lab[0] > kappa * epsilon ? middle * middle * middle : lab[0] / kappa;
  apply(d50_to_d65, d50, xyz);
  set_xyz(xyz, out);
}

static void set_oklab(const double lab[3], cs_svg_colour *out) {
  double lms[3], light[3];
  apply(oklab_to_lms, lab, lms);
  for (int c = 0; c < 3; c++)
    lms[c] = lms[c] * lms[c] * lms[c];
  apply(lms_to_srgb, lms, light);
  set_light(light, out);
}

/* ---------------------------------------------------------------- functions */

/* Lightness and two axes; or lightness, chroma and hue. */
static bool take_lab(const char **text, bool is_ok, bool is_polar, cs_svg_colour *out) {
  double lab[3], hue, sine, cosine, chroma = is_ok ? 0.4 : is_polar ? 150 : 125;
  if (!take_component(text, is_ok ? 1 : 100, &lab[0]) || !take_component(text, chroma, &lab[1]) ||
      !(is_polar ? take_hue(text, &hue) : take_component(text, chroma, &lab[2])))
    return false;
  if (is_polar) {
    cs_elementary_sincos(fmod(hue, 360) * (PI / 180), &sine, &cosine);
    lab[2] = fmax(0, lab[1]) * sine;
    lab[1] = fmax(0, lab[1]) * cosine;
  }
  lab[0] = cs_number_clamp(lab[0], 0, is_ok ? 1 : 100);
  (is_ok ? set_oklab : set_lab)(lab, out);
  return true;
}

/* A hue, and the shares of white and of black that are mixed in. */
static bool take_hwb(const char **text, cs_svg_colour *out) {
  double hue, white, black;
  if (!take_hue(text, &hue) || !take_component(text, 100, &white) ||
      !take_component(text, 100, &black))
    return false;
  white = fmax(0, white) / 100;
  black = fmax(0, black) / 100;
  cs_svg_colour_of_hue(hue, 1, 0.5, out);
  double sum = white + black;
  for (int c = 0; c < 3; c++)
    out->rgb[c] = sum >= 1 ? white / sum : out->rgb[c] * (1 - sum) + white;
  return true;
}

/* color(): the name of a known space, and three components. */
static bool take_color(const char **text, cs_svg_colour *out) {
  static const char *const words[] = {"srgb",    "srgb-linear", "display-p3",
                                      "xyz-d50", "xyz-d65",     "xyz"};
  size_t space = 0;
  double in[3], xyz[3];
  *text = cs_svg_skip_space(*text);
  size_t size = strcspn(*text, " \t\r\n\f");
  while (space < 6 && (strlen(words[space]) != size || strncmp(*text, words[space], size) != 0))
    space++;
  *text += size;
  for (int c = 0; c < 3; c++)
    if (space == 6 || !take_component(text, 1, &in[c]))
      return false;
  if (space == 0)
    memcpy(out->rgb, in, sizeof in);
  else if (space == 1)
    set_light(in, out);
  else if (space == 2) {
    for (int c = 0; c < 3; c++)
      in[c] =
          (double)cs_transfer_decode(CELSPAN_TRANSFER_SRGB, (float)cs_number_clamp(in[c], 0, 1));
    apply(p3_to_xyz, in, xyz);
    set_xyz(xyz, out);
  } else {
    apply(d50_to_d65, in, xyz);
    set_xyz(space == 3 ? xyz : in, out);
  }
  return true;
}

bool cs_svg_take_space_colour(const char **text, cs_svg_colour *out) {
  static const char *const words[] = {"hwb", "color", "lab", "lch", "oklab", "oklch"};
  const char *at = *text;
  size_t function = 0;
  while (function < 6 && !cs_svg_take_word(&at, words[function]))
    function++;
  if (function == 6 || *at++ != '(')
    return false;
  bool is_taken = function == 0   ? take_hwb(&at, out)
                  : function == 1 ? take_color(&at, out)
                                  : take_lab(&at, function >= 4, function % 2 == 1, out);
  if (!is_taken || !take_end(&at, &out->alpha))
    return false;
  *text = at;
  return true;
}
