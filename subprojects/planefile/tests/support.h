/* Numbered random planes, as files in memory. */
#pragma once

#include "../../spanfile/tests/common.h"
#include "planefile.h"

static inline const unsigned char *named_pixels(void *user, const planefile_picture *wanted);

static inline planefile_source memory_source(memory_file *file) {
  return (planefile_source){
      .read = memory_read, .user = file, .size = file->size, .picture = named_pixels};
}

static inline int32_t random_between(random_state *random, int32_t low, int32_t high) {
  return low + (int32_t)random_below(random, (uint32_t)(high - low) + 1);
}

/* ---------------------------------------------------------------- pictures */

enum { PICTURES = 6, PICTURE_SIDE = 40 };

/* The pixels of a picture of these tests: waves, with noise in every other one. */
static inline int32_t picture_channel(uint32_t picture, uint32_t x, uint32_t y, uint32_t c) {
  random_state random = {picture + 7 * (x + 99 * (y + 99 * c))};
  uint32_t wave = (x * (c + 1) + y * (picture + 1)) % 32, noise = random_below(&random, 64);
  return (int32_t)(wave < 16 ? 15 * wave : 15 * (31 - wave)) +
         (picture % 2 ? (int32_t)noise / 5 : 0);
}

static inline bool picture_row(void *user, uint32_t y, void *out) {
  const planefile_picture *picture = user;
  for (uint32_t x = 0; x < picture->width; x++)
    for (uint32_t c = 0; c < 4; c++) {
      int32_t channel = picture_channel((uint32_t)picture->key[0], x, y, c);
      if (picture->kind == PLANEFILE_LIGHT)
        ((planefile_cell *)out)[x].colour[c] = channel * 257 - (c < 3 ? 900 : 0);
      else
        ((unsigned char *)out)[4 * x + c] = (unsigned char)channel;
    }
  return true;
}

/* Two of each kind. */
static inline const planefile_picture *test_pictures(void) {
  static planefile_picture pictures[PICTURES];
  static char names[PICTURES][16];
  for (uint32_t i = 0; i < PICTURES; i++) {
    snprintf(names[i], sizeof names[i], "picture %d", (int)i);
    pictures[i] = (planefile_picture){.width = 1 + 11 * i % PICTURE_SIDE,
                                      .height = 1 + 17 * i % PICTURE_SIDE,
                                      .kind = (uint8_t)(i % 3),
                                      .key = {i, 0},
                                      .row = picture_row,
                                      .user = &pictures[i],
                                      .name = names[i]};
  }
  return pictures;
}

static inline const unsigned char *named_pixels(void *user, const planefile_picture *wanted) {
  static unsigned char pixels[4 * PICTURE_SIDE * PICTURE_SIDE];
  const planefile_picture *pictures = test_pictures();
  (void)user;
  for (size_t i = 0; i < PICTURES; i++) {
    const planefile_picture *p = &pictures[i];
    if (p->kind != PLANEFILE_NAMED || strcmp(p->name, wanted->name) != 0 ||
        p->width != wanted->width || p->height != wanted->height || p->key[0] != wanted->key[0])
      continue;
    for (uint32_t y = 0; y < p->height; y++)
      picture_row(p->user, y, pixels + (size_t)4 * p->width * y);
    return pixels;
  }
  return NULL;
}

/* ---------------------------------------------------------------- planes */

/* A plane with room to grow in. */
typedef struct drawing {
  planefile_point *points;
  planefile_piece *pieces;
  planefile_chain *chains;
  planefile_border *borders;
  planefile_cell *cells;
  planefile_program *programs;
  planefile_step *steps;
  planefile_axis *axes;
  planefile_stop *stops;
  planefile_band plane;
} drawing;

/* Whether a drawing has cells with programs. */
typedef enum variety { FLAT, VARIED } variety;
enum { STEPS_A_CELL = 12 };

static inline drawing drawing_new(uint32_t shapes) {
  size_t pieces = 8 * (size_t)shapes + 1;
  drawing d = {.points = calloc(4 * pieces, sizeof *d.points),
               .pieces = calloc(pieces, sizeof *d.pieces),
               .chains = calloc(pieces, sizeof *d.chains),
               .borders = calloc(4 * pieces, sizeof *d.borders),
               .cells = calloc(4 * pieces, sizeof *d.cells),
               .programs = calloc(4 * pieces, sizeof *d.programs),
               .steps = calloc(4 * STEPS_A_CELL * pieces, sizeof *d.steps),
               .axes = calloc(4 * STEPS_A_CELL * pieces, sizeof *d.axes),
               .stops = calloc(16 * STEPS_A_CELL * pieces, sizeof *d.stops)};
  d.plane = (planefile_band){.foot = PLANEFILE_SIDE,
                             .points = d.points,
                             .pieces = d.pieces,
                             .chains = d.chains,
                             .borders = d.borders,
                             .cells = d.cells,
                             .programs = d.programs,
                             .steps = d.steps,
                             .axes = d.axes,
                             .stops = d.stops,
                             .pictures = test_pictures(),
                             .picture_count = PICTURES};
  return d;
}

