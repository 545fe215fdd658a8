/* What a PNG tells of its colours before its data: a profile, or the chunks that stand for one.
 *
 *   iCCP   name, NUL, 0, profile in zlib     sRGB   that it is sRGB
 *   gAMA   a power                           cHRM   white and primaries
 *
 * The first two win over the others; without any the codes are those of sRGB.
 */
#ifndef CS_PAINTING_PNG_PROFILE_H
#define CS_PAINTING_PNG_PROFILE_H

#include "painting/profile.h"
#include "painting/zip.h"

/* What stands in front of the data, at most: behind it chunks of colour are not looked for. */
#define CS_PNG_PROFILE_SCANNED ((int64_t)1 << 20)

/* *scanned: the bytes that were unpacked for it. Errors: INPUT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_png_read_profile(celspan_context *context, const cs_input *input,
                                                   const cs_zip_member *member, cs_profile *out,
                                                   int64_t *scanned);

#endif
