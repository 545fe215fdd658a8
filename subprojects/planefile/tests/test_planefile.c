/* Written planes are read back and drawn; truncated, altered and inconsistent files are refused;
 * memory is limited. One list of cases, long because there are many kinds of damage. */
#include <math.h>

#include "../src/coder.h"
#include "../src/codes.h"
#include "../src/plane.h"
#include "mend.h"
#include "support.h"

/* ---------------------------------------------------------------- numbers */

static uint32_t any_number(random_state *random) {
  uint32_t bits = random_below(random, 33);
  return bits == 0 ? 0 : random_next(random) >> (32 - bits);
}

static void test_numbers(void) {
  enum { COUNT = 20000 };
  pf_memory memory = pf_memory_of(NULL, NULL);
  pf_encoder encoder;
  pf_decoder decoder;
  for (int turn = 0; turn < 2; turn++) {
    static pf_number model;
    uint16_t *models = (uint16_t *)&model;
    for (size_t i = 0; i < sizeof model / 2; i++)
      models[i] = PF_EVEN;
    random_state random = {3};
    if (turn == 0)
      pf_encoder_begin(&encoder, &memory, 0);
    else
      pf_decoder_begin(&decoder, encoder.bytes, encoder.count);
    for (int i = 0; i < COUNT; i++) {
      uint32_t number = i < 3 ? UINT32_MAX : any_number(&random);
      int64_t other = (int64_t)(number >> 1) - (i % 2 ? 0 : number);
      if (turn == 0) {
        pf_put_number(&encoder, &model, number);
        pf_put_signed(&encoder, &model, other);
      } else {
        CHECK(pf_get_number(&decoder, &model) == number);
        CHECK(pf_get_signed(&decoder, &model) == other);
      }
    }
    if (turn == 0)
      pf_encoder_end(&encoder);
    else
      CHECK(pf_decoder_is_whole(&decoder) && decoder.at == decoder.end);
  }
  pf_decoder_begin(&decoder, encoder.bytes, encoder.count - 1);
  CHECK(!decoder.is_beyond);
  pf_encoder_finish(&encoder);
}

static void test_checksum(void) { CHECK(pf_crc32c(0, "123456789", 9) == 0xe3069283); }

/* ---------------------------------------------------------------- there and back */

static bool is_same_border(const planefile_band *a, const planefile_band *b, uint32_t i) {
  const planefile_border *p = &a->borders[i], *q = &b->borders[i];
  return p->top == q->top && p->foot == q->foot &&
         memcmp(&a->cells[p->left], &b->cells[q->left], sizeof *a->cells) == 0 &&
         memcmp(&a->cells[p->right], &b->cells[q->right], sizeof *a->cells) == 0;
}

/* A band that was read, with the pictures of which it was made: those of its sizes. */
static planefile_band with_pictures(const planefile_plane *plane, planefile_picture *pictures) {
  planefile_band band = *planefile_plane_band(plane, 0);
  for (uint32_t i = 0; i < band.picture_count; i++)
    for (uint32_t k = 0; k < PICTURES; k++)
      if (test_pictures()[k].width == plane->pictures[i].width)
        pictures[i] = test_pictures()[k];
  band.pictures = pictures;
  return band;
}

/* What is read is written as the same bytes, and has as many borders as were written. */
static void test_round_trips(void) {
  for (uint64_t seed = 0; seed < 300; seed++) {
    written w = random_written(seed, (uint32_t)(seed % 40), seed / 40 % 2 ? VARIED : FLAT);
    const planefile_band *band = planefile_plane_band(w.plane, 0);
    planefile_info info = planefile_plane_info(w.plane);
    CHECK(info.width == 4 && info.height == 3 && info.band_count == 1);
    CHECK(info.is_opaque == (seed % 3 == 0) || w.d.plane.cell_count < 3);
    CHECK(band->border_count == w.d.plane.border_count);
    planefile_picture pictures[PICTURES];
    const planefile_band whole = with_pictures(w.plane, pictures);
    memory_file again = write_plane(&whole);
    planefile_plane *other = read_plane(&again);
    CHECK(memory_is_same(&again, &w.file));
    for (uint32_t i = 0; i < band->border_count; i++)
      CHECK(is_same_border(band, planefile_plane_band(other, 0), i));
    planefile_plane_destroy(other);
    free(again.bytes);
    written_free(&w);
  }
}

/* ---------------------------------------------------------------- 8-bit colours */

/* Each code has a colour that is rounded to itself, whatever its alpha. */
static void test_rounding(void) {
  planefile_rounding *rounding = planefile_rounding_create(NULL, NULL);
  random_state random = {3};
  pf_codes codes;
  pf_codes_make(&codes);
  for (int alpha = 0; alpha < 256; alpha++)
    for (int code = 0; code < 256; code++) {
      const int32_t straight[4] = {code, code / 2, 255 - code, alpha};
      planefile_cell cell = pf_codes_cell(&codes, straight);
      planefile_cell again = planefile_round(rounding, cell);
      CHECK(memcmp(&cell, &again, sizeof cell) == 0);
    }
  for (int i = 0; i < 1000; i++) {
    planefile_cell cell = random_colour(&random, true), near = planefile_round(rounding, cell);
    for (int c = 0; c < 3; c++)
      CHECK(pf_codes_find(&codes, near.colour[c]) == pf_codes_find(&codes, cell.colour[c]));
  }
  const planefile_cell bright = {{-5, PLANEFILE_BRIGHT, 70000, 70000}};
  const planefile_cell limited = {{0, PLANEFILE_WHITE, PLANEFILE_WHITE, PLANEFILE_WHITE}};
  planefile_cell near = planefile_round(rounding, bright);
  CHECK(memcmp(&near, &limited, sizeof near) == 0);
  planefile_rounding_destroy(rounding);
  planefile_rounding_destroy(NULL);
}

/* Cells are read as they are rounded, and what is read is written as the same bytes. */
static void test_coded(void) {
  planefile_rounding *rounding = planefile_rounding_create(NULL, NULL);
  for (uint64_t seed = 0; seed < 60; seed++) {
    drawing d = random_drawing(seed, (uint32_t)(seed % 20), seed % 2 ? VARIED : FLAT);
    written w = written_new(d, true);
    const planefile_band *band = planefile_plane_band(w.plane, 0);
    planefile_info info = planefile_plane_info(w.plane);
    CHECK(info.is_coded && band->border_count == d.plane.border_count);
    for (uint32_t i = 0; i < band->cell_count; i++) {
      planefile_cell near = planefile_round(rounding, band->cells[i]);
      CHECK(memcmp(&near, &band->cells[i], sizeof near) == 0);
    }
    if (info.picture_count == 0) { /* their pixels are not read to be written */
      memory_file again = write_coded(band, true);
      CHECK(memory_is_same(&again, &w.file));
      free(again.bytes);
    }
    written_free(&w);
  }
  planefile_rounding_destroy(rounding);
}

/* A cell that is seen through glass takes hardly any bytes: it is guessed. */
static void test_guesses(void) {
  size_t sizes[2];
  for (int is_random = 0; is_random < 2; is_random++) {
    random_state random = {5};
    drawing d = drawing_new(40);
    add_cell(&d, &random, true);
    for (int i = 0; i < 20; i++)
      add_glass(&d, &random, true);
    for (uint32_t i = 0; is_random && i < d.plane.cell_count; i++)
      d.cells[i] = random_colour(&random, true);
    memory_file file = write_plane(&d.plane);
    sizes[is_random] = file.size;
    free(file.bytes);
    drawing_free(&d);
  }
  CHECK(sizes[0] + 400 < sizes[1]);
}

