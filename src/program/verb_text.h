/* The texts of verbs/, which are part of the binary: verbs in Lua, and texts that they write. */
#pragma once

#include <lauxlib.h>

/* A text in the binary, which ends with a zero. */
typedef struct cs_verb_text {
  const char *name; /* of its file */
  const char *bytes;
  size_t size;
} cs_verb_text;

extern const cs_verb_text cs_verb_texts[]; /* the last one has no name */

/* The text of that name, which must exist. */
const cs_verb_text *cs_verb_text_find(const char *name);
/* Pushes the text of that name as a function. Raises. */
void cs_verb_text_load(lua_State *L, const char *name);
