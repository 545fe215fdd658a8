/* Light removed from pictures: R = S F + T I, solved at every pixel and for every channel.
 *
 *   one picture     S = R / F                           T = 1 - alpha
 *   two exposures   S = R1 / F                          T = R2 / I
 *   two grounds     S = (R1 - T I1) / F                 T = (R1 - R2) / (I1 - I2)
 *
 * In the last two beta is 1 less the greatest T: any beta from the greatest S to that shows the
 * same in every light. S may be above 1, where something shines or the light was estimated too low;
 * it is kept, so that the picture in its own light is the picture.
 *
 * Measured pictures have noise, so S and T are clamped to possible values; where more than a few
 * pixels are far from them, the given lights cannot be right, which is an error.
 */
#include "celspan/relight.h"
#include "inside/number.h"
#include "inside/scene.h"
#include "tools/relight/light_field.h"
#include "tools/relight/original.h"

/* The greatest value that surfaces may hold. */
#define MOST 65504.0
/* By how much noise may put T outside 0..1, or S below 0. */
#define NOISE 0.02
/* The share of values that may be farther off, such as glints or a hair that moved. */
#define FEW 0.01
/* Backgrounds that differ by less give no information about the artwork in front of them. */
#define LEAST_CONTRAST 0.02

/* Impossible values, each of one channel of a pixel. */
typedef struct doubts {
  int64_t count;
  double worst, distance; /* the worst value, and how far it is outside its range */
  int32_t x, y;
  int channel;
} doubts;

static void doubt(doubts *d, double distance, double value, int32_t x, int32_t y, int channel) {
  d->count++;
  if (distance > d->distance)
    *d = (doubts){d->count, value, distance, x, y, channel};
}

static bool are_many(const doubts *d, const celspan_picture_info *info) {
  return (double)d->count > FEW * 3 * (double)info->width * (double)info->height;
}

/* A share of light, clamped to 0..1. */
static double share(doubts *d, double value, int32_t x, int32_t y, int channel) {
  double off = value < 0 ? -value : value - 1;
  if (off > NOISE)
    doubt(d, off, value, x, y, channel);
  return cs_number_clamp(value, 0, 1);
}

static celspan_status fail_share(celspan_context *context, const doubts *d, const char *name,
                                 const char *advice) {
  return cs_fail(
      context, CELSPAN_BAD_ARGUMENT,
      "%s: %lld values are impossible in this light: at pixel %d,%d, %.3g times as much %s comes "
      "through as fell on it; %s",
      name, (long long)d->count, d->x, d->y, d->worst, cs_light_field_channel(d->channel), advice);
}

/* S of a pixel; a value below 0 becomes 0. */
static float scattered(doubts *too_bright, double value, int32_t x, int32_t y, int channel) {
  if (value > MOST)
    doubt(too_bright, value, value, x, y, channel);
  return (float)cs_number_clamp(value, 0, MOST);
}

static celspan_status check_bright(celspan_context *context, const doubts *d,
                                   const cs_picture *picture) {
  if (d->count == 0)
    return CELSPAN_OK;
  return cs_fail(
      context, CELSPAN_BAD_ARGUMENT,
      "%s: the light is too dim: at pixel %d,%d the picture has %.3g times as much %s; at most "
      "%g times is possible",
      cs_picture_name(picture), d->x, d->y, d->worst, cs_light_field_channel(d->channel), MOST);
}

/* ---------------------------------------------------------------- rows of several pictures */

#define MOST_ORIGINALS 4

/* Pictures of one size that are read side by side. */
typedef struct originals {
  cs_original list[MOST_ORIGINALS];
  int count;
} originals;

static void close_all(celspan_context *context, originals *all) {
  for (int i = 0; i < all->count; i++)
    cs_original_close(context, &all->list[i]);
  all->count = 0;
}

/* Adds an original, unless it has another size. */
static celspan_status open_one(celspan_context *context, const celspan_texture *texture,
                               originals *all) {
  CS_TRY(cs_original_open(context, "relight", texture, &all->list[all->count]));
  all->count++;
  return cs_original_same_size(context, &all->list[0], &all->list[all->count - 1]);
}

/* Solves the rows that were read. */
typedef struct solver solver;
struct solver {
  originals all;
  cs_unlit unlit;
  const celspan_light_field *front, *back; /* back: if there are exposures */
  const celspan_relight_ground *grounds;
  int ground_index[2]; /* the indices of the pictures of the grounds; 0: the ground is a colour */
  doubts bright, shares;
  void (*row)(solver *s, int32_t y);
};

