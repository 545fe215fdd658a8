/* The verbs that are written in C, each in the file of its name; the others are Lua in verbs/. A
 * verb that returns anything other than CS_EXIT_OK has reported the error.
 */
#pragma once

#include "program/options/request.h"

/* In the order of the help; the last one has no name. */
extern const cs_verb cs_verbs[];
/* NULL: there is none. */
const cs_verb *cs_verb_named(const char *name);

cs_exit cs_verb_render(celspan_context *context, const cs_request *request);
cs_exit cs_verb_sound(celspan_context *context, const cs_request *request);
cs_exit cs_verb_spans(celspan_context *context, const cs_request *request);
cs_exit cs_verb_tiles(celspan_context *context, const cs_request *request);
