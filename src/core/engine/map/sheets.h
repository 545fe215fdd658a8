/* A frame of sheets, one over the other: drawings, each from its map, and cels that are swept.
 *
 *     camera
 *       |   sheet n - 1  ----- map        colours and alpha, and behind each sheet a back light
 *       |   sheet n - 2  ===== plan       neighbouring cels that are swept are one sheet (swept.h)
 *       |   ...
 *       v   sheet 0      ----- map
 *
 * A pixel in which at most one sheet is broken is a fold of means: it is exact, because a fold is
 * linear in each of its layers. One in which several are broken is solved (exact.h).
 *
 * Invariant: a frame does not change once it is made, and threads share it. A row is a function of
 * the frame and its number.
 */
#pragma once

#include "engine/compose/over.h"
#include "engine/map/swath.h"
#include "engine/row/plan.h"
#include "engine/span/row.h"

#define CS_MAP_DRAWINGS 64 /* in a frame, at most */

typedef struct cs_map_sheet {
  cs_map_drawing drawing; /* the drawing of a map; all 0 for other sheets */
  cs_plan *plan; /* the plan of cels that are swept, owned; NULL: the sheet is drawn from a map */
  /* Of a map: a hash of all that it shows, and the heights of the frame that it reaches. */
  cs_hash hash;
  double top, bottom;
  size_t source_count; /* the number of cels that it was made from, for the caller */
  cs_v4 back;          /* the light behind the sheet; lane 3 is 0 */
  float keep;          /* the share of transparency that the matte of that light leaves */
} cs_map_sheet;

typedef struct cs_map_frame {
  cs_map_sheet *sheets; /* from the camera */
  size_t count;
  /* maps that were made for this frame, because they were not kept from an earlier one */
  size_t made;
  bool has_gaps; /* a zone of some map is missing: some rows cannot be made (frame_rows.h) */
  cs_v4 back;    /* the back light of the frame, as above */
  float keep;
  int32_t width, height;
} cs_map_frame;

/* The light gathered so far, from the camera. Lane 3 of e has no meaning; lane 3 of t has a meaning
 * only where all sheets are even. */
typedef struct cs_map_fold {
  cs_v4 e, t;
  float keep;
} cs_map_fold;

static const cs_map_fold cs_map_fold_begin = {{0, 0, 0, 0}, {1, 1, 1, 1}, 1};

/* The transmission of a colour that dims all channels alike. */
static inline cs_v4 cs_map_even(cs_v4 colour) { return cs_v4_all(1 - colour[3]); }

/* The transmission of a cell of a drawing that shows this colour. */
static inline cs_v4 cs_map_through(const cs_map_drawing *drawing, uint32_t cell, cs_v4 colour) {
  return drawing->through && drawing->map->cells[cell].length == 0 ? drawing->through[cell]
                                                                   : cs_map_even(colour);
}

static inline void cs_map_fold_add(cs_map_fold *fold, const cs_map_sheet *sheet, cs_v4 colour,
                                   cs_v4 through) {
  fold->e += fold->t * colour;
  fold->t *= through;
  fold->e += fold->t * sheet->back;
  fold->keep *= sheet->keep;
}

/* t: the mean transmission. */
static inline cs_v4 cs_map_fold_end_with(cs_map_fold fold, float t, const cs_map_frame *frame) {
  cs_v4 colour = fold.e + fold.t * frame->back;
  colour[3] = 1 - fold.keep * frame->keep * t;
  return colour;
}

static inline cs_v4 cs_map_fold_end(cs_map_fold fold, const cs_map_frame *frame) {
  return cs_map_fold_end_with(fold, cs_over_mean(fold.t), frame);
}

/* The same where all sheets are even. */
static inline cs_v4 cs_map_fold_end_even(cs_map_fold fold, const cs_map_frame *frame) {
  return cs_map_fold_end_with(fold, fold.t[0], frame);
}

/* A frame of one sheet, which is even. */
static inline cs_v4 cs_map_fold_one(const cs_map_sheet *sheet, const cs_map_frame *frame,
                                    cs_v4 colour) {
  cs_map_fold fold = cs_map_fold_begin;
  cs_map_fold_add(&fold, sheet, colour, cs_map_even(colour));
  return cs_map_fold_end_even(fold, frame);
}
