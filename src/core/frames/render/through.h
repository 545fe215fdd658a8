/* Bounds on the light that shines through a layer: layers hidden behind several others need not be
 * examined.
 *
 *     T of a layer
 *       |  - - - - - - - - - - - - - - -  bound: no channel lets through more, wherever the layer
 *       |      .-o-.                      is present
 *       |  o-'      ` - . _ o
 *       |  :   :            :
 *       +--------------------------> x    between stops a paint is a mix of theirs, and outside of
 *          stops                          them it is that of the nearest
 *
 * Invariant: a bound depends on the scene and the frame's size alone, so that what is cut behind it
 * is the same for every worker, strip and crop.
 */
#pragma once

#include "engine/compose/stack.h"
#include "model/geometry/boundary.h"

/* The most that a formula transmits where it is visible, in pixels of the frame. Lane 3 is 0. */
cs_v4 cs_through_shade(const cs_shade *shade, const cs_boundary_frame *visible);

/* The most that a painted layer transmits wherever it is present, fade included. A picture's header
 * is read for it; an unreadable picture counts as clear, since it may be hidden itself. */
cs_v4 cs_through_layer(celspan_context *context, const cs_stack *stack, const cs_layer *layer);
/* The least value that the result may have, known before a header is read. */
cs_v4 cs_through_least(const cs_stack *stack, const cs_layer *layer);

/* How many times a layer of transmission `t` at most halves the light behind it, roughly; at most
 * CS_THROUGH_OPAQUE. */
#define CS_THROUGH_OPAQUE 16
double cs_through_halvings(cs_v4 t);
