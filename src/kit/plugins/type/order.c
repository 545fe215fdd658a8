/* The order of characters (FriBidi) and where lines may break (libunibreak). */
#include "celspan/text.h"
#include "plugins/type/parts.h"

#include <fribidi.h>
#include <linebreak.h>
#include <pthread.h>
#include <stdlib.h>

/* ---------------------------------------------------------------- order */

/* FriBidi's view of some characters: one block of memory. */
typedef struct classified {
  FriBidiCharType *types;
  FriBidiBracketType *brackets;
  FriBidiLevel *embeddings;
} classified;

static bool classify(const uint32_t *characters, size_t count, classified *out) {
  size_t each = sizeof *out->types + sizeof *out->brackets + sizeof *out->embeddings;
  out->types = calloc(count, each);
  if (!out->types)
    return false;
  out->brackets = (FriBidiBracketType *)(out->types + count);
  out->embeddings = (FriBidiLevel *)(out->brackets + count);
  fribidi_get_bidi_types(characters, (FriBidiStrIndex)count, out->types);
  fribidi_get_bracket_types(characters, (FriBidiStrIndex)count, out->types, out->brackets);
  return true;
}

celspan_status cs_order_embeddings(const uint32_t *characters, size_t count,
                                   celspan_direction direction, uint8_t *embeddings,
                                   uint8_t *base) {
  /* A paragraph without a strong character runs to the right. */
  FriBidiParType wanted = direction == CELSPAN_DIRECTION_LTR   ? FRIBIDI_PAR_LTR
                          : direction == CELSPAN_DIRECTION_RTL ? FRIBIDI_PAR_RTL
                                                               : FRIBIDI_PAR_ON;
  *base = direction == CELSPAN_DIRECTION_RTL;
  if (count == 0)
    return CELSPAN_OK;
  classified paragraph;
  if (!classify(characters, count, &paragraph))
    return CELSPAN_NO_MEMORY;
  FriBidiLevel highest = fribidi_get_par_embedding_levels_ex(
      paragraph.types, paragraph.brackets, (FriBidiStrIndex)count, &wanted, paragraph.embeddings);
  *base = FRIBIDI_IS_RTL(wanted) ? 1 : 0;
  for (size_t i = 0; i < count; i++)
    embeddings[i] = paragraph.embeddings[i] > 0 ? (uint8_t)paragraph.embeddings[i] : 0;
  free(paragraph.types);
  return highest > 0 ? CELSPAN_OK : CELSPAN_NO_MEMORY;
}

celspan_status cs_order_end_line(const uint32_t *characters, size_t begin, size_t end, uint8_t base,
                                 uint8_t *embeddings) {
  size_t count = end - begin;
  if (count == 0)
    return CELSPAN_OK;
  classified line;
  if (!classify(characters + begin, count, &line))
    return CELSPAN_NO_MEMORY;
  for (size_t i = 0; i < count; i++)
    line.embeddings[i] = (FriBidiLevel)embeddings[begin + i];
  FriBidiLevel highest =
      fribidi_reorder_line(FRIBIDI_FLAGS_DEFAULT, line.types, (FriBidiStrIndex)count, 0,
                           base ? FRIBIDI_PAR_RTL : FRIBIDI_PAR_LTR, line.embeddings, NULL, NULL);
  for (size_t i = 0; i < count; i++)
    embeddings[begin + i] = (uint8_t)line.embeddings[i];
  free(line.types);
  return highest > 0 ? CELSPAN_OK : CELSPAN_NO_MEMORY;
}

/* ---------------------------------------------------------------- breaks */

/* The library ends the process for a regional indicator (flags are made of these) or U+FFFF, so it
 * is given letters instead. */
static uint32_t bearable(uint32_t character) {
  bool is_known = character != 0xffff && (character < 0x1f1e6 || character > 0x1f1ff);
  return is_known ? character : 'A';
}

celspan_status cs_order_breaks(const uint32_t *characters, size_t count, const char *language,
                               uint8_t *breaks) {
  /* The library makes an index of its tables; this is done once. */
  static pthread_once_t once = PTHREAD_ONCE_INIT;
  pthread_once(&once, init_linebreak);
  utf32_t *letters = calloc(count > 0 ? count : 1, sizeof *letters);
  if (!letters)
    return CELSPAN_NO_MEMORY;
  for (size_t i = 0; i < count; i++)
    letters[i] = bearable(characters[i]);
  if (count > 0)
    set_linebreaks_utf32(letters, count, language, (char *)breaks);
  free(letters);
  for (size_t i = 0; i < count; i++)
    breaks[i] = breaks[i] == LINEBREAK_MUSTBREAK    ? CS_TYPE_MUST_BREAK
                : breaks[i] == LINEBREAK_ALLOWBREAK ? CS_TYPE_MAY_BREAK
                                                    : CS_TYPE_NO_BREAK;
  return CELSPAN_OK;
}
