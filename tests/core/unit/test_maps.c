/* Frames that are drawn from maps: as the sweep draws them, to the bit the same whatever was kept
 * and in whatever order rows are made, and without leaks between cels that abut. One file, because
 * all tests compare the same two ways of drawing.
 */
#include "engine/map/keep.h"
#include "engine/map/turn.h"
#include "frames/render/drawings.h"
#include "frames/render/frame.h"
#include "frames/render/parts.h"
#include "frames/render/ways.h"
#include "model/geometry/matrix.h"
#include "tests/support/frame_rows.h"
#include "tests/support/memory.h"
#include "tests/support/random.h"

#define WIDTH 90
#define HEIGHT 60
#define SCENES 140
#define CROPPED_SCENES 70
#define CROSSING 100
#define SHAPES 80 /* of each cel: enough for maps */

/* What a scene has. PARTED: cels of parts that are moved. MIXED: cels that are swept, too.
 * COLOURED: gels and coloured media. GLAZED: and opaque gradients. */
typedef enum scene_kind {
  STRAIGHT,
  ROUND,
  PARTED,
  VARIED,
  MIXED,
  COLOURED,
  GLAZED,
  KINDS
} scene_kind;

static celspan_paint random_paint(test_random *random) {
  float red = random_unit(random), green = random_unit(random), blue = random_unit(random);
  float alpha = random_below(random, 2) ? 1 : random_unit(random);
  return celspan_paint_rgb(red, green, blue, alpha);
}

/* A paint that lets red, green and blue through each as much as it likes. */
static celspan_paint random_gel(test_random *random) {
  celspan_paint gel = random_paint(random);
  for (int c = 0; c < 3; c++)
    gel.medium[c] = random_unit(random);
  gel.beta = random_below(random, 2) ? 0 : random_unit(random);
  return gel;
}

static celspan_texture *random_texture(studio *s, test_random *random, bool is_varied,
                                       bool is_opaque) {
  celspan_paint paints[3] = {random_paint(random)};
  celspan_point points[3];
  if (!is_varied)
    return studio_paint(s, paints[0]);
  for (int k = 0; k < 3; k++) {
    paints[k] = random_paint(random);
    if (is_opaque)
      paints[k].beta = 1;
    points[k] = random_point(random, 0, WIDTH, 0, HEIGHT);
  }
  if (random_below(random, 3) == 0)
    return studio_gradient(s, points, paints);
  const celspan_stop stops[] = {{0, paints[0]}, {0.3, paints[1]}, {1, paints[2]}};
  return random_below(random, 2)
             ? studio_linear(s, points[0], points[1], stops, 3)
             : studio_radial(s, points[0], random_between(random, 20, 90), stops, 3);
}

static celspan_object *random_object(studio *s, test_random *random, scene_kind kind) {
  bool is_round = kind == ROUND;
  bool has_gels = kind == COLOURED || kind == GLAZED;
  bool is_varied = (kind == VARIED || kind == MIXED || kind == GLAZED) && random_below(random, 3);
  celspan_texture *texture = has_gels && random_below(random, 2)
                                 ? studio_paint(s, random_gel(random))
                                 : random_texture(s, random, is_varied, kind == GLAZED);
  celspan_point corners[3];
  for (int k = 0; k < 3; k++)
    corners[k] = random_point(random, -10, WIDTH + 10, -10, HEIGHT + 10);
  if (is_round)
    return studio_circle(s, corners[0].x, corners[0].y, random_between(random, 3, 30), texture);
  if (random_below(random, 3) == 0) {
    double width = random_between(random, 1, 50), height = random_between(random, 1, 50);
    return studio_rect(s, corners[0].x, corners[0].y, width, height, texture);
  }
  return studio_polygon(s, corners, 3, CELSPAN_RULE_NONZERO, texture);
}

/* An object and enough clear shapes for a map, which nobody can see. */
static celspan_object *with_shapes(studio *s, celspan_object *object) {
  celspan_object *objects[SHAPES];
  celspan_texture *clear = studio_paint(s, celspan_paint_rgb(0, 0, 0, 0));
  objects[0] = studio_rect(s, 20, 20, 1, 1, clear);
  for (int i = 1; i < SHAPES; i++)
    objects[i] = objects[0];
  return studio_pair(s, CELSPAN_OPERATOR_UNION, object,
                     studio_boolean(s, CELSPAN_OPERATOR_UNION, objects, SHAPES));
}

static celspan_object *turned(studio *s, celspan_object *object, double angle) {
  const celspan_point centre = {WIDTH / 2.0, HEIGHT / 2.0};
  return studio_transform(s, object, celspan_matrix_rotation(angle, centre));
}

/* Moves two in three objects of a cel, which become parts, and unites the last ones, which are
 * moved once more. Returns how many there are then. */
static size_t hold_in_parts(studio *s, test_random *random, celspan_object **objects,
                            size_t count) {
  for (size_t i = 0; i < count; i++)
    if (random_below(random, 3))
      objects[i] = turned(s, with_shapes(s, objects[i]), random_between(random, -20, 20));
  size_t first = (size_t)random_below(random, count);
  if (random_below(random, 2))
    return count;
  celspan_object *held = studio_boolean(s, CELSPAN_OPERATOR_UNION, objects + first, count - first);
  objects[first] = random_below(random, 2) ? held : turned(s, held, 30);
  return first + 1;
}

/* Moved, stretched, mirrored, and one in three turned, sheared and tilted, by quarter turns too. */
static celspan_matrix random_place(test_random *random) {
  double x = random_between(random, 0.4, 1.7), y = random_between(random, 0.4, 1.7);
  celspan_matrix matrix = celspan_matrix_scaling(random_below(random, 4) ? x : -x, y);
  const celspan_point centre = {WIDTH / 2.0, HEIGHT / 2.0};
  if (random_below(random, 3) == 0) {
    double angle = random_between(random, -180, 180);
    angle = random_below(random, 2) ? angle : 90 * floor(angle / 90);
    matrix = celspan_matrix_then(matrix, cs_matrix_turn(angle, centre));
    matrix.m[1] += random_below(random, 2) ? 0 : random_between(random, -1, 1);
    double tilt = random_between(random, 0.001, 0.004);
    if (random_below(random, 3) == 0)
      matrix.m[6 + random_below(random, 2)] = tilt;
  }
  matrix.m[2] += random_between(random, 0, WIDTH / 2.0);
  matrix.m[5] += random_between(random, -HEIGHT / 2.0, HEIGHT / 2.0);
  return matrix;
}