/* Lenses: pairs of chains of two cubic pieces each, which meet at the top and at the foot, and are
 * smooth in the middle. apart: no two ends are the same, and bent: no joint is smooth. */
static size_t lenses_size(int32_t apart, int32_t bent) {
  enum { LENSES = 40, STEP = 100003 };
  random_state random = {7};
  drawing d = drawing_new(2 * LENSES);
  add_cell(&d, &random, true);
  for (int i = 0; i < LENSES; i++) {
    int32_t left = random_between(&random, 1 << 22, 1 << 25), wide = 3 * STEP + i;
    uint32_t inside = add_cell(&d, &random, true);
    for (int side = -1; side <= 1; side += 2) {
      int32_t x = left + side * apart, y = 1 << 24, out = side * wide;
      const planefile_point points[7] = {
          {x, y + i, 0},
          {x + out, y + STEP, 0},
          {x + 2 * out, y + 2 * STEP, 0},
          {x + 3 * out, y + 3 * STEP, 0},
          {x + 4 * out + bent * out / 2, y + 4 * STEP - bent * wide, 0},
          {x + 2 * out, y + 5 * STEP, 0},
          {x, y + 9 * STEP + i, 0}};
      d.chains[d.plane.chain_count] = (planefile_chain){d.plane.piece_count, 2};
      for (uint32_t k = 0; k < 2; k++)
        d.pieces[d.plane.piece_count++] = (planefile_piece){d.plane.point_count + 3 * k, 3, false};
      memcpy(d.points + d.plane.point_count, points, sizeof points);
      d.plane.point_count += 7;
      add_border(&d, d.plane.chain_count++, y + i, y + 9 * STEP + i, side < 0 ? 0 : inside,
                 side < 0 ? inside : 0);
    }
  }
  written w = written_new(d, false);
  size_t size = w.file.size;
  written_free(&w);
  return size;
}

/* Points that two chains share are in the code once, and smooth joints need less. */
static void test_joints(void) {
  size_t shared = lenses_size(0, 0);
  CHECK(shared + 150 < lenses_size(12345, 0));
  CHECK(shared + 150 < lenses_size(0, 1));
}

/* Borders that change so much together that sums would not be exact. */
static void test_too_bright(void) {
  enum { CHAINS = 2100 };
  drawing d = drawing_new(CHAINS);
  random_state random = {1};
  const int32_t heights[2] = {0, PLANEFILE_SIDE};
  add_cell(&d, &random, true);
  uint32_t bright = add_cell(&d, &random, true);
  d.cells[0].colour[1] = -PLANEFILE_BRIGHT;
  d.cells[bright].colour[1] = PLANEFILE_BRIGHT;
  for (uint32_t i = 0; i < CHAINS; i++) {
    uint32_t chain = add_chain(&d, &random, heights, 2);
    add_border(&d, chain, 0, PLANEFILE_SIDE, i % 2 ? bright : 0, i % 2 ? 0 : bright);
  }
  memory_file file = {0};
  planefile_writer_desc desc = writer_desc(&file, 0);
  CHECK(planefile_write(&desc, &d.plane) == PLANEFILE_BAD_ARGUMENT);
  d.plane.border_count = 2000;
  CHECK(planefile_write(&desc, &d.plane) == PLANEFILE_OK);
  free(file.bytes);
  drawing_free(&d);
}

/* ---------------------------------------------------------------- what is drawn */

/* By repeated means of neighbouring points. */
static double coordinate(const planefile_piece *piece, const planefile_point *points, double t,
                         bool is_y) {
  double at[4], w[4];
  for (int i = 0; i <= piece->degree; i++) {
    w[i] = piece->is_rational ? points[i].w : 1;
    at[i] = w[i] * (is_y ? points[i].y : points[i].x);
  }
  for (int last = piece->degree; last > 0; last--)
    for (int i = 0; i < last; i++) {
      at[i] += t * (at[i + 1] - at[i]);
      w[i] += t * (w[i + 1] - w[i]);
    }
  return at[0] / w[0];
}

/* x of a chain at a height, by halving. */
static double exact_x(const planefile_band *plane, uint32_t index, double y) {
  const planefile_chain *chain = &plane->chains[index];
  const planefile_piece *piece = &plane->pieces[chain->piece];
  while (plane->points[piece->point + piece->degree].y <= y &&
         piece < &plane->pieces[chain->piece + chain->piece_count - 1])
    piece++;
  const planefile_point *points = &plane->points[piece->point];
  double low = 0, high = 1;
  for (int i = 0; i < 50; i++) {
    double middle = 0.5 * (low + high);
    if (coordinate(piece, points, middle, true) > y)
      high = middle;
    else
      low = middle;
  }
  return coordinate(piece, points, low, false);
}

/* The mean of many heights of each row, exact in x; of one height: the colour at the centres. */
static double *draw_exactly(const planefile_band *plane, uint32_t size, int heights) {
  double *out = calloc((size_t)size * size * 4, sizeof *out);
  for (uint32_t k = 0; k < plane->border_count; k++) {
    const planefile_border *b = &plane->borders[k];
    for (uint32_t line = 0; line < size * (uint32_t)heights; line++) {
      double y = (line + 0.5) / heights / size * PLANEFILE_SIDE;
      if (y < b->top || y >= b->foot)
        continue;
      double x = exact_x(plane, b->chain, y) * size / PLANEFILE_SIDE;
      double *row = out + (size_t)(line / (uint32_t)heights) * size * 4;
      for (uint32_t column = 0; column < size; column++) {
        double share = heights == 1 ? column + 0.5 >= x : fmin(fmax(column + 1 - x, 0), 1);
        for (int c = 0; c < 4; c++)
          row[4 * column + (uint32_t)c] +=
              share / heights *
              (plane->cells[b->right].colour[c] - plane->cells[b->left].colour[c]);
      }
    }
  }
  return out;
}

/* The most that a channel is off, in codes of 255. */
static double find_worst(const planefile_band *plane, const planefile_cell *drawn,
                         const double *exact, size_t pixels) {
  double worst = 0;
  for (size_t i = 0; i < pixels; i++)
    for (int c = 0; c < 4; c++) {
      double wanted = exact[4 * i + (size_t)c] + plane->cells[0].colour[c];
      worst = fmax(worst, fabs(drawn[i].colour[c] - wanted) * 255 / PLANEFILE_WHITE);
    }
  return worst;
}

static void check_drawn(uint64_t seed, uint32_t size, planefile_sampling sampling) {
  written w = random_written(seed, 8, FLAT);
  planefile_view view = {size, size, 0, 0, size, size, sampling};
  planefile_cell *drawn = draw_view(w.plane, view);
  double *exact = draw_exactly(&w.d.plane, size, sampling == PLANEFILE_NONE ? 1 : 1024);
  CHECK(find_worst(&w.d.plane, drawn, exact, (size_t)size * size) <= 0.5);
  free(exact);
  free(drawn);
  written_free(&w);
}

static void test_drawn(void) {
  for (uint64_t seed = 0; seed < 8; seed++) {
    check_drawn(seed, 24 + (uint32_t)(5 * seed), PLANEFILE_AREA);
    check_drawn(seed, 59, PLANEFILE_NONE); /* no curve passes a centre too closely */
  }
}

