/* The fold of a program over many pixels: light gathered and what still shines through, pixel by
 * pixel, from the camera backwards.
 *
 *   begin, then for every item from the front: reach its leaf, paint; end
 *
 * Invariant: a pixel's colour is the same whatever pixels stand beside it, and whichever
 * instructions made it.
 */
#ifndef CS_PAINT_OVER_ROW_H
#define CS_PAINT_OVER_ROW_H

#include "base/arena.h"
#include "base/wide.h"
#include "compose/over.h"

#define CS_OVER_ROW_BATCH 256 /* pixels, a multiple of those in a register */

/* Four floats a pixel; lane 3 is of no account. */
typedef struct cs_over_row_level {
  float e[CS_OVER_ROW_BATCH][4], t[CS_OVER_ROW_BATCH][4]; /* light gathered, and transmission */
} cs_over_row_level;

typedef struct cs_over_row {
  const cs_stack *stack;
  cs_isa isa;
  int32_t count; /* pixels */
  cs_over_row_level *level;
  cs_over_row_level *outer[CS_SCENE_DEPTH + 2]; /* of the faded groups around */
  uint32_t depth;
  uint32_t group; /* where the fold stands */
  size_t light;   /* the next back light to be met */
  float keep;     /* what the mattes of back lights leave of transparency */
} cs_over_row;

/* arena: lives as long as the blend. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_over_row_begin(celspan_context *context, cs_arena *arena,
                                                 const cs_stack *stack, cs_isa isa, int32_t count,
                                                 cs_over_row *out);
/* Moves back to just before a leaf: leaves groups, meets back lights, enters groups. */
CELSPAN_CHECKED celspan_status cs_over_row_reach(celspan_context *context, cs_arena *arena,
                                                 cs_over_row *blend, uint32_t layer);
void cs_over_row_flat(cs_over_row *blend, const cs_layer *layer);
/* rgba: a picture's samples; s and t: paints, s not yet lit. Room for a whole batch in each. */
void cs_over_row_picture(cs_over_row *blend, const cs_layer *layer, celspan_picture_use use,
                         const float (*rgba)[4]);
void cs_over_row_paints(cs_over_row *blend, const cs_layer *layer, const float (*s)[4],
                        const float (*t)[4]);
/* Reaches a leaf and folds it: a flat one as it is, any other by its paints. */
CELSPAN_CHECKED celspan_status cs_over_row_layer(celspan_context *context, cs_arena *arena,
                                                 cs_over_row *blend, uint32_t layer,
                                                 const float (*s)[4], const float (*t)[4]);
/* Premultiplied RGBA of the pixels. */
void cs_over_row_end(cs_over_row *blend, float (*rgba)[4]);

/* The fold of pictures alone, none faded, lit white, in no group and before the one back light
 * that there may be: the same bits at once. A folded pixel is light gathered and, in lane 3, what
 * still shines through. */
typedef struct cs_over_row_part {
  int32_t first, end; /* pixels of the batch */
} cs_over_row_part;

/* Folds a picture's samples of some pixels behind what was folded; is_first: nothing was. Returns
 * the pixels that something shines through, and some between and beside them: multiples of what a
 * register holds, but for the end of the batch. All arrays are whole batches. */
cs_over_row_part cs_over_row_bare(cs_isa isa, bool is_first, const float (*rgba)[4],
                                  cs_over_row_part part, float (*folded)[4]);
/* Pictures as they were folded, but for the last: its samples of the pixels that it shows in. */
typedef struct cs_over_row_layers {
  float rgba[CS_OVER_ROW_BATCH][4], folded[CS_OVER_ROW_BATCH][4];
  cs_over_row_part part;
  int32_t count; /* pixels */
  bool is_first; /* the last is the only one */
} cs_over_row_layers;

/* Those and the light behind them, which may be none: premultiplied RGBA, or codes. */
void cs_over_row_bare_end(cs_isa isa, const cs_stack *stack, cs_over_row_layers *layers,
                          float (*rgba)[4]);
void cs_over_row_bare_codes(cs_isa isa, const cs_stack *stack, cs_over_row_layers *layers,
                            unsigned char *codes);

/* ---- blend_wide.c: loops over the pixels of a level */

CS_WIDE_DECLARE(void, cs_over_row_clear, (cs_over_row_level * level, int32_t count));
CS_WIDE_DECLARE(void, cs_over_row_add_flat,
                (cs_over_row_level * level, int32_t count, const float s[4], const float t[4]));
CS_WIDE_DECLARE(void, cs_over_row_add_picture,
                (cs_over_row_level * level, int32_t count, const float front[4], float fade,
                 bool is_gel, const float (*rgba)[4]));
CS_WIDE_DECLARE(void, cs_over_row_add_paints,
                (cs_over_row_level * level, int32_t count, const float front[4], float fade,
                 const float (*s)[4], const float (*t)[4]));
CS_WIDE_DECLARE(void, cs_over_row_add_light,
                (cs_over_row_level * level, int32_t count, const float light[4]));
/* A faded group into what is around it. */
CS_WIDE_DECLARE(void, cs_over_row_add_group,
                (cs_over_row_level * outer, int32_t count, float fade,
                 const cs_over_row_level *inner));
CS_WIDE_DECLARE(cs_over_row_part, cs_over_row_fold_bare,
                (bool is_first, const float (*rgba)[4], cs_over_row_part part, float (*folded)[4]));
CS_WIDE_DECLARE(void, cs_over_row_end_bare,
                (const cs_back_light *behind, bool is_first, const float (*rgba)[4], int32_t count,
                 const float (*folded)[4], float (*out)[4]));
/* The same, coded. */
CS_WIDE_DECLARE(void, cs_over_row_code_bare,
                (const cs_back_light *behind, bool is_first, const float (*rgba)[4], int32_t count,
                 const float (*folded)[4], unsigned char *out));
CS_WIDE_DECLARE(void, cs_over_row_to_rgba,
                (const cs_over_row_level *level, int32_t count, float keep, float (*rgba)[4]));

#endif