/* Which way a cel goes. MAPPED: unless it is behind one that is swept TOGETHER with all that is
 * behind it; RICH: it is mapped, and has more shapes than all others; ALONE: or it is mapped. */
typedef enum cel_way { MAPPED, RICH, ALONE, TOGETHER } cel_way;

/* Makes a cel one that is swept: with a gel or a mode, before or under a light with a shape,
 * defocused; others are as they were. */
static void sweep_cel(studio *s, test_random *random, cel_way way, celspan_cel_desc *desc,
                      celspan_object **first) {
  const celspan_stop stops[] = {{0, celspan_paint_rgb(1, 0.5f, 0, 1)},
                                {1, celspan_paint_rgb(0, 0.5f, 1, 1)}};
  const celspan_point from = {0, 0}, to = {WIDTH, HEIGHT};
  const celspan_paint gel = {{0.1f, 0, 0}, {0.9f, 0.3f, 0.5f}, 0.2f};
  uint64_t kind = way == ALONE ? 3 + random_below(random, 6) : random_below(random, 9);
  if (kind == 0)
    *first = studio_rect(s, 10, 10, 50, 30, studio_paint(s, gel));
  else if (kind == 1)
    desc->blend = CELSPAN_BLEND_MULTIPLY;
  else if (kind == 2)
    desc->back_texture.texture = studio_linear(s, from, to, stops, 2);
  else if (kind == 3)
    desc->front_texture.texture = studio_linear(s, from, to, stops, 2);
  else if (kind < 7)
    desc->defocus_radius = random_between(random, 1, 9);
}

/* A cel of a few shapes, in the light of its own. */
static celspan_cel *random_cel(studio *s, test_random *random, scene_kind kind, cel_way way) {
  celspan_object *objects[5];
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  size_t count = 1 + (size_t)random_below(random, 5);
  if (kind == MIXED && (way == MAPPED || way == RICH) && random_below(random, 2))
    kind = random_below(random, 2) ? COLOURED : GLAZED;
  for (size_t i = 0; i < count; i++)
    objects[i] = random_object(s, random, kind);
  desc.opacity = random_below(random, 3) ? 1 : random_unit(random);
  desc.has_front = random_below(random, 2);
  desc.front = (celspan_light){random_unit(random), 1, 0.5f, 1};
  desc.back = random_below(random, 3) ? desc.back : (celspan_light){0.25f, 0.5f, 0, 0.5f};
  for (int i = 0; i < (way == MAPPED ? 1 : way == RICH ? 4 : 0); i++)
    objects[0] = with_shapes(s, objects[0]);
  if (kind == PARTED)
    count = hold_in_parts(s, random, objects, count);
  if (way == ALONE || way == TOGETHER)
    sweep_cel(s, random, way, &desc, objects);
  const celspan_matrix matrix = random_place(random);
  celspan_cel *cel = studio_cel(s, desc, objects, count), *moved = NULL;
  studio_check(s, celspan_cel_transform(s->context, cel, &matrix, &moved));
  return s->cels[s->cel_count++] = moved;
}

static cel_way random_way(test_random *random, size_t place, size_t rich) {
  if (place == rich)
    return RICH;
  return place > rich ? ALONE : random_below(random, 3) ? TOGETHER : MAPPED;
}

static celspan_rostrum *random_rostrum(studio *s, uint64_t seed, scene_kind kind) {
  test_random random = {seed};
  celspan_cel *cels[4];
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  size_t count = 1 + (size_t)random_below(&random, 4);
  size_t rich = kind == MIXED ? (size_t)random_below(&random, count) : count;
  for (size_t i = 0; i < count; i++)
    cels[i] = random_cel(s, &random, kind, kind == MIXED ? random_way(&random, i, rich) : MAPPED);
  if (random_below(&random, 2))
    desc.back = (celspan_light){1, 0.75f, 0.5f, 1};
  return studio_rostrum(s, desc, cels, count);
}

static celspan_frame_desc frame_of(const celspan_exposure *exposure) {
  celspan_frame_desc desc = studio_frame(exposure, 1, WIDTH, HEIGHT, NULL);
  desc.repeats = true;
  return desc;
}

/* Lets all cels that suit go one way. */
static void force(studio *s, cs_ways_forced way) { s->context->forced_way = way; }

static celspan_statistics count(studio *s, const celspan_frame_desc *desc) {
  celspan_statistics statistics = CELSPAN_STATISTICS;
  const celspan_sink nowhere = {.struct_size = sizeof nowhere};
  studio_check(s, celspan_frame_render(s->context, desc, &nowhere, &statistics));
  return statistics;
}

static image make_swept(studio *s, const celspan_frame_desc *desc) {
  force(s, CS_WAYS_SWEPT);
  CHECK(count(s, desc).maps == 0);
  image picture = make_image(s, desc, 1);
  force(s, CS_WAYS_MAPPED);
  return picture;
}

static float difference(const image *a, const image *b) {
  float most = 0;
  for (int i = 0; i < 4 * a->width * a->height; i++)
    most = fmaxf(most, fabsf(a->rgba[i / 4][i % 4] - b->rgba[i / 4][i % 4]));
  return most;
}

/* ---------------------------------------------------------------- the same picture */

/* A pixel's colour from as many points of it as are counted in the square, by the probe. */
static void sample(studio *s, celspan_frame_desc desc, int i, double rgba[4]) {
  const int side = 256;
  desc.film_width = WIDTH;
  desc.film_height = HEIGHT;
  for (int k = 0; k < side * side; k++) {
    const celspan_point point = {i % WIDTH + (k % side + 0.5) / side,
                                 i / WIDTH + (k / side + 0.5) / side};
    double at[4];
    studio_check(s, celspan_probe(s->context, &desc, point, at));
    for (int c = 0; c < 4; c++)
      rgba[c] += at[c] / (side * side);
  }
}

