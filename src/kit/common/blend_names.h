/* What blend modes are called in the files of painting programs, both ways:
 *
 *   OpenRaster, Krita   svg:src-over   krita:linear_burn     <-->   the words of celspan_blend
 *   Photoshop           norm           lbrn                  <-->   (cs_blend_words)
 */
#pragma once

#include <stdbool.h>

#include "celspan/celspan.h"

enum { CS_BLEND_WORD = 32 };

/* celspan's word for a mode of OpenRaster or Krita; for an unknown one, the file's word without the
 * name of the program. */
void cs_blend_word_of_openraster(const char *file, char out[CS_BLEND_WORD]);
/* The word for a key of four letters; for an unknown one, its letters; "" gives "". */
void cs_blend_word_of_photoshop(const char key[5], char out[CS_BLEND_WORD]);

/* The mode for OpenRaster: svg: where its specification has it, else as Krita calls it. */
void cs_blend_openraster(celspan_blend blend, char out[CS_BLEND_WORD]);
/* The key for Photoshop, of the mode or of the one that is most like it; which one it is. */
const char *cs_blend_photoshop(celspan_blend blend);
bool cs_blend_is_photoshop(celspan_blend blend);
