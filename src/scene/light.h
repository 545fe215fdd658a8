/* A light of a cel or a rostrum: one colour everywhere, or a texture.
 *
 *     flat          r, g, b; and the matte a of a back light
 *     texture       gain * beta * pigment at each point; the matte is matte * beta
 *
 *         on = FRAME                             on = CEL
 *      +------------------+                   +------------------+
 *      |   .  * .         |  stays while      |        .  * .    |  moves with the cel
 *      |  . light .  cel  |  the cel moves    |   cel . light .  |
 *      |     . .          |                   |          . .     |
 *      +------------------+                   +------------------+
 *
 * Invariant: a texture here is no flat one, and its paints have clear media, so its T is 1 - beta.
 */
#ifndef CS_SCENE_LIGHT_H
#define CS_SCENE_LIGHT_H

#include "base/hash.h"
#include "celspan/celspan.h"

typedef struct cs_light {
  bool is_given;            /* front lights: false for a cel that takes its rostrum's */
  celspan_light flat;       /* where there is no texture; else 0 */
  celspan_texture *texture; /* NULL: flat */
  double gain;              /* of the texture; else 0 */
  celspan_light_place on;   /* likewise */
  double matte;             /* likewise: what the texture's beta is multiplied by */
} cs_light;

/* What a description says of one light. */
typedef struct cs_light_desc {
  const char *noun, *field;
  bool is_given; /* the plain light is */
  celspan_light flat;
  const celspan_light_texture *texture;
} cs_light_desc;

/* *out: owns a reference to its texture. Errors: NO_MEMORY, BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_light_make(celspan_context *context, const cs_light_desc *desc,
                                             cs_light *out);
/* Another owner of the same light. */
cs_light cs_light_ref(const cs_light *light);
void cs_light_unref(const cs_light *light);
void cs_light_hash(cs_hash *hash, const cs_light *light);
/* The light times a brightness; the matte does not change. Borrows the texture. */
cs_light cs_light_scale(const cs_light *light, double brightness);

#endif
