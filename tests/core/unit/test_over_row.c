/* engine/paint/over_row.c: every instruction set gives the same fold, and every pixel is
 * independent.
 */
#include "engine/paint/over_bare.h"

#include "model/colour/srgb8.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

static test_random numbers = {11};

static float rgba[CS_OVER_ROW_BATCH][4], s[CS_OVER_ROW_BATCH][4], t[CS_OVER_ROW_BATCH][4];
static cs_layer all_layers[6];
static cs_group groups[2] = {{.parent = CS_STACK_NONE, .first = 1, .fade = 0.7f},
                             {.parent = 0, .first = 2, .fade = 0.4f}};
static cs_back_light lights[2] = {{.below = 5, .light = {0.1f, 0.2f, 0.3f, 0}, .keep = 0.8f},
                                  {.below = 1, .light = {1, 1, 0.5f, 0}, .keep = 0.1f}};
static const cs_stack stack = {.layers = all_layers,
                               .layer_count = 6,
                               .groups = groups,
                               .group_count = 2,
                               .lights = lights,
                               .light_count = 2};

static void fill(void) {
  for (int i = 0; i < CS_OVER_ROW_BATCH; i++)
    for (int c = 0; c < 4; c++) {
      rgba[i][c] = c == 3 ? 0.5f + 0.5f * random_unit(&numbers) : 0.4f * random_unit(&numbers);
      s[i][c] = 0.4f * random_unit(&numbers);
      t[i][c] = random_unit(&numbers);
    }
  for (uint32_t i = 0; i < 6; i++) {
    float fade = i == 5 ? 1 : random_unit(&numbers);
    float red = random_unit(&numbers), blue = 2 * random_unit(&numbers);
    float from_front = random_unit(&numbers), through = random_unit(&numbers);
    all_layers[i] = (cs_layer){.fade = fade,
                               .group = i == 0 || i == 5  ? CS_STACK_NONE
                                        : i < 2 || i == 4 ? 0
                                                          : 1,
                               .front = {red, 1, blue, 0},
                               .s = {0.1f, 0.2f, from_front, 0},
                               .t = {0.5f, through, 0.7f, 0}};
  }
}

/* Leaves 5 .. 0 from the front, given as flat layers, paints and samples, groups and lights between
 * them. */
static void fold(celspan_context *context, cs_arena *arena, cs_isa isa, int32_t from, int32_t count,
                 float (*out)[4]) {
  cs_over_row over;
  cs_arena_reset(arena);
  CHECK(cs_over_row_begin(context, arena, &stack, isa, count, &over) == CELSPAN_OK);
  for (uint32_t layer = 6; layer-- > 0;) {
    CHECK(cs_over_row_move(&over, layer) == CELSPAN_OK);
    if (layer % 3 == 0)
      cs_over_row_add_layer(&over, &all_layers[layer]);
    else if (layer % 3 == 1)
      CHECK(cs_over_row_add_paint(&over, &all_layers[layer], (const float(*)[4])s + from,
                                  (const float(*)[4])t + from) == CELSPAN_OK);
    else
      CHECK(cs_over_row_add_samples(&over, &all_layers[layer],
                                    layer == 2 ? CELSPAN_PICTURE_GEL : CELSPAN_PICTURE_PAINT,
                                    (const float(*)[4])rgba + from) == CELSPAN_OK);
  }
  cs_over_row_end(&over, out);
}

/* The fold of one pixel by definition, in doubles; groups are folded by recursion. */
static double by_hand_alpha(int i) {
  double through[3] = {1, 1, 1}, inner[3] = {1, 1, 1}, innermost[3] = {1, 1, 1}, mean = 0;
  for (int c = 0; c < 3; c++) {
    const cs_layer *l = all_layers;
    double alpha = (double)rgba[i][3],
           front = 1 - alpha; /* layer 5 is a picture that is not faded */
    through[c] *= front;
    inner[c] *= 1 - (double)l[4].fade + (double)l[4].fade * (double)t[i][c];
    innermost[c] *= (double)l[3].t[c];
    innermost[c] *=
        1 - (double)l[2].fade + (double)l[2].fade * fmin(1, 1 - alpha + (double)rgba[i][c]);
    inner[c] *= 1 - (double)groups[1].fade + (double)groups[1].fade * innermost[c];
    inner[c] *= 1 - (double)l[1].fade + (double)l[1].fade * (double)t[i][c];
    through[c] *= 1 - (double)groups[0].fade + (double)groups[0].fade * inner[c];
    through[c] *= (double)l[0].t[c];
    mean += through[c] / 3;
  }
  return 1 - (double)lights[0].keep * (double)lights[1].keep * mean;
}

