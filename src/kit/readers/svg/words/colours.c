#include "readers/svg/words/colours.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "inside/number.h"
#include "readers/svg/words/transforms.h"

/* The colours that have names, sorted. Source: CSS Color Module Level 4, 6.1. */
static const struct named_colour {
  const char *name;
  uint32_t rgb;
} named_colours[] = {
    {"aliceblue", 0xf0f8ff},
    {"antiquewhite", 0xfaebd7},
    {"aqua", 0x00ffff},
    {"aquamarine", 0x7fffd4},
    {"azure", 0xf0ffff},
    {"beige", 0xf5f5dc},
    {"bisque", 0xffe4c4},
    {"black", 0x000000},
    {"blanchedalmond", 0xffebcd},
    {"blue", 0x0000ff},
    {"blueviolet", 0x8a2be2},
    {"brown", 0xa52a2a},
    {"burlywood", 0xdeb887},
    {"cadetblue", 0x5f9ea0},
    {"chartreuse", 0x7fff00},
    {"chocolate", 0xd2691e},
    {"coral", 0xff7f50},
    {"cornflowerblue", 0x6495ed},
    {"cornsilk", 0xfff8dc},
    {"crimson", 0xdc143c},
    {"cyan", 0x00ffff},
    {"darkblue", 0x00008b},
    {"darkcyan", 0x008b8b},
    {"darkgoldenrod", 0xb8860b},
    {"darkgray", 0xa9a9a9},
    {"darkgreen", 0x006400},
    {"darkgrey", 0xa9a9a9},
    {"darkkhaki", 0xbdb76b},
    {"darkmagenta", 0x8b008b},
    {"darkolivegreen", 0x556b2f},
    {"darkorange", 0xff8c00},
    {"darkorchid", 0x9932cc},
    {"darkred", 0x8b0000},
    {"darksalmon", 0xe9967a},
    {"darkseagreen", 0x8fbc8f},
    {"darkslateblue", 0x483d8b},
    {"darkslategray", 0x2f4f4f},
    {"darkslategrey", 0x2f4f4f},
    {"darkturquoise", 0x00ced1},
    {"darkviolet", 0x9400d3},
    {"deeppink", 0xff1493},
    {"deepskyblue", 0x00bfff},
    {"dimgray", 0x696969},
    {"dimgrey", 0x696969},
    {"dodgerblue", 0x1e90ff},
    {"firebrick", 0xb22222},
    {"floralwhite", 0xfffaf0},
    {"forestgreen", 0x228b22},
    {"fuchsia", 0xff00ff},
    {"gainsboro", 0xdcdcdc},
    {"ghostwhite", 0xf8f8ff},
    {"gold", 0xffd700},
    {"goldenrod", 0xdaa520},
    {"gray", 0x808080},
    {"green", 0x008000},
    {"greenyellow", 0xadff2f},
    {"grey", 0x808080},
    {"honeydew", 0xf0fff0},
    {"hotpink", 0xff69b4},
    {"indianred", 0xcd5c5c},
    {"indigo", 0x4b0082},
    {"ivory", 0xfffff0},
    {"khaki", 0xf0e68c},
    {"lavender", 0xe6e6fa},
    {"lavenderblush", 0xfff0f5},
    {"lawngreen", 0x7cfc00},
    {"lemonchiffon", 0xfffacd},
    {"lightblue", 0xadd8e6},
    {"lightcoral", 0xf08080},
    {"lightcyan", 0xe0ffff},
    {"lightgoldenrodyellow", 0xfafad2},
    {"lightgray", 0xd3d3d3},
    {"lightgreen", 0x90ee90},
    {"lightgrey", 0xd3d3d3},
    {"lightpink", 0xffb6c1},
    {"lightsalmon", 0xffa07a},
    {"lightseagreen", 0x20b2aa},
    {"lightskyblue", 0x87cefa},
    {"lightslategray", 0x778899},
    {"lightslategrey", 0x778899},
    {"lightsteelblue", 0xb0c4de},
    {"lightyellow", 0xffffe0},
    {"lime", 0x00ff00},
    {"limegreen", 0x32cd32},
    {"linen", 0xfaf0e6},
    {"magenta", 0xff00ff},
    {"maroon", 0x800000},
    {"mediumaquamarine", 0x66cdaa},
    {"mediumblue", 0x0000cd},
    {"mediumorchid", 0xba55d3},
    {"mediumpurple", 0x9370db},
    {"mediumseagreen", 0x3cb371},
    {"mediumslateblue", 0x7b68ee},
    {"mediumspringgreen", 0x00fa9a},
    {"mediumturquoise", 0x48d1cc},
    {"mediumvioletred", 0xc71585},
    {"midnightblue", 0x191970},
    {"mintcream", 0xf5fffa},
    {"mistyrose", 0xffe4e1},
    {"moccasin", 0xffe4b5},
    {"navajowhite", 0xffdead},
    {"navy", 0x000080},
    {"oldlace", 0xfdf5e6},
    {"olive", 0x808000},
    {"olivedrab", 0x6b8e23},
    {"orange", 0xffa500},
    {"orangered", 0xff4500},
    {"orchid", 0xda70d6},
    {"palegoldenrod", 0xeee8aa},
    {"palegreen", 0x98fb98},
    {"paleturquoise", 0xafeeee},
    {"palevioletred", 0xdb7093},
    {"papayawhip", 0xffefd5},
    {"peachpuff", 0xffdab9},
    {"peru", 0xcd853f},
    {"pink", 0xffc0cb},
    {"plum", 0xdda0dd},
    {"powderblue", 0xb0e0e6},
    {"purple", 0x800080},
    {"rebeccapurple", 0x663399},
    {"red", 0xff0000},
    {"rosybrown", 0xbc8f8f},
    {"royalblue", 0x4169e1},
    {"saddlebrown", 0x8b4513},
    {"salmon", 0xfa8072},
    {"sandybrown", 0xf4a460},
    {"seagreen", 0x2e8b57},
    {"seashell", 0xfff5ee},
    {"sienna", 0xa0522d},
    {"silver", 0xc0c0c0},
    {"skyblue", 0x87ceeb},
    {"slateblue", 0x6a5acd},
    {"slategray", 0x708090},
    {"slategrey", 0x708090},
    {"snow", 0xfffafa},
    {"springgreen", 0x00ff7f},
    {"steelblue", 0x4682b4},
    {"tan", 0xd2b48c},
    {"teal", 0x008080},
    {"thistle", 0xd8bfd8},
    {"tomato", 0xff6347},
    {"turquoise", 0x40e0d0},
    {"violet", 0xee82ee},
    {"wheat", 0xf5deb3},
    {"white", 0xffffff},
    {"whitesmoke", 0xf5f5f5},
    {"yellow", 0xffff00},
    {"yellowgreen", 0x9acd32},
};