/* Where a pixel drawn from maps differs from the swept one, whether it is right. */
static bool is_right(studio *s, const celspan_frame_desc *desc, const image *swept,
                     const image *drawn) {
  bool is_right = true;
  for (int i = 0; i < WIDTH * HEIGHT; i++) {
    const float *a = swept->rgba[i], *b = drawn->rgba[i];
    double rgba[4] = {0};
    float most = 0;
    for (int c = 0; c < 4; c++)
      most = fmaxf(most, fabsf(a[c] - b[c]));
    if (most < 0.0002f)
      continue;
    sample(s, *desc, i, rgba);
    for (int c = 0; c < 4; c++)
      is_right &= fabs(rgba[c] - (double)b[c]) < 0.0002;
  }
  return is_right;
}

/* Straight shapes are the same except for rounding, or those drawn from maps are right: the sweep
 * is off by up to 0.003 in a pixel of one scene in sixty. Round ones have other chords, and a
 * gradient that shares a pixel with others has the colour of its middle in all of it. */
static void check_pictures(studio *s) {
  for (uint64_t seed = 0; seed < SCENES; seed++) {
    if (!check_is_drawn((int)seed / KINDS))
      continue;
    scene_kind kind = (scene_kind)(seed % KINDS);
    celspan_exposure exposure = {random_rostrum(s, seed, kind), 1};
    celspan_frame_desc desc = frame_of(&exposure);
    image a = make_swept(s, &desc), b = make_image(s, &desc, 1);
    CHECK(count(s, &desc).maps > 0);
    float most = difference(&a, &b);
    bool is_varied = kind == VARIED || kind == MIXED || kind == GLAZED;
    float bound = kind == ROUND ? 0.02f : is_varied ? 2 / 255.0f : 0.0002f;
    if (!CHECK(most < bound || (kind == PARTED && most < 0.003f && is_right(s, &desc, &a, &b))))
      fprintf(stderr, "  scene %d: %g\n", (int)seed, (double)most);
    free(a.rgba);
    free(b.rgba);
    studio_finish(s);
  }
}

/* A channel of the paint over a light. */
static float over(celspan_paint paint, float light, int c) {
  return paint.beta * paint.pigment[c] + (1 - paint.beta) * paint.medium[c] * light;
}

/* Two gels whose boundaries cross in the pixel (10, 10): the near one has the half below its
 * diagonal, the far one its right half, so that an eighth of it is in both and one in neither. */
static void check_gels(studio *s) {
  const celspan_paint near = {{0.5f, 0.25f, 0}, {0.9f, 0.3f, 0.5f}, 0.2f};
  const celspan_paint far = {{0, 0.5f, 1}, {0.1f, 0.8f, 0.4f}, 0.3f};
  const celspan_point corners[] = {{0, 0}, {0, HEIGHT}, {HEIGHT, HEIGHT}};
  celspan_object *front =
      studio_polygon(s, corners, 3, CELSPAN_RULE_NONZERO, studio_paint(s, near));
  celspan_object *objects[] = {with_shapes(s, front),
                               studio_rect(s, 10.5, 0, WIDTH, HEIGHT, studio_paint(s, far))};
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.back = (celspan_light){1, 0.75f, 0.5f, 0};
  const float light[] = {1, 0.75f, 0.5f, 0};
  const celspan_cel_desc cel = CELSPAN_CEL_DESC;
  celspan_cel *cels[] = {studio_cel(s, cel, &objects[1], 1), studio_cel(s, cel, &objects[0], 1)};
  celspan_exposure exposure = {studio_rostrum(s, desc, cels, 2), 1};
  celspan_frame_desc frame = frame_of(&exposure);
  CHECK(count(s, &frame).maps == 2);
  image picture = make_image(s, &frame, 1);
  for (int c = 0; c < 3; c++) {
    float behind = over(far, light[c], c), both = over(near, behind, c);
    float wanted = (both + 3 * behind + 3 * over(near, light[c], c) + light[c]) / 8;
    CHECK(fabsf(picture.rgba[WIDTH * 10 + 10][c] - wanted) < 1e-4f);
  }
  float through[2] = {0, 0}, both = 0;
  for (int c = 0; c < 3; c++) {
    through[0] += (1 - near.beta) * near.medium[c] / 3;
    through[1] += (1 - far.beta) * far.medium[c] / 3;
    both += (1 - near.beta) * near.medium[c] * (1 - far.beta) * far.medium[c] / 3;
  }
  float clear = (both + 3 * through[0] + 3 * through[1] + 1) / 8;
  CHECK(fabsf(picture.rgba[WIDTH * 10 + 10][3] - (1 - clear)) < 1e-4f);
  free(picture.rgba);
  studio_finish(s);
}

/* A cel with two gels, which differ in nothing but how much each channel is dimmed, between two
 * drawings with maps. Where a gel lies over a gradient that lets something through it is swept, and
 * so is the rear drawing. gradient: how opaque the gradient is; x: where it lies. */
static void check_gels_among_others(studio *s, float gradient, double x, uint64_t maps) {
  const celspan_paint red = {{0, 0, 0}, {0.75f, 0.25f, 0.5f}, 0};
  const celspan_paint green = {{0, 0, 0}, {0.25f, 0.75f, 0.5f}, 0};
  const celspan_point from = {0, 0}, to = {WIDTH, HEIGHT};
  const celspan_stop stops[] = {{0, celspan_paint_rgb(1, 0.5f, 0, 1)},
                                {1, celspan_paint_rgb(0, 0.5f, 1, gradient)}};
  celspan_object *gels[] = {
      studio_rect(s, x, 12, 20, 30, studio_linear(s, from, to, stops, 2)),
      studio_rect(s, 10, 10, 20, 30, studio_paint(s, red)),
      studio_rect(s, 30, 10, 20, 30, studio_paint(s, green)),
  };
  celspan_object *rear = with_shapes(s, studio_circle(s, 40, 20, 15, NULL));
  celspan_object *disc = with_shapes(s, studio_circle(s, 20, 35, 15, NULL));
  celspan_object *front[] = {disc, disc}; /* more shapes than all others */
  const celspan_cel_desc cel = CELSPAN_CEL_DESC;
  celspan_cel *cels[] = {studio_cel(s, cel, &rear, 1), studio_cel(s, cel, gels, 3),
                         studio_cel(s, cel, front, 2)};
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.back = (celspan_light){1, 0.75f, 0.5f, 1};
  celspan_exposure exposure = {studio_rostrum(s, desc, cels, 3), 1};
  celspan_frame_desc frame = frame_of(&exposure);
  image a = make_swept(s, &frame), b = make_image(s, &frame, 1);
  CHECK(count(s, &frame).maps == maps && difference(&a, &b) < 0.01f);
  free(a.rgba);
  free(b.rgba);
  studio_finish(s);
}

