#include "model/stroke/dashes.h"

#include <math.h>

#define MANY 50 /* patterns of dashes on one piece */

/* ---------------------------------------------------------------- ruler */

void cs_ruler_init(cs_ruler *ruler, const cs_outline *line, const double *ends, double pattern) {
  ruler->line = line;
  ruler->ends = ends;
  ruler->pattern = pattern;
  ruler->marked = SIZE_MAX;
}

/* The piece at a length, among the pieces [begin, end). after: at a joint, the piece that begins
 * there. */
static size_t find(const cs_ruler *ruler, size_t begin, size_t end, double length, bool after) {
  while (begin + 1 < end) {
    size_t middle = begin + (end - begin) / 2;
    double joint = ruler->ends[middle - 1];
    if (after ? joint <= length : joint < length)
      begin = middle;
    else
      end = middle;
  }
  return begin;
}

/* Whether a piece has enough dashes to make marks on it worth while. */
static bool is_marked(cs_ruler *ruler, size_t piece, const cs_bezier *line, double whole) {
  if (ruler->marked == piece)
    return true;
  if (cs_curve_is_straight(line) || !(ruler->pattern > 0) || !(whole > MANY * ruler->pattern))
    return false;
  cs_curve_mark(line, ruler->marks);
  ruler->marked = piece;
  return true;
}

static double parameter_at(cs_ruler *ruler, size_t piece, double length) {
  cs_bezier line;
  double start = cs_ruler_begin(ruler, piece), whole = ruler->ends[piece] - start;
  if (!(length > start))
    return 0;
  if (!(length < ruler->ends[piece]))
    return 1;
  cs_curve_load_line(ruler->line, piece, 0, 1, &line);
  return is_marked(ruler, piece, &line, whole)
             ? cs_curve_marked_parameter(&line, ruler->marks, length - start)
             : cs_curve_parameter(&line, whole, length - start);
}

cs_stroke_part cs_ruler_part(cs_ruler *ruler, size_t contour, double from, double to) {
  size_t begin, end;
  cs_stroke_contour(ruler->line, contour, &begin, &end);
  size_t last = find(ruler, begin, end, to, false);
  size_t first = from < to ? find(ruler, begin, end, from, true) : last;
  if (first > last) /* at a joint, both may differ by rounding */
    first = last;
  return (cs_stroke_part){.contour = (uint32_t)contour,
                          .first = (uint32_t)first,
                          .count = (uint32_t)(last - first + 1),
                          .begin = parameter_at(ruler, first, from),
                          .end = parameter_at(ruler, last, to)};
}

/* ---------------------------------------------------------------- making */

celspan_status cs_dashes_set(celspan_context *context, cs_dashes *dashes,
                             const celspan_stroke_desc *desc) {
  size_t count = desc->dash_count % 2 == 1 ? 2 * desc->dash_count : desc->dash_count;
  CS_TRY(CS_ARRAY_MAKE(context, dashes->places, count));
  dashes->place_count = count;
  dashes->pattern = 0;
  for (size_t i = 0; i < count; i++) {
    dashes->places[i] = dashes->pattern;
    dashes->pattern += desc->dashes[i % desc->dash_count];
  }
  dashes->offset = fmod(desc->dash_offset, dashes->pattern);
  dashes->offset += dashes->offset < 0 ? dashes->pattern : 0;
  return CELSPAN_OK;
}

cs_stroke_part cs_dashes_whole(const cs_outline *line, const cs_dashes_run *run) {
  size_t begin, end;
  cs_stroke_contour(line, run->contour, &begin, &end);
  return (cs_stroke_part){.contour = run->contour,
                          .first = (uint32_t)begin,
                          .count = (uint32_t)(end - begin),
                          .end = run->is_dot ? 0 : 1,
                          .is_closed = run->is_closed};
}

celspan_status cs_dashes_append(celspan_context *context, cs_stroke *stroke, cs_dashes_run run,
                                size_t parts) {
  cs_dashes *dashes = &stroke->dashes;
  run.begin = stroke->part_count;
  CS_TRY(CS_ARRAY_APPEND(context, dashes->runs, dashes->run_count, run));
  stroke->part_count += parts;
  return CELSPAN_OK;
}

/* The lengths of the line between which a dash of a run is drawn. Returns whether the dash is
 * drawn: a dash of no length is a dot. */
static bool find_dash(const cs_dashes *dashes, const cs_dashes_run *run, size_t number,
                      double *from, double *to) {
  size_t each = dashes->place_count / 2;
  const double *place = dashes->places + 2 * (number % each);
  double turn = run->start + (double)(number / each) * dashes->pattern;
  double begin = turn + place[0], end = turn + place[1];
  bool is_dot = begin == end && begin >= run->from && begin <= run->to;
  *from = fmax(begin, run->from);
  *to = fmin(end, run->to);
  return is_dot || *from < *to;
}

