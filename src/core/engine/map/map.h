/* Maps: the drawing of a cel, reduced to what can be seen of it.
 *
 *       a --------.
 *       |  red   /            border: a piece of a visible boundary, with the cell on its left and
 *       |   .---/---.                 the cell on its right
 *       |  /   / blue|        cell:   a colour, or a program; cell 0 is clear, around the whole
 *       b-+---c      |                drawing
 *          `--------'         borders of red: a to b, clear | red; a to c, red | clear, and from
 *                             where blue begins on, red | blue
 *
 * No order is kept: each border says by how much the colour changes from its left to its right,
 * so what is right of any set of borders is a sum (sums.h). Flat boundaries change no sum: only a
 * map that is turned has them (turn.h). The programs of gradients and pictures name
 * layers of a stack that the map keeps: its formulas and pictures lie on the raster, and are put
 * into their place in each frame (brush.h).
 *
 *       zone 0 ----|--------\----    A raster has zones of rows, and no border crosses the top of
 *              |   |         \       a zone. So a zone is the same whichever others are made: where
 *       zone 1 ----|----------\--    few rows of a frame are wanted, the map has some zones alone.
 *              |   |           \     A zone with too many windings is missing.
 *
 * Units: a raster of the drawing at a scale of its own, in 2^-16 of its pixels. The raster begins
 * at a whole pixel, so that equal boundaries of two drawings at one scale have equal points.
 *
 * Invariant: at any height, the borders that cross it lead from cell 0 to cell 0, each with the
 * cell on its left that the border before it has on its right.
 */
#pragma once

#include <math.h>
#include <stdatomic.h>

#include "engine/compose/cell.h"
#include "engine/row/plan.h"

#define CS_MAP_UNIT 65536    /* parts of a pixel of the raster */
#define CS_MAP_SIDE 16384    /* pixels of a raster's side, at most */
#define CS_MAP_CELLS 1048576 /* at most */
#define CS_MAP_ZONES 64      /* at most, by the bits of cs_map.missing */
/* The key of a cell: its number in 20 bits, and 28 bits of a hash. */
#define CS_MAP_KEY UINT64_C(0xffffffffffff)

typedef struct cs_map_cell {
  cs_v4 colour;         /* premultiplied, under white light; 0 where it varies */
  uint64_t key;         /* identifies the cell in sums of areas: see sums.h */
  uint32_t item;        /* the index in the map's items of the first item of its program */
  uint32_t length : 31; /* items; 0: one colour everywhere */
  uint32_t hides : 1;   /* nothing shines through its program */
} cs_map_cell;

typedef struct cs_map_point {
  int32_t x, y;
} cs_map_point;

typedef struct cs_map_border {
  uint32_t left, right;    /* the cells on both sides, which differ */
  uint32_t first, count;   /* points, at least two, downwards */
  int32_t low, high, foot; /* the least and the greatest x of the border, and its last y */
} cs_map_border;

typedef struct cs_map_lines {
  CS_ARRAY(cs_map_border, borders); /* by their first points */
  CS_ARRAY(cs_map_point, points);
  size_t border_count, point_count;
} cs_map_lines;

/* A flat boundary, from `from` to `to` on the right of it. */
typedef struct cs_map_flat {
  uint32_t above, below; /* the cells on both sides, which differ */
  int32_t y, from, to;
} cs_map_flat;

typedef struct cs_map {
  atomic_size_t references;
  cs_memory *memory;
  /* some flat cell dims the channels differently; cells that vary dim them alike */
  bool is_coloured;
  bool is_whole;        /* false: the drawing cannot be a map, and the other fields are empty */
  int64_t left, top;    /* where the raster begins, in its pixels from the drawing's origin */
  int32_t height, zone; /* pixels of the raster, and of a zone */
  uint64_t missing;     /* bit k: zone k was requested, but has too many windings */
  cs_map_lines lines;
  CS_ARRAY(cs_map_flat, flats); /* only of a map that is turned */
  CS_ARRAY(cs_map_cell, cells);
  /* Of a coloured map: the transmission of each cell; lane 3: its mean; 0 where the cell varies.
   * NULL for other maps. */
  CS_ARRAY(cs_v4, through);
  CS_ARRAY(cs_item, items); /* the items of the programs */
  cs_stack stack;           /* the stack that the programs refer to; empty if all cells are flat */
  size_t flat_count, cell_count, item_count;
} cs_map;

void cs_map_lines_finish(cs_map_lines *lines, cs_memory *memory);
/* The border whose points are the last points of the list, from `first` on. It is not added to the
 * list. */
cs_map_border cs_map_lines_border(const cs_map_lines *lines, size_t first, uint32_t left,
                                  uint32_t right);
/* Finds the order of borders by their first points, in the numbers of the keys, one for each.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_lines_order(celspan_context *context,
                                                  const cs_map_point *tops, size_t count,
                                                  uint64_t *keys);
/* Makes room for given numbers of borders and points, above 0, and no more. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_lines_make(celspan_context *context, size_t borders,
                                                 size_t points, cs_map_lines *out);
/* Brings the borders into their order: by the y of their first points, then by x; borders that
 * begin at one point keep their order. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_lines_sort(celspan_context *context, cs_map_lines *lines);

/* An empty map that is not whole. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_create(celspan_context *context, cs_map **out);
void cs_map_ref(cs_map *map);
void cs_map_unref(cs_map *map); /* NULL is ignored; any thread */
size_t cs_map_bytes(const cs_map *map);
/* Whether a plan of a drawing alone can be a map: it has no procedures, lights or blurs. */
bool cs_map_suits(const cs_plan *plan);
/* Fills a map with a plan that suits, whose raster begins at the pixel (map->left, map->top). The
 * map is not whole if a cell that varies does not let all channels through alike. If cells vary,
 * the map takes the plan's stack. first, end: the rows for which it is made, whole zones; the plan
 * may have only these rows. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_make(celspan_context *context, cs_plan *plan, int32_t first,
                                           int32_t end, cs_map *map);

/* Gives an empty map its raster's height. */
static inline void cs_map_divide(cs_map *map, int32_t height) {
  map->height = height;
  for (map->zone = 32; map->zone * CS_MAP_ZONES < height;)
    map->zone *= 2;
}

/* The zones, from *first to before *end, that contain certain rows of a raster. */
static inline void cs_map_find_zones(const cs_map *map, double row, double end_row, int32_t *first,
                                     int32_t *end) {
  const double last = (map->height - 1) / map->zone + 1;
  *first = (int32_t)fmin(fmax(floor(row / map->zone), 0), last);
  *end = (int32_t)fmin(fmax(ceil(end_row / map->zone), *first), last);
}
