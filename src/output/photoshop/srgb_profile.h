/* A colour profile of sRGB, for files that say by one what their codes mean.
 * Source: ICC.1:2010 (profile version 4.3); IEC 61966-2-1.
 */
#pragma once

#include <stddef.h>

enum { CS_SRGB_PROFILE = 496 }; /* bytes */

void cs_srgb_profile(unsigned char out[CS_SRGB_PROFILE]);
