#include "common/blend_names.h"

#include <stdio.h>
#include <string.h>

#include "inside/colour.h"

typedef struct name {
  const char *file, *word;
} name;

/* Other modes have celspan's word. The first of a word is the one that is written. "plus" is
 * OpenRaster's mode, which adds premultiplied colours; Krita's do not. Its own "hard mix" dodges or
 * burns. */
static const name openraster[] = {
    {"src-over", "normal"},           {"plus", "add"},
    {"add", "linear-dodge"},          {"soft_light", "soft-light-photoshop"},
    {"dodge", "color-dodge"},         {"burn", "color-burn"},
    {"diff", "difference"},           {"luminize", "luminosity"},
    {"soft_light_svg", "soft-light"}, {"hard_mix_photoshop", "hard-mix"},
    {"hard mix", "hard-mix-krita"},   {"linear light", "linear-light"},
    {"darker color", "darker-color"}, {"lighter color", "lighter-color"}};

/* The modes of the specification that have celspan's word. */
static const char *const standard[] = {
    "multiply",   "screen",     "overlay",    "darken", "lighten",    "color-dodge", "color-burn",
    "hard-light", "soft-light", "difference", "color",  "luminosity", "hue",         "saturation"};

/* The first of a key is the word that is read. "add" and "soft-light" have none of their own, and
 * get that of the mode that is most like them. */
static const name photoshop[] = {
    {"norm", "normal"},       {"pass", "pass-through"},  {"mul ", "multiply"},
    {"lddg", "linear-dodge"}, {"scrn", "screen"},        {"over", "overlay"},
    {"dark", "darken"},       {"lite", "lighten"},       {"diss", "dissolve"},
    {"idiv", "color-burn"},   {"lbrn", "linear-burn"},   {"dkCl", "darker-color"},
    {"div ", "color-dodge"},  {"lgCl", "lighter-color"}, {"sLit", "soft-light-photoshop"},
    {"hLit", "hard-light"},   {"vLit", "vivid-light"},   {"lLit", "linear-light"},
    {"pLit", "pin-light"},    {"hMix", "hard-mix"},      {"diff", "difference"},
    {"smud", "exclusion"},    {"fsub", "subtract"},      {"fdiv", "divide"},
    {"hue ", "hue"},          {"sat ", "saturation"},    {"colr", "color"},
    {"lum ", "luminosity"},   {"lddg", "add"},           {"sLit", "soft-light"}};

#define COUNT(list) (sizeof(list) / sizeof *(list))

/* ---------------------------------------------------------------- from files */

static const char *word_of(const name *names, size_t count, const char *file) {
  for (size_t i = 0; i < count; i++)
    if (strcmp(names[i].file, file) == 0)
      return names[i].word;
  return NULL;
}

void cs_blend_word_of_openraster(const char *file, char out[CS_BLEND_WORD]) {
  const char *colon = strchr(file, ':');
  const char *given = colon ? colon + 1 : file;
  const char *word = word_of(openraster, COUNT(openraster), given);
  snprintf(out, CS_BLEND_WORD, "%s", word ? word : given);
  for (char *at = out; *at; at++)
    *at = *at == '_' ? '-' : *at > ' ' && *at < 127 ? *at : '?';
}

void cs_blend_word_of_photoshop(const char key[5], char out[CS_BLEND_WORD]) {
  const char *word = word_of(photoshop, COUNT(photoshop), key);
  size_t done = 0;
  if (word) {
    snprintf(out, CS_BLEND_WORD, "%s", word);
    return;
  }
  for (int i = 0; i < 4 && key[i]; i++)
    if (key[i] > ' ' && key[i] < 127)
      out[done++] = key[i];
  out[done] = 0;
}

/* ---------------------------------------------------------------- for files */

static const char *file_of(const name *names, size_t count, const char *word) {
  for (size_t i = 0; i < count; i++)
    if (strcmp(names[i].word, word) == 0)
      return names[i].file;
  return NULL;
}

static bool is_standard(const char *word) {
  for (size_t i = 0; i < COUNT(standard); i++)
    if (strcmp(standard[i], word) == 0)
      return true;
  return strcmp(word, "normal") == 0 || strcmp(word, "add") == 0;
}

void cs_blend_openraster(celspan_blend blend, char out[CS_BLEND_WORD]) {
  const char *word = cs_blend_words[blend];
  const char *file = is_standard(word) && strcmp(word, "normal") != 0 && strcmp(word, "add") != 0
                         ? word
                         : file_of(openraster, COUNT(openraster), word);
  bool is_krita = !is_standard(word);
  snprintf(out, CS_BLEND_WORD, "%s:%s", is_krita ? "krita" : "svg", file ? file : word);
  for (char *at = out; is_krita && *at; at++)
    *at = *at == '-' ? '_' : *at;
}

const char *cs_blend_photoshop(celspan_blend blend) {
  return file_of(photoshop, COUNT(photoshop), cs_blend_words[blend]);
}

bool cs_blend_is_photoshop(celspan_blend blend) {
  return strcmp(word_of(photoshop, COUNT(photoshop), cs_blend_photoshop(blend)),
                cs_blend_words[blend]) == 0;
}