/* Large shapes over each other, of which few can be seen: the others are culled tile by tile. */
static void check_hidden(studio *s) {
  for (uint64_t seed = 0; seed < 12; seed++) {
    test_random random = {seed};
    celspan_object *objects[SHAPES];
    for (size_t i = 0; i < SHAPES; i++) {
      celspan_point corners[3];
      for (int k = 0; k < 3; k++)
        corners[k] = random_point(&random, -60, WIDTH + 60, -60, HEIGHT + 60);
      celspan_paint paint = random_paint(&random);
      objects[i] = studio_polygon(s, corners, 3, CELSPAN_RULE_NONZERO, studio_paint(s, paint));
    }
    const celspan_cel_desc cel = CELSPAN_CEL_DESC;
    celspan_cel *cels[] = {studio_cel(s, cel, objects, SHAPES)};
    const celspan_rostrum_desc rostrum = CELSPAN_ROSTRUM_DESC;
    celspan_exposure exposure = {studio_rostrum(s, rostrum, cels, 1), 1};
    celspan_frame_desc desc = frame_of(&exposure);
    image a = make_swept(s, &desc), b = make_image(s, &desc, 1);
    CHECK(count(s, &desc).maps == 1 && difference(&a, &b) < 0.0002f);
    free(a.rgba);
    free(b.rgba);
    studio_finish(s);
  }
}

/* Shapes so small that nothing is left of them on the raster of a map. */
static void check_nothing(studio *s) {
  celspan_object *objects[SHAPES];
  celspan_texture *red = studio_paint(s, celspan_paint_rgb(1, 0, 0, 1));
  for (size_t i = 0; i < SHAPES; i++)
    objects[i] = studio_rect(s, 20, 20, 1e-9, 1e-9, red);
  const celspan_cel_desc cel = CELSPAN_CEL_DESC;
  celspan_cel *cels[] = {studio_cel(s, cel, objects, SHAPES)};
  const celspan_rostrum_desc rostrum = CELSPAN_ROSTRUM_DESC;
  celspan_exposure exposure = {studio_rostrum(s, rostrum, cels, 1), 1};
  celspan_frame_desc drawn = frame_of(&exposure);
  image a = make_image(s, &drawn, 1);
  CHECK(count(s, &drawn).maps == 1);
  for (int i = 0; i < WIDTH * HEIGHT; i++)
    CHECK(a.rgba[i][3] < 1e-6f);
  free(a.rgba);
  studio_finish(s);
}

/* ---------------------------------------------------------------- the same bits */

/* Rows in another order, parts of the frame, and maps that are made again. */
static void check_bits(studio *s, studio *small) {
  for (uint64_t seed = 100; seed < 120; seed++) {
    celspan_exposure exposure = {random_rostrum(s, seed, (scene_kind)(seed % KINDS)), 1};
    celspan_exposure again = {random_rostrum(small, seed, (scene_kind)(seed % KINDS)), 1};
    celspan_frame_desc desc = frame_of(&exposure), other = frame_of(&again);
    image a = make_image(s, &desc, 1), b = make_image(s, &desc, 7),
          c = make_image(small, &other, 1);
    CHECK(memcmp(a.rgba, b.rgba, WIDTH * HEIGHT * sizeof *a.rgba) == 0);
    CHECK(memcmp(a.rgba, c.rgba, WIDTH * HEIGHT * sizeof *a.rgba) == 0);
    desc.crop_x = 17;
    desc.crop_y = 21;
    desc.crop_width = 40;
    desc.crop_height = 30;
    image part = make_image(s, &desc, 1);
    for (int y = 0; y < 30; y++)
      CHECK(memcmp(part.rgba[40 * y], a.rgba[WIDTH * (y + 21) + 17], 40 * sizeof *a.rgba) == 0);
    free(a.rgba);
    free(b.rgba);
    free(c.rgba);
    free(part.rgba);
    studio_finish(s);
    studio_finish(small);
  }
}

/* ---------------------------------------------------------------- what is kept */

static celspan_exposure moved_disc(studio *s, celspan_matrix matrix) {
  celspan_object *disc = with_shapes(s, studio_circle(s, 20, 20, 15, NULL));
  return (celspan_exposure){studio_show(s, studio_transform(s, disc, matrix)), 1};
}

static bool are_same(const celspan_span *a, const celspan_span *b, size_t count) {
  bool same = true;
  for (size_t i = 0; i < count; i++)
    same = same && a[i].x0 == b[i].x0 && a[i].x1 == b[i].x1 && a[i].kind == b[i].kind &&
           memcmp(a[i].colour, b[i].colour, sizeof a->colour) == 0;
  return same;
}

/* Rows of a frame of one map that are asked for upwards, twice, or as a part of their swath. */
static void check_any_order(studio *s) {
  static const int order[] = {20, 21, 21, 37, 12, 20, 59, 3, 2, 40, 40, 23, 0, 16, 15, 58, 21};
  celspan_exposure exposure = moved_disc(s, celspan_matrix_identity());
  celspan_frame_desc desc = frame_of(&exposure);
  celspan_rows *rows, *fresh;
  studio_check(s, celspan_rows_create(s->context, &desc, &rows));
  for (size_t i = 0; i < sizeof order / sizeof *order; i++) {
    const celspan_span *spans, *same;
    size_t count, same_count;
    studio_check(s, celspan_rows_create(s->context, &desc, &fresh));
    studio_check(s, celspan_rows_get(fresh, order[i], &same, &same_count));
    studio_check(s, celspan_rows_get(rows, order[i], &spans, &count));
    CHECK(count == same_count && are_same(spans, same, count));
    celspan_rows_destroy(fresh);
  }
  celspan_rows_destroy(rows);
  studio_finish(s);
}

/* Maps of a frame that has been made, and how many of them were new. */
static void check_maps(studio *s, celspan_exposure exposure, uint64_t maps, uint64_t made) {
  celspan_frame_desc desc = frame_of(&exposure);
  celspan_statistics statistics = count(s, &desc);
  if (!CHECK(statistics.maps == maps && statistics.maps_made == made))
    fprintf(stderr, "  %d maps, of which %d were made\n", (int)statistics.maps,
            (int)statistics.maps_made);
}

