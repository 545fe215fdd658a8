/* The fold of over_row.h for programs of pictures alone that are shown unchanged: not faded, lit
 * white, in no group, and in front of the only back light, if there is one. It gives the same bits
 * in less time.
 *
 *     pixels         0 ......................... count - 1
 *     first          [opaque opaque][ mixed  ][opaque ...]
 *     something shines through       <------->              the next picture is only sampled here
 *
 * A folded pixel is light gathered and, as its fourth number, what still shines through: of a
 * picture that is the same for all channels.
 */
#pragma once

#include "base/wide.h"
#include "engine/paint/over_row.h"
#include "engine/sample/samples.h"
#include "model/colour/srgb8.h"

typedef struct cs_over_bare_range {
  int32_t first, end; /* pixels of the batch */
} cs_over_bare_range;

/* Pictures folded so far, except the last one: that is kept as samples, of the pixels in which it
 * can be seen. */
typedef struct cs_over_bare {
  cs_samples last; /* from pixel shown.first on */
  /* In an order of over_bare_wide.c's own: read with the instructions that it was made with. */
  float folded[CS_OVER_ROW_BATCH][4];
  cs_over_bare_range shown;
  int32_t count; /* pixels */
  bool is_first; /* the last picture is the only one */
} cs_over_bare;

/* Begins with no picture. */
void cs_over_bare_begin(cs_over_bare *over, int32_t count);
/* Folds the last picture behind those before it. The next one is shown in the pixels that
 * something shines through, and some between and beside them. */
void cs_over_bare_add(cs_isa isa, cs_over_bare *over);
/* Folds the last picture and the back light, if any: to premultiplied RGBA, or to codes. */
void cs_over_bare_end(cs_isa isa, const cs_stack *stack, const cs_over_bare *over,
                      float (*rgba)[4]);
void cs_over_bare_codes(cs_isa isa, const cs_stack *stack, const cs_over_bare *over,
                        unsigned char *codes);

/* ---- over_bare_wide.c */

/* The codes of one picture over an opaque one, both from exact codes. Only with
 * cs_srgb8_decodes. */
CS_WIDE_DECLARE(void, cs_over_bare_mix_copies,
                (const cs_srgb8_curve *curve, const unsigned char *front, const unsigned char *rear,
                 int32_t count, unsigned char *out));

/* Returns the range from the first to the last group of pixels that something shines through. */
CS_WIDE_DECLARE(cs_over_bare_range, cs_over_bare_fold, (cs_over_bare * over));
CS_WIDE_DECLARE(void, cs_over_bare_mix_rgba,
                (const cs_back_light *behind, const cs_over_bare *over, float (*out)[4]));
/* The same, coded. */
CS_WIDE_DECLARE(void, cs_over_bare_mix_codes,
                (const cs_back_light *behind, const cs_over_bare *over, unsigned char *out));
