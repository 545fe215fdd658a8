#include "engine/map/exact.h"

#include "base/sort.h"

void cs_map_exact_finish(cs_map_exact *exact, cs_memory *memory) {
  cs_mem_free(memory, exact->lines, exact->line_capacity * sizeof *exact->lines);
  cs_mem_free(memory, exact->heights, exact->height_capacity * sizeof *exact->heights);
  cs_mem_free(memory, exact->order, exact->order_capacity * sizeof *exact->order);
  *exact = (cs_map_exact){0};
}

/* ---------------------------------------------------------------- lines */

static inline double x_at(const cs_map_line *line, double y) {
  double height = line->yb - line->ya;
  return line->xa + (line->xb - line->xa) * ((y - line->ya) / height);
}

static celspan_status add_piece(celspan_context *context, cs_map_exact *exact, cs_map_line line,
                                double ya, double yb) {
  cs_map_line piece = line;
  piece.xa = ya > line.ya ? x_at(&line, ya) : line.xa;
  piece.xb = yb < line.yb ? x_at(&line, yb) : line.xb;
  piece.ya = ya;
  piece.yb = yb;
  double middle = 0.5 * (piece.xa + piece.xb);
  if (!(yb > ya) || middle >= 1)
    return CELSPAN_OK;
  if (middle <= 0)
    piece.xa = piece.xb = 0;
  return CS_APPEND(context, exact->lines, exact->line_count, exact->line_capacity, piece);
}

/* Cuts a line where it enters or leaves the pixel sideways. What is right of the pixel is left out;
 * what is left of it is moved to its left edge. */
