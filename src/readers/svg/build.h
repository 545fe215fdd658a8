/* From the elements of a document to the items of a drawing. */
#pragma once

#include "celspan/svg.h"
#include "readers/svg/art.h"
#include "readers/svg/reading.h"

/* Fills in the size and the items of *art. Errors: INPUT and LIMIT with the line, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_build(cs_svg_reading *reading, celspan_svg *art);
