/* The light of the codes under a colour profile, and rows of pixels converted by it.
 *
 *   row of codes, 8 or 16 bits --convert--> RGBA floats: linear light, alpha straight
 *
 * INVARIANT: immutable and counted; any thread.
 */
#pragma once

#include "inside/hash.h"
#include "readers/layered/colour_module.h"
#include "readers/layered/input.h"

typedef enum cs_profile_codes {
  CS_PROFILE_SRGB = 0,
  CS_PROFILE_LINEAR,    /* light in the primaries of sRGB */
  CS_PROFILE_CONVERTED, /* other codes, which the table converts */
  CS_PROFILE_UNKNOWN    /* not understood */
} cs_profile_codes;

typedef struct cs_profile_table {
  atomic_size_t references;
  cs_memory *memory; /* borrowed from the painting or surface that has a reference */
  cs_hash hash;      /* the hash of the request */
  cs_profile_codes codes;
  cs_colour_table light;
} cs_profile_table;

/* The module for a context; loaded if the context has no module yet. Errors: INPUT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_profile_table_module(celspan_context *context,
                                                       const cs_colour_module **out);

cs_hash cs_profile_table_hash(const cs_colour_request *request);
/* input: for messages. Errors: INPUT and LIMIT if the profile ended the process that read it,
 * NO_MEMORY, CANCELLED. */
CELSPAN_CHECKED celspan_status cs_profile_table_create(celspan_context *context,
                                                       const cs_input *input,
                                                       const cs_colour_request *request,
                                                       cs_profile_table **out);
cs_profile_table *cs_profile_table_ref(cs_profile_table *table);
void cs_profile_table_unref(cs_profile_table *table);

/* Converts `count` pixels, RGBA of `bits` a channel. table: of codes CONVERTED. */
void cs_profile_table_convert(const cs_profile_table *table, int bits, const void *codes,
                              size_t count, float *out);
