/* Rules by which a composition's only cel is computed from its neighbourhood: it is averaged over
 * samples, and each of these becomes a function of the samples around it.
 *
 *     . . . . .      SHARPEN  the sample, and its difference from a Gaussian of those around it
 *     . o o o .      WEIGHTS  the sum of a matrix of samples, times a weight each
 *     . o x o .      LIGHT    alpha as a height: its slope, from nine samples, and a light
 *     . o o o .      ALPHA    the sample with a function of its alpha
 *     . . . . .
 *
 * Samples are pixels of the frame. Those of WEIGHTS and LIGHT are one of the cel's units apart, but
 * at least a pixel. Nothing that the cel lets through differs between its channels, except under
 * SHARPEN, which changes only what it shows. All numbers are in the cel's units.
 */
#pragma once

#include "model/scene/scene.h"

#define CS_NEARBY_WEIGHTS_MOST 1024 /* numbers of a matrix */
#define CS_NEARBY_TABLE 4097        /* values of a function of alpha */

typedef enum cs_nearby_kind {
  CS_NEARBY_SHARPEN,
  CS_NEARBY_WEIGHTS,
  CS_NEARBY_LIGHT,
  CS_NEARBY_ALPHA
} cs_nearby_kind;

typedef enum cs_nearby_source {
  CS_NEARBY_DISTANT, /* from a direction */
  CS_NEARBY_POINT,   /* from a place */
  CS_NEARBY_SPOT     /* from a place, along an axis */
} cs_nearby_source;

typedef struct cs_nearby_light {
  cs_nearby_source source;
  bool is_specular;
  double height;             /* units of an alpha of 1 */
  double constant, exponent; /* the exponent: of what is specular */
  double colour[3];          /* light */
  double from[3];            /* the direction to the light, of length 1; or its place */
  double towards[3];         /* SPOT: a point of its axis */
  double focus;              /* SPOT: the exponent of the cosine to the axis */
  double cone;               /* SPOT: nothing is lit below this cosine to the axis */
} cs_nearby_light;

typedef struct cs_nearby {
  atomic_size_t references;
  cs_memory *memory;
  cs_hash hash;
  cs_nearby_kind kind;
  celspan_box box;       /* LIGHT, and where it continues: the edges */
  bool continues;        /* WEIGHTS: an edge continues beyond it, else all is clear */
  double radius, amount; /* SHARPEN: the radius is two deviations */
  int32_t size[2];       /* WEIGHTS: columns and rows */
  int32_t target[2];     /* the sample that becomes the sum */
  double bias;           /* WEIGHTS: is added to the sum */
  bool keeps_alpha;      /* WEIGHTS: colours alone are summed, as they are without alpha */
  cs_nearby_light light; /* LIGHT */
  double ground[3];      /* ALPHA: the colour, in its own space, where alpha is 0 */
  const float *numbers;  /* the weights, row after row, or the values of alpha from 0 to 1 */
  size_t count;
} cs_nearby;

/* *out: new, with copies of the fields and the numbers; the caller gives no hash. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_nearby_create(celspan_context *context, const cs_nearby *fields,
                                                cs_nearby **out);
cs_nearby *cs_nearby_ref(cs_nearby *nearby);
void cs_nearby_unref(cs_nearby *nearby);

/* An object without a mode, or nothing (NULL), changed by a rule inside a frame. *out: new. Errors:
 * NO_MEMORY, BAD_ARGUMENT, LIMIT. */
CELSPAN_CHECKED celspan_status cs_nearby_object_create(celspan_context *context,
                                                       celspan_object *object, cs_nearby *nearby,
                                                       const celspan_box *frame,
                                                       celspan_object **out);
