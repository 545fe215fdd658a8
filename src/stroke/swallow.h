/* Where discs of a curve begin or cease to be inside their neighbours.
 *
 *      .---------.        A disc that grows by more than its centre goes on is swallowed by the next
 *    .'  .----.   '.      one: |r'| >= |c'|. With c = p / w that is where the polynomial
 *    |  ( *--* )   |         (r' w^2)^2 - |p' w - p w'|^2
 *    '.  '----'   .'      is not below 0. All of its changes of sign are found, whatever the size at
 *      '---------'        which the curve is drawn, for it has no more of them than its degree tells.
 */
#ifndef CS_STROKE_SWALLOW_H
#define CS_STROKE_SWALLOW_H

#include "stroke/curve.h"

#define CS_SWALLOW_CHANGES (2 * (CS_STROKE_RADIUS_DEGREE - 1 + 2 * CS_BEZIER_DEGREE))

/* Parameters inside (0, 1) where that changes, ascending; their number. */
int cs_swallow_changes(const cs_curve *curve, double changes[CS_SWALLOW_CHANGES]);
bool cs_swallow_at(const cs_curve *curve, double t);

#endif
