#include "program/options/argument.h"

#include <ctype.h>
#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lua/bind/form.h"
#include "writers/apart/apart.h"
#include "writers/parcels/plot.h"
#include "writers/tiles/pyramid.h"

bool cs_argument_read(const cs_argument *kind, const char *text, void *field) {
  return kind->read(kind, text, field);
}

/* ---------------------------------------------------------------- texts */

static bool read_text(const cs_argument *kind, const char *text, void *field) {
  (void)kind;
  if (!text[0])
    return false;
  *(const char **)field = text;
  return true;
}

static bool add_text(const cs_argument *kind, const char *text, void *field) {
  cs_given_texts *given = field;
  (void)kind;
  if (!text[0] || given->count == CS_TEXTS_MOST)
    return false;
  given->items[given->count++] = text;
  return true;
}

/* Reads a name, =, and any text. */
static bool read_setting(const cs_argument *kind, const char *text, void *field) {
  size_t length = strcspn(text, "=");
  (void)kind;
  if (length == 0 || text[length] != '=')
    return false;
  *(const char **)field = text;
  return true;
}

#define TEXT(name, words)                                                                          \
  const cs_argument cs_argument_##name = {.allowed = (words), .read = read_text}

TEXT(text, "a name");
TEXT(file, "the name of a file");
TEXT(folder, "the name of a folder");
TEXT(file_or_folder, "the name of a folder or file");
TEXT(frames, "a list of frames such as 1-10,20-30:2,45, 2s-4s or the name of a mark");
TEXT(format, "the name of a file format such as png");
TEXT(cel, "the name of a cel");
TEXT(colour, "srgb, linear, rec709, cineon, or the name of a colour space");
TEXT(codec, "the name of a codec such as h265");
TEXT(pattern, "a pattern of names");
TEXT(picture, "png or jpg");
TEXT(colours, "a whole number from 1 to 64, or colours like #ffffff,#203040");
TEXT(lamp, "a colour like #ffe0b0, r,g,b with each above 0, or grey");
TEXT(light, "a colour like #203060, or r,g,b");
const cs_argument cs_argument_setting = {.allowed = "NAME=VALUE", .read = read_setting};
const cs_argument cs_argument_texts = {.allowed = "the name of a folder; at most 48 can be given",
                                       .read = add_text};

/* ---------------------------------------------------------------- numbers */

/* strtol and strtod skip white space before a number; here it is not allowed. */
static bool has_space(const char *text) { return isspace((unsigned char)text[0]) != 0; }

/* Reads `count` whole numbers with separators between them, and nothing else. */
static bool read_integers(const cs_argument *kind, const char *text, int32_t *out, size_t count) {
  for (size_t i = 0; i < count; i++) {
    char *end = NULL;
    errno = 0;
    long long number = strtoll(text, &end, 10);
    bool is_last = i + 1 == count;
    if (end == text || has_space(text) || errno || (double)number < kind->least ||
        (double)number > kind->most)
      return false;
    if (*end != (is_last ? '\0' : kind->separator))
      return false;
    out[i] = (int32_t)number;
    text = end + 1;
  }
  return true;
}

static bool read_integer(const cs_argument *kind, const char *text, void *field) {
  return read_integers(kind, text, field, 1);
}

static bool take_pair(const int32_t pair[2], bool is_right, void *field) {
  if (is_right)
    memcpy(field, pair, 2 * sizeof *pair);
  return is_right;
}

static bool read_pair(const cs_argument *kind, const char *text, void *field) {
  int32_t pair[2];
  return take_pair(pair, read_integers(kind, text, pair, 2), field);
}

static bool read_range(const cs_argument *kind, const char *text, void *field) {
  int32_t pair[2];
  return take_pair(pair, read_integers(kind, text, pair, 2) && pair[0] <= pair[1], field);
}

/* I/N, or env or env/N. */
static bool read_task(const cs_argument *kind, const char *text, void *field) {
  int32_t task[2] = {0}, count = 0;
  if (strncmp(text, "env", 3) != 0)
    return read_range(kind, text, field);
  bool is_right = !text[3] || (text[3] == '/' && read_integers(kind, text + 4, &count, 1));
  return take_pair(task, is_right && cs_task_find(count, task), field);
}

static bool read_onion(const cs_argument *kind, const char *text, void *field) {
  int32_t pair[2];
  return take_pair(pair, read_integers(kind, text, pair, 2) && pair[0] + pair[1] > 0, field);
}

