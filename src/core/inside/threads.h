/* Threads.
 *
 *     base/thread_pool.h  Tasks are taken in order; the calling thread works, too.
 *     base/pipeline.h     Results come in the order of their tasks.
 */
#pragma once

#include "base/pipeline.h"
#include "base/thread_pool.h"
