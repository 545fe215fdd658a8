/* A line's characters as glyphs: runs of one direction and one script, put into the order in which
 * they are seen, and shaped one by one.
 *
 *   characters   a b c  ד ה 1 2 ו  d       embeddings  0 0 0 1 1 2 2 1 0
 *   runs         [abc] [דה] [12] [ו] [d]   reordered   [abc] [ו] [12] [דה] [d]
 */
#ifndef CS_TEXT_SHAPING_H
#define CS_TEXT_SHAPING_H

#include "text/layout.h"

/* Fills layout->shaped with the glyphs of characters begin .. end - 1, which are a line, by their
 * `directions` and scripts. Errors: NO_MEMORY, LIMIT; BAD_ARGUMENT for a character that no font
 * has. */
CELSPAN_CHECKED celspan_status cs_shaping_make(cs_layout *layout, size_t begin, size_t end);

#endif
