/* Time that passes.
 *
 *   base/clock.h   it never goes back
 */
#pragma once

#include "base/clock.h"
