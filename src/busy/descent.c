#include "busy/descent.h"

#include "area/edges.h"

/* A row this far below the last one is found from nothing. */
#define FAR_ROWS 16

void cs_descent_init(cs_descent *descent, const cs_boundary_set *set) {
  *descent = (cs_descent){.set = set, .row = CS_DESCENT_NONE};
}

void cs_descent_finish(cs_descent *descent, cs_memory *memory) {
  cs_mem_free(memory, descent->followed, descent->capacity * sizeof *descent->followed);
  cs_mem_free(memory, descent->units.units, descent->units.capacity * sizeof *descent->units.units);
  cs_mem_free(memory, descent->units.points,
              descent->units.point_capacity * sizeof *descent->units.points);
  *descent = (cs_descent){0};
}

/* ---------------------------------------------------------------- chords */

static void begin_piece(const cs_descent *descent, cs_followed *f, uint32_t piece) {
  const cs_boundary_piece *p = &descent->set->pieces[piece];
  f->piece = piece;
  f->chords = cs_chords_count(p);
  f->first = f->at = 0;
  f->count = cs_chords_make(descent->set, p, f->chords, 0, &f->made);
}

/* Goes to chord `at`; false where the batch ends before it. */
static inline bool take_chord(cs_followed *f) {
  if (f->at == f->count)
    return false;
  const cs_chords *made = &f->made;
  f->x0 = made->x[f->at];
  f->y0 = made->y[f->at];
  f->x1 = made->x[f->at + 1];
  f->y1 = made->y[f->at + 1];
  f->slope = made->slope[f->at];
  return true;
}

/* The next vertices of the piece, or those of the next piece; false at the end of the chain. */
static bool make_more(const cs_descent *descent, cs_followed *f) {
  f->first += f->count;
  f->at = 0;
  if (f->first < f->chords) {
    const cs_boundary_piece *p = &descent->set->pieces[f->piece];
    f->count = cs_chords_make(descent->set, p, f->chords, f->first, &f->made);
    return true;
  }
  if (f->piece + 1 == f->chain->piece + f->chain->piece_count)
    return false;
  begin_piece(descent, f, f->piece + 1);
  return true;
}

/* Goes to the next chord that has a height; false at the end of the chain. */
static inline bool next_chord(const cs_descent *descent, cs_followed *f) {
  f->at++;
  do {
    while (take_chord(f)) {
      if (f->y1 > f->y0)
        return true;
      f->at++;
    }
  } while (make_more(descent, f));
  return false;
}

/* x on the chord: a function of the chord and the height alone. */
static inline double x_at(const cs_followed *f, double y) {
  return y == f->y1 ? f->x1 : f->x0 + (y - f->y0) * f->slope;
}

/* Begins a chain at the height `top`, or at its own top below it; it ends below `top`. */
static void begin_chain(const cs_descent *descent, const cs_boundary_chain *chain, double top,
                        cs_followed *f) {
  uint32_t piece = chain->piece;
  while (descent->set->pieces[piece].y1 <= top)
    piece++;
  f->chain = chain;
  begin_piece(descent, f, piece);
  bool has_chord = take_chord(f) && f->y1 > f->y0 ? true : next_chord(descent, f);
  while (has_chord && f->y1 <= top)
    has_chord = next_chord(descent, f);
  f->y = f->y0 > top ? f->y0 : top;
  f->x = f->y0 > top ? f->x0 : x_at(f, top);
}

/* ---------------------------------------------------------------- units */

/* A unit under construction. */
typedef struct builder {
  celspan_point *point; /* the last one */
  double low, high;
  double twice; /* the area left of it, times 2 */
} builder;

static inline void put_point(builder *b, double x, double y) {
  b->twice += (b->point->x + x) * (y - b->point->y);
  b->point++;
  *b->point = (celspan_point){x, y};
  b->low = x < b->low ? x : b->low;
  b->high = x > b->high ? x : b->high;
}

/* Room for a unit, and for so many points as one batch of chords may add to it. */
static inline celspan_status reserve(celspan_context *context, cs_units *units, size_t points) {
  CS_TRY(cs_mem_reserve(context, (void **)&units->units, &units->capacity, units->count + 1,
                        sizeof *units->units));
  return cs_mem_reserve(context, (void **)&units->points, &units->point_capacity,
                        units->point_count + points + CS_CHORDS_BATCH + 2, sizeof *units->points);
}

