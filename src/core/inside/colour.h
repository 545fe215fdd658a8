/* Colours.
 *
 *     model/colour/transfer.h        Codes and light of sRGB.
 *     model/colour/transfer_names.h  Names of curves.
 *     model/colour/blend.h           Modes in which layers are blended.
 *     model/colour/space.h           Spaces in which layers are mixed.
 *     model/colour/primaries.h       Primaries of files.
 *     model/colour/grade.h           Grades.
 *     model/colour/srgb8.h           Codes of 8 bits.
 *     model/colour/srgb8_lanes.h     Codes of 8 bits, several at a time.
 */
#pragma once

#include "model/colour/blend.h"
#include "model/colour/grade.h"
#include "model/colour/primaries.h"
#include "model/colour/space.h"
#include "model/colour/srgb8.h"
#include "model/colour/srgb8_lanes.h"
#include "model/colour/transfer.h"
#include "model/colour/transfer_names.h"
