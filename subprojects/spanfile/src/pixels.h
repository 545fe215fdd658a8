/* Pixels of gradients, beside the public functions of spanfile.h. */
#pragma once

#include "spanfile.h"

/* Whether both ends of a gradient are finite; otherwise the pixels between them are undefined. */
bool sf_pixels_are_finite(spanfile_format format, const unsigned char *ends);
