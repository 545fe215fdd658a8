/* engine/paint/over_channels.c: programs of gradients that dim all channels alike have the bits
 * that folding their paints gives, with every set of instructions, whatever pixels a batch has,
 * also under a front light with a shape.
 */
#include "engine/paint/over_channels.h"

#include "engine/paint/colours.h"
#include "model/colour/srgb8.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

enum { LEAVES = 5, WIDTH = 200, TRIES = 300 };

static test_random numbers = {11};

static cs_layer layers[LEAVES];
static cs_layer_rule rules[LEAVES];
static cs_shade shades[LEAVES];
static cs_back_light lights[1];
static cs_group groups[1];
static celspan_texture *textures[4];
static cs_stack stack = {.layers = layers,
                         .rules = rules,
                         .shades = shades,
                         .lights = lights,
                         .groups = groups,
                         .layer_count = LEAVES,
                         .shade_count = LEAVES};

static celspan_paint grey_paint(void) {
  celspan_paint paint = {.beta = random_unit(&numbers)};
  float medium = random_unit(&numbers);
  for (int c = 0; c < 3; c++) {
    paint.pigment[c] = random_unit(&numbers);
    paint.medium[c] = medium;
  }
  return paint;
}

/* Slanted, upright, radial and conic, with stops in one place. */
static void make_textures(celspan_context *context) {
  celspan_point from = {20, 10};
  celspan_stop stops[4] = {{.at = 0.1}, {.at = 0.4}, {.at = 0.4}, {.at = 0.9}};
  for (int i = 0; i < 4; i++)
    stops[i].paint = grey_paint();
  CHECK(celspan_texture_create_linear(context, from, (celspan_point){150, 60}, stops, 4,
                                      &textures[0]) == CELSPAN_OK);
  CHECK(celspan_texture_create_linear(context, from, (celspan_point){20, 90}, stops, 4,
                                      &textures[1]) == CELSPAN_OK);
  CHECK(celspan_texture_create_radial(context, from, 160, stops, 4, &textures[2]) == CELSPAN_OK);
  CHECK(celspan_texture_create_conic(context, from, 0.3, stops, 4, &textures[3]) == CELSPAN_OK);
}

static float sometimes_one(void) {
  return random_below(&numbers, 2) == 0 ? 1 : random_unit(&numbers);
}

/* Layers of which each may be flat, bare or lit, and in perspective. */
static void make_layers(void) {
  for (uint32_t i = 0; i < LEAVES; i++) {
    float through = random_unit(&numbers);
    float light = sometimes_one();
    double tilt = random_below(&numbers, 4) == 0 ? 0.008 : 0; /* the horizon lies at column 125 */
    float blue = light * sometimes_one();
    float fade = sometimes_one();
    float green = random_unit(&numbers);
    bool is_shaded = i < 2 || random_below(&numbers, 3) > 0;
    layers[i] = (cs_layer){.kind = is_shaded ? CS_LAYER_SHADED : CS_LAYER_FLAT,
                           .group = CS_STACK_NONE,
                           .index = i,
                           .fade = fade,
                           .front = {light, light, blue, 0},
                           .s = {0.1f, green, 0.3f, 0},
                           .t = {through, through, through, 0}};
    rules[i] = (cs_layer_rule){.key = {(uint64_t)1 << i, ~(uint64_t)i}};
    shades[i] = (cs_shade){.texture = textures[random_below(&numbers, 4)],
                           .inverse = {{1, 0, 5.0 * i, 0, 1, 3, -tilt, 0, 1}}};
    cs_shade_prepare(&shades[i]);
  }
  lights[0] = (cs_back_light){.light = {0.5f, random_unit(&numbers), 1, 0}, .keep = 0.3f};
  stack.light_count = (size_t)random_below(&numbers, 2);
}

/* Puts all layers into a group, which the one in front may light. */
static void make_group(void) {
  cs_layer *front = &layers[LEAVES - 1];
  groups[0] = (cs_group){.parent = CS_STACK_NONE,
                         .fade = 1,
                         .has_light = random_below(&numbers, 4) > 0,
                         .converts = CELSPAN_SPACE_AROUND,
                         .light = LEAVES - 1};
  for (uint32_t i = 0; i < LEAVES; i++)
    layers[i].group = 0;
  stack.group_count = 1;
  stack.light_count = 0;
  if (!groups[0].has_light)
    return;
  front->kind = CS_LAYER_SHADED;
  front->role = CS_LAYER_FRONT;
  front->front *= random_below(&numbers, 4) == 0 ? 1e13f : 1.5f;
}

