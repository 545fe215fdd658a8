/* PNG and deflate.
 *
 *     output/png/strips.h       Strips of a PNG by several workers.
 *     output/png/chunk.h        Chunks.
 *     output/deflate/deflate.h  Streams of deflate.
 */
#pragma once

#include "output/deflate/deflate.h"
#include "output/png/chunk.h"
#include "output/png/strips.h"
