/* The verbs of the command line, each in the file of its name. They have reported whatever they do
 * not answer with CS_EXIT_OK.
 */
#ifndef CS_CLI_VERBS_H
#define CS_CLI_VERBS_H

#include "cli/request.h"

cs_exit cs_render_run(celspan_context *context, const cs_request *request);
cs_exit cs_info_run(celspan_context *context, const cs_request *request);
cs_exit cs_check_run(celspan_context *context, const cs_request *request);
cs_exit cs_spans_run(celspan_context *context, const cs_request *request);
cs_exit cs_probe_run(celspan_context *context, const cs_request *request);
cs_exit cs_convert_run(celspan_context *context, const cs_request *request);
cs_exit cs_compare_run(celspan_context *context, const cs_request *request);
cs_exit cs_tiles_run(celspan_context *context, const cs_request *request);

#endif
