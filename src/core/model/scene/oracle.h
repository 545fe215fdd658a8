/* Textures at a point, in doubles: a second implementation, with which the tests compare the
 * frames. It shares no code with the composer.
 */
#pragma once

#include "model/scene/scene.h"

/* A premultiplied paint, as cs_paint. */
typedef struct cs_oracle_paint {
  double s[3], t[3], beta;
} cs_oracle_paint;

extern const cs_oracle_paint cs_oracle_clear;

/* (1 - u) p + u q */
cs_oracle_paint cs_oracle_mix(const cs_oracle_paint *p, const cs_oracle_paint *q, double u);

/* A texture at a point of its own units, with its pigments as numbers of a space. Pictures are
 * bilinear at full resolution. bounds: the box of a picture that has no box of its own. Errors:
 * INPUT, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_oracle_texture(celspan_context *context,
                                                 const celspan_texture *texture,
                                                 const celspan_box *bounds, celspan_point point,
                                                 celspan_space space, cs_oracle_paint *out);
/* Noise at a point of its own units, with all its octaves, 0 to 1. */
double cs_oracle_noise(const cs_noise *noise, celspan_point point);
/* The paint of a primitive at a point of its own units that is inside it. Procedures are called for
 * their row, and *is_there says whether one of its spans covers the point. For other primitives it
 * is true. Errors: INPUT, LIMIT, NO_MEMORY, CALLBACK. */
CELSPAN_CHECKED celspan_status cs_oracle_primitive(celspan_context *context,
                                                   const cs_primitive_data *data,
                                                   celspan_point point, celspan_space space,
                                                   bool *is_there, cs_oracle_paint *out);

/* One channel of a colour with alpha `share`, converted from the other space to this one. */
double cs_oracle_convert(celspan_space to, double s, double share);

/* A part of the picture as it is seen: the light that it sends to the camera, and the light that it
 * lets through. */
typedef struct cs_oracle_sight {
  double light[3], through[3];
  double keep; /* the share of transparency that the mattes of back lights in it leave; they dim no
                  light */
} cs_oracle_sight;

extern const cs_oracle_sight cs_oracle_nothing;

/* The alpha of a sight. */
double cs_oracle_alpha(const cs_oracle_sight *sight);
/* One sight in front of another one. */
cs_oracle_sight cs_oracle_before(const cs_oracle_sight *front, const cs_oracle_sight *back);
/* A source with a mode in front of its backdrop, by the formulas of W3C Compositing and Blending
 * Level 1. */
cs_oracle_sight cs_oracle_blend(celspan_blend mode, const cs_oracle_sight *source,
                                const cs_oracle_sight *back);
/* Converts a colour to a space from the other space, channel by channel. */
cs_oracle_sight cs_oracle_leave(celspan_space to, const cs_oracle_sight *sight);
/* Grades a whole composition in a space. */
void cs_oracle_grade(const celspan_grade *grade, celspan_space space, cs_oracle_sight *sight);
/* weight * sight + (1 - weight) * nothing. */
cs_oracle_sight cs_oracle_fade(const cs_oracle_sight *sight, double weight);
