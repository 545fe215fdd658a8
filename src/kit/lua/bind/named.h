/* Names of values, and the lines of scripts where they were made.
 *
 * While a constructor runs, the context knows the line of the script that called it: of the
 * innermost function that is not one of celspan's own. A method such as :rotate needs no line,
 * because the core keeps the line of the value that it changes; :with copies the line here.
 */
#pragma once

#include "lua/bind/userdata.h"

/* Makes the caller's line the one that the context gives to new values from now on. */
void cs_named_begin(lua_State *L, celspan_context *context);
/* The same, with the line where `value` was made. */
void cs_named_begin_as(celspan_context *context, const cs_userdata *value);
void cs_named_end(celspan_context *context);

/* Whether the callers of these lines are kept from now on, so that cs_named_push_callers knows
 * them; this needs a walk over the stack for every value. At first they are not kept. */
void cs_named_keep_callers(lua_State *L, bool is_kept);
/* Pushes the text of cs_caller_push_callers from the time when a value with this number in its mark
 * was made. */
void cs_named_push_callers(lua_State *L, uint32_t number);

/* Whether the words of texts are kept from now on, so that cs_named_push_words has them. At first
 * they are not kept. */
void cs_named_keep_words(lua_State *L, bool is_kept);
/* For a constructor of texts, after cs_named_begin: the words of the new values, and their size.
 * em: of the letters. has_letters: each value is one letter of these words. */
typedef struct cs_named_words {
  const char *text;
  size_t size;
  double em;
  bool has_letters;
} cs_named_words;
void cs_named_add_words(lua_State *L, celspan_context *context, const cs_named_words *words);
/* The words of a value with this number in its mark; false: there are none. Pushes a value that
 * keeps the text alive. */
bool cs_named_push_words(lua_State *L, uint32_t number, cs_named_words *out);

/* Gives `value`, which is new and not shared yet, the name of `from`, if it has one. */
void cs_named_copy(lua_State *L, const cs_userdata *from, cs_userdata *value);
/* v:named("hand") */
int cs_named_method(lua_State *L);
