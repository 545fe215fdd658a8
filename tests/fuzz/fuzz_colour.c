/* Any bytes as a colour, in the notations of scripts and of drawings: accepted values are in 0..1,
 * scripts accept only "#" with 3, 6 or 8 hexadecimal digits, and both readers agree on those.
 */
#include "tests/fuzz/target.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

#include "readers/svg/words/colours.h"

static bool is_hexadecimal(const char *text) {
  size_t length = strlen(text);
  if (text[0] != '#' || (length != 4 && length != 7 && length != 9))
    return false;
  for (size_t i = 1; i < length; i++)
    if (!isxdigit((unsigned char)text[i]))
      return false;
  return true;
}

static void check_share(double share) {
  demand(share >= 0 && share <= 1, "a number beyond 0 to 1");
}

static void check_colour(const char *text) {
  const char *end = text;
  cs_svg_colour colour;
  celspan_paint paint;
  bool is_taken = cs_svg_take_colour(&end, &colour);
  demand(end >= text && end <= text + strlen(text), "it reads beyond the end");
  for (int c = 0; c < 3 && is_taken; c++)
    check_share(colour.rgb[c]);
  if (is_taken)
    check_share(colour.alpha);
  bool is_parsed = celspan_paint_parse(text, &paint);
  demand(is_parsed == is_hexadecimal(text), "a colour of scripts is mistaken");
  if (is_parsed)
    demand(is_taken && fabs(colour.alpha - (double)paint.beta) < 1e-6, "two readers differ");
  for (int c = 0; c < 3 && is_parsed; c++)
    check_share((double)paint.pigment[c]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  char *text = calloc(1, size + 1);
  if (size > 0)
    memcpy(text, data, size);
  check_colour(text);
  free(text);
  return 0;
}

#ifdef REPLAY_MAIN
#include "tests/fuzz/replay.h"
#endif
