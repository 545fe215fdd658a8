#include "engine/map/adding.h"

/* Functions that return such vectors are inlined, so how they would be returned does not matter. */
#pragma GCC diagnostic ignored "-Wpsabi"
typedef double doubles __attribute__((vector_size(32)));

/* ---------------------------------------------------------------- places */

typedef int32_t integers __attribute__((vector_size(16)));

static inline doubles load_doubles(const double *from) {
  doubles v;
  memcpy(&v, from, sizeof v);
  return v;
}

#define FARTHEST (32767.0 * CS_MAP_UNIT)

/* Clamped to the range of an integer. A drawing is at most 16384 pixels long, so this bends only
 * borders that lie wholly left of the frame. */
static inline doubles bounded(doubles v) {
#ifdef __AVX2__
  return _mm256_max_pd(_mm256_set1_pd(-FARTHEST), _mm256_min_pd(_mm256_set1_pd(FARTHEST), v));
#else
  for (int i = 0; i < 4; i++)
    v[i] = v[i] < -FARTHEST ? -FARTHEST : v[i] > FARTHEST ? FARTHEST : v[i];
  return v;
#endif
}

/* From points to places: (origin + point) * scale + shift. Each array has x first, then y. */
typedef struct placing {
  double origin[4], scale[4], shift[4];
} placing;

static placing placing_of(const cs_map_drawing *d) {
  placing p;
  for (int lane = 0; lane < 4; lane++) {
    bool is_x = lane % 2 == 0;
    p.origin[lane] = (double)(is_x ? d->left : d->top) * CS_MAP_UNIT;
    p.scale[lane] = (is_x ? d->scale_x : d->scale_y) * CS_MAP_UNIT;
    p.shift[lane] = (is_x ? d->shift_x : d->shift_y) * CS_MAP_UNIT + 0.5;
  }
  return p;
}

/* Rounded, except that numbers below 0 may be too great by one: they lie beyond the frame. */
static inline integers place_two(const placing *p, integers points) {
  doubles whole = load_doubles(p->origin) + __builtin_convertvector(points, doubles);
  return __builtin_convertvector(bounded(whole * load_doubles(p->scale) + load_doubles(p->shift)),
                                 integers);
}

/* Puts points into their places; `out` must have room for one more than there are. */
static inline void put_places(const placing *p, const cs_map_point *points, size_t count,
                              cs_map_point *out) {
  integers two = {0};
  for (; count > 1; count -= 2, points += 2, out += 2) {
    memcpy(&two, points, sizeof two);
    two = place_two(p, two);
    memcpy(out, &two, sizeof two);
  }
  if (count > 0) {
    memcpy(&two, points, sizeof *points);
    two = place_two(p, two);
    memcpy(out, &two, sizeof two);
  }
}

/* ---------------------------------------------------------------- which borders */

/* Where the lives of a swath are searched for. */
typedef struct swath {
  celspan_context *context;
  cs_map_rows *rows;
  const cs_map_drawing *drawing;
  placing placing;
  int32_t row, width, top, foot; /* width: of the frame; top, foot: in places */
} swath;

/* The first line of a live border, from a place on, that is in the swath. */
static uint32_t find_place(const swath *s, const cs_map_live *live, uint32_t from) {
  const cs_map_point *places = s->rows->places;
  uint32_t low = from, high = live->end;
  while (high - low > 1) {
    uint32_t middle = low + (high - low) / 2;
    if (places[middle].y <= s->top)
      low = middle;
    else
      high = middle;
  }
  return low;
}

/* Moves the places of the live borders to the front of their array. */
static void pack_places(cs_map_rows *rows) {
  uint32_t count = 0;
  for (size_t i = 0; i < rows->live_count; i++) {
    cs_map_live *live = &rows->lives[i];
    uint32_t kept = live->end - live->at;
    memmove(rows->places + count, rows->places + live->at, kept * sizeof *rows->places);
    live->at = count;
    count += kept;
    live->end = count;
  }
  rows->place_count = count;
}

/* Removes the borders that end above the swath. */
static void drop_lives(const swath *s) {
  cs_map_rows *rows = s->rows;
  size_t kept = 0, places = 0;
  for (size_t i = 0; i < rows->live_count; i++) {
    const cs_map_live *live = &rows->lives[i];
    if (live->foot > s->top) {
      places += live->end - live->at;
      rows->lives[kept++] = *live;
    }
  }
  rows->live_count = kept;
  if (rows->place_count > 2 * places)
    pack_places(rows);
}

