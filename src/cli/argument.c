/* Readers of option values. */
#include "cli/argument.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "celspan/celspan.h"
#include "colour/transfer.h"

typedef struct choice {
  const char *name;
  int value;
} choice;

#define CHOOSE(text, field, choices)                                                               \
  choose(text, field, choices, sizeof(choices) / sizeof((choices)[0]))

static cs_argument_outcome choose(const char *text, void *field, const choice *choices,
                                  size_t count) {
  for (size_t i = 0; i < count; i++) {
    if (strcmp(text, choices[i].name) != 0)
      continue;
    memcpy(field, &choices[i].value, sizeof choices[i].value);
    return CS_ARGUMENT_READ;
  }
  return CS_ARGUMENT_BAD;
}

/* strtol and its like skip what space stands before a number; here nothing may. */
static bool has_space(const char *text) { return isspace((unsigned char)text[0]) != 0; }

/* Reads `count` whole numbers in [least, most] with `separator` between them, and nothing else. */
static bool read_integers(const char *text, char separator, int64_t least, int64_t most,
                          int32_t *out, size_t count) {
  for (size_t i = 0; i < count; i++) {
    char *end = NULL;
    errno = 0;
    long long number = strtoll(text, &end, 10);
    bool is_last = i + 1 == count;
    if (end == text || has_space(text) || errno || number < least || number > most)
      return false;
    if (*end != (is_last ? '\0' : separator))
      return false;
    out[i] = (int32_t)number;
    text = end + 1;
  }
  return true;
}

static bool read_number(const char *text, double *out) {
  char *end = NULL;
  double number = strtod(text, &end);
  if (end == text || *end || has_space(text) || !isfinite(number))
    return false;
  *out = number;
  return true;
}

cs_argument_outcome cs_argument_text(const char *text, void *field) {
  if (!text[0])
    return CS_ARGUMENT_BAD;
  *(const char **)field = text;
  return CS_ARGUMENT_READ;
}

/* A whole number that may be given. */
static cs_argument_outcome read_given(const char *text, int32_t least, int32_t most, void *field) {
  int32_t value = 0;
  if (!read_integers(text, 0, least, most, &value, 1))
    return CS_ARGUMENT_BAD;
  *(cs_given_integer *)field = (cs_given_integer){true, value};
  return CS_ARGUMENT_READ;
}

cs_argument_outcome cs_argument_integer(const char *text, void *field) {
  return read_given(text, -INT32_MAX, INT32_MAX, field);
}

cs_argument_outcome cs_argument_every(const char *text, void *field) {
  return read_given(text, 1, INT32_MAX, field);
}

cs_argument_outcome cs_argument_grid(const char *text, void *field) {
  int32_t grid[2];
  if (!read_integers(text, 'x', 1, 100, grid, 2))
    return CS_ARGUMENT_BAD;
  memcpy(field, grid, sizeof grid);
  return CS_ARGUMENT_READ;
}

cs_argument_outcome cs_argument_onion(const char *text, void *field) {
  int32_t onion[2];
  if (!read_integers(text, ',', 0, 16, onion, 2) || onion[0] + onion[1] == 0)
    return CS_ARGUMENT_BAD;
  memcpy(field, onion, sizeof onion);
  return CS_ARGUMENT_READ;
}

cs_argument_outcome cs_argument_share(const char *text, void *field) {
  int32_t share[2];
  if (!read_integers(text, '/', 1, INT32_MAX, share, 2) || share[0] > share[1])
    return CS_ARGUMENT_BAD;
  memcpy(field, share, sizeof share);
  return CS_ARGUMENT_READ;
}

cs_argument_outcome cs_argument_workers(const char *text, void *field) {
  return read_integers(text, 0, 1, 1024, field, 1) ? CS_ARGUMENT_READ : CS_ARGUMENT_BAD;
}

cs_argument_outcome cs_argument_count(const char *text, void *field) {
  return read_given(text, 0, INT32_MAX, field);
}

cs_argument_outcome cs_argument_memory(const char *text, void *field) {
  return read_given(text, 0, 1048576, field);
}

