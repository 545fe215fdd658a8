#include "engine/map/frame_rows.h"

#include "base/self_check.h"

/* ---------------------------------------------------------------- life */

celspan_status cs_map_maker_init(cs_map_maker *maker, celspan_context *context,
                                 const cs_map_frame *frame) {
  *maker = (cs_map_maker){.context = context, .frame = frame, .row = -1};
  CS_TRY(cs_map_sums_init(context, frame->width, &maker->sums));
  if (frame->count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, maker->rows, frame->count));
  for (size_t i = 0; i < frame->count; i++)
    maker->rows[i] = (cs_map_rows){.drawing = &frame->sheets[i].drawing, .row = -1};
  return CELSPAN_OK;
}

void cs_map_maker_finish(cs_map_maker *maker) {
  if (!maker->context)
    return;
  cs_memory *memory = maker->context->memory;
  for (size_t i = 0; maker->rows && i < maker->frame->count; i++)
    cs_map_rows_finish(&maker->rows[i], memory);
  cs_mem_free(memory, maker->rows, maker->frame->count * sizeof *maker->rows);
  cs_map_sums_finish(&maker->sums, memory);
  cs_map_exact_finish(&maker->exact, memory);
  *maker = (cs_map_maker){0};
}

/* ---------------------------------------------------------------- a row */

/* Where a row is being folded. */
typedef struct folding {
  cs_map_maker *maker;
  int32_t y;
  const cs_map_span *at[CS_MAP_DRAWINGS]; /* the span of each sheet */
  cs_map_shown shown[CS_MAP_DRAWINGS];    /* what can be shown at x, from the camera */
  size_t shown_count, broken_count;
} folding;

/* Folds the sheets at a column up to the first one that nothing shines through. *end: gets the end
 * of the columns where they are the same. */
static cs_map_fold fold_sheets(folding *f, int32_t x, int32_t *end) {
  const cs_map_frame *frame = f->maker->frame;
  cs_map_fold fold = cs_map_fold_begin;
  f->broken_count = 0;
  size_t i = 0;
  for (; i < frame->count && fold.t > 0; i++) {
    while (f->at[i]->end <= x)
      f->at[i]++;
    const cs_map_span *span = f->at[i];
    *end = span->end < *end ? span->end : *end;
    f->shown[i] = (cs_map_shown){&frame->sheets[i], span->colour};
    f->broken_count += span->cell == CS_MAP_BROKEN;
    cs_map_fold_add(&fold, &frame->sheets[i], span->colour);
  }
  f->shown_count = i;
  return fold;
}

/* Solves the pixel at x, where several sheets that can be shown are broken. */
static celspan_status solve(folding *f, int32_t x, cs_v4 *out) {
  cs_map_maker *maker = f->maker;
  for (size_t i = 0; i < f->shown_count; i++) {
    const cs_map_rows *rows = &maker->rows[i];
    const cs_map_span *first = rows->spans + rows->first[f->y - maker->row], *span = f->at[i];
    if (span->cell != CS_MAP_BROKEN)
      continue;
    while (span > first && span[-1].cell == CS_MAP_BROKEN)
      span--;
    int32_t from = span > first ? span[-1].end : 0;
    f->shown[i].colour = span > first ? span[-1].colour : rows->drawing->colours[0];
    CS_TRY(cs_map_exact_add(maker->context, &maker->exact, rows, (uint32_t)i, from, x, f->y));
  }
  return cs_map_exact_mean(maker->context, &maker->exact, maker->frame, f->shown, f->shown_count,
                           out);
}

static celspan_status make_row(folding *f, cs_row *out) {
  const cs_map_maker *maker = f->maker;
  int32_t width = maker->frame->width;
  for (size_t i = 0; i < maker->frame->count; i++)
    f->at[i] = maker->rows[i].spans + maker->rows[i].first[f->y - maker->row];
  for (int32_t x = 0, end; x < width; x = end) {
    end = width;
    cs_v4 colour = cs_map_fold_end(fold_sheets(f, x, &end), maker->frame);
    if (f->broken_count > 1) {
      end = x + 1;
      CS_TRY(solve(f, x, &colour));
    }
    CS_TRY(cs_row_single(maker->context, out, x, end, colour));
  }
  return CELSPAN_OK;
}

static celspan_status make_swath(cs_map_maker *maker, int32_t row) {
  maker->row = -1;
  for (size_t i = 0; i < maker->frame->count; i++)
    CS_TRY(cs_map_rows_make(maker->context, &maker->sums, &maker->rows[i], row));
  maker->row = row;
  return CELSPAN_OK;
}

celspan_status cs_map_maker_row(cs_map_maker *maker, int32_t y, cs_row *out) {
  folding f = {.maker = maker, .y = y};
  int32_t row = y - y % CS_MAP_ROWS;
  cs_row_clear(out);
  if (row != maker->row)
    CS_TRY(make_swath(maker, row));
  maker->exact.line_count = 0;
  CS_TRY(make_row(&f, out));
  CS_SELF_CHECK(cs_row_is_whole(out, maker->frame->width));
  return CELSPAN_OK;
}
