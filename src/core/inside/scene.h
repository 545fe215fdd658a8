/* Values of scenes.
 *
 *   model/scene/scene.h            values never change, and every number in them was checked
 *   model/scene/check.h            a wrong argument is refused with its noun, its field and what is
 *                                  allowed
 *   model/scene/value.h            how a value is made: its memory, its hash, its references
 *   model/scene/primitive_data.h   every primitive has an outline, procedures too
 *   model/scene/texture.h          the kinds of textures, and what each has
 *   model/scene/texture_fit.h      no primitive has a gradient without points
 *   model/scene/bounds.h           boxes are tight, except the one that says otherwise
 *   model/scene/walk.h             each value below another is visited, shared ones each time they
 *                                  occur
 *   model/scene/inspect.h          a picture that cannot be read is reported once a primitive, in
 *                                  order
 *   model/scene/nearby.h           a rule is a function of the samples around a place, and of
 *                                  nothing else
 *   model/scene/displace.h         a displaced object is a composition with a shift
 *   model/scene/grade.h            a grade is a value with a hash of its steps
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
#include "model/scene/texture_fit.h"
#include "model/scene/value.h"
#include "model/scene/walk.h"
