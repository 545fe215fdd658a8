/* The visible boxes of the patterns of a frame.
 *
 *     plane of a pattern                     object in its place
 *     few boxes in view                       a union of rostrums, one for each box: exact
 *     many                                    a rectangle with a picture of one box, which repeats
 *
 * The picture is made by the compiler that makes the frame, in about the size in which the box is
 * seen, so that it is sharp, and costs what one box of pixels does, however often it is repeated.
 * It is made once for all places where it is seen in one size, so that patterns inside patterns do
 * not multiply.
 *
 * Invariant: which of the two it is depends on the scene and the frame's size alone.
 */
#pragma once

#include "frames/render/compiler.h"

/* A picture of a pattern that was made for this frame. */
typedef struct cs_patterns_picture {
  cs_hash tile; /* the tile of the rostrum that it shows */
  int32_t width, height;
  celspan_space space;
  celspan_texture *texture; /* a reference */
} cs_patterns_picture;

/* The patterns of a frame, with everything that is compiled alone for it. All zero is empty. */
typedef struct cs_patterns {
  cs_patterns_picture *pictures;
  size_t count, capacity;
  size_t copies; /* primitives in boxes that are copied */
} cs_patterns;

void cs_patterns_finish(cs_patterns *patterns, cs_memory *memory);
/* *out: new; the objects that show the plane, in its units. The pictures that it shows are kept by
 * the plan. matrix: the plane's units to pixels. Errors: those of the compiler. */
CELSPAN_CHECKED celspan_status cs_patterns_expand(cs_compiler *c, const cs_primitive_data *plane,
                                                  const celspan_matrix *matrix,
                                                  celspan_object **out);