static cs_svg_colour of_bytes(unsigned r, unsigned g, unsigned b, unsigned a) {
  return (cs_svg_colour){{r / 255.0, g / 255.0, b / 255.0}, a / 255.0};
}

static bool take_digits(const char **text, cs_svg_colour *out) {
  unsigned d[9];
  size_t count = 0;
  for (const char *at = *text + 1; count < 9 && cs_hex_digit(*at) >= 0; at++)
    d[count++] = (unsigned)cs_hex_digit(*at);
  *text += 1 + count;
  if (count == 3 || count == 4)
    *out = of_bytes(17 * d[0], 17 * d[1], 17 * d[2], count == 4 ? 17 * d[3] : 255);
  else if (count == 6 || count == 8)
    *out = of_bytes(16 * d[0] + d[1], 16 * d[2] + d[3], 16 * d[4] + d[5],
                    count == 8 ? 16 * d[6] + d[7] : 255);
  return count == 3 || count == 4 || count == 6 || count == 8;
}

/* A number from 0 to `whole`, or a percentage, as a share. */
static bool take_share(const char **text, double whole, double *out, bool *is_percent) {
  double value;
  if (!cs_svg_take_number(text, &value))
    return false;
  *is_percent = **text == '%';
  *text += *is_percent;
  *out = cs_number_clamp(value / (*is_percent ? 100 : whole), 0, 1);
  return true;
}

