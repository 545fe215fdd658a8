/* Fields of the table on top of the stack, and lists of numbers, also read. */
#pragma once

#include <lauxlib.h>
#include <stdbool.h>
#include <stddef.h>

void cs_put_flag(lua_State *L, const char *name, bool flag);
void cs_put_integer(lua_State *L, const char *name, lua_Integer number);
void cs_put_number(lua_State *L, const char *name, lua_Number number);
void cs_put_numbers(lua_State *L, const char *name, const double *numbers, size_t count);
void cs_put_pair(lua_State *L, const char *name, lua_Integer first, lua_Integer second);
/* text: NULL puts nil. */
void cs_put_text(lua_State *L, const char *name, const char *text);

/* Pushes a list. */
void cs_push_numbers(lua_State *L, const double *numbers, size_t count);
/* Reads `count` numbers of the table that the argument at index must be. */
void cs_read_numbers(lua_State *L, int index, int count, double *out);
