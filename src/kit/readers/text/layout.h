/* The places of the glyphs of a text.
 *
 *   "Hello\nשלום 12"                      characters
 *      | embeddings, scripts, breaks        by paragraph: what was typed as one line
 *      | runs: one direction and script     by line
 *      | shaping, each letter by the first font that has it
 *      v
 *     glyphs, from left to right            ---H---e---l---l---o---   line 1
 *     letters: glyphs of the same text      ----1---2-----ם---ו----   line 2
 *
 * A letter is a user-perceived character (grapheme cluster): a character with its marks, or several
 * as a ligature.
 *
 * INVARIANT: the glyphs of a letter are neighbours, and letters are in the order of their glyphs.
 */
#pragma once

#include "celspan/text.h"
#include "readers/text/font.h"

#define CS_TEXT_CHARACTERS 100000
#define CS_TEXT_FONTS 16
#define CS_TEXT_SETTINGS 64
#define CS_TEXT_POINTS ((size_t)16 << 20)

typedef struct cs_text_glyph {
  cs_font *font; /* borrowed from the layout */
  uint32_t glyph;
  double x, y; /* the origin of the glyph */
} cs_text_glyph;

typedef struct cs_text_letter {
  uint32_t begin, end; /* characters, in reading order */
  size_t glyph, glyph_count;
  /* x, y: its left end on the baseline; advance: its width, without tracking */
  double x, y, advance;
  int32_t line; /* from 0 */
} cs_text_letter;

/* A glyph as its font shapes it, before it is placed. */
typedef struct cs_text_shaped {
  cs_font *font;
  cs_type_glyph glyph; /* characters are counted from the beginning of the text */
  bool is_leftward;
} cs_text_shaped;

typedef struct cs_layout {
  celspan_context *context;
  const char *noun; /* for messages */
  const celspan_text_desc *desc;
  const cs_type_functions *type;
  cs_font *fonts[CS_TEXT_FONTS]; /* pinned */
  size_t font_count;

  size_t count;
  /* By character. */
  CS_ARRAY(uint32_t, characters);
  CS_ARRAY(uint32_t, places); /* the byte of the text at which each character begins */
  CS_ARRAY(uint32_t, scripts);
  CS_ARRAY(uint8_t, embeddings); /* in the paragraph */
  CS_ARRAY(uint8_t, directions); /* embeddings in the current line */
  CS_ARRAY(uint8_t, breaks);
  /* of the letter that begins with the character, tracking included; otherwise 0 */
  CS_ARRAY(double, advances);

  CS_ARRAY(cs_text_shaped, shaped); /* the current line, from left to right */
  CS_ARRAY(cs_text_glyph, glyphs);
  CS_ARRAY(cs_text_letter, letters);
  size_t shaped_count, glyph_count, letter_count;
  int32_t line;            /* the number of the next line */
  double width;            /* the width of the widest line */
  celspan_texture *fitted; /* the texture of all letters; NULL: not yet made */
} cs_layout;

/* Lays out a text by its desc, which has not been checked yet: fonts, characters, lines. The layout
 * must be finished whatever the result is. noun: for messages. Errors: see
 * celspan_object_create_text. */
CELSPAN_CHECKED celspan_status cs_typeset_make(cs_layout *layout, celspan_context *context,
                                               const char *noun, const celspan_text_desc *desc);
void cs_typeset_finish(cs_layout *layout);
/* The measures of a text that is laid out. */
celspan_text_metrics cs_typeset_measure(const cs_layout *layout);
/* Adds the lines of characters begin .. end - 1, which were typed as one line. Errors: NO_MEMORY,
 * LIMIT; BAD_ARGUMENT for a character that no font has. */
CELSPAN_CHECKED celspan_status cs_lines_add_paragraph(cs_layout *layout, size_t begin, size_t end);
/* Fills layout->shaped with the glyphs of characters begin .. end - 1, which form a line, by their
 * `directions` and scripts. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_shaping_make(cs_layout *layout, size_t begin, size_t end);
