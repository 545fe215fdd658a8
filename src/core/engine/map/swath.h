/* The sources of the rows of a swath: a map in its place in a frame, its borders that cross the
 * swath, and the values that they add to the pixels.
 *
 *   row 8 k      +--+--+--+--+--+--+     a swath: the rows that are summed together
 *   ...          |  |\ |  |  |  |  |
 *   row 8 k + 7  +--+-\+--+--+--+--+     live: a border that crosses it
 *
 * Invariant: places are a function of the drawing and of the point, so that borders which meet in
 * the map meet in the frame.
 */
#pragma once

#include "base/wide.h"
#include "engine/map/map.h"

#define CS_MAP_ROWS 8 /* rows of a swath: its first row is a multiple of it */
/* units of a row's height: heights and areas are multiples of 1 / this */
#define CS_MAP_HEIGHT 65536
#define CS_MAP_BROKEN UINT32_MAX

/* The first row of the swath in which a row lies. */
static inline int32_t cs_map_swath(int32_t row) { return row - row % CS_MAP_ROWS; }

/* A map in its place in a frame. */
typedef struct cs_map_drawing {
  cs_map *map;               /* a reference */
  const cs_map_lines *lines; /* the lines of the map, or turned copies */
  cs_map_lines turned;       /* owned; empty where the frame shows the map upright */
  /* From units of the lines to pixels of the map, counted from the drawing's origin, which is at
   * -left, -top. Both scales are above 0. */
  double scale_x, shift_x, scale_y, shift_y;
  int64_t left, top;
  celspan_matrix to_raster; /* from pixels to pixels of the map's raster */
  cs_v4 light;              /* the light that falls on the drawing; lane 3: its opacity */
  const cs_grade *grade;    /* NULL: none. Borrowed from the scene */
  celspan_space space;
  /* the colours of its cells, in the frame's light; 0 where they vary; owned */
  CS_ARRAY(cs_v4, colours);
  /* the light that each cell transmits, faded; lane 3: the mean; 0 where the cell varies. Only of a
   * coloured map; NULL for other maps. Owned. */
  CS_ARRAY(cs_v4, through);
  cs_stack stack; /* the stack of the map, on the pixels of the frame: shades and images are owned,
                     the rest belongs to the map */
} cs_map_drawing;

/* How much of a pixel is in a cell that varies. */
typedef struct cs_map_share {
  uint32_t cell;
  float share;
} cs_map_share;

/* Neighbouring pixels of one colour, from the end of the span before. */
typedef struct cs_map_span {
  cs_v4 colour; /* the colour of the cells that do not vary */
  int32_t end;
  uint32_t cell;               /* BROKEN: several */
  uint32_t share, share_count; /* in the shares of the rows: the cells that vary */
} cs_map_span;

/* A border that crosses the swath. Its points, beginning with the first point of its first line in
 * the swath, are in `places` of the rows, from `at` to before `end`. */
typedef struct cs_map_live {
  uint32_t border, at, end;
  uint32_t next;           /* the same index as `at`, for the swath below */
  int32_t low, high, foot; /* where the border is, in the units of places */
  bool varies;             /* a cell on one of its sides varies */
  uint64_t key;            /* the difference of the keys, from its left to its right */
  float step[4];           /* the difference of the colours, for each HEIGHTth of a pixel */
} cs_map_live;

/* How much of a cell that varies is in the pixel that is being read, in HEIGHTths. */
typedef struct cs_map_area {
  uint32_t cell;
  int32_t area;
} cs_map_area;

/* The rows of a drawing in the current swath. */
typedef struct cs_map_rows {
  const cs_map_drawing *drawing;  /* borrowed */
  struct cs_map_brush *brush;     /* the brush of the cells that vary: brush.h. Borrowed */
  int32_t row;                    /* the first row; -1: no rows have been made */
  bool has_back;                  /* where it is clear, something may still be added */
  uint32_t next;                  /* all borders before this one have been visited */
  CS_ARRAY(cs_map_live, lives);   /* the borders that are crossed, in the order of the map */
  CS_ARRAY(cs_map_point, places); /* of their points on the frame, in UNITths of a pixel */
  CS_ARRAY(cs_map_span, spans);
  /* of a coloured drawing: the light that the flat part of each span lets through */
  CS_ARRAY(cs_v4, through);
  CS_ARRAY(cs_map_share, shares);
  CS_ARRAY(cs_map_area, areas);  /* of the pixel that is being read: the areas that are not 0 */
  CS_ARRAY(uint64_t, near);      /* filled by near.c, if has_near */
  size_t first[CS_MAP_ROWS + 1]; /* the first span of each row, and the end of the last row's
                                    spans */
  size_t live_count, place_count, span_count, share_count, area_count, near_words;
  int32_t width; /* the width of the frame */
  bool has_near;
} cs_map_rows;

/* By how much a pixel exceeds the pixel on its left. Its size is half a line of the cache. */
typedef struct cs_map_sum {
  float colour[4];
  /* The same difference for keys, multiplied by HEIGHT, modulo 2^64. Some systems align it to 4. */
  _Alignas(8) uint64_t key;
  uint32_t head; /* the number of its first part, as cs_map_part.next */
} cs_map_sum;
_Static_assert(sizeof(cs_map_sum) == 32, "two sums are a line of the cache");

/* The same for the area of a cell that varies, in units of 1 / HEIGHT. */
typedef struct cs_map_part {
  int32_t change;
  uint32_t cell, next; /* next: 1 more than the next part of the pixel; 0: none */
} cs_map_part;

/* Room for the sums of a swath, cleared between uses: all drawings of a worker share it. They lie
 * column by column, since most borders go down rather than across. */
typedef struct cs_map_sums {
  cs_isa isa;
  int32_t width;    /* pixels of a row; there is one more column, which is not read */
  size_t words;     /* the words of a row of bits: a multiple of four */
  cs_map_sum *sums; /* column by column */
  uint32_t unread;  /* one bit for each row that has not been cleared yet */
  CS_ARRAY(unsigned char, storage); /* of the sums, which lie on lines of the cache */
  CS_ARRAY(uint64_t, bits);         /* row by row: the pixels to which something was added */
  CS_ARRAY(cs_map_part, parts);
  size_t part_count;
} cs_map_sums;