/* The difference of the keys from the left to the right of a border; also whether a cell on one of
 * its sides varies. */
static void find_change(const cs_map_drawing *drawing, const cs_map_border *f, cs_map_live *live) {
  const cs_map_cell *left = &drawing->map->cells[f->left], *right = &drawing->map->cells[f->right];
  live->varies = left->length > 0 || right->length > 0;
  live->key = right->key - left->key;
}

/* The places of a border are appended to the others. box: its lowest and its highest place. If a
 * border is left of the frame, only its heights count. */
static inline celspan_status add_live(const swath *s, uint32_t number, const cs_map_point *box) {
  cs_map_rows *rows = s->rows;
  const cs_map_lines *lines = s->drawing->lines;
  const cs_map_border *f = &lines->borders[number];
  const bool is_outside = box[1].x < 0;
  const cs_map_point *points = lines->points + f->first;
  uint32_t first = (uint32_t)rows->place_count, count = is_outside ? 2 : f->count;
  CS_TRY(CS_ARRAY_RESERVE(s->context, rows->places, first + count + 1));
  CS_TRY(CS_ARRAY_RESERVE(s->context, rows->lives, rows->live_count + 1));
  cs_map_live *live = &rows->lives[rows->live_count++];
  *live = (cs_map_live){.border = number,
                        .at = first,
                        .end = first + count,
                        .low = box[0].x,
                        .high = box[1].x,
                        .foot = box[1].y};
  find_change(s->drawing, f, live);
  cs_map_find_step(s->drawing->colours, f, live);
  if (is_outside)
    memcpy(rows->places + first, box, 2 * sizeof *box);
  else
    put_places(&s->placing, points, count, rows->places + first);
  if (rows->places[first].y < s->top)
    live->at = find_place(s, live, first);
  rows->place_count = live->end;
  return CELSPAN_OK;
}

/* Adds the borders that begin above the foot of the swath. */
static celspan_status add_lives(const swath *s) {
  cs_map_rows *rows = s->rows;
  const cs_map_lines *lines = s->drawing->lines;
  for (; rows->next < lines->border_count; rows->next++) {
    const cs_map_border *f = &lines->borders[rows->next];
    const cs_map_point ends[2] = {{f->low, lines->points[f->first].y}, {f->high, f->foot}};
    cs_map_point box[3];
    put_places(&s->placing, ends, 2, box);
    if (box[0].y >= s->foot)
      return CELSPAN_OK;
    if (box[1].y > s->top && box[0].x / CS_MAP_UNIT < s->width)
      CS_TRY(add_live(s, rows->next, box));
  }
  return CELSPAN_OK;
}

/* Goes back to the first border, or keeps the borders that cross the swath above. */
static void go_to(const swath *s) {
  cs_map_rows *rows = s->rows;
  if (rows->row < 0 || s->row < rows->row)
    rows->next = 0;
  if (rows->next == 0)
    rows->live_count = 0;
  bool is_next = s->row == rows->row + CS_MAP_ROWS;
  for (size_t i = 0; i < rows->live_count; i++) {
    cs_map_live *live = &rows->lives[i];
    live->at = is_next ? live->next : find_place(s, live, live->at);
  }
  rows->row = -1;
}

celspan_status CS_WIDE(cs_map_find_lives)(const cs_map_adding *adding) {
  cs_map_rows *rows = adding->rows;
  const int32_t top = adding->row * CS_MAP_UNIT;
  const swath s = {.context = adding->context,
                   .rows = rows,
                   .drawing = rows->drawing,
                   .placing = placing_of(rows->drawing),
                   .row = adding->row,
                   .width = adding->sums->width,
                   .top = top,
                   .foot = top + CS_MAP_ROWS * CS_MAP_UNIT};
  go_to(&s);
  drop_lives(&s);
  return add_lives(&s);
}

/* ---------------------------------------------------------------- a pixel */

/* The sums to which a border is added: copies, which stay in registers. */
typedef struct target {
  cs_map_sum *sums;
  unsigned char *bits;
  uint32_t stride; /* bytes of a row of bits */
  bool varies;     /* the areas of cells that vary are listed; a constant of each caller */
  cs_v4 step;
  uint64_t key;
  const cs_map_live *live;
} target;

