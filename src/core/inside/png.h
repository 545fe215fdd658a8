/* PNG and deflate.
 *
 *   output/png/strips.h        one PNG from strips of several workers, with the same bytes
 *   output/png/chunk.h         chunks with their sums
 *   output/deflate/deflate.h   a stream of deflate from runs and bytes
 */
#pragma once

#include "output/deflate/deflate.h"
#include "output/png/chunk.h"
#include "output/png/strips.h"
