/* XML documents, element by element.
 *
 * Invariant: a document that ends with OK is well-formed and never has more than `depth` elements
 * open. Its entities contain only text and elements, and make it at most twice as large, or larger
 * by a MiB.
 */
#pragma once

#include "inside/context.h"
#include "readers/type/module.h"

/* Parses `size` bytes. When a handler's function answers false it has recorded a failure in the
 * context, and *failure is its status.
 * name     of the document, for messages: "hat.svg"; the line follows it
 * purpose  "reading SVG", for the message where the type module is missing
 * failure  set by the handler before it answers false
 * Errors: those of cs_type_module's parse_xml and of cs_type_module_load. */
CELSPAN_CHECKED celspan_status cs_xml_parse(celspan_context *context, const char *name,
                                            const char *purpose, const char *bytes, size_t size,
                                            const cs_xml_handler *handler,
                                            const celspan_status *failure);
/* An element's name without its namespace. */
const char *cs_xml_local_name(const char *name);