/* The fold of paints. */
static void fold(cs_painter *painter, const cs_program *program, double y, float (*out)[4]) {
  static float s[CS_OVER_ROW_BATCH][4], t[CS_OVER_ROW_BATCH][4];
  cs_over_row over;
  cs_arena_reset(&painter->scratch);
  CHECK(cs_over_row_begin(painter->context, &painter->scratch, &stack, CS_ISA_ANY, WIDTH, &over) ==
        CELSPAN_OK);
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer *layer = &layers[program->items[i].layer];
    for (int32_t x = 0; x < WIDTH && layer->kind == CS_LAYER_SHADED; x++) {
      cs_shade_lanes paint = cs_shade_paint(&shades[layer->index], x + 0.5, y);
      cs_v4_store(s[x], paint.s);
      cs_v4_store(t[x], paint.t);
    }
    CHECK(cs_over_row_layer(&over, program->items[i].layer, (const float(*)[4])s,
                            (const float(*)[4])t) == CELSPAN_OK);
  }
  cs_over_row_end(&over, out);
}

/* Colours and codes of a batch are those of the same pixels of the row. */
static void check_batch(cs_painter *painter, const cs_program *program, const cs_batch *batch,
                        const float (*wanted)[4]) {
  static float made[CS_OVER_ROW_BATCH][4];
  uint32_t codes[CS_OVER_ROW_BATCH];
  int32_t wrong = 0;
  CHECK(cs_painter_batch_colours(painter, program, batch, made) == CELSPAN_OK);
  CHECK(cs_painter_batch_codes(painter, program, batch, (unsigned char *)codes) == CELSPAN_OK);
  for (int32_t k = 0; k < batch->count; k++) {
    int32_t x = batch->columns ? batch->columns[k] : batch->x0 + k;
    wrong += memcmp(made[k], wanted[x], sizeof made[k]) != 0;
    wrong += codes[k] != cs_srgb8_pixel(wanted[x]);
  }
  CHECK(wrong == 0);
}

static bool is_ready(const cs_painter *painter, const cs_program *program, int32_t x0,
                     int32_t count, double y) {
  static float rgba[CS_OVER_ROW_BATCH][4];
  return cs_over_channels_ready(painter, program, &(cs_batch){NULL, x0, count, y}, rgba);
}

/* What has been folded ahead is given for these pixels of this program, and is not folded again. */
static void check_ahead(cs_painter *painter, const cs_program *program, double y,
                        const float (*wanted)[4]) {
  const int32_t x0 = 1 + random_below(&numbers, WIDTH - 20), x1 = x0 + 12, listed[] = {x0, x1 - 1};
  const cs_program shorter = {program->items + 1, NULL, program->length - 1};
  cs_over_channels_prepare(painter, program, (cs_run){x0, x1, y});
  cs_over_channels_prepare(painter, &shorter, (cs_run){x0, x1, y});
  const uint64_t evaluations = painter->evaluations;
  cs_over_channels_prepare(painter, program, (cs_run){x0 + 1, x1, y});
  check_batch(painter, program, &(cs_batch){NULL, x0, 12, y}, wanted);
  check_batch(painter, program, &(cs_batch){NULL, x0 + 5, 3, y}, wanted);
  CHECK(painter->evaluations == evaluations);
  check_batch(painter, program, &(cs_batch){listed, 0, 2, y}, wanted);
  CHECK(painter->evaluations == evaluations + 2); /* codes of listed pixels are folded */
  CHECK(is_ready(painter, program, x0, 12, y) && is_ready(painter, &shorter, x0, 12, y));
  CHECK(!is_ready(painter, program, x0 - 1, 12, y) && !is_ready(painter, program, x0 + 1, 12, y));
  CHECK(!is_ready(painter, program, x0, 12, y + 1));
  const cs_program prefix = {program->items, NULL, program->length - 1};
  CHECK(!is_ready(painter, &prefix, x0, 12, y));
  const cs_program other = {program->items + 2, NULL, program->length - 2};
  CHECK(!is_ready(painter, &other, x0, 12, y));
  cs_over_channels_prepare(painter, &other, (cs_run){x0, x1, y});
  CHECK(!is_ready(painter, program, x0, 12, y)); /* two at most */
}

