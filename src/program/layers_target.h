/* Files with the cels of a frame apart: the options --layers and --cryptomatte of a request. */
#pragma once

#include "frames/apart/apart.h"
#include "program/report.h"
#include "program/request.h"

/* What the files of the request have beside the frame: nothing, without these options. */
cs_apart_contents cs_layers_target_read(const cs_request *request);
/* Writes the files of a frame. Errors: those of the format's writer. */
CELSPAN_CHECKED celspan_status cs_layers_target_write(celspan_context *context,
                                                      cs_apart_contents contents,
                                                      const celspan_frame_desc *desc,
                                                      const char *path,
                                                      const celspan_file_desc *file);
bool cs_layers_target_is_wanted(const cs_request *request);
/* OK if the output can have what is asked for; otherwise the reason is reported. */
cs_exit cs_layers_target_refuse(const cs_request *request);
/* Whether the output is a file of a painting program, which no other option makes. */
bool cs_layers_target_is_painting(const cs_request *request);
