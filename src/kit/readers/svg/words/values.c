#include "readers/svg/words/values.h"

#include <math.h>
#include <string.h>

#include "inside/number.h"

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c; }

const char *cs_svg_skip_space(const char *text) {
  while (cs_svg_is_space(*text))
    text++;
  return text;
}

const char *cs_svg_skip_comma(const char *text) {
  text = cs_svg_skip_space(text);
  return *text == ',' ? cs_svg_skip_space(text + 1) : text;
}

bool cs_svg_take_number(const char **text, double *out) {
  double value;
  const char *end = cs_decimal_read(*text, &value);
  if (!end || !cs_number_is_sane(value))
    return false;
  *text = end;
  *out = value;
  return true;
}

static bool is_word_character(char c) {
  c = lower(c);
  return (c >= 'a' && c <= 'z') || c == '-';
}

bool cs_svg_take_word(const char **text, const char *word) {
  const char *at = *text;
  for (; *word; word++, at++)
    if (lower(*at) != lower(*word))
      return false;
  if (is_word_character(*at))
    return false;
  *text = at;
  return true;
}

bool cs_svg_is_word(const char *text, const char *word) {
  if (!text)
    return false;
  text = cs_svg_skip_space(text);
  return cs_svg_take_word(&text, word) && !*cs_svg_skip_space(text);
}

/* ---------------------------------------------------------------- lengths */

bool cs_svg_take_length(const char **text, cs_svg_length *out) {
  static const struct {
    const char *name;
    cs_svg_unit unit;
    double factor;
  } units[] = {{"px", CS_SVG_UNIT_NUMBER, 1},
               {"pt", CS_SVG_UNIT_NUMBER, 4.0 / 3},
               {"pc", CS_SVG_UNIT_NUMBER, 16},
               {"mm", CS_SVG_UNIT_NUMBER, 96 / 25.4},
               {"cm", CS_SVG_UNIT_NUMBER, 96 / 2.54},
               {"in", CS_SVG_UNIT_NUMBER, 96},
               {"em", CS_SVG_UNIT_EM, 1},
               {"ex", CS_SVG_UNIT_EX, 1},
               {"Q", CS_SVG_UNIT_NUMBER, 24 / 25.4},
               {"rem", CS_SVG_UNIT_REM, 1},
               {"vw", CS_SVG_UNIT_VW, 0.01},
               {"vh", CS_SVG_UNIT_VH, 0.01},
               {"vmin", CS_SVG_UNIT_VMIN, 0.01},
               {"vmax", CS_SVG_UNIT_VMAX, 0.01}};
  const char *at = *text;
  double value;
  if (!cs_svg_take_number(&at, &value))
    return false;
  *out = (cs_svg_length){value, CS_SVG_UNIT_NUMBER};
  if (*at == '%') {
    out->unit = CS_SVG_UNIT_PERCENT;
    at++;
  }
  for (size_t i = 0; is_word_character(*at) && i < sizeof units / sizeof *units; i++)
    if (cs_svg_take_word(&at, units[i].name)) {
      *out = (cs_svg_length){value * units[i].factor, units[i].unit};
      break;
    }
  if (is_word_character(*at))
    return false;
  *text = at;
  return true;
}

bool cs_svg_parse_length(const char *text, cs_svg_length *out) {
  text = cs_svg_skip_space(text);
  return cs_svg_take_length(&text, out) && !*cs_svg_skip_space(text);
}

bool cs_svg_parse_share(const char *text, double *out) {
  text = cs_svg_skip_space(text);
  if (!cs_svg_take_number(&text, out))
    return false;
  if (*text == '%') {
    *out /= 100;
    text++;
  }
  return !*cs_svg_skip_space(text);
}

bool cs_svg_is_unfit(const char *text) {
  double value;
  text = cs_svg_skip_space(text);
  if (cs_decimal_read(text, &value))
    return !cs_number_is_sane(value);
  text += *text == '+' || *text == '-';
  return cs_svg_take_word(&text, "nan") || cs_svg_take_word(&text, "inf") ||
         cs_svg_take_word(&text, "infinity");
}

double cs_svg_resolve(cs_svg_length length, cs_svg_axis axis, const cs_svg_measure *measure) {
  double width = measure->width, height = measure->height;
  switch (length.unit) {
  case CS_SVG_UNIT_EM:
    return length.value * measure->font_size;
  case CS_SVG_UNIT_EX:
    return length.value * measure->font_size * 0.5;
  case CS_SVG_UNIT_REM:
    return length.value * measure->root_font_size;
  case CS_SVG_UNIT_VW:
    return length.value * measure->page_width;
  case CS_SVG_UNIT_VH:
    return length.value * measure->page_height;
  case CS_SVG_UNIT_VMIN:
    return length.value * fmin(measure->page_width, measure->page_height);
  case CS_SVG_UNIT_VMAX:
    return length.value * fmax(measure->page_width, measure->page_height);
  case CS_SVG_UNIT_PERCENT:
    return length.value / 100 *
           (axis == CS_SVG_AXIS_X   ? width
            : axis == CS_SVG_AXIS_Y ? height
                                    : sqrt((width * width + height * height) / 2));
  default:
    return length.value;
  }
}

/* ---------------------------------------------------------------- references */

bool cs_svg_take_reference(const char **text, cs_svg_reference *out) {
  const char *at = *text;
  if (strncmp(at, "url(", 4) != 0)
    return false;
  at = cs_svg_skip_space(at + 4);
  char quote = *at == '"' || *at == '\'' ? *at++ : 0;
  const char *end = at;
  while (*end && *end != quote && *end != ')')
    end++;
  const char *close = strchr(end, ')');
  if (!close)
    return false;
  while (!quote && end > at && cs_svg_is_space(end[-1]))
    end--;
  *out =
      *at == '#' ? (cs_svg_reference){at + 1, (size_t)(end - at - 1)} : (cs_svg_reference){at, 0};
  *text = close + 1;
  return true;
}

