/* Numbers from outside.
 *
 *   base/number.h    a number that passed the check is finite and at most 1e12; doubles become
 *                    integers without traps
 *   base/decimal.h   a text is the same number on every machine, whatever the locale
 *   base/hex.h       digits of base 16 alone
 */
#pragma once

#include "base/decimal.h"
#include "base/hex.h"
#include "base/number.h"
