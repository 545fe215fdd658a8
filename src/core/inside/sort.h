/* Sorting.
 *
 *   base/sort.h   no memory, n log n at most, and one result where the order is strict
 */
#pragma once

#include "base/sort.h"