static inline void drawing_free(drawing *d) {
  void *arrays[] = {d->points,   d->pieces, d->chains, d->borders, d->cells,
                    d->programs, d->steps,  d->axes,   d->stops};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
    free(arrays[i]);
}

static inline planefile_cell random_colour(random_state *random, bool is_opaque) {
  planefile_cell out;
  for (int c = 0; c < 3; c++)
    out.colour[c] = random_between(random, 0, PLANEFILE_WHITE);
  out.colour[3] = is_opaque ? PLANEFILE_WHITE : random_between(random, 0, PLANEFILE_WHITE);
  return out;
}

static inline uint32_t add_cell(drawing *d, random_state *random, bool is_opaque) {
  d->cells[d->plane.cell_count] = random_colour(random, is_opaque);
  return d->plane.cell_count++;
}

static inline double random_double(random_state *random, double low, double high) {
  return low + (high - low) * random_next(random) / UINT32_MAX;
}

/* The place of a picture: many have their edges along the frame's, and some are far smaller than
 * their pixels. */
static inline void place_picture(random_state *random, planefile_axis *axis) {
  double wide = random_double(random, 1, 60), high = random_double(random, 1, 60);
  bool is_upright = random_below(random, 2);
  wide *= random_below(random, 4) ? 1 : 40;
  axis->picture = random_below(random, PICTURES);
  axis->wrap = (uint8_t)random_below(random, 3);
  axis->filter = (uint8_t)random_below(random, 4);
  for (int i = 0; i < 3; i++) {
    axis->p[i] *= i == 1 && is_upright ? 0 : wide;
    axis->q[i] *= i == 0 && is_upright ? 0 : high;
  }
}

/* A slope that a gradient may have, and now and then a frame in perspective. */
static inline planefile_axis random_axis(random_state *random) {
  planefile_axis axis = {.kind = (uint8_t)random_below(random, 4), .w = {0, 0, 1}};
  bool is_wide = random_below(random, 4) == 0;
  for (int i = 0; i < 3; i++) {
    axis.p[i] = random_double(random, -1.5, 1.5);
    axis.q[i] = axis.kind == PLANEFILE_LINEAR ? 0 : random_double(random, -1.5, 1.5);
    axis.w[i] += is_wide ? random_double(random, -0.2, 0.2) : 0;
  }
  axis.focus = axis.kind == PLANEFILE_RADIAL ? random_double(random, 0, 0.8) : 0;
  if (axis.kind == PLANEFILE_PICTURE)
    place_picture(random, &axis);
  return axis;
}

static inline planefile_step random_ramp(drawing *d, random_state *random) {
  planefile_band *plane = &d->plane;
  bool is_old = plane->axis_count > 0 && random_below(random, 3) > 0;
  uint32_t axis = is_old ? random_below(random, plane->axis_count) : plane->axis_count;
  if (!is_old)
    d->axes[plane->axis_count++] = random_axis(random);
  planefile_step step = {.kind = PLANEFILE_RAMP, .axis = axis, .stop = plane->stop_count};
  step.stop_count = d->axes[axis].kind == PLANEFILE_TRIANGLE ? 3 : 1 + random_below(random, 4);
  if (d->axes[axis].kind == PLANEFILE_PICTURE)
    step.stop_count = 1;
  double at = random_double(random, -0.5, 0.5);
  for (uint32_t i = 0; i < step.stop_count; i++) {
    d->stops[plane->stop_count++] = (planefile_stop){at, random_colour(random, false)};
    at += random_double(random, 0.1, 0.6);
  }
  return step;
}

/* is_opaque: no matte, behind which nothing is. */
static inline planefile_step random_leave(random_state *random, bool is_opaque) {
  uint32_t hows = is_opaque ? PLANEFILE_MATTE : PLANEFILE_INVERTED_LUMA + 1;
  planefile_step step = {.kind = PLANEFILE_LEAVE, .how = (uint8_t)random_below(random, hows)};
  step.colour = random_colour(random, false);
  return step;
}