/* Adds an area to the area of the cell on the right, and subtracts it from the area of the cell on
 * the left; cells that do not vary have no area here. */
static celspan_status add_parts(const cs_map_adding *a, const cs_map_live *live, uint32_t *head,
                                int32_t change) {
  const cs_map_drawing *drawing = a->rows->drawing;
  const cs_map_border *f = &drawing->lines->borders[live->border];
  cs_map_sums *all = a->sums;
  for (int side = 0; side < 2; side++) {
    const cs_map_part part = {side == 0 ? -change : change, side == 0 ? f->left : f->right, *head};
    if (drawing->map->cells[part.cell].length == 0)
      continue;
    CS_TRY(CS_ARRAY_APPEND(a->context, all->parts, all->part_count, part));
    *head = (uint32_t)all->part_count;
  }
  return CELSPAN_OK;
}

/* Adds the area of a border in a pixel, minus its area in the pixel on the left. weight: the area
 * again, as a float. */
static inline void add(const cs_map_adding *a, const target *t, cs_map_sum *sum, int32_t change,
                       float weight) {
  cs_v4_store(sum->colour, cs_v4_load(sum->colour) + cs_v4_all(weight) * t->step);
  sum->key += (uint64_t)change * t->key;
  if (t->varies && add_parts(a, t->live, &sum->head, change))
    *a->status = CELSPAN_NO_MEMORY;
}

/* Marks pixels, up to 24 from one whose bit is in byte `at` on. */
static inline void mark(const target *t, uint32_t at, uint32_t mask) {
  uint32_t bits;
  memcpy(&bits, t->bits + at, sizeof bits);
  bits |= mask;
  memcpy(t->bits + at, &bits, sizeof bits);
}

/* ---------------------------------------------------------------- pieces */

#define PIECES 128
#define UNIT_BITS 16 /* vectors of integers are shifted: they are slow to divide */
_Static_assert(1 << UNIT_BITS == CS_MAP_UNIT, "a pixel is a power of two");

/* The part of a line in one row of the frame: its upper end and its lower end. */
typedef struct piece {
  int32_t xa, ya, xb, yb;
} piece;

/* The pieces of one border after the other, which are added together. */
typedef struct batch {
  piece pieces[PIECES + 7]; /* at the end room for zeros up to a multiple of eight */
  size_t count, run_count;
  struct {
    const cs_map_live *live;
    size_t end; /* of its pieces */
  } runs[PIECES];
} batch;

static inline target target_of(const cs_map_adding *a, const cs_map_live *live, bool varies) {
  const cs_map_sums *sums = a->sums;
  return (target){.sums = sums->sums,
                  .bits = (unsigned char *)sums->bits,
                  .stride = (uint32_t)(sums->words * sizeof *sums->bits),
                  .varies = varies,
                  .step = cs_v4_load(live->step),
                  .key = live->key,
                  .live = live};
}

/* Adds a piece over more than two columns. */
static __attribute__((noinline)) void add_columns(const cs_map_adding *a, const cs_map_live *live,
                                                  const piece *pieces, size_t k) {
  const target whole = target_of(a, live, live->varies), *t = &whole;
  const piece *p = pieces + k;
  const int32_t from = p->xa < p->xb ? p->xa : p->xb, to = p->xa < p->xb ? p->xb : p->xa;
  const int32_t height = p->yb - p->ya;
  const double slope = (double)height / ((double)to - from);
  const uint32_t row = ((uint32_t)p->ya / CS_MAP_UNIT) % CS_MAP_ROWS;
  uint32_t column = (uint32_t)from / CS_MAP_UNIT;
  /* rest: how far the end of the last column is below its height */
  int32_t x = from, passed = 0, rest = 0;
  cs_map_sum *sum = &t->sums[CS_MAP_ROWS * (size_t)column + row];
  for (; x < to; column++, sum += CS_MAP_ROWS) {
    const int32_t right = (int32_t)(column + 1) * CS_MAP_UNIT, end = right < to ? right : to;
    const int32_t all = right < to ? (int32_t)((double)(right - from) * slope + 0.5) : height;
    const uint64_t twice = (uint64_t)(uint32_t)(all - passed) * (uint32_t)(2 * right - x - end);
    const int32_t area = (int32_t)((twice + CS_MAP_UNIT) / (2 * CS_MAP_UNIT));
    mark(t, row * t->stride + column / 8, 3U << column % 8);
    add(a, t, sum, rest + area, (float)(rest + area));
    rest = all - passed - area;
    passed = all;
    x = end;
  }
  add(a, t, sum, rest, (float)rest);
}

