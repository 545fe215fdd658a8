#include "readers/svg/motion/motion_values.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "inside/number.h"
#include "readers/svg/words/colours.h"
#include "readers/svg/words/offset.h"
#include "readers/svg/words/transforms.h"

const char cs_svg_colour_frame[] = "colour";

/* A value that is being read: its frame and its numbers, whose memory is taken before. */
typedef struct reader {
  cs_svg_mixed *out;
  char *frame;
  size_t size;
} reader;

/* ---------------------------------------------------------------- reading */

static void put(reader *r, char c) { r->frame[r->size++] = c; }

static void put_number(reader *r, double value, const char *unit) {
  cs_svg_mixed_number *number = &r->out->numbers[r->out->count++];
  *number = (cs_svg_mixed_number){.value = value};
  snprintf(number->unit, sizeof number->unit, "%s", unit);
  put(r, '#');
}

/* A number with its unit; absolute lengths become px. */
static bool take_number(reader *r, const char **text) {
  const char *at = *text, *end;
  cs_svg_length length;
  double value;
  if (!cs_svg_take_number(&at, &value))
    return false;
  end = at;
  if (cs_svg_take_length(text, &length) && length.unit == CS_SVG_UNIT_NUMBER) {
    put_number(r, length.value, "");
    return true;
  }
  char unit[8] = "";
  while (*end == '%' || (*end >= 'a' && *end <= 'z') || (*end >= 'A' && *end <= 'Z'))
    end++;
  if ((size_t)(end - at) >= sizeof unit)
    return false;
  memcpy(unit, at, (size_t)(end - at));
  put_number(r, value, unit);
  *text = end;
  return true;
}

static bool may_begin_number(const char *text, const char *at) {
  char before = at > text ? at[-1] : ' ';
  return cs_svg_is_space(before) || before == ',' || before == '(' || before == ')' ||
         before == '%';
}

/* Any text: false if it refers to something. Spaces and commas do not count. */
static bool read_any(reader *r, const char *text) {
  for (const char *at = text; *at;) {
    if (*at == '#' || *at == '"' || strncasecmp(at, "url(", 4) == 0)
      return false;
    if (may_begin_number(text, at) && take_number(r, &at))
      continue;
    if (!cs_svg_is_space(*at) && *at != ',')
      put(r, *at);
    at++;
  }
  return true;
}

/* ---------------------------------------------------------------- paths */

/* The number of numbers after a letter of path data; -1: it is no such letter. */
static int path_numbers(char letter) {
  switch (letter | 32) {
  case 'm':
  case 'l':
  case 't':
    return 2;
  case 'h':
  case 'v':
    return 1;
  case 'c':
    return 6;
  case 's':
  case 'q':
    return 4;
  case 'a':
    return 7;
  case 'z':
    return 0;
  default:
    return -1;
  }
}

/* Number i after a letter: the flags of an arc are single digits. */
static bool take_path_number(reader *r, const char **text, char letter, int i) {
  const char *at = cs_svg_skip_comma(*text);
  double value;
  if ((letter | 32) == 'a' && (i == 3 || i == 4)) {
    if (*at != '0' && *at != '1')
      return false;
    value = *at++ - '0';
  } else if (!cs_svg_take_number(&at, &value))
    return false;
  put_number(r, value, "");
  *text = at;
  return true;
}

/* Every piece gets its letter. */
static bool read_path(reader *r, const char *text) {
  char letter = 0;
  for (text = cs_svg_skip_space(text); *text; text = cs_svg_skip_comma(text)) {
    if (path_numbers(*text) >= 0)
      letter = *text++;
    else if (path_numbers(letter) <= 0)
      return false;
    put(r, letter);
    for (int i = 0; i < path_numbers(letter); i++)
      if (!take_path_number(r, &text, letter, i))
        return false;
    letter = letter == 'M' ? 'L' : letter == 'm' ? 'l' : letter;
  }
  return true;
}

/* The style d: path("..."), as far as it is data. */
static bool read_data(reader *r, const char *text) {
  size_t size = strlen(text);
  if (strncmp(text, "path(", 5) != 0)
    return read_path(r, text);
  char inside[4096];
  const char *begin = strpbrk(text, "\"'"), *end = begin ? strrchr(text, *begin) : NULL;
  if (!begin || end == begin || size >= sizeof inside)
    return false;
  memcpy(inside, begin + 1, (size_t)(end - begin) - 1);
  inside[end - begin - 1] = 0;
  return read_path(r, inside);
}

