/* Values of scenes.
 *
 *     model/scene/scene.h           Values are immutable, counted, and may be used by several
 *                                   threads.
 *     model/scene/check.h           What a value may be is asked here and nowhere else.
 *     model/scene/primitive_data.h  The parts of a primitive.
 *     model/scene/bounds.h          The box of what an object shows.
 *     model/scene/texture.h         The parts of a texture.
 *     model/scene/walk.h            Every value below a value is met once.
 *     model/scene/inspect.h         What lies under a point.
 *     model/scene/nearby.h          Effects that read neighbouring pixels.
 *     model/scene/value.h           What all values have in common.
 *     model/scene/displace.h        Objects whose pixels come from elsewhere.
 *     model/scene/grade.h           Objects that are graded.
 */
#pragma once

#include "model/scene/bounds.h"
#include "model/scene/check.h"
#include "model/scene/displace.h"
#include "model/scene/grade.h"
#include "model/scene/inspect.h"
#include "model/scene/nearby.h"
#include "model/scene/primitive_data.h"
#include "model/scene/scene.h"
#include "model/scene/texture.h"
#include "model/scene/value.h"
#include "model/scene/walk.h"