static void check_crops(const planefile_plane *plane, random_state *random,
                        planefile_sampling sampling) {
  uint32_t size = 1 + random_below(random, 90);
  planefile_cell *all = draw_view(plane, (planefile_view){size, size, 0, 0, size, size, sampling});
  for (int i = 0; i < 6; i++) {
    uint32_t x = random_below(random, size), y = random_below(random, size);
    uint32_t columns = 1 + random_below(random, size - x);
    uint32_t rows = 1 + random_below(random, size - y);
    planefile_view crop = {size, size, x, y, columns, rows, sampling};
    planefile_cell *part = draw_view(plane, crop);
    for (uint32_t row = 0; row < rows; row++)
      CHECK(memcmp(part + row * columns, all + (y + row) * size + x, columns * sizeof *part) == 0);
    free(part);
  }
  free(all);
}

/* Crops of crops, at sizes of which nobody draws the whole. */
static void check_deep(const planefile_plane *plane, random_state *random) {
  uint32_t size = UINT32_C(1) << random_between(random, 12, 30);
  uint32_t x = random_below(random, size - 64), y = random_below(random, size - 64);
  planefile_view large = {size, size, x, y, 64, 64, PLANEFILE_AREA};
  planefile_view small = {size, size, x + 17, y + 29, 31, 23, PLANEFILE_AREA};
  planefile_cell *all = draw_view(plane, large), *part = draw_view(plane, small);
  for (uint32_t row = 0; row < 23; row++)
    CHECK(memcmp(part + row * 31, all + (row + 29) * 64 + 17, 31 * sizeof *part) == 0);
  free(all);
  free(part);
}

static void test_crops(void) {
  random_state random = {8};
  for (uint64_t seed = 0; seed < 40; seed++) {
    written w = random_written(seed, 30, seed % 2 ? VARIED : FLAT);
    check_crops(w.plane, &random, PLANEFILE_AREA);
    check_crops(w.plane, &random, PLANEFILE_NONE);
    for (int i = 0; i < 10; i++)
      check_deep(w.plane, &random);
    written_free(&w);
  }
}

/* Where nothing is broken a pixel is its cell, to the bit, however many borders lie before it. */
static void test_cells_are_exact(void) {
  drawing d = drawing_new(2);
  random_state random = {1};
  int32_t heights[2] = {0, PLANEFILE_SIDE};
  for (int i = 0; i < 3; i++)
    add_cell(&d, &random, false);
  uint32_t left = add_chain(&d, &random, heights, 2), right = add_chain(&d, &random, heights, 2);
  add_border(&d, left, 0, PLANEFILE_SIDE, 0, 1);
  add_border(&d, right, 0, PLANEFILE_SIDE, 1, 2);
  written w = written_new(d, false);
  planefile_view view = {3000, 64, 2999, 0, 1, 64, PLANEFILE_AREA};
  planefile_cell *drawn = draw_view(w.plane, view);
  for (int y = 0; y < 64; y++)
    CHECK(memcmp(&drawn[y], &d.cells[2], sizeof *drawn) == 0 || d.points[0].x > 60 << 20);
  free(drawn);
  written_free(&w);
}

static void test_codes(void) {
  written w = random_written(0, 1, FLAT);
  for (int code = 0; code < 256; code++) {
    double s = code / 255.0, linear = s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
    int32_t grey = (int32_t)(linear * PLANEFILE_WHITE + 0.5);
    unsigned char out[4];
    planefile_srgb8(w.plane, (planefile_cell){{grey, grey, grey, PLANEFILE_WHITE}}, out);
    CHECK(out[0] == code && out[1] == code && out[2] == code && out[3] == 255);
    planefile_srgb8(w.plane, (planefile_cell){{grey / 2, -grey, grey, PLANEFILE_WHITE / 2}}, out);
    CHECK(abs(out[0] - code) <= (code < 16 ? 1 : 0) && out[1] == 0 && out[3] == 127);
  }
  unsigned char out[4] = {1, 1, 1, 1};
  planefile_srgb8(w.plane, (planefile_cell){{9, 9, 9, 0}}, out);
  CHECK(out[0] == 0 && out[3] == 0);
  planefile_srgb8(w.plane, (planefile_cell){{1 << 24, 0, 0, 1 << 24}}, out);
  CHECK(out[0] == 255 && out[3] == 255);
  written_free(&w);
}

/* ---------------------------------------------------------------- bands */

static void check_part(memory_file *file, const planefile_cell *all, uint32_t size, uint32_t y,
                       uint32_t rows) {
  planefile_plane *plane = NULL;
  planefile_source source = memory_source(file);
  int32_t unit = PLANEFILE_SIDE / (int32_t)size;
  int32_t top = (int32_t)y * unit, foot = (int32_t)(y + rows) * unit;
  planefile_drawer *drawer;
  CHECK(planefile_read(&source, top, foot, &plane, NULL) == PLANEFILE_OK);
  planefile_view view = {size, size, 0, y, size, rows, PLANEFILE_AREA};
  planefile_cell *part = draw_view(plane, view);
  CHECK(memcmp(part, all + y * size, (size_t)rows * size * sizeof *part) == 0);
  planefile_view whole = {size, size, 0, 0, size, size, PLANEFILE_AREA};
  CHECK(planefile_drawer_create(plane, &whole, &drawer) == PLANEFILE_BAD_ARGUMENT);
  free(part);
  planefile_plane_destroy(plane);
}

/* Nearly all pixels have the colour at their centre. */
static void check_centres(const written *w, planefile_view view) {
  size_t same = 0, pixels = (size_t)view.columns * view.rows;
  view.sampling = PLANEFILE_NONE;
  planefile_cell *centres = draw_view(w->plane, view);
  double *exact = draw_exactly(&w->d.plane, view.rows, 1);
  for (size_t i = 0; i < pixels; i++)
    same += fabs(centres[i].colour[0] - exact[4 * i] - w->d.cells[0].colour[0]) < 0.5;
  CHECK(same > pixels * 98 / 100);
  free(exact);
  free(centres);
}

/* A plane of many bands is that of one; a part of its heights needs only some of its bytes. */
static void check_bands(uint64_t seed, variety kind) {
  enum { SIZE = 128 };
  written w = random_written(seed, 6000, kind);
  planefile_info info = planefile_plane_info(w.plane);
  CHECK(info.band_count > 3 && info.varies == (kind == VARIED));
  planefile_view view = {SIZE, SIZE, 0, 0, SIZE, SIZE, PLANEFILE_AREA};
  planefile_cell *all = draw_view(w.plane, view);
  if (kind == FLAT)
    check_centres(&w, view);
  for (uint32_t y = 0; y + 8 <= SIZE; y += 24)
    check_part(&w.file, all, SIZE, y, 8);
  free(all);
  written_free(&w);
}

/* ---------------------------------------------------------------- tiles */

/* Whether each row of a tile is one span. */
static bool is_plain(const planefile_plane *plane, const planefile_view *tile) {
  planefile_drawer *drawer = NULL;
  bool is_one = true;
  CHECK(planefile_drawer_create(plane, tile, &drawer) == PLANEFILE_OK);
  for (uint32_t y = 0; y < tile->rows; y++) {
    const planefile_span *spans;
    size_t count = 0;
    CHECK(planefile_drawer_row(drawer, &spans, &count) == PLANEFILE_OK);
    is_one &= count == 1;
  }
  planefile_drawer_destroy(drawer);
  return is_one;
}

/* A tile of a huge frame in which no border lies has, as a rule, no memory for pixels (256 KiB),
 * nor for chains beside it. */
