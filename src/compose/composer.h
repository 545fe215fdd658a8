/* The composer: from the leaves present in a cell to its colour, or to the short program that gives
 * its colour along a row.
 *
 *   walk along a row --cross--> set of leaves present --cell--> colour or program --run--> spans
 *
 * Invariants
 *   - The running set, windings and hash describe the place the walk stands at; crossing the same
 *     boundary back undoes a crossing.
 *   - The colour of a cell depends on its set alone, never on the way it was reached: a cell whose
 *     hash is known is not composed again.
 *   - A program lists the contributing leaves front to back, cut where nothing shines through.
 * One composer a worker; the stack is shared.
 */
#ifndef CS_COMPOSE_COMPOSER_H
#define CS_COMPOSE_COMPOSER_H

#include "compose/cell.h"
#include "compose/over_table.h"

/* A leaf at the walk's place. */
typedef struct cs_presence {
  cs_layer_rule rule;
  int32_t winding;
} cs_presence;

typedef struct cs_memo {
  cs_cell cell;
  bool is_used;
} cs_memo;

/* The one thing the composer has to ask those who paint: whether the picture of an image layer lets
 * nothing through, wherever the layer is present. A picture that cannot be read does not. */
typedef struct cs_image_opacity {
  bool (*is_opaque)(void *painter, uint32_t image);
  void *painter; /* borrowed */
} cs_image_opacity;

typedef struct cs_composer {
  celspan_context *context; /* the worker's branch */
  const cs_stack *stack;
  cs_image_opacity opacity;
  uint64_t *set;          /* leaves present at the walk's place */
  uint8_t *filled;        /* whether a word of the set is not 0; a multiple of eight of them */
  uint64_t *contributing; /* scratch */
  cs_presence *presences; /* one a leaf */
  uint32_t
      *procedure_span_of; /* a leaf's strip at the walk's place; NULL without scan-line leaves */
  cs_set_hash hash;
  cs_tree_result *results;
  cs_over_table *folds; /* NULL where leaves are not all plain */
  cs_memo *memo;
  cs_item *items;
  size_t item_count, item_capacity;
  cs_item *gathered; /* scratch: the items of the cell being composed */
  size_t gathered_count, gathered_capacity;
  cs_procedure_span *procedure_spans; /* of the current row */
  size_t procedure_span_count, procedure_span_capacity;
  uint64_t evaluations;   /* cells composed */
  celspan_status failure; /* sticky: the first failure of the row, recorded in context */
} cs_composer;

CELSPAN_CHECKED celspan_status cs_composer_init(cs_composer *composer, celspan_context *context,
                                                const cs_stack *stack, cs_image_opacity opacity);
void cs_composer_finish(cs_composer *composer);
/* Before each row: forgets strips, and programs when they have grown many; true when cells made
 * before are no longer valid. */
bool cs_composer_begin_row(cs_composer *composer);

/* Puts the walk back to where nothing is present, from wherever a failure left it. */
void cs_composer_restart(cs_composer *composer);

/* What crossing a boundary of `leaf` does to its presence, the set and the set's hash. */
static inline void cs_composer_turn(cs_presence *presences, uint64_t *set, uint8_t *filled,
                                    cs_set_hash *hash, uint32_t layer, int32_t direction) {
  cs_presence *presence = &presences[layer];
  const cs_layer_rule *rule = &presence->rule;
  int32_t before = presence->winding, after = before + direction;
  presence->winding = after;
  /* Whether it flips can hardly be foreseen, so nothing here is a branch. */
  uint64_t flips = ((before & rule->winding_mask) != 0) != ((after & rule->winding_mask) != 0);
  uint64_t word = set[layer / 64] ^ flips << (layer % 64);
  set[layer / 64] = word;
  filled[layer / 64] = word != 0;
  hash->a ^= rule->key[0] & -flips;
  hash->b ^= rule->key[1] & -flips;
}

/* Crosses a boundary of `leaf` that runs in `direction` (+1, -1), from left to right. */
static inline void cs_composer_cross(cs_composer *composer, uint32_t layer, int32_t direction) {
  cs_composer_turn(composer->presences, composer->set, composer->filled, &composer->hash, layer,
                   direction);
}

/* Enters (+1) or leaves (-1) a strip of a scan-line leaf. */
void cs_composer_cross_span(cs_composer *composer, uint32_t layer, uint32_t procedure_span,
                            int32_t direction);

/* The cell at the walk's place. On failure the cell is clear and composer->failure is set. */
void cs_composer_cell(cs_composer *composer, cs_cell *out);

/* Whether two cells look alike everywhere. */
bool cs_composer_same(const cs_composer *composer, const cs_cell *a, const cs_cell *b);

/* The program of a cell whose length is not 0, valid until the next cell is composed. */
cs_program cs_composer_program(const cs_composer *composer, const cs_cell *cell);
#endif