static void put_text(reader *r, const char *text) {
  for (; *text; text++)
    put(r, *text);
}

/* path("...") as a whole. */
static bool read_way(reader *r, const char *text) {
  const char *data;
  size_t size;
  if (!cs_svg_parse_way(text, &data, &size) || size == 0)
    return false;
  put_text(r, "path(\"");
  bool is_read = read_data(r, text);
  put_text(r, "\")");
  return is_read;
}

/* The direction of a path and an angle, also where one of them is left out. */
static bool read_heading(reader *r, const char *text) {
  bool follows;
  double degrees;
  if (!cs_svg_parse_heading(text, &follows, &degrees))
    return false;
  put_text(r, follows ? "auto " : "");
  put_number(r, degrees, "deg");
  return true;
}

/* ---------------------------------------------------------------- colours and transforms */

static bool read_colour(reader *r, const char *text) {
  cs_svg_colour colour;
  text = cs_svg_skip_space(text);
  if (!cs_svg_take_colour(&text, &colour) || *cs_svg_skip_space(text))
    return false;
  for (int i = 0; i < 3; i++)
    put_number(r, colour.rgb[i], "");
  put_number(r, colour.alpha, "");
  return true;
}

/* Functions that are the same with other arguments: the pair of which they are a half. */
static const struct {
  const char *name, *whole;
  int place; /* the place of the argument; the other is `rest` */
  double rest;
} halves[] = {{"translateX", "translate", 0, 0}, {"translateY", "translate", 1, 0},
              {"scaleX", "scale", 0, 1},         {"scaleY", "scale", 1, 1},
              {"translate", "translate", 0, 0},  {"scale", "scale", 0, 1},
              {"rotateZ", "rotate", 0, 0},       {"rotate", "rotate", 0, 0}};

/* The arguments of a function, without its parentheses; angles in degrees. */
static bool read_arguments(reader *r, const char **text) {
  const char *at = *text;
  for (at = cs_svg_skip_space(at); *at && *at != ')'; at = cs_svg_skip_comma(at)) {
    double degrees;
    const char *angle = at, *length = at;
    cs_svg_length read;
    if (!cs_svg_take_length(&length, &read) && cs_svg_take_angle(&angle, &degrees)) {
      put_number(r, degrees, "deg");
      at = angle;
    } else if (!take_number(r, &at))
      return false;
  }
  *text = at + (*at == ')');
  return true;
}

/* Puts a half in its place among two numbers. */
static void complete(reader *r, size_t first, size_t half) {
  cs_svg_mixed_number *numbers = &r->out->numbers[first];
  if (r->out->count - first != 1 || strcmp(halves[half].whole, "rotate") == 0)
    return;
  cs_svg_mixed_number rest = {.value = halves[half].rest};
  if (strcmp(halves[half].name, "scale") == 0)
    rest = numbers[0];
  put_number(r, 0, "");
  numbers[1] = halves[half].place == 0 ? rest : numbers[0];
  numbers[0] = halves[half].place == 0 ? numbers[0] : rest;
}

static bool read_transform(reader *r, const char *text) {
  text = cs_svg_skip_space(text);
  if (cs_svg_is_word(text, "none"))
    return true;
  for (; *text; text = cs_svg_skip_comma(text)) {
    size_t size = strcspn(text, "( \t\r\n"), half = 0, most = sizeof halves / sizeof *halves;
    while (half < most &&
           (strlen(halves[half].name) != size || strncasecmp(halves[half].name, text, size) != 0))
      half++;
    const char *name = half < most ? halves[half].whole : text;
    for (size_t i = 0; i < (half < most ? strlen(name) : size); i++)
      put(r, name[i]);
    text = cs_svg_skip_space(text + size);
    if (*text++ != '(')
      return false;
    size_t first = r->out->count;
    put(r, '(');
    if (!read_arguments(r, &text))
      return false;
    if (half < most)
      complete(r, first, half);
    put(r, ')');
  }
  return true;
}

/* ---------------------------------------------------------------- values */

