/* The painter: from the programs of cells to pixels and spans.
 *
 *     composer                          painter
 *     cell: one colour ------------------------------------> one span
 *     cell: program (layers, front to back)
 *            |-- colours.h   samples, over_row --> pixels
 *            `-- run.h       visible items     --> shown.h
 *                            a picture shows   --> pixels, or their codes
 *                            formulas only     --> few linear spans (gradient_lines.c)
 *                            one defocused cel --> from node to node (run.c)
 *
 * The composer says which layers are visible; the painter keeps the data that their colours need:
 * headers and texels of pictures, grids of defocused cels, folded gradients. It reads the
 * composer's programs and the procedure spans of the row, and changes nothing there.
 *
 * Invariant: a pixel depends on the program and its place alone, not on the run it is painted in.
 * One painter a worker, beside its composer.
 */
#pragma once

#include "base/arena.h"
#include "engine/compose/composer.h"
#include "engine/paint/ahead.h"
#include "engine/paint/shade.h"
#include "engine/sample/defocused.h"
#include "engine/sample/sampler.h"
#include "model/pictures/block_cache.h"

/* An image layer as this worker sees it: the header of its picture is read when it is needed. */
typedef struct cs_image_view {
  bool is_ready, is_opaque;
  cs_sampler sampler;
  cs_sampler medium; /* where the texture has one */
} cs_image_view;

/* The visible items of a program over some columns: shown.h. */
typedef struct cs_shown {
  CS_ARRAY(cs_item, items); /* those that are neither clear nor hidden there, front to back */
  uint32_t length;
  bool ends_opaque; /* nothing shines through them */
  bool is_sure;     /* this is known of every part of the columns */
} cs_shown;

/* What the columns show that a program was asked for last: shown.h. */
typedef struct cs_shown_kept {
  CS_ARRAY(cs_item, asked); /* the items of the program */
  uint32_t length;          /* 0: of none */
  int32_t stride;
  cs_run run; /* without columns: none are known */
  cs_shown shown;
} cs_shown_kept;

/* Pieces of a run of copied pictures: copies.c. */
typedef enum cs_copies_kind { CS_COPIES_OTHER, CS_COPIES_ONE, CS_COPIES_OVER } cs_copies_kind;

/* Columns up to x1. */
typedef struct cs_copies_piece {
  int32_t x1;
  cs_copies_kind kind;
  const unsigned char *front, *rear; /* the codes of the first column, in the plan's first row */
} cs_copies_piece;

/* The pieces of a run, on some rows. */
typedef struct cs_copies_plan {
  CS_ARRAY(cs_item, items); /* the items of the program */
  CS_ARRAY(cs_copies_piece, pieces);
  uint32_t length;
  int32_t x0, x1, row, end_row;
  uint32_t fetches; /* the fetches of blocks, when it was made */
  size_t count;
} cs_copies_plan;

/* Runs of copied pictures whose pieces are kept. */
#define CS_PAINTER_COPIES 16
/* Programs for which it is kept what they show. */
#define CS_PAINTER_SHOWN 64

/* The paint of a steady shade in the row that was asked for last. */
typedef struct cs_painter_steady {
  cs_shade_lanes paint;
  double y;
  bool is_found;
} cs_painter_steady;

typedef struct cs_painter {
  celspan_context *context;    /* the worker's branch */
  const cs_composer *composer; /* borrowed: its cells are painted; NULL: only programs are */
  const cs_stack *stack;
  cs_isa isa;                      /* the instructions that loops over pixels are made with */
  CS_ARRAY(cs_over_outer, outers); /* scratch, of folds; cs_stack_depth */
  CS_ARRAY(cs_image_view, images);
  CS_ARRAY(cs_block_cache, blocks); /* one: the blocks of its pictures; NULL without pictures */
  CS_ARRAY(cs_defocused_view, defocused);
  CS_ARRAY(cs_painter_steady, steady);     /* one for each shade */
  CS_ARRAY(cs_over_channels_ahead, ahead); /* two, or NULL: ahead.h */
  CS_ARRAY(cs_copies_plan, copies);        /* NULL without pictures: copies.c */
  CS_ARRAY(cs_shown_kept, kept);           /* NULL without pictures and defocused cels: shown.h */
  struct cs_gradient_tables *gradients;    /* NULL without formulas: gradient_table.h */
  int next_ahead;                          /* which of the two is replaced next */
  cs_arena scratch;                        /* the scratch of one run */
  cs_shown shown[2];    /* what the columns show that are painted now, and those right of them */
  uint64_t examined;    /* runs of columns that shown.c has examined */
  uint64_t evaluations; /* pixels whose colour has been computed */
} cs_painter;

/* stack: the programs' stack, borrowed; composer: initialized, borrowed; NULL: no cells will be
 * painted. The painter must not be moved.
 * Errors: NO_MEMORY; cs_painter_finish must be called then, too. */
CELSPAN_CHECKED celspan_status cs_painter_init(cs_painter *painter, celspan_context *context,
                                               const cs_stack *stack, const cs_composer *composer);
void cs_painter_finish(cs_painter *painter);

/* The question that the composer of the same worker asks the painter. The composer
 * gets it before the painter is initialized, and asks it when the first cell is composed. */
cs_image_opacity cs_painter_opacity(cs_painter *painter);

/* The view of an image layer, its header read on first use. Errors: INPUT, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_painter_image(cs_painter *painter, uint32_t image,
                                                const cs_image_view **out);

/* What a layer whose shade is steady (cs_shade.is_steady) adds in a row, lit and faded. */
cs_over_pair cs_painter_lit_steady(cs_painter *painter, const cs_layer *layer, double y);
