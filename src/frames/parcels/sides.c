/* What is cut off by the left and the right side of the frame.
 *
 *        | frame     arcs that are left of the frame are all on its side: together they lead from
 *     0 a|b b|c      fill 0 to the fill that is inside, so that one arc is enough. Numbers of fills
 *                    tell which: the sum of (right - left) of all of them is its number.
 */
#include "base/sort.h"
#include "frames/parcels/making.h"

static inline bool is_before(const cs_side_change *a, const cs_side_change *b) {
  return a->side != b->side ? a->side < b->side : a->height < b->height;
}
CS_SORT_DEFINE(sort_changes, cs_side_change, is_before)

celspan_status cs_sides_add(celspan_context *context, cs_frame_sides *sides, int side, int32_t top,
                            int32_t foot, uint32_t left, uint32_t right) {
  const int64_t by = (int64_t)right - left;
  if (top >= foot)
    return CELSPAN_OK;
  CS_TRY(CS_APPEND(context, sides->changes, sides->count, sides->capacity,
                   (cs_side_change){side, top, by}));
  return CS_APPEND(context, sides->changes, sides->count, sides->capacity,
                   (cs_side_change){side, foot, -by});
}

/* The changes at one height of one side, from one on: *by is their sum. Returns their end. */
static size_t sum_changes(const cs_frame_sides *sides, size_t first, int64_t *by) {
  size_t end = first;
  for (*by = 0; end < sides->count && !is_before(&sides->changes[first], &sides->changes[end]);
       end++)
    *by += sides->changes[end].by;
  return end;
}

celspan_status cs_sides_put(celspan_context *context, cs_frame_sides *sides, cs_parcels *parcels) {
  int64_t sum = 0, by;
  int32_t top = 0;
  sort_changes(sides->changes, sides->count);
  for (size_t i = 0; i < sides->count;) {
    const cs_side_change change = sides->changes[i];
    const int64_t fill = change.side == 0 ? sum : -sum;
    i = sum_changes(sides, i, &by);
    if (by == 0)
      continue;
    if (fill > 0 && fill < (int64_t)parcels->fill_count)
      CS_TRY(cs_arc_put_side(context, change.side, top, change.height, (uint32_t)fill, parcels));
    sum += by;
    top = change.height;
  }
  return CELSPAN_OK;
}

void cs_sides_finish(cs_frame_sides *sides, cs_memory *memory) {
  cs_mem_free(memory, sides->changes, sides->capacity * sizeof *sides->changes);
}