static celspan_status solve(celspan_context *context, solver *s) {
  int32_t height = s->all.list[0].info.height;
  for (int32_t first = 0; first < height; first += CS_ORIGINAL_ROWS) {
    for (int i = 0; i < s->all.count; i++)
      CS_TRY(cs_original_read(context, &s->all.list[i], first));
    for (int32_t y = first; y < cs_original_end(&s->all.list[0], first); y++)
      s->row(s, y);
  }
  return check_bright(context, &s->bright, s->all.list[0].picture);
}

static cs_light_row row_of(const solver *s, const celspan_light_field *field, int32_t y) {
  return cs_light_row_make(field, s->unlit.width, s->unlit.height, y);
}

/* beta of a pixel whose T is known. */
static float beta_of(const float t[4]) {
  float most = t[0] > t[1] ? t[0] : t[1];
  return 1 - (most > t[2] ? most : t[2]);
}

/* Solves, makes the texture, then closes and frees everything. status: the result of opening the
 * pictures. advice: what may be the cause of impossible shares. */
static celspan_status finish(celspan_context *context, solver *s, celspan_status status,
                             const celspan_texture *like, const char *advice,
                             celspan_texture **out) {
  const cs_original *first = &s->all.list[0];
  if (status == CELSPAN_OK)
    status =
        cs_unlit_create(context, first->info.width, first->info.height, advice != NULL, &s->unlit);
  if (status == CELSPAN_OK)
    status = solve(context, s);
  if (status == CELSPAN_OK && are_many(&s->shares, &first->info))
    status = fail_share(context, &s->shares, cs_picture_name(s->all.list[s->all.count - 1].picture),
                        advice);
  close_all(context, &s->all);
  if (status == CELSPAN_OK)
    return cs_unlit_finish(context, &s->unlit, like, out);
  cs_unlit_discard(context, &s->unlit);
  return status;
}

/* ---------------------------------------------------------------- one picture */

static void picture_row(solver *s, int32_t y) {
  cs_light_row front = row_of(s, s->front, y);
  for (int32_t x = 0; x < s->unlit.width; x++) {
    const float *light = cs_original_at(&s->all.list[0], x, y);
    float *paint = cs_unlit_paint(&s->unlit, x, y);
    double f[3];
    cs_light_row_at(&front, x, f);
    for (int c = 0; c < 3; c++)
      paint[c] = scattered(&s->bright, (double)light[c] / f[c], x, y, c);
    paint[3] = light[3];
  }
}

celspan_status celspan_relight_picture(celspan_context *context, const celspan_texture *picture,
                                       const celspan_light_field *light, celspan_texture **out) {
  CS_TRY(cs_light_field_check(context, "relight", light));
  solver s = {.front = light, .row = picture_row};
  celspan_status status = open_one(context, picture, &s.all);
  return finish(context, &s, status, picture, NULL, out);
}

/* ---------------------------------------------------------------- two exposures */

static void exposures_row(solver *s, int32_t y) {
  cs_light_row front = row_of(s, s->front, y), back = row_of(s, s->back, y);
  for (int32_t x = 0; x < s->unlit.width; x++) {
    const float *lit = cs_original_at(&s->all.list[0], x, y);
    const float *through = cs_original_at(&s->all.list[1], x, y);
    float *paint = cs_unlit_paint(&s->unlit, x, y), *medium = cs_unlit_medium(&s->unlit, x, y);
    double f[3], i[3];
    cs_light_row_at(&front, x, f);
    cs_light_row_at(&back, x, i);
    for (int c = 0; c < 3; c++) {
      paint[c] = scattered(&s->bright, (double)lit[c] / f[c], x, y, c);
      medium[c] = (float)share(&s->shares, (double)through[c] / i[c], x, y, c);
    }
    medium[3] = 1;
    paint[3] = beta_of(medium);
  }
}

celspan_status celspan_relight_exposures(celspan_context *context, const celspan_texture *front,
                                         const celspan_light_field *front_light,
                                         const celspan_texture *back,
                                         const celspan_light_field *back_light,
                                         celspan_texture **out) {
  CS_TRY(cs_light_field_check(context, "relight: front", front_light));
  CS_TRY(cs_light_field_check(context, "relight: back", back_light));
  solver s = {.front = front_light, .back = back_light, .row = exposures_row};
  celspan_status status = open_one(context, front, &s.all);
  if (status == CELSPAN_OK)
    status = open_one(context, back, &s.all);
  return finish(context, &s, status, front, "the light behind must have been brighter", out);
}

/* ---------------------------------------------------------------- two grounds */

static double ground_at(const solver *s, int i, int32_t x, int32_t y, int c) {
  int index = s->ground_index[i];
  return index > 0 ? (double)cs_original_at(&s->all.list[index], x, y)[c] : s->grounds[i].colour[c];
}

