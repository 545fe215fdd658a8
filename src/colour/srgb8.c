#include "colour/srgb8.h"

cs_srgb8 cs_srgb8_choose(cs_isa isa) { return CS_WIDE_CHOOSE(isa, cs_srgb8_code); }
