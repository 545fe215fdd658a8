/* Values: full userdata that hold a reference to something in the core, and the fields they were
 * made from.
 *
 * INVARIANT: a userdata is made closed (handle NULL), then filled; __gc releases it, and no script
 * can call it, because __metatable hides the metatables. Its user value
 * is a table that no script can reach: fields that are read come out as copies. Chains of an
 * operator share a table of operands, of which each shows the first ones.
 */
#ifndef CS_BIND_USERDATA_H
#define CS_BIND_USERDATA_H

#include <lauxlib.h>

#include "bind/noun.h"

typedef struct cs_userdata {
  const cs_noun *noun;
  void *handle; /* a reference to something in the core; NULL: closed, or a noun without one */
  celspan_matrix matrix; /* objects, cels: applied since the constructor, for :with */
  double fade;           /* likewise */
  bool is_chain;         /* made by an operator and not touched since: the next one flattens it */
  lua_Integer shown;     /* of the operands in a table that chains share; 0: not shared */
  celspan_paint paint;   /* paints */
  uint64_t seed;         /* frames: for f:random */
} cs_userdata;

extern const cs_noun cs_noun_paint, cs_noun_rostrum, cs_noun_rostrum_object, cs_noun_film;
extern const cs_kind cs_kind_paint, cs_kind_texture, cs_kind_object, cs_kind_cel, cs_kind_rostrum,
    cs_kind_film, cs_kind_frame;

/* Makes the metatable of a kind. methods: NULL-ended, or NULL. Every kind gets __index, __newindex,
 * __tostring, __gc, __metatable and __name. */
void cs_userdata_register(lua_State *L, const cs_kind *kind, const luaL_Reg *methods);

/* Pushes a closed value. */
cs_userdata *cs_userdata_push(lua_State *L, const cs_noun *noun);
/* Pushes a copy of the fields of the value at `index`. */
void cs_userdata_push_fields(lua_State *L, int index);
/* Pushes a closed value that is else like the one at index: noun, fields, transform, fade, paint. */
cs_userdata *cs_userdata_push_like(lua_State *L, int index);
/* Pushes a copy of the table at `table`, with the tables in it, that has room for `more` fields. */
void cs_userdata_push_copy(lua_State *L, int table, int more);

/* The value at index if it is of this kind, else NULL. Raises when it is closed. */
cs_userdata *cs_userdata_test(lua_State *L, int index, const cs_kind *kind);
/* The value at index, of any kind that constructors make (frames are not), else NULL. The kind is
 * told by the identity of its metatable, never by what a metatable says. */
cs_userdata *cs_userdata_any(lua_State *L, int index);
/* The `self` of a method; raises when it is not of this kind. */
cs_userdata *cs_userdata_self(lua_State *L, const cs_kind *kind, const char *method);

/* Pushes what the value at index is, for messages: "a circle", "number". */
const char *cs_userdata_type(lua_State *L, int index);

#endif
