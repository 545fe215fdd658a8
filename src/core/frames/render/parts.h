/* Parts: what is moved as a whole inside a cel is drawn as a cel of its own.
 *
 *     cel                              parts, from the rear
 *       union                            cel 1: hills, trees     neighbours that are no parts
 *         hills                          cel 2: the dog          in its own place, so that its map
 *         trees                                                  is found again in other frames
 *         dog, rotated                   cel 3: coat, scarf
 *         union, moved                   cel 4: an arm, rotated
 *           coat
 *           scarf
 *           arm, rotated
 *
 * A cel that is one map is solved again whenever anything in it moves. The rule. An object of a cel
 * is a part that has a transform, is rich (CS_WAYS_PIECES of ways.h), and has at least one in
 * CS_PARTS_MOST of the pieces of its cel; unless it only groups objects that contain parts: then
 * these are the parts. An object only groups if it is a union that is not faded and has no mode,
 * grade or space of its own. The objects between two parts make a cel, too. A cel keeps its parts
 * together that
 *   - composites its objects by themselves, such as a faded one, or has objects whose modes act on
 *     other cels, or a light with a shape,
 *   - would have more pieces in what is not rich than in what is,
 *   - enlarges or reduces a part beyond what a cel may,
 *   - would make more than CS_MAP_DRAWINGS cels of the frame.
 *
 * Invariant: the parts, one over the other, show what the rostrum shows; and they depend on it and
 * on the size of the whole frame alone.
 */
#pragma once

#include "engine/map/sheets.h"
#include "frames/render/compile.h"

#define CS_PARTS_MOST 8 /* in a cel */

typedef struct cs_cel_parts {
  const celspan_rostrum *rostrum;  /* its cels are the parts; it borrows their contents */
  const celspan_rostrum *from;     /* borrowed */
  size_t numbers[CS_MAP_DRAWINGS]; /* the numbers of the cels that the parts belong to, from 1 */
  celspan_rostrum own;             /* the rostrum of the parts, */
  celspan_cel *cels, **list; /* the parts: CS_MAP_DRAWINGS each, or NULL where no cel has parts */
} cs_cel_parts;

/* rich: the least pieces of a rich object. The rostrum has at most CS_MAP_DRAWINGS cels and must
 * outlive the parts, which stay in their place in memory. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_parts_create(celspan_context *context,
                                               const celspan_rostrum *rostrum, const cs_view *view,
                                               size_t rich, cs_cel_parts *out);
/* From the units of a part to film units on the frame. Errors: BAD_ARGUMENT, as of
 * cs_scene_cel_matrix for its cel. */
CELSPAN_CHECKED celspan_status cs_parts_place(celspan_context *context, const cs_cel_parts *parts,
                                              size_t index, const cs_view *view,
                                              celspan_matrix *out);
/* The pieces of the outlines in a list of objects, as rules about maps count them: see piece_count
 * of cs_primitive_data. */
size_t cs_parts_pieces(celspan_object *const *objects, size_t count);
void cs_parts_finish(cs_cel_parts *parts, cs_memory *memory);
