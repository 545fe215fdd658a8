/* What is cut off by the left and the right side of the frame.
 *
 *        | frame     arcs that are left of the frame are all on its side: together they lead from
 *     0 a|b b|c      fill 0 to the fill that is inside, so that one arc is enough. Numbers of fills
 *                    tell which: the sum of (right - left) of all of them is its number.
 *
 * Of a sum of several pictures it is the sum of several numbers, and the sum of their squares is
 * less than its square: so both are kept.
 */
#include "inside/sort.h"
#include "writers/parcels/making.h"

static inline bool is_before(const cs_side_change *a, const cs_side_change *b) {
  return a->side != b->side ? a->side < b->side : a->height < b->height;
}
CS_SORT_DEFINE(sort_changes, cs_side_change, is_before)

celspan_status cs_sides_add(celspan_context *context, cs_frame_sides *sides, int side, int32_t top,
                            int32_t foot, uint32_t left, uint32_t right) {
  const int64_t by = (int64_t)right - left;
  const uint64_t squares = (uint64_t)right * right - (uint64_t)left * left;
  if (top >= foot)
    return CELSPAN_OK;
  CS_TRY(CS_APPEND(context, sides->changes, sides->count, sides->capacity,
                   (cs_side_change){side, top, by, squares}));
  return CS_APPEND(context, sides->changes, sides->count, sides->capacity,
                   (cs_side_change){side, foot, -by, -squares});
}

/* Adds the changes at one height of one side, from one on, to a sum. Returns their end. */
static size_t sum_changes(const cs_frame_sides *sides, size_t first, cs_side_change *sum) {
  size_t end = first;
  for (; end < sides->count && !is_before(&sides->changes[first], &sides->changes[end]); end++) {
    sum->by += sides->changes[end].by;
    sum->squares += sides->changes[end].squares;
  }
  return end;
}

/* Whether sums of numbers and of their squares are those of one fill. */
static bool is_one(int64_t fill, uint64_t squares, const cs_parcels *parcels) {
  return fill >= 0 && fill < (int64_t)parcels->fill_count &&
         squares == (uint64_t)fill * (uint64_t)fill;
}

celspan_status cs_sides_put(celspan_context *context, cs_frame_sides *sides, cs_parcels *parcels) {
  cs_side_change sum = {.height = 0}; /* height: the top of the part that the sum is for */
  sort_changes(sides->changes, sides->count);
  for (size_t i = 0; i < sides->count;) {
    const cs_side_change change = sides->changes[i], before = sum;
    const int64_t fill = change.side == 0 ? sum.by : -sum.by;
    i = sum_changes(sides, i, &sum);
    if (sum.by == before.by && sum.squares == before.squares)
      continue;
    if (!is_one(fill, change.side == 0 ? before.squares : -before.squares, parcels))
      parcels->is_sum |= change.height - before.height > cs_parcels_apart(parcels);
    else if (fill > 0)
      CS_TRY(cs_arc_put_side(context, change.side, before.height, change.height, (uint32_t)fill,
                             parcels));
    sum.height = change.height;
  }
  return CELSPAN_OK;
}

void cs_sides_finish(cs_frame_sides *sides, cs_memory *memory) {
  cs_mem_free(memory, sides->changes, sides->capacity * sizeof *sides->changes);
}