cs_argument_outcome cs_argument_quality(const char *text, void *field) {
  return read_given(text, 0, 100, field);
}

cs_argument_outcome cs_argument_number(const char *text, void *field) {
  return read_number(text, field) ? CS_ARGUMENT_READ : CS_ARGUMENT_BAD;
}

cs_argument_outcome cs_argument_scale(const char *text, void *field) {
  double number = 0;
  if (!read_number(text, &number) || number <= 0 || number > CS_SIDE_MAX)
    return CS_ARGUMENT_BAD;
  *(double *)field = number;
  return CS_ARGUMENT_READ;
}

cs_argument_outcome cs_argument_tolerance(const char *text, void *field) {
  double number = 0;
  if (!read_number(text, &number) || number < 0)
    return CS_ARGUMENT_BAD;
  *(double *)field = number;
  return CS_ARGUMENT_READ;
}

cs_argument_outcome cs_argument_size(const char *text, void *field) {
  int32_t size[2];
  if (!read_integers(text, 'x', 1, CS_SIDE_MAX, size, 2))
    return CS_ARGUMENT_BAD;
  memcpy(field, size, sizeof size);
  return CS_ARGUMENT_READ;
}

cs_argument_outcome cs_argument_crop(const char *text, void *field) {
  int32_t crop[4];
  if (!read_integers(text, ',', 0, CS_SIDE_MAX, crop, 4) || !crop[2] || !crop[3])
    return CS_ARGUMENT_BAD;
  memcpy(field, crop, sizeof crop);
  return CS_ARGUMENT_READ;
}

cs_argument_outcome cs_argument_rows(const char *text, void *field) {
  int32_t rows[2];
  if (!read_integers(text, '-', 0, CS_SIDE_MAX - 1, rows, 2) || rows[0] > rows[1])
    return CS_ARGUMENT_BAD;
  memcpy(field, rows, sizeof rows);
  return CS_ARGUMENT_READ;
}

/* KERNEL[:ROWS]: the part before the colon names the kernel. */
cs_argument_outcome cs_argument_antialias(const char *text, void *field) {
  static const choice modes[] = {{"area", CELSPAN_ANTIALIAS_AREA},
                                 {"none", CELSPAN_ANTIALIAS_NONE}};
  static const choice kernels[] = {{"box", CELSPAN_KERNEL_BOX},
                                   {"gaussian", CELSPAN_KERNEL_GAUSSIAN},
                                   {"mitchell", CELSPAN_KERNEL_MITCHELL},
                                   {"lanczos", CELSPAN_KERNEL_LANCZOS}};
  cs_given_antialias given = {.is_given = true, .mode = CELSPAN_ANTIALIAS_FILTER};
  char name[16];
  size_t length = strcspn(text, ":");
  int32_t rows = 0;
  if (length >= sizeof name)
    return CS_ARGUMENT_BAD;
  memcpy(name, text, length);
  name[length] = '\0';
  if (CHOOSE(text, &given.mode, modes) != CS_ARGUMENT_READ) {
    if (CHOOSE(name, &given.filter.kernel, kernels) != CS_ARGUMENT_READ)
      return CS_ARGUMENT_BAD;
    if (text[length] && !read_integers(text + length + 1, '\0', 1, 256, &rows, 1))
      return CS_ARGUMENT_BAD;
    given.filter.rows = rows;
  }
  memcpy(field, &given, sizeof given);
  return CS_ARGUMENT_READ;
}

cs_argument_outcome cs_argument_depth(const char *text, void *field) {
  static const choice choices[] = {{"8", CELSPAN_DEPTH_8},
                                   {"16", CELSPAN_DEPTH_16},
                                   {"half", CELSPAN_DEPTH_HALF},
                                   {"float", CELSPAN_DEPTH_FLOAT}};
  return CHOOSE(text, field, choices);
}

cs_argument_outcome cs_argument_colour(const char *text, void *field) {
  static const choice choices[] = {{"srgb", CELSPAN_TRANSFER_SRGB},
                                   {"linear", CELSPAN_TRANSFER_LINEAR},
                                   {"rec709", CELSPAN_TRANSFER_REC709},
                                   {"cineon", CELSPAN_TRANSFER_CINEON}};
  return CHOOSE(text, field, choices);
}

