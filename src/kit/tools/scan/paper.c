#include "tools/scan/paper.h"

#include <math.h>

#include "inside/elementary.h"

/* Where the upright line x = at[0] + at[1] y meets the level line y = across[0] + across[1] x. */
static celspan_point meet(const double at[2], const double across[2]) {
  double x = (at[0] + at[1] * across[0]) / (1 - at[1] * across[1]);
  return (celspan_point){x, across[0] + across[1] * x};
}

bool cs_paper_find(const cs_rough *page, cs_paper_found *out) {
  double lines[4][2], turns[4];
  for (int side = 0; side < 4; side++) {
    const double *edge = page->edges[side];
    double far = side < 2 ? 0 : side == 2 ? page->scan.width : page->scan.height;
    if (!page->has_edge[side])
      return false;
    lines[side][0] = side < 2 ? edge[0] : far - edge[0];
    lines[side][1] = side < 2 ? edge[1] : -edge[1];
    turns[side] = cs_elementary_atan2(side % 2 == 0 ? -lines[side][1] : lines[side][1], 1);
  }
  *out = (cs_paper_found){.turn = (turns[0] + turns[1] + turns[2] + turns[3]) / 4};
  for (int side = 0; side < 4; side++) {
    double off = fabs(turns[side] - out->turn);
    celspan_point corner = meet(lines[side & 2], lines[side % 2 == 0 ? 1 : 3]);
    out->x += corner.x / 4;
    out->y += corner.y / 4;
    out->error = off > out->error ? off : out->error;
  }
  return true;
}
