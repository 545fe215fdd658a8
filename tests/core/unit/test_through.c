/* Transmittance: the bounds of layers hold everywhere, the layers of a tree that are reported as
 * painted are painted, and cutting and culling by them changes no pixel.
 */
#include "engine/compose/tree.h"
#include "engine/paint/colours.h"
#include "engine/paint/run.h"
#include "engine/paint/shade.h"
#include "frames/render/through.h"
#include "model/geometry/matrix.h"
#include "tests/support/frame_rows.h"
#include "tests/support/random.h"

#define SIDE 256 /* pixels of a frame */

static studio s;
static test_random numbers = {11};

static celspan_paint random_paint(float least_beta) {
  celspan_paint paint = {.beta = least_beta + (1 - least_beta) * random_unit(&numbers)};
  for (int c = 0; c < 3; c++) {
    paint.pigment[c] = random_unit(&numbers);
    paint.medium[c] = random_unit(&numbers);
  }
  return paint;
}

/* ---------------------------------------------------------------- bounds */

static celspan_texture *random_gradient(int kind, float least_beta) {
  celspan_point points[3], from, to;
  celspan_paint paints[3];
  celspan_stop stops[4];
  for (int i = 0; i < 4; i++)
    stops[i] = (celspan_stop){0.3 * i, random_paint(least_beta)};
  for (int i = 0; i < 3; i++) {
    points[i] = random_point(&numbers, 0, SIDE, 0, SIDE);
    paints[i] = random_paint(least_beta);
  }
  from = random_point(&numbers, 0, SIDE, 0, SIDE);
  to = random_point(&numbers, 0, SIDE, 0, SIDE);
  return kind == 0   ? studio_linear(&s, from, to, stops, 4)
         : kind == 1 ? studio_radial(&s, from, random_between(&numbers, 10, SIDE), stops, 4)
                     : studio_gradient(&s, points, paints);
}

/* The bound against samples in and around the visible part of the frame. */
static void check_bound(const cs_shade *shade, const cs_boundary_frame *visible) {
  cs_v4 bound = cs_through_shade(shade, visible), most = cs_v4_all(0);
  for (int i = 0; i <= 100; i++)
    for (int k = 0; k <= 100; k++) {
      double x = visible->left - 0.5 + (visible->right - visible->left + 1) * i / 100;
      double y = visible->top - 0.5 + (visible->bottom - visible->top + 1) * k / 100;
      most = cs_v4_max(cs_shade_paint(shade, x, y).t, most);
    }
  for (int c = 0; c < 3; c++)
    CHECK(bound[c] >= most[c] && bound[c] <= 1);
}

/* For stops no bound is greater than the greatest of them. */
static bool is_tight(const cs_shade *shade, const cs_boundary_frame *visible) {
  cs_v4 bound = cs_through_shade(shade, visible);
  float most = 0;
  for (size_t i = 0; i < shade->texture->variation->stop_count; i++)
    most = fmaxf(most, shade->texture->variation->stops[i].paint.t[0]);
  return bound[0] <= most * 1.00001f;
}

static void test_bounds(void) {
  int in_perspective = 0, triangles = 0;
  for (int trial = 0; trial < 600; trial++) {
    int kind = trial % 3;
    double perspective = trial % 4 == 3 ? random_between(&numbers, -0.01, 0.01) : 0;
    double skew = random_between(&numbers, -1, 1);
    float least_beta = random_unit(&numbers);
    cs_shade shade = {.inverse = {{1, skew, 3, -0.2, 1, 5, perspective, perspective / 2, 1}}};
    shade.texture = random_gradient(kind, least_beta);
    cs_shade_prepare(&shade);
    double x = random_between(&numbers, 0, SIDE), y = random_between(&numbers, 0, SIDE);
    double width = random_between(&numbers, 0, SIDE - x);
    double height = random_between(&numbers, 0, SIDE - y);
    cs_boundary_frame visible = {x, x + width, y, y + height};
    check_bound(&shade, &visible);
    if (kind < 2 && perspective == 0)
      CHECK(is_tight(&shade, &visible));
    in_perspective += kind < 2 && perspective != 0 && is_tight(&shade, &visible);
    triangles += kind == 2 && cs_through_shade(&shade, &visible)[0] < 0.5f;
    studio_finish(&s);
  }
  CHECK(in_perspective > 30 && triangles > 30); /* in front of the horizon; planes are followed */
}