static void test_plain_tiles(void) {
  enum { SIZE = 1 << 20, SIDE = 256 };
  written w = random_written(7, 40, FLAT);
  planefile_source source = memory_source(&w.file);
  planefile_plane *plane;
  random_state random = {11};
  meter m = {0};
  int plain = 0, small = 0, large = 0;
  source.resize = metered;
  source.resize_user = &m;
  CHECK(planefile_read(&source, 0, PLANEFILE_SIDE, &plane, NULL) == PLANEFILE_OK);
  for (int i = 0; i < 100; i++) {
    uint32_t x = random_below(&random, SIZE - SIDE), y = random_below(&random, SIZE - SIDE);
    m.given = 0;
    if (is_plain(plane, &(planefile_view){SIZE, SIZE, x, y, SIDE, SIDE, PLANEFILE_AREA})) {
      plain++;
      small += m.given < 9000;
      large += m.given > 128 * 1024;
    }
  }
  CHECK(plain > 90 && small > plain / 2 && large < plain / 2);
  planefile_plane_destroy(plane);
  written_free(&w);
}

/* ---------------------------------------------------------------- pixels */

/* Spans of all lengths, at all places of a word, become their colours; the bytes around them stay.
 */
static void test_span_pixels(void) {
  enum { COUNT = 700, PIXELS = COUNT * (COUNT + 1) / 2 };
  written w = random_written(3, 20, FLAT);
  planefile_span *spans = calloc(COUNT, sizeof *spans);
  unsigned char *room = malloc(4 * PIXELS + 4);
  for (uint32_t i = 0, end = 0; i < COUNT; i++) {
    int32_t alpha = i % 5 == 4 ? 0 : PLANEFILE_WHITE - (int32_t)(i % 5) * 9000;
    end += i + 1;
    spans[i] = (planefile_span){end, {{(int32_t)(i * 90), 20000, alpha / 2, alpha}}};
  }
  for (int shift = 0; shift < 4; shift++) {
    size_t wrong = 0;
    memset(room, 77, 4 * PIXELS + 4);
    planefile_span_pixels(w.plane, spans, COUNT, room + shift);
    for (uint32_t i = 0, x = 0; i < COUNT; i++) {
      unsigned char pixel[4];
      planefile_srgb8(w.plane, spans[i].colour, pixel);
      for (; x < spans[i].end; x++)
        wrong += memcmp(room + shift + 4 * (size_t)x, pixel, 4) != 0;
    }
    for (int i = 0; i < 4; i++)
      wrong += room[i < shift ? i : 4 * PIXELS + i] != 77;
    CHECK(wrong == 0);
  }
  free(room);
  free(spans);
  written_free(&w);
}

/* ---------------------------------------------------------------- damage */

static bool is_refused(memory_file *file, const char *reason) {
  planefile_plane *plane = NULL;
  planefile_fault fault = {0};
  planefile_source source = memory_source(file);
  planefile_status status = planefile_read(&source, 0, PLANEFILE_SIDE, &plane, &fault);
  planefile_plane_destroy(plane);
  return status == PLANEFILE_BAD_FILE && fault.offset <= file->size &&
         (reason ? strcmp(fault.reason, reason) == 0 : fault.reason[0] != '\0');
}

static void check_every_byte(variety kind) {
  written w = random_written(4, 6, kind);
  size_t size = w.file.size;
  for (size_t i = 0; i < size; i++) {
    w.file.bytes[i] ^= (unsigned char)(1 + i % 255);
    CHECK(is_refused(&w.file, NULL));
    w.file.bytes[i] ^= (unsigned char)(1 + i % 255);
    w.file.size = i;
    CHECK(is_refused(&w.file, NULL));
    w.file.size = size;
  }
  written_free(&w);
}

/* Changes of the numbers before the code of the first band, and why they are refused. */
static void test_reasons(void) {
  static const struct {
    size_t at;
    uint32_t number;
    const char *reason;
  } changes[] = {
      {0, 1 << 26, "band 0: its heights are not in the frame"},
      {4, (1 << 26) - 1, "band 0: it has other heights"},
      {8, UINT32_MAX, "band 0: it claims more than its bytes can hold"},
      {16, 0, "band 0: it has no cell"},
      {12, 1, "band 0: it has more than it claims"},
      {20, 1, "band 0: a group is too large"},
  };
  drawing d = random_drawing(4, 6, FLAT);
  for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
    memory_file file = write_plane(&d.plane);
    pf_store_32(file.bytes + PF_HEADER_BYTES + PF_HEAD_BYTES + changes[i].at, changes[i].number);
    mend_sums(&file);
    if (!CHECK(is_refused(&file, changes[i].reason)))
      fprintf(stderr, "  %s\n", changes[i].reason);
    free(file.bytes);
  }
  drawing_free(&d);
}

static void test_ends(void) {
  written w = random_written(4, 6, FLAT);
  CHECK(planefile_is(w.file.bytes, PLANEFILE_MAGIC_BYTES) && !planefile_is(w.file.bytes, 7));
  pf_store_32(w.file.bytes + 8, 1);
  pf_store_32(w.file.bytes + 36, pf_crc32c(0, w.file.bytes, 36));
  CHECK(is_refused(&w.file, "the plane file has another version: 1"));
  mend_sums(&w.file);
  CHECK(!is_refused(&w.file, NULL));
  pf_store_double(w.file.bytes + 16, -1);
  mend_sums(&w.file);
  CHECK(is_refused(&w.file, "the header has a value that is not allowed"));
  written_free(&w);
}

/* Any byte of the code may be any other: then the plane is another one, or it is refused. */
static void test_altered_code(void) {
  for (uint64_t seed = 0; seed < 6; seed++) {
    written w = random_written(seed, 5, seed % 2 ? VARIED : FLAT);
    for (size_t i = PF_HEADER_BYTES; i + PF_TRAILER_BYTES < w.file.size; i++) {
      unsigned char kept = w.file.bytes[i];
      planefile_plane *plane = NULL;
      planefile_source source = memory_source(&w.file);
      w.file.bytes[i] ^= 0x55;
      mend_sums(&w.file);
      if (planefile_read(&source, 0, PLANEFILE_SIDE, &plane, NULL) == PLANEFILE_OK)
        free(draw_view(plane, (planefile_view){20, 20, 0, 0, 20, 20, PLANEFILE_AREA}));
      planefile_plane_destroy(plane);
      w.file.bytes[i] = kept;
    }
    written_free(&w);
  }
}

/* ---------------------------------------------------------------- misuse */

static planefile_status write_status(const planefile_band *plane, double width) {
  memory_file file = {0};
  planefile_writer_desc desc = writer_desc(&file, 0);
  desc.width = width;
  planefile_status status = planefile_write(&desc, plane);
  free(file.bytes);
  return status;
}

#define CHECK_REFUSED(change)                                                                      \
  do {                                                                                             \
    drawing d = random_drawing(2, 4, FLAT);                                                        \
    change;                                                                                        \
    CHECK(write_status(&d.plane, 4) == PLANEFILE_BAD_ARGUMENT);                                    \
    drawing_free(&d);                                                                              \
  } while (0)

