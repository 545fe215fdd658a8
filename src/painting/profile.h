/* Colour profiles (ICC) that lie in paintings: how the codes of their pixels are meant.
 *
 *   header, 128 bytes | count of tags | signature offset size | ... | what the tags hold
 *
 *   rXYZ gXYZ bXYZ    where red, green and blue lie, seen by the white of D50
 *   rTRC gTRC bTRC    from codes to light: a power, a table or a formula; of grey kTRC
 *   desc              the name of the profile
 *
 * Two kinds are honoured: codes of sRGB, and light itself in the primaries of sRGB, or in grey.
 * Pixels of all others are taken as codes of sRGB, and a note of the painting names the profile.
 * Damaged profiles are others without a name: a profile is never a reason to refuse a painting.
 */
#ifndef CS_PAINTING_PROFILE_H
#define CS_PAINTING_PROFILE_H

#include "painting/contents.h"

#define CS_PROFILE_BYTES ((size_t)4 << 20) /* larger ones are others without a name */

typedef enum cs_profile_codes {
  CS_PROFILE_SRGB = 0,
  CS_PROFILE_LINEAR,
  CS_PROFILE_OTHER
} cs_profile_codes;

typedef struct cs_profile {
  cs_profile_codes codes;
  char name[64]; /* printable ASCII; "": not known */
} cs_profile;

/* What the bytes of a profile tell. */
void cs_profile_read(const unsigned char *bytes, size_t size, cs_profile *out);
/* What the name of a profile tells, where it is not embedded: those that Krita comes with. */
void cs_profile_of_name(const char *name, cs_profile *out);
/* What the gAMA and cHRM chunks of a PNG tell: light as a power of the codes, in 1/100,000 (above 0); x
 * and y of white, red, green and blue in the same unit, or NULL. */
void cs_profile_of_power(uint32_t power, const uint32_t *places, cs_profile *out);
/* The word for the codes: that of celspan_picture_desc. */
const char *cs_profile_colour(const cs_profile *profile);
/* Notes a profile that is not honoured, on a layer or on the whole painting: CS_CONTENTS_NONE.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_profile_note(celspan_context *context, celspan_painting *painting,
                                               size_t layer, const cs_profile *profile);

#endif