/* ---------------------------------------------------------------- trees */

#define LEAVES 7

/* A random tree over the layers [first, end) as steps in post-order. */
static void make_steps(cs_stack *stack, uint32_t first, uint32_t end) {
  celspan_operator op = (celspan_operator)random_below(&numbers, 5);
  bool is_frame = random_below(&numbers, 6) == 0 && end - first > 2;
  if (end - first == 1) {
    stack->steps[stack->step_count++] =
        (cs_step){.kind = CS_STEP_LAYER, .first = first, .end = end};
    return;
  }
  if (!is_frame && random_below(&numbers, 3) == 0) {
    stack->steps[stack->step_count++] = (cs_step){CS_STEP_LAYERS, op, first, end, end - first};
    return;
  }
  uint32_t begin = first + is_frame;
  uint32_t cut = begin + 1 + (uint32_t)random_below(&numbers, (int)(end - begin) - 1);
  make_steps(stack, begin, cut);
  make_steps(stack, cut, end);
  stack->steps[stack->step_count++] =
      (cs_step){is_frame ? CS_STEP_FRAME : CS_STEP_OPERATOR, op, first, end, 2};
}

/* The layers that are painted whichever of the possible layers are present. */
static uint64_t always_painted(const cs_stack *stack, uint64_t certain, uint64_t possible) {
  cs_tree_result results[32];
  uint64_t always = ~(uint64_t)0;
  for (uint64_t set = 0; set < 1u << LEAVES; set++) {
    uint64_t contributing = set;
    if ((set & certain) != certain || (set & ~possible))
      continue;
    cs_tree_resolve(stack, &contributing, results);
    always &= contributing;
  }
  return always;
}

/* 64 tiles at a time, each with another choice of known layers. */
static void test_trees(void) {
  int painted_count = 0, missed = 0;
  for (int trial = 0; trial < 200; trial++) {
    cs_step steps[32];
    cs_tree tree = {0, LEAVES, 0, 0};
    cs_stack stack = {.steps = steps, .trees = &tree, .tree_count = 1, .layer_count = LEAVES};
    cs_cull_presence presences[LEAVES];
    cs_tree_certain_result results[32];
    uint64_t painted[LEAVES];
    make_steps(&stack, 0, LEAVES);
    tree.step_count = (uint32_t)stack.step_count;
    for (int i = 0; i < LEAVES; i++) {
      presences[i].certain = random_bits(&numbers);
      presences[i].possible = random_bits(&numbers);
      presences[i].possible &= random_bits(&numbers);
      presences[i].possible |= presences[i].certain;
    }
    cs_tree_certain(&stack, &tree, presences, results, painted);
    for (int tile = 0; tile < 64; tile++) {
      uint64_t certain = 0, possible = 0, found = 0;
      for (int i = 0; i < LEAVES; i++) {
        certain |= (presences[i].certain >> tile & 1) << i;
        possible |= (presences[i].possible >> tile & 1) << i;
        found |= (painted[i] >> tile & 1) << i;
      }
      uint64_t always = always_painted(&stack, certain, possible);
      CHECK((found & ~always) == 0);
      painted_count += __builtin_popcountll(found);
      missed += __builtin_popcountll(always & ~found);
    }
  }
  CHECK(painted_count > 5000);
  CHECK(missed == 0); /* no layer occurs twice, so no certain layer is overlooked */
}

/* ---------------------------------------------------------------- frames */

