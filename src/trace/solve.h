/* Systems of a few linear equations. */
#ifndef CS_TRACE_SOLVE_H
#define CS_TRACE_SOLVE_H

#include <stdbool.h>

/* Solves n equations of n unknowns by elimination, the largest pivots first. m: n rows of n + 1 numbers,
 * what multiplies each unknown and then what the row is equal to, which becomes the solution. Returns
 * false where a pivot is below `least`. */
bool cs_solve(double *m, int n, double least);

#endif