/* Some layers, of which a few in the middle may be a group. */
static inline uint32_t add_varied(drawing *d, random_state *random, bool is_opaque) {
  planefile_band *plane = &d->plane;
  planefile_program *program = &d->programs[plane->cell_count];
  uint32_t layers = random_between(random, 1, 4), group = random_below(random, 2 * layers);
  program->step = plane->step_count;
  for (uint32_t i = 0; i < layers; i++) {
    if (i == group)
      d->steps[plane->step_count++] = (planefile_step){.kind = PLANEFILE_ENTER};
    planefile_step flat = {.kind = PLANEFILE_FLAT, .colour = random_colour(random, false)};
    bool is_ramp = random_below(random, 3) > 0;
    d->steps[plane->step_count++] = is_ramp ? random_ramp(d, random) : flat;
  }
  if (group < layers)
    d->steps[plane->step_count++] = random_leave(random, is_opaque);
  if (is_opaque)
    d->steps[plane->step_count++] =
        (planefile_step){.kind = PLANEFILE_FLAT, .colour = random_colour(random, true)};
  program->step_count = plane->step_count - program->step;
  return plane->cell_count++;
}

/* A piece from one point to another, whose heights between them only fall where it is plain. */
static inline void add_piece(drawing *d, random_state *random, planefile_point from,
                             planefile_point to) {
  uint8_t degree = (uint8_t)random_between(random, 1, 3);
  bool is_rational = degree > 1 && random_below(random, 3) == 0;
  planefile_point *points = &d->points[d->plane.point_count];
  d->pieces[d->plane.piece_count++] = (planefile_piece){d->plane.point_count, degree, is_rational};
  for (int i = 0; i <= degree; i++) {
    points[i].x = i == 0        ? from.x
                  : i == degree ? to.x
                                : from.x + random_between(random, -(1 << 24), 1 << 24);
    points[i].y = from.y + (int32_t)((int64_t)(to.y - from.y) * i / degree);
    points[i].w = PLANEFILE_WEIGHT;
    if (is_rational)
      points[i].w = (uint32_t)random_between(random, PLANEFILE_WEIGHT / 2, PLANEFILE_WEIGHT);
  }
  d->plane.point_count += degree + 1U;
}

/* A chain through random points at given heights. */
static inline uint32_t add_chain(drawing *d, random_state *random, const int32_t *heights,
                                 int count) {
  planefile_chain *chain = &d->chains[d->plane.chain_count];
  *chain = (planefile_chain){d->plane.piece_count, (uint32_t)count - 1};
  planefile_point from = {random_between(random, -(1 << 24), 5 << 24), heights[0], 0};
  for (int i = 1; i < count; i++) {
    planefile_point to = {from.x + random_between(random, -(1 << 23), 1 << 23), heights[i], 0};
    add_piece(d, random, from, to);
    from = to;
  }
  return d->plane.chain_count++;
}

static inline void add_border(drawing *d, uint32_t chain, int32_t top, int32_t foot, uint32_t left,
                              uint32_t right) {
  d->borders[d->plane.border_count++] = (planefile_border){chain, top, foot, left, right};
}

/* Two chains from top to foot, between which there is another cell from each cut to the next; now
 * and then they are hidden. Sums do not ask whether other shapes lie there, too. */
static inline void add_shape(drawing *d, random_state *random, bool is_opaque, variety kind) {
  int32_t top = random_between(random, -(1 << 24), 4 << 24);
  int32_t least = kind == VARIED ? 21 : 10; /* what varies must be seen in small views */
  int32_t height = random_between(random, 1 << 4, 1 << random_between(random, least, 25));
  int32_t heights[4] = {top, top + height / 4, top + height / 2, top + height};
  int32_t cuts[4] = {top, top + height / 3, top + height / 3 * 2, top + height};
  uint32_t chains[2];
  chains[0] = add_chain(d, random, heights, 4);
  chains[1] = add_chain(d, random, heights, 4);
  for (int i = 0; i < 3; i++) {
    int32_t from = cuts[i] > 0 ? cuts[i] : 0;
    int32_t to = cuts[i + 1] < PLANEFILE_SIDE ? cuts[i + 1] : PLANEFILE_SIDE;
    if (from >= to || random_below(random, 6) == 0)
      continue;
    bool is_new = random_below(random, 4) > 0 || d->plane.cell_count < 2;
    bool varies = kind == VARIED && random_below(random, 2);
    uint32_t cell = !is_new  ? 1 + random_below(random, d->plane.cell_count - 1)
                    : varies ? add_varied(d, random, is_opaque)
                             : add_cell(d, random, is_opaque);
    add_border(d, chains[0], from, to, 0, cell);
    add_border(d, chains[1], from, to, cell, 0);
  }
}