/* ---------------------------------------------------------------- viewports */

bool cs_svg_parse_view_box(const char *text, cs_svg_view_box *out) {
  double numbers[4];
  text = cs_svg_skip_space(text);
  for (int i = 0; i < 4; i++, text = cs_svg_skip_comma(text))
    if (!cs_svg_take_number(&text, &numbers[i]))
      return false;
  if (*text || !(numbers[2] > 0) || !(numbers[3] > 0))
    return false;
  *out = (cs_svg_view_box){true, numbers[0], numbers[1], numbers[2], numbers[3]};
  return true;
}

/* Which share of the remaining space is before the content along one axis: 0, 1/2 or 1. word:
 * "xMidYMax". */
static double alignment(const char *word, size_t at) {
  return strncmp(word + at, "Min", 3) == 0 ? 0 : strncmp(word + at, "Max", 3) == 0 ? 1 : 0.5;
}

celspan_matrix cs_svg_fit(const cs_svg_view_box *box, double width, double height,
                          const char *aspect) {
  const char *at = cs_svg_skip_space(aspect ? aspect : "");
  double sx = width / box->width, sy = height / box->height, align_x = 0.5, align_y = 0.5;
  if (cs_svg_take_word(&at, "none"))
    return (celspan_matrix){{sx, 0, -box->x * sx, 0, sy, -box->y * sy, 0, 0, 1}};
  if (strlen(at) >= 8 && at[0] == 'x' && at[4] == 'Y') {
    align_x = alignment(at, 1);
    align_y = alignment(at, 5);
    at = cs_svg_skip_space(at + 8);
  }
  bool is_slice = cs_svg_is_word(at, "slice");
  double scale = is_slice ? fmax(sx, sy) : fmin(sx, sy);
  return (celspan_matrix){{scale, 0, (width - box->width * scale) * align_x - box->x * scale, 0,
                           scale, (height - box->height * scale) * align_y - box->y * scale, 0, 0,
                           1}};
}

/* ---------------------------------------------------------------- variables */

#define LONGEST 4096 /* bytes of a value after variables have been replaced */
#define DEEPEST 16   /* variables inside the values of variables */
#define MOST 1000    /* the most variables in one value, including those in their values */

typedef struct filling {
  const cs_svg_variable *list;
  char text[LONGEST];
  size_t size;
  int depth, count;
} filling;

static void *take(cs_svg_variables *made, size_t size) {
  made->used += size;
  return made->used <= CS_SVG_VARIABLE_BYTES ? cs_arena_take(made->context, made->arena, size)
                                             : NULL;
}

static celspan_status fail(const cs_svg_variables *made) {
  return made->used <= CS_SVG_VARIABLE_BYTES
             ? CELSPAN_NO_MEMORY
             : cs_fail(made->context, CELSPAN_LIMIT,
                       "the variables of the style sheets take more than %zu bytes",
                       CS_SVG_VARIABLE_BYTES);
}

celspan_status cs_svg_variable_add(cs_svg_variables *made, const char *name, const char *value,
                                   const cs_svg_variable **list) {
  cs_svg_variable *added = take(made, sizeof *added);
  if (!added)
    return fail(made);
  *added = (cs_svg_variable){name, value, *list};
  *list = added;
  return CELSPAN_OK;
}

static const char *find(const cs_svg_variable *list, const char *name, size_t size) {
  for (; list; list = list->next)
    if (strncmp(list->name, name, size) == 0 && list->name[size] == 0)
      return list->value;
  return NULL;
}

/* The ')' that closes the parenthesis around `text`, or the end. */
static const char *closing(const char *text, const char *end) {
  int depth = 0;
  for (; text < end && (depth > 0 || *text != ')'); text++)
    depth += (*text == '(') - (*text == ')');
  return text;
}

/* Appends [text, end), with its variables replaced. Recursion: DEEPEST. */
static bool append(filling *f, const char *text, const char *end);

/* Appends the value for the text between the parentheses of var(). */
static bool append_variable(filling *f, const char *text, const char *end) {
  while (text < end && cs_svg_is_space(*text))
    text++;
  const char *name_end = text;
  while (name_end < end && *name_end != ',' && !cs_svg_is_space(*name_end))
    name_end++;
  const char *comma = memchr(name_end, ',', (size_t)(end - name_end));
  const char *value = find(f->list, text, (size_t)(name_end - text));
  if (f->depth >= DEEPEST || f->count++ >= MOST || (!value && !comma))
    return false;
  f->depth++;
  bool is_filled = value ? append(f, value, value + strlen(value)) : append(f, comma + 1, end);
  f->depth--;
  return is_filled;
}

static bool append(filling *f, const char *text, const char *end) {
  while (text < end) {
    if (end - text > 4 && strncmp(text, "var(", 4) == 0) {
      const char *close = closing(text + 4, end);
      if (close == end || !append_variable(f, text + 4, close))
        return false;
      text = close + 1;
    } else if (f->size + 1 < sizeof f->text) {
      f->text[f->size++] = *text++;
    } else {
      return false;
    }
  }
  return true;
}

celspan_status cs_svg_variable_fill(cs_svg_variables *made, const cs_svg_variable *list,
                                    const char *value, const char **out) {
  filling f = {.list = list};
  *out = NULL;
  if (!append(&f, value, value + strlen(value)))
    return CELSPAN_OK;
  char *text = take(made, f.size + 1);
  if (!text)
    return fail(made);
  memcpy(text, f.text, f.size);
  text[f.size] = 0;
  *out = text;
  return CELSPAN_OK;
}
