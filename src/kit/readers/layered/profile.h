/* Colour profiles (ICC) of paintings: how the codes of their pixels are meant.
 *
 *   codes       the layer's colour   its pixels
 *   SRGB        "srgb"               as they are: without a profile too
 *   LINEAR      "linear"             as they are
 *   CONVERTED   "linear"             floats, by the profile's table
 *   UNKNOWN     "srgb"               as they are, with a note
 *
 * A damaged profile is UNKNOWN, never a reason to refuse a painting.
 *
 * INVARIANT: a painting has a table for each of its different profiles, at most CS_PROFILES_MOST,
 * until its surfaces are made; the surfaces that need it have references.
 */
#pragma once

#include "celspan/layers.h"
#include "readers/layered/contents.h"
#include "readers/layered/profile_table.h"

#define CS_PROFILE_BYTES ((size_t)4 << 20) /* larger profiles are not read */

typedef struct cs_profile {
  cs_profile_codes codes;
  char name[64];           /* printable ASCII; "": not known */
  cs_profile_table *table; /* the table of CONVERTED: the painting's */
} cs_profile;

/* Reads the profile of the request. Errors: LIMIT for too many different profiles; those of
 * cs_profile_table_create. */
CELSPAN_CHECKED celspan_status cs_profile_read(celspan_context *context, const cs_input *input,
                                               celspan_painting *painting,
                                               const cs_colour_request *request, cs_profile *out);
/* The meaning of a profile that is not embedded, by its name: a profile that comes with Krita. */
void cs_profile_of_name(const char *name, cs_profile *out);
/* The values of the gAMA and cHRM chunks of a PNG; has_places: whether there is a cHRM. Errors:
 * those of cs_profile_read. */
CELSPAN_CHECKED celspan_status cs_profile_of_power(celspan_context *context, const cs_input *input,
                                                   celspan_painting *painting,
                                                   const cs_colour_request *request,
                                                   cs_profile *out);
/* Sets the meaning of the codes of a layer. */
void cs_profile_apply(const cs_profile *profile, cs_contents_layer *layer);
/* Notes a profile that is not understood, on a layer or on the whole painting: CS_CONTENTS_NONE.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_profile_note(celspan_context *context, celspan_painting *painting,
                                               size_t layer, const cs_profile *profile);