static cs_stroke_part read_dash(cs_ruler *ruler, const cs_dashes *dashes, const cs_dashes_run *run,
                                size_t number) {
  double from, to;
  (void)find_dash(dashes, run, number, &from, &to);
  return cs_ruler_part(ruler, run->contour, from, to);
}

static bool is_dot(const cs_stroke_part *part) { return part->begin == part->end; }

/* Whether the last of several dashes of a closed contour continues in the first dash, or the only
 * dash in itself. */
static bool meet(const cs_outline *line, const cs_stroke_part *first, const cs_stroke_part *last,
                 size_t count) {
  size_t begin, end;
  cs_stroke_contour(line, first->contour, &begin, &end);
  return first->first == begin && first->begin == 0 && last->first + last->count == end &&
         last->end == 1 && (count == 1 || !(is_dot(first) || is_dot(last)));
}

/* Finds the first dash of a run that is drawn, and the number of drawn dashes. */
static size_t count_dashes(const cs_dashes *dashes, cs_dashes_run *run) {
  size_t each = dashes->place_count / 2;
  size_t first = each * (size_t)floor((run->from - run->start) / dashes->pattern);
  size_t end = each * ((size_t)floor((run->to - run->start) / dashes->pattern) + 2);
  double from, to;
  while (first < end && !find_dash(dashes, run, first, &from, &to))
    first++;
  while (first < end && !find_dash(dashes, run, end - 1, &from, &to))
    end--;
  run->first = first;
  return end - first;
}

celspan_status cs_dashes_add(celspan_context *context, cs_stroke *stroke, size_t contour,
                             double from, double to, bool is_round) {
  const cs_dashes *dashes = &stroke->dashes;
  size_t begin, end;
  cs_ruler ruler;
  cs_ruler_init(&ruler, &stroke->line, dashes->ends, dashes->pattern);
  cs_stroke_contour(&stroke->line, contour, &begin, &end);
  cs_dashes_run run = {.contour = (uint32_t)contour,
                       .start = cs_ruler_begin(&ruler, begin) - dashes->offset,
                       .from = from,
                       .to = to};
  size_t count = count_dashes(dashes, &run);
  if (count == 0)
    return CELSPAN_OK;
  if (is_round) {
    cs_stroke_part first = read_dash(&ruler, dashes, &run, run.first);
    cs_stroke_part last = read_dash(&ruler, dashes, &run, run.first + count - 1);
    bool do_meet = meet(&stroke->line, &first, &last, count);
    run.is_closed = do_meet && count == 1;
    run.is_joined = do_meet && count > 1;
  }
  return cs_dashes_append(context, stroke, run, count - run.is_joined);
}

/* ---------------------------------------------------------------- reading */

void cs_parts_init(cs_parts *parts, const cs_stroke *stroke) {
  parts->stroke = stroke;
  parts->run = 0;
  cs_ruler_init(&parts->ruler, &stroke->line, stroke->dashes.ends, stroke->dashes.pattern);
}

static size_t run_end(const cs_stroke *stroke, size_t run) {
  return run + 1 < stroke->dashes.run_count ? stroke->dashes.runs[run + 1].begin
                                            : stroke->part_count;
}

/* The run of a part: most often the run of the previous part. */
static size_t find_run(const cs_parts *parts, size_t index) {
  const cs_dashes *dashes = &parts->stroke->dashes;
  size_t low = 0, high = dashes->run_count;
  if (dashes->runs[parts->run].begin <= index && index < run_end(parts->stroke, parts->run))
    return parts->run;
  while (low + 1 < high) {
    size_t middle = low + (high - low) / 2;
    if (dashes->runs[middle].begin <= index)
      low = middle;
    else
      high = middle;
  }
  return low;
}

cs_stroke_part cs_parts_get(cs_parts *parts, size_t index) {
  const cs_stroke *stroke = parts->stroke;
  const cs_dashes *dashes = &stroke->dashes;
  if (dashes->place_count == 0)
    return stroke->parts[index];
  parts->run = find_run(parts, index);
  const cs_dashes_run *run = &dashes->runs[parts->run];
  if (run->is_whole)
    return cs_dashes_whole(&stroke->line, run);
  cs_stroke_part part = read_dash(&parts->ruler, dashes, run, run->first + (index - run->begin));
  part.is_closed = run->is_closed;
  if (run->is_joined && index == run->begin) {
    size_t last = run->first + (run_end(stroke, parts->run) - run->begin);
    cs_stroke_part tail = read_dash(&parts->ruler, dashes, run, last);
    part.first = tail.first;
    part.begin = tail.begin;
    part.count += tail.count;
  }
  return part;
}