cs_argument_outcome cs_argument_alpha(const char *text, void *field) {
  static const choice choices[] = {{"straight", CELSPAN_ALPHA_STRAIGHT},
                                   {"premultiplied", CELSPAN_ALPHA_PREMULTIPLIED}};
  return CHOOSE(text, field, choices);
}

cs_argument_outcome cs_argument_layout(const char *text, void *field) {
  static const choice choices[] = {{"dzi", CS_PYRAMID_DZI}, {"iiif", CS_PYRAMID_IIIF}};
  return CHOOSE(text, field, choices);
}

/* "r,g,b": numbers, 0 or more. */
static bool read_triple(const char *text, float rgb[3]) {
  for (int c = 0; c < 3; c++) {
    char *end;
    double value = strtod(text, &end);
    if (end == text || has_space(text) || !(value >= 0 && value <= 1e6) ||
        *end != (c < 2 ? ',' : '\0'))
      return false;
    rgb[c] = (float)value;
    text = end + 1;
  }
  return true;
}

cs_argument_outcome cs_argument_light(const char *text, void *field) {
  cs_given_light light = {.is_given = true};
  cs_given_colour colour;
  if (cs_argument_tint(text, &colour) == CS_ARGUMENT_READ)
    memcpy(light.rgb, colour.rgb, sizeof light.rgb);
  else if (!read_triple(text, light.rgb))
    return CS_ARGUMENT_BAD;
  *(cs_given_light *)field = light;
  return CS_ARGUMENT_READ;
}

cs_argument_outcome cs_argument_lamp(const char *text, void *field) {
  cs_given_light light = {.is_given = true, .is_grey = true};
  if (strcmp(text, "grey") != 0) {
    if (cs_argument_light(text, &light) != CS_ARGUMENT_READ ||
        !(light.rgb[0] > 0 && light.rgb[1] > 0 && light.rgb[2] > 0))
      return CS_ARGUMENT_BAD;
  }
  *(cs_given_light *)field = light;
  return CS_ARGUMENT_READ;
}

cs_argument_outcome cs_argument_tint(const char *text, void *field) {
  celspan_paint paint;
  if (!celspan_paint_parse(text, &paint) || paint.beta != 1)
    return CS_ARGUMENT_BAD;
  *(cs_given_colour *)field =
      (cs_given_colour){true, {paint.pigment[0], paint.pigment[1], paint.pigment[2]}};
  return CS_ARGUMENT_READ;
}

/* The sRGB codes of an opaque colour, up to a comma or the end; what follows it, NULL: there is none
 * such. */
static const char *read_code(const char *text, unsigned char code[3]) {
  char name[10] = {0};
  celspan_paint paint;
  size_t size = strcspn(text, ",");
  if (size >= sizeof name)
    return NULL;
  memcpy(name, text, size);
  if (!celspan_paint_parse(name, &paint) || paint.beta != 1)
    return NULL;
  for (int c = 0; c < 3; c++)
    code[c] = cs_transfer_srgb8(paint.pigment[c]);
  return text + size;
}

cs_argument_outcome cs_argument_colours(const char *text, void *field) {
  cs_given_colours given = {.has_codes = true};
  const int32_t most = sizeof given.codes / 3;
  if (text[0] != '#') {
    given.has_codes = false;
    if (!read_integers(text, 0, 1, most, &given.count, 1))
      return CS_ARGUMENT_BAD;
    *(cs_given_colours *)field = given;
    return CS_ARGUMENT_READ;
  }
  for (const char *rest = text; rest; rest = *rest == ',' ? rest + 1 : NULL) {
    rest = given.count < most ? read_code(rest, given.codes + 3 * given.count) : NULL;
    if (!rest)
      return CS_ARGUMENT_BAD;
    given.count++;
  }
  *(cs_given_colours *)field = given;
  return CS_ARGUMENT_READ;
}

cs_argument_outcome cs_argument_smooth(const char *text, void *field) {
  double number = 0;
  if (!read_number(text, &number) || number < 0 || number > 16)
    return CS_ARGUMENT_BAD;
  *(double *)field = number;
  return CS_ARGUMENT_READ;
}

