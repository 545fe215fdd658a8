/* Paragraphs cut into lines, and glyphs put into their places.
 *
 *      tracking after each letter, in the direction of its run
 *        v
 *   |H |e |l |l |o |_|        a line: from the left end of its leftmost letter to the right end of
 *    <------------->          the rightmost, without the spaces at its end
 */
#ifndef CS_TEXT_LINES_H
#define CS_TEXT_LINES_H

#include "text/layout.h"

/* Adds the lines of characters begin .. end - 1, which were typed as one line. Errors: NO_MEMORY,
 * LIMIT; BAD_ARGUMENT for a character that no font has. */
CELSPAN_CHECKED celspan_status cs_lines_add_paragraph(cs_layout *layout, size_t begin, size_t end);

#endif
