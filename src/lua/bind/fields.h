/* Reading the named fields of a table into a description of the core, as their rows say. */
#pragma once

#include "lua/bind/form.h"

/* Reads the fields that the noun does not read itself into *desc, which fields that are not given
 * leave unchanged. Raises an error for wrong types and for numbers outside their range. Texts and
 * textures are borrowed from values that are left on the stack. */
void cs_fields_read(const cs_form *form, void *desc);
/* The place of the word on top of the stack among words (ended by NULL). name: of its field. */
int cs_fields_word(const cs_form *form, const char *name, const char *const *words);
