/* Options that several functions share: antialiasing, sizes, crops, codings, exposures. */
#pragma once

#include "inside/films.h"
#include "lua/bind/fields.h"

/* The options of all functions, while they are read; each function uses only the options of its own
 * noun. The desc points into this struct and to the stack. */
typedef struct cs_options {
  cs_form form; /* the form of the table */
  celspan_frame_desc desc;
  celspan_coding coding;
  const char *format;
  int frame;
  bool has_size, has_film, has_frame, has_rows, dithers;
  int32_t size[2], crop[4];
  double film[2], rows[2];
} cs_options;

extern const cs_noun cs_noun_filter, cs_noun_render, cs_noun_pixels, cs_noun_stack, cs_noun_bytes,
    cs_noun_write, cs_noun_spans, cs_noun_probe, cs_noun_plane, cs_noun_plane_view;

/* Reads the table at index, or a new empty one, as options of the noun. It stays on the stack. The
 * default size is 1920 x 1080. */
void cs_options_read(lua_State *L, const cs_noun *noun, int index, cs_options *out);
/* Sizes that were not given are taken from the film. */
void cs_options_use_film(cs_options *options, const cs_film_info *film);
/* Reads the field `antialias`; false if it is missing. A kernel function is called here, and its
 * values are scratch memory left on the stack: *filter points to them. */
bool cs_options_antialias(const cs_form *form, celspan_antialias_mode *mode,
                          const celspan_filter_desc **filter);
