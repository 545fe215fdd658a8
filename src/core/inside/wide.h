/* Vectors of floats.
 *
 *   base/wide.h   a lane has the bits of the same operation on one float, whichever instructions
 *                 are chosen
 */
#pragma once

#include "base/wide.h"
