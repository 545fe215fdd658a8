/* Functions with the same bits on every machine.
 *
 *     base/elementary.h  The last bit does not change without new goldens.
 *     base/splitmix.h    The sequence of numbers of a seed does not change.
 *     base/functions.h   The functions of math.h for all numbers, with the same bits everywhere.
 */
#pragma once

#include "base/elementary.h"
#include "base/functions.h"
#include "base/splitmix.h"
