/* Decoded pictures.
 *
 *     model/pictures/module.h         The table of functions of a module of pictures.
 *     model/pictures/store.h          Pictures of a context, which are decoded once.
 *     model/pictures/picture.h        The parts of a picture.
 *     model/pictures/load.h           Rows of a picture.
 *     model/pictures/surface.h        Pictures that a host or a reader gives.
 *     model/pictures/configuration.h  Spaces of a configuration.
 */
#pragma once

#include "model/pictures/configuration.h"
#include "model/pictures/load.h"
#include "model/pictures/module.h"
#include "model/pictures/picture.h"
#include "model/pictures/store.h"
#include "model/pictures/surface.h"
