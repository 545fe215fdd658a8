/* The program's Lua uses the engine's functions, also for the operator ^, so that scripts give the
 * same bits everywhere: the linker replaces the functions of the C library by these. */
#include "inside/elementary.h"

#define WRAP(name, function)                                                                       \
  double __wrap_##name(double x);                                                                  \
  double __wrap_##name(double x) { return function(x); }
#define WRAP_TWO(name, function)                                                                   \
  double __wrap_##name(double x, double y);                                                        \
  double __wrap_##name(double x, double y) { return function(x, y); }

WRAP(sin, cs_function_sin)
WRAP(cos, cs_function_cos)
WRAP(tan, cs_function_tan)
WRAP(asin, cs_function_asin)
WRAP(acos, cs_function_acos)
WRAP_TWO(atan2, cs_function_atan2)
WRAP(exp, cs_elementary_exp)
WRAP(log, cs_elementary_log)
WRAP(log2, cs_function_log2)
WRAP(log10, cs_function_log10)
WRAP_TWO(pow, cs_function_pow)
