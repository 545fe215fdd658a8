/* Memory that is bounded.
 *
 *     base/cache.h  What is held stays while it is used.
 *     base/arena.h  All is freed at once, and nothing moves.
 */
#pragma once

#include "base/arena.h"
#include "base/cache.h"
