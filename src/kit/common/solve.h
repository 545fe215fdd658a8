/* Systems of a few linear equations. */
#pragma once

#include <stdbool.h>

/* Solves n equations of n unknowns by elimination with the largest pivots.
 *
 *     rows    stride = 5, n = 3
 *             a00 a01 a02 | b0  .      the factors of each unknown, then the value of the row
 *             a10 a11 a12 | b1  .
 *             a20 a21 a22 | b2  .
 *
 * The rows are overwritten. Returns false where no pivot is above `least`, that is, where the
 * equations do not determine the unknowns. */
bool cs_solve(double *rows, int n, int stride, double least, double *out);