static bool take_hue(const char **text, cs_svg_colour *out) {
  double hue, saturation, lightness;
  bool is_percent;
  if (!cs_svg_take_angle(text, &hue))
    return false;
  *text = cs_svg_skip_comma(*text);
  if (!take_share(text, 100, &saturation, &is_percent))
    return false;
  *text = cs_svg_skip_comma(*text);
  if (!take_share(text, 100, &lightness, &is_percent))
    return false;
  cs_svg_colour_of_hue(hue, saturation, lightness, out);
  return true;
}

/* With commas between them, all must be numbers, or all percentages. */
static bool take_channels(const char **text, cs_svg_colour *out) {
  bool is_percent[3], has_comma = false;
  for (int c = 0; c < 3; c++) {
    *text = cs_svg_skip_space(*text);
    has_comma = has_comma || **text == ',';
    *text = cs_svg_skip_comma(*text);
    if (!take_share(text, 255, &out->rgb[c], &is_percent[c]))
      return false;
  }
  return !has_comma || (is_percent[0] == is_percent[1] && is_percent[1] == is_percent[2]);
}

/* The arguments after "rgb(" or "hsl(". */
static bool take_function(const char **text, bool is_hue, cs_svg_colour *out) {
  bool is_percent;
  *text = cs_svg_skip_space(*text);
  out->alpha = 1;
  if (!(is_hue ? take_hue(text, out) : take_channels(text, out)))
    return false;
  *text = cs_svg_skip_comma(*text);
  if (**text == '/')
    *text = cs_svg_skip_space(*text + 1);
  if (**text != ')' && !take_share(text, 1, &out->alpha, &is_percent))
    return false;
  *text = cs_svg_skip_space(*text);
  bool is_closed = **text == ')';
  *text += is_closed;
  return is_closed;
}

static int compare_name(const void *key, const void *item) {
  return strcmp(key, ((const struct named_colour *)item)->name);
}

static bool take_name(const char **text, cs_svg_colour *out) {
  char name[24];
  size_t size = 0;
  const char *at = *text;
  for (; ((*at | 32) >= 'a' && (*at | 32) <= 'z'); at++)
    if (size + 1 < sizeof name)
      name[size++] = (char)(*at | 32);
  name[size] = 0;
  *text = at;
  if (strcmp(name, "transparent") == 0) {
    *out = (cs_svg_colour){{0, 0, 0}, 0};
    return true;
  }
  const struct named_colour *found =
      bsearch(name, named_colours, sizeof named_colours / sizeof *named_colours,
              sizeof *named_colours, compare_name);
  if (found)
    *out = of_bytes(found->rgb >> 16, found->rgb >> 8 & 255, found->rgb & 255, 255);
  return found;
}

static bool begins(const char *text, const char *word) {
  for (; *word; text++, word++)
    if ((*text | 32) != (*word | 32))
      return false;
  return true;
}

bool cs_svg_take_colour(const char **text, cs_svg_colour *out) {
  const char *at = *text;
  static const char *const functions[] = {"rgba(", "rgb(", "hsla(", "hsl("};
  for (size_t i = 0; i < 4; i++)
    if (begins(at, functions[i])) {
      at += strlen(functions[i]);
      *text = at;
      return take_function(text, i >= 2, out);
    }
  return *at == '#' ? take_digits(text, out)
                    : cs_svg_take_space_colour(text, out) || take_name(text, out);
}