static celspan_frame_desc frame_of(celspan_rostrum *rostrum, celspan_exposure *exposure,
                                   const celspan_antialias_mode *mode) {
  *exposure = (celspan_exposure){rostrum, 1};
  return studio_frame(exposure, 1, SIDE, SIDE, mode);
}

/* A picture in memory, with a clear pixel or without alpha. */
static celspan_texture *make_picture(bool has_alpha, celspan_picture_use use) {
  unsigned char pixels[16] = {200, 90, 30, 255, 10, 90, 230, 0, 50, 90, 30, 255, 200, 10, 30, 255};
  celspan_surface_desc surface = CELSPAN_SURFACE_DESC;
  celspan_picture_desc desc = {.struct_size = sizeof desc, .wrap = CELSPAN_WRAP_REPEAT};
  celspan_texture *texture = NULL;
  surface.width = surface.height = 2;
  surface.format = has_alpha ? CELSPAN_SURFACE_RGBA8 : CELSPAN_SURFACE_RGB8;
  surface.pixels = pixels;
  desc.use = use;
  studio_check(&s, celspan_surface_create(s.context, &surface, &desc.surface));
  studio_check(&s, celspan_texture_create_picture(s.context, &desc, &texture));
  celspan_surface_unref(desc.surface);
  s.textures[s.texture_count++] = texture;
  return texture;
}

/* A large shape that is nearly opaque or not: flat, a gradient or a picture. Some begin and
 * end where tiles do. */
static celspan_object *random_leaf(void) {
  float least = random_below(&numbers, 3) == 0 ? 1 : random_below(&numbers, 2) ? 0.9f : 0.3f;
  int kind = random_below(&numbers, 5);
  celspan_picture_use use = random_below(&numbers, 5) ? CELSPAN_PICTURE_PAINT : CELSPAN_PICTURE_GEL;
  celspan_texture *texture = kind < 3    ? random_gradient(kind, least)
                             : kind == 3 ? studio_paint(&s, random_paint(least))
                                         : make_picture(least == 1, use);
  double x = random_between(&numbers, -SIDE / 2, SIDE / 2),
         width = random_between(&numbers, 60, SIDE);
  double y = random_between(&numbers, -SIDE / 2, SIDE / 2);
  if (random_below(&numbers, 2))
    return studio_circle(&s, x + width, y + width, width, texture);
  if (random_below(&numbers, 2))
    return studio_rect(&s, floor(x / 16) * 16, floor(y / 16) * 16, 2 * width,
                       96 + 16 * random_below(&numbers, 18), texture);
  return studio_rect(&s, x, y, 2 * width, 1.5 * SIDE, texture);
}

static celspan_object *random_tree(int depth) {
  celspan_object *operands[3];
  celspan_operator op = (celspan_operator)random_below(&numbers, 5);
  int count = op == CELSPAN_OPERATOR_CLIP ? 2 : 2 + random_below(&numbers, 2);
  if (depth == 0 || random_below(&numbers, 3) == 0)
    return random_leaf();
  for (int i = 0; i < count; i++)
    operands[i] = random_tree(depth - 1);
  celspan_object *tree = studio_boolean(&s, op, operands, (size_t)count);
  return random_below(&numbers, 2) ? tree : studio_fade(&s, tree, random_between(&numbers, 0.5, 1));
}

static celspan_rostrum *random_scene(void) {
  celspan_object *objects[14];
  for (int i = 0; i < 14; i++)
    objects[i] = random_tree(2);
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.opacity = random_below(&numbers, 3) ? 1 : 0.9;
  celspan_cel *cel = studio_cel(&s, desc, objects, 14);
  celspan_rostrum_desc rostrum = CELSPAN_ROSTRUM_DESC;
  rostrum.back = (celspan_light){1, 1, 1, 1};
  return studio_rostrum(&s, rostrum, &cel, 1);
}

