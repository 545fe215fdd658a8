/* Descriptions that hosts give.
 *
 *   base/description.h   a description that was read is full, whichever header the host had
 */
#pragma once

#include "base/description.h"