static void test_bad_planes(void) {
  drawing good = random_drawing(2, 4, FLAT);
  CHECK(write_status(&good.plane, 4) == PLANEFILE_OK);
  CHECK(write_status(&good.plane, 0) == PLANEFILE_BAD_ARGUMENT);
  CHECK(write_status(&good.plane, INFINITY) == PLANEFILE_BAD_ARGUMENT);
  drawing_free(&good);
  CHECK_REFUSED(d.plane.foot--);
  CHECK_REFUSED(d.plane.cell_count = 0);
  CHECK_REFUSED(d.borders[0].left = d.borders[0].right);
  CHECK_REFUSED(d.borders[0].chain = d.plane.chain_count);
  CHECK_REFUSED(d.borders[0].left = d.plane.cell_count);
  CHECK_REFUSED(d.borders[0].top = -1);
  CHECK_REFUSED(d.borders[0].foot = d.borders[0].top);
  CHECK_REFUSED(d.borders[1] = d.borders[0]);
  CHECK_REFUSED(d.chains[0].piece_count = d.plane.piece_count + 1);
  CHECK_REFUSED(d.chains[0].piece_count = 0);
  CHECK_REFUSED(d.pieces[0].degree = 4);
  CHECK_REFUSED(d.pieces[1].degree = 0);
  CHECK_REFUSED(d.points[0].x = PLANEFILE_FAR + 1);
  CHECK_REFUSED(d.points[0].y = 1 << 27);
  CHECK_REFUSED(d.points[d.pieces[1].point].x++);
  CHECK_REFUSED(d.cells[0].colour[1] = PLANEFILE_BRIGHT + 1);
}

/* A plane of one program with a linear ramp in a group. */
#define CHECK_PROGRAM_REFUSED(change)                                                              \
  do {                                                                                             \
    drawing d = random_drawing(2, 4, FLAT);                                                        \
    planefile_program *program = &d.programs[1];                                                   \
    planefile_step *steps = d.steps;                                                               \
    *program = (planefile_program){0, 3};                                                          \
    steps[0].kind = PLANEFILE_ENTER;                                                               \
    steps[1] = (planefile_step){.kind = PLANEFILE_RAMP, .stop_count = 2};                          \
    steps[2].kind = PLANEFILE_LEAVE;                                                               \
    d.plane.step_count = 3;                                                                        \
    d.plane.axis_count = 1;                                                                        \
    d.plane.stop_count = 2;                                                                        \
    d.cells[1] = (planefile_cell){{0}};                                                            \
    CHECK(write_status(&d.plane, 4) == PLANEFILE_OK);                                              \
    change;                                                                                        \
    CHECK(write_status(&d.plane, 4) == PLANEFILE_BAD_ARGUMENT);                                    \
    drawing_free(&d);                                                                              \
  } while (0)

static void test_bad_programs(void) {
  CHECK_PROGRAM_REFUSED(d.cells[1].colour[0] = 1);
  CHECK_PROGRAM_REFUSED(d.programs[0] = *program);
  CHECK_PROGRAM_REFUSED(program->step_count = 4);
  CHECK_PROGRAM_REFUSED(program->step = 1);
  CHECK_PROGRAM_REFUSED(steps[2].kind = PLANEFILE_ENTER);
  CHECK_PROGRAM_REFUSED(steps[0].kind = PLANEFILE_LEAVE);
  CHECK_PROGRAM_REFUSED(steps[1].kind = 4);
  CHECK_PROGRAM_REFUSED(steps[1].axis = 1);
  CHECK_PROGRAM_REFUSED(steps[1].stop_count = 3);
  CHECK_PROGRAM_REFUSED(steps[1].stop_count = 0);
  CHECK_PROGRAM_REFUSED(steps[2].colour.colour[3] = -1);
  CHECK_PROGRAM_REFUSED(d.stops[1].at = -1);
  CHECK_PROGRAM_REFUSED(d.stops[1].at = NAN);
  CHECK_PROGRAM_REFUSED(d.stops[1].colour.colour[2] = PLANEFILE_BRIGHT + 1);
  CHECK_PROGRAM_REFUSED(d.axes[0].kind = 3);
  CHECK_PROGRAM_REFUSED(d.axes[0].kind = PLANEFILE_TRIANGLE);
  CHECK_PROGRAM_REFUSED(d.axes[0].w[1] = INFINITY);
}

/* Groups are as deep as they may be, and one deeper. */
static void test_depth(void) {
  for (uint32_t depth = PLANEFILE_DEPTH; depth <= PLANEFILE_DEPTH + 1; depth++) {
    drawing d = random_drawing(2, 4, FLAT);
    d.programs[1] = (planefile_program){0, 2 * depth};
    d.plane.step_count = 2 * depth;
    d.cells[1] = (planefile_cell){{0}};
    for (uint32_t i = 0; i < depth; i++) {
      d.steps[i].kind = PLANEFILE_ENTER;
      d.steps[depth + i].kind = PLANEFILE_LEAVE;
    }
    CHECK((write_status(&d.plane, 4) == PLANEFILE_OK) == (depth == PLANEFILE_DEPTH));
    drawing_free(&d);
  }
}

static void test_bad_views(void) {
  written w = random_written(2, 4, FLAT);
  const planefile_view views[] = {{0, 1, 0, 0, 1, 1, 0}, {9, 9, 9, 0, 1, 1, 0},
                                  {9, 9, 0, 0, 0, 1, 0}, {9, 9, 4, 0, 6, 1, 0},
                                  {9, 9, 0, 4, 1, 6, 0}, {UINT32_MAX, 9, 0, 0, 1, 1, 0}};
  planefile_drawer *drawer;
  for (size_t i = 0; i < sizeof views / sizeof *views; i++)
    CHECK(planefile_drawer_create(w.plane, &views[i], &drawer) == PLANEFILE_BAD_ARGUMENT &&
          !drawer);
  planefile_view view = {9, 9, 0, 0, 9, 1, PLANEFILE_AREA};
  const planefile_span *spans;
  size_t count;
  CHECK(planefile_drawer_create(w.plane, &view, &drawer) == PLANEFILE_OK);
  CHECK(planefile_drawer_row(drawer, &spans, &count) == PLANEFILE_OK);
  CHECK(planefile_drawer_row(drawer, &spans, &count) == PLANEFILE_BAD_ARGUMENT);
  planefile_drawer_destroy(drawer);
  planefile_plane *plane;
  planefile_source source = memory_source(&w.file);
  CHECK(planefile_read(&source, 5, 5, &plane, NULL) == PLANEFILE_BAD_ARGUMENT);
  written_free(&w);
}

/* ---------------------------------------------------------------- films */

enum { FRAMES = 24 };

/* Frames of random drawings, some of them again and again. Returns how many differ. */
static uint32_t write_film(memory_file *file, drawing drawings[FRAMES]) {
  planefile_writer_desc desc = writer_desc(file, 12.5);
  planefile_writer *writer;
  uint32_t count = 0;
  CHECK(planefile_writer_create(&desc, &writer) == PLANEFILE_OK);
  for (uint32_t i = 0; i < FRAMES; i++) {
    count = i % 4 ? count : i / 4 + 1; /* on fours */
    drawings[i] = random_drawing(count, count % 3 ? 9 : 0, count % 2 ? FLAT : VARIED);
    if (i % 4 == 2)
      CHECK(planefile_writer_repeat(writer) == PLANEFILE_OK);
    else
      CHECK(planefile_writer_frame(writer, &drawings[i].plane) == PLANEFILE_OK);
  }
  CHECK(planefile_writer_end(writer) == PLANEFILE_OK);
  planefile_writer_destroy(writer);
  return count;
}

static void free_drawings(drawing drawings[FRAMES]) {
  for (uint32_t i = 0; i < FRAMES; i++)
    drawing_free(&drawings[i]);
}

