/* Values: full userdata that hold a reference to something in the core, and the fields they were
 * made from.
 *
 *   [ noun, handle | the kind's own | placement | packed fields ]   and user value 1
 *                                     only of     only where they fit; else a table is user value 1
 *                                     values that were placed
 *
 * INVARIANT: a userdata is made closed (handle NULL), then filled; __gc releases it, and no script
 * can call it, because __metatable hides the metatables. Its user value is a table that no script
 * can reach: fields that are read come out as copies. The values of a chain of operators share a
 * table of operands; each value shows the first few.
 */
#pragma once

#include <lauxlib.h>

#include "lua/bind/noun.h"
#include "lua/bind/packed.h"

typedef struct cs_userdata {
  const cs_noun *noun;
  void *handle; /* a reference to something in the core; NULL: closed, or a noun without one */
  /* how many operands of a table that chains share belong to this value; 0: it is not shared */
  int32_t shown;
  uint16_t packed; /* bytes of its packed fields; 0: its fields are in a table */
  bool is_chain;   /* made by an operator and unchanged since; the next operator extends it */
  bool is_placed;  /* there is room for a placement */
} cs_userdata;

/* The transform and the fade that an object or a cel was given after its constructor, for :with. */
typedef struct cs_placement {
  celspan_matrix matrix;
  double fade;
} cs_placement;

/* The own data of objects and cels: the point that a script gave them, and of a letter the middle
 * of its baseline (anchor.h). */
typedef struct cs_anchor {
  celspan_point pivot, baseline;
  bool has_pivot, has_baseline;
} cs_anchor;

extern const cs_noun cs_noun_paint, cs_noun_rostrum, cs_noun_rostrum_object, cs_noun_film;
extern const cs_kind cs_kind_paint, cs_kind_texture, cs_kind_object, cs_kind_cel, cs_kind_rostrum,
    cs_kind_film, cs_kind_frame;
extern const cs_kind *const cs_kinds[]; /* all kinds, ended by NULL */

/* Makes the metatable of a kind: its operators, and __index, __newindex, __tostring, __gc,
 * __metatable and __name. */
void cs_userdata_register(lua_State *L, const cs_kind *kind);

/* Pushes a closed value. */
cs_userdata *cs_userdata_push(lua_State *L, const cs_noun *noun);
/* The same, with packed fields and, if is_placed, room for a placement. The caller then sets user
 * value 1: the field of another type, or, if packed->size is 0, the table of fields. */
cs_userdata *cs_userdata_push_packed(lua_State *L, const cs_noun *noun, bool is_placed,
                                     const cs_packed *packed);
/* The value's own data, as its kind defines: kind->own_size bytes, zeros at first. */
void *cs_userdata_own(const cs_userdata *value);
/* If it was not placed: no transform and no fade. */
cs_placement cs_userdata_placement(const cs_userdata *value);
/* value: must have room for a placement. */
void cs_userdata_place(cs_userdata *value, const cs_placement *placement);
/* Whether values of the noun have a field. */
bool cs_userdata_has_field(const cs_noun *noun, const char *name);
/* Pushes a copy of the fields of the value at `index`. */
void cs_userdata_push_fields(lua_State *L, int index);
/* Pushes the table of fields of the value at `index`, which must not be changed, or nil. */
void cs_userdata_push_kept(lua_State *L, int index);
/* Pushes a closed value with the same noun, fields, placement and own data of its kind as the value
 * at index. is_placed: with room for a placement in any case. */
cs_userdata *cs_userdata_push_like(lua_State *L, int index, bool is_placed);
/* Pushes a copy of the table at `table`, with the tables in it, that has room for `more` fields. */
void cs_userdata_push_copy(lua_State *L, int table, int more);

/* The value at index if it is of this kind, else NULL. Raises when it is closed. */
cs_userdata *cs_userdata_test(lua_State *L, int index, const cs_kind *kind);
/* The value at index, of any kind that constructors make (frames are not among these), or else
 * NULL. The kind is recognized by the identity of its metatable, never by the contents of a
 * metatable. */
cs_userdata *cs_userdata_any(lua_State *L, int index);
/* The `self` of a method; raises when it is not of this kind. */
cs_userdata *cs_userdata_self(lua_State *L, const cs_kind *kind, const char *method);

/* Pushes a word for the value at index, for messages: "a circle", "number". */
const char *cs_userdata_type(lua_State *L, int index);
/* The same, but of a number pushes its value. */
const char *cs_userdata_number(lua_State *L, int index);
/* The same, but of a string pushes its beginning, in quotes and without control characters. */
const char *cs_userdata_shown(lua_State *L, int index);

/* Gives the metatable of this name these functions, also if it exists already: without memory it
 * may be incomplete. Scripts can neither read nor change it. */
void cs_userdata_open_metatable(lua_State *L, const char *name, const luaL_Reg *functions);

/* ---------------------------------------------------------------- holders */

/* A holder keeps what C holds while Lua runs, and releases it in any case: a call that fails leaves
 * by a long jump, and no C code after it is run.
 *
 *   holder = cs_userdata_push_holder(L, "celspan.painting", sizeof *holder, release)
 *   *holder = what was made             the collector calls release(L) with it as argument 1
 *
 * INVARIANT: a metatable is in the registry complete or not at all. If memory runs out while one is
 * made, the next call makes it again. Scripts can neither read nor change it.
 */

/* Pushes zeroed memory with one user value. Its finaliser is `release`, which must be the same for
 * all of a kind. Raises an error if there is no memory. */
void *cs_userdata_push_holder(lua_State *L, const char *kind, size_t size, lua_CFunction release);

/* Defines `release` for holders of a pointer to `type`, which `drop` releases; it ignores NULL. */
#define CS_HOLDER_RELEASE(release, type, drop)                                                     \
  static int release(lua_State *L) {                                                               \
    type **held = lua_touserdata(L, 1);                                                            \
    drop(*held);                                                                                   \
    *held = NULL;                                                                                  \
    return 0;                                                                                      \
  }
/* Defines `release` for holders of what `finish` releases, as often as it is called. */
#define CS_HOLDER_FINISH(release, finish)                                                          \
  static int release(lua_State *L) {                                                               \
    finish(lua_touserdata(L, 1));                                                                  \
    return 0;                                                                                      \
  }