/* The colours of a frame at the pixels' centres, RGBA. */
static void render(const cs_frame *frame, float (*rgba)[4]) {
  cs_row_worker worker = {0};
  studio_check(&s, cs_row_worker_init(&worker, s.context, frame));
  for (int32_t y = 0; y < SIDE; y++)
    row_colours(worker_row(&worker, y), rgba + (size_t)y * SIDE);
  cs_row_worker_finish(&worker);
}

static size_t count_left_out(const cs_cull *cull) {
  size_t count = 0;
  for (size_t i = 0; i < cull->kept_count; i++)
    count += !cull->kept[i];
  return count;
}

/* Deep stacks of trees, gradients and faded groups look the same, to the bit, whether hidden parts
 * are left out or not. */
static void test_cull(void) {
  static float with[SIDE * SIDE][4], without[SIDE * SIDE][4];
  const celspan_antialias_mode none = CELSPAN_ANTIALIAS_NONE;
  size_t culled = 0, left_out = 0;
  for (int trial = 0; trial < 60; trial++) {
    celspan_exposure exposure;
    celspan_frame_desc desc = frame_of(random_scene(), &exposure, &none);
    cs_frame frame;
    studio_check(&s, cs_frame_create(s.context, &desc, &frame));
    culled += frame.plans[0].cull.tile_rows > 0;
    left_out += count_left_out(&frame.plans[0].cull);
    render(&frame, with);
    cs_cull_free(&frame.plans[0].cull, s.context->memory);
    render(&frame, without);
    CHECK(memcmp(with, without, sizeof with) == 0);
    cs_frame_free(&frame, s.context->memory);
    studio_finish(&s);
  }
  CHECK(culled > 40 && left_out > 1000);
}

/* Stripes behind a picture that covers the frame: how many boundaries are left out. */
static size_t left_out_behind(bool has_alpha, celspan_picture_use use, double fade) {
  const celspan_antialias_mode none = CELSPAN_ANTIALIAS_NONE;
  celspan_exposure exposure;
  celspan_object *objects[12];
  cs_frame frame;
  for (int i = 0; i < 11; i++)
    objects[i] = studio_rect(&s, 40 + 12 * i, 30, 8, 190, random_gradient(0, 0.3f));
  objects[11] = studio_rect(&s, 0, 0, SIDE, SIDE, make_picture(has_alpha, use));
  objects[11] = fade < 1 ? studio_fade(&s, objects[11], fade) : objects[11];
  celspan_cel *cel = studio_cel(&s, CELSPAN_CEL_DESC, objects, 12);
  celspan_rostrum *rostrum = studio_rostrum(&s, CELSPAN_ROSTRUM_DESC, &cel, 1);
  celspan_frame_desc desc = frame_of(rostrum, &exposure, &none);
  studio_check(&s, cs_frame_create(s.context, &desc, &frame));
  size_t count = count_left_out(&frame.plans[0].cull);
  cs_frame_free(&frame, s.context->memory);
  studio_finish(&s);
  return count;
}

static void test_pictures(void) {
  CHECK(left_out_behind(false, CELSPAN_PICTURE_PAINT, 1) > 11);
  CHECK(left_out_behind(false, CELSPAN_PICTURE_PAINT, 0.5) == 0);
  CHECK(left_out_behind(false, CELSPAN_PICTURE_GEL, 1) == 0);
  CHECK(left_out_behind(true, CELSPAN_PICTURE_PAINT, 1) == 0);
}

/* ---------------------------------------------------------------- columns */

/* What each of two programs shows is examined once in a row, however often pixels and runs of it
 * are asked for in turn. */
