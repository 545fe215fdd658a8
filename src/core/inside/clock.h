/* Time that passes.
 *
 *     base/clock.h  It never goes back.
 */
#pragma once

#include "base/clock.h"
