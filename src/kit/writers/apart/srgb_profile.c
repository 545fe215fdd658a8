/* A colour profile of sRGB. */
#include "writers/apart/photoshop.h"

#include <string.h>

#include "common/bytes.h"

/* Numbers are in units of 1/65536. The primaries of sRGB are adapted from its white, D65, to D50 by
 * Bradford's matrix, and their sum is exactly D50. */
static const int32_t white[] = {0xf6d6, 0x10000, 0xd32d}, red[] = {0x6fa0, 0x38f5, 0x0390},
                     green[] = {0x6297, 0xb787, 0x18d9}, blue[] = {0x249f, 0x0f84, 0xb6c4};
static const int32_t adaptation[] = {0x10c42, 0x05de,  -0x0cdb, 0x0793, 0xfd90,
                                     -0x045f, -0x025e, 0x03dc,  0xc06e};
/* 2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92 and 0.04045. */
static const int32_t curve[] = {0x26666, 0xf2a7, 0x0d59, 0x13d0, 0x0a5b};

/* A tag's bytes begin with eight that say what they are. Tags that follow each other and have the
 * same numbers share them. */
typedef struct tag {
  const char *name, *type;
  const char *text; /* NULL: numbers */
  const int32_t *numbers;
  int count;
} tag;

static const tag tags[] = {
    {"desc", "mluc", "sRGB", NULL, 0}, {"cprt", "mluc", "No copyright", NULL, 0},
    {"wtpt", "XYZ ", NULL, white, 3},  {"chad", "sf32", NULL, adaptation, 9},
    {"rXYZ", "XYZ ", NULL, red, 3},    {"gXYZ", "XYZ ", NULL, green, 3},
    {"bXYZ", "XYZ ", NULL, blue, 3},   {"rTRC", "para", NULL, curve, 5},
    {"gTRC", "para", NULL, curve, 5},  {"bTRC", "para", NULL, curve, 5}};

enum { HEADER = 128, TAGS = sizeof tags / sizeof *tags };

static unsigned char *store(unsigned char *at, uint32_t number, int bytes) {
  return cs_bytes_put_big(at, number, bytes);
}

static unsigned char *store_name(unsigned char *at, const char *name) {
  memcpy(at, name, 4);
  return at + 4;
}

static unsigned char *store_numbers(unsigned char *at, const int32_t *numbers, int count) {
  for (int i = 0; i < count; i++)
    at = store(at, (uint32_t)numbers[i], 4);
  return at;
}

/* One text, in English, as UTF-16. */
static unsigned char *store_text(unsigned char *at, const char *text) {
  enum { RECORD = 12, BEGIN = 28 };
  at = store(store(at, 1, 4), RECORD, 4);
  at = store_name(at, "enUS");
  at = store(store(at, (uint32_t)(2 * strlen(text)), 4), BEGIN, 4);
  for (; *text; text++)
    at = store(at, (unsigned char)*text, 2);
  return at;
}

static unsigned char *store_tag(unsigned char *at, const tag *t) {
  enum { IEC = 3 }; /* the form of the curve: a power, and linear near black */
  at = store(store_name(at, t->type), 0, 4);
  if (t->text)
    return store_text(at, t->text);
  if (t->numbers == curve)
    at = store(store(at, IEC, 2), 0, 2);
  return store_numbers(at, t->numbers, t->count);
}

static void store_header(unsigned char out[CS_SRGB_PROFILE]) {
  enum { VERSION = 0x04300000 };
  unsigned char *at = store(store(out, CS_SRGB_PROFILE, 4), 0, 4);
  at = store_name(store_name(store_name(store(at, VERSION, 4), "mntr"), "RGB "), "XYZ ");
  at = store(store(store(at, 2000, 2), 1, 2), 1, 2); /* a date: 1 January 2000 */
  store_name(out + 36, "acsp");
  store_numbers(out + 68, white, 3);
}

void cs_srgb_profile(unsigned char out[CS_SRGB_PROFILE]) {
  memset(out, 0, CS_SRGB_PROFILE);
  store_header(out);
  unsigned char *list = store(out + HEADER, TAGS, 4), *at = list + 12 * TAGS, *start = at;
  for (const tag *t = tags; t < tags + TAGS; t++) {
    bool is_shared = t > tags && t->numbers && t->numbers == t[-1].numbers;
    start = is_shared ? start : at;
    at = is_shared ? at : store_tag(at, t);
    list = store(store_name(list, t->name), (uint32_t)(start - out), 4);
    list = store(list, (uint32_t)(at - start), 4);
  }
}
