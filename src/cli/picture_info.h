/* What a picture is, in figures, one "name value" a line, as `info` prints it. */
#ifndef CS_CLI_PICTURE_INFO_H
#define CS_CLI_PICTURE_INFO_H

#include "cli/report.h"

/* Reads headers alone. OK, or reported. */
cs_exit cs_picture_info_print(celspan_context *context, const char *path);

#endif
