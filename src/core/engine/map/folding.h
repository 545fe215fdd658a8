/* The fold of a row of sheets: for rows in which nothing varies (flat_wide.c), and for other rows
 * (frame_rows.c).
 *
 *     x                 end         the fold of the sheets up to each one is kept, with the first
 *     |--- sheet 1 ------|          column where it changes; so a column begins with the first
 *     |--- sheet 0 ---|             sheet that has changed
 *
 * Invariant: `before[i]` is the fold of the first i sheets at the column that was folded last.
 */
#pragma once

#include "engine/map/exact.h"
#include "engine/map/swept.h"

/* The state of one thread that makes the rows of a frame of drawings. */
typedef struct cs_map_maker {
  celspan_context *context;  /* borrowed: the worker's branch */
  const cs_map_frame *frame; /* borrowed */
  cs_map_sums sums;
  CS_ARRAY(cs_map_rows, rows);     /* one for each sheet */
  CS_ARRAY(cs_map_brush, brushes); /* one for each sheet */
  CS_ARRAY(cs_map_swept, swept);   /* one for each sheet, used by the swept sheets */
  int32_t row;                     /* the first row of the swath that is in `rows`; -1: none is */
  cs_map_exact exact;
  cs_row painted; /* a run of the only sheet that varies */
  bool varies;    /* a cell of a sheet varies, or a sheet is coloured */
} cs_map_maker;

/* The fold of the sheets from the camera to before one of them. */
typedef struct cs_map_folded {
  cs_map_fold fold;
  int32_t end;             /* the first column where one of these sheets changes */
  uint32_t broken, varied; /* how many of these sheets are broken, and how many vary */
} cs_map_folded;

/* Where a row is being folded. */
typedef struct cs_map_folding {
  cs_map_maker *maker;
  int32_t y;
  const cs_map_span *at[CS_MAP_DRAWINGS]; /* the span of each sheet */
  cs_map_folded
      before[CS_MAP_DRAWINGS + 1]; /* one for each sheet that may be visible, and one more */
  size_t shown_count;              /* sheets that may be visible, from the camera */
} cs_map_folding;

/* is_even: all sheets are even; a constant of each caller. */
static inline bool cs_map_lets_through(const cs_map_fold *fold, bool is_even) {
  return is_even ? fold->t[0] > 0 : cs_v4_any_above(fold->t, cs_v4_all(0));
}

/* Whether nothing shines through a span, which varies. */
static inline bool cs_map_folding_hides(const cs_map_drawing *drawing, const cs_map_span *span) {
  return span->cell != CS_MAP_BROKEN && drawing->map->cells[span->cell].hides &&
         drawing->light[3] == 1;
}

/* The transmission of a span of a sheet. */
static inline cs_v4 cs_map_folding_through(const cs_map_folding *f, size_t i,
                                           const cs_map_span *span) {
  const cs_map_rows *rows = &f->maker->rows[i];
  return rows->drawing->through ? rows->through[span - rows->spans] : cs_map_even(span->colour);
}

/* Folds `count` sheets at a column, up to the first one that nothing shines through. It continues
 * from the first sheet that has changed since the column before. Cells that vary are left out of
 * the fold. varies: whether any cell varies or is coloured: a constant of each caller. */
static inline cs_map_folded cs_map_fold_sheets(cs_map_folding *f, int32_t x, size_t count,
                                               bool varies) {
  const cs_map_frame *frame = f->maker->frame;
  size_t i = f->shown_count > 0 ? f->shown_count - 1 : 0;
  while (i > 0 && f->before[i].end <= x)
    i--;
  cs_map_folded all = f->before[i];
  for (bool is_hidden = false; i < count && cs_map_lets_through(&all.fold, !varies) && !is_hidden;
       i++) {
    const cs_map_span *span = f->at[i];
    while (span->end <= x)
      span++;
    f->at[i] = span;
    all.end = span->end < all.end ? span->end : all.end;
    all.broken += span->cell == CS_MAP_BROKEN;
    all.varied += varies && span->share_count > 0;
    if (varies && span->share_count > 0)
      is_hidden = cs_map_folding_hides(f->maker->rows[i].drawing, span);
    else if (span->cell > 0 || f->maker->rows[i].has_back)
      cs_map_fold_add(&all.fold, &frame->sheets[i], span->colour,
                      varies ? cs_map_folding_through(f, i, span) : cs_map_even(span->colour));
    f->before[i + 1] = all;
  }
  f->shown_count = i;
  return all;
}

/* The transmission of a varying sheet in the pixels of its span where its alpha is 0: a cell that
 * varies dims all channels alike, by its alpha. */
cs_v4 cs_map_folding_clear(const cs_map_folding *f, size_t i);
/* The colours of a sheet from x to end, in one of its spans. Errors: those of painting. */
CELSPAN_CHECKED celspan_status cs_map_folding_colours(cs_map_folding *f, size_t i, int32_t x,
                                                      int32_t end, cs_v4 *out);
/* Solves the pixel at x, where several shown sheets are broken. Errors: NO_MEMORY, and those of
 * painting. */
CELSPAN_CHECKED celspan_status cs_map_folding_solve(cs_map_folding *f, int32_t x,
                                                    uint32_t broken_count, cs_v4 *out);

/* ---- flat_wide.c */

/* A row in which nothing varies. Errors: NO_MEMORY, and those of painting. */
CS_WIDE_DECLARE(CELSPAN_CHECKED celspan_status, cs_map_fold_flat,
                (cs_map_folding * f, cs_row *out));
