/* Functions with the same bits on every machine and under every compiler.
 *
 *   base/elementary.h   sine, power and their like, by plain IEEE arithmetic
 *   base/functions.h    the functions of math.h for all numbers, infinities too
 *   base/splitmix.h     a seed gives the same sequence for ever
 */
#pragma once

#include "base/elementary.h"
#include "base/functions.h"
#include "base/splitmix.h"
