/* Speckles: regions of few pixels, which get the label of what they border on most.
 *
 * INVARIANT: only labels of speckles change. A speckle whose neighbours are all speckles stays until
 * one of them is none any more; where everything is speckled nothing changes.
 */
#ifndef CS_TRACE_SPECKLES_H
#define CS_TRACE_SPECKLES_H

#include "trace/material.h"

/* Drops regions of at most `most` pixels, which hang together by sides or corners. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_speckles_drop(celspan_context *context,
                                                const cs_material *material, uint32_t most);

#endif
