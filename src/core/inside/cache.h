/* Memory that is kept.
 *
 *   base/arena.h   what was taken does not move, and ends with the next reset
 *   base/cache.h   what is pinned stays; results depend neither on the budget nor on the workers
 */
#pragma once

#include "base/arena.h"
#include "base/cache.h"
