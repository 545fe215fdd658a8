/* Sine, cosine, exponential, logarithm and power with the same bits on every machine and
 * under every compiler: plain IEEE arithmetic, no libm, no fused operations. Relative error below
 * 4e-16 (sine, cosine: absolute) for arguments in the ranges celspan meets.
 */
#pragma once

void cs_elementary_sincos(double radians, double *sine, double *cosine);
double cs_elementary_tan(double radians);
double cs_elementary_atan2(double y, double x);
double cs_elementary_exp(double x);
double cs_elementary_log(double x);                     /* x > 0 */
double cs_elementary_pow(double base, double exponent); /* base >= 0 */
