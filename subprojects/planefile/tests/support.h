/* Files in memory, numbered random planes and checks. */
#ifndef PLANEFILE_TESTS_SUPPORT_H
#define PLANEFILE_TESTS_SUPPORT_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "planefile.h"

static int check_count, check_failures;

static inline bool check(bool holds, const char *file, int line, const char *text) {
  check_count++;
  if (!holds && ++check_failures <= 20)
    fprintf(stderr, "%s:%d: %s\n", file, line, text);
  return holds;
}
#define CHECK(holds) check((holds), __FILE__, __LINE__, #holds)

static inline int check_done(void) {
  if (check_failures)
    printf("%d of %d checks failed\n", check_failures, check_count);
  else
    printf("%d checks passed\n", check_count);
  return check_failures != 0;
}

/* ---------------------------------------------------------------- files in memory */

typedef struct memory_file {
  unsigned char *bytes;
  size_t size, capacity;
} memory_file;

static inline bool memory_write(void *user, const void *bytes, size_t size) {
  memory_file *file = user;
  if (file->size + size > file->capacity) {
    file->capacity = 2 * (file->size + size);
    file->bytes = realloc(file->bytes, file->capacity);
  }
  if (size > 0)
    memcpy(file->bytes + file->size, bytes, size);
  file->size += size;
  return true;
}

static inline bool memory_read(void *user, uint64_t offset, void *bytes, size_t size) {
  const memory_file *file = user;
  if (offset > file->size || size > file->size - offset)
    return false;
  memcpy(bytes, file->bytes + offset, size);
  return true;
}

static inline planefile_source memory_source(memory_file *file) {
  return (planefile_source){.read = memory_read, .user = file, .size = file->size};
}

/* ---------------------------------------------------------------- random numbers */

typedef struct random_state {
  uint64_t state;
} random_state;

static inline uint32_t random_next(random_state *random) { /* splitmix64 */
  uint64_t z = random->state += 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return (uint32_t)((z ^ z >> 31) >> 16);
}
static inline uint32_t random_below(random_state *random, uint32_t limit) {
  return (uint32_t)((uint64_t)random_next(random) * limit >> 32);
}
static inline int32_t random_between(random_state *random, int32_t low, int32_t high) {
  return low + (int32_t)random_below(random, (uint32_t)(high - low) + 1);
}

/* ---------------------------------------------------------------- planes */

/* A plane with room to grow in. */
typedef struct drawing {
  planefile_point *points;
  planefile_piece *pieces;
  planefile_chain *chains;
  planefile_border *borders;
  planefile_cell *cells;
  planefile_band plane;
} drawing;

static inline drawing drawing_new(uint32_t shapes) {
  size_t pieces = 8 * (size_t)shapes + 1;
  drawing d = {.points = calloc(4 * pieces, sizeof *d.points),
               .pieces = calloc(pieces, sizeof *d.pieces),
               .chains = calloc(pieces, sizeof *d.chains),
               .borders = calloc(4 * pieces, sizeof *d.borders),
               .cells = calloc(4 * pieces, sizeof *d.cells)};
  d.plane = (planefile_band){.foot = PLANEFILE_SIDE,
                             .points = d.points,
                             .pieces = d.pieces,
                             .chains = d.chains,
                             .borders = d.borders,
                             .cells = d.cells};
  return d;
}

static inline void drawing_free(drawing *d) {
  free(d->points);
  free(d->pieces);
  free(d->chains);
  free(d->borders);
  free(d->cells);
}

static inline uint32_t add_cell(drawing *d, random_state *random, bool is_opaque) {
  planefile_cell *cell = &d->cells[d->plane.cell_count];
  for (int c = 0; c < 3; c++)
    cell->colour[c] = random_between(random, 0, PLANEFILE_WHITE);
  cell->colour[3] = is_opaque ? PLANEFILE_WHITE : random_between(random, 0, PLANEFILE_WHITE);
  return d->plane.cell_count++;
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
static inline void add_shape(drawing *d, random_state *random, bool is_opaque) {
  int32_t top = random_between(random, -(1 << 24), 4 << 24);
  int32_t height = random_between(random, 1 << 4, 1 << random_between(random, 10, 25));
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
    uint32_t cell = random_below(random, 4) > 0 || d->plane.cell_count < 2
                        ? add_cell(d, random, is_opaque)
                        : 1 + random_below(random, d->plane.cell_count - 1);
    add_border(d, chains[0], from, to, 0, cell);
    add_border(d, chains[1], from, to, cell, 0);
  }
}

static inline drawing random_drawing(uint64_t seed, uint32_t shapes) {
  random_state random = {seed};
  drawing d = drawing_new(shapes);
  bool is_opaque = seed % 3 == 0;
  add_cell(&d, &random, is_opaque);
  for (uint32_t i = 0; i < shapes; i++)
    add_shape(&d, &random, is_opaque);
  return d;
}

/* ---------------------------------------------------------------- writing and reading them */

static inline memory_file write_plane(const planefile_band *plane) {
  memory_file file = {0};
  planefile_writer_desc desc = {.width = 4, .height = 3, .write = memory_write, .user = &file};
  CHECK(planefile_write(&desc, plane) == PLANEFILE_OK);
  return file;
}

static inline planefile_plane *read_plane(memory_file *file) {
  planefile_plane *plane = NULL;
  planefile_fault fault = {0};
  planefile_source source = memory_source(file);
  if (!CHECK(planefile_read(&source, 0, PLANEFILE_SIDE, &plane, &fault) == PLANEFILE_OK))
    fprintf(stderr, "  at %llu: %s\n", (unsigned long long)fault.offset, fault.reason);
  return plane;
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

#endif
