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
  const char *noun;  /* the function that needs the list, "circle" */
  const char *field; /* if the list is a field: "centre"; NULL: `whole` and `item` name it */
  const char *whole; /* "the matrix", or with %d for `number` "point %d" */
  /* for value number i: "value %d of it"; with `number`, "point %d: its value %d" */
  const char *item;
  int number; /* 0: it is not one of several lists */
  /* Its required form, "{x, y}", with the names of its values; NULL: "an array of 9 numbers". */
  const char *shape;
} cs_numbers_name;

/* Reads the `least` to `most` numbers of the list at index, and returns how many there are. Raises
 * when there are fewer or more. */
int cs_numbers_read(lua_State *L, int index, const cs_numbers_name *name, int least, int most,
                    double *out);
/* Reads all `count` numbers of the table at index; the table must have this length. */
void cs_numbers_read_all(lua_State *L, int index, const cs_numbers_name *name, int count,
                         double *out);
/* The value at index, which must be a finite number. subject: its name in messages, "the angle". */
double cs_numbers_check(lua_State *L, int index, const char *noun, const char *subject);

/* Pushes a number as messages show it: a whole number has no point. */
const char *cs_numbers_digits(lua_State *L, double number);
