#include "engine/map/exact.h"

#include "base/sort.h"
#include "model/geometry/cover.h"

void cs_map_exact_finish(cs_map_exact *exact, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, exact, lines, order);
  *exact = (cs_map_exact){0};
}

/* ---------------------------------------------------------------- lines */

static celspan_status append(celspan_context *context, cs_map_exact *exact,
                             const cs_map_line *line) {
  return CS_ARRAY_APPEND(context, exact->lines, exact->line_count, *line);
}

static celspan_status add_piece(celspan_context *context, cs_map_exact *exact,
                                const cs_map_line *line, double ya, double yb) {
  cs_map_line piece = *line;
  const cs_segment *at = &line->at;
  piece.at.xa = ya > at->ya ? cs_segment_x(at, ya) : at->xa;
  piece.at.xb = yb < at->yb ? cs_segment_x(at, yb) : at->xb;
  piece.at.ya = ya;
  piece.at.yb = yb;
  double middle = 0.5 * (piece.at.xa + piece.at.xb);
  if (!(yb > ya) || middle >= 1)
    return CELSPAN_OK;
  if (middle <= 0)
    piece.at.xa = piece.at.xb = 0;
  return append(context, exact, &piece);
}

/* Cuts a line where it enters or leaves the pixel sideways. The part right of the pixel is left
 * out; the part left of it is moved to its left edge. */
static celspan_status add_line(celspan_context *context, cs_map_exact *exact,
                               const cs_map_line *line) {
  const cs_segment *at = &line->at;
  double cuts[4] = {at->ya, at->yb, at->yb, at->yb}, across = at->xb - at->xa;
  if (at->xa > 0 && at->xb > 0 && at->xa < 1 && at->xb < 1)
    return append(context, exact, line);
  for (int side = 0; side < 2 && across != 0; side++) {
    double y = at->ya + (at->yb - at->ya) * ((side - at->xa) / across);
    if (y > at->ya && y < at->yb)
      cuts[1 + side] = y;
  }
  if (cuts[1] > cuts[2]) {
    double y = cuts[1];
    cuts[1] = cuts[2];
    cuts[2] = y;
  }
  for (int k = 0; k < 3; k++)
    CS_TRY(add_piece(context, exact, line, cuts[k], cuts[k + 1]));
  return CELSPAN_OK;
}

/* The pixel whose lines are searched for, and the columns [from, column] in which these count. */
typedef struct spot {
  int32_t from, column, row;
  int32_t left, right, top, foot; /* in places */
} spot;

/* Sets a line to the line between two places, cut to the row and relative to the pixel's corner.
 * False: the line does not count. */
static bool cut_to_row(cs_segment *line, cs_map_point above, cs_map_point below, const spot *at) {
  const double unit = 1.0 / CS_MAP_UNIT;
  if (below.y <= at->top || below.y == above.y || (above.x < at->left && below.x < at->left) ||
      (above.x >= at->right && below.x >= at->right))
    return false;
  const cs_segment whole = {above.x * unit, above.y * unit, below.x * unit, below.y * unit};
  double top = whole.ya > at->row ? whole.ya : at->row;
  double foot = whole.yb < at->row + 1 ? whole.yb : at->row + 1;
  double xa = top > whole.ya ? cs_segment_x(&whole, top) : whole.xa;
  double xb = foot < whole.yb ? cs_segment_x(&whole, foot) : whole.xb;
  line->xa = xa - at->column;
  line->xb = xb - at->column;
  line->ya = top - at->row;
  line->yb = foot - at->row;
  return !(at->from > 0 && xa < at->from && xb < at->from) && !(line->xa >= 1 && line->xb >= 1);
}

