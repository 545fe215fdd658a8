/* The primaries and the white of linear light, as chromaticities in the order of OpenEXR:
 *
 *   x and y of red, of green, of blue, and of white
 *
 * celspan's light has those of BT.709. Light with another white is adapted by Bradford's matrix, so
 * that white stays white.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>

enum { CS_PRIMARIES = 8 };

/* The weights of luma in BT.709 and sRGB (ITU-R BT.709, 3.2), and the luma of a colour; `number` is
 * the type of the weights, float or double. */
#define CS_LUMA_RED 0.2126
#define CS_LUMA_GREEN 0.7152
#define CS_LUMA_BLUE 0.0722
#define CS_LUMA(number, r, g, b)                                                                   \
  ((number)CS_LUMA_RED * (r) + (number)CS_LUMA_GREEN * (g) + (number)CS_LUMA_BLUE * (b))

typedef struct cs_known_primaries {
  const char *name;
  float xy[CS_PRIMARIES];
} cs_known_primaries;

/* BT.709, then others; the last one has no name. */
extern const cs_known_primaries cs_primaries_known[];

/* The name of known primaries, or NULL. */
const char *cs_primaries_name(const float xy[CS_PRIMARIES]);
/* The matrix, in rows, from light of these primaries to that of BT.709. false: they are the
 * primaries of no light. */
bool cs_primaries_to_bt709(const float xy[CS_PRIMARIES], double out[9]);
/* The matrix from light of BT.709 to that of these known primaries. */
void cs_primaries_from_bt709(const cs_known_primaries *known, double out[9]);

/* Converts colours of four floats, in place. */
typedef void (*cs_primaries_convert)(void *user, float *rgba, size_t count);
/* The primaries of the numbers that a conversion makes of light, if these are light, too. */
bool cs_primaries_of(cs_primaries_convert convert, void *user, float xy[CS_PRIMARIES]);
