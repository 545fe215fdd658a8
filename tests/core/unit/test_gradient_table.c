/* engine/paint/gradient_table.c, gradient_run.c and gradient_lines.c: programs of gradients have
 * the colours that folding their paints gives, and their runs are right within 1/1023; those
 * of one gradient with fewer colours than columns.
 */
#include "engine/paint/run.h"

#include "engine/paint/colours.h"
#include "engine/paint/over_row.h"
#include "engine/paint/shade.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

#define LEAVES 6
#define WIDTH 200

static test_random numbers = {5};

static cs_layer layers[LEAVES];
static cs_layer_rule rules[LEAVES];
static cs_shade shades[LEAVES];
static cs_group group = {.parent = CS_STACK_NONE, .first = 1, .fade = 0.6f};
static cs_back_light lights[2] = {{.below = 4, .light = {0.1f, 0.2f, 0.3f, 0}, .keep = 0.8f},
                                  {.below = 1, .light = {1, 1, 0.5f, 0}, .keep = 0.3f}};
static cs_stack stack = {.layers = layers,
                         .rules = rules,
                         .shades = shades,
                         .groups = &group,
                         .lights = lights,
                         .layer_count = LEAVES,
                         .shade_count = LEAVES,
                         .group_count = 1,
                         .light_count = 2};
static celspan_texture *linear, *upright, *radial;

static celspan_paint random_paint(void) {
  celspan_paint paint = {.beta = random_unit(&numbers)};
  for (int c = 0; c < 3; c++) {
    paint.pigment[c] = random_unit(&numbers);
    paint.medium[c] = random_unit(&numbers);
  }
  return paint;
}

/* Stops that leave both ends free, two of them in one place. */
static void make_textures(celspan_context *context) {
  celspan_stop stops[4] = {{.at = 0.1}, {.at = 0.4}, {.at = 0.4}, {.at = 0.9}};
  for (int i = 0; i < 4; i++)
    stops[i].paint = random_paint();
  celspan_point from = {20, 10}, to = {150, 60};
  CHECK(celspan_texture_create_linear(context, from, to, stops, 4, &linear) == CELSPAN_OK);
  CHECK(celspan_texture_create_linear(context, from, (celspan_point){20, 90}, stops, 4, &upright) ==
        CELSPAN_OK);
  CHECK(celspan_texture_create_radial(context, from, 160, stops, 4, &radial) == CELSPAN_OK);
}

static void make_layers(bool is_grouped, double perspective) {
  for (uint32_t i = 0; i < LEAVES; i++) {
    float fade = random_unit(&numbers), red = random_unit(&numbers), blue = random_unit(&numbers);
    float s = random_unit(&numbers), t = random_unit(&numbers);
    layers[i] = (cs_layer){.fade = fade,
                           .group = is_grouped && i > 0 && i < 4 ? 0 : CS_STACK_NONE,
                           .index = i,
                           .front = {red, 1, blue, 0},
                           .s = {0.1f, 0.2f, s, 0},
                           .t = {0.5f, t, 0.7f, 0}};
    rules[i] = (cs_layer_rule){.key = {(uint64_t)1 << i | (uint64_t)i << 40, ~(uint64_t)i << i}};
    const bool is_steady = i == 3; /* without perspective */
    shades[i] =
        (cs_shade){.texture = is_steady ? upright
                              : i % 2   ? linear
                                        : radial,
                   .inverse = {{1, 0.1 * i, 3, is_steady ? 0 : -0.2, 1, 5, perspective, 0, 1}}};
    cs_shade_prepare(&shades[i]);
  }
}

/* varying: a bit for every layer that is a gradient. */
static cs_program make_program(cs_item *items, unsigned varying) {
  for (uint32_t i = 0; i < LEAVES; i++) {
    uint32_t layer = LEAVES - 1 - i;
    layers[layer].kind = varying >> layer & 1 ? CS_LAYER_SHADED : CS_LAYER_FLAT;
    items[i] = (cs_item){.layer = layer};
  }
  return (cs_program){.items = items, .length = LEAVES};
}

/* The fold of paints, column by column. */
static void fold(cs_painter *painter, const cs_program *program, double y, float (*out)[4]) {
  static float s[CS_OVER_ROW_BATCH][4], t[CS_OVER_ROW_BATCH][4];
  cs_over_row over;
  cs_arena *arena = &painter->scratch;
  cs_arena_reset(arena);
  CHECK(cs_over_row_begin(painter->context, arena, &stack, CS_ISA_ANY, WIDTH, &over) == CELSPAN_OK);
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer *layer = &layers[program->items[i].layer];
    CHECK(cs_over_row_move(&over, program->items[i].layer) == CELSPAN_OK);
    for (int32_t x = 0; x < WIDTH && layer->kind == CS_LAYER_SHADED; x++) {
      cs_shade_lanes paint = cs_shade_paint(&shades[layer->index], x + 0.5, y);
      cs_v4_store(s[x], paint.s);
      cs_v4_store(t[x], paint.t);
    }
    if (layer->kind == CS_LAYER_SHADED)
      CHECK(cs_over_row_add_paint(&over, layer, (const float(*)[4])s, (const float(*)[4])t) ==
            CELSPAN_OK);
    else
      cs_over_row_add_layer(&over, layer);
  }
  cs_over_row_end(&over, out);
}

