/* A line's characters as glyphs: its runs shaped one by one, each letter by the first font that has
 * it.
 *
 *   first font    A ? ? C ?      glyphs that are missing
 *   second font     b ?   E      a letter is taken from one font, with its marks
 *   third font        d
 */
#ifndef CS_TEXT_SHAPING_H
#define CS_TEXT_SHAPING_H

#include "text/layout.h"

/* Fills layout->shaped with the glyphs of characters begin .. end - 1, which are a line, by their
 * `directions` and scripts. Errors: NO_MEMORY, LIMIT; BAD_ARGUMENT for a character that no font
 * has. */
CELSPAN_CHECKED celspan_status cs_shaping_make(cs_layout *layout, size_t begin, size_t end);

#endif
