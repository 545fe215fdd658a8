#include "painting/profile.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "colour/transfer.h"
#include "painting/bytes.h"

enum { HEADER = 128, ENTRY = 12 };

typedef struct tag {
  const unsigned char *bytes; /* NULL: there is none */
  size_t size;
} tag;

static tag find(const unsigned char *bytes, size_t size, const char *signature) {
  uint32_t count = cs_bytes_big32(bytes + HEADER);
  for (size_t i = 0; i < count && HEADER + 4 + (i + 1) * ENTRY <= size; i++) {
    const unsigned char *entry = bytes + HEADER + 4 + i * ENTRY;
    uint32_t at = cs_bytes_big32(entry + 4), length = cs_bytes_big32(entry + 8);
    if (memcmp(entry, signature, 4) == 0 && at <= size && length <= size - at && length >= 12)
      return (tag){bytes + at, length};
  }
  return (tag){NULL, 0};
}

static bool is_type(tag t, const char *type) { return t.bytes && memcmp(t.bytes, type, 4) == 0; }

/* Numbers of the format: 16 bits before the point, 16 behind it. */
static double fixed(const unsigned char *at) { return (int32_t)cs_bytes_big32(at) / 65536.0; }

static bool is_near(double a, double b, double tolerance) { return fabs(a - b) <= tolerance; }

/* ---------------------------------------------------------------- from codes to light */

/* A table of 16-bit values from code 0 to code 1, at 33 places. A power of 2.2, which differs from
 * sRGB by 0.008, is another curve. */
static cs_profile_codes codes_of_table(const unsigned char *values, uint32_t count) {
  double from_srgb = 0, from_linear = 0;
  for (int i = 0; i <= 32; i++) {
    double code = i / 32.0, place = code * (count - 1);
    uint32_t low = (uint32_t)place, high = low + 1 < count ? low + 1 : low;
    double below = cs_bytes_big16(values + 2 * (size_t)low);
    double above = cs_bytes_big16(values + 2 * (size_t)high);
    double light = (below + (above - below) * (place - low)) / 65535;
    double srgb = (double)cs_transfer_decode(CELSPAN_TRANSFER_SRGB, (float)code);
    from_srgb = fmax(from_srgb, fabs(light - srgb));
    from_linear = fmax(from_linear, fabs(light - code));
  }
  return from_srgb < 0.003     ? CS_PROFILE_SRGB
         : from_linear < 0.003 ? CS_PROFILE_LINEAR
                               : CS_PROFILE_OTHER;
}

/* Light is (a code + b)^g from code d on, c code below it; e and f are added to the two. */
static cs_profile_codes codes_of_formula(tag curve) {
  static const double srgb[] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045, 0, 0};
  static const size_t counts[] = {1, 3, 4, 5, 7};
  unsigned kind = cs_bytes_big16(curve.bytes + 8);
  if (kind > 4 || curve.size < 12 + 4 * counts[kind])
    return CS_PROFILE_OTHER;
  if (kind == 0 && is_near(fixed(curve.bytes + 12), 1, 0.005))
    return CS_PROFILE_LINEAR;
  bool is_srgb = kind >= 3;
  for (size_t i = 0; i < counts[kind]; i++)
    is_srgb = is_srgb && is_near(fixed(curve.bytes + 12 + 4 * i), srgb[i], 0.002);
  return is_srgb ? CS_PROFILE_SRGB : CS_PROFILE_OTHER;
}

static cs_profile_codes codes_of_curve(tag curve) {
  if (is_type(curve, "para"))
    return codes_of_formula(curve);
  if (!is_type(curve, "curv"))
    return CS_PROFILE_OTHER;
  uint32_t count = cs_bytes_big32(curve.bytes + 8);
  if (count > (curve.size - 12) / 2)
    return CS_PROFILE_OTHER;
  if (count == 0 || (count == 1 && cs_bytes_big16(curve.bytes + 12) == 256)) /* a power of 1 */
    return CS_PROFILE_LINEAR;
  return count == 1 ? CS_PROFILE_OTHER : codes_of_table(curve.bytes + 12, count);
}

/* ---------------------------------------------------------------- primaries */

static bool has_primaries(const unsigned char *bytes, size_t size) {
  /* Of sRGB, by the white of D50: IEC 61966-2-1, Bradford's adaptation. */
  static const double primaries[3][3] = {
      {0.4361, 0.2225, 0.0139}, {0.3851, 0.7169, 0.0971}, {0.1431, 0.0606, 0.7141}};
  static const char *const signatures[] = {"rXYZ", "gXYZ", "bXYZ"};
  bool is_same = true;
  for (int c = 0; c < 3 && is_same; c++) {
    tag place = find(bytes, size, signatures[c]);
    is_same = is_type(place, "XYZ ") && place.size >= 20;
    for (int i = 0; i < 3 && is_same; i++)
      is_same = is_near(fixed(place.bytes + 8 + 4 * i), primaries[c][i], 0.003);
  }
  return is_same;
}