typedef float eight __attribute__((vector_size(32)));
typedef int32_t integers8 __attribute__((vector_size(32)));

static inline integers8 load(const void *from) {
  integers8 v;
  memcpy(&v, from, sizeof v);
  return v;
}

static inline integers8 choose(integers8 mask, integers8 a, integers8 b) {
  return (mask & a) | (~mask & b);
}

/* The members of eight pieces. */
typedef struct ends {
  integers8 xa, ya, xb, yb;
} ends;

static inline ends load_pieces(const piece *p) {
  const integers8 a = load(p), b = load(p + 2), c = load(p + 4), d = load(p + 6);
  const integers8 ab = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
  const integers8 cd = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
  const integers8 ba = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
  const integers8 dc = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
  return (ends){__builtin_shufflevector(ab, cd, 0, 4, 1, 5, 8, 12, 9, 13),
                __builtin_shufflevector(ab, cd, 2, 6, 3, 7, 10, 14, 11, 15),
                __builtin_shufflevector(ba, dc, 0, 4, 1, 5, 8, 12, 9, 13),
                __builtin_shufflevector(ba, dc, 2, 6, 3, 7, 10, 14, 11, 15)};
}

/* The changes by pieces, each of them in at most two columns. */
typedef struct changes {
  int32_t sum[PIECES];                /* the sum of the first column, in bytes from the first */
  int32_t byte[PIECES], mask[PIECES]; /* the bits of all columns */
  /* the changes in the first column, in the second, and to the right of both */
  int32_t one[PIECES], two[PIECES], three[PIECES];
  float weights[3][PIECES]; /* the same changes as floats */
  int32_t beyond[PIECES];   /* how far a piece reaches right of the first column */
} changes;

#define FLOATS(v) __builtin_convertvector(v, eight)
#define ROUNDED(v) __builtin_convertvector((v) + 0.5f, integers8)
static inline void put(integers8 v, int32_t *out) { memcpy(out, &v, sizeof v); }

static inline void put_floats(eight v, float *out) { memcpy(out, &v, sizeof v); }

/* Where eight pieces, from the ith one on, are in the sums. */
static inline void find_places(uint32_t stride, integers8 from, integers8 ya, integers8 has_two,
                               size_t i, changes *out) {
  const integers8 column = from >> UNIT_BITS, row = (ya >> UNIT_BITS) & (CS_MAP_ROWS - 1);
  const integers8 sum = (column * CS_MAP_ROWS + row) * (int32_t)sizeof(cs_map_sum);
  const integers8 byte = row * (int32_t)stride + (column >> 3);
  const integers8 mask = (3 - 4 * has_two) << (column & 7);
  put(sum, out->sum + i);
  put(byte, out->byte + i);
  put(mask, out->mask + i);
}

/* An upright piece divides by 0, but that result is not used, because the piece has one column. */
static inline void find_changes(uint32_t stride, const piece *pieces, size_t i, changes *out) {
  const ends p = load_pieces(pieces + i);
  const integers8 is_down = p.xa < p.xb;
  const integers8 from = choose(is_down, p.xa, p.xb), to = choose(is_down, p.xb, p.xa);
  const integers8 all = p.yb - p.ya, right = (from | (CS_MAP_UNIT - 1)) + 1, beyond = to - right;
  const integers8 has_two = beyond > 0, end = choose(has_two, right, to);
  const eight share = FLOATS(right - from) / FLOATS(to - from);
  const integers8 height = choose(has_two, ROUNDED(FLOATS(all) * share), all);
  const integers8 rest = all - height;
  const float unit = 0.5f / CS_MAP_UNIT;
  const integers8 one = ROUNDED(FLOATS(height) * FLOATS(2 * right - from - end) * unit);
  const integers8 area = ROUNDED(FLOATS(rest) * FLOATS(2 * CS_MAP_UNIT - beyond) * unit);
  const integers8 two = height - one + area, three = rest - area;
  find_places(stride, from, p.ya, has_two, i, out);
  put(one, out->one + i);
  put(two, out->two + i);
  put(three, out->three + i);
  put_floats(FLOATS(one), out->weights[0] + i);
  put_floats(FLOATS(two), out->weights[1] + i);
  put_floats(FLOATS(three), out->weights[2] + i);
  put(beyond, out->beyond + i);
}

