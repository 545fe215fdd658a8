/* Stretches of one contour are joined to chains. */
#include "model/geometry/boundary_build.h"

void cs_stretches_reverse(cs_boundary_stretches *stretches, size_t begin, bool turns_direction) {
  cs_boundary_stretch *items = stretches->items;
  for (size_t i = begin; turns_direction && i < stretches->count; i++)
    items[i].direction = -items[i].direction;
  for (size_t i = begin, j = stretches->count; i + 1 < j; i++) {
    cs_boundary_stretch swapped = items[i];
    items[i] = items[--j];
    items[j] = swapped;
  }
}

/* Whether b continues a, along the contour. */
static inline bool joins(const cs_boundary_stretch *a, const cs_boundary_stretch *b) {
  const cs_boundary_piece *upper = a->direction > 0 ? &a->piece : &b->piece;
  const cs_boundary_piece *lower = a->direction > 0 ? &b->piece : &a->piece;
  return a->direction == b->direction && upper->x1 == lower->x0 && upper->y1 == lower->y0;
}

/* The end of the stretches that continue one another, from `begin` on. */
static size_t end_of_run(const cs_boundary_stretches *stretches, size_t begin) {
  size_t end = begin + 1;
  while (end < stretches->count && joins(&stretches->items[end - 1], &stretches->items[end]))
    end++;
  return end;
}

static bool is_vertical(const cs_boundary_piece *piece) {
  return piece->chords == 1 && piece->x0 == piece->x1;
}

/* Appends the pieces of a run to the bottom of its chain, which is from `chain` to `next`; two
 * vertical lines become one. Returns the end of the chain. */
static cs_boundary_piece *append_run(const cs_boundary_stretch *items, size_t begin, size_t end,
                                     const cs_boundary_piece *chain, cs_boundary_piece *next) {
  bool falls = items[begin].direction > 0;
  for (size_t i = begin; i < end; i++) {
    const cs_boundary_piece *piece = &items[falls ? i : begin + end - 1 - i].piece;
    if (is_vertical(piece) && next > chain && is_vertical(next - 1))
      next[-1].y1 = piece->y1;
    else
      *next++ = *piece;
  }
  return next;
}

/* Makes the chain of a run. The first `wrapped` stretches continue the run. */
static void append_chain(const cs_boundary_stretch *items, size_t begin, size_t end, size_t wrapped,
                         uint32_t layer, cs_boundary_set *set) {
  int32_t direction = items[begin].direction;
  cs_boundary_piece *first = &set->pieces[set->piece_count], *next = first;
  if (wrapped > 0 && direction < 0)
    next = append_run(items, 0, wrapped, first, next);
  next = append_run(items, begin, end, first, next);
  if (wrapped > 0 && direction > 0)
    next = append_run(items, 0, wrapped, first, next);
  set->chains[set->chain_count++] = (cs_boundary_chain){.y0 = first->y0,
                                                        .y1 = next[-1].y1,
                                                        .x0 = first->x0,
                                                        .piece = (uint32_t)set->piece_count,
                                                        .piece_count = (uint32_t)(next - first),
                                                        .layer = layer,
                                                        .direction = direction};
  set->piece_count += (size_t)(next - first);
}

static celspan_status reserve(celspan_context *context, size_t count, cs_boundary_set *set) {
  if (count > UINT32_MAX - set->piece_count)
    return cs_fail(context, CELSPAN_LIMIT, "the frame has more than 4294967295 curve pieces");
  CS_TRY(CS_ARRAY_RESERVE(context, set->pieces, set->piece_count + count));
  return CS_ARRAY_RESERVE(context, set->chains, set->chain_count + count);
}

celspan_status cs_stretches_join(celspan_context *context, const cs_boundary_stretches *stretches,
                                 uint32_t layer, cs_boundary_set *set) {
  const cs_boundary_stretch *items = stretches->items;
  size_t count = stretches->count;
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(reserve(context, count, set));
  size_t origin = joins(&items[count - 1], &items[0]) ? end_of_run(stretches, 0) : 0;
  for (size_t begin = origin, end; begin < count; begin = end) {
    end = end_of_run(stretches, begin);
    append_chain(items, begin, end, end == count ? origin : 0, layer, set);
  }
  return CELSPAN_OK;
}
