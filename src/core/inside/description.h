/* Descriptions that hosts give.
 *
 *     base/description.h  Behind cs_description_read every description is full.
 */
#pragma once

#include "base/description.h"
