/* Registers.
 *
 *     base/wide.h  A lane is a float, and operations on it round as those on a float.
 */
#pragma once

#include "base/wide.h"
