/* Reading the named fields of a table into a description of the core, as their rows say. */
#pragma once

#include "lua/bind/form.h"

/* Reads into *desc all fields that the noun does not read itself; missing fields do not change it.
 * Raises an error for wrong types and for numbers outside their range. Texts and textures are
 * borrowed from values that are left on the stack. */
void cs_fields_read(const cs_form *form, void *desc);
/* Pushes words (ended by NULL) for a message: "a", "b" or "c". */
const char *cs_fields_push_words(lua_State *L, const char *const *words);
/* The index of the word on top of the stack among words (ended by NULL). name: of its field. */
int cs_fields_word(const cs_form *form, const char *name, const char *const *words);
