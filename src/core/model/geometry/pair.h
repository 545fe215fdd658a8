/* A pair: x and y of a point in one register. An operation acts on both, and gives the same bits as
 * it would for each number alone. */
#pragma once

#include <string.h>

#include "model/geometry/outline.h"

typedef double cs_pair __attribute__((vector_size(16)));

/* The first two numbers of a point. */
static inline cs_pair cs_pair_load(const cs_hpoint *point) {
  cs_pair pair;
  memcpy(&pair, point, sizeof pair);
  return pair;
}

static inline celspan_point cs_pair_point(cs_pair pair) {
  return (celspan_point){pair[0], pair[1]};
}

/* The lesser, or the greater, of both x and of both y. */
static inline cs_pair cs_pair_least(cs_pair a, cs_pair b) {
  return (cs_pair){a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1]};
}

static inline cs_pair cs_pair_most(cs_pair a, cs_pair b) {
  return (cs_pair){a[0] > b[0] ? a[0] : b[0], a[1] > b[1] ? a[1] : b[1]};
}

/* A point on the line from a to b. In this form the mean of two equal numbers is the same
 * number. */
static inline cs_pair cs_pair_between(cs_pair a, cs_pair b, double t) { return a + t * (b - a); }
