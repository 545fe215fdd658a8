/* The fold of a program over many pixels: light gathered and what still shines through, pixel by
 * pixel, from the camera backwards.
 *
 *   begin, then for every item from the front: reach its leaf, paint; end
 *
 * Invariant: a pixel's colour is the same whatever pixels stand beside it, and whichever
 * instructions made it.
 */
#ifndef CS_COMPOSE_BLEND_H
#define CS_COMPOSE_BLEND_H

#include "base/arena.h"
#include "base/wide.h"
#include "compose/stack.h"

#define CS_BLEND_BATCH 256 /* pixels, a multiple of those in a register */

/* Four floats a pixel; lane 3 is of no account. */
typedef struct cs_blend_level {
  float e[CS_BLEND_BATCH][4], t[CS_BLEND_BATCH][4]; /* light gathered, and transmission */
} cs_blend_level;

typedef struct cs_blend {
  const cs_stack *stack;
  cs_isa isa;
  int32_t count; /* pixels */
  cs_blend_level *level;
  cs_blend_level *outer[CS_SCENE_DEPTH + 2]; /* of the faded groups around */
  uint32_t depth;
  uint32_t group; /* where the fold stands */
  size_t light;   /* the next back light to be met */
  float keep;     /* what the mattes of back lights leave of transparency */
} cs_blend;

/* arena: lives as long as the blend. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_blend_begin(celspan_context *context, cs_arena *arena,
                                              const cs_stack *stack, cs_isa isa, int32_t count,
                                              cs_blend *out);
/* Moves back to just before a leaf: leaves groups, meets back lights, enters groups. */
CELSPAN_CHECKED celspan_status cs_blend_reach(celspan_context *context, cs_arena *arena,
                                              cs_blend *blend, uint32_t leaf);
void cs_blend_flat(cs_blend *blend, const cs_leaf *leaf);
/* rgba: a picture's samples; s and t: paints, s not yet lit. Room for a whole batch in each. */
void cs_blend_picture(cs_blend *blend, const cs_leaf *leaf, celspan_picture_use use,
                      const float (*rgba)[4]);
void cs_blend_paints(cs_blend *blend, const cs_leaf *leaf, const float (*s)[4],
                     const float (*t)[4]);
/* Premultiplied RGBA of the pixels. */
void cs_blend_end(cs_blend *blend, float (*rgba)[4]);

/* The fold of pictures alone, none faded, lit white, in no group and before no back light: the same
 * bits at once. layers: samples from the front, room for a whole batch in each. */
void cs_blend_bare(cs_isa isa, const float (*const *layers)[4], uint32_t layer_count, int32_t count,
                   float (*rgba)[4]);

/* ---- blend_wide.c: loops over the pixels of a level */

CS_WIDE_DECLARE(void, cs_blend_clear, (cs_blend_level * level, int32_t count));
CS_WIDE_DECLARE(void, cs_blend_add_flat,
                (cs_blend_level * level, int32_t count, const float s[4], const float t[4]));
CS_WIDE_DECLARE(void, cs_blend_add_picture,
                (cs_blend_level * level, int32_t count, const float front[4], float fade,
                 bool is_gel, const float (*rgba)[4]));
CS_WIDE_DECLARE(void, cs_blend_add_paints,
                (cs_blend_level * level, int32_t count, const float front[4], float fade,
                 const float (*s)[4], const float (*t)[4]));
CS_WIDE_DECLARE(void, cs_blend_add_light,
                (cs_blend_level * level, int32_t count, const float light[4]));
/* A faded group into what is around it. */
CS_WIDE_DECLARE(void, cs_blend_add_group,
                (cs_blend_level * outer, int32_t count, float fade, const cs_blend_level *inner));
CS_WIDE_DECLARE(void, cs_blend_fold_bare,
                (const float (*const *layers)[4], uint32_t layer_count, int32_t count,
                 float (*rgba)[4]));
CS_WIDE_DECLARE(void, cs_blend_to_rgba,
                (const cs_blend_level *level, int32_t count, float keep, float (*rgba)[4]));

#endif
