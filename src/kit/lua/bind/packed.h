/* The fields of small values, as bytes instead of a table.
 *
 *   rect{ 10, 20, 3.5, 4, texture = t }         the fields in the order of the noun:
 *
 *   [ 4 | int 10 | int 20 | float 3.5 | int 4 | nil | other ]       and t is the value's user value
 *     |                                         |     |
 *     items of the list                      radius  texture
 *
 * A scene may have a million squares, and a table takes more memory than everything that the core
 * keeps of one square. Values whose fields are only numbers, short lists of numbers and at most one
 * value of another type are packed; the others keep a table.
 *
 * INVARIANT: unpacking gives a table equal to the packed one.
 */
#pragma once

#include <lauxlib.h>

#include "lua/bind/noun.h"

#define CS_PACKED_SIZE 240 /* bytes at most */

typedef struct cs_packed {
  size_t size; /* 0: the fields did not fit */
  bool has_other;
  unsigned char bytes[CS_PACKED_SIZE];
} cs_packed;

/* Packs the table at `fields`, whose names have been checked, and pushes its value of another type;
 * nil if there is no such value, or if the table does not fit. */
void cs_packed_push_other(lua_State *L, const cs_noun *noun, int fields, cs_packed *out);
/* Appends a number, or a list of them, as the next field; there must be room for it. */
void cs_packed_add_number(cs_packed *packed, double number);
void cs_packed_add_list(cs_packed *packed, const double *numbers, int count);
/* Begins a noun without a list. */
void cs_packed_begin(cs_packed *packed);
/* Pushes a new table of fields, with the presets. other: the index of the value of another type. */
void cs_packed_push_fields(lua_State *L, const cs_noun *noun, const unsigned char *bytes,
                           int other);

/* Sets the missing fields of a table that have a preset. */
void cs_packed_set_presets(lua_State *L, const cs_noun *noun, int table);
