/* The fonts of a text. */
#include "readers/svg/draw/letters.h"

#include <string.h>
#include <strings.h>

#include "celspan/svg.h"
#include "readers/svg/words/values.h"

#define FAMILIES 64 /* the most families of one list that are searched for */

/* The name of a family, as it is written in a list. */
typedef struct family {
  const char *text;
  size_t size;
} family;

/* Takes the next name of a list, without its quotes; false at the end. */
static bool take_family(const char **text, family *out) {
  const char *at = *text + strspn(*text, " \t\n\f\r,");
  if (!*at)
    return false;
  bool is_quoted = *at == '"' || *at == '\'';
  const char stop[] = {is_quoted ? *at : ',', 0};
  at += is_quoted;
  *out = (family){at, strcspn(at, stop)};
  *text = at + out->size + (is_quoted && at[out->size]);
  while (out->size > 0 && strchr(" \t\n\f\r", at[out->size - 1]))
    out->size--;
  return true;
}

/* Whether a name consists of the family's name and then the words of a face. */
static bool is_named(const char *name, family wanted, const char *face) {
  return strncasecmp(name, wanted.text, wanted.size) == 0 &&
         strcasecmp(name + wanted.size, face) == 0;
}

static const celspan_svg_font *find_face(const cs_svg_source *source, family wanted,
                                         const char *face) {
  for (size_t i = 0; i < source->font_count; i++)
    if (is_named(source->fonts[i].family, wanted, face))
      return &source->fonts[i];
  return NULL;
}

static void add(cs_svg_faces *faces, const celspan_svg_font *found, bool is_plain) {
  if (!found || faces->count == CS_TEXT_FONTS)
    return;
  for (size_t i = 0; i < faces->count; i++)
    if (strcmp(faces->fonts[i], found->file) == 0)
      return;
  if (faces->count == 0)
    faces->is_plain = is_plain;
  faces->fonts[faces->count++] = found->file;
}

static void add_family(const cs_svg_source *source, const cs_svg_style *style, family wanted,
                       cs_svg_faces *out) {
  const char *face = style->text.is_bold && style->text.is_italic ? " bold italic"
                     : style->text.is_bold                        ? " bold"
                     : style->text.is_italic                      ? " italic"
                                                                  : "";
  const celspan_svg_font *exact = find_face(source, wanted, face);
  add(out, exact ? exact : find_face(source, wanted, ""), !exact);
}

void cs_svg_faces_find(const cs_svg_source *source, const cs_svg_style *style, cs_svg_faces *out) {
  const char *list = style->text.font_family ? style->text.font_family : "";
  const family other = {"default", strlen("default")};
  *out = (cs_svg_faces){.count = 0};
  family wanted;
  for (int i = 0; i < FAMILIES && take_family(&list, &wanted); i++)
    add_family(source, style, wanted, out);
  add_family(source, style, other, out);
}

bool cs_svg_faces_are_same(const cs_svg_style *a, const cs_svg_style *b) {
  const char *one = a->text.font_family ? a->text.font_family : "";
  const char *other = b->text.font_family ? b->text.font_family : "";
  return a->text.is_bold == b->text.is_bold && a->text.is_italic == b->text.is_italic &&
         a->font_size == b->font_size && a->text.letter_spacing == b->text.letter_spacing &&
         a->text.is_leftward == b->text.is_leftward && strcmp(one, other) == 0;
}
