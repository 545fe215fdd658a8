/* Lists of numbers, such as {x, y}, in any table. Messages name the place of the wrong number.
 *
 *   circle: centre[1] must be a number, got nil
 *   circle: field 'centre' must be a point {x, y}: write {10, 20}, not {x = 10, y = 20}
 *   transform: the matrix must be {a,b,c, d,e,f, g,h,i}, got 8 values
 *
 * INVARIANT: every number read here is finite. Ranges are checked by the core.
 */
#pragma once

#include <lua.h>

/* The name of a list in messages. */
typedef struct cs_numbers_name {
  const char *noun;  /* who asks for it, "circle" */
  const char *field; /* it is a field, "centre"; NULL: it is called as whole and item say */
  const char *whole; /* "the matrix", or with %d for `number` "point %d" */
  const char *item; /* number i of it: "value %d of it"; after `number`, "point %d: its value %d" */
  int number;       /* 0: it is not one of many */
  /* Its required form, "{x, y}", by names of its places; NULL: "an array of 9 numbers". */
  const char *shape;
} cs_numbers_name;

/* Reads the `least` to `most` numbers of the list at index, and returns how many there are. Raises
 * when there are fewer or more. */
int cs_numbers_read(lua_State *L, int index, const cs_numbers_name *name, int least, int most,
                    double *out);
/* Reads all `count` numbers of the table at index, whose length that is. */
void cs_numbers_read_all(lua_State *L, int index, const cs_numbers_name *name, int count,
                         double *out);
/* The value at index, which must be a finite number. subject: its name in messages, "the angle". */
double cs_numbers_check(lua_State *L, int index, const char *noun, const char *subject);

/* Pushes a number as messages show it: a whole number has no point. */
const char *cs_numbers_digits(lua_State *L, double number);
