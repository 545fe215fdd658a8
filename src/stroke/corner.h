/* Corners, caps and other places where the side of a stroke does not go on as it came.
 *
 *     round             bevel             miter              the inside, and cuts
 *
 *        .---.          o-----o               o tip
 *      .'     '.       /       \            .' '.             o         o
 *     o         o     o  chord  o          o     o              \     /
 *      \       /       \       /            \   /                 \ /
 *       centre          centre              centre                centre
 *
 * A round shape fills the disc between two spokes, which is where the disc of that place lies
 * outside of all its neighbours; a smooth place where the radius bends is treated so too. The other
 * shapes have the width of their place: if the spokes lean, what is between them and the normals is
 * filled as at the end of a stroke that has butt caps.
 *
 *   butt end     o tip           the width falls from here:       tip o    the width grows: the
 *                | \             the disc up to the normal            |    end is straight from
 *     the line's |  o                                                 |    tip to tip
 *     end        *--->                                            <---*
 */
#ifndef CS_STROKE_CORNER_H
#define CS_STROKE_CORNER_H

#include "stroke/side.h"

/* From the tip where the side comes in to the one where it goes out, at one place. Errors: NO_MEMORY,
 * LIMIT. */
CELSPAN_CHECKED celspan_status cs_corner_turn(cs_side *side, const cs_stroke *stroke,
                                              const cs_spoke *in, const cs_spoke *out);
/* From the tip on the right of a line's end to that on its left. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_corner_cap(cs_side *side, const cs_stroke *stroke,
                                             const cs_spoke *end);
/* The same, where the line is only cut. */
CELSPAN_CHECKED celspan_status cs_corner_cut(cs_side *side, const cs_spoke *end);
/* Contours of their own, for what does not lie along the side: the straight ends of both lines at a
 * corner, and a square cap before a straight end. */
CELSPAN_CHECKED celspan_status cs_corner_turn_more(cs_side *side, const cs_stroke *stroke,
                                                   const cs_spoke *in, const cs_spoke *out);
CELSPAN_CHECKED celspan_status cs_corner_cap_more(cs_side *side, const cs_stroke *stroke,
                                                  const cs_spoke *end);
/* A line of no length. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_corner_dot(cs_side *side, const cs_stroke *stroke,
                                             const cs_spoke *place);

#endif
