/* The field `grain` of films, rostrums and cels, which lua/celspan/film/grain.lua makes. */
#pragma once

#include "lua/bind/form.h"

#define CS_GRAIN_FIELD                                                                             \
  { "grain", CS_OWN("celspan.grain"), .about = "Grey grain, another one in each frame" }

/* Raises where the field is no grain. */
void cs_grain_check(const cs_form *form);
/* Pushes the objects of a cel's form as one object with its grain; false: it has none, and nothing
 * is pushed. */
bool cs_grain_push_object(const cs_form *form);
/* Pushes the texture of a rostrum's grain, which is borrowed from it; NULL: it has none. */
celspan_texture *cs_grain_push_texture(const cs_form *form);
/* Sets the number of the frame that is being built, for the grain of its cels, and returns the one
 * before: a frame may ask for a frame of another film. */
int64_t cs_grain_begin(lua_State *L, int64_t number);