static bool is_near(cs_v4 a, const float *b, float tolerance) {
  bool near = true;
  for (int c = 0; c < 4; c++)
    near = near && fabsf(a[c] - b[c]) <= tolerance;
  return near;
}

/* Every pixel of a span row is near the expected colour. Returns how many pixels lie in arrays. */
static int32_t compare_row(const cs_row *row, const float (*wanted)[4]) {
  int32_t x = 0, wrong = 0, arrays = 0;
  for (size_t i = 0; i < row->count; i++)
    for (CHECK(row->spans[i].x0 == x); x < row->spans[i].x1; x++) {
      float colour[4];
      celspan_span_colour(&row->spans[i], x, colour);
      wrong += !is_near(cs_v4_load(colour), wanted[x], 1.0f / 1023);
      arrays += row->spans[i].kind == CELSPAN_SPAN_ARRAY;
    }
  CHECK(x == WIDTH);
  CHECK(wrong == 0);
  return arrays;
}

/* Every column lies in a span that is close to the expected colour there. */
static void check_run(cs_painter *painter, const cs_gradient_table *table, double y,
                      const float (*wanted)[4]) {
  cs_row row;
  cs_row_init(&row);
  uint64_t before = painter->evaluations;
  CHECK(cs_gradient_run(painter, table, (cs_run){0, WIDTH, y}, &row) == CELSPAN_OK);
  CHECK(painter->evaluations - before < WIDTH / 2);
  compare_row(&row, wanted);
  cs_row_finish(&row, painter->context->memory);
}

static void check_program(cs_painter *painter, const cs_program *program, double y) {
  static float wanted[CS_OVER_ROW_BATCH][4], made[CS_OVER_ROW_BATCH][4], one[1][4];
  const cs_gradient_table *table, *again;
  CHECK(cs_gradient_table_find(painter->gradients, program, &table) == CELSPAN_OK);
  if (!CHECK(table != NULL))
    return;
  CHECK(cs_gradient_table_find(painter->gradients, program, &again) == CELSPAN_OK &&
        again == table);
  fold(painter, program, y, wanted);
  cs_gradient_table_colours(table, &(cs_batch){NULL, 0, WIDTH, y}, made);
  int32_t wrong = 0;
  for (int32_t x = 0; x < WIDTH; x++) {
    cs_gradient_table_colours(table, &(cs_batch){NULL, x, 1, y}, one);
    wrong += memcmp(one[0], made[x], sizeof one[0]) != 0; /* whatever its neighbours */
    wrong += !is_near(cs_v4_load(made[x]), wanted[x], 2e-6f);
  }
  CHECK(wrong == 0);
  if (cs_gradient_run_fits(table))
    check_run(painter, table, y, (const float(*)[4])wanted);
}

static int32_t pixels_in_arrays;

/* A program of several gradients: a few pixels have the bits that a whole row has, and its run is
 * right within 1/1023. */
static void check_several(cs_painter *painter, const cs_program *program, double y) {
  static float wanted[CS_OVER_ROW_BATCH][4], few[3][4];
  int32_t wrong = 0;
  cs_row row;
  fold(painter, program, y, wanted);
  for (int32_t x = 0; x + 3 <= WIDTH; x += 3) {
    CHECK(cs_painter_program_colours(painter, program, (cs_run){x, x + 3, y}, few) == CELSPAN_OK);
    for (int32_t k = 0; k < 3; k++)
      wrong += memcmp(few[k], wanted[x + k], 3 * sizeof(float)) != 0 ||
               fabsf(few[k][3] - wanted[x + k][3]) > 2e-7f;
  }
  CHECK(wrong == 0);
  cs_row_init(&row);
  CHECK(cs_lines_run(painter, program, (cs_run){0, WIDTH, y}, &row) == CELSPAN_OK);
  pixels_in_arrays += compare_row(&row, (const float(*)[4])wanted);
  cs_row_finish(&row, painter->context->memory);
}

