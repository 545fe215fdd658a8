/* How the paper lies in its scan, by its four sides. */
#pragma once

#include "tools/scan/rough.h"

typedef struct cs_paper_found {
  double turn;  /* radians clockwise, of the paper */
  double x, y;  /* of its middle, in pixels */
  double error; /* radians: how far a side is from its direction */
} cs_paper_found;

/* Returns false if a side of the paper is not in the picture. */
bool cs_paper_find(const cs_rough *page, cs_paper_found *out);
