/* Sorting.
 *
 *     base/sort.h  The order of equal keys is the one that they came in.
 */
#pragma once

#include "base/sort.h"
