/* Options that several functions share: antialiasing, sizes, crops, exposures. */
#ifndef CS_BIND_OPTIONS_H
#define CS_BIND_OPTIONS_H

#include "bind/form.h"

/* A frame as described by Lua; the desc points into it and onto the stack. */
typedef struct cs_options_frame {
  celspan_frame_desc desc;
  celspan_antialias_mode antialias;
} cs_options_frame;

/* The fields that cs_options_read reads. */
#define CS_OPTIONS_FIELDS                                                                          \
  {"size", NULL}, {"film", NULL}, {"crop", NULL}, {"workers", NULL}, {"antialias", NULL}, {        \
    "tolerance", NULL                                                                              \
  }

/* Reads the field `antialias`; false when it is missing. A kernel function is called here, and its
 * values are scratch memory left on the stack: *filter points to them. */
bool cs_options_antialias(const cs_form *form, celspan_antialias_mode *mode,
                          celspan_filter_desc *filter);
/* Reads size, film, crop, workers, antialias, tolerance. Sizes that are not given are 1920 x 1080. */
void cs_options_read(const cs_form *form, cs_options_frame *out);
/* The value at index, a rostrum or {{rostrum, weight}, ...}, as exposures of *desc: scratch memory,
 * left on the stack; the rostrums are borrowed from the value. name: for messages. */
void cs_options_exposures(lua_State *L, int index, const char *name, celspan_frame_desc *desc);
/* The fields that cs_options_coding reads. */
#define CS_OPTIONS_CODING                                                                          \
  {"depth", NULL}, {"colour", NULL}, {"alpha", NULL}, { "dither", NULL }

/* Reads depth, colour, alpha, dither. */
void cs_options_coding(const cs_form *form, celspan_coding *out);
/* The table at index, or a new empty one, checked against the noun. It stays on the stack. */
cs_form cs_options_open(lua_State *L, const cs_noun *noun, int index);

#endif
