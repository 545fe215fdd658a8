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

cs_oracle_paint cs_oracle_over(const cs_oracle_paint *front, const cs_oracle_paint *back);
/* (1 - u) p + u q */
cs_oracle_paint cs_oracle_mix(const cs_oracle_paint *p, const cs_oracle_paint *q, double u);
/* Whether the paint lets no light through, so that nothing behind it is visible. */
bool cs_oracle_hides(const cs_oracle_paint *shade);

/* A texture at a point of its own units. Pictures are bilinear at full resolution; bounds: where
 * one without a box lies. Errors: INPUT, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_oracle_texture(celspan_context *context,
                                                 const celspan_texture *texture,
                                                 const celspan_box *bounds, celspan_point point,
                                                 cs_oracle_paint *out);
/* The paint of a primitive at a point of its own units that is inside it. Procedures are asked for
 * their row, and *is_there is whether a span of it covers the point (true for all others). Errors:
 * INPUT, LIMIT, NO_MEMORY, CALLBACK. */
CELSPAN_CHECKED celspan_status cs_oracle_primitive(celspan_context *context,
                                                   const cs_primitive_data *data,
                                                   celspan_point point, bool *is_there,
                                                   cs_oracle_paint *out);