/* One channel of a pixel. If the grounds are alike, it is unknown: this is counted as a value that
 * is far off. */
static void solve_grounds(solver *s, int32_t x, int32_t y, int c, double f, float *paint,
                          float *medium) {
  double r1 = (double)cs_original_at(&s->all.list[0], x, y)[c];
  double r2 = (double)cs_original_at(&s->all.list[1], x, y)[c];
  double i1 = ground_at(s, 0, x, y, c), i2 = ground_at(s, 1, x, y, c);
  double t = share(&s->shares, (r1 - r2) / (i1 - i2), x, y, c);
  double lit = ((r1 - t * i1) + (r2 - t * i2)) / 2;
  if (lit < -NOISE)
    doubt(&s->shares, -lit, (r1 - r2) / (i1 - i2), x, y, c);
  paint[c] = scattered(&s->bright, lit / f, x, y, c);
  medium[c] = (float)t;
}

static void grounds_row(solver *s, int32_t y) {
  cs_light_row front = row_of(s, s->front, y);
  for (int32_t x = 0; x < s->unlit.width; x++) {
    float *paint = cs_unlit_paint(&s->unlit, x, y), *medium = cs_unlit_medium(&s->unlit, x, y);
    double f[3];
    cs_light_row_at(&front, x, f);
    for (int c = 0; c < 3; c++)
      solve_grounds(s, x, y, c, f[c], paint, medium);
    medium[3] = 1;
    paint[3] = beta_of(medium);
  }
}

static celspan_status open_grounds(celspan_context *context, solver *s) {
  CS_TRY(open_one(context, s->grounds[0].picture, &s->all));
  CS_TRY(open_one(context, s->grounds[1].picture, &s->all));
  for (int i = 0; i < 2; i++)
    if (s->grounds[i].ground) {
      CS_TRY(open_one(context, s->grounds[i].ground, &s->all));
      s->ground_index[i] = s->all.count - 1;
    }
  return CELSPAN_OK;
}

static celspan_status check_contrast_at(celspan_context *context, const solver *s, int32_t x,
                                        int32_t y) {
  for (int c = 0; c < 3; c++) {
    double first = ground_at(s, 0, x, y, c), second = ground_at(s, 1, x, y, c);
    if (!(fabs(first - second) >= LEAST_CONTRAST))
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "relight: both grounds have the same %s, %.3g and %.3g at pixel %d,%d, so how "
                     "much of it comes through cannot be known; they must differ by %g or more",
                     cs_light_field_channel(c), first, second, x, y, LEAST_CONTRAST);
  }
  return CELSPAN_OK;
}

/* Checks that the grounds differ everywhere. */
static celspan_status check_contrast(celspan_context *context, solver *s) {
  const celspan_picture_info *info = &s->all.list[0].info;
  if (s->ground_index[0] == 0 && s->ground_index[1] == 0)
    return check_contrast_at(context, s, 0, 0);
  for (int32_t first = 0; first < info->height; first += CS_ORIGINAL_ROWS) {
    for (int i = 2; i < s->all.count; i++)
      CS_TRY(cs_original_read(context, &s->all.list[i], first));
    for (int32_t y = first; y < cs_original_end(&s->all.list[0], first); y++)
      for (int32_t x = 0; x < info->width; x++)
        CS_TRY(check_contrast_at(context, s, x, y));
  }
  return CELSPAN_OK;
}

static celspan_status check_grounds(celspan_context *context,
                                    const celspan_relight_ground grounds[2]) {
  CS_TRY(cs_check_given(context, "relight", "grounds", grounds));
  for (size_t i = 0; i < 2; i++)
    for (int c = 0; c < 3; c++)
      if (!grounds[i].ground)
        CS_TRY(cs_check_item(context, (cs_check_field){"relight", "grounds", i + 1, "colour"},
                             grounds[i].colour[c], 0, MOST));
  return CELSPAN_OK;
}

celspan_status celspan_relight_grounds(celspan_context *context,
                                       const celspan_relight_ground grounds[2],
                                       const celspan_light_field *light, celspan_texture **out) {
  CS_TRY(cs_light_field_check(context, "relight", light));
  CS_TRY(check_grounds(context, grounds));
  solver s = {.front = light, .grounds = grounds, .row = grounds_row};
  celspan_status status = open_grounds(context, &s);
  if (status == CELSPAN_OK)
    status = check_contrast(context, &s);
  return finish(context, &s, status, grounds[0].picture,
                "the grounds, or the light in front, must have been different in the two "
                "pictures",
                out);
}
