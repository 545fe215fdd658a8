/* Working spaces: the numbers that are mixed are light, or codes of sRGB.
 *
 *     pigment, linear --encode--> pigment, codes        S = beta * pigment; beta and T stay
 *
 *     group in one space                                the space around it
 *     S, T  -- S / d --> colour --curve--> colour * d --> S, T      d: how much of it is there
 *
 * Invariant: 0, 1 and T do not change, to the bit; a colour that goes there and back is the same
 * within rounding.
 */
#pragma once

#include "base/vector.h"
#include "base/wide.h"
#include "model/colour/paint.h"

#define CS_SPACES (CELSPAN_SPACE_SRGB + 1) /* the length of arrays that are indexed by a space */

/* the words of celspan_space, from LINEAR on, ended by NULL */
extern const char *const cs_space_words[];

/* The space that `own` means inside the space `around`; at the outermost level, around is
 * LINEAR. */
static inline celspan_space cs_space_inside(celspan_space own, celspan_space around) {
  return own != CELSPAN_SPACE_AROUND      ? own
         : around == CELSPAN_SPACE_AROUND ? CELSPAN_SPACE_LINEAR
                                          : around;
}

/* The factor d for one channel of a colour whose coverage is `share`: the greater of `share` and
 * min(s, 1). */
static inline float cs_space_there(float s, float share) {
  float size = s < 0 ? -s : s, least = size < 1 ? size : 1;
  return share > least ? share : least;
}

/* One channel of a colour whose coverage is `share`, converted from the other space to this one, as
 * described above. */
float cs_space_channel(celspan_space to, float s, float share);
/* Converts `count` channels at once, to the same bits as one by one. (space_wide.c) */
CS_WIDE_DECLARE(void, cs_space_channels,
                (celspan_space to, const float *shares, int32_t count, float *s));
/* The same for the first three channels of `count` pixels; the fourth stays. */
CS_WIDE_DECLARE(void, cs_space_pixels,
                (celspan_space to, const float *shares, int32_t count, float *s));
/* The sRGB codes of straight light, to the bits of cs_transfer_encode. (space_wide.c) */
CS_WIDE_DECLARE(void, cs_space_codes, (int32_t count, float *colours));

/* Converts three channels. t: the transmission of each channel, of which only the share `keep`
 * counts. */
static inline cs_v4 cs_space_leave(celspan_space to, cs_v4 e, cs_v4 t, float keep) {
  return (cs_v4){cs_space_channel(to, e[0], 1 - keep * t[0]),
                 cs_space_channel(to, e[1], 1 - keep * t[1]),
                 cs_space_channel(to, e[2], 1 - keep * t[2]), 0};
}

/* Converts a colour from premultiplied linear light to premultiplied numbers of a space, or
 * back. */
void cs_space_encode(celspan_space to, float rgba[4]);
void cs_space_decode(celspan_space from, float rgba[4]);

/* A paint of linear light in a space: its pigment is converted. */
cs_paint cs_space_paint(celspan_space space, cs_paint paint);
/* A flat light, converted. */
celspan_light cs_space_light(celspan_space space, celspan_light light);