static bool read_crop(const cs_argument *kind, const char *text, void *field) {
  int32_t crop[4];
  if (!read_integers(kind, text, crop, 4) || !crop[2] || !crop[3])
    return false;
  memcpy(field, crop, sizeof crop);
  return true;
}

static bool read_number(const cs_argument *kind, const char *text, void *field) {
  char *end = NULL;
  double number = strtod(text, &end);
  if (end == text || *end || has_space(text) || !(number >= kind->least && number <= kind->most))
    return false;
  *(double *)field = number;
  return true;
}

/* N or N/M, such as 30000/1001. */
static bool read_rate(const cs_argument *kind, const char *text, void *field) {
  double parts[2] = {0, 1};
  char *end = NULL;
  parts[0] = strtod(text, &end);
  if (end == text || has_space(text))
    return false;
  if (*end == '/') {
    const char *below = end + 1;
    parts[1] = strtod(below, &end);
    if (end == below || has_space(below))
      return false;
  }
  double rate = parts[0] / parts[1];
  if (*end || !(rate >= kind->least && rate <= kind->most))
    return false;
  *(double *)field = rate;
  return true;
}

/* A number of bytes, also in thousands, millions or thousands of millions. */
static bool read_millions(const cs_argument *kind, const char *text, void *field) {
  static const char units[] = "kMG";
  char *end = NULL;
  double number = strtod(text, &end);
  const char *unit = *end ? strchr(units, *end) : NULL;
  if (end == text || has_space(text) || (*end && (!unit || end[1])))
    return false;
  if (unit)
    number *= pow(1000, (double)(unit - units + 1));
  if (!(number >= kind->least && number <= kind->most))
    return false;
  *(double *)field = number;
  return true;
}

static bool read_positive(const cs_argument *kind, const char *text, void *field) {
  double number = 0;
  if (!read_number(kind, text, &number) || number == 0)
    return false;
  *(double *)field = number;
  return true;
}

#define NUMBERS(name, words, reader, low, high, sign)                                              \
  const cs_argument cs_argument_##name = {                                                         \
      .allowed = (words), .read = (reader), .least = (low), .most = (high), .separator = (sign)}

NUMBERS(integer, "the number of a frame", read_integer, -INT32_MAX, INT32_MAX, 0);
NUMBERS(every, "a whole number, 1 or more", read_integer, 1, INT32_MAX, 0);
NUMBERS(mebibytes, "a whole number of MiB, 1 or more", read_integer, 1, INT32_MAX, 0);
NUMBERS(minutes, "a whole number of minutes, 1 or more", read_integer, 1, INT32_MAX, 0);
NUMBERS(count, "a whole number", read_integer, 0, INT32_MAX, 0);
NUMBERS(pixels, "a whole number of pixels, 0 or more", read_integer, 0, INT32_MAX, 0);
NUMBERS(tile, "a whole number of pixels, 16 to 8192", read_integer, 0, INT32_MAX, 0);
NUMBERS(workers, "a whole number from 1 to 1024", read_integer, 1, 1024, 0);
NUMBERS(port, "the number of a port, 1 to 65535", read_integer, 1, 65535, 0);
NUMBERS(memory, "a whole number of MiB from 0 to 1048576", read_integer, 0, 1048576, 0);
NUMBERS(quality, "a whole number from 0 to 100", read_integer, 0, 100, 0);
NUMBERS(crf, "a whole number from 0 to 63", read_integer, 0, 63, 0);
NUMBERS(millions, "at least 10,000 bytes, such as 500k, 8M, 1.5G (in thousands) or 8000000",
        read_millions, 10000, 1e15, 0);
NUMBERS(rate, "frames per second from 0.01 to 1000, such as 25 or 30000/1001", read_rate, 0.01,
        1000, 0);
NUMBERS(precision, "a whole number from 0 to 9", read_integer, 0, 9, 0);
NUMBERS(plays, "a whole number from 0 to 65535", read_integer, 0, 65535, 0);
NUMBERS(size, "width x height in whole pixels, 1 to 1048576, such as 1920x1080", read_pair, 1,
        CS_SIDE_MAX, 'x');
