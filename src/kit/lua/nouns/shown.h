/* What a frame shows: what frame functions return, and whatever else shows a frame, as rostrums.
 *
 *   rostrum                             itself
 *   object, cel                         a rostrum with it
 *   { object, { cel, nil }, camera = }  a rostrum with a cel for each, and with the named fields
 *   { { any of these, weight }, ... }   exposures
 */
#pragma once

#include "lua/bind/noun.h"

/* Replaces the value at index by a rostrum or a new list of {rostrum, weight}, which no callback
 * can change, and reads it as the exposures of *desc. They are scratch memory, left on the stack;
 * the rostrums belong to the value. Raises at the caller's line. name: for messages. */
void cs_shown_read(lua_State *L, int index, const char *name, celspan_frame_desc *desc);
/* native.exposures(name, value): the same as a list in any case, in which each rostrum has a
 * weight. */
int cs_shown_exposures(lua_State *L);
/* native.cels(name, value): the cels of an object, a cel or a list of them; none of nil. */
int cs_shown_cels(lua_State *L);
