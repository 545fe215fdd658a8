/* Places of a value that methods turn, scale and move it about: a point, or a word.
 *
 *   top left      top      top right        of the bounds of the value as it is
 *       left     centre    right
 *   bottom left  bottom   bottom right      of a letter, "bottom" is its baseline
 *
 * "pivot" is the point that the value was given by with { pivot = ... }. Transforms move it.
 */
#pragma once

#include "lua/bind/userdata.h"

/* Reads the place at index: a point {x, y}, a word, or two numbers at index and the index after it;
 * the origin if there is nothing. False: it is a word, and the value has nothing to paint. Raises
 * an error that begins with the method's name. */
bool cs_anchor_read(lua_State *L, int index, const char *method, const cs_userdata *value,
                    celspan_point *out);
/* Whether the argument at index is a place by itself, and no number. */
bool cs_anchor_is_whole(lua_State *L, int index);

/* The places of a value move with it. */
void cs_anchor_move(cs_userdata *value, const celspan_matrix *matrix);
/* Gives `value`, which was made from `from`, its pivot. */
void cs_anchor_keep_pivot(const cs_userdata *from, cs_userdata *value);
/* Replaces the value on top of the stack by a copy whose pivot is the place at index. */
void cs_anchor_set_pivot(lua_State *L, int index);