static void test_examined(void) {
  enum { ROWS = 3 };
  const celspan_antialias_mode none = CELSPAN_ANTIALIAS_NONE;
  const cs_item items[2][2] = {{{0, 0}, {1, 0}}, {{0, 0}, {2, 0}}};
  celspan_exposure exposure;
  celspan_object *objects[3];
  for (int i = 0; i < 3; i++)
    objects[i] = studio_rect(&s, 0, 0, SIDE, SIDE, make_picture(true, CELSPAN_PICTURE_PAINT));
  celspan_cel *cel = studio_cel(&s, CELSPAN_CEL_DESC, objects, 3);
  celspan_frame_desc desc =
      frame_of(studio_rostrum(&s, CELSPAN_ROSTRUM_DESC, &cel, 1), &exposure, &none);
  cs_frame frame;
  cs_painter painter;
  cs_row out;
  cs_row_init(&out);
  studio_check(&s, cs_frame_create(s.context, &desc, &frame));
  studio_check(&s, cs_painter_init(&painter, s.context, &frame.plans[0].stack, NULL));
  for (int row = 0; row < ROWS; row++) {
    cs_row_clear(&out);
    for (int x = 0; x < SIDE; x += 4) {
      const cs_program program = {.items = items[x / 4 % 2], .length = 2};
      float rgba[1][4];
      const cs_run pixel = {x, x + 1, row + 0.5}, run = {x + 1, x + 4, row + 0.5};
      studio_check(&s, cs_painter_program_colours(&painter, &program, pixel, rgba));
      studio_check(&s, cs_painter_run_program(&painter, &program, run, &out));
    }
  }
  CHECK(painter.examined == 2 * ROWS);
  cs_row_finish(&out, s.context->memory);
  cs_painter_finish(&painter);
  cs_frame_free(&frame, s.context->memory);
  studio_finish(&s);
}

/* ---------------------------------------------------------------- programs */

/* The length of the program behind a point where all layers of a rostrum are present. */
static uint32_t program_length(celspan_rostrum *rostrum) {
  const celspan_antialias_mode none = CELSPAN_ANTIALIAS_NONE;
  celspan_exposure exposure;
  celspan_frame_desc desc = frame_of(rostrum, &exposure, &none);
  cs_frame frame;
  cs_composer composer;
  cs_painter painter;
  cs_cell cell;
  studio_check(&s, cs_frame_create(s.context, &desc, &frame));
  const cs_stack *stack = &frame.plans[0].stack;
  CHECK(cs_composer_init(&composer, s.context, stack, cs_painter_opacity(&painter)) == CELSPAN_OK);
  CHECK(cs_painter_init(&painter, s.context, composer.stack, &composer) == CELSPAN_OK);
  for (uint32_t layer = 0; layer < stack->layer_count; layer++)
    cs_composer_cross(&composer, layer, 1);
  cs_composer_cell(&composer, &cell);
  cs_painter_finish(&painter);
  cs_composer_finish(&composer);
  cs_frame_free(&frame, s.context->memory);
  return cell.length;
}

/* 60 gradients that let through at most a quarter of each channel, somewhere: eight hide everything
 * behind them. Faded by a half, they let through 5/8. */
static void test_programs(void) {
  celspan_stop stops[2] = {{0, celspan_paint_rgb(1, 0, 0, 0.75f)},
                           {1, celspan_paint_rgb(0, 1, 0, 1)}};
  for (int is_faded = 0; is_faded < 2; is_faded++) {
    celspan_object *objects[60];
    for (int i = 0; i < 60; i++) {
      celspan_texture *texture =
          studio_linear(&s, (celspan_point){0, 0}, (celspan_point){SIDE, i}, stops, 2);
      objects[i] = studio_rect(&s, 0, 0, SIDE, SIDE, texture);
      if (is_faded)
        objects[i] = studio_fade(&s, objects[i], 0.5);
    }
    celspan_cel *cel = studio_cel(&s, CELSPAN_CEL_DESC, objects, 60);
    uint32_t length = program_length(studio_rostrum(&s, CELSPAN_ROSTRUM_DESC, &cel, 1));
    CHECK(length == (is_faded ? 24 : 9)); /* 4^-8 and more, by rounding */
    studio_finish(&s);
  }
}

int main(void) {
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  test_bounds();
  test_trees();
  test_cull();
  test_pictures();
  test_examined();
  test_programs();
  celspan_context_destroy(s.context);
  return check_done();
}
