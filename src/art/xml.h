/* XML through expat: see the table in artwork/module.h. */
#ifndef CS_ART_XML_H
#define CS_ART_XML_H

#include "artwork/module.h"

celspan_status cs_art_parse_xml(const char *bytes, size_t size, const cs_xml_handler *handler,
                                cs_art_failure *failure);

#endif
