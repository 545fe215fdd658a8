/* The fold of over.h for a program over up to 256 pixels of a row: light gathered and what still
 * shines through, pixel by pixel, from the camera backwards.
 *
 *     pixels          0    1    2    3   ...  count - 1
 *     state  e     [ rgb. rgb. rgb. rgb. .............. ]   a state for each group that has been
 *            t     [ rgb. rgb. rgb. rgb. .............. ]   entered and not yet left, and the front
 *            front [ rgb. rgb. rgb. rgb. .............. ]   light of a group that has a shape
 *
 *   begin; then for every item from the front: move to its layer, add its paints; then end
 *
 * Invariant: a pixel's colour is the same whatever pixels are beside it, and whichever instructions
 * made it.
 */
#pragma once

#include "base/arena.h"
#include "base/wide.h"
#include "engine/compose/over.h"

#define CS_OVER_ROW_BATCH 256 /* pixels, a multiple of those in a register */

/* Pixels of one row, ascending: `count` from x0 on, or those listed. */
typedef struct cs_batch {
  const int32_t *columns; /* or NULL */
  int32_t x0, count;      /* count: at most CS_OVER_ROW_BATCH */
  double y;
} cs_batch;

static inline double cs_batch_centre(const cs_batch *batch, int32_t k) {
  return (batch->columns ? batch->columns[k] : batch->x0 + k) + 0.5;
}

static inline void cs_batch_centres(const cs_batch *batch, double *x) {
  for (int32_t k = 0; k < batch->count && batch->columns; k++)
    x[k] = batch->columns[k] + 0.5;
#pragma omp simd
  for (int32_t k = 0; k < (batch->columns ? 0 : batch->count); k++)
    x[k] = batch->x0 + k + 0.5;
}

/* Four floats a pixel; lane 3 has no meaning. */
typedef struct cs_over_row_state {
  float e[CS_OVER_ROW_BATCH][4], t[CS_OVER_ROW_BATCH][4]; /* light gathered, and transmission */
} cs_over_row_state;

/* A group that has been entered and not yet left. */
typedef struct cs_over_row_outer {
  cs_over_row_state *outer; /* the state of the group around it, put aside */
  bool is_clear;            /* nothing has been added to `outer` yet */
  cs_over_row_state *head;  /* GROUND and MATTE: composited, not yet faded; NULL: none was met */
  float head_fade;          /* the fade of the head */
  float (*front)[4];        /* the group's front light, where that has a shape */
  uint32_t group;           /* the group around it, entered before, or CS_STACK_NONE */
  float keep;               /* what mattes of back lights leave in the group around it */
} cs_over_row_outer;

typedef struct cs_over_row {
  celspan_context *context;
  cs_arena *arena; /* the arena of the states; borrowed */
  const cs_stack *stack;
  cs_isa isa;
  int32_t count; /* pixels */
  cs_over_row_state *state;
  bool is_clear;             /* nothing has been added to the state yet: it has no contents */
  cs_over_row_outer *outers; /* room for cs_stack_depth of them */
  uint32_t depth;
  uint32_t group; /* the innermost that has been entered, or CS_STACK_NONE */
  size_t light;   /* the next back light to be met */
  float keep;     /* the share of transparency that the mattes of back lights leave */
} cs_over_row;

/* arena: lives as long as the fold. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_over_row_begin(celspan_context *context, cs_arena *arena,
                                                 const cs_stack *stack, cs_isa isa, int32_t count,
                                                 cs_over_row *out);
/* Moves back to just in front of a layer: leaves groups, meets back lights, enters groups.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_over_row_move_far(cs_over_row *over, uint32_t layer);
static inline CELSPAN_CHECKED celspan_status cs_over_row_move(cs_over_row *over, uint32_t layer) {
  const cs_stack *stack = over->stack;
  bool is_near = stack->layers[layer].group == over->group &&
                 (over->light >= stack->light_count || layer >= stack->lights[over->light].below);
  return is_near ? CELSPAN_OK : cs_over_row_move_far(over, layer);
}
/* Add a layer that has been moved to, by its role. rgba: a picture's samples; s and t: paints, s
 * not yet lit. Room for a whole batch in each. Errors: NO_MEMORY. */
