/* Rows of sheets in which nothing varies: loops for every set of instructions. */
#include "engine/map/folding.h"
#include "engine/span/row_writer.h"

/* Writes the spans of the last sheet that is shown, from column x on, as far as the sheets in front
 * of it stay as they are and nothing behind it can be seen. Returns the column where it ends. */
static inline int32_t write_last(cs_map_folding *f, int32_t x, cs_row_writer *writer) {
  const cs_map_frame *frame = f->maker->frame;
  const cs_map_frame behind = {.back = frame->back, .keep = frame->keep};
  const size_t last = f->shown_count - 1;
  const float clearest = last + 1 == frame->count ? 1 : 0;
  const cs_map_span *span = f->at[last];
  const cs_map_sheet sheet = {.back = frame->sheets[last].back, .keep = frame->sheets[last].keep};
  const cs_map_folded front = f->before[last];
  while (x < front.end) {
    cs_map_fold fold = front.fold;
    cs_map_fold_add(&fold, &sheet, span[1].colour, cs_map_even(span[1].colour));
    if (fold.t[0] > clearest)
      break;
    span++;
    x = span->end < front.end ? span->end : front.end;
    cs_row_writer_to(writer, x, cs_map_fold_end_even(fold, &behind));
  }
  f->at[last] = span;
  return x;
}

celspan_status CS_WIDE(cs_map_fold_flat)(cs_map_folding *f, cs_row *out) {
  const cs_map_maker *maker = f->maker;
  int32_t width = maker->frame->width;
  CS_TRY(cs_row_room(maker->context, out, (size_t)width));
  cs_row_writer writer = cs_row_writer_begin(out, 0);
  for (int32_t x = 0, end; x < width; x = end) {
    const cs_map_folded all = cs_map_fold_sheets(f, x, maker->frame->count, false);
    cs_v4 colour = cs_map_fold_end_even(all.fold, maker->frame);
    end = all.broken > 1 ? x + 1 : all.end;
    if (all.broken > 1)
      CS_TRY(cs_map_folding_solve(f, x, all.broken, &colour));
    cs_row_writer_to(&writer, end, colour);
    if (f->before[f->shown_count - 1].broken == 0)
      end = write_last(f, end, &writer);
  }
  cs_row_writer_end(&writer);
  return CELSPAN_OK;
}
