/* The composer: from the layers present at a place of a row to the colour of the cell there, or to
 * the short program that gives its colour pixel by pixel.
 *
 *     boundaries of a row, from left to right
 *        |         |   |            |
 *        | --------> cross ---------> |          the walk: sets, windings, hash
 *               cell |
 *                    v
 *       hash known? ----yes----> the same cell as before (not asked where a tree folds)
 *            | no
 *       trees: what contributes (tree.h)
 *            |
 *       all of it flat? --yes--> one colour (over.h, over_table.h)
 *            | no
 *       the layers that are not hidden, front to back = a program, for paint/ to paint
 *
 * Invariants
 *   - The running set, windings and hash describe the place of the walk; crossing the same boundary
 *     back undoes a crossing.
 *   - The colour of a cell depends on its set alone, never on the way it was reached: a cell whose
 *     hash is known is not composed again.
 *   - A program lists the contributing layers front to back, cut where nothing shines through.
 * One composer a worker; the stack is shared.
 */
#pragma once

#include "engine/compose/cell.h"
#include "engine/compose/over_table.h"
#include "engine/compose/tree.h"

typedef struct cs_memo {
  cs_cell cell;
  bool is_used;
} cs_memo;

/* The one question that the composer asks the painter: whether the picture of an image layer is
 * opaque wherever the layer is present. A picture that cannot be read is not opaque. */
typedef struct cs_image_opacity {
  bool (*is_opaque)(void *painter, uint32_t image);
  void *painter; /* borrowed */
} cs_image_opacity;

typedef struct cs_composer {
  celspan_context *context; /* the worker's branch */
  const cs_stack *stack;
  cs_image_opacity opacity;
  CS_ARRAY(uint64_t, set);          /* layers present at the place of the walk */
  CS_ARRAY(uint8_t, filled);        /* 1 where a word of the set is not 0: see set.h */
  CS_ARRAY(uint64_t, contributing); /* scratch */
  CS_ARRAY(cs_presence, presences); /* one for each layer */
  /* the span of a layer at the place of the walk; NULL without scan-line layers */
  CS_ARRAY(uint32_t, procedure_span_of);
  CS_ARRAY(cs_tree_result, results);
  CS_ARRAY(cs_over_outer, outers); /* memory for folds; cs_stack_depth items */
  CS_ARRAY(cs_over_table, table);  /* one, or NULL if it does not suit the stack */
  CS_ARRAY(cs_memo, memo);
  CS_ARRAY(cs_item, items);                     /* the items of all programs in use */
  CS_ARRAY(cs_item, gathered);                  /* scratch: the items of the cell being composed */
  CS_ARRAY(cs_procedure_span, procedure_spans); /* spans of the current row */
  size_t item_count, gathered_count, procedure_span_count;
  cs_set_hash hash;     /* the hash of the set */
  bool is_flat;         /* cs_composer_is_flat */
  uint64_t evaluations; /* cells composed */
  /* the first failure of the row, recorded in the context; kept until the row ends */
  celspan_status failure;
} cs_composer;

/* Whether all layers are flat, in no group and in front of all back lights. */
bool cs_composer_is_flat(const cs_stack *stack);

/* Errors: NO_MEMORY; cs_composer_finish must be called then, too. */
CELSPAN_CHECKED celspan_status cs_composer_init(cs_composer *composer, celspan_context *context,
                                                const cs_stack *stack, cs_image_opacity opacity);
void cs_composer_finish(cs_composer *composer);
/* Before each row: forgets the procedure spans, and the programs if there are many. Returns whether
 * earlier cells are no longer valid. */
bool cs_composer_begin_row(cs_composer *composer);

/* Moves the walk back to the left end of the row from any place where a failure has stopped it. */
void cs_composer_restart(cs_composer *composer);

/* Crosses a boundary of a layer from left to right; direction: the direction in which the boundary
 * runs, +1 or -1. */
static inline void cs_composer_cross(cs_composer *composer, uint32_t layer, int32_t direction) {
  cs_set_cross(composer->presences, composer->set, composer->filled, &composer->hash, layer,
               direction);
}

/* Enters (+1) or leaves (-1) a procedure span of a scan-line layer. */
void cs_composer_cross_span(cs_composer *composer, uint32_t layer, uint32_t procedure_span,
                            int32_t direction);

/* The cell at the place of the walk. On failure the cell is clear and composer->failure is set. */
void cs_composer_cell(cs_composer *composer, cs_cell *out);

/* The transmission of the cell at the place of the walk, channel by channel; lane 3: the mean of
 * the channels. The cell must have one colour, and the stack must have no back lights. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_composer_through(cs_composer *composer, cs_v4 *out);

/* Whether two cells look the same everywhere. */
bool cs_composer_same(const cs_composer *composer, const cs_cell *a, const cs_cell *b);

/* The program of a cell whose length is not 0, valid until the next cell is composed. */
cs_program cs_composer_program(const cs_composer *composer, const cs_cell *cell);