static planefile_plane *read_frame(memory_file *file, uint32_t frame) {
  planefile_plane *plane = NULL;
  planefile_fault fault = {0};
  planefile_source source = memory_source(file);
  if (!CHECK(planefile_read_frame(&source, frame, 0, PLANEFILE_SIDE, &plane, &fault) ==
             PLANEFILE_OK))
    fprintf(stderr, "  at %llu: %s\n", (unsigned long long)fault.offset, fault.reason);
  return plane;
}

/* A frame of a film is the plane that it would be alone. */
static void check_frame(memory_file *film, uint32_t frame, const drawing *d) {
  planefile_view view = {31, 23, 0, 0, 31, 23, PLANEFILE_AREA};
  memory_file file = write_plane(&d->plane);
  planefile_plane *alone = read_plane(&file), *plane = read_frame(film, frame);
  planefile_info info = planefile_plane_info(plane), other = planefile_plane_info(alone);
  CHECK(info.frame_count == FRAMES && info.frames_second == 12.5);
  CHECK(other.frame_count == 1 && other.frames_second == 0);
  CHECK(info.is_opaque == other.is_opaque && info.varies == other.varies && info.width == 4);
  CHECK(draws_same(plane, alone, view));
  free(file.bytes);
  planefile_plane_destroy(alone);
  planefile_plane_destroy(plane);
}

static void test_films(void) {
  memory_file film = {0};
  drawing drawings[FRAMES];
  size_t alone = 0;
  uint32_t different = write_film(&film, drawings);
  for (uint32_t i = FRAMES; i-- > 0;) /* at random, as it were */
    check_frame(&film, i, &drawings[i]);
  for (uint32_t i = 0; i < FRAMES; i += 4) {
    memory_file file = write_plane(&drawings[i].plane);
    alone += file.size;
    free(file.bytes);
  }
  CHECK(different == FRAMES / 4 && film.size < alone + 1024); /* each is there once */
  free_drawings(drawings);
  free(film.bytes);
}

/* Frames one after the other, some again, are what they are alone. */
static void check_next(memory_file *film, uint64_t seed) {
  random_state random = {seed};
  planefile_source source = memory_source(film);
  planefile_view view = {31, 23, 0, 0, 31, 23, PLANEFILE_AREA};
  planefile_plane *plane = NULL;
  for (uint32_t i = 0, frame = 0; i < 2 * FRAMES; i++) {
    frame = (frame + random_below(&random, 3)) % FRAMES;
    planefile_plane *alone = read_frame(film, frame);
    CHECK(planefile_read_next(&source, frame, &plane, NULL) == PLANEFILE_OK);
    CHECK(draws_same(plane, alone, view));
    planefile_plane_destroy(alone);
  }
  CHECK(planefile_read_next(&source, FRAMES, &plane, NULL) == PLANEFILE_BAD_ARGUMENT);
  CHECK(plane == NULL);
}

/* What is not needed of the frame before is freed before the next one is read. */
static void check_memory_of_next(memory_file *film) {
  meter live = {0};
  planefile_source source = memory_source(film);
  planefile_plane *plane = NULL;
  source.resize = metered;
  source.resize_user = &live;
  CHECK(planefile_read_next(&source, 1, &plane, NULL) == PLANEFILE_OK);
  const size_t before = live.least = live.bytes;
  CHECK(planefile_read_next(&source, 1, &plane, NULL) == PLANEFILE_OK);
  CHECK(live.bytes == before && live.least < before);
  planefile_plane_destroy(plane);
  CHECK(live.bytes == 0);
}

/* A film with any byte altered is refused, or its frames can be drawn. */
static void check_altered_film(memory_file *film, uint64_t seed) {
  random_state random = {seed};
  memory_file other = {malloc(film->size), film->size, film->size};
  memcpy(other.bytes, film->bytes, film->size);
  uint32_t place = random_below(&random, (uint32_t)film->size);
  other.bytes[place] ^= (unsigned char)(1 << random_below(&random, 8));
  mend_sums(&other);
  planefile_source source = memory_source(&other);
  planefile_plane *plane = NULL;
  uint32_t frame = random_below(&random, FRAMES + 1); /* the last one is not there */
  planefile_view view = {9, 7, 0, 0, 9, 7, PLANEFILE_AREA};
  planefile_fault fault = {0};
  planefile_read_next(&source, random_below(&random, FRAMES), &plane, NULL);
  if (planefile_read_next(&source, frame, &plane, &fault) == PLANEFILE_OK)
    free(draw_view(plane, view));
  else
    CHECK(fault.offset <= film->size && fault.reason[0] != '\0');
  planefile_plane_destroy(plane);
  free(other.bytes);
}

/* A film whose frames are made from each other. */
static memory_file write_changing(uint64_t seed, drawing drawings[FRAMES]) {
  memory_file file = {0};
  planefile_writer_desc desc = writer_desc(&file, 12.5);
  desc.grid = (planefile_grid){seed % 4 == 1 ? 1920 : 0, seed % 4 == 1 ? 1081 : 0};
  planefile_writer *writer;
  random_state random = {seed};
  CHECK(planefile_writer_create(&desc, &writer) == PLANEFILE_OK);
  for (uint32_t i = 0; i < FRAMES; i++) {
    drawings[i] = random_drawing(seed, 40, seed % 2 ? FLAT : VARIED);
    random.state = seed + i / 4; /* the steps of four frames begin alike */
    for (uint32_t k = 0; k < i; k++)
      alter_drawing(&drawings[i], &random, seed % 3 == 0);
    coarsen_drawing(&drawings[i], desc.grid);
    CHECK(planefile_writer_frame(writer, &drawings[i].plane) == PLANEFILE_OK);
  }
  CHECK(planefile_writer_end(writer) == PLANEFILE_OK);
  planefile_writer_destroy(writer);
  return file;
}

/* The records of a kind. */
static uint32_t count_records(const memory_file *file, unsigned char kind) {
  uint32_t count = 0;
  for (uint64_t at = PF_HEADER_BYTES; at < file->size - PF_TRAILER_BYTES;
       at += PF_HEAD_BYTES + (uint64_t)pf_load_32(file->bytes + at + 1) + PF_CHECK_BYTES)
    count += file->bytes[at] == kind;
  return count;
}

static void test_changing_films(void) {
  for (uint64_t seed = 0; seed < 12; seed++) {
    drawing drawings[FRAMES];
    memory_file film = write_changing(seed, drawings);
    size_t alone = 0;
    for (uint32_t i = 0; i < FRAMES; i++) {
      memory_file file = write_plane(&drawings[i].plane);
      check_frame(&film, i, &drawings[i]);
      alone += file.size;
      free(file.bytes);
    }
    check_next(&film, seed);
    check_memory_of_next(&film);
    CHECK(count_records(&film, PF_CHANGED) >= FRAMES / 2);
    CHECK(film.size < alone / 4 * 3);
    for (uint32_t i = 0; i < 100; i++)
      check_altered_film(&film, seed * 100 + i);
    free_drawings(drawings);
    free(film.bytes);
  }
}

static void check_film_fault(memory_file *film, uint32_t frame, planefile_status status,
                             const char *reason) {
  planefile_plane *plane;
  planefile_fault fault = {0};
  planefile_source source = memory_source(film);
  CHECK(planefile_read_frame(&source, frame, 0, PLANEFILE_SIDE, &plane, &fault) == status);
  if (!CHECK(strstr(fault.reason, reason) != NULL))
    fprintf(stderr, "  %s\n", fault.reason);
}