/* The samples of a picture in the visible pixels; values outside them have no meaning. */
static cs_samples shown_samples(const cs_over_bare *over, const float (*picture)[4],
                                bool are_planes) {
  cs_samples out = {.are_planes = are_planes};
  memset(out.rgba, 0xff, sizeof out.rgba);
  for (int32_t i = 0; i < over->shown.end - over->shown.first; i++)
    for (int32_t c = 0; c < 4; c++) {
      int32_t lane = 4 * (i % 4) + i / 4 % 4, plane = i / CS_SAMPLES_PLANE * CS_SAMPLES_PLANE;
      float *at = (float *)out.rgba + (are_planes ? 4 * plane + 16 * c + lane : 4 * i + c);
      *at = picture[over->shown.first + i][c];
    }
  return out;
}

/* Pictures alone: the same result as the general fold. */
static void check_bare(celspan_context *context, cs_arena *arena, const cs_stack *bare, cs_isa isa,
                       bool are_planes, int32_t count) {
  static cs_over_bare layers;
  static float wanted[CS_OVER_ROW_BATCH][4], made[CS_OVER_ROW_BATCH][4];
  static unsigned char codes[4 * CS_OVER_ROW_BATCH + 4];
  cs_over_row over;
  cs_arena_reset(arena);
  CHECK(cs_over_row_begin(context, arena, bare, CS_ISA_ANY, count, &over) == CELSPAN_OK);
  cs_over_bare_begin(&layers, count);
  const float(*samples[2])[4] = {(const float(*)[4])rgba, (const float(*)[4])s};
  for (uint32_t i = 0; i < 2; i++) {
    CHECK(cs_over_row_move(&over, 5 - i) == CELSPAN_OK);
    CHECK(cs_over_row_add_samples(&over, &all_layers[5], CELSPAN_PICTURE_PAINT, samples[i]) ==
          CELSPAN_OK);
    layers.last = shown_samples(&layers, samples[i], are_planes);
    if (i == 0)
      cs_over_bare_add(isa, &layers);
  }
  cs_over_row_end(&over, wanted);
  codes[4 * count] = 77;
  cs_over_bare_codes(isa, bare, &layers, codes);
  cs_over_bare_end(isa, bare, &layers, made);
  CHECK(memcmp(made, wanted, (size_t)count * sizeof *made) == 0);
  for (int32_t k = 0; k < count; k++) {
    uint32_t pixel = cs_srgb8_pixel(wanted[k]);
    CHECK(memcmp(codes + 4 * k, &pixel, sizeof pixel) == 0);
  }
  CHECK(codes[4 * count] == 77);
}

/* Where the first picture is opaque, the second is not sampled, except next to visible pixels. */
static void check_shown(cs_isa isa, int32_t count, int32_t opaque) {
  static cs_over_bare over;
  cs_over_bare_begin(&over, count);
  over.last = shown_samples(&over, (const float(*)[4])rgba, false);
  cs_over_bare_add(isa, &over);
  cs_over_bare_range shown = over.shown;
  if (opaque >= count)
    CHECK(shown.first >= shown.end);
  else
    CHECK(shown.first <= opaque && shown.first > opaque - CS_SAMPLES_PLANE && shown.end == count);
}

/* If a picture is opaque wherever it is visible, nothing behind it is sampled, whatever lies
 * outside the visible pixels. */
static void check_ends(cs_isa isa) {
  for (int32_t count = 1; count <= 40; count++) {
    for (int i = 0; i < CS_OVER_ROW_BATCH; i++)
      rgba[i][3] = i < count ? 1 : 0.5f;
    check_shown(isa, count, count);
  }
}

static void test_bare(celspan_context *context, cs_arena *arena) {
  const cs_stack unlit = {.layers = all_layers, .layer_count = 6};
  const cs_stack lit = {
      .layers = all_layers, .layer_count = 6, .lights = lights + 1, .light_count = 1};
  all_layers[4] = all_layers[5] =
      (cs_layer){.fade = 1, .group = CS_STACK_NONE, .front = {1, 1, 1, 0}};
  for (int opaque = 0; opaque <= CS_OVER_ROW_BATCH; opaque += 61) {
    fill();
    all_layers[4] = all_layers[5] =
        (cs_layer){.fade = 1, .group = CS_STACK_NONE, .front = {1, 1, 1, 0}};
    for (int i = 0; i < CS_OVER_ROW_BATCH; i++) {
      rgba[i][3] = i < opaque ? 1 : rgba[i][3];
      s[i][3] = opaque % 2 == 0 ? 1 : 0.7f;
    }
    for (cs_isa isa = CS_ISA_ANY; isa <= cs_isa_best(); isa++)
      for (int32_t count = 1; count <= CS_OVER_ROW_BATCH; count += 51) {
        for (int planes = 0; planes <= (isa == CS_ISA_AVX512); planes++) {
          check_bare(context, arena, &unlit, isa, planes, count);
          check_bare(context, arena, &lit, isa, planes, count);
        }
        check_shown(isa, count, opaque);
      }
  }
}

