/* OpenEXR of one part in rows, uncompressed or compressed by runs or zlib, as celspan writes it
 * (output/exr/exr.h). Other files are refused with a sentence. */
#pragma once

#include "output/exr/exr.h"
#include "plugins/raster/raster.h"