/* A step is the inverse of its place, whatever the grid; places beside it are refused. */
static void test_grids(void) {
  const planefile_grid grids[] = {{1, 0}, {0, 1}, {1920, 1080}, {65535, 65535}};
  random_state random = {1};
  for (size_t i = 0; i < 4 * 1000; i++) {
    uint16_t count = i % 2 ? grids[i % 4].columns : grids[i % 4].rows;
    int32_t at = random_between(&random, -PLANEFILE_FAR, PLANEFILE_FAR), near = on_grid(at, count);
    double step = (double)PLANEFILE_SIDE / (double)planefile_steps(count);
    CHECK(near - at <= step / 2 + 0.5 && at - near <= step / 2 + 0.5);
    CHECK(on_grid(near, count) == near && (count > 0 || near == at));
  }
  for (size_t i = 0; i < sizeof grids / sizeof *grids; i++) {
    memory_file file = {0};
    drawing d = random_drawing(4, 6, FLAT);
    planefile_writer_desc desc = writer_desc(&file, 0);
    desc.grid = grids[i];
    CHECK(planefile_write(&desc, &d.plane) == PLANEFILE_BAD_ARGUMENT);
    coarsen_drawing(&d, grids[i]);
    CHECK(planefile_write(&desc, &d.plane) == PLANEFILE_OK);
    drawing_free(&d);
    free(file.bytes);
  }
}

static void test_bad_films(void) {
  memory_file film = {0}, one;
  drawing drawings[FRAMES];
  write_film(&film, drawings);
  check_film_fault(&film, FRAMES, PLANEFILE_BAD_ARGUMENT, "it has no frame 24");
  uint64_t last = pf_load_64(film.bytes + film.size - PF_TRAILER_BYTES + 8);
  unsigned char *frames = film.bytes + last + PF_HEAD_BYTES + PF_RATE_BYTES, kept[8];
  memcpy(kept, frames, 8);
  pf_store_64(frames, PF_HEADER_BYTES); /* a band */
  mend_sums(&film);
  check_film_fault(&film, 0, PLANEFILE_BAD_FILE, "the index: there is another record");
  pf_store_64(frames, film.size);
  mend_sums(&film);
  check_film_fault(&film, 0, PLANEFILE_BAD_FILE, "the index: its record is outside the file");
  memcpy(frames, kept, 8);
  pf_store_double(frames - 8, -1);
  mend_sums(&film);
  check_film_fault(&film, 0, PLANEFILE_BAD_FILE, "there is no such rate");
  pf_store_double(frames - 8, 12.5);
  for (uint32_t i = 0; i < 400; i++)
    check_altered_film(&film, i);
  one = write_plane(&drawings[0].plane);
  check_film_fault(&one, 1, PLANEFILE_BAD_ARGUMENT, "it has no frame 1");
  for (uint32_t i = 0; i < 400; i++)
    check_altered_film(&one, i);
  planefile_writer_desc desc = writer_desc(&one, 0);
  planefile_writer *writer;
  CHECK(planefile_writer_create(&desc, &writer) == PLANEFILE_OK);
  CHECK(planefile_writer_end(writer) == PLANEFILE_BAD_ARGUMENT);
  CHECK(planefile_writer_repeat(writer) == PLANEFILE_BAD_ARGUMENT);
  CHECK(planefile_writer_frame(writer, &drawings[0].plane) == PLANEFILE_OK);
  CHECK(planefile_writer_frame(writer, &drawings[0].plane) == PLANEFILE_BAD_ARGUMENT);
  CHECK(planefile_writer_repeat(writer) == PLANEFILE_BAD_ARGUMENT);
  planefile_writer_destroy(writer);
  desc.frames_second = -1;
  CHECK(planefile_writer_create(&desc, &writer) == PLANEFILE_BAD_ARGUMENT);
  free_drawings(drawings);
  free(one.bytes);
  free(film.bytes);
}

/* ---------------------------------------------------------------- failures */

static planefile_status draw_all(const planefile_plane *plane) {
  planefile_drawer *drawer;
  planefile_view view = {40, 40, 0, 0, 40, 40, PLANEFILE_AREA};
  planefile_status status = planefile_drawer_create(plane, &view, &drawer);
  for (int y = 0; y < 40 && status == PLANEFILE_OK; y++) {
    const planefile_span *spans;
    size_t count;
    status = planefile_drawer_row(drawer, &spans, &count);
  }
  planefile_drawer_destroy(drawer);
  return status;
}

static planefile_status write_frames(const planefile_writer_desc *desc,
                                     const planefile_band planes[2], int count) {
  planefile_writer *writer;
  planefile_status status = planefile_writer_create(desc, &writer);
  for (int i = 0; i < count && status == PLANEFILE_OK; i++)
    status = planefile_writer_frame(writer, &planes[i % 2]);
  if (status == PLANEFILE_OK)
    status = planefile_writer_end(writer);
  planefile_writer_destroy(writer);
  return status;
}

static planefile_status write_and_draw(const planefile_band from[2], double frames_second,
                                       meter *m) {
  memory_file file = {0};
  planefile_writer_desc desc = writer_desc(&file, frames_second);
  desc.resize = metered;
  desc.resize_user = m;
  desc.is_coded = true;
  planefile_plane *plane = NULL;
  planefile_status status = write_frames(&desc, from, frames_second > 0 ? 3 : 1);
  planefile_source source = memory_source(&file);
  source.resize = metered;
  source.resize_user = m;
  if (status == PLANEFILE_OK)
    status = planefile_read_frame(&source, frames_second > 0, 0, PLANEFILE_SIDE, &plane, NULL);
  if (status == PLANEFILE_OK)
    status = draw_all(plane);
  planefile_plane_destroy(plane);
  plane = NULL;
  for (uint32_t i = 1; frames_second > 0 && i < 3 && status == PLANEFILE_OK; i++)
    status = planefile_read_next(&source, i, &plane, NULL);
  planefile_plane_destroy(plane);
  free(file.bytes);
  return status;
}

static void check_no_memory(double frames_second, variety kind) {
  random_state random = {1};
  drawing d = random_drawing(4, 30, kind), next = random_drawing(4, 30, kind);
  alter_drawing(&next, &random, false);
  const planefile_band planes[2] = {d.plane, next.plane};
  int count = 0;
  for (int k = 1;; k++, count++) {
    meter m = {.fail_at = k};
    planefile_status status = write_and_draw(planes, frames_second, &m);
    CHECK(m.bytes == 0);
    if (status == PLANEFILE_OK)
      break;
    CHECK(status == PLANEFILE_NO_MEMORY);
  }
  CHECK(count > 20);
  drawing_free(&next);
  drawing_free(&d);
}

static void test_no_output(void) {
  written w = random_written(4, 3, FLAT);
  for (size_t room = 0; room < w.file.size; room += 7) {
    size_t left = room;
    planefile_writer_desc desc = {.width = 4, .height = 3, .write = failing_write, .user = &left};
    CHECK(planefile_write(&desc, &w.d.plane) == PLANEFILE_WRITE_FAILED);
  }
  planefile_plane *plane;
  planefile_source source = memory_source(&w.file);
  source.size++; /* than there is */
  CHECK(planefile_read(&source, 0, PLANEFILE_SIDE, &plane, NULL) == PLANEFILE_READ_FAILED);
  written_free(&w);
}

/* ---------------------------------------------------------------- nests */

enum { NEST_PLANES = 3, NEST_WINDOWS = 2 };
enum { NEST_HEAD = PF_NEST_BYTES + PF_SIZE_BYTES * NEST_PLANES + PF_WINDOW_BYTES * NEST_WINDOWS };
enum { NEST_WINDOW = PF_NEST_BYTES + PF_SIZE_BYTES * NEST_PLANES };

