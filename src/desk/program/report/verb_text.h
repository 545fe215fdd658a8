/* The files of verbs/, which are part of the binary: verbs in Lua, and texts that they write. */
#pragma once

#include "lua/bind/built_in.h"

extern const cs_built_in cs_verb_texts[];