void cs_over_row_add_layer(cs_over_row *over, const cs_layer *layer);
/* The same where the layer has one paint in all pixels, given lit. */
void cs_over_row_add_lit(cs_over_row *over, const cs_over_pair *lit);
/* The same where the layer has a gradient: x: the middles of the pixels. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_over_row_add_shade(cs_over_row *over, const cs_layer *layer,
                                                     const double *x, double y);
CELSPAN_CHECKED celspan_status cs_over_row_add_samples(cs_over_row *over, const cs_layer *layer,
                                                       celspan_picture_use use,
                                                       const float (*rgba)[4]);
CELSPAN_CHECKED celspan_status cs_over_row_add_paint(cs_over_row *over, const cs_layer *layer,
                                                     const float (*s)[4], const float (*t)[4]);
/* Moves to a layer and adds it: a flat layer with its light, any other layer with the paints s and
 * t. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_over_row_layer(cs_over_row *over, uint32_t layer,
                                                 const float (*s)[4], const float (*t)[4]);
/* Premultiplied RGBA of the pixels. */
void cs_over_row_end(cs_over_row *over, float (*rgba)[4]);

/* ---- over_row_wide.c: loops over the pixels of a state */

CS_WIDE_DECLARE(void, cs_over_row_clear, (cs_over_row_state * state, int32_t count));
/* is_first: the state has no contents yet. */
CS_WIDE_DECLARE(void, cs_over_row_add_flat,
                (cs_over_row_state * state, int32_t count, bool is_first, const float s[4],
                 const float t[4]));
CS_WIDE_DECLARE(void, cs_over_row_add_picture,
                (cs_over_row_state * state, int32_t count, bool is_first, const float front[4],
                 float fade, bool is_gel, const float (*rgba)[4]));
CS_WIDE_DECLARE(void, cs_over_row_add_paints,
                (cs_over_row_state * state, int32_t count, bool is_first, const float front[4],
                 float fade, const float (*s)[4], const float (*t)[4]));
CS_WIDE_DECLARE(void, cs_over_row_add_light,
                (cs_over_row_state * state, int32_t count, const float light[4]));
/* Adds a back light with a shape: of a gain, and pigments. */
CS_WIDE_DECLARE(void, cs_over_row_add_back,
                (cs_over_row_state * state, int32_t count, const float gain[4],
                 const float (*s)[4]));
/* Makes a front light with a shape: pigments times a gain. Then multiplies the light of a group by
 * it. */
CS_WIDE_DECLARE(void, cs_over_row_make_front,
                (int32_t count, const float gain[4], const float (*s)[4], float (*front)[4]));
/* As cs_over_develop, each of its steps for all pixels. */
CS_WIDE_DECLARE(void, cs_over_row_develop,
                (cs_over_row_state * state, int32_t count, const cs_group *group, float keep));
CS_WIDE_DECLARE(void, cs_over_row_light_group,
                (cs_over_row_state * state, int32_t count, const float (*front)[4]));
/* Adds a group that has been left to the state around it. */
CS_WIDE_DECLARE(void, cs_over_row_add_group,
                (cs_over_row_state * outer, int32_t count, float fade,
                 const cs_over_row_state *inner));
/* Fades a group by its matte, which is faded first; head NULL: the matte is clear. */
CS_WIDE_DECLARE(void, cs_over_row_matte,
                (const cs_over_row_state *head, int32_t count, const cs_group *group, float fade,
                 cs_over_row_state *art));
CS_WIDE_DECLARE(void, cs_over_row_to_rgba,
                (cs_over_row_state * state, int32_t count, float keep, float (*rgba)[4]));

/* ---- over_key_wide.c */

/* The key of a group, as cs_over_develop. space: of the group. */
CS_WIDE_DECLARE(void, cs_over_row_key,
                (cs_over_row_state * state, int32_t count, const cs_keying *key,
                 celspan_space space));

/* ---- over_blend_wide.c */

/* Fades a source and blends it over its backdrop, as cs_over_blend does. The result replaces the
 * backdrop. keep: the share of transparency that the mattes of back lights leave in the
 * backdrop. */
CS_WIDE_DECLARE(void, cs_over_row_blend,
                (cs_over_row_state * source, int32_t count, float fade, celspan_blend mode,
                 float keep, cs_over_row_state *back));
