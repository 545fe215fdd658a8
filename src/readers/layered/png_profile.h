/* The chunks before a PNG's data that describe its colours: a profile, or values in its place.
 *
 *   iCCP   name, NUL, 0, profile in zlib     sRGB   that it is sRGB
 *   gAMA   a power                           cHRM   white and primaries
 *
 * The first two take precedence; without any of them the codes are those of sRGB.
 */
#pragma once

#include "celspan/layers.h"
#include "readers/layered/profile.h"
#include "readers/layered/zip.h"

/* Bytes before the data in which chunks of colour are looked for. */
#define CS_PNG_PROFILE_SCANNED ((int64_t)1 << 20)

/* *scanned: the bytes that were unpacked for it. Errors: INPUT, NO_MEMORY; those of
 * cs_profile_read. */
CELSPAN_CHECKED celspan_status cs_png_read_profile(celspan_context *context, const cs_input *input,
                                                   const cs_zip_member *member,
                                                   celspan_painting *painting, cs_profile *out,
                                                   int64_t *scanned);
