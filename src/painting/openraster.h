/* OpenRaster: an archive of PNG pictures and stack.xml, which tells how they lie on each other. */
#ifndef CS_PAINTING_OPENRASTER_H
#define CS_PAINTING_OPENRASTER_H

#include "painting/document.h"

extern const cs_document_format cs_openraster_format;

#endif
