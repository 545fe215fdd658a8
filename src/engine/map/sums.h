/* Rows of one map: sums of what its borders change.
 *
 *      border             pixel p           p + 1
 *                   +-----------/-----+-----------------+     right of a border the colour changes
 *                   |          /######|#################|     by right - left, in the area that is
 *                   |   left  / right |                 |     marked: pixel p gets that times its
 *                   |        /########|#################|     area, pixel p + 1 the rest of the
 *                   +-------/---------+-----------------+     border's height
 *
 * So the colour of a pixel is the sum of all pixels up to it. The rows of a swath are summed
 * together, and a pixel to which nothing was added has the colour of the one before it.
 *
 * The keys of cells are summed, too, in integers and with the same areas. Where such a sum is the
 * key of a cell times a whole pixel, nothing else is in the pixel: its colour is then
 * that of the cell to the bit, and nothing of the sum so far is carried on. A pixel in which there
 * is more than one cell is broken.
 *
 * Cells that vary are clear in these sums. Their areas are summed cell by cell instead, and what
 * shows of them is painted where it can be seen (brush.h): as a share of the cell's own colour in
 * that pixel, so that nothing leaks between a gradient and its neighbour.
 *
 * Invariant: the rows are a function of the drawing and their numbers: borders are added in the
 * order that the map has, whichever rows were made before.
 */
#pragma once

#include "engine/map/map.h"

#define CS_MAP_ROWS 8       /* of a swath: its first row is a multiple of it */
#define CS_MAP_HEIGHT 65536 /* of a row of the frame: heights and areas are multiples of 1 / it */
#define CS_MAP_BROKEN UINT32_MAX

/* A map in its place in a frame. */
typedef struct cs_map_drawing {
  cs_map *map;               /* a reference */
  const cs_map_lines *lines; /* those of the map, or turned ones */
  cs_map_lines turned;       /* owned; empty where the frame shows the map upright */
  /* Units of the lines to pixels: those of the map from the drawing's origin, which is at -left,
   * -top. Both scales are above 0. */
  double scale_x, shift_x, scale_y, shift_y;
  int64_t left, top;
  celspan_matrix to_raster; /* from pixels to those of the map's raster */
  cs_v4 light;              /* that falls on it; lane 3: how opaque it is */
  const cs_grade *grade;    /* NULL: none. Borrowed from the scene */
  celspan_space space;
  cs_v4 *colours; /* of its cells, in the frame's light; 0 where they vary; owned */
  cs_stack stack; /* that of the map, on the pixels of the frame: shades and images are owned, the
                     rest is the map's */
} cs_map_drawing;

/* How much of a pixel is in a cell that varies. */
typedef struct cs_map_share {
  uint32_t cell;
  float share;
} cs_map_share;

/* Neighbouring pixels of one colour, from the end of the span before. */
typedef struct cs_map_span {
  cs_v4 colour; /* of what does not vary */
  int32_t end;
  uint32_t cell;               /* BROKEN: several */
  uint32_t share, share_count; /* of the rows: what varies */
} cs_map_span;

/* A border that crosses the swath, and its last point that is not below the swath's top. */
typedef struct cs_map_live {
  uint32_t border, at;
} cs_map_live;

/* The area of a cell that varies, in the pixel that is being read. */
typedef struct cs_map_area {
  uint32_t cell;
  int64_t area; /* times HEIGHT */
} cs_map_area;

/* The rows of a drawing in the current swath. */
typedef struct cs_map_rows {
  const cs_map_drawing *drawing; /* borrowed */
  struct cs_map_brush *brush;    /* of the cells that vary: brush.h. Borrowed */
  int32_t row;                   /* the first; -1: none has been made */
  uint32_t next;                 /* borders before it have been visited */
  cs_map_live *lives;            /* in the order of the map */
  cs_map_span *spans;
  size_t first[CS_MAP_ROWS + 1]; /* spans of each row, and the end of those of the last */
  cs_map_share *shares;
  cs_map_area *areas; /* of the pixel being read, those that are not 0 */
  size_t live_count, live_capacity, span_count, span_capacity;
  size_t share_count, share_capacity, area_count, area_capacity;
} cs_map_rows;

/* What is added to a pixel. */
typedef struct cs_map_sum {
  cs_v4d colour; /* times HEIGHT */
  uint64_t key;  /* times HEIGHT, modulo 2^64 */
  uint32_t part; /* 1 more than its first part; 0: none */
} cs_map_sum;

/* What a border adds to the area of a cell that varies. */
typedef struct cs_map_part {
  int64_t area;
  uint32_t cell, next; /* next: as above */
} cs_map_part;

/* Room for the sums of a swath, cleared between uses: all drawings of a worker share it. */
typedef struct cs_map_sums {
  int32_t width; /* pixels of a row */
  size_t words;  /* of a row's bits */
  cs_map_sum *sums;
  uint64_t *bits; /* the pixels to which something was added */
  cs_map_part *parts;
  size_t part_count, part_capacity;
  celspan_status status; /* of appending parts */
} cs_map_sums;

CELSPAN_CHECKED celspan_status cs_map_sums_init(celspan_context *context, int32_t width,
                                                cs_map_sums *out);
void cs_map_sums_finish(cs_map_sums *sums, cs_memory *memory);

void cs_map_rows_finish(cs_map_rows *rows, cs_memory *memory);
/* Makes the rows of the swath that begins with `row`. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_rows_make(celspan_context *context, cs_map_sums *sums,
                                                cs_map_rows *rows, int32_t row);

/* The last point of a border that is not below the top of a row, or else its first one. */
uint32_t cs_map_find_point(const cs_map_drawing *drawing, const cs_map_border *border, int32_t row);

/* A point of a map on the frame. */
typedef struct cs_map_place {
  double x;  /* pixels */
  int64_t y; /* HEIGHTths of a pixel */
} cs_map_place;

static inline double cs_map_place_y(const cs_map_drawing *drawing, int32_t y) {
  double whole = (double)(drawing->top * CS_MAP_UNIT + y);
  return whole * drawing->scale_y + drawing->shift_y;
}

static inline double cs_map_place_x(const cs_map_drawing *drawing, int32_t x) {
  double whole = (double)(drawing->left * CS_MAP_UNIT + x);
  return whole * drawing->scale_x + drawing->shift_x;
}

static inline cs_map_place cs_map_place_of(const cs_map_drawing *drawing, cs_map_point point) {
  double y = cs_map_place_y(drawing, point.y) * CS_MAP_HEIGHT + 0.5;
  int64_t whole = (int64_t)y;
  return (cs_map_place){cs_map_place_x(drawing, point.x), whole - ((double)whole > y)};
}