/* By how much colour and light change at a border. */
static celspan_status find_step(cs_map_exact *exact, const cs_map_rows *rows,
                                const cs_map_live *live, const spot *at, cs_map_line *line) {
  const cs_map_drawing *drawing = rows->drawing;
  const cs_map_border *f = &drawing->lines->borders[live->border];
  cs_v4 left, right;
  CS_TRY(cs_map_brush_colour(rows->brush, drawing, f->left, at->column, at->row, &left));
  CS_TRY(cs_map_brush_colour(rows->brush, drawing, f->right, at->column, at->row, &right));
  line->step = right - left;
  line->through = cs_v4_all(-line->step[3]);
  if (drawing->through) {
    line->through =
        cs_map_through(drawing, f->right, right) - cs_map_through(drawing, f->left, left);
    exact->is_coloured = true;
  }
  return CELSPAN_OK;
}

/* Adds the lines of a border that count. */
static celspan_status add_border(celspan_context *context, cs_map_exact *exact,
                                 const cs_map_rows *rows, uint32_t index, const cs_map_live *live,
                                 const spot *at) {
  const cs_map_point *places = rows->places;
  cs_map_line line = {.sheet = index};
  bool has_step = false;
  for (uint32_t k = live->at; k + 1 < live->end && places[k].y < at->foot; k++) {
    if (!cut_to_row(&line.at, places[k], places[k + 1], at))
      continue;
    if (!has_step)
      CS_TRY(find_step(exact, rows, live, at, &line));
    has_step = true;
    CS_TRY(add_line(context, exact, &line));
  }
  return CELSPAN_OK;
}

