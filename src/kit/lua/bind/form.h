/* Reading the table that a constructor is given: its names, its list, and values that a noun reads
 * itself; fields.h reads those that are described by data. An error is one sentence, raised at the
 * caller's line.
 *
 * INVARIANT: reading is raw (no metamethods run), so nothing a script does can change a table while
 * it is read. Scratch memory belongs to Lua and stays on the stack until the constructor returns,
 * so that an error at any point leaks nothing.
 */
#pragma once

#include <lauxlib.h>

#include "lua/bind/noun.h"

typedef struct cs_form {
  lua_State *L;
  const cs_noun *noun;
  int table;       /* absolute index */
  bool has_others; /* some fields were spelled in another way */
} cs_form;

/* Checks that the value at index is a table that has no unknown fields and no holes in its list. If
 * fields are spelled in another way (suggest.h) or given by their places, the value is replaced by
 * a copy that has them by celspan's names. */
cs_form cs_form_open(lua_State *L, const cs_noun *noun, int index);
/* Replaces the table at index in this way, and checks its names; the rest of it may be missing. */
void cs_form_settle(lua_State *L, const cs_noun *noun, int index);
/* Raises "noun: ..." with the formats of lua_pushfstring. */
_Noreturn void cs_form_fail(const cs_form *form, const char *format, ...);
/* Pushes a number as messages show it: a whole number has no point. */
const char *cs_form_digits(lua_State *L, double number);
/* Raises the core's refusal unless the status is OK. */
void cs_form_try(const cs_form *form, celspan_status status);

/* Pushes a field, without metamethods; returns its type. */
int cs_form_get(const cs_form *form, const char *name);
bool cs_form_has(const cs_form *form, const char *name);
/* "#rgb", "#rrggbb" and with alpha, the names of CSS in any case, and "transparent"; false: another
 * text. */
bool cs_form_colour(const char *text, celspan_paint *out);
/* The same as "#rrggbb" or another text that the core reads; NULL: no colour. */
#define CS_FORM_HEX 28
const char *cs_form_hex(const char *text, char out[CS_FORM_HEX]);
/* As cs_userdata_shown, with the nearest name of a colour: "redd"; did you mean "red"? */
const char *cs_form_shown_colour(lua_State *L, int index);
/* A texture, a paint or a colour like "#rrggbb": the value on top of the stack, the field `name`.
 * Borrowed from a value that is left on the stack. */
celspan_texture *cs_form_texture(const cs_form *form, const char *name);

/* The length of the array part. */
int cs_form_length(const cs_form *form);
#define CS_FORM_ITEMS_MOST 10000000 /* so that the size of all items fits into 32 bits */
/* Pushes item i; raises unless its type is `type`. what: "point", "stop". */
void cs_form_item(const cs_form *form, int i, int type, const char *what, const char *shape);
/* Points {x, y} of the table at index, or {x, y, w} where weights is not NULL. New scratch memory,
 * left on the stack. *weights remains NULL if no point has a weight. */
celspan_point *cs_form_points(const cs_form *form, int index, size_t count, const double **weights);
/* The numbers of an array field as scratch memory on the stack; NULL when missing. */
double *cs_form_array(const cs_form *form, const char *name, size_t *count);

/* Numbers and paints in tuples such as {at, paint}: value number `i` of the table at index. what,
 * item: the name of the tuple, for the message "stop 2"; of a list of paints, item is 0 and what
 * the name of each. */
double cs_form_tuple_number(const cs_form *form, int index, int i, const char *what, int item);
celspan_paint cs_form_tuple_paint(const cs_form *form, int index, int i, const char *what,
                                  int item);

/* A plain argument of a function or method that must be a number within 1e12. Raises "function:
 * name must be a number, got ...". */
double cs_form_argument(lua_State *L, int index, const char *function, const char *name);

/* count items of `size` bytes, owned by Lua, pushed. */
void *cs_form_scratch(lua_State *L, size_t count, size_t size);