static bool is_word_only(cs_svg_name name) {
  return name == CS_SVG_CLASS || name == CS_SVG_HREF || name == CS_SVG_DISPLAY ||
         name == CS_SVG_FONT_FAMILY || name == CS_SVG_IN || name == CS_SVG_IN2 ||
         name == CS_SVG_RESULT || name == CS_SVG_PRESERVE_ASPECT_RATIO ||
         (name < CS_SVG_NAME_COUNT && cs_svg_name_facts_of(name)->form == CS_SVG_FORM_WORD);
}

static bool read_value(reader *r, cs_svg_name name, const char *text) {
  cs_svg_form form =
      name < CS_SVG_NAME_COUNT ? cs_svg_name_facts_of(name)->form : CS_SVG_FORM_LENGTHS;
  if (is_word_only(name))
    return false;
  if (form == CS_SVG_FORM_COLOUR || form == CS_SVG_FORM_PAINT)
    return read_colour(r, text);
  if (form == CS_SVG_FORM_TRANSFORM)
    return read_transform(r, text);
  if (form == CS_SVG_FORM_WAY)
    return read_way(r, text);
  if (form == CS_SVG_FORM_HEADING)
    return read_heading(r, text);
  return name == CS_SVG_D ? read_data(r, text) : read_any(r, text);
}

celspan_status cs_svg_mixed_read(const cs_css_place *place, cs_svg_name name, const char *text,
                                 cs_svg_mixed *out) {
  /* A number takes a byte at least, half of a function of transform, with one more, many, and a
   * colour may have three for four. */
  size_t size = strlen(text), most = size + 4;
  *out = (cs_svg_mixed){.text = text};
  if (size > CS_SVG_MIXED_NUMBERS)
    return CELSPAN_OK;
  out->numbers = cs_arena_take(place->context, place->arena, most * sizeof *out->numbers);
  reader r = {out, cs_arena_take(place->context, place->arena, 4 * most + 16), 0};
  if (!out->numbers || !r.frame)
    return CELSPAN_NO_MEMORY;
  bool is_read = read_value(&r, name, text);
  r.frame[r.size] = 0;
  bool is_colour = is_read && name < CS_SVG_NAME_COUNT &&
                   (cs_svg_name_facts_of(name)->form == CS_SVG_FORM_COLOUR ||
                    cs_svg_name_facts_of(name)->form == CS_SVG_FORM_PAINT);
  bool is_none = name < CS_SVG_NAME_COUNT && r.size == 0 &&
                 cs_svg_name_facts_of(name)->form == CS_SVG_FORM_TRANSFORM;
  if (is_read && (out->count > 0 || is_none))
    out->frame = is_colour ? cs_svg_colour_frame : r.frame;
  return CELSPAN_OK;
}