/* A drawing that only moves has one map; one that turns has another one, whatever the angle and the
 * perspective. One that reaches the horizon, and one of few shapes, have none. */
static void check_kept(studio *s, studio *small) {
  const celspan_point origin = {0, 0};
  const celspan_matrix tilted = {{1, 0, 0, 0, 1, 0, 5e-3, 0, 1.1}};
  const celspan_matrix behind = {{1, 0, 0, 0, 1, 0, -0.04, 0, 1}};
  studio *both[2] = {s, small};
  for (uint64_t k = 0; k < 2; k++) {
    studio *each = both[k];
    check_maps(each, moved_disc(each, celspan_matrix_identity()), 1, 1);
    check_maps(each, moved_disc(each, celspan_matrix_translation(7.3, 0)), 1, k);
    check_maps(each, moved_disc(each, celspan_matrix_rotation(0.3, origin)), 1, 1);
    check_maps(each, moved_disc(each, celspan_matrix_rotation(-77, origin)), 1, k);
    check_maps(each, moved_disc(each, tilted), 1, k);
    check_maps(each, moved_disc(each, behind), 0, 0);
    celspan_object *plain = studio_circle(each, 20, 20, 15, NULL);
    check_maps(each, (celspan_exposure){studio_show(each, plain), 1}, 0, 0);
    studio_finish(each);
  }
  CHECK(cs_map_keep_count(s->context).bytes > 0 && cs_map_keep_count(small->context).bytes == 0);
}

static uint64_t made_of(studio *s, double radius, bool repeats) {
  celspan_object *disc = with_shapes(s, studio_circle(s, 20, 20, radius, NULL));
  celspan_exposure exposure = {studio_show(s, disc), 1};
  celspan_frame_desc desc = frame_of(&exposure);
  desc.repeats = repeats;
  return count(s, &desc).maps_made;
}

/* A still uses the maps that are kept, but none of them goes to make room for its own. */
static void check_no_map_goes(studio *s, celspan_context_desc desc) {
  cs_context_trim(s->context);
  CHECK(made_of(s, 15, false) == 1 && made_of(s, 15, false) == 0);
  studio tight = {0};
  desc.defocus_bytes = 6 * cs_map_keep_count(s->context).bytes; /* a quarter of it is for maps */
  CHECK(celspan_context_create(&desc, &tight.context) == CELSPAN_OK);
  force(&tight, CS_WAYS_MAPPED);
  CHECK(made_of(&tight, 15, true) == 1 && made_of(&tight, 15, false) == 0);
  CHECK(made_of(&tight, 14, false) == 1 && made_of(&tight, 14, false) == 1);
  CHECK(made_of(&tight, 15, false) == 0);
  CHECK(made_of(&tight, 14, true) == 1 && made_of(&tight, 15, false) == 1);
  studio_finish(s);
  studio_finish(&tight);
  celspan_context_destroy(tight.context);
}

/* Frames of few rows, and frames whose map was not kept, because it was not of all rows. */
static int made_in_part, made_alone;

/* Rows of a frame, which are made from a map of some zones alone, are those of the whole frame. */
static void check_rows(studio *s, celspan_frame_desc desc, const image *whole, int y, int height) {
  desc.repeats = false;
  desc.crop_y = y;
  desc.crop_width = WIDTH;
  desc.crop_height = height;
  cs_context_trim(s->context);
  image part = make_image(s, &desc, 1);
  made_in_part++;
  made_alone += cs_map_keep_count(s->context).bytes == 0;
  CHECK(memcmp(part.rgba, whole->rgba[WIDTH * y], sizeof *part.rgba * WIDTH * (size_t)height) == 0);
  free(part.rgba);
}

static void check_crops(studio *s) {
  for (uint64_t seed = 200; seed < 200 + CROPPED_SCENES; seed++) {
    test_random random = {seed};
    scene_kind kind = (scene_kind)(seed % KINDS);
    if (!check_is_drawn((int)seed / KINDS))
      continue;
    celspan_exposure exposure = {random_rostrum(s, seed, kind), 1};
    celspan_frame_desc desc = frame_of(&exposure);
    image whole = make_image(s, &desc, 1);
    for (int k = 0; k < 4; k++) {
      int height = 1 + random_below(&random, HEIGHT / 4);
      check_rows(s, desc, &whole, random_below(&random, HEIGHT - height), height);
    }
    free(whole.rgba);
    studio_finish(s);
  }
  CHECK(8 * made_alone > made_in_part);
}

/* Translucent shapes that cross all over: each crossing makes new windings. */
static celspan_exposure crossing(studio *s, int count) {
  celspan_object *objects[CROSSING];
  celspan_texture *glass = studio_paint(s, celspan_paint_rgb(1, 0, 0, 0.1f));
  for (int i = 0; i < count; i++) {
    const double x = 88.0 * i / count;
    const celspan_point corners[] = {{x, 0}, {x + 0.2, 0}, {WIDTH - x, HEIGHT}};
    objects[i] = studio_polygon(s, corners, 3, CELSPAN_RULE_NONZERO, glass);
  }
  celspan_cel *cels[] = {studio_cel(s, CELSPAN_CEL_DESC, objects, (size_t)count)};
  return (celspan_exposure){studio_rostrum(s, CELSPAN_ROSTRUM_DESC, cels, 1), 1};
}

/* Zones of a map with too many windings are missing, and their rows are swept; the others, and rows
 * that are made alone, are what they are without them. */
static void check_missing(studio *s) {
  celspan_exposure exposure = crossing(s, CROSSING);
  celspan_frame_desc desc = frame_of(&exposure);
  cs_frame frame;
  image whole = make_image(s, &desc, 1), swept = make_swept(s, &desc);
  studio_check(s, cs_frame_create(s->context, &desc, &frame));
  int missing = 0, different = 0;
  for (int y = 0; y < HEIGHT; y++) {
    bool is_same =
        memcmp(whole.rgba[WIDTH * y], swept.rgba[WIDTH * y], WIDTH * sizeof *whole.rgba) == 0;
    missing += !cs_map_frame_has(&frame.maps[0], y);
    different += !is_same;
    CHECK(is_same || cs_map_frame_has(&frame.maps[0], y));
  }
  CHECK(frame.maps[0].has_gaps && missing > 8 && different > 8);
  cs_frame_free(&frame, s->context->memory);
  for (int y = 0; y < HEIGHT; y += 5)
    check_rows(s, desc, &whole, y, 5);
  free(whole.rgba);
  free(swept.rgba);
  studio_finish(s);
}