celspan_status cs_map_exact_add(celspan_context *context, cs_map_exact *exact, cs_map_rows *rows,
                                uint32_t index, int32_t from, int32_t column, int32_t row) {
  const spot at = {.from = from,
                   .column = column,
                   .row = row,
                   .left = from > 0 ? from * CS_MAP_UNIT : INT32_MIN,
                   .right = (column + 1) * CS_MAP_UNIT,
                   .top = row * CS_MAP_UNIT,
                   .foot = (row + 1) * CS_MAP_UNIT};
  CS_TRY(cs_map_near_find(context, rows));
  for (size_t word = 0; word < rows->near_words; word++)
    for (uint64_t bits = cs_map_near_word(rows, word, from, column); bits; bits &= bits - 1) {
      const cs_map_live *live = &rows->lives[64 * word + (size_t)__builtin_ctzll(bits)];
      bool is_near = live->low < at.right && live->high >= at.left && live->foot > at.top;
      if (is_near && rows->places[live->at].y < at.foot)
        CS_TRY(add_border(context, exact, rows, index, live, &at));
    }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- two drawings */

/* The area of a pixel right of a line. */
static double area_of(const cs_segment *line) {
  return (line->yb - line->ya) * cs_cover_within(line->xa, line->xb, 1);
}

/* The area of the pixel that lies right of both lines. */
static double overlap_of(const cs_segment *k, const cs_segment *l) {
  double top = k->ya > l->ya ? k->ya : l->ya, foot = k->yb < l->yb ? k->yb : l->yb;
  double height = foot - top;
  if (!(height > 0))
    return 0;
  double ka = cs_segment_x(k, top), kb = cs_segment_x(k, foot);
  double la = cs_segment_x(l, top), lb = cs_segment_x(l, foot);
  double above = ka - la, below = kb - lb;
  double a = above > 0 ? ka : la, b = below > 0 ? kb : lb; /* the ends on the right */
  if ((above >= 0) == (below >= 0))
    return height * cs_cover_within(a, b, 1);
  double part = above / (above - below), x = ka + part * (kb - ka); /* where they cross */
  return height * cs_cover_within(part * (a + x), (1 - part) * (x + b), 1);
}

/* How the transmission of the near drawing and the light and transmission of the far one change
 * together. */
typedef struct change {
  cs_v4 colour, through;
} change;

/* For drawings that dim all channels alike: each of their lines needs one product. */
static change even_change(const cs_map_exact *exact, uint32_t near) {
  cs_v4d sum = {{0, 0}, {0, 0}};
  for (size_t i = 0; i < exact->line_count; i++) {
    const cs_map_line *k = &exact->lines[i];
    if (k->sheet != near || k->step[3] == 0)
      continue;
    double area = area_of(&k->at);
    for (size_t j = 0; j < exact->line_count; j++) {
      const cs_map_line *l = &exact->lines[j];
      double both = l->sheet != near ? overlap_of(&k->at, &l->at) - area * area_of(&l->at) : 0;
      sum = cs_v4d_add(sum, cs_v4d_scale(both * (double)k->step[3], cs_v4_wide(l->step)));
    }
  }
  const cs_v4 all = cs_v4_narrow(sum);
  return (change){-all, cs_v4_all(all[3])};
}

/* For all other drawings. */
static change coloured_change(const cs_map_exact *exact, uint32_t near) {
  cs_v4d colour = {{0, 0}, {0, 0}}, through = colour;
  for (size_t i = 0; i < exact->line_count; i++) {
    const cs_map_line *k = &exact->lines[i];
    double area = area_of(&k->at);
    for (size_t j = 0; k->sheet == near && j < exact->line_count; j++) {
      const cs_map_line *l = &exact->lines[j];
      if (l->sheet == near)
        continue;
      double both = overlap_of(&k->at, &l->at) - area * area_of(&l->at);
      colour = cs_v4d_add(colour, cs_v4d_scale(both, cs_v4_wide(k->through * l->step)));
      through = cs_v4d_add(through, cs_v4d_scale(both, cs_v4_wide(k->through * l->through)));
    }
  }
  return (change){cs_v4_narrow(colour), cs_v4_narrow(through)};
}

cs_v4 cs_map_exact_pair(cs_map_exact *exact, const cs_map_frame *frame, const cs_map_shown *shown,
                        size_t count) {
  uint32_t near = UINT32_MAX, far = 0;
  for (size_t i = 0; i < exact->line_count; i++) {
    near = exact->lines[i].sheet < near ? exact->lines[i].sheet : near;
    far = exact->lines[i].sheet > far ? exact->lines[i].sheet : far;
  }
  const change joint = exact->is_coloured ? coloured_change(exact, near) : even_change(exact, near);
  cs_map_exact_clear(exact);
  cs_map_fold all = cs_map_fold_begin, behind = cs_map_fold_begin;
  cs_v4 before = cs_v4_all(1); /* the transmission of the other drawings in front of the far one */
  for (size_t i = 0; i < count; i++) {
    const cs_map_shown *s = &shown[i];
    cs_map_fold_add(&all, s->sheet, s->colour, s->through);
    before *= i < far && i != near ? s->through : cs_v4_all(1);
    if (i == far)
      behind.e = s->sheet->back;
    else if (i > far)
      cs_map_fold_add(&behind, s->sheet, s->colour, s->through);
  }
  cs_v4 hidden = behind.e + behind.t * frame->back;
  cs_v4 colour = cs_map_fold_end(all, frame) + before * (joint.colour + joint.through * hidden);
  cs_v4 through = all.t + before * behind.t * joint.through;
  colour[3] = 1 - all.keep * frame->keep * cs_over_mean(through);
  return colour;
}

/* ---------------------------------------------------------------- heights */

static inline bool is_higher(const double *a, const double *b) { return *a < *b; }

CS_SORT_DEFINE(sort_heights, double, is_higher)

/* The height at which two lines cross; the top of one of them if they do not cross. */
static double crossing_of(const cs_segment *a, const cs_segment *b) {
  double top = a->ya > b->ya ? a->ya : b->ya, foot = a->yb < b->yb ? a->yb : b->yb;
  if (!(foot > top))
    return a->ya;
  double above = cs_segment_x(a, top) - cs_segment_x(b, top);
  double below = cs_segment_x(a, foot) - cs_segment_x(b, foot);
  if (!((above < 0 && below > 0) || (above > 0 && below < 0)))
    return a->ya;
  return top + (foot - top) * (above / (above - below));
}

/* Finds the heights between which the order of the lines does not change. There is room for
 * them. */
static void find_heights(cs_map_exact *exact) {
  double *heights = exact->heights;
  size_t count = 0;
  heights[count++] = 0;
  heights[count++] = 1;
  for (size_t i = 0; i < exact->line_count; i++) {
    const cs_map_line *a = &exact->lines[i];
    heights[count++] = a->at.ya;
    heights[count++] = a->at.yb;
    for (size_t j = 0; j < i; j++)
      if (exact->lines[j].sheet != a->sheet)
        heights[count++] = crossing_of(&a->at, &exact->lines[j].at);
  }
  sort_heights(heights, count);
  exact->height_count = count;
}

static void space_heights(cs_map_exact *exact) {
  for (size_t i = 0; i <= CS_MAP_EXACT_LINES; i++)
    exact->heights[i] = (double)i / CS_MAP_EXACT_LINES;
  exact->height_count = CS_MAP_EXACT_LINES + 1;
}

/* ---------------------------------------------------------------- the mean */

/* Lists the lines at a height from left to right. */
static size_t list_lines(cs_map_exact *exact, double y) {
  size_t count = 0;
  for (size_t i = 0; i < exact->line_count; i++) {
    cs_map_line *line = &exact->lines[i];
    if (line->at.ya > y || line->at.yb <= y)
      continue;
    double x = cs_segment_x(&line->at, y);
    size_t place = count++;
    for (; place > 0 && cs_segment_x(&exact->order[place - 1]->at, y) > x; place--)
      exact->order[place] = exact->order[place - 1];
    exact->order[place] = line;
  }
  return count;
}

static cs_v4 fold(const cs_map_frame *frame, const cs_map_shown *shown, size_t count) {
  cs_map_fold all = cs_map_fold_begin;
  for (size_t i = 0; i < count; i++)
    cs_map_fold_add(&all, shown[i].sheet, shown[i].colour, shown[i].through);
  return cs_map_fold_end(all, frame);
}

/* The colour of a drawing right of a line. */
static void cross(cs_map_shown *shown, const cs_map_line *line) {
  shown->colour += line->step;
  shown->through =
      shown->sheet->drawing.through ? shown->through + line->through : cs_map_even(shown->colour);
}

/* The mean colour along a height. */
static cs_v4d mean_at(cs_map_exact *exact, const cs_map_frame *frame, const cs_map_shown *at_left,
                      size_t count, double y) {
  cs_map_shown shown[CS_MAP_DRAWINGS];
  cs_v4d mean = {{0, 0}, {0, 0}};
  size_t lines = list_lines(exact, y);
  double x = 0;
  for (size_t i = 0; i < count; i++)
    shown[i] = at_left[i];
  for (size_t k = 0; k <= lines; k++) {
    double next = k < lines ? cs_segment_x(&exact->order[k]->at, y) : 1;
    next = next < 1 ? next : 1;
    if (next > x) {
      cs_v4 colour = fold(frame, shown, count);
      mean = cs_v4d_add(mean, cs_v4d_scale(next - x, cs_v4_wide(colour)));
      x = next;
    }
    if (k < lines)
      cross(&shown[exact->order[k]->sheet], exact->order[k]);
  }
  return mean;
}

celspan_status cs_map_exact_mean(celspan_context *context, cs_map_exact *exact,
                                 const cs_map_frame *frame, const cs_map_shown *shown, size_t count,
                                 cs_v4 *out) {
  cs_v4d mean = {{0, 0}, {0, 0}};
  size_t lines = exact->line_count;
  size_t most = lines > CS_MAP_EXACT_LINES ? CS_MAP_EXACT_LINES + 1 : lines * (lines + 3) / 2 + 2;
  CS_TRY(CS_ARRAY_RESERVE(context, exact->heights, most));
  CS_TRY(CS_ARRAY_RESERVE(context, exact->order, lines + 1));
  if (lines > CS_MAP_EXACT_LINES)
    space_heights(exact);
  else
    find_heights(exact);
  for (size_t i = 0; i + 1 < exact->height_count; i++) {
    double top = exact->heights[i], height = exact->heights[i + 1] - top;
    if (height > 0)
      mean = cs_v4d_add(
          mean, cs_v4d_scale(height, mean_at(exact, frame, shown, count, top + 0.5 * height)));
  }
  cs_map_exact_clear(exact);
  *out = cs_v4_narrow(mean);
  return CELSPAN_OK;
}