NUMBERS(grid, "columns x rows, each 1 to 100, such as 6x4", read_pair, 1, 100, 'x');
NUMBERS(onion, "two numbers of frames, 0 to 16, not both 0, such as 2,1", read_onion, 0, 16, ',');
NUMBERS(share, "a number and how many there are, such as 3/24", read_range, 1, INT32_MAX, '/');
NUMBERS(task,
        "a number and how many there are, such as 3/24; nor env, in a task of an array of Slurm, "
        "Grid Engine or AWS Batch; nor env/24, there or in an indexed job of Kubernetes",
        read_task, 1, INT32_MAX, '/');
NUMBERS(rows, "two rows from 0, the first not below the second", read_range, 0, CS_SIDE_MAX - 1,
        '-');
NUMBERS(levels, "two levels from 0, the first not above the second", read_range, 0, CS_SIDE_MAX - 1,
        '-');
NUMBERS(crop, "four whole numbers of pixels, width and height above 0", read_crop, 0, CS_SIDE_MAX,
        ',');
NUMBERS(scale, "a number above 0 such as 0.5", read_positive, 0, CS_SIDE_MAX, 0);
NUMBERS(tolerance, "a number, 0 or more", read_number, 0, DBL_MAX, 0);
NUMBERS(loudness, "LUFS from -60 to 0, such as -14 or -23", read_number, -60, 0, 0);
NUMBERS(smooth, "a number from 0 to 16", read_number, 0, 16, 0);

/* ---------------------------------------------------------------- names */

typedef struct cs_choice {
  const char *name;
  int value;
} cs_choice;

static bool choose(const cs_argument *kind, const char *text, void *field) {
  const cs_choice *choice = kind->choices;
  while (choice->name && strcmp(text, choice->name) != 0)
    choice++;
  if (choice->name)
    memcpy(field, &choice->value, sizeof choice->value);
  return choice->name != NULL;
}

#define CHOICE(name, words, ...)                                                                   \
  const cs_argument cs_argument_##name = {                                                         \
      .allowed = (words), .read = choose, .choices = (const cs_choice[]){__VA_ARGS__, {NULL, 0}}}

CHOICE(depth, "8, 16, half or float", {"8", CELSPAN_DEPTH_8}, {"16", CELSPAN_DEPTH_16},
       {"half", CELSPAN_DEPTH_HALF}, {"float", CELSPAN_DEPTH_FLOAT});
CHOICE(layers, "cels", {"cels", CS_LAYERS_CELS});
CHOICE(mattes, "cels or names", {"cels", CS_APART_MATTES_CELS}, {"names", CS_APART_MATTES_NAMES});
CHOICE(alpha, "straight or premultiplied", {"straight", CELSPAN_ALPHA_STRAIGHT},
       {"premultiplied", CELSPAN_ALPHA_PREMULTIPLIED});
CHOICE(layout, "dzi or iiif", {"dzi", CS_PYRAMID_DZI}, {"iiif", CS_PYRAMID_IIIF});
CHOICE(progress, "auto, bar, lines, none, json or openjd", {"auto", CS_PROGRESS_AUTO},
       {"bar", CS_PROGRESS_BAR}, {"lines", CS_PROGRESS_LINES}, {"none", CS_PROGRESS_NONE},
       {"json", CS_PROGRESS_JSON}, {"openjd", CS_PROGRESS_OPENJD});
CHOICE(fit, "stretch, contain or cover", {"stretch", CS_FIT_STRETCH}, {"contain", CS_FIT_CONTAIN},
       {"cover", CS_FIT_COVER});
CHOICE(flat, "over or regions", {"over", CS_FLAT_OVER}, {"regions", CS_FLAT_REGIONS});
CHOICE(model, "translation, similarity or perspective", {"translation", 0}, {"similarity", 1},
       {"perspective", 2});

/* KERNEL[:ROWS]: the part before the colon names the kernel. */
static bool read_antialias(const cs_argument *kind, const char *text, void *field) {
  static const cs_choice modes[] = {
      {"area", CELSPAN_ANTIALIAS_AREA}, {"none", CELSPAN_ANTIALIAS_NONE}, {NULL, 0}};
  static const cs_argument mode = {.choices = modes};
  static const cs_argument rows = {.least = 1, .most = 256};
  cs_given_antialias given = {CELSPAN_ANTIALIAS_FILTER, CELSPAN_FILTER_DESC};
  char name[16];
  size_t length = strcspn(text, ":");
  if (length >= sizeof name)
    return false;
  memcpy(name, text, length);
  name[length] = '\0';
  if (!choose(&mode, text, &given.mode)) {
    if (!choose(kind, name, &given.filter.kernel))
      return false;
    if (text[length] && !read_integers(&rows, text + length + 1, &given.filter.rows, 1))
      return false;
  }
  memcpy(field, &given, sizeof given);
  return true;
}

