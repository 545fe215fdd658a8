/* One row of a raw picture as R'G'B'A. */
#include <math.h>

#include "plugins/footage/raw.h"

/* One plane. */
typedef struct plane {
  const unsigned char *at;
  int32_t width, height;
  int bits;
} plane;

static int32_t halved(int32_t size, int32_t by) { return (size + by - 1) / by; }

static size_t bytes_of(const plane *p) {
  return (size_t)p->width * (size_t)p->height * (p->bits > 8 ? 2 : 1);
}

/* Plane 0: light, or green; 1 and 2: colour; 3: alpha. */
static plane plane_of(const cs_raw *planes, const unsigned char *picture, int number) {
  plane found = {picture, planes->width, planes->height, planes->bits};
  for (int i = 0; i < number; i++) {
    bool is_colour = i == 1 || i == 2;
    if (is_colour && !planes->has_colour)
      continue;
    found.width = is_colour ? halved(planes->width, planes->across) : planes->width;
    found.height = is_colour ? halved(planes->height, planes->down) : planes->height;
    found.at += bytes_of(&found);
  }
  bool is_colour = number == 1 || number == 2;
  found.width = is_colour ? halved(planes->width, planes->across) : planes->width;
  found.height = is_colour ? halved(planes->height, planes->down) : planes->height;
  return found;
}

static int32_t held(int32_t value, int32_t size) {
  return value < 0 ? 0 : value >= size ? size - 1 : value;
}

static float sample(const plane *p, int32_t x, int32_t y) {
  size_t place = (size_t)y * (size_t)p->width + (size_t)x;
  if (p->bits == 8)
    return (float)p->at[place];
  return (float)(p->at[2 * place] | p->at[2 * place + 1] << 8);
}

/* The two samples around a pixel along an axis, and the share of the second one. */
typedef struct between {
  int32_t first, second;
  float share;
} between;

static between around(int32_t pixel, int32_t step, float site, int32_t size) {
  if (step == 1)
    return (between){pixel, pixel, 0};
  float place = ((float)pixel - site) / (float)step;
  int32_t first = (int32_t)floorf(place);
  return (between){held(first, size), held(first + 1, size), place - (float)first};
}

static float mixed(float a, float b, float share) { return a + (b - a) * share; }

/* The colour at column x, on the way from row to row. */
static float colour_at(const cs_raw *planes, const plane *p, int32_t x, const between *down) {
  between along = around(x, planes->across, planes->site_x, p->width);
  float upper =
      mixed(sample(p, along.first, down->first), sample(p, along.second, down->first), along.share);
  if (down->share == 0)
    return upper;
  float lower = mixed(sample(p, along.first, down->second), sample(p, along.second, down->second),
                      along.share);
  return mixed(upper, lower, down->share);
}

/* How codes become numbers: light from 0 to 1, and colour from -.5 to .5. */
typedef struct scale {
  float black, light, middle, colour;
} scale;

static scale scale_of(const cs_raw *planes) {
  const float unit = (float)(1 << (planes->bits - 8)), most = (float)((1 << planes->bits) - 1);
  if (planes->is_full)
    return (scale){0, 1 / most, 128 * unit, 1 / most};
  return (scale){16 * unit, 1 / (219 * unit), 128 * unit, 1 / (224 * unit)};
}

/* Light and two colours in out[0..2] to R'G'B'. */
static void decode(const cs_raw *planes, float *out) {
  const float red = planes->red, blue = planes->blue, green = 1 - red - blue;
  float y = out[0], cb = out[1], cr = out[2];
  out[0] = y + 2 * (1 - red) * cr;
  out[2] = y + 2 * (1 - blue) * cb;
  out[1] = y - 2 * (1 - blue) * blue / green * cb - 2 * (1 - red) * red / green * cr;
}

static void put_grey(const plane *light, const scale *by, int32_t x, int32_t y, int32_t count,
                     float *out) {
  for (int32_t i = 0; i < count; i++)
    for (int c = 0; c < 3; c++)
      out[4 * i + c] = (sample(light, x + i, y) - by->black) * by->light;
}

/* Planes are in the order green, blue, red. */
static void put_rgb(const plane *all, const scale *by, int32_t x, int32_t y, int32_t count,
                    float *out) {
  static const int places[] = {1, 2, 0};
  for (int c = 0; c < 3; c++)
    for (int32_t i = 0; i < count; i++)
      out[4 * i + places[c]] = (sample(&all[c], x + i, y) - by->black) * by->light;
}

static void put_colour(const cs_raw *planes, const plane *all, const scale *by, int32_t x,
                       int32_t y, int32_t count, float *out) {
  const between down = around(y, planes->down, planes->site_y, all[1].height);
  for (int32_t i = 0; i < count; i++) {
    out[4 * i] = (sample(&all[0], x + i, y) - by->black) * by->light;
    for (int c = 1; c < 3; c++)
      out[4 * i + c] = (colour_at(planes, &all[c], x + i, &down) - by->middle) * by->colour;
    decode(planes, out + 4 * i);
  }
}

void cs_raw_row(const cs_raw *planes, const unsigned char *picture, int32_t x, int32_t y,
                int32_t count, float *out) {
  const float unit = 1 / (float)((1 << planes->bits) - 1);
  const scale by = scale_of(planes);
  plane all[4];
  for (int i = 0; i < 4; i++)
    all[i] = plane_of(planes, picture, i);
  if (planes->is_rgb)
    put_rgb(all, &by, x, y, count, out);
  else if (planes->has_colour)
    put_colour(planes, all, &by, x, y, count, out);
  else
    put_grey(&all[0], &by, x, y, count, out);
  for (int32_t i = 0; i < count; i++)
    out[4 * i + 3] = planes->has_alpha ? sample(&all[3], x + i, y) * unit : 1;
}