/* Something translucent over other cells: what is right of its first chain is what is left of it,
 * times a slope, and something; its second chain is the other way round. */
static inline void add_glass(drawing *d, random_state *random, bool is_opaque) {
  enum { CUTS = 6 };
  int32_t start = random_between(random, 1 << 20, 1 << 25);
  const int32_t heights[4] = {start, start + (1 << 23), start + (1 << 24), 1 << 26};
  uint32_t chains[2];
  chains[0] = add_chain(d, random, heights, 4);
  chains[1] = add_chain(d, random, heights, 4);
  planefile_cell colour = random_colour(random, is_opaque);
  int slope = random_between(random, 20, 90);
  for (int i = 0; i < CUTS; i++) {
    uint32_t below = add_cell(d, random, is_opaque), above = d->plane.cell_count++;
    planefile_cell *cells = &d->cells[below];
    for (int c = 0; c < 4; c++) {
      cells[0].colour[c] = (cells[0].colour[c] + 3 * colour.colour[c]) / 4; /* seen dimly */
      cells[1].colour[c] = (cells[0].colour[c] * slope + colour.colour[c] * (100 - slope)) / 100;
    }
    int32_t top = start + (i << 22), foot = i + 1 < CUTS ? top + (1 << 22) : 1 << 26;
    add_border(d, chains[0], top, foot, below, above);
    add_border(d, chains[1], top, foot, above, below);
  }
}

static inline drawing random_drawing(uint64_t seed, uint32_t shapes, variety kind) {
  random_state random = {seed};
  drawing d = drawing_new(shapes);
  bool is_opaque = seed % 3 == 0;
  add_cell(&d, &random, is_opaque);
  for (uint32_t i = 0; i < shapes; i++)
    if (i % 5 == 4)
      add_glass(&d, &random, is_opaque);
    else
      add_shape(&d, &random, is_opaque, kind);
  return d;
}

/* Moves a chain with its borders, as far as they stay in the frame. */
static inline void move_chain(drawing *d, uint32_t chain, int32_t dx, int32_t dy) {
  const planefile_chain *of = &d->chains[chain];
  for (uint32_t i = of->piece; i < of->piece + of->piece_count; i++)
    for (uint32_t k = 0; k <= d->pieces[i].degree; k++) {
      d->points[d->pieces[i].point + k].x += dx;
      d->points[d->pieces[i].point + k].y += dy;
    }
  uint32_t kept = 0;
  for (uint32_t i = 0; i < d->plane.border_count; i++) {
    planefile_border b = d->borders[i];
    if (b.chain == chain) {
      b.top = b.top + dy > 0 ? b.top + dy : 0;
      b.foot = b.foot + dy < PLANEFILE_SIDE ? b.foot + dy : PLANEFILE_SIDE;
    }
    if (b.top < b.foot)
      d->borders[kept++] = b;
  }
  d->plane.border_count = kept;
}

/* Moves the inner points of a chain across. */
static inline void bend_chain(drawing *d, random_state *random, uint32_t chain) {
  const planefile_chain *of = &d->chains[chain];
  for (uint32_t i = of->piece; i < of->piece + of->piece_count; i++)
    for (uint32_t k = 1; k < d->pieces[i].degree; k++)
      d->points[d->pieces[i].point + k].x += random_between(random, -999, 999);
}

static inline void recolour_program(drawing *d, random_state *random, planefile_program program) {
  for (uint32_t i = program.step; i < program.step + program.step_count; i++) {
    planefile_step *step = &d->steps[i];
    if (step->kind == PLANEFILE_FLAT)
      step->colour = random_colour(random, step->colour.colour[3] == PLANEFILE_WHITE);
    for (uint32_t k = 0; step->kind == PLANEFILE_RAMP && k < step->stop_count; k++)
      d->stops[step->stop + k].colour = random_colour(random, false);
  }
}

/* A cell other than cell 0 gets other colours, or becomes what another one is. */
static inline void alter_cell(drawing *d, random_state *random, uint32_t cell, bool is_opaque) {
  uint32_t other = random_below(random, d->plane.cell_count);
  if (random_below(random, 4) == 0) {
    d->programs[cell] = d->programs[other];
    d->cells[cell] = d->cells[other];
  } else if (d->programs[cell].step_count > 0) {
    recolour_program(d, random, d->programs[cell]);
  } else {
    d->cells[cell] = random_colour(random, is_opaque);
  }
}

static inline int32_t on_grid(int32_t at, uint16_t count) {
  return (int32_t)planefile_place_of(planefile_step_at(at, count), count);
}

