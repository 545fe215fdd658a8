/* A description as a layout: checked, its fonts found, its characters decoded, its lines made. */
#ifndef CS_TEXT_TYPESET_H
#define CS_TEXT_TYPESET_H

#include "text/layout.h"

/* Lays out what desc says, which was not checked yet. Whatever the answer is, the layout is to be
 * finished. noun: for messages. Errors: see celspan_object_create_text. */
CELSPAN_CHECKED celspan_status cs_typeset_make(cs_layout *layout, celspan_context *context,
                                               const char *noun, const celspan_text_desc *desc);
void cs_typeset_finish(cs_layout *layout);

#endif
