/* One row of a raw picture as codes of R'G'B'A. */
#include "plugins/footage/raw_row.h"

#include "plugins/footage/raw.h"

#define RUN(name) CS_WIDE_CHOOSE(cs_isa_best(), name)

/* One plane. */
typedef struct plane {
  const unsigned char *at;
  int32_t width, height;
  int bytes; /* the bytes of a sample */
} plane;

static int32_t halved(int32_t size, int32_t by) { return (size + by - 1) / by; }

/* Plane 0: light, or green; 1 and 2: colour; 3: alpha. */
static plane plane_of(const cs_raw *planes, const unsigned char *picture, int number) {
  plane found = {.at = picture};
  for (int i = 0; i <= number; i++) {
    bool is_colour = i == 1 || i == 2;
    found.at += (size_t)found.width * (size_t)found.height * (size_t)found.bytes;
    found.width = is_colour ? halved(planes->width, planes->across) : planes->width;
    found.height = is_colour ? halved(planes->height, planes->down) : planes->height;
    found.bytes = is_colour && !planes->has_colour ? 0 : planes->bits > 8 ? 2 : 1;
  }
  return found;
}

static int32_t held(int32_t value, int32_t size) {
  return value < 0 ? 0 : value >= size ? size - 1 : value;
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

static cs_raw_shares shares_of(const cs_raw *planes) {
  const float red = planes->red, blue = planes->blue, green = 1 - red - blue;
  return (cs_raw_shares){.red_cr = 2 * (1 - red),
                         .blue_cb = 2 * (1 - blue),
                         .green_cb = 2 * (1 - blue) * blue / green,
                         .green_cr = 2 * (1 - red) * red / green};
}

/* Samples [x, x + count) between two rows of a plane, of which those beyond the edges are those of
 * the edges. */
static void widen(const plane *p, const int32_t rows[2], float share, int32_t x, int32_t count,
                  float *out) {
  const int32_t first = held(x, p->width), last = held(x + count - 1, p->width);
  const size_t bytes = (size_t)p->bytes, row = (size_t)p->width * bytes,
               skip = (size_t)first * bytes;
  RUN(cs_raw_widen)
  (p->at + (size_t)rows[0] * row + skip, p->at + (size_t)rows[1] * row + skip, share, p->bytes,
   last - first + 1, out + (first - x));
  for (int32_t i = x; i < first; i++)
    out[i - x] = out[first - x];
  for (int32_t i = last + 1; i < x + count; i++)
    out[i - x] = out[last - x];
}

/* Pixels of a row, from an even one on; count: even. */
typedef struct stretch {
  int32_t x, y, count;
} stretch;

static void put_plane(const plane *p, float black, float by, const stretch *at, float *out) {
  widen(p, (const int32_t[]){at->y, at->y}, 0, at->x, at->count, out);
  RUN(cs_raw_scale)(black, by, at->count, out);
}

/* room: for a row. */
static void put_colour(const cs_raw *planes, const plane *p, const scale *by, const stretch *at,
                       float *room, float *out) {
  const float place = planes->down == 2 ? ((float)at->y - planes->site_y) / 2 : (float)at->y;
  const int32_t upper = (int32_t)floorf(place);
  const int32_t rows[] = {held(upper, p->height), held(upper + 1, p->height)};
  const float share = place - (float)upper;
  const float shares[] = {1 - planes->site_x / 2, .5f - planes->site_x / 2};
  if (planes->across == 1) {
    widen(p, rows, share, at->x, at->count, out);
  } else {
    widen(p, rows, share, at->x / 2 - 1, at->count / 2 + 2, room);
    RUN(cs_raw_spread)(room, shares, at->count / 2, out);
  }
  RUN(cs_raw_scale)(by->middle, by->colour, at->count, out);
}

/* Floats of room for one of the five rows, which may be longer by a pixel at each end. */
static size_t room_of(int32_t count) { return (size_t)count + 8; }

size_t cs_raw_room(int32_t count) { return 5 * room_of(count); }

void cs_raw_row(const cs_raw *planes, const unsigned char *picture, int32_t x, int32_t y,
                int32_t count, float *room, void *out) {
  const scale by = scale_of(planes);
  const cs_raw_shares shares = shares_of(planes);
  const int32_t odd = x % 2;
  const stretch at = {x - odd, y, (count + odd + 1) / 2 * 2};
  const size_t stride = room_of(count);
  float *all[] = {room, room + stride, room + 2 * stride, room + 3 * stride};
  plane p[4];
  for (int i = 0; i < 4; i++)
    p[i] = plane_of(planes, picture, i);
  if (planes->is_rgb) /* stored in the order green, blue, red */
    for (int c = 0; c < 3; c++)
      put_plane(&p[(c + 2) % 3], by.black, by.light, &at, all[c]);
  else
    put_plane(&p[0], by.black, by.light, &at, all[0]);
  if (!planes->is_rgb && planes->has_colour) {
    for (int c = 1; c < 3; c++)
      put_colour(planes, &p[c], &by, &at, room + 4 * stride, all[c]);
    RUN(cs_raw_mix)(&shares, at.count, all[0], all[1], all[2]);
  }
  bool is_grey = !planes->is_rgb && !planes->has_colour;
  if (planes->has_alpha)
    put_plane(&p[3], 0, 1 / (float)((1 << planes->bits) - 1), &at, all[3]);
  else
    for (int32_t i = 0; i < at.count; i++)
      all[3][i] = 1;
  float *const rows[] = {all[0] + odd, (is_grey ? all[0] : all[1]) + odd,
                         (is_grey ? all[0] : all[2]) + odd, all[3] + odd};
  RUN(cs_raw_put)(rows, count, planes->bits > 8, out);
}