static celspan_status add_line(celspan_context *context, cs_map_exact *exact, cs_map_line line) {
  double cuts[4] = {line.ya, line.yb, line.yb, line.yb}, across = line.xb - line.xa;
  for (int side = 0; side < 2 && across != 0; side++) {
    double y = line.ya + (line.yb - line.ya) * ((side - line.xa) / across);
    if (y > line.ya && y < line.yb)
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

/* The part of a line of the frame that is in the row. */
static celspan_status add_part(celspan_context *context, cs_map_exact *exact, cs_map_line line,
                               int32_t from, int32_t column, int32_t row) {
  double top = line.ya > row ? line.ya : row, foot = line.yb < row + 1 ? line.yb : row + 1;
  if (!(foot > top))
    return CELSPAN_OK;
  double xa = x_at(&line, top), xb = x_at(&line, foot);
  if ((from > 0 && xa < from && xb < from) || (xa >= column + 1 && xb >= column + 1))
    return CELSPAN_OK;
  line.xa = xa - column;
  line.xb = xb - column;
  line.ya = top - row;
  line.yb = foot - row;
  return add_line(context, exact, line);
}

static celspan_status add_border(celspan_context *context, cs_map_exact *exact,
                                 const cs_map_rows *rows, const cs_map_live *live, cs_map_line line,
                                 const int32_t pixel[3]) {
  const cs_map_drawing *drawing = rows->drawing;
  const cs_map_border *f = &drawing->lines->borders[live->border];
  const double unit = 1.0 / CS_MAP_UNIT;
  int32_t top = pixel[2] * CS_MAP_UNIT, foot = top + CS_MAP_UNIT;
  cs_v4 left, right;
  CS_TRY(cs_map_brush_colour(rows->brush, drawing, f->left, pixel[1], pixel[2], &left));
  CS_TRY(cs_map_brush_colour(rows->brush, drawing, f->right, pixel[1], pixel[2], &right));
  line.step = right - left;
  line.through = cs_v4_all(-line.step[3]);
  if (drawing->through) {
    line.through = drawing->through[f->right] - drawing->through[f->left];
    exact->is_coloured = true;
  }
  for (uint32_t k = live->at; k + 1 < live->end && rows->places[k].y < foot; k++) {
    const cs_map_point above = rows->places[k], below = rows->places[k + 1];
    line.xa = above.x * unit;
    line.ya = above.y * unit;
    line.xb = below.x * unit;
    line.yb = below.y * unit;
    if (below.y > top && below.y > above.y)
      CS_TRY(add_part(context, exact, line, pixel[0], pixel[1], pixel[2]));
  }
  return CELSPAN_OK;
}

celspan_status cs_map_exact_add(celspan_context *context, cs_map_exact *exact,
                                const cs_map_rows *rows, uint32_t index, int32_t from,
                                int32_t column, int32_t row) {
  const int32_t pixel[3] = {from, column, row};
  int32_t top = row * CS_MAP_UNIT, right = (column + 1) * CS_MAP_UNIT;
  int32_t left = from > 0 ? from * CS_MAP_UNIT : INT32_MIN;
  for (size_t i = 0; i < rows->live_count; i++) {
    const cs_map_live *live = &rows->lives[i];
    /* All at once: each by itself is as often true as not, which a processor could not predict. */
    bool is_near = (live->low < right) & (live->high >= left) & (live->foot > top);
    if (is_near && rows->places[live->at].y < top + CS_MAP_UNIT)
      CS_TRY(add_border(context, exact, rows, live, (cs_map_line){.sheet = index}, pixel));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- two drawings */

/* What a pixel has right of a line. */
static double area_of(const cs_map_line *line) {
  return (line->yb - line->ya) * (1 - 0.5 * (line->xa + line->xb));
}

/* What it has right of both of two lines. */
static double overlap_of(const cs_map_line *k, const cs_map_line *l) {
  double top = k->ya > l->ya ? k->ya : l->ya, foot = k->yb < l->yb ? k->yb : l->yb;
  double height = foot - top;
  if (!(height > 0))
    return 0;
  double ka = x_at(k, top), kb = x_at(k, foot), la = x_at(l, top), lb = x_at(l, foot);
  double above = ka - la, below = kb - lb;
  double a = above > 0 ? ka : la, b = below > 0 ? kb : lb; /* the ends on the right */
  if ((above >= 0) == (below >= 0))
    return height * (1 - 0.5 * (a + b));
  double part = above / (above - below), x = ka + part * (kb - ka); /* where they cross */
  return height * (1 - 0.5 * (part * (a + x) + (1 - part) * (x + b)));
}

/* How what the near drawing lets through and what the far one shows and lets through change
 * together. */
typedef struct change {
  cs_v4 colour, through;
} change;

/* Of drawings that dim all channels alike, whose lines need one product each. */
static change even_change(const cs_map_exact *exact, uint32_t near) {
  cs_v4d sum = {{0, 0}, {0, 0}};
  for (size_t i = 0; i < exact->line_count; i++) {
    const cs_map_line *k = &exact->lines[i];
    if (k->sheet != near || k->step[3] == 0)
      continue;
    double area = area_of(k);
    for (size_t j = 0; j < exact->line_count; j++) {
      const cs_map_line *l = &exact->lines[j];
      double both = l->sheet != near ? overlap_of(k, l) - area * area_of(l) : 0;
      sum = cs_v4d_add(sum, cs_v4d_scale(both * (double)k->step[3], cs_v4_wide(l->step)));
    }
  }
  const cs_v4 all = cs_v4_narrow(sum);
  return (change){-all, cs_v4_all(all[3])};
}

/* Of any drawings. */
static change coloured_change(const cs_map_exact *exact, uint32_t near) {
  cs_v4d colour = {{0, 0}, {0, 0}}, through = colour;
  for (size_t i = 0; i < exact->line_count; i++) {
    const cs_map_line *k = &exact->lines[i];
    double area = area_of(k);
    for (size_t j = 0; k->sheet == near && j < exact->line_count; j++) {
      const cs_map_line *l = &exact->lines[j];
      if (l->sheet == near)
        continue;
      double both = overlap_of(k, l) - area * area_of(l);
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
  cs_v4 before = cs_v4_all(1); /* what comes through the others in front of the far one */
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

/* The height at which two lines cross; one of them at its top where they do not. */
static double crossing_of(const cs_map_line *a, const cs_map_line *b) {
  double top = a->ya > b->ya ? a->ya : b->ya, foot = a->yb < b->yb ? a->yb : b->yb;
  if (!(foot > top))
    return a->ya;
  double above = x_at(a, top) - x_at(b, top), below = x_at(a, foot) - x_at(b, foot);
  if (!((above < 0 && below > 0) || (above > 0 && below < 0)))
    return a->ya;
  return top + (foot - top) * (above / (above - below));
}

/* Finds the heights between which the lines keep their order. There is room. */
static void find_heights(cs_map_exact *exact) {
  double *heights = exact->heights;
  size_t count = 0;
  heights[count++] = 0;
  heights[count++] = 1;
  for (size_t i = 0; i < exact->line_count; i++) {
    const cs_map_line *a = &exact->lines[i];
    heights[count++] = a->ya;
    heights[count++] = a->yb;
    for (size_t j = 0; j < i; j++)
      if (exact->lines[j].sheet != a->sheet)
        heights[count++] = crossing_of(a, &exact->lines[j]);
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
    if (line->ya > y || line->yb <= y)
      continue;
    double x = x_at(line, y);
    size_t place = count++;
    for (; place > 0 && x_at(exact->order[place - 1], y) > x; place--)
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

/* What a drawing shows right of a line. */
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
    double next = k < lines ? x_at(exact->order[k], y) : 1;
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
  CS_TRY(CS_RESERVE(context, exact->heights, exact->height_capacity, most));
  CS_TRY(CS_RESERVE(context, exact->order, exact->order_capacity, lines + 1));
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
