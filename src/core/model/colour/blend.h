/* Blend modes: the colour that a source and its backdrop give where both are present.
 *
 *     separable          each channel by itself: multiply, screen, ... exclusion
 *     not separable      hue, saturation, color, luminosity: of the colour as a whole
 *
 * W3C Compositing and Blending Level 1, chapter 10. CELSPAN_BLEND_ADD has no such colour: it adds
 * premultiplied colours (engine/compose/over.h). The modes after it are those of painting programs;
 * all are separable but the last two, DARKER_COLOR and LIGHTER_COLOR.
 *
 * Colours are not premultiplied, and in 0..1. Lane 3 has no meaning. Every operation is exact IEEE
 * arithmetic, so the bits do not depend on the instruction set.
 */
#pragma once

#include "base/vector.h"
#include "celspan/celspan.h"

#define CS_BLEND_COUNT (CELSPAN_BLEND_LIGHTER_COLOR + 1)

/* Added to a mode: the source shows only where its backdrop is present, and does not change the
 * backdrop's alpha; so a mode with this flag is never CELSPAN_BLEND_NORMAL. The result of "add" is
 * then clamped to 1. */
#define CS_BLEND_WITHIN 32
#define CS_BLEND_MODE(blend) ((celspan_blend)((unsigned)(blend) & (CS_BLEND_WITHIN - 1)))

/* The words of celspan_blend, ended by NULL. */
extern const char *const cs_blend_words[];

/* Blends one colour of a source, s, and one colour of its backdrop, b; blend_lanes.h blends many
 * colours at once. ADD is blended here only for sources within their backdrops
 * (CS_BLEND_WITHIN). */
cs_v4 cs_blend_colour(celspan_blend mode, cs_v4 b, cs_v4 s);
