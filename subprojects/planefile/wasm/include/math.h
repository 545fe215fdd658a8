/* For modules: the module's own instructions. */
#pragma once
#define sqrt __builtin_sqrt
#define fabs __builtin_fabs
#define floor __builtin_floor
#define ceil __builtin_ceil
#define isfinite __builtin_isfinite
#define isnan __builtin_isnan
static inline double fmin(double a, double b) { return a < b || b != b ? a : b; }
static inline double fmax(double a, double b) { return a > b || b != b ? a : b; }
#define NAN __builtin_nanf("")
#define INFINITY __builtin_inff()