/* ---------------------------------------------------------------- modes */

static float channel_of(int i) { return i % 5 == 0 ? 0 : i % 7 == 0 ? 1 : random_unit(&numbers); }

/* Colours with their alpha, from 0 to 1, both ends among them. */
static void random_state_of(cs_over_row_state *state) {
  for (int i = 0; i < CS_OVER_ROW_BATCH; i++)
    for (int c = 0; c < 3; c++) {
      state->t[i][c] = c > 0 && i % 3 ? state->t[i][0] : channel_of(i / 2 + c);
      state->e[i][c] = (1 - state->t[i][c]) * channel_of(i + c);
    }
}

/* Many pixels are blended as one is, to the bit. */
static void check_blend(cs_isa isa, celspan_blend mode) {
  static cs_over_row_state source, back, made;
  const float keep = random_below(&numbers, 2) ? 1 : 0.4f;
  const float fade = random_below(&numbers, 2) ? 1 : 0.7f;
  random_state_of(&source);
  random_state_of(&back);
  made = back;
  CS_WIDE_CHOOSE(isa, cs_over_row_blend)
  (&source, CS_OVER_ROW_BATCH, fade, mode, keep, &made);
  for (int i = 0; i < CS_OVER_ROW_BATCH; i++) {
    float kept = keep;
    cs_over_pair above = {fade * cs_v4_load(source.e[i]),
                          (1 - fade) + fade * cs_v4_load(source.t[i])};
    cs_over_pair behind = {cs_v4_load(back.e[i]), cs_v4_load(back.t[i])};
    cs_over_pair wanted = cs_over_blend(mode, above, behind, &kept);
    if (!CHECK(memcmp(&wanted.e, made.e[i], 3 * sizeof(float)) == 0) ||
        !CHECK(memcmp(&wanted.t, made.t[i], 3 * sizeof(float)) == 0))
      fprintf(stderr, "  mode %d, pixel %d, isa %d\n", (int)mode, i, (int)isa);
  }
}

static void check_modes(cs_isa isa) {
  for (unsigned mode = 0; mode < CS_BLEND_COUNT; mode++) {
    check_blend(isa, (celspan_blend)mode);
    if (mode != CELSPAN_BLEND_NORMAL)
      check_blend(isa, (celspan_blend)(mode | CS_BLEND_WITHIN));
  }
}

int main(void) {
  celspan_context *context;
  cs_arena arena;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  cs_arena_init(&arena);
  for (int round = 0; round < 20; round++) {
    float wanted[CS_OVER_ROW_BATCH][4], made[CS_OVER_ROW_BATCH][4];
    fill();
    fold(context, &arena, CS_ISA_ANY, 0, CS_OVER_ROW_BATCH, wanted);
    for (cs_isa isa = CS_ISA_ANY; isa <= cs_isa_best(); isa++) {
      fold(context, &arena, isa, 0, CS_OVER_ROW_BATCH, made);
      CHECK(memcmp(made, wanted, sizeof wanted) == 0);
      for (int32_t from = 0; from < 200; from += 37) { /* alone, and in odd numbers */
        int32_t count = 1 + from % 7;
        made[count][0] = -1;
        fold(context, &arena, isa, from, count, made);
        CHECK(memcmp(made, wanted + from, (size_t)count * sizeof *made) == 0);
        CHECK(made[count][0] == -1);
      }
    }
    for (int i = 0; i < CS_OVER_ROW_BATCH; i += 17)
      CHECK_NEAR((double)wanted[i][3], by_hand_alpha(i), 1e-6);
  }
  test_bare(context, &arena);
  for (cs_isa isa = CS_ISA_ANY; isa <= cs_isa_best(); isa++)
    check_ends(isa);
  for (cs_isa isa = CS_ISA_ANY; isa <= cs_isa_best(); isa++)
    for (int round = 0; round < 10; round++)
      check_modes(isa);
  cs_arena_finish(&arena, context->memory);
  celspan_context_destroy(context);
  return check_done();
}
