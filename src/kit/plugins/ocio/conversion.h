/* Conversions between celspan's linear light and a configuration's spaces; for this module, and for
 * the picture module, which reads files in such spaces.
 *
 *   light, BT.709 --matrix, if the configuration has no such space--> its linear space --> space
 *
 * Every failure is a ConversionFailure, whose text is a sentence that names the configuration.
 */
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <stdexcept>
#include <string>

struct ConversionFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct ConversionRequest {
  std::string file;
  std::string space;         /* "": a view */
  std::string display, view; /* "": the default */
  bool decodes;              /* from the space to light */
};

struct Conversion {
  OCIO_NAMESPACE::ConstCPUProcessorRcPtr processor;
  std::string name; /* the name of the space, or "VIEW on DISPLAY" */
};

/* A conversion from or to a space is kept, and made again when the file has changed. */
Conversion make_conversion(const ConversionRequest &request);
/* Converts colours of four floats, in place; the fourth stays. Many at once, because the library
 * enters its whole chain of steps in each call. */
void apply_conversion(const Conversion &conversion, float *rgba, size_t count);