cs_argument_outcome cs_argument_model(const char *text, void *field) {
  if (strcmp(text, "translation") != 0 && strcmp(text, "similarity") != 0 &&
      strcmp(text, "perspective") != 0)
    return CS_ARGUMENT_BAD;
  return cs_argument_text(text, field);
}

cs_argument_outcome cs_argument_progress(const char *text, void *field) {
  static const choice choices[] = {{"auto", CS_PROGRESS_AUTO},   {"bar", CS_PROGRESS_BAR},
                                   {"lines", CS_PROGRESS_LINES}, {"none", CS_PROGRESS_NONE},
                                   {"json", CS_PROGRESS_JSON},   {"openjd", CS_PROGRESS_OPENJD}};
  return CHOOSE(text, field, choices);
}

/* ---------------------------------------------------------------- a script's rights */

cs_argument_outcome cs_argument_texts(const char *text, void *field) {
  cs_given_texts *given = field;
  if (!text[0] || given->count == CS_TEXTS_MOST)
    return CS_ARGUMENT_BAD;
  given->items[given->count++] = text;
  return CS_ARGUMENT_READ;
}

/* A number of 0 or more with one of the letters behind it, each 1024 times the one before; up to
 * `end`. */
static bool read_amount(const char *text, const char *end, const char *letters, double *out) {
  char *after = NULL;
  double number = text < end && !has_space(text) ? strtod(text, &after) : -1;
  if (!after || after == text || after > end || !(number >= 0 && number <= 1e15))
    return false;
  const char *letter = after < end ? strchr(letters, *after) : NULL;
  if (after + (letter != NULL) != end)
    return false;
  for (ptrdiff_t i = letter ? letter - letters : -1; i >= 0; i--)
    number *= 1024;
  *out = number;
  return number <= 1e15;
}

static void set_limit(cs_given_limits *out, int index, double value) {
  switch (index) {
  case 0:
    out->has_picture_memory = true, out->picture_memory = (uint64_t)value;
    break;
  case 1:
    out->has_picture_time = true, out->picture_seconds = value;
    break;
  case 2:
    out->has_memory = true, out->values.memory = (size_t)value;
    break;
  case 3:
    out->has_steps = true, out->values.steps = (uint64_t)value;
    break;
  case 4:
    out->has_time = true, out->values.seconds = value;
    break;
  default:
    out->has_print = true, out->values.print = (size_t)value;
  }
}

enum { LIMITS = 6, PICTURE_LIMITS = 2 };

/* count: of the names that are known, from the first one on. */
static bool read_limit(const char *text, const char *end, int count, cs_given_limits *out) {
  static const struct limit {
    const char *name, *letters;
    double most;
  } known[LIMITS] = {{"picture-memory=", "KMG", 1e15},
                     {"picture-time=", "", 1e6},
                     {"memory=", "KMG", 1e15},
                     {"steps=", "", 1e15},
                     {"time=", "", 1e6},
                     {"print=", "KMG", 1e15}};
  double value = 0;
  int i = 0;
  while (i < count && strncmp(text, known[i].name, strlen(known[i].name)) != 0)
    i++;
  if (i == count || !read_amount(text + strlen(known[i].name), end, known[i].letters, &value) ||
      value > known[i].most)
    return false;
  set_limit(out, i, value);
  return true;
}

static cs_argument_outcome read_limits(const char *text, int count, void *field) {
  cs_given_limits given = *(cs_given_limits *)field;
  for (const char *end;; text = end + 1) {
    end = text + strcspn(text, ",");
    if (!read_limit(text, end, count, &given))
      return CS_ARGUMENT_BAD;
    if (!*end)
      break;
  }
  *(cs_given_limits *)field = given;
  return CS_ARGUMENT_READ;
}

cs_argument_outcome cs_argument_limits(const char *text, void *field) {
  return read_limits(text, LIMITS, field);
}

cs_argument_outcome cs_argument_picture_limits(const char *text, void *field) {
  return read_limits(text, PICTURE_LIMITS, field);
}