/* A map is turned as far as its corners, here (5, 5) of a disc, are no farther away than its lines
 * can be. */
static void check_lines_fit(studio *s) {
  const celspan_matrix turn = celspan_matrix_rotation(45, (celspan_point){0, 0});
  const double corner = 10 * sqrt(0.5), half = sqrt(0.5) / 2;
  for (int k = 0; k < 2; k++) {
    cs_context_trim(s->context);
    double y = -CS_MAP_FARTHEST - corner + (k == 0 ? half : -half);
    celspan_matrix matrix = celspan_matrix_then(turn, celspan_matrix_translation(0, y));
    check_maps(s, moved_disc(s, matrix), k == 0, k == 0);
    studio_finish(s);
  }
  /* Here the corner right, top decides, in which x and y of the map have different signs. */
  const celspan_matrix over = celspan_matrix_rotation(150, (celspan_point){0, 0});
  cs_context_trim(s->context);
  check_maps(s,
             moved_disc(s, celspan_matrix_then(
                               over, celspan_matrix_translation(0, -CS_MAP_FARTHEST + 22))),
             1, 1);
  studio_finish(s);
}

/* ---------------------------------------------------------------- the rule */

/* What makes a cel artwork: each row differs from the first one in what is judged there. */
static void check_rule(void) {
  static const struct {
    size_t pieces, shapes, inside, hiding;
    double height; /* of each that is inside */
    double varied, flat;
    bool occurs_again, is_artwork, is_small;
  } rows[] = {
      {400, 100, 100, 50, 210, 5, 5, false, true, false},
      {255, 63, 63, 63, 210, 5, 5, false, false, true},    /* too few */
      {256, 64, 64, 64, 210, 5, 5, false, true, false},    /* enough */
      {256, 12, 12, 12, 210, 5, 5, false, true, false},    /* in fewer shapes */
      {999, 11, 11, 11, 210, 5, 5, false, false, true},    /* which are too few */
      {255, 63, 63, 63, 210, 6, 5, false, false, false},   /* too few, and they vary */
      {400, 100, 100, 49, 210, 5, 5, false, false, false}, /* translucent */
      {400, 100, 100, 50, 210, 6, 5, false, false, false}, /* gradients */
      {400, 100, 25, 50, 210, 5, 5, false, true, false},   /* a quarter is seen */
      {400, 100, 24, 50, 210, 5, 5, false, false, false},  /* less */
      {400, 100, 100, 50, 211, 5, 5, false, false, false}, /* too high */
      {400, 100, 100, 50, 315, 5, 5, true, true, false},   /* seen twice */
      {400, 100, 100, 50, 316, 5, 5, true, false, false},
      {400, 100, 0, 50, 0, 0, 0, false, false, false}, /* outside the frame */
  };
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    const cs_census census = {.shapes = rows[i].shapes,
                              .inside = rows[i].inside,
                              .hiding = rows[i].hiding,
                              .heights = rows[i].height * (double)rows[i].inside,
                              .varied = rows[i].varied,
                              .flat = rows[i].flat};
    cs_ways ways = {0};
    cs_ways_judge(&ways, 1, rows[i].pieces, &census, rows[i].occurs_again);
    if (!CHECK(ways.is_artwork[1] == rows[i].is_artwork && ways.is_small[1] == rows[i].is_small))
      fprintf(stderr, "  row %d of the rule\n", (int)i);
  }
}

/* Pieces of outline: a shape counts at least as a box does, and what is cut away not at all. */
static void check_pieces(studio *s) {
  celspan_point points[20];
  for (int i = 0; i < 20; i++)
    points[i] = (celspan_point){i, i % 2 + (i < 10 ? i : 30 - i)};
  celspan_object *jagged = studio_polygon(s, points, 20, CELSPAN_RULE_NONZERO, NULL);
  celspan_object *triangle = studio_polygon(s, points, 3, CELSPAN_RULE_NONZERO, NULL);
  celspan_object *box = studio_rect(s, 0, 0, 9, 9, NULL);
  celspan_object *cut = studio_pair(s, CELSPAN_OPERATOR_DIFFERENCE, box, jagged);
  celspan_object *uncut = studio_pair(s, CELSPAN_OPERATOR_DIFFERENCE, jagged, box);
  celspan_object *all[] = {jagged, triangle, box, cut, uncut};
  CHECK(cs_parts_pieces(all, 1) == 20 && cs_parts_pieces(all + 1, 1) == 4);
  CHECK(cs_parts_pieces(all + 3, 1) == 4 && cs_parts_pieces(all + 4, 1) == 20);
  CHECK(cs_parts_pieces(all, 5) == 20 + 4 + 4 + 4 + 20);
  celspan_object *held = studio_boolean(s, CELSPAN_OPERATOR_UNION, all, 5);
  CHECK(cs_parts_pieces(&held, 1) == 52);
  studio_finish(s);
}

static celspan_exposure shown(studio *s, celspan_cel_desc desc, celspan_object **objects,
                              size_t count) {
  celspan_cel *cels[] = {studio_cel(s, desc, objects, count)};
  return (celspan_exposure){studio_rostrum(s, CELSPAN_ROSTRUM_DESC, cels, 1), 1};
}

/* A character of 20 traced shapes is drawn from a map; 20 boxes are not. */
static void check_character(studio *s) {
  celspan_object *traced[20], *boxes[20];
  for (int k = 0; k < 20; k++) {
    celspan_point points[16];
    for (int i = 0; i < 16; i++) {
      const double angle = 0.3927 * i, radius = i % 2 ? 12 - 0.3 * k : 9 - 0.3 * k;
      points[i] = (celspan_point){30 + radius * cos(angle), 30 + radius * sin(angle)};
    }
    celspan_texture *paint = studio_paint(s, celspan_paint_rgb(k % 3 / 2.0f, 0.5f, k % 2, 1));
    traced[k] = studio_polygon(s, points, 16, CELSPAN_RULE_NONZERO, paint);
    boxes[k] = studio_rect(s, k, k, 20, 20, paint);
  }
  force(s, CS_WAYS_BY_RULE);
  check_maps(s, shown(s, CELSPAN_CEL_DESC, traced, 20), 1, 1);
  check_maps(s, shown(s, CELSPAN_CEL_DESC, boxes, 20), 0, 0);
  force(s, CS_WAYS_MAPPED);
  studio_finish(s);
}

