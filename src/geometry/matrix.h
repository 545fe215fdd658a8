/* 3x3 homogeneous matrices, row-major, column vectors. */
#ifndef CS_GEOMETRY_MATRIX_H
#define CS_GEOMETRY_MATRIX_H

#include "celspan/celspan.h"
#include "geometry/outline.h"

cs_hpoint cs_matrix_apply(const celspan_matrix *matrix, cs_hpoint point);
bool cs_matrix_is_sane(const celspan_matrix *matrix); /* every entry passes cs_number_is_sane */
bool cs_matrix_is_affine(const celspan_matrix *matrix);
/* Affine without rotation or skew: rows stay rows and columns columns. */
bool cs_matrix_is_upright(const celspan_matrix *matrix);
/* The same map with all signs turned where that brings an affine one before the horizon. */
celspan_matrix cs_matrix_facing(const celspan_matrix *matrix);

#endif
