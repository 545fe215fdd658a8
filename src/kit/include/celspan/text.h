/* Text: the outlines of the letters of fonts (TrueType, OpenType, collections of them).
 * The conventions of celspan/celspan.h hold. */
#ifndef CELSPAN_TEXT_H
#define CELSPAN_TEXT_H

#include "celspan/celspan.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct celspan_feature { /* of OpenType, for the whole text */
  const char *tag;               /* four printable characters: "liga", "ss01" */
  uint32_t value;                /* 0: off, 1: on, or which of several alternates */
} celspan_feature;

typedef struct celspan_variation { /* an axis of variable fonts */
  const char *tag;                 /* four printable characters: "wght", "wdth" */
  double value;                    /* in the axis's own units; clamped to its range */
} celspan_variation;

typedef enum celspan_align {
  CELSPAN_ALIGN_LEFT = 0, /* in every script */
  CELSPAN_ALIGN_CENTRE,
  CELSPAN_ALIGN_RIGHT
} celspan_align;

typedef enum celspan_valign { /* what is placed at at.y; the first font has the heights */
                              CELSPAN_VALIGN_BASELINE = 0, /* of the first line */
                              CELSPAN_VALIGN_TOP,          /* the ascent of the first line */
                              CELSPAN_VALIGN_CAP,    /* the top of the capitals of the first line */
                              CELSPAN_VALIGN_MIDDLE, /* halfway between TOP and BOTTOM */
                              CELSPAN_VALIGN_BOTTOM  /* the descent of the last line */
} celspan_valign;

typedef enum celspan_direction {
  CELSPAN_DIRECTION_AUTO = 0, /* for each line of the text: by its first letter */
  CELSPAN_DIRECTION_LTR,
  CELSPAN_DIRECTION_RTL
} celspan_direction;

/* Lines end at each "\n", U+2028 and U+2029. With a width, they also end where the language allows
 * a break, before they become longer than the width; a longer word extends beyond it. Spaces at a
 * line's end do not count. Every letter is taken from the first font that has it. */
typedef struct celspan_text_desc {
  size_t struct_size;
  const char *text;         /* UTF-8 without other control characters, at most 100,000 characters */
  size_t text_size;         /* bytes */
  const char *const *fonts; /* their files */
  size_t font_count;        /* 1..16 */
  double size;              /* the em, in film units */
  celspan_point at;         /* the first line's baseline, or as valign says */
  celspan_align align;      /* about at.x; with a width, within at.x .. at.x + width */
  bool has_width;           /* lines wrap */
  double width;             /* >= 0 */
  double leading;           /* from baseline to baseline, times size */
  double tracking;          /* thousandths of an em after each letter */
  const celspan_feature *features;
  size_t feature_count; /* at most 64 */
  const celspan_variation *variations;
  size_t variation_count; /* at most 64 */
  const char *language;   /* a BCP 47 tag such as "tr"; NULL: none */
  celspan_direction direction;
  celspan_texture *texture; /* kept; NULL: opaque black */
  uint32_t face; /* the face of fonts that are collections: the number of the font, from 0 */
  celspan_valign valign;
} celspan_text_desc;

CELSPAN_DESCRIPTION(celspan_text_desc)
#define CELSPAN_TEXT_DESC (celspan_text_desc_initial())

/* All letters as one primitive, filled by the non-zero rule. Fonts are read at once and kept in the
 * context. Text without letters, and of size 0, draws nothing.
 * desc: borrowed, except for the texture      out: new
 * Errors: NO_MEMORY; INPUT for a font that is missing, cut or not a font at all, and where the art
 * module is missing; BAD_ARGUMENT for numbers, for what is not UTF-8, for a character that no font
 * has, for an axis that no font has, and for fonts of coloured glyphs; LIMIT for more than 100,000
 * characters, 16,777,216 points of outline, or 256 MiB of a font's file. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_create_text(celspan_context *context,
                                                                      const celspan_text_desc *desc,
                                                                      celspan_object **out);

/* Measures of a text in film units. Heights are those of the first font, usually 0 or more, from
 * the baseline. If the file lacks them, they are measured on its letters H and x. */
typedef struct celspan_text_metrics {
  size_t struct_size;
  double ascent, descent; /* the ascent and descent of a line: above the baseline and below it */
  double cap_height, x_height;
  double width;  /* the width of the widest line */
  double height; /* from the ascent of the first line to the descent of the last one */
  int32_t lines; /* 1 or more */
} celspan_text_metrics;

CELSPAN_RESULT(celspan_text_metrics)
#define CELSPAN_TEXT_METRICS (celspan_text_metrics_initial())

/* desc, Errors: as above. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_text_measure(celspan_context *context,
                                                                const celspan_text_desc *desc,
                                                                celspan_text_metrics *out);

/* The text letter by letter: a letter is a user-perceived character with its marks, or a ligature.
 * Line ends are not letters; spaces are, and draw nothing. */
typedef struct celspan_glyph {
  /* borrowed; it is in its place in the text, with the texture of the text */
  celspan_object *object;
  double x, y;    /* its left end, on the baseline */
  double advance; /* its width, without tracking */
  /* its characters: text_size bytes of UTF-8, borrowed, without a zero at the end */
  const char *text;
  size_t text_size;
  int32_t line; /* from 1 */
} celspan_glyph;

typedef struct celspan_glyphs celspan_glyphs;

/* In reading order. desc, Errors: as above; out: new. One thread at a time. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_glyphs_create(celspan_context *context,
                                                                 const celspan_text_desc *desc,
                                                                 celspan_glyphs **out);
CELSPAN_API size_t celspan_glyphs_count(const celspan_glyphs *glyphs);
/* index: below the count. Valid as long as the glyphs. */
CELSPAN_API const celspan_glyph *celspan_glyphs_get(const celspan_glyphs *glyphs, size_t index);
/* NULL is ignored. */
CELSPAN_API void celspan_glyphs_destroy(celspan_glyphs *glyphs);

#ifdef __cplusplus
}
#endif
#endif