/* Boxes that lie partly in the frame, faded, cut away, turned by a right angle and moved. */
static void check_census(studio *s) {
  celspan_texture *red = studio_paint(s, celspan_paint_rgb(1, 0, 0, 1));
  const celspan_stop stops[] = {{0, celspan_paint_rgb(1, 0, 0, 1)},
                                {1, celspan_paint_rgb(0, 0, 1, 1)}};
  celspan_texture *varied =
      studio_linear(s, (celspan_point){0, 0}, (celspan_point){9, 9}, stops, 2);
  celspan_object *objects[] = {
      studio_rect(s, -10, -10, 20, 30, red), /* 10 x 20 of it are inside */
      studio_pair(s, CELSPAN_OPERATOR_DIFFERENCE, studio_rect(s, 0, 0, 10, 10, red),
                  studio_rect(s, 5, 5, 2, 4, red)),
      studio_transform(s, studio_rect(s, 0, 0, 8, 4, varied),
                       celspan_matrix_rotation(90, (celspan_point){0, 0})),
      studio_rect(s, 200, 0, 5, 5, red),
      studio_rect(s, 20, -3, 7, 9, varied), /* 7 x 6 of it */
  };
  const celspan_matrix here = celspan_matrix_identity();
  cs_census census = cs_census_take(objects, 5, &here, WIDTH, HEIGHT);
  CHECK(census.shapes == 6 && census.inside == 4 && census.hiding == 3);
  CHECK(fabs(census.heights - (20 + 10 + 4 + 6)) < 1e-9);
  CHECK(fabs(census.varied - 42) < 1e-9 && fabs(census.flat - (200 + 100 + 8)) < 1e-9);
  studio_finish(s);
}

/* ---------------------------------------------------------------- parts */

static celspan_object *part(studio *s, double angle) {
  return turned(s, with_shapes(s, studio_circle(s, 20, 20, 15, NULL)), angle);
}

/* What is moved inside a cel is a part, also inside unions, and so is what lies between parts. A
 * part that moves keeps its map; here all are one drawing, turned. */
static void check_parts(studio *s) {
  const celspan_cel_desc plain = CELSPAN_CEL_DESC;
  celspan_object *ground = with_shapes(s, studio_rect(s, 0, 0, 50, 50, NULL));
  cs_context_trim(s->context);
  for (uint64_t k = 1; k < 4; k++) {
    celspan_object *pair = studio_pair(s, CELSPAN_OPERATOR_UNION, part(s, (double)k), part(s, 5));
    celspan_object *both[] = {ground, turned(s, pair, 3 * (double)k)};
    check_maps(s, shown(s, plain, both, 2), 3, k == 1 ? 2 : 0);
    check_maps(s, shown(s, plain, both + 1, 1), 2, 0);
  }
  studio_finish(s);
}

/* Cels that keep their parts together: faded ones, those with a mode that acts on other cels, those
 * with a light of a shape behind them, and those whose parts are poor. */
static void check_parts_together(studio *s) {
  const celspan_cel_desc plain = CELSPAN_CEL_DESC;
  celspan_cel_desc faded = plain, lit = plain;
  faded.opacity = 0.5;
  const celspan_stop stops[] = {{0, celspan_paint_rgb(1, 0, 0, 1)},
                                {1, celspan_paint_rgb(0, 0, 1, 1)}};
  lit.back_texture.texture =
      studio_linear(s, (celspan_point){0, 0}, (celspan_point){9, 9}, stops, 2);
  celspan_object *objects[24] = {part(s, 1), part(s, 2)};
  check_maps(s, shown(s, plain, objects, 2), 2, 0);
  check_maps(s, shown(s, faded, objects, 2), 1, 1);
  check_maps(s, shown(s, lit, objects, 2), 0, 0);
  const celspan_group_desc group = {.struct_size = sizeof group,
                                    .objects = objects + 1,
                                    .object_count = 1,
                                    .opacity = 1,
                                    .blend = CELSPAN_BLEND_MULTIPLY};
  celspan_object *source = turned(s, studio_group(s, &group), 4);
  celspan_object *blended[] = {objects[0], source};
  check_maps(s, shown(s, plain, blended, 2), 0, 0);
  for (int i = 0; i < 24; i++)
    objects[i] = part(s, i + 1);
  check_maps(s, shown(s, plain, objects, 24), 1, 1);
  studio_finish(s);
}

/* A cel behind which there are parts of another one is named by its own number. */
static void check_number(studio *s) {
  celspan_cel_desc far = CELSPAN_CEL_DESC;
  far.has_viewport = true;
  far.viewport = (celspan_box){0, 0, 1e-200, 1e-200};
  celspan_object *objects[] = {part(s, 1), part(s, 2)};
  celspan_cel *cels[] = {studio_cel(s, CELSPAN_CEL_DESC, objects, 2),
                         studio_cel(s, far, objects, 1)};
  celspan_exposure exposure = {studio_rostrum(s, CELSPAN_ROSTRUM_DESC, cels, 2), 1};
  celspan_frame_desc desc = frame_of(&exposure);
  const celspan_sink nowhere = {.struct_size = sizeof nowhere};
  CHECK(celspan_frame_render(s->context, &desc, &nowhere, NULL) == CELSPAN_BAD_ARGUMENT);
  CHECK(strncmp(celspan_context_error(s->context), "cel 2:", 6) == 0);
  studio_finish(s);
}

/* A cel that is beyond the frame by more than places can be far is not seen. */
static void check_far(studio *s) {
  const double ways[] = {-1e5, 1e5, -1e9, 1e9};
  for (int k = 0; k < 8; k++) {
    double way = ways[k / 2], x = k % 2 ? way : 0, y = k % 2 ? 0 : way;
    celspan_exposure exposure = moved_disc(s, celspan_matrix_translation(x, y));
    celspan_frame_desc desc = frame_of(&exposure);
    CHECK(count(s, &desc).maps == 1);
    image picture = make_image(s, &desc, 1);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
      CHECK(picture.rgba[i][3] == 0);
    free(picture.rgba);
    studio_finish(s);
  }
}

