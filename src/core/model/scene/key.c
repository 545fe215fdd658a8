/* Keys: a union of one object that is graded by a key. It isolates. */

#include "base/description.h"
#include "model/scene/check.h"
#include "model/scene/primitive_data.h"
#include "model/scene/value.h"

#define GREY (1.0 / 64) /* the least length of a chroma that is a hue: part of a code */

static const float green[3] = {0, 0.49693304f, 0}; /* #0b0 */

/* ---------------------------------------------------------------- checks */

/* The colour of the screen, as light. */
static celspan_status find_screen(celspan_context *context, const celspan_texture *colour,
                                  float screen[3]) {
  memcpy(screen, green, sizeof green);
  if (!colour)
    return CELSPAN_OK;
  if (colour->kind != CS_TEXTURE_FLAT || colour->flat.beta != 1)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "key: colour must be one opaque colour, such as \"#0b0\"; for a screen that "
                   "varies, take a colour in the middle and a greater tolerance");
  for (int c = 0; c < 3; c++)
    screen[c] = colour->flat.s[c];
  return CELSPAN_OK;
}

static void codes_of(const float light[3], double codes[3]) {
  float rgba[4] = {light[0], light[1], light[2], 1};
  cs_space_encode(CELSPAN_SPACE_SRGB, rgba);
  for (int c = 0; c < 3; c++)
    codes[c] = (double)rgba[c];
}

static celspan_status check_chroma(celspan_context *context, const celspan_key_desc *desc,
                                   const float screen[3]) {
  double codes[3];
  codes_of(screen, codes);
  if (!(cs_keying_hue(codes) >= GREY))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "key: colour is grey, and a key needs a hue; for black, white or grey screens "
                   "write luma = true, with from and to");
  CS_TRY(cs_check_size(context, "key", "tolerance", desc->tolerance));
  CS_TRY(cs_check_size(context, "key", "softness", desc->softness));
  return cs_check_range(context, "key", "spill", desc->spill, 0, 1);
}

static celspan_status check(celspan_context *context, const celspan_object *art,
                            const celspan_key_desc *desc, const float screen[3]) {
  CS_TRY(cs_check_given(context, "key", "the art", art));
  CS_TRY(cs_check_choice(context, "key", "by", (unsigned)desc->by, CELSPAN_KEY_LUMA + 1));
  if (desc->by == CELSPAN_KEY_CHROMA)
    return check_chroma(context, desc, screen);
  CS_TRY(cs_check_number(context, "key", "from", desc->from));
  return cs_check_number(context, "key", "to", desc->to);
}

/* ---------------------------------------------------------------- values */

static cs_hash hash_key(const cs_keying *key) {
  cs_hash hash = cs_hash_begin(CS_VALUE_GRADE);
  const float numbers[] = {key->chroma[0], key->chroma[1], key->screen[0], key->screen[1],
                           key->screen[2], key->spill,     key->from,      key->gain};
  cs_hash_word(&hash, key->is_luma);
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
    cs_hash_number(&hash, (double)numbers[i]);
  return cs_hash_end(hash);
}

static celspan_status make_key(celspan_context *context, const celspan_key_desc *desc,
                               const float screen[3], celspan_grade **out) {
  double codes[3];
  celspan_grade *grade;
  CS_TRY(CS_COUNTED_MAKE(context, grade));
  codes_of(screen, codes);
  grade->steps.keying =
      desc->by == CELSPAN_KEY_LUMA
          ? cs_keying_of_luma(desc->from, desc->to)
          : cs_keying_of_chroma(codes, desc->tolerance, desc->softness, desc->spill);
  grade->key = *desc;
  grade->key.colour = NULL;
  memcpy(grade->screen, screen, sizeof grade->screen);
  grade->hash = hash_key(&grade->steps.keying);
  *out = grade;
  return CELSPAN_OK;
}

celspan_status celspan_object_key(celspan_context *context, celspan_object *art,
                                  const celspan_key_desc *desc, celspan_object **out) {
  CS_READ(context, "key", celspan_key_desc, desc);
  cs_boolean look = {.op = CELSPAN_OPERATOR_UNION, .isolates = true};
  cs_primitive_data *data;
  celspan_grade *grade;
  float screen[3];
  CS_TRY(find_screen(context, desc->colour, screen));
  CS_TRY(check(context, art, desc, screen));
  CS_TRY(make_key(context, desc, screen, &grade));
  look.grade = grade;
  celspan_status status = cs_primitive_data_of_operands(context, "key", &look, &art, 1, &data);
  celspan_grade_unref(grade);
  return status == CELSPAN_OK ? cs_primitive_data_wrap(context, data, status, out) : status;
}
