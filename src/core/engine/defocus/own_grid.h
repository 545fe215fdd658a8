/* The grid of a cel's own: where a defocused cel is blurred once for all the frames in which it is
 * only moved or enlarged.
 *
 *        the cel's units                 the cel's own grid               a frame
 *      +-----------------+  matrix     o  o  o  o  o  o  o   a map    +-----------+
 *      |  0,0            |  =======>   o  o  o +-----------+ =======> |           |
 *      |                 |             o  o  o |o  o  o  o | by axis  |           |
 *      +-----------------+             o  o  o +-----------+          +-----------+
 *                                      |<-- the part that is made -->|
 *
 * The rows of nodes lie along the frame's axes, as the cel is turned there, and the unit 0, 0 of
 * the cel lies at a whole place. How far the nodes are apart follows from the radius in the cel's
 * units; where samples of pictures must be as fine as pixels, from the class of the scale too.
 * Scales from the fourth root of 2 above the one below it are one class, so nodes are at most 1.19
 * times too dense. The part of the grid that is made is rounded outward to multiples of many nodes,
 * so that a pan rarely leaves it.
 *
 * Invariant: the grid is a function of the cel's artwork, its placement and blur, and the size of
 * the frame; of the placement and the size only the class, the direction of the axes and the part
 * matter. Nothing depends on crops, on workers, on memory, or on other frames.
 */
#pragma once

#include "engine/defocus/defocus.h"

/* A cel of a frame. */
typedef struct cs_defocus_cel {
  const celspan_rostrum *rostrum;
  /* a cel of the rostrum, or a similar one that has only the object below */
  const celspan_cel *cel;
  celspan_matrix to_pixels; /* film units to pixels */
  double film_width, film_height;
  celspan_matrix matrix;   /* the cel's units to pixels */
  cs_boundary_frame frame; /* the part of the plane that can be seen, its margin included */
  int32_t width, height;   /* the width and height of the frame, pixels */
  bool is_antialiased;
  celspan_space space;      /* in which it is blurred */
  bool is_source;           /* a mode or a matte shows it pixel by pixel */
  celspan_object *extended; /* a cel's objects, continued (layer.c); NULL: its own objects */
} cs_defocus_cel;

typedef struct cs_own_grid {
  celspan_matrix matrix; /* the cel's units to pixels of the part; a node is one pixel */
  int32_t size[2];       /* the size of the part */
  cs_blur blur;          /* in pixels of the part */
  double samples;        /* the least number of samples in the radius, where samples are summed */
  double scale[2], offset[2]; /* by axis, pixels of the frame to pixels of the part */
} cs_own_grid;

/* varies: the cel has layers that vary between their boundaries. blur: in pixels of the frame.
 * False where the cel must be blurred for the frame alone: in perspective, where the radius is
 * small, where even kernels are not smooth on any grid as coarse as pixels, and very far from the
 * cel's origin. */
bool cs_own_grid_find(const cs_defocus_cel *place, const cs_blur *blur, bool varies,
                      cs_own_grid *out);
