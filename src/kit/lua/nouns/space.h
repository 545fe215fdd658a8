/* The field `space` of films, rostrums and groups: "linear" or "srgb"; if it is missing, the space
 * around them. */
#pragma once

#include "inside/colour.h"
#include "lua/bind/noun.h"

typedef struct cs_own_space {
  bool is_given;
  int word; /* the word of cs_space_words */
} cs_own_space;

#define CS_OWN_SPACE(desc, member, otherwise)                                                      \
  {                                                                                                \
    "space", CS_CHOICE(desc, member.word, cs_space_words), CS_HAS(desc, member.is_given),          \
        .about = "The numbers that are mixed in it: linear light, or sRGB codes",                  \
        .fallback = otherwise                                                                      \
  }

static inline celspan_space cs_own_space_of(const cs_own_space *own) {
  return own->is_given ? (celspan_space)(CELSPAN_SPACE_LINEAR + own->word) : CELSPAN_SPACE_AROUND;
}
