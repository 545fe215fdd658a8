/* Colours.
 *
 *   model/colour/transfer.h         curves between light and codes, with the same bits everywhere
 *   model/colour/transfer_names.h   one list of their names
 *   model/colour/primaries.h        primaries in the order of OpenEXR
 *   model/colour/blend.h            the formula of each mode
 *   model/colour/space.h            0 and 1 do not change, and a colour that goes there and back
 *                                   stays
 *   model/colour/grade.h            steps that do nothing are left out, to the bit
 *   model/colour/srgb8.h            the pixel of a colour, and back
 *   model/colour/srgb8_lanes.h      the same for a register of pixels
 */
#pragma once

#include "model/colour/transfer_names.h"
#ifndef __cplusplus /* modules in C++ see names alone */
#include "model/colour/blend.h"
#include "model/colour/grade.h"
#include "model/colour/primaries.h"
#include "model/colour/space.h"
#include "model/colour/srgb8.h"
#include "model/colour/srgb8_lanes.h"
#include "model/colour/transfer.h"
#endif
