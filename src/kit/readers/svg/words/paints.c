#include "readers/svg/words/paints.h"

#include <string.h>

static bool take_paint_colour(const char **text, cs_svg_paint *out) {
  if (cs_svg_take_word(text, "none"))
    out->kind = CS_SVG_PAINT_NONE;
  else if (cs_svg_take_word(text, "currentColor"))
    out->kind = CS_SVG_PAINT_CURRENT;
  else if (cs_svg_take_colour(text, &out->colour))
    out->kind = CS_SVG_PAINT_COLOUR;
  else
    return false;
  return true;
}

bool cs_svg_parse_paint(const char *text, cs_svg_paint *out) {
  *out = (cs_svg_paint){.kind = CS_SVG_PAINT_NONE};
  text = cs_svg_skip_space(text);
  out->has_server = cs_svg_take_reference(&text, &out->server);
  text = cs_svg_skip_space(text);
  bool has_colour = *text && take_paint_colour(&text, out);
  out->has_fallback = out->has_server && has_colour;
  /* Only an ICC profile may follow, and it is skipped. */
  text = cs_svg_skip_space(text);
  return out->has_server || (has_colour && (!*text || strncmp(text, "icc-color", 9) == 0));
}

bool cs_svg_parse_order(const char *text, cs_svg_layer out[3]) {
  static const char *const words[] = {"fill", "stroke", "markers"};
  bool is_named[3] = {false, false, false};
  int count = 0;
  text = cs_svg_skip_space(text);
  if (cs_svg_take_word(&text, "normal"))
    text = cs_svg_skip_space(text);
  for (; *text; text = cs_svg_skip_space(text)) {
    int layer = 0;
    while (layer < 3 && !cs_svg_take_word(&text, words[layer]))
      layer++;
    if (layer == 3 || is_named[layer])
      return false;
    is_named[layer] = true;
    out[count++] = (cs_svg_layer)layer;
  }
  for (int layer = 0; layer < 3; layer++)
    if (!is_named[layer])
      out[count++] = (cs_svg_layer)layer;
  return true;
}
