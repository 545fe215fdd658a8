/* What the frames of a film are made of, for exposure sheets: core.parts(frame).
 */
#ifndef CS_BIND_PARTS_H
#define CS_BIND_PARTS_H

#include <lua.h>

/* A frame, a rostrum or {{rostrum, weight}, ...} -> { { kind =, name =, drawing =, placement =,
 * procedure = }, ... }: every named cel and object as often as it occurs, rearmost first, and the
 * cels without a name, which are called by their places. drawing, placement: hashes, as strings of
 * 16 bytes; procedure: true where they cannot be compared. */
int cs_parts_list(lua_State *L);

#endif