static inline void add_piece(const cs_map_adding *a, const target *t, const piece *pieces,
                             const changes *c, size_t k) {
  cs_map_sum *sum = (cs_map_sum *)(void *)((char *)t->sums + (uint32_t)c->sum[k]);
  if (c->beyond[k] > 0) {
    if (c->beyond[k] > CS_MAP_UNIT) {
      add_columns(a, t->live, pieces, k);
      return;
    }
    add(a, t, sum + 2 * CS_MAP_ROWS, c->three[k], c->weights[2][k]);
  }
  mark(t, (uint32_t)c->byte[k], (uint32_t)c->mask[k]);
  add(a, t, sum, c->one[k], c->weights[0][k]);
  add(a, t, sum + CS_MAP_ROWS, c->two[k], c->weights[1][k]);
}

/* Adds the pieces of a border from the kth one on. varies: a constant of each caller. */
static inline __attribute__((always_inline)) void add_run(const cs_map_adding *a,
                                                          const cs_map_live *live, bool varies,
                                                          const piece *pieces, const changes *c,
                                                          size_t k, size_t end) {
  const target t = target_of(a, live, varies);
  for (; k < end; k++)
    add_piece(a, &t, pieces, c, k);
}

static __attribute__((noinline)) void add_varied(const cs_map_adding *a, const cs_map_live *live,
                                                 const piece *pieces, const changes *c, size_t k,
                                                 size_t end) {
  add_run(a, live, true, pieces, c, k, end);
}

static __attribute__((noinline)) void add_pieces(const cs_map_adding *a, batch *b) {
  const uint32_t stride = (uint32_t)(a->sums->words * sizeof *a->sums->bits);
  changes c;
  memset(b->pieces + b->count, 0, 7 * sizeof *b->pieces);
  for (size_t i = 0; i < b->count; i += 8)
    find_changes(stride, b->pieces, i, &c);
  for (size_t i = 0, first = 0; i < b->run_count; first = b->runs[i++].end) {
    const cs_map_live *live = b->runs[i].live;
    if (live->varies)
      add_varied(a, live, b->pieces, &c, first, b->runs[i].end);
    else
      add_run(a, live, false, b->pieces, &c, first, b->runs[i].end);
  }
  b->count = b->run_count = 0;
}

/* ---------------------------------------------------------------- cutting */

/* Adds the part of a piece that is in the frame, and returns the end of the pieces. Of the part
 * left of the frame only the height counts. */
static piece *put_clipped(piece p, int32_t side, piece *out) {
  const int32_t from = p.xa < p.xb ? p.xa : p.xb, to = p.xa < p.xb ? p.xb : p.xa;
  const double slope = to > from ? (double)(p.yb - p.ya) / ((double)to - from) : 0;
  if (from >= side)
    return out;
  if (to > side)
    p.yb = p.ya + (int32_t)(((double)side - from) * slope + 0.5);
  const int32_t left = to <= 0    ? p.yb - p.ya
                       : from < 0 ? (int32_t)(-(double)from * slope + 0.5)
                                  : 0;
  if (left > 0)
    *out++ = (piece){0, p.ya, 0, p.ya + left};
  if (p.ya + left < p.yb)
    *out++ = (piece){from > 0 ? from : 0, p.ya + left, to < side ? to : side, p.yb};
  return out;
}

static inline void put_piece(integers v, piece *out) { memcpy(out, &v, sizeof *out); }

/* Cuts the part of a line that is in the swath, four rows at a time. Returns the end of the pieces;
 * up to three more are overwritten. */
