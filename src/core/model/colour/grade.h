/* Grades: changes of a colour, step by step, in the numbers of a space.
 *
 *   exposure   slope, offset  power   contrast  saturation  hue  temperature, tint
 *   '------- affine -------'   c^p    '---------- one affine map a space --------'
 *
 *   gamma    matrix   curves   steps    table         steps: in codes; table: in codes or in light
 *   |c|^1/g  affine            _|--
 *
 * Invariant: steps that would do nothing are left out, so that a colour stays as it is, to the bit,
 * where all of them do nothing; the result is finite.
 */
#pragma once

#include "model/colour/cube.h"
#include "model/colour/keying.h"
#include "model/colour/space.h"

#define CS_GRADE_POINTS 1024    /* points of a curve, at most */
#define CS_GRADE_STEPS 256      /* steps of a code, at most */
#define CS_GRADE_BORDER 0x1p-16 /* a share of a step: half a code of 15 bits */
#define CS_GRADE_MOST 1e12 /* between two steps, colours are clamped to this and its negative */

/* A map of colours: each row makes one channel of the result from the channels of the colour and
 * 1. */
typedef struct cs_grade_map {
  bool is_given;
  double rows[3][4];
} cs_grade_map;

/* A monotone cubic through points, straight beyond the first and the last. */
typedef struct cs_grade_curve {
  /* x: input, ascending; y: output. Without points there is no curve. Owned */
  celspan_point *points;
  double *slopes; /* at the points; owned */
  size_t count;
} cs_grade_curve;

typedef struct cs_grade {
  cs_grade_map cdl;                /* exposure, slope and offset, where there is a CDL */
  double power[3];                 /* behind these */
  cs_grade_map balance[CS_SPACES]; /* everything up to tint that is not in `cdl` */
  double exponent;                 /* 1 / gamma */
  cs_grade_map matrix;
  cs_grade_curve curves[3];
  int steps;                /* the steps of codes; 0: none */
  celspan_space cube_space; /* the space in which the numbers of the table are */
  cs_cube *cube;            /* NULL: none. A reference */
  cs_keying keying;         /* where it is given, there are no steps, and the alpha changes, too */
} cs_grade;

/* desc: checked before. Fills everything except the cube. Errors: NO_MEMORY; *out must be finished
 * in this case, too. */
CELSPAN_CHECKED celspan_status cs_grade_make(celspan_context *context,
                                             const celspan_grade_desc *desc, cs_grade *out);
void cs_grade_finish(cs_grade *grade, cs_memory *memory);

/* Replaces a colour by the graded one. The colour was divided by its alpha before. */
void cs_grade_colour(const cs_grade *grade, celspan_space space, double colour[3]);
/* Replaces premultiplied light by the graded light. alpha: the coverage; light without coverage is
 * graded as if its coverage were its brightness. */
void cs_grade_light(const cs_grade *grade, celspan_space space, float alpha, float light[3]);
