/* XML documents, element by element.
 *
 * Invariant: a document that ends with OK was well-formed, had no entities but those of plain text
 * and elements, which made it at most twice as large or a MiB, and never had more than `depth`
 * elements open.
 */
#pragma once

#include "base/context.h"
#include "readers/xml/module.h"

/* Parses `size` bytes. When a handler's function answers false it has recorded a failure in the
 * context, and *failure is its status.
 * name     of the document, for messages: "hat.svg"; the line follows it
 * purpose  "reading SVG", for the message where the art module is missing
 * failure  set by the handler before it answers false
 * Errors: those of cs_art_module's parse_xml and of cs_artwork_module. */
CELSPAN_CHECKED celspan_status cs_xml_parse(celspan_context *context, const char *name,
                                            const char *purpose, const char *bytes, size_t size,
                                            const cs_xml_handler *handler,
                                            const celspan_status *failure);