static inline piece *cut_line(int32_t top, const cs_map_point *at, piece *out) {
  const int32_t foot = top + CS_MAP_ROWS * CS_MAP_UNIT, end = at[1].y < foot ? at[1].y : foot;
  integers line;
  memcpy(&line, at, sizeof line);
  const doubles both = __builtin_convertvector(line, doubles);
  const doubles across = both - __builtin_shufflevector(both, both, 2, 3, 0, 1);
  const double slope = across[0] / across[1];
  const integers x = __builtin_shufflevector(line, line, 0, 0, 0, 0);
  const integers y = __builtin_shufflevector(line, line, 1, 1, 1, 1);
  integers high = __builtin_shufflevector(line, line, 0, 1, 0, 1), low, from;
  if (at->y < top)
    high = (integers){0, 0, at->x + (int32_t)((double)(top - at->y) * slope), top};
  integers feet =
      ((__builtin_shufflevector(high, high, 3, 3, 3, 3) >> UNIT_BITS) + (integers){1, 2, 3, 4})
      << UNIT_BITS;
  piece *const last = out + ((end - 1) >> UNIT_BITS) - ((at->y < top ? top : at->y) >> UNIT_BITS);
  for (; out <= last; out += 4) {
    /* beyond its end a flat line has no number for its place */
    const integers is_inside = feet < end, ys = (is_inside & feet) | (~is_inside & end);
    const integers xs =
        x + __builtin_convertvector(__builtin_convertvector(ys - y, doubles) * slope, integers);
    from = high;
    low = __builtin_shufflevector(xs, ys, 0, 4, 1, 5);
    high = __builtin_shufflevector(xs, ys, 2, 6, 3, 7);
    put_piece(__builtin_shufflevector(from, low, 2, 3, 4, 5), out);
    put_piece(low, out + 1);
    put_piece(__builtin_shufflevector(low, high, 2, 3, 4, 5), out + 2);
    put_piece(high, out + 3);
    feet += 4 * CS_MAP_UNIT;
  }
  last->xb = end == at[1].y ? at[1].x : last->xb;
  return last + 1;
}

/* The same, of a border that is left or right of the frame somewhere. */
static __attribute__((noinline)) piece *cut_clipped(const cs_map_adding *a, const cs_map_point *at,
                                                    piece *out) {
  piece pieces[CS_MAP_ROWS];
  const piece *end = cut_line(a->row * CS_MAP_UNIT, at, pieces);
  for (const piece *p = pieces; p < end; p++)
    out = put_clipped(*p, a->sums->width * CS_MAP_UNIT, out);
  return out;
}

/* ---------------------------------------------------------------- a border */

/* end: of its pieces, which are the last ones. */
static inline void end_run(batch *b, const cs_map_live *live, const piece *end) {
  const size_t before = b->count;
  b->count = (size_t)(end - b->pieces);
  b->runs[b->run_count].live = live;
  b->runs[b->run_count].end = b->count;
  b->run_count += b->count > before;
}

/* is_inside: it is nowhere left or right of the frame; a constant of each caller. The first line
 * ends in the swath or below it, and so no line is above it. */
static inline void add_border(const cs_map_adding *a, cs_map_live *live, bool is_inside, batch *b) {
  const cs_map_point *places = a->rows->places, *at = places + live->at;
  const cs_map_point *last = places + live->end - 1;
  const int32_t top = a->row * CS_MAP_UNIT, foot = top + CS_MAP_ROWS * CS_MAP_UNIT;
  piece *out = b->pieces + b->count;
  for (; at < last && at->y < foot; at++) {
    if (is_inside && (at[0].y ^ (at[1].y - 1)) >> UNIT_BITS == 0) {
      memcpy(out, at, sizeof *out);
      out += at[1].y > at[0].y;
    } else if (at[1].y > at[0].y) {
      out = is_inside ? cut_line(top, at, out) : cut_clipped(a, at, out);
    }
    if (out > b->pieces + PIECES - 2 * CS_MAP_ROWS) {
      end_run(b, live, out);
      add_pieces(a, b);
      out = b->pieces;
    }
    if (at[1].y > foot)
      break;
  }
  end_run(b, live, out);
  live->next = (uint32_t)(at - places);
}

void CS_WIDE(cs_map_add)(const cs_map_adding *adding) {
  cs_map_rows *rows = adding->rows;
  const int32_t end = adding->sums->width * CS_MAP_UNIT;
  batch b;
  b.count = b.run_count = 0;
  for (size_t i = 0; i < rows->live_count; i++) {
    cs_map_live *live = &rows->lives[i];
    if (live->low >= 0 && live->high < end)
      add_border(adding, live, true, &b);
    else
      add_border(adding, live, false, &b);
  }
  add_pieces(adding, &b);
}
