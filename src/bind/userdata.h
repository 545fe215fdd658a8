/* Values: full userdata that hold a reference of something of the core's, and the fields they were
 * made from.
 *
 *   noun   what a constructor makes ("circle"): its fields, and how they become a value
 *   kind   what can be done with it ("object"): one metatable each
 *
 * INVARIANT: a userdata is made closed (handle NULL), then filled; __gc releases it. Its user value
 * is a table of its own that no script can reach: fields that are read come out as copies.
 */
#ifndef CS_BIND_USERDATA_H
#define CS_BIND_USERDATA_H

#include <lua.h>

#include "bind/form.h"

typedef struct cs_kind {
  const char *name; /* of the metatable, "celspan.object" */
  void (*unref)(void *handle);
  celspan_status (*transform)(celspan_context *context, void *handle, const celspan_matrix *matrix,
                              void **out);
  celspan_status (*fade)(celspan_context *context, void *handle, double k, void **out);
  bool (*bounds)(const void *handle, celspan_box *out);
  bool (*contains)(const void *handle, celspan_point point);
} cs_kind;

typedef struct cs_userdata {
  const cs_noun *noun;
  void *handle;          /* a reference of the core's; NULL: closed, or a noun without one */
  celspan_matrix matrix; /* objects, cels: applied since the constructor, for :with */
  double fade;           /* likewise */
  bool is_chain;         /* made by an operator and not touched since: the next one flattens it */
  celspan_paint paint;   /* paints */
  uint64_t seed;         /* frames: for f:random */
} cs_userdata;

extern const cs_noun cs_noun_paint, cs_noun_rostrum, cs_noun_film;
extern const cs_kind cs_kind_paint, cs_kind_texture, cs_kind_object, cs_kind_cel, cs_kind_rostrum,
    cs_kind_film, cs_kind_frame;

/* Makes the metatable of a kind. methods: NULL-ended, or NULL. Every kind gets __index, __newindex,
 * __tostring, __gc and __name. */
void cs_userdata_register(lua_State *L, const cs_kind *kind, const luaL_Reg *methods);

/* Pushes a closed value. */
cs_userdata *cs_userdata_push(lua_State *L, const cs_noun *noun);
/* Gives the value on top of the stack a copy of the table at `fields`, with the noun's presets. */
void cs_userdata_freeze(lua_State *L, const cs_noun *noun, int fields);
/* Checks, makes and pushes a value from the table at `fields`. */
void cs_userdata_construct(lua_State *L, const cs_noun *noun, int fields);
/* Pushes the constructor of a noun. */
void cs_userdata_push_constructor(lua_State *L, const cs_noun *noun);

/* The value at index if it is of this kind, else NULL. Raises when it is closed. */
cs_userdata *cs_userdata_test(lua_State *L, int index, const cs_kind *kind);
/* The `self` of a method; raises when it is not of this kind. */
cs_userdata *cs_userdata_self(lua_State *L, const cs_kind *kind, const char *method);

/* Pushes what the value at index is, for messages: "a circle", "number". */
const char *cs_userdata_type(lua_State *L, int index);

/* The method :with of every kind that has one. */
int cs_userdata_with(lua_State *L);

#endif