/* All programs of six layers with one gradient or more, in rows near and far from the centre. */
static void test_programs(celspan_context *context, bool is_grouped, double perspective) {
  cs_composer composer;
  cs_painter painter;
  cs_item items[LEAVES];
  make_layers(is_grouped, perspective);
  CHECK(cs_composer_init(&composer, context, &stack, cs_painter_opacity(&painter)) == CELSPAN_OK);
  CHECK(cs_painter_init(&painter, context, composer.stack, &composer) == CELSPAN_OK);
  for (unsigned varying = 1; varying < 1u << LEAVES; varying++) {
    /* A layer's kind never changes, so layers alone identify a table. */
    cs_gradient_tables_destroy(painter.gradients, context->memory);
    CHECK(cs_gradient_tables_create(context, &stack, painter.isa, &painter.scratch,
                                    &painter.gradients) == CELSPAN_OK);
    cs_program program = make_program(items, varying);
    const cs_gradient_table *table;
    if ((varying & (varying - 1)) != 0) {
      CHECK(cs_gradient_table_find(painter.gradients, &program, &table) == CELSPAN_OK && !table);
      for (double y = 0.5; y < 120; y += 17)
        check_several(&painter, &program, y);
      continue;
    }
    for (double y = 0.5; y < 120; y += 17)
      check_program(&painter, &program, y);
  }
  cs_painter_finish(&painter);
  cs_composer_finish(&composer);
}

/* ---------------------------------------------------------------- more than are remembered */

enum { FLATS = 9, PROGRAMS = 1 << FLATS, MANY_STOPS = 200, COLUMNS = 4 };

/* Any of the flat layers over and under a gradient of many stops. */
static cs_program make_subset(cs_item *items, unsigned subset) {
  uint32_t length = 0;
  for (uint32_t layer = FLATS + 1; layer-- > 0;)
    if (layer == FLATS / 2 || (subset >> (layer - (layer > FLATS / 2)) & 1))
      items[length++] = (cs_item){.layer = layer};
  return (cs_program){.items = items, .length = length};
}

static void find_colours(cs_painter *painter, unsigned subset, float (*out)[4]) {
  cs_item items[FLATS + 1];
  const int32_t columns[COLUMNS] = {25, 60, 100, 149};
  const cs_gradient_table *table;
  cs_program program = make_subset(items, subset);
  CHECK(cs_gradient_table_find(painter->gradients, &program, &table) == CELSPAN_OK);
  if (CHECK(table != NULL))
    cs_gradient_table_colours(table, &(cs_batch){columns, 0, COLUMNS, 30}, out);
}

/* Programs are discarded when there are many, and made again: a frame with more of them than the
 * cache keeps has the same colours. */
static void test_forgotten(celspan_context *context) {
  static cs_layer many[FLATS + 1];
  static cs_layer_rule keys[FLATS + 1];
  static float colours[PROGRAMS][COLUMNS][4], again[COLUMNS][4];
  celspan_stop stops[MANY_STOPS];
  celspan_texture *texture;
  for (int i = 0; i < MANY_STOPS; i++)
    stops[i] = (celspan_stop){(double)i / MANY_STOPS, random_paint()};
  CHECK(celspan_texture_create_linear(context, (celspan_point){20, 10}, (celspan_point){150, 60},
                                      stops, MANY_STOPS, &texture) == CELSPAN_OK);
  for (uint32_t i = 0; i <= FLATS; i++) {
    float red = random_unit(&numbers), through = random_unit(&numbers);
    many[i] = (cs_layer){.kind = i == FLATS / 2 ? CS_LAYER_SHADED : CS_LAYER_FLAT,
                         .fade = 1,
                         .group = CS_STACK_NONE,
                         .front = {1, 1, 1, 0},
                         .s = {0.2f * red, 0.1f, 0, 0},
                         .t = {through, 0.8f, 0.9f, 0}};
    for (int k = 0; k < 2; k++)
      keys[i].key[k] = random_bits(&numbers);
  }
  cs_shade shade = {.texture = texture, .inverse = {{1, 0, 0, 0, 1, 0, 0, 0, 1}}};
  const cs_stack full = {
      .layers = many, .rules = keys, .shades = &shade, .layer_count = FLATS + 1, .shade_count = 1};
  cs_composer composer;
  cs_painter painter;
  cs_shade_prepare(&shade);
  CHECK(cs_composer_init(&composer, context, &full, cs_painter_opacity(&painter)) == CELSPAN_OK);
  CHECK(cs_painter_init(&painter, context, composer.stack, &composer) == CELSPAN_OK);
  for (unsigned subset = 0; subset < PROGRAMS; subset++)
    find_colours(&painter, subset, colours[subset]);
  int wrong = 0;
  for (unsigned subset = 0; subset < PROGRAMS; subset++) {
    find_colours(&painter, subset, again);
    wrong += memcmp(again, colours[subset], sizeof again) != 0;
  }
  CHECK(wrong == 0);
  cs_painter_finish(&painter);
  cs_composer_finish(&composer);
  celspan_texture_unref(texture);
}

int main(void) {
  celspan_context *context;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  make_textures(context);
  test_programs(context, false, 0);
  test_programs(context, true, 0);
  test_programs(context, false, 0.002);
  test_programs(context, false, -0.012); /* with a horizon */
  CHECK(pixels_in_arrays > 0);
  test_forgotten(context);
  celspan_texture_unref(linear);
  celspan_texture_unref(upright);
  celspan_texture_unref(radial);
  celspan_context_destroy(context);
  return check_done();
}