const cs_argument cs_argument_antialias = {
    .allowed =
        "'area', 'none', or 'box', 'gaussian', 'mitchell' or 'lanczos' with ':ROWS' (1 to 256) or "
        "without",
    .read = read_antialias,
    .choices = (const cs_choice[]){{"box", CELSPAN_KERNEL_BOX},
                                   {"gaussian", CELSPAN_KERNEL_GAUSSIAN},
                                   {"mitchell", CELSPAN_KERNEL_MITCHELL},
                                   {"lanczos", CELSPAN_KERNEL_LANCZOS},
                                   {NULL, 0}}};

static bool read_tint(const cs_argument *kind, const char *text, void *field) {
  celspan_paint paint;
  (void)kind;
  if (!cs_form_colour(text, &paint) || paint.beta != 1)
    return false;
  memcpy(field, paint.pigment, 3 * sizeof *paint.pigment);
  return true;
}

const cs_argument cs_argument_tint = {.allowed = "a colour like #336699", .read = read_tint};

/* ---------------------------------------------------------------- a script's rights */

/* Reads a number of 0 or more, with an optional letter after it, each of which means 1024 times the
 * previous one; up to `end`. */
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

static bool read_bytes(const cs_argument *kind, const char *text, void *field) {
  double bytes;
  if (!read_amount(text, text + strlen(text), "KMG", &bytes) || bytes < kind->least)
    return false;
  *(double *)field = bytes;
  return true;
}

const cs_argument cs_argument_bytes = {
    .allowed = "a size of at least 1M, such as 512M or 4G", .read = read_bytes, .least = 1 << 20};

/* count: how many of the known limits are allowed, from the first one on. */
static bool read_limit(const char *text, const char *end, size_t count, cs_given_limits *out) {
  static const struct limit {
    const char *name, *letters;
    double most;
  } known[CS_LIMIT_COUNT] = {[CS_LIMIT_PICTURE_MEMORY] = {"picture-memory=", "KMG", 1e15},
                             [CS_LIMIT_PICTURE_TIME] = {"picture-time=", "", 1e6},
                             [CS_LIMIT_MEMORY] = {"memory=", "KMG", 1e15},
                             [CS_LIMIT_STEPS] = {"steps=", "", 1e15},
                             [CS_LIMIT_TIME] = {"time=", "", 1e6},
                             [CS_LIMIT_PRINT] = {"print=", "KMG", 1e15},
                             [CS_LIMIT_RENDER_MEMORY] = {"render-memory=", "KMG", 1e15}};
  size_t i = 0;
  while (i < count && strncmp(text, known[i].name, strlen(known[i].name)) != 0)
    i++;
  if (i == count ||
      !read_amount(text + strlen(known[i].name), end, known[i].letters, &out->values[i]) ||
      out->values[i] > known[i].most)
    return false;
  out->has[i] = true;
  return true;
}

static bool read_limits(const cs_argument *kind, const char *text, void *field) {
  cs_given_limits given = *(cs_given_limits *)field;
  for (const char *end;; text = end + 1) {
    end = text + strcspn(text, ",");
    if (!read_limit(text, end, (size_t)kind->most, &given))
      return false;
    if (!*end)
      break;
  }
  *(cs_given_limits *)field = given;
  return true;
}

const cs_argument cs_argument_limits = {.allowed =
                                            "memory=SIZE, steps=N, time=SECONDS, print=SIZE, "
                                            "render-memory=SIZE, picture-memory=SIZE or "
                                            "picture-time=SECONDS, "
                                            "such as memory=512M,time=60; 0: no limit",
                                        .read = read_limits,
                                        .most = CS_LIMIT_COUNT};
const cs_argument cs_argument_picture_limits = {
    .allowed = "picture-memory=SIZE or picture-time=SECONDS, such as "
               "picture-memory=1G,picture-time=20; 0: no "
               "limit",
    .read = read_limits,
    .most = CS_LIMIT_MEMORY};
