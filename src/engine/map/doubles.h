/* Vectors of four doubles, for the wide files of this folder (base/wide.h): a colour in sums. */
#pragma once

#include <string.h>

/* Functions that return such vectors are inlined, so how they would be returned does not matter. */
#pragma GCC diagnostic ignored "-Wpsabi"
typedef double cs_doubles __attribute__((vector_size(32)));

static inline cs_doubles cs_doubles_load(const double *from) {
  cs_doubles v;
  memcpy(&v, from, sizeof v);
  return v;
}
