#include "plugins/footage/raw.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HIGH = 720 /* rows from which a movie without a tag is treated as BT.709 */ };

/* ---------------------------------------------------------------- what codes mean */

static const float BT601[] = {.299f, .114f}, BT709[] = {.2126f, .0722f},
                   BT2020[] = {.2627f, .0593f};

const float *cs_raw_matrix(const char *name, int32_t height) {
  static const struct {
    const char *name;
    const float *shares;
  } known[] = {{"bt709", BT709},
               {"bt470bg", BT601},
               {"smpte170m", BT601},
               {"bt2020nc", BT2020},
               {"gbr", BT709}};
  if (!*name || strcmp(name, "unknown") == 0 || strcmp(name, "unspecified") == 0)
    return height >= HIGH ? BT709 : BT601;
  for (size_t i = 0; i < sizeof known / sizeof *known; i++)
    if (strcmp(name, known[i].name) == 0)
      return known[i].shares;
  return NULL;
}

const char *cs_raw_matrix_taken(const cs_raw *planes, const char *name, int32_t height) {
  const float *shares = cs_raw_matrix(name, height);
  if (planes->is_rgb || !planes->has_colour)
    return "none";
  return shares == BT601 ? "bt601" : shares == BT709 ? "bt709" : "bt2020";
}

void cs_raw_set_range(cs_raw *planes, const char *name) {
  if (strcmp(name, "pc") == 0)
    planes->is_full = true;
  else if (planes->is_rgb)
    planes->is_full = planes->is_made || strcmp(name, "tv") != 0;
}

void cs_raw_set_site(cs_raw *planes, const char *name) {
  bool is_left =
      strcmp(name, "center") != 0 && strcmp(name, "top") != 0 && strcmp(name, "bottom") != 0;
  bool is_top = strncmp(name, "top", 3) == 0, is_bottom = strncmp(name, "bottom", 6) == 0;
  planes->site_x = is_left || planes->across == 1 ? 0 : .5f;
  planes->site_y = is_top || planes->down == 1 ? 0 : is_bottom ? 1 : .5f;
}

/* ---------------------------------------------------------------- forms of pixels */

/* The forms whose planes are read as they are: what comes before the number of bits. */
static const struct {
  const char *name;
  cs_raw form;
} forms[] = {
    {"yuv420p", {.has_colour = true, .across = 2, .down = 2}},
    {"yuv422p", {.has_colour = true, .across = 2, .down = 1}},
    {"yuv444p", {.has_colour = true, .across = 1, .down = 1}},
    {"yuvj420p", {.has_colour = true, .across = 2, .down = 2, .is_full = true}},
    {"yuvj422p", {.has_colour = true, .across = 2, .down = 1, .is_full = true}},
    {"yuvj444p", {.has_colour = true, .across = 1, .down = 1, .is_full = true}},
    {"yuva420p", {.has_colour = true, .across = 2, .down = 2, .has_alpha = true}},
    {"yuva422p", {.has_colour = true, .across = 2, .down = 1, .has_alpha = true}},
    {"yuva444p", {.has_colour = true, .across = 1, .down = 1, .has_alpha = true}},
    {"gbrp", {.has_colour = true, .is_rgb = true, .across = 1, .down = 1}},
    {"gbrap", {.has_colour = true, .is_rgb = true, .across = 1, .down = 1, .has_alpha = true}},
    {"gray", {.across = 1, .down = 1}},
};

/* Forms with the same numbers in another order, and the form of planes that ffmpeg makes of them
 * without changing one. */
static const char *const orders[][2] = {
    {"nv12", "yuv420p"},       {"nv21", "yuv420p"},       {"p010le", "yuv420p10le"},
    {"yuyv422", "yuv422p"},    {"uyvy422", "yuv422p"},    {"rgba", "gbrap"},
    {"bgra", "gbrap"},         {"argb", "gbrap"},         {"abgr", "gbrap"},
    {"pal8", "gbrap"},         {"rgb48le", "gbrp16le"},   {"bgr48le", "gbrp16le"},
    {"rgba64le", "gbrap16le"}, {"bgra64le", "gbrap16le"}, {"ya8", "gbrap"},
    {"ya16le", "gbrap16le"},
};

static bool parse_form(const char *name, cs_raw *out) {
  for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
    size_t length = strlen(forms[i].name);
    if (strncmp(name, forms[i].name, length) != 0)
      continue;
    char *end;
    const char *rest = name + length;
    long bits = *rest ? strtol(rest, &end, 10) : 8;
    if (bits < 8 || bits > 16 || (*rest && strcmp(end, "le") != 0))
      continue;
    *out = forms[i].form;
    out->bits = (int)bits;
    return true;
  }
  return false;
}

/* Planes of R'G'B' that hold what a form has which is not read: names with a letter for alpha have
 * it, and those with an order of bytes have more than 8 bits. */