/* ---------------------------------------------------------------- no leaks */

/* Two black cels that share a boundary, before white: nowhere along it is it lighter. The black of
 * one is a gradient. They are moved and enlarged, and turned by an angle in each frame. maps: 2, or
 * 1, so that one is swept, under a light with a shape, and the boundary is straight. */
static void check_leaks(studio *s, double angle, uint64_t maps) {
  celspan_texture *black = studio_paint(s, celspan_paint_rgb(0, 0, 0, 1));
  const celspan_stop stops[] = {{0, celspan_paint_rgb(0, 0, 0, 1)},
                                {1, celspan_paint_rgb(0, 0, 0, 1)}};
  const celspan_point from = {0, 0}, to = {WIDTH, HEIGHT};
  celspan_texture *varied = studio_linear(s, from, to, stops, 2);
  bool is_round = maps == 2;
  celspan_object *left = studio_path(s,
                                     is_round ? "M 2 2 L 40 2 C 70 20 10 40 44 58 L 2 58 Z"
                                              : "M 2 2 L 40 2 L 58 21 L 27 40 L 44 58 L 2 58 Z",
                                     varied);
  celspan_object *right = studio_path(s,
                                      is_round ? "M 88 2 L 40 2 C 70 20 10 40 44 58 L 88 58 Z"
                                               : "M 88 2 L 40 2 L 58 21 L 27 40 L 44 58 L 88 58 Z",
                                      black);
  left = with_shapes(s, left);
  celspan_cel_desc lit = CELSPAN_CEL_DESC;
  lit.front_texture.texture = maps == 1 ? varied : NULL;
  right = with_shapes(s, right);
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.back = (celspan_light){1, 1, 1, 1};
  float most = 0;
  for (int k = 0; k < 60; k++) {
    if (!check_is_drawn(k))
      continue;
    desc.has_camera_width = desc.has_camera_centre = true;
    desc.camera_width = WIDTH / (1 + 0.037 * k);
    desc.camera_centre = (celspan_point){WIDTH / 2.0 + 0.013 * k, HEIGHT / 2.0 - 0.017 * k};
    const celspan_matrix turn =
        celspan_matrix_rotation(k * angle, (celspan_point){WIDTH / 2.0, HEIGHT / 2.0});
    celspan_object *one = studio_transform(s, left, turn),
                   *other = studio_transform(s, right, turn);
    celspan_cel *cels[] = {studio_cel(s, lit, &one, 1), studio_cel(s, CELSPAN_CEL_DESC, &other, 1)};
    celspan_exposure exposure = {studio_rostrum(s, desc, cels, 2), 1};
    celspan_frame_desc frame = frame_of(&exposure);
    CHECK(count(s, &frame).maps == maps);
    image picture = make_image(s, &frame, 1);
    int margin = angle == 0 ? 5 : 20, edge = angle == 0 ? 5 : 35;
    for (int y = margin; y < HEIGHT - margin; y++)
      for (int x = edge; x < WIDTH - edge; x++)
        most = fmaxf(most, picture.rgba[WIDTH * y + x][0]);
    free(picture.rgba);
  }
  if (!CHECK(most < 0.0001f))
    fprintf(stderr, "  a leak of %g\n", (double)most);
  studio_finish(s);
}

/* ---------------------------------------------------------------- failures */

/* Every allocation fails once: in the end there is the frame or the reason, and the frame can be
 * made again. */
static void check_failures_of_memory(studio *s, memory_watch *watch, scene_kind kind) {
  celspan_exposure exposure = {random_rostrum(s, 3, kind), 1};
  celspan_frame_desc desc = frame_of(&exposure);
  desc.workers = 1;
  uint64_t wanted[2], digest[2];
  studio_check(s, celspan_frame_digest(s->context, &desc, NULL, wanted));
  bool has_failed = true;
  for (size_t n = 1; has_failed; n++) {
    if (!check_is_drawn((int)n))
      continue;
    cs_context_trim(s->context);
    watch->fail_at = watch->allocations + n;
    has_failed = celspan_frame_digest(s->context, &desc, NULL, digest) != CELSPAN_OK;
    watch->fail_at = 0;
    studio_check(s, celspan_frame_digest(s->context, &desc, NULL, digest));
    CHECK(memcmp(wanted, digest, sizeof wanted) == 0);
  }
  studio_finish(s);
}

int main(void) {
  memory_watch watch = {0};
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  desc.resize = memory_watch_resize;
  desc.resize_user = &watch;
  studio s = {0}, small = {0};
  CHECK(celspan_context_create(&desc, &s.context) == CELSPAN_OK);
  desc.defocus_bytes = 1;
  CHECK(celspan_context_create(&desc, &small.context) == CELSPAN_OK);
  force(&s, CS_WAYS_MAPPED);
  force(&small, CS_WAYS_MAPPED);
  check_pictures(&s);
  check_gels(&s);
  check_gels_among_others(&s, 0.5f, 60, 3);
  check_gels_among_others(&s, 1, 25, 3);
  check_gels_among_others(&s, 0.5f, 25, 1);
  check_hidden(&s);
  check_nothing(&s);
  check_bits(&s, &small);
  check_kept(&s, &small);
  check_any_order(&s);
  check_no_map_goes(&s, desc);
  check_crops(&s);
  check_missing(&s);
  check_lines_fit(&s);
  check_rule();
  check_pieces(&s);
  check_character(&s);
  check_census(&s);
  check_parts(&s);
  check_parts_together(&s);
  check_number(&s);
  check_far(&s);
  for (uint64_t maps = 1; maps <= 2; maps++) {
    check_leaks(&s, 0, maps);
    check_leaks(&s, 0.1, maps);
  }
  check_failures_of_memory(&s, &watch, VARIED);
  check_failures_of_memory(&s, &watch, MIXED);
  check_failures_of_memory(&s, &watch, PARTED);
  check_failures_of_memory(&s, &watch, COLOURED);
  celspan_context_destroy(s.context);
  celspan_context_destroy(small.context);
  CHECK(watch.blocks == 0 && watch.size_errors == 0);
  return check_done();
}