/* The vertices above the foot of the row; *ends: the chain ends there or above. */
static celspan_status put_vertices(celspan_context *context, cs_descent *descent, cs_followed *f,
                                   double top, builder *b, bool *ends) {
  celspan_point *start = descent->units.points + descent->units.point_count;
  const double foot = top + 1;
  while (f->y1 < foot) {
    put_point(b, f->x1, cs_edges_round(f->y1 - top));
    if (f->at + 1 == f->count) { /* more may come than there is room for */
      size_t count = (size_t)(b->point - start);
      CS_TRY(reserve(context, &descent->units, count));
      start = descent->units.points + descent->units.point_count;
      b->point = start + count;
    }
    if (!next_chord(descent, f)) {
      *ends = true;
      return CELSPAN_OK;
    }
  }
  return CELSPAN_OK;
}

/* Adds the unit of a chain in a row, and goes on to the row below; *ends: it does not reach that. */
static celspan_status add_unit(celspan_context *context, cs_descent *descent, cs_followed *f,
                               double top, bool *ends) {
  cs_units *units = &descent->units;
  CS_TRY(reserve(context, units, 0));
  celspan_point *start = units->points + units->point_count;
  *start = (celspan_point){f->x, cs_edges_round(f->y - top)};
  builder b = {start, f->x, f->x, 0};
  *ends = false;
  if (f->y1 < top + 1)
    CS_TRY(put_vertices(context, descent, f, top, &b, ends));
  if (!*ends) {
    f->y = top + 1;
    f->x = x_at(f, f->y);
    put_point(&b, f->x, 1);
    *ends = f->y1 == f->y && !next_chord(descent, f);
  }
  start = units->points + units->point_count;
  if (b.point->y == start->y) /* of no height */
    return CELSPAN_OK;
  units->units[units->count++] = (cs_unit){.low = b.low,
                                           .high = b.high,
                                           .y0 = start->y,
                                           .y1 = b.point->y,
                                           .left = 0.5 * b.twice,
                                           .point = (uint32_t)units->point_count,
                                           .count = (uint32_t)(b.point - start) + 1,
                                           .layer = f->chain->layer,
                                           .direction = f->chain->direction};
  units->point_count += (size_t)(b.point - start) + 1;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- rows */

/* Takes in the chains that begin above a height and end below another one. */
static celspan_status begin_chains(celspan_context *context, cs_descent *descent, double top) {
  const cs_boundary_set *set = descent->set;
  for (; descent->next < set->chain_count && set->chains[descent->next].y0 < top + 1;
       descent->next++) {
    const cs_boundary_chain *chain = &set->chains[descent->next];
    if (chain->y1 <= top)
      continue;
    CS_TRY(cs_mem_reserve(context, (void **)&descent->followed, &descent->capacity,
                          descent->count + 1, sizeof *descent->followed));
    begin_chain(descent, chain, top, &descent->followed[descent->count++]);
  }
  return CELSPAN_OK;
}

static celspan_status make_row(celspan_context *context, cs_descent *descent, double top) {
  descent->units.count = descent->units.point_count = 0;
  CS_TRY(begin_chains(context, descent, top));
  for (size_t i = 0; i < descent->count;) {
    bool ends;
    CS_TRY(add_unit(context, descent, &descent->followed[i], top, &ends));
    if (ends)
      descent->followed[i] = descent->followed[--descent->count];
    else
      i++;
  }
  return CELSPAN_OK;
}

celspan_status cs_descent_row(celspan_context *context, cs_descent *descent, int32_t row) {
  bool is_near =
      descent->row != CS_DESCENT_NONE && row >= descent->row && row - descent->row < FAR_ROWS;
  if (!is_near) {
    descent->count = descent->next = 0;
    descent->row = row;
  }
  celspan_status status = CELSPAN_OK;
  for (; status == CELSPAN_OK && descent->row <= row; descent->row++)
    status = make_row(context, descent, descent->row);
  if (status != CELSPAN_OK)
    descent->row = CS_DESCENT_NONE;
  return status;
}