static cs_profile_codes codes_of_colour(const unsigned char *bytes, size_t size) {
  static const char *const signatures[] = {"rTRC", "gTRC", "bTRC"};
  cs_profile_codes codes = codes_of_curve(find(bytes, size, "rTRC"));
  for (int c = 1; c < 3; c++)
    if (codes_of_curve(find(bytes, size, signatures[c])) != codes)
      return CS_PROFILE_OTHER;
  return has_primaries(bytes, size) ? codes : CS_PROFILE_OTHER;
}

/* ---------------------------------------------------------------- the name */

/* step: bytes of a character, of which the last is kept where the others are 0. */
static void set_name(char name[64], const unsigned char *text, size_t size, size_t step) {
  size_t done = 0;
  for (size_t at = 0; at + step <= size && done < 63; at += step) {
    unsigned char last = text[at + step - 1];
    bool is_plain = last >= ' ' && last < 127 && (step == 1 || text[at] == 0);
    if (last == 0 && (step == 1 || text[at] == 0))
      break;
    name[done++] = is_plain ? (char)last : '?';
  }
  name[done] = 0;
}

static void read_name(tag description, char name[64]) {
  if (is_type(description, "desc")) {
    size_t size = cs_bytes_big32(description.bytes + 8);
    if (size <= description.size - 12)
      set_name(name, description.bytes + 12, size, 1);
  } else if (is_type(description, "mluc") && description.size >= 28) {
    uint32_t size = cs_bytes_big32(description.bytes + 20);
    uint32_t at = cs_bytes_big32(description.bytes + 24);
    if (at <= description.size && size <= description.size - at)
      set_name(name, description.bytes + at, size, 2);
  }
}

/* ---------------------------------------------------------------- profiles */

void cs_profile_read(const unsigned char *bytes, size_t size, cs_profile *out) {
  *out = (cs_profile){.codes = CS_PROFILE_OTHER};
  if (size < HEADER + 4 || memcmp(bytes + 36, "acsp", 4) != 0)
    return;
  read_name(find(bytes, size, "desc"), out->name);
  if (memcmp(bytes + 16, "GRAY", 4) == 0)
    out->codes = codes_of_curve(find(bytes, size, "kTRC"));
  else if (memcmp(bytes + 16, "RGB ", 4) == 0)
    out->codes = codes_of_colour(bytes, size);
}

void cs_profile_of_name(const char *name, cs_profile *out) {
  bool is_grey = strncmp(name, "Gray-D50", 8) == 0, is_srgb = strncmp(name, "sRGB", 4) == 0;
  bool is_linear = strstr(name, "g10") || strstr(name, "inear");
  bool is_known = is_srgb || (is_grey && (is_linear || strstr(name, "srgbtrc")));
  *out = (cs_profile){.codes = !is_known   ? CS_PROFILE_OTHER
                               : is_linear ? CS_PROFILE_LINEAR
                                           : CS_PROFILE_SRGB};
  set_name(out->name, (const unsigned char *)name, strlen(name), 1);
}

void cs_profile_of_power(uint32_t power, const uint32_t *places, cs_profile *out) {
  static const uint32_t srgb[] = {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000};
  bool is_other = power != 45455 && power != 100000;
  for (size_t i = 0; places && i < 8; i++)
    is_other |= llabs((long long)places[i] - srgb[i]) > 300;
  *out = (cs_profile){.codes = is_other          ? CS_PROFILE_OTHER
                               : power == 100000 ? CS_PROFILE_LINEAR
                                                 : CS_PROFILE_SRGB};
  snprintf(out->name, sizeof out->name, "gamma %.5g%s", 100000.0 / power,
           places ? " with primaries" : "");
}

const char *cs_profile_colour(const cs_profile *profile) {
  return profile->codes == CS_PROFILE_LINEAR ? "linear" : "srgb";
}

celspan_status cs_profile_note(celspan_context *context, celspan_painting *painting, size_t layer,
                               const cs_profile *profile) {
  if (profile->codes != CS_PROFILE_OTHER)
    return CELSPAN_OK;
  return cs_contents_note(context, painting, layer,
                          "the colour profile \"%s\": its colours are taken as those of sRGB",
                          profile->name[0] ? profile->name : "without a name");
}
