#include "readers/svg/words/colours.h"

#include <stdlib.h>
#include <string.h>

#include "inside/number.h"
#include "readers/svg/words/transforms.h"

/* The colours that have names, sorted, with 0xRRGGBB. Source: CSS Color Module Level 4, 6.1. */
#define COLOUR_LIST(COLOUR)                                                                        \
  COLOUR(aliceblue, 0xf0f8ff), COLOUR(antiquewhite, 0xfaebd7), COLOUR(aqua, 0x00ffff),             \
      COLOUR(aquamarine, 0x7fffd4), COLOUR(azure, 0xf0ffff), COLOUR(beige, 0xf5f5dc),              \
      COLOUR(bisque, 0xffe4c4), COLOUR(black, 0x000000), COLOUR(blanchedalmond, 0xffebcd),         \
      COLOUR(blue, 0x0000ff), COLOUR(blueviolet, 0x8a2be2), COLOUR(brown, 0xa52a2a),               \
      COLOUR(burlywood, 0xdeb887), COLOUR(cadetblue, 0x5f9ea0), COLOUR(chartreuse, 0x7fff00),      \
      COLOUR(chocolate, 0xd2691e), COLOUR(coral, 0xff7f50), COLOUR(cornflowerblue, 0x6495ed),      \
      COLOUR(cornsilk, 0xfff8dc), COLOUR(crimson, 0xdc143c), COLOUR(cyan, 0x00ffff),               \
      COLOUR(darkblue, 0x00008b), COLOUR(darkcyan, 0x008b8b), COLOUR(darkgoldenrod, 0xb8860b),     \
      COLOUR(darkgray, 0xa9a9a9), COLOUR(darkgreen, 0x006400), COLOUR(darkgrey, 0xa9a9a9),         \
      COLOUR(darkkhaki, 0xbdb76b), COLOUR(darkmagenta, 0x8b008b),                                  \
      COLOUR(darkolivegreen, 0x556b2f), COLOUR(darkorange, 0xff8c00),                              \
      COLOUR(darkorchid, 0x9932cc), COLOUR(darkred, 0x8b0000), COLOUR(darksalmon, 0xe9967a),       \
      COLOUR(darkseagreen, 0x8fbc8f), COLOUR(darkslateblue, 0x483d8b),                             \
      COLOUR(darkslategray, 0x2f4f4f), COLOUR(darkslategrey, 0x2f4f4f),                            \
      COLOUR(darkturquoise, 0x00ced1), COLOUR(darkviolet, 0x9400d3), COLOUR(deeppink, 0xff1493),   \
      COLOUR(deepskyblue, 0x00bfff), COLOUR(dimgray, 0x696969), COLOUR(dimgrey, 0x696969),         \
      COLOUR(dodgerblue, 0x1e90ff), COLOUR(firebrick, 0xb22222), COLOUR(floralwhite, 0xfffaf0),    \
      COLOUR(forestgreen, 0x228b22), COLOUR(fuchsia, 0xff00ff), COLOUR(gainsboro, 0xdcdcdc),       \
      COLOUR(ghostwhite, 0xf8f8ff), COLOUR(gold, 0xffd700), COLOUR(goldenrod, 0xdaa520),           \
      COLOUR(gray, 0x808080), COLOUR(green, 0x008000), COLOUR(greenyellow, 0xadff2f),              \
      COLOUR(grey, 0x808080), COLOUR(honeydew, 0xf0fff0), COLOUR(hotpink, 0xff69b4),               \
      COLOUR(indianred, 0xcd5c5c), COLOUR(indigo, 0x4b0082), COLOUR(ivory, 0xfffff0),              \
      COLOUR(khaki, 0xf0e68c), COLOUR(lavender, 0xe6e6fa), COLOUR(lavenderblush, 0xfff0f5),        \
      COLOUR(lawngreen, 0x7cfc00), COLOUR(lemonchiffon, 0xfffacd), COLOUR(lightblue, 0xadd8e6),    \
      COLOUR(lightcoral, 0xf08080), COLOUR(lightcyan, 0xe0ffff),                                   \
      COLOUR(lightgoldenrodyellow, 0xfafad2), COLOUR(lightgray, 0xd3d3d3),                         \
      COLOUR(lightgreen, 0x90ee90), COLOUR(lightgrey, 0xd3d3d3), COLOUR(lightpink, 0xffb6c1),      \
      COLOUR(lightsalmon, 0xffa07a), COLOUR(lightseagreen, 0x20b2aa),                              \
      COLOUR(lightskyblue, 0x87cefa), COLOUR(lightslategray, 0x778899),                            \
      COLOUR(lightslategrey, 0x778899), COLOUR(lightsteelblue, 0xb0c4de),                          \
      COLOUR(lightyellow, 0xffffe0), COLOUR(lime, 0x00ff00), COLOUR(limegreen, 0x32cd32),          \
      COLOUR(linen, 0xfaf0e6), COLOUR(magenta, 0xff00ff), COLOUR(maroon, 0x800000),                \
      COLOUR(mediumaquamarine, 0x66cdaa), COLOUR(mediumblue, 0x0000cd),                            \
      COLOUR(mediumorchid, 0xba55d3), COLOUR(mediumpurple, 0x9370db),                              \
      COLOUR(mediumseagreen, 0x3cb371), COLOUR(mediumslateblue, 0x7b68ee),                         \
      COLOUR(mediumspringgreen, 0x00fa9a), COLOUR(mediumturquoise, 0x48d1cc),                      \
      COLOUR(mediumvioletred, 0xc71585), COLOUR(midnightblue, 0x191970),                           \
      COLOUR(mintcream, 0xf5fffa), COLOUR(mistyrose, 0xffe4e1), COLOUR(moccasin, 0xffe4b5),        \
      COLOUR(navajowhite, 0xffdead), COLOUR(navy, 0x000080), COLOUR(oldlace, 0xfdf5e6),            \
      COLOUR(olive, 0x808000), COLOUR(olivedrab, 0x6b8e23), COLOUR(orange, 0xffa500),              \
      COLOUR(orangered, 0xff4500), COLOUR(orchid, 0xda70d6), COLOUR(palegoldenrod, 0xeee8aa),      \
      COLOUR(palegreen, 0x98fb98), COLOUR(paleturquoise, 0xafeeee),                                \
      COLOUR(palevioletred, 0xdb7093), COLOUR(papayawhip, 0xffefd5), COLOUR(peachpuff, 0xffdab9),  \
      COLOUR(peru, 0xcd853f), COLOUR(pink, 0xffc0cb), COLOUR(plum, 0xdda0dd),                      \
      COLOUR(powderblue, 0xb0e0e6), COLOUR(purple, 0x800080), COLOUR(rebeccapurple, 0x663399),     \
      COLOUR(red, 0xff0000), COLOUR(rosybrown, 0xbc8f8f), COLOUR(royalblue, 0x4169e1),             \
      COLOUR(saddlebrown, 0x8b4513), COLOUR(salmon, 0xfa8072), COLOUR(sandybrown, 0xf4a460),       \
      COLOUR(seagreen, 0x2e8b57), COLOUR(seashell, 0xfff5ee), COLOUR(sienna, 0xa0522d),            \
      COLOUR(silver, 0xc0c0c0), COLOUR(skyblue, 0x87ceeb), COLOUR(slateblue, 0x6a5acd),            \
      COLOUR(slategray, 0x708090), COLOUR(slategrey, 0x708090), COLOUR(snow, 0xfffafa),            \
      COLOUR(springgreen, 0x00ff7f), COLOUR(steelblue, 0x4682b4), COLOUR(tan, 0xd2b48c),           \
      COLOUR(teal, 0x008080), COLOUR(thistle, 0xd8bfd8), COLOUR(tomato, 0xff6347),                 \
      COLOUR(turquoise, 0x40e0d0), COLOUR(violet, 0xee82ee), COLOUR(wheat, 0xf5deb3),              \
      COLOUR(white, 0xffffff), COLOUR(whitesmoke, 0xf5f5f5), COLOUR(yellow, 0xffff00),             \
      COLOUR(yellowgreen, 0x9acd32)

#define COLOUR(name, rgb)                                                                          \
  { #name, rgb }
static const struct named_colour {
  const char *name;
  uint32_t rgb;
} named_colours[] = {COLOUR_LIST(COLOUR)};

#undef COLOUR
#define COLOUR(name, rgb) #name
const char *const *cs_svg_colour_names(size_t *count) {
  static const char *const names[] = {COLOUR_LIST(COLOUR)};
  *count = sizeof names / sizeof *names;
  return names;
}

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
