/* Numbers.
 *
 *     base/number.h   Functions that are inline, and have the same result on every machine.
 *     base/decimal.h  Texts become the nearest double, whatever the locale.
 *     base/hex.h      Digits of base 16.
 */
#pragma once

#include "base/decimal.h"
#include "base/hex.h"
#include "base/number.h"
