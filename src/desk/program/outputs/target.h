/* How pixels are coded, and files are described, under the options of a request. */
#pragma once

#include "program/options/request.h"

/* The coding of pixels under the options, with defaults, except --dither. */
celspan_coding cs_target_coding(const cs_request *request);
/* The description of a file under the options, without the metadata of frames, and without the
 * place of a strip. */
celspan_file_desc cs_target_file(const cs_request *request, celspan_coding *coding);
