/* The verbs: their operands and options, and their help. Each is a file of its name in verbs/, in
 * Lua.
 */
#pragma once

#include "program/options/request.h"

/* In the order of the help; the last one has no name. */
extern const cs_verb cs_verbs[];
/* NULL: there is none. */
const cs_verb *cs_verb_named(const char *name);
