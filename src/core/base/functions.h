/* The functions of math.h that differ between C libraries, for all numbers: base/elementary.h, and
 * the results that C demands for infinities and for arguments outside the domain.
 *
 * Invariant: the bits are the same everywhere, except the sign of what is not a number. A zero
 * keeps its sign.
 */
#pragma once

double cs_function_sin(double x);
double cs_function_cos(double x);
double cs_function_tan(double x);
double cs_function_asin(double x);
double cs_function_acos(double x);
double cs_function_atan2(double y, double x);
double cs_function_log2(double x); /* whole powers of two are exact */
double cs_function_log10(double x);
double cs_function_pow(double base, double exponent);
