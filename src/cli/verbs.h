/* The verbs of the command line, each in the file of its name. They have reported whatever they do
 * not answer with CS_EXIT_OK.
 */
#ifndef CS_CLI_VERBS_H
#define CS_CLI_VERBS_H

#include "cli/request.h"

cs_exit cs_verb_render(celspan_context *context, const cs_request *request);
cs_exit cs_verb_info(celspan_context *context, const cs_request *request);
cs_exit cs_verb_check(celspan_context *context, const cs_request *request);
cs_exit cs_verb_spans(celspan_context *context, const cs_request *request);
cs_exit cs_verb_probe(celspan_context *context, const cs_request *request);
cs_exit cs_verb_convert(celspan_context *context, const cs_request *request);
cs_exit cs_verb_compare(celspan_context *context, const cs_request *request);
cs_exit cs_verb_tiles(celspan_context *context, const cs_request *request);
cs_exit cs_verb_sheet(celspan_context *context, const cs_request *request);
cs_exit cs_verb_track(celspan_context *context, const cs_request *request);
cs_exit cs_verb_test(celspan_context *context, const cs_request *request);
cs_exit cs_verb_init(celspan_context *context, const cs_request *request);
cs_exit cs_verb_contact(celspan_context *context, const cs_request *request);
cs_exit cs_verb_farm(celspan_context *context, const cs_request *request);
cs_exit cs_verb_join(celspan_context *context, const cs_request *request);
cs_exit cs_verb_relight(celspan_context *context, const cs_request *request);
cs_exit cs_verb_trace(celspan_context *context, const cs_request *request);

#endif
