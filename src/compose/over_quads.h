/* Quads: the light of every choice of four neighbouring flat layers, made beforehand.
 *
 *     word of a set   [0110 | 0000 | ... | 1011 | 0100]     64 layers, 16 quads
 *                                     |
 *                  quad 1 of 16:   0000  0001  0010  ...  1011  ...  1111
 *                                  clear                  layers 7, 5, 4, one over the other
 *
 * The fold by table (over_table.h) and the fold by tree (over_tree.h) begin with these.
 */
#ifndef CS_COMPOSE_OVER_QUADS_H
#define CS_COMPOSE_OVER_QUADS_H

#include "compose/over.h"

#define CS_OVER_FOUR 4     /* layers of a quad */
#define CS_OVER_QUADS 16   /* of a word */
#define CS_OVER_CHOICES 16 /* of the layers of a quad */

/* A flat layer by itself; clear beyond the last layer. */
static inline cs_over_pair cs_over_layer_pair(const cs_stack *stack, size_t layer) {
  if (layer >= stack->layer_count)
    return cs_over_pair_clear;
  return (cs_over_pair){stack->layers[layer].s, stack->layers[layer].t};
}

/* Adds the layers of word i of a set to the light of what is in front of them, one by one from the
 * front, until nothing shines through. */
cs_over_pair cs_over_word_layers(const cs_stack *stack, cs_over_pair light, size_t i,
                                 uint64_t word);

/* Makes the quads of word i, CS_OVER_CHOICES pairs each. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_over_quads_create(celspan_context *context, const cs_stack *stack,
                                                    size_t i, cs_over_pair **out);
void cs_over_quads_free(cs_over_pair *quads, cs_memory *memory);

#endif
