/* Krita documents: an archive of layers in tiles and maindoc.xml, which tells how they lie on each
 * other. Layers whose pixels Krita computes (filters, fills, vectors, clones, files) are noted. */
#ifndef CS_PAINTING_KRITA_H
#define CS_PAINTING_KRITA_H

#include "painting/document.h"

extern const cs_document_format cs_krita_format;

#endif
