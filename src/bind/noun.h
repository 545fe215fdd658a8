/* What there is to make in Lua, as data.
 *
 *   noun   what a constructor makes ("circle"): its fields, and how they become a value
 *   kind   what can be done with it ("object"): one metatable each
 */
#ifndef CS_BIND_NOUN_H
#define CS_BIND_NOUN_H

#include <lua.h>

#include "celspan/celspan.h"

struct cs_userdata;
struct cs_form;

typedef struct cs_kind {
  const char *name; /* of the metatable, "celspan.object" */
  void (*unref)(void *handle);
  celspan_status (*transform)(celspan_context *context, void *handle, const celspan_matrix *matrix,
                              void **out);
  celspan_status (*fade)(celspan_context *context, void *handle, double k, void **out);
  celspan_status (*bounds)(celspan_context *context, const void *handle, bool *is_there,
                           celspan_box *out);
  bool (*contains)(const void *handle, celspan_point point);
  /* Pushes a field that is not kept but found in the core; false when there is none of this name.
   * NULL: there are none. */
  bool (*push_field)(lua_State *L, const struct cs_userdata *value, const char *key);
  size_t own_size; /* bytes that a value has of its own: a paint's numbers, a frame's seed */
  int kept;        /* user values of a value beside its fields, which are the first */
} cs_kind;

typedef struct cs_field {
  const char *name;
  const char *preset; /* what it reads as when it was left out, a number or a word; NULL: nil */
} cs_field;

/* What the array part of the table holds. */
typedef enum cs_list {
  CS_LIST_NONE,
  CS_LIST_TUPLE, /* a fixed number of values: :with changes them one by one */
  CS_LIST_ITEMS  /* any number of items: :with{a, b} replaces them all */
} cs_list;

typedef struct cs_noun {
  const char *name;
  const cs_kind *kind; /* NULL: a table of options, not a value */
  cs_list list;
  const char *item;          /* "object": one of them; NULL without a list */
  const cs_field *fields;    /* ended by a NULL name */
  const char *places;        /* TUPLE: "{x, y, w, h}" for messages; NULL: they have no names */
  const char *either[2];     /* fields of which only one may be given; NULL: none */
  const char *const *second; /* fields that go with either[1] alone, ended by NULL; NULL: none */
  void (*create)(const struct cs_form *form, struct cs_userdata *value);
  void (*complete)(lua_State *L,
                   int fields); /* fills in fields that follow from others; NULL: none */
} cs_noun;

#endif
