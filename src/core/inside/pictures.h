/* Decoded pictures.
 *
 *   model/pictures/module.h          the table of a picture module: no exception crosses it, no
 *                                    memory changes its owner
 *   model/pictures/store.h           blocks of texels in one budget, shared by all threads
 *   model/pictures/load.h            a block is read by one thread at a time
 *   model/pictures/picture.h         a picture is a value; its texels are found by its hash
 *   model/pictures/surface.h         pixels in memory never change, or their key promises so
 *   model/pictures/configuration.h   the spaces of an OpenColorIO configuration
 */
#pragma once

#include "model/pictures/configuration.h"
#include "model/pictures/module.h"
#ifndef __cplusplus /* modules in C++ see their table alone */
#include "model/pictures/load.h"
#include "model/pictures/picture.h"
#include "model/pictures/store.h"
#include "model/pictures/surface.h"
#endif