static void mend_head(memory_file *nest) {
  pf_store_32(nest->bytes + NEST_HEAD, pf_crc32c(0, nest->bytes, NEST_HEAD));
}

/* Three planes, of which the second is shown twice. */
static memory_file write_nest(written planes[NEST_PLANES]) {
  static const double box[4] = {0, 0.25, 1, 0.25 + 1.0 / (1 << 20)};
  memory_file nest = {.bytes = calloc(1, NEST_HEAD + PF_CHECK_BYTES),
                      .size = NEST_HEAD + PF_CHECK_BYTES};
  memcpy(nest.bytes, pf_nest_magic, sizeof pf_nest_magic);
  pf_store_32(nest.bytes + 8, 1);
  pf_store_32(nest.bytes + 12, NEST_PLANES);
  pf_store_32(nest.bytes + 16, NEST_WINDOWS);
  for (size_t i = 0; i < NEST_WINDOWS; i++) {
    unsigned char *window = nest.bytes + NEST_WINDOW + PF_WINDOW_BYTES * i;
    for (size_t k = 0; k < 4; k++)
      pf_store_double(window + 8 * k, box[k]);
    pf_store_32(window + 32, 1);
  }
  for (uint64_t i = 0; i < NEST_PLANES; i++) {
    planes[i] = random_written(i, 4, FLAT);
    pf_store_64(nest.bytes + PF_NEST_BYTES + PF_SIZE_BYTES * i, planes[i].file.size);
    memory_write(&nest, planes[i].file.bytes, planes[i].file.size);
  }
  mend_head(&nest);
  return nest;
}

/* The outer plane is read, and each inner one where the nest says. */
static void test_nests(void) {
  written planes[NEST_PLANES];
  memory_file nest = write_nest(planes);
  planefile_plane *outer = read_plane(&nest);
  const planefile_view view = {16, 16, 0, 0, 16, 16, PLANEFILE_AREA};
  planefile_info info = planefile_plane_info(outer);
  CHECK(planefile_is(nest.bytes, PLANEFILE_MAGIC_BYTES));
  CHECK(info.inner_count == 2 && info.window_count == NEST_WINDOWS);
  for (uint32_t i = 0; i < NEST_PLANES; i++) {
    uint64_t offset, size;
    planefile_plane *alone = read_plane(&planes[i].file), *inner = outer;
    if (i > 0) {
      planefile_plane_inner(outer, i - 1, &offset, &size);
      memory_file part = {.bytes = nest.bytes + offset, .size = (size_t)size};
      inner = read_plane(&part);
    }
    CHECK(draws_same(inner, alone, view));
    if (i > 0)
      planefile_plane_destroy(inner);
    planefile_plane_destroy(alone);
    written_free(&planes[i]);
  }
  planefile_plane_destroy(outer);
  free(nest.bytes);
}

/* Every byte of the head, the outer plane and the length is examined. */
static void test_damaged_nests(void) {
  written planes[NEST_PLANES];
  memory_file nest = write_nest(planes);
  size_t size = nest.size, outer = NEST_HEAD + PF_CHECK_BYTES + planes[0].file.size;
  for (size_t i = 0; i < outer; i++) {
    nest.bytes[i] ^= (unsigned char)(1 + i % 255);
    CHECK(is_refused(&nest, NULL));
    nest.bytes[i] ^= (unsigned char)(1 + i % 255);
  }
  for (nest.size = 0; nest.size < size; nest.size++)
    CHECK(is_refused(&nest, NULL));
  for (size_t i = 0; i < NEST_PLANES; i++)
    written_free(&planes[i]);
  free(nest.bytes);
}

/* A number of the head is another one, and its checksum is right. */
static bool is_nest_refused(const memory_file *nest, size_t at, uint64_t number, size_t size,
                            const char *reason) {
  memory_file other = {.bytes = malloc(nest->size), .size = nest->size};
  memcpy(other.bytes, nest->bytes, nest->size);
  for (size_t i = 0; i < size; i++)
    other.bytes[at + i] = (unsigned char)(number >> 8 * i);
  mend_head(&other);
  bool is_good = is_refused(&other, reason);
  free(other.bytes);
  return is_good;
}

static void test_nest_reasons(void) {
  static const char many[] = "a nest has 1 to 1024 planes and at most 1024 windows";
  static const char window[] = "the nest has a window that is not allowed";
  static const char large[] = "the planes of the nest are larger than the file";
  static const struct {
    size_t at, size;
    uint64_t number;
    const char *reason;
  } changes[] = {{8, 4, 2, "the nest of planes has another version"},
                 {12, 4, 0, many},
                 {12, 4, PF_NEST_MOST + 1, many},
                 {16, 4, PF_NEST_MOST + 1, many},
                 {16, 4, PF_NEST_MOST, "the file is too short for the head of its nest"},
                 {PF_NEST_BYTES, 8, UINT64_MAX, large},
                 {PF_NEST_BYTES + 16, 8, 1, "there is something after the nest"},
                 {NEST_WINDOW + 32, 4, 0, window},
                 {NEST_WINDOW + 32, 4, NEST_PLANES, window}};
  static const double edges[][2] = {{0, -1e-9}, {1, -1e-9}, {2, 1 + 1e-9},   {3, 1 + 1e-9},
                                    {0, NAN},   {1, NAN},   {2, NAN},        {3, INFINITY},
                                    {0, 1},     {3, 0.25},  {3, 0.25 + 1e-7}};
  written planes[NEST_PLANES];
  memory_file nest = write_nest(planes);
  for (size_t i = 0; i < sizeof changes / sizeof *changes; i++)
    if (!CHECK(is_nest_refused(&nest, changes[i].at, changes[i].number, changes[i].size,
                               changes[i].reason)))
      fprintf(stderr, "  change %zu\n", i);
  for (size_t i = 0; i < sizeof edges / sizeof *edges; i++) {
    uint64_t bits;
    memcpy(&bits, &edges[i][1], sizeof bits);
    size_t at = NEST_WINDOW + PF_WINDOW_BYTES + 8 * (size_t)edges[i][0];
    if (!CHECK(is_nest_refused(&nest, at, bits, 8, window)))
      fprintf(stderr, "  edge %zu\n", i);
  }
  memcpy(nest.bytes + NEST_HEAD + PF_CHECK_BYTES, pf_nest_magic, sizeof pf_nest_magic);
  CHECK(is_refused(&nest, "this is not a plane file"));
  for (size_t i = 0; i < NEST_PLANES; i++)
    written_free(&planes[i]);
  free(nest.bytes);
}

int main(void) {
  test_nests();
  test_damaged_nests();
  test_nest_reasons();
  test_checksum();
  test_rounding();
  test_coded();
  test_guesses();
  test_joints();
  test_too_bright();
  test_numbers();
  test_round_trips();
  test_drawn();
  test_crops();
  test_cells_are_exact();
  test_codes();
  check_bands(5, FLAT);
  check_bands(6, VARIED);
  test_plain_tiles();
  test_span_pixels();
  check_every_byte(FLAT);
  check_every_byte(VARIED);
  test_reasons();
  test_ends();
  test_altered_code();
  test_bad_planes();
  test_bad_programs();
  test_depth();
  test_bad_views();
  check_no_memory(0, VARIED);
  check_no_memory(0, FLAT);
  check_no_memory(24, VARIED);
  test_films();
  test_changing_films();
  test_grids();
  test_bad_films();
  test_no_output();
  return check_done();
}
