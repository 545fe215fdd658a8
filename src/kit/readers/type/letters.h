/* The functions of the type module for type: shaping and outlines of fonts (HarfBuzz), the order of
 * characters (FriBidi), and where lines may end (libunibreak).
 *
 *   bytes of a font --open--> font --shape-->   glyphs: numbers, advances, offsets
 *                                  --outline--> contours of lines and curves
 *   characters --embeddings--> which of them run to the left   --breaks--> where lines may end
 *              --scripts-----> Latn, Arab, ...
 *
 * Characters are Unicode scalar values. Lengths are in font units, of which info.units make an em;
 * y points up. Functions that give a value to each character fill an array of `count` items.
 *
 * INVARIANT: no memory changes its owner, and nothing outside the bytes is read.
 */
#pragma once

#include "celspan/celspan.h"
#include "celspan/text.h"

/* "Latn" as a number. */
#define CS_TYPE_TAG(a, b, c, d)                                                                    \
  ((uint32_t)(unsigned char)(a) << 24 | (uint32_t)(unsigned char)(b) << 16 |                       \
   (uint32_t)(unsigned char)(c) << 8 | (uint32_t)(unsigned char)(d))

/* of characters that occur in every script */
#define CS_TYPE_COMMON CS_TYPE_TAG('Z', 'y', 'y', 'y')
/* of marks: they have the script of their letter */
#define CS_TYPE_INHERITED CS_TYPE_TAG('Z', 'i', 'n', 'h')
#define CS_TYPE_UNKNOWN CS_TYPE_TAG('Z', 'z', 'z', 'z')

typedef struct cs_type_font cs_type_font;

typedef struct cs_type_font_info {
  uint32_t units; /* the units of an em, 16..16384 */
  int32_t ascent; /* how far lines reach above and below the baseline; their sum is above 0 */
  int32_t descent;
  int32_t cap_height, x_height; /* of capitals, and of small letters without ascenders */
  uint32_t glyphs;              /* all numbers of glyphs are less than this */
  uint64_t variation;           /* bit i: the font has the axis of variations[i] */
} cs_type_font_info;

typedef struct cs_type_glyph {
  uint32_t glyph;     /* 0: the font has no glyph for these characters */
  uint32_t character; /* of its characters */
  int32_t advance, x_offset, y_offset;
} cs_type_glyph;

/* The characters to be shaped: begin .. end - 1 of `count`; the characters around them decide how
 * letters join. */
typedef struct cs_type_run {
  const uint32_t *characters;
  size_t count, begin, end;
  uint32_t script;
  bool is_leftward;
  const char *language; /* a BCP 47 tag; NULL: none */
  const celspan_feature *features;
  size_t feature_count;
} cs_type_run;

/* Receives an outline. Contours are closed by the next `move` and by the end. */
typedef struct cs_type_outliner {
  void (*move)(void *user, celspan_point to);
  void (*line)(void *user, celspan_point to);
  void (*conic)(void *user, celspan_point control, celspan_point to);
  void (*cubic)(void *user, celspan_point control, celspan_point control2, celspan_point to);
  void *user;
} cs_type_outliner;

enum { CS_TYPE_NO_BREAK = 0, CS_TYPE_MAY_BREAK, CS_TYPE_MUST_BREAK };

typedef struct cs_type_functions {
  /* bytes: borrowed until close; a font that was checked before (readers/text/font.c). face: in a
   * collection, otherwise 0. variations: at most 64; values are clamped to the range of their axes.
   * Errors: NO_MEMORY. */
  celspan_status (*open)(const void *bytes, size_t size, uint32_t face,
                         const celspan_variation *variations, size_t variation_count,
                         cs_type_font_info *info, cs_type_font **out);
  void (*close)(cs_type_font *font);
  /* Calls `take` for each glyph, from left to right, until it returns false; the characters descend
   * if the run is leftward. Glyphs that belong together have the same character. Errors: NO_MEMORY;
   * CANCELLED if `take` returned false. Any thread. */
  celspan_status (*shape)(cs_type_font *font, const cs_type_run *run,
                          bool (*take)(void *user, const cs_type_glyph *glyph), void *user);
  /* Errors: NO_MEMORY. Any thread. */
  celspan_status (*outline)(cs_type_font *font, uint32_t glyph, const cs_type_outliner *outliner);
  bool (*has)(cs_type_font *font, uint32_t character);
  /* Embedding levels of one paragraph by the bidirectional algorithm: odd ones run to the left.
   * *base: the level of the paragraph. Errors: NO_MEMORY. */
  celspan_status (*embeddings)(const uint32_t *characters, size_t count,
                               celspan_direction direction, uint8_t *embeddings, uint8_t *base);
  /* The same algorithm's rule L1 for a line, which is characters begin .. end - 1. Errors:
   * NO_MEMORY. */
  celspan_status (*end_line)(const uint32_t *characters, size_t begin, size_t end, uint8_t base,
                             uint8_t *embeddings);
  /* The kind of break that is allowed after each character. language: NULL, or a tag. Errors:
   * NO_MEMORY. */
  celspan_status (*breaks)(const uint32_t *characters, size_t count, const char *language,
                           uint8_t *breaks);
  void (*scripts)(const uint32_t *characters, size_t count, uint32_t *scripts);
} cs_type_functions;
