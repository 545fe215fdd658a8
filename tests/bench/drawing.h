/* Drawings: what every renderer of the benchmark draws, read from a text file of one shape a line,
 * back to front, over white. Coordinates lie in the unit square, colours are 8-bit, alpha straight.
 *
 *   drawing COUNT
 *   spline RULE PAINT  X Y X Y X Y X Y    a closed uniform cubic B-spline on four points
 *   path RULE PAINT  M X Y L X Y C X Y X Y X Y Z ...
 *
 * RULE is evenodd or nonzero. PAINT is a colour or a linear gradient:
 *
 *   R G B A
 *   across X X R G B A R G B A    from the first colour at the first column to the second at the
 *                                 second, held outside; both of one alpha
 *
 *      colour            far_colour
 *        |  :  :  :  :  :  |
 *   -----x0----------------x1-----> columns of the unit square
 *
 * Every renderer blends between codes as they are, as it blends flat colours; where alpha is the
 * same at both ends, straight and premultiplied values make the same gradient.
 *
 * INVARIANT: every shape has its outline as moves, lines and cubics; each contour begins with a
 * move.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct bench_point {
  double x, y;
} bench_point;

typedef enum bench_verb { BENCH_MOVE, BENCH_LINE, BENCH_CUBIC, BENCH_CLOSE } bench_verb;

typedef struct bench_segment {
  bench_verb verb;
  bench_point p[3]; /* the last that the verb uses is the end */
} bench_segment;

typedef struct bench_colour {
  uint8_t red, green, blue, alpha; /* straight */
} bench_colour;

typedef struct bench_shape {
  bench_colour colour;
  bool is_gradient;
  bench_colour far_colour; /* this and the columns: of a gradient */
  double x0, x1;
  bool is_evenodd, is_spline;
  bench_point spline[4];
  const char *data; /* path data of a shape that is no spline */
  const bench_segment *segments;
  size_t segment_count;
  double top, bottom; /* rows of the unit square that the control points span */
} bench_shape;

typedef struct bench_drawing {
  bench_shape *shapes;
  size_t shape_count;
  double crossings; /* of edges with a row, on average over the rows of the unit square */
} bench_drawing;

/* Reads a drawing, or ends the program with a sentence. */
bench_drawing bench_drawing_read(const char *path);
void bench_drawing_free(bench_drawing *drawing);

#ifdef __cplusplus
}
#endif