/* Puts all places on a grid; borders that are lower than a step are left out. */
static inline void coarsen_drawing(drawing *d, planefile_grid grid) {
  uint32_t kept = 0;
  for (uint32_t i = 0; i < d->plane.point_count; i++) {
    d->points[i].x = on_grid(d->points[i].x, grid.columns);
    d->points[i].y = on_grid(d->points[i].y, grid.rows);
  }
  for (uint32_t i = 0; i < d->plane.border_count; i++) {
    planefile_border b = d->borders[i];
    b.top = on_grid(b.top, grid.rows);
    b.foot = on_grid(b.foot, grid.rows);
    if (b.top < b.foot)
      d->borders[kept++] = b;
  }
  d->plane.border_count = kept;
}

/* What the next frame of a film may be: some shapes have moved or bent, some axes have moved, some
 * cells differ. */
static inline void alter_drawing(drawing *d, random_state *random, bool is_opaque) {
  for (uint32_t i = 0; i + 1 < d->plane.chain_count; i += 2) {
    int32_t dx = random_between(random, -(1 << 20), 1 << 20);
    int32_t dy = random_between(random, -(1 << 20), 1 << 20);
    uint32_t what = random_below(random, 4);
    if (what == 0) {
      move_chain(d, i, dx, dy);
      move_chain(d, i + 1, dx, dy);
    } else if (what == 1) {
      bend_chain(d, random, i);
    }
  }
  for (uint32_t i = 0; i < d->plane.axis_count; i++)
    if (random_below(random, 2))
      d->axes[i].p[2] += 0.125;
  for (uint32_t i = 1; i < d->plane.cell_count; i += 3)
    if (random_below(random, 4) == 0)
      alter_cell(d, random, i, is_opaque);
}

/* ---------------------------------------------------------------- writing and reading them */

/* frames_second: 0 for a plane. */
static inline planefile_writer_desc writer_desc(memory_file *file, double frames_second) {
  return (planefile_writer_desc){
      .width = 4, .height = 3, .write = memory_write, .user = file, .frames_second = frames_second};
}

static inline memory_file write_coded(const planefile_band *plane, bool is_coded) {
  memory_file file = {0};
  planefile_writer_desc desc = writer_desc(&file, 0);
  desc.is_coded = is_coded;
  CHECK(planefile_write(&desc, plane) == PLANEFILE_OK);
  return file;
}

static inline memory_file write_plane(const planefile_band *plane) {
  return write_coded(plane, false);
}

static inline planefile_plane *read_plane(memory_file *file) {
  planefile_plane *plane = NULL;
  planefile_fault fault = {0};
  planefile_source source = memory_source(file);
  if (!CHECK(planefile_read(&source, 0, PLANEFILE_SIDE, &plane, &fault) == PLANEFILE_OK))
    fprintf(stderr, "  at %llu: %s\n", (unsigned long long)fault.offset, fault.reason);
  return plane;
}

/* A drawing, its file, and the plane that is read from the file. */
typedef struct written {
  drawing d;
  memory_file file;
  planefile_plane *plane;
} written;

static inline written written_new(drawing d, bool is_coded) {
  written w = {.d = d, .file = write_coded(&d.plane, is_coded)};
  w.plane = read_plane(&w.file);
  return w;
}

static inline written random_written(uint64_t seed, uint32_t shapes, variety kind) {
  return written_new(random_drawing(seed, shapes, kind), false);
}

static inline void written_free(written *w) {
  planefile_plane_destroy(w->plane);
  free(w->file.bytes);
  drawing_free(&w->d);
}

/* The colours of a view, row by row; the caller frees them. */
static inline planefile_cell *draw_view(const planefile_plane *plane, planefile_view view) {
  planefile_drawer *drawer = NULL;
  planefile_cell *out = calloc((size_t)view.columns * view.rows, sizeof *out), *at = out;
  CHECK(planefile_drawer_create(plane, &view, &drawer) == PLANEFILE_OK);
  for (uint32_t y = 0; y < view.rows && drawer; y++) {
    const planefile_span *spans;
    size_t count;
    CHECK(planefile_drawer_row(drawer, &spans, &count) == PLANEFILE_OK);
    for (uint32_t i = 0, x = 0; i < count; i++)
      for (; x < spans[i].end; x++)
        *at++ = spans[i].colour;
  }
  planefile_drawer_destroy(drawer);
  return out;
}

static inline bool draws_same(const planefile_plane *one, const planefile_plane *other,
                              planefile_view view) {
  planefile_cell *a = draw_view(one, view), *b = draw_view(other, view);
  bool is_same = memcmp(a, b, (size_t)view.columns * view.rows * sizeof *a) == 0;
  free(a);
  free(b);
  return is_same;
}
