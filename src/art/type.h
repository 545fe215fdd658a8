/* Type through HarfBuzz, FriBidi and libunibreak: see the table in artwork/type.h. */
#ifndef CS_ART_TYPE_H
#define CS_ART_TYPE_H

#include "artwork/type.h"

extern const cs_type_functions cs_art_type;

#endif