celspan_status cs_svg_mixed_fit(const cs_css_place *place, const double *fallbacks, size_t count,
                                cs_svg_mixed *value) {
  static const char places[] = "######";
  cs_svg_mixed_number *numbers =
      cs_arena_take(place->context, place->arena, count * sizeof *numbers);
  if (!numbers)
    return CELSPAN_NO_MEMORY;
  for (size_t i = 0; i < count; i++)
    numbers[i] =
        (cs_svg_mixed_number){.value = i < value->count ? value->numbers[i].value : fallbacks[i]};
  value->numbers = numbers;
  value->count = count;
  value->frame = places + (sizeof places - 1 - count);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- sums */

bool cs_svg_mixed_fits(const cs_svg_mixed *a, const cs_svg_mixed *b) {
  if (!a->frame || !b->frame || strcmp(a->frame, b->frame) != 0 || a->count != b->count)
    return false;
  for (size_t i = 0; i < a->count; i++) {
    const cs_svg_mixed_number *x = &a->numbers[i], *y = &b->numbers[i];
    if (strcmp(x->unit, y->unit) != 0 && !(x->value == 0 && !*x->unit) &&
        !(y->value == 0 && !*y->unit))
      return false;
  }
  return true;
}

/* a times p + b times q; *out may be one of them. */
static celspan_status sum(const cs_css_place *place, const cs_svg_mixed *a, double p,
                          const cs_svg_mixed *b, double q, cs_svg_mixed *out) {
  const cs_svg_mixed_number *x = a->numbers, *y = b->numbers;
  cs_svg_mixed made = {.frame = a->frame, .count = a->count};
  made.numbers = cs_arena_take(place->context, place->arena, a->count * sizeof *made.numbers);
  if (!made.numbers)
    return CELSPAN_NO_MEMORY;
  for (size_t i = 0; i < a->count; i++) {
    made.numbers[i] = *x[i].unit ? x[i] : y[i];
    made.numbers[i].value = x[i].value * p + y[i].value * q;
  }
  *out = made;
  return CELSPAN_OK;
}

/* Multiplies the channels of a colour by its alpha, or divides them. */
static void weigh(cs_svg_mixed_number *numbers, bool divides) {
  double alpha = numbers[3].value;
  for (int i = 0; i < 3; i++)
    numbers[i].value = !divides    ? numbers[i].value * alpha
                       : alpha > 0 ? numbers[i].value / alpha
                                   : 0;
}

celspan_status cs_svg_mixed_mix(const cs_css_place *place, const cs_svg_mixed *a,
                                const cs_svg_mixed *b, double share, bool premultiplied,
                                cs_svg_mixed *out) {
  cs_svg_mixed_number first[4], second[4];
  cs_svg_mixed from = *a, to = *b;
  bool weighs = premultiplied && a->frame == cs_svg_colour_frame;
  if (weighs) {
    memcpy(first, a->numbers, sizeof first);
    memcpy(second, b->numbers, sizeof second);
    weigh(first, false);
    weigh(second, false);
    from.numbers = first;
    to.numbers = second;
  }
  CS_TRY(sum(place, &from, 1 - share, &to, share, out));
  if (weighs)
    weigh(out->numbers, true);
  return CELSPAN_OK;
}

celspan_status cs_svg_mixed_add(const cs_css_place *place, const cs_svg_mixed *a,
                                const cs_svg_mixed *b, double times, cs_svg_mixed *out) {
  double alpha = a->frame == cs_svg_colour_frame ? a->numbers[3].value : 0;
  CS_TRY(sum(place, a, 1, b, times, out));
  if (a->frame == cs_svg_colour_frame)
    out->numbers[3].value = alpha;
  return CELSPAN_OK;
}

double cs_svg_mixed_distance(const cs_svg_mixed *a, const cs_svg_mixed *b) {
  double squares = 0;
  if (!cs_svg_mixed_fits(a, b))
    return 0;
  for (size_t i = 0; i < a->count; i++) {
    double way = b->numbers[i].value - a->numbers[i].value;
    squares += way * way;
  }
  return sqrt(squares);
}

/* ---------------------------------------------------------------- texts */

/* A decimal point whatever the locale of the host is. */
static size_t print(char *text, const cs_svg_mixed_number *number) {
  int size = snprintf(text, 32, " %.12g%s", number->value, number->unit);
  for (char *at = text; *at; at++)
    *at = *at == ',' ? '.' : *at;
  return (size_t)size;
}

static size_t print_colour(char *text, size_t most, const cs_svg_mixed_number *numbers) {
  double codes[4];
  for (int i = 0; i < 4; i++)
    codes[i] = cs_number_clamp(numbers[i].value, 0, 1);
  size_t size = (size_t)snprintf(text, most, "rgba(%.6f;%.6f;%.6f;%.6f)", codes[0] * 255,
                                 codes[1] * 255, codes[2] * 255, codes[3]);
  for (char *at = text; *at; at++)
    *at = *at == ',' ? '.' : *at == ';' ? ',' : *at;
  return size;
}

celspan_status cs_svg_mixed_write(const cs_css_place *place, const cs_svg_mixed *value,
                                  const char **out) {
  *out = value->text;
  if (*out)
    return CELSPAN_OK;
  for (size_t i = 0; i < value->count; i++)
    if (!cs_number_is_sane(value->numbers[i].value))
      return CELSPAN_OK;
  size_t most = strlen(value->frame) + value->count * 40 + 64, size = 0, number = 0;
  char *text = cs_arena_take(place->context, place->arena, most);
  if (!text)
    return CELSPAN_NO_MEMORY;
  text[0] = 0;
  if (value->frame == cs_svg_colour_frame)
    print_colour(text, most, value->numbers);
  else
    for (const char *at = value->frame; *at; at++) {
      if (*at == '#')
        size += print(text + size, &value->numbers[number++]);
      else
        text[size++] = *at;
      text[size] = 0;
    }
  *out = *text ? text : "none"; /* transforms without functions */
  return CELSPAN_OK;
}