static const char *nearest_form(const char *name) {
  static const char *const with_alpha[] = {"ya", "yuva", "ayuv", "vuya", "rgba", "bgra", "gbra"};
  bool has_alpha = false, is_deep = strlen(name) > 2 && strcmp(name + strlen(name) - 2, "le") == 0;
  for (size_t i = 0; i < sizeof with_alpha / sizeof *with_alpha; i++)
    has_alpha = has_alpha || strncmp(name, with_alpha[i], strlen(with_alpha[i])) == 0;
  for (size_t i = 0; i < sizeof orders / sizeof *orders; i++)
    if (strcmp(name, orders[i][0]) == 0)
      return orders[i][1];
  return has_alpha ? is_deep ? "gbrap16le" : "gbrap" : is_deep ? "gbrp16le" : "gbrp";
}

bool cs_raw_is_foreign(const char *name) {
  return strncmp(name, "xyz", 3) == 0 || strncmp(name, "bayer", 5) == 0;
}

void cs_raw_parse(const char *name, cs_raw *out, char wanted[16]) {
  size_t length = (size_t)snprintf(wanted, 16, "%s", name);
  if (length > 2 && length < 16 && strcmp(wanted + length - 2, "be") == 0)
    wanted[length - 2] = 'l'; /* the same numbers in the other order of bytes */
  if (parse_form(wanted, out))
    return;
  const char *nearest = nearest_form(wanted);
  bool is_rgb = strstr(wanted, "rgb") || strstr(wanted, "bgr") || strstr(wanted, "gbr");
  (void)!parse_form(nearest, out);
  out->is_made = out->is_rgb && !is_rgb;
  snprintf(wanted, 16, "%s", nearest);
}

/* ---------------------------------------------------------------- sizes */

size_t cs_raw_size(const cs_raw *planes) {
  size_t width = (size_t)planes->width, height = (size_t)planes->height;
  size_t across = (size_t)planes->across, down = (size_t)planes->down;
  size_t colour = (width + across - 1) / across * ((height + down - 1) / down);
  size_t samples = width * height * (planes->has_alpha ? 2 : 1);
  return (samples + (planes->has_colour ? 2 * colour : 0)) * (planes->bits > 8 ? 2 : 1);
}

size_t cs_raw_pixel(const cs_raw *planes) { return planes->bits > 8 ? 8 : 4; }

void cs_raw_upright(const cs_raw *planes, int32_t *width, int32_t *height) {
  *width = planes->turns % 2 ? planes->height : planes->width;
  *height = planes->turns % 2 ? planes->width : planes->height;
}

/* ---------------------------------------------------------------- conversion */

/* A rectangle of the upright picture, in the picture as it is stored. */
static celspan_rectangle stored(const cs_raw *planes, const celspan_rectangle *r) {
  const int32_t width = planes->width, height = planes->height;
  switch (planes->turns) {
  case 1:
    return (celspan_rectangle){r->y, height - r->x - r->width, r->height, r->width};
  case 2:
    return (celspan_rectangle){width - r->x - r->width, height - r->y - r->height, r->width,
                               r->height};
  case 3:
    return (celspan_rectangle){width - r->y - r->height, r->x, r->height, r->width};
  default:
    return *r;
  }
}

/* Where the stored pixel (x, y) of the rectangle's `width` x `height` stored pixels goes. */
static size_t place_of(const cs_raw *planes, const celspan_rectangle *from, int32_t x, int32_t y,
                       size_t stride, size_t pixel) {
  const int32_t last_x = from->width - 1, last_y = from->height - 1;
  const int32_t columns[] = {x, last_y - y, last_x - x, y}, rows[] = {y, x, last_y - y, last_x - x};
  return (size_t)rows[planes->turns] * stride + (size_t)columns[planes->turns] * pixel;
}

/* Writes a row of a picture that is stored turned: its pixels go apart. */
static void put_turned(const cs_raw *planes, const celspan_rectangle *from, int32_t y,
                       const unsigned char *codes, unsigned char *out, size_t stride) {
  const size_t pixel = cs_raw_pixel(planes);
  for (int32_t x = 0; x < from->width; x++)
    memcpy(out + place_of(planes, from, x, y, stride, pixel), codes + (size_t)x * pixel, pixel);
}

celspan_status cs_raw_convert(const cs_raw *planes, celspan_context *context,
                              const unsigned char *picture, const celspan_rectangle *rectangle,
                              unsigned char *out, size_t stride) {
  const celspan_rectangle from = stored(planes, rectangle);
  const size_t row_room = cs_raw_room(from.width), floats = row_room + 2 * (size_t)from.width;
  float *room;
  CS_TRY(CS_MAKE(context, room, floats));
  unsigned char *codes = (unsigned char *)(room + row_room);
  for (int32_t y = 0; y < from.height; y++) {
    unsigned char *row = planes->turns ? codes : out + (size_t)y * stride;
    cs_raw_row(planes, picture, from.x, from.y + y, from.width, room, row);
    if (planes->turns)
      put_turned(planes, &from, y, codes, out, stride);
  }
  cs_mem_free(context->memory, room, floats * sizeof *room);
  return CELSPAN_OK;
}
