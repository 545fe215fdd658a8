#include "engine/map/folding.h"

#include "engine/paint/over_row.h"

cs_v4 cs_map_folding_clear(const cs_map_folding *f, size_t i) {
  const cs_map_rows *rows = &f->maker->rows[i];
  const cs_map_span *span = f->at[i];
  float through = span->colour[3];
  if (!rows->drawing->through)
    return cs_v4_all(1);
  for (uint32_t n = 0; n < span->share_count; n++)
    through += rows->shares[span->share + n].share;
  return cs_map_folding_through(f, i, span) + cs_v4_all(through);
}

celspan_status cs_map_folding_colours(cs_map_folding *f, size_t i, int32_t x, int32_t end,
                                      cs_v4 *out) {
  const cs_map_rows *rows = &f->maker->rows[i];
  const cs_map_span *span = f->at[i];
  cs_v4 colours[CS_OVER_ROW_BATCH];
  for (int32_t k = 0; k < end - x; k++)
    out[k] = span->colour;
  for (uint32_t n = 0; n < span->share_count; n++) {
    const cs_map_share *share = &rows->shares[span->share + n];
    CS_TRY(cs_map_brush_colours(rows->brush, share->cell, f->y, x, end, colours));
    for (int32_t k = 0; k < end - x; k++)
      out[k] += share->share * colours[k];
  }
  return CELSPAN_OK;
}

/* The first of the broken spans that end with the current one of a sheet. */
static const cs_map_span *find_broken(const cs_map_folding *f, size_t i) {
  const cs_map_rows *rows = &f->maker->rows[i];
  const cs_map_span *first = rows->spans + rows->first[f->y - f->maker->row], *span = f->at[i];
  while (span > first && span[-1].cell == CS_MAP_BROKEN)
    span--;
  return span;
}

/* The colour of a sheet at x, to the left of its broken pixels. */
static celspan_status find_base(cs_map_folding *f, size_t i, int32_t x, cs_map_shown *out) {
  const cs_map_rows *rows = &f->maker->rows[i];
  const cs_map_span *first = rows->spans + rows->first[f->y - f->maker->row];
  const cs_map_span *span = find_broken(f, i);
  uint32_t cell = span > first ? span[-1].cell : 0;
  CS_TRY(cs_map_brush_colour(rows->brush, rows->drawing, cell, x, f->y, &out->colour));
  out->through = cs_map_through(rows->drawing, cell, out->colour);
  return CELSPAN_OK;
}

/* Adds the lines of a broken sheet at x. */
static celspan_status add_lines(cs_map_folding *f, size_t i, int32_t x) {
  cs_map_maker *maker = f->maker;
  cs_map_rows *rows = &maker->rows[i];
  const cs_map_span *first = rows->spans + rows->first[f->y - maker->row];
  const cs_map_span *span = find_broken(f, i);
  return cs_map_exact_add(maker->context, &maker->exact, rows, (uint32_t)i,
                          span > first ? span[-1].end : 0, x, f->y);
}

/* The mean of a sheet at x, and the lines of a broken one. */
static celspan_status find_shown(cs_map_folding *f, size_t i, int32_t x, cs_map_shown *out) {
  *out = (cs_map_shown){&f->maker->frame->sheets[i], f->at[i]->colour,
                        cs_map_folding_through(f, i, f->at[i])};
  if (f->at[i]->share_count > 0) {
    CS_TRY(cs_map_folding_colours(f, i, x, x + 1, &out->colour));
    out->through = cs_map_folding_clear(f, i) - cs_v4_all(out->colour[3]);
  }
  return f->at[i]->cell == CS_MAP_BROKEN ? add_lines(f, i, x) : CELSPAN_OK;
}

celspan_status cs_map_folding_solve(cs_map_folding *f, int32_t x, uint32_t broken_count,
                                    cs_v4 *out) {
  cs_map_maker *maker = f->maker;
  cs_map_exact *exact = &maker->exact;
  cs_map_shown shown[CS_MAP_DRAWINGS];
  for (size_t i = 0; i < f->shown_count; i++)
    CS_TRY(find_shown(f, i, x, &shown[i]));
  if (broken_count == 2 && exact->line_count <= CS_MAP_EXACT_LINES) {
    *out = cs_map_exact_pair(exact, maker->frame, shown, f->shown_count);
    return CELSPAN_OK;
  }
  for (size_t i = 0; i < f->shown_count; i++)
    if (f->at[i]->cell == CS_MAP_BROKEN)
      CS_TRY(find_base(f, i, x, &shown[i]));
  return cs_map_exact_mean(maker->context, exact, maker->frame, shown, f->shown_count, out);
}
