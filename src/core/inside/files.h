/* Files.
 *
 *     base/open.h               A descriptor is not inherited by processes that are started.
 *     output/sinks/temporary.h  A file appears under its name whole, or not at all.
 *     output/sinks/file_copy.h  A copy has the bytes of what was measured, or is not made.
 */
#pragma once

#include "base/open.h"
#include "output/sinks/file_copy.h"
#include "output/sinks/temporary.h"
