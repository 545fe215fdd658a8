/* The colours of what is written: --colour, --display and --view, in the OpenColorIO configuration
 * that --ocio or else OCIO names. The module is loaded only for a space or a view.
 */
#pragma once

#include "plugins/ocio/module.h"
#include "program/options/request.h"

typedef struct cs_spaces {
  const cs_space_module *module;
  cs_space_conversion *conversion; /* NULL: none is asked for */
  char colour[256];                /* the space or the view, and the configuration */
  const char *digest;
} cs_spaces;

/* Sets OCIO, for the decoders of pictures, too, from --ocio; and opens the conversion that the
 * request asks for, which is then in request->spaces. Failures are reported. */
cs_exit cs_spaces_open(celspan_context *context, cs_request *request, cs_spaces *out);
void cs_spaces_close(cs_spaces *spaces);
/* Puts what the request says of colours into a coding. */
void cs_spaces_set(const cs_request *request, celspan_coding *coding);