static void check_row(cs_painter *painter, const cs_program *program, double y) {
  static float wanted[CS_OVER_ROW_BATCH][4];
  static int32_t columns[WIDTH];
  fold(painter, program, y, wanted);
  for (int isa = CS_ISA_ANY; isa <= (int)cs_isa_best(); isa++) {
    int32_t x0 = random_below(&numbers, WIDTH - 1), listed = 0;
    for (int32_t x = x0; x < WIDTH; x += 1 + random_below(&numbers, 9))
      columns[listed++] = x;
    painter->isa = (cs_isa)isa;
    check_batch(painter, program, &(cs_batch){NULL, 0, WIDTH, y}, (const float(*)[4])wanted);
    check_batch(painter, program, &(cs_batch){NULL, x0, 1 + random_below(&numbers, WIDTH - x0), y},
                (const float(*)[4])wanted);
    check_batch(painter, program, &(cs_batch){columns, 0, listed, y}, (const float(*)[4])wanted);
    check_ahead(painter, program, y, (const float(*)[4])wanted);
  }
}

/* Programs that are not folded so. */
static void check_refusals(const cs_program *program) {
  cs_stack other = stack;
  cs_back_light near = {.below = LEAVES - 1};
  other.lights = &near;
  other.light_count = 1;
  CHECK(!cs_over_channels_fits(&other, program)); /* a light between the layers */
  other = stack;
  other.has_root = true;
  CHECK(!cs_over_channels_fits(&other, program));
  const cs_layer kept = layers[0];
  layers[0].group = kept.group == CS_STACK_NONE ? 0 : CS_STACK_NONE;
  CHECK(!cs_over_channels_fits(&stack, program));
  layers[0] = kept;
  layers[0].role = CS_LAYER_BACK;
  CHECK(!cs_over_channels_fits(&stack, program));
  layers[0] = kept;
  shades[0].is_even = false;
  CHECK(!cs_over_channels_fits(&stack, program));
  shades[0].is_even = true;
}

/* Groups that do more than be lit. */
static void check_group_refusals(const cs_program *program) {
  const cs_group kept = groups[0];
  const cs_grade grade = {0};
  cs_group others[6] = {kept, kept, kept, kept, kept, kept};
  others[0].fade = 0.5f;
  others[1].has_front = true;
  others[2].kind = CS_GROUP_MATTE;
  others[3].parent = 0;
  others[4].converts = CELSPAN_SPACE_SRGB;
  others[5].grade = &grade;
  for (int i = 0; i < 6; i++) {
    groups[0] = others[i];
    CHECK(!cs_over_channels_fits(&stack, program));
  }
  groups[0] = kept;
  stack.light_count = 1;
  CHECK(!cs_over_channels_fits(&stack, program));
  stack.light_count = 0;
}

int main(void) {
  celspan_context *context;
  cs_composer composer;
  cs_painter painter;
  cs_item items[LEAVES];
  for (uint32_t i = 0; i < LEAVES; i++)
    items[i] = (cs_item){.layer = LEAVES - 1 - i};
  const cs_program program = {.items = items, .length = LEAVES};
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  make_textures(context);
  for (int i = 0; i < TRIES; i++) {
    make_layers();
    stack.group_count = 0;
    if (i % 2 == 1)
      make_group();
    CHECK(cs_composer_init(&composer, context, &stack, cs_painter_opacity(&painter)) == CELSPAN_OK);
    CHECK(cs_painter_init(&painter, context, composer.stack, &composer) == CELSPAN_OK);
    CHECK(cs_over_channels_fits(&stack, &program));
    check_row(&painter, &program, random_between(&numbers, -20, 140));
    check_refusals(&program);
    if (stack.group_count > 0)
      check_group_refusals(&program);
    cs_painter_finish(&painter);
    cs_composer_finish(&composer);
  }
  for (int i = 0; i < 4; i++)
    celspan_texture_unref(textures[i]);
  celspan_context_destroy(context);
  return check_done();
}
