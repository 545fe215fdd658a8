/* A cel that is changed by a rule of its own (model/scene/nearby.h), except what is sharpened: each
 * node is a function of the samples around it.
 *
 *     . . . . . .    the samples are as far apart as the nodes (o), and each is the mean over its
 *     . o o o o .    area; an extent of further ones lies around the nodes
 *     . o o o o .
 *     . . . . . .    those beyond an edge of the rule's box are those on the edge, where it says so
 */
#pragma once

#include "engine/row/row.h"
#include "model/scene/nearby.h"

typedef struct cs_defocus_neighbours {
  cs_nearby *rule;          /* a reference; NULL: there is none */
  int32_t extent[2];        /* samples beyond the nodes on each side */
  int32_t first[2], end[2]; /* the samples of the rule's box, by axis */
  celspan_matrix to_units;  /* from samples */
  double slope[2][2];       /* samples in a unit: how much column and row grow with x and y */
  float colour[3];          /* the colour of a light, in the space of the samples */
} cs_defocus_neighbours;

void cs_defocus_neighbours_init(cs_defocus_neighbours *neighbours, cs_nearby *rule);
/* to_samples: from the cel's units, affine. Errors: BAD_ARGUMENT where that has no area. */
CELSPAN_CHECKED celspan_status cs_defocus_neighbours_place(celspan_context *context,
                                                           cs_defocus_neighbours *neighbours,
                                                           const celspan_matrix *to_samples,
                                                           celspan_space space);
void cs_defocus_neighbours_finish(cs_defocus_neighbours *neighbours);
/* Fills the rows [first, end) of `columns` nodes each. maker: of the samples. Errors: those of its
 * rows. */
CELSPAN_CHECKED celspan_status cs_defocus_neighbours_fill(const cs_defocus_neighbours *neighbours,
                                                          cs_row_maker *maker, int32_t columns,
                                                          int32_t first, int32_t end,
                                                          float (*nodes)[4]);
