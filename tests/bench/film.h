/* The film of the benchmark: a sheet of drawings under a pan and a zoom, and two drawings in front
 * of it, each on a way of its own. All that changes from frame to frame is where the drawings lie.
 *
 *   frame 0                          frame 48
 *   +--------------------+           +--------------------+
 *   | sheet   +--------+ |           | (part of the sheet)|
 *   |         | middle | |           |   +--------+       |
 *   | +-------+        | |    -->    |   | middl+--------+|
 *   | | front  |-------+ |           |   +------| front  ||
 *   | +--------+         |           |          +--------+|
 *   +--------------------+           +--------------------+
 */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

enum { BENCH_FILM_FRAMES = 48, BENCH_FILM_CELS = 3 };

/* Where the unit square of a drawing lies, in sides of the frame. */
typedef struct bench_place {
  double scale, x, y;
} bench_place;

/* cel: 0 the sheet, 1 and 2 the drawings in front of it, the nearest last. skia.js has the same. */
static inline bench_place bench_film_place(int frame, int cel) {
  double t = (double)frame / BENCH_FILM_FRAMES;
  const bench_place places[BENCH_FILM_CELS] = {{1 + 0.25 * t, -0.2 * t, -0.1 * t},
                                               {0.4, 0.55 - 0.3 * t, 0.1 + 0.013 * t},
                                               {0.45, 0.1 + 0.4 * t, 0.45 - 0.017 * t}};
  return places[cel];
}

#ifdef __cplusplus
}
#endif
