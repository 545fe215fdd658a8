/* Threads.
 *
 *   base/thread_pool.h   fewer threads do the same work; signals reach the calling thread alone
 *   base/pipeline.h      items are made by any worker and delivered in their order
 */
#pragma once

#include "base/pipeline.h"
#include "base/thread_pool.h"
