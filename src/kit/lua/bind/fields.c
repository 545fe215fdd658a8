#include "lua/bind/fields.h"

#include <limits.h>
#include <math.h>
#include <string.h>

#include "inside/scene.h"
#include "lua/bind/host.h"
#include "lua/bind/numbers.h"
#include "lua/bind/suggest.h"
#include "lua/bind/userdata.h"

/* All readers below read the value on top of the stack, which is nil if a required field is
 * missing. */

static _Noreturn void fail_type(const cs_form *form, const cs_field *field, const char *wanted) {
  cs_form_fail(form, "field '%s' must be %s, got %s", field->name, wanted,
               cs_userdata_type(form->L, -1));
}

/* ---------------------------------------------------------------- numbers */

static bool has_range(const cs_field *field) { return field->least < field->most; }

static bool is_in_range(const cs_field *field, double number) {
  return number >= field->least && number <= field->most &&
         !(field->is_above && number == field->least);
}

/* Raises the error with the wording of the core. */
static void fail_range(const cs_form *form, const cs_field *field, double number) {
  celspan_context *context = cs_host_context(form->L);
  if (field->is_above)
    cs_form_try(form, cs_check_positive(context, "field", field->name, number));
  cs_form_try(form,
              cs_check_range(context, "field", field->name, number, field->least, field->most));
}

static double number_of(const cs_form *form, const cs_field *field) {
  lua_State *L = form->L;
  double number = lua_tonumber(L, -1);
  if (lua_type(L, -1) != LUA_TNUMBER || !isfinite(number)) {
    const char *subject = lua_pushfstring(L, "field '%s'", field->name);
    cs_numbers_check(L, -2, form->noun->name, subject);
  }
  if (has_range(field) && !is_in_range(field, number))
    fail_range(form, field, number);
  return number;
}

static bool is_whole(double number) {
  return number >= INT_MIN && number <= INT_MAX && number == (int)number;
}

/* The end of a message about a number that is not whole, which says what to do. */
static const char *rounding_hint(double number) {
  return number == floor(number) ? "" : "; math.ceil makes a number whole";
}

static int whole_of(const cs_form *form, const cs_field *field) {
  double number = number_of(form, field);
  if (!is_whole(number))
    cs_form_fail(form, "field '%s' must be a whole number, got %s", field->name,
                 cs_form_digits(form->L, number));
  return (int)number;
}

static void read_numbers(const cs_form *form, const cs_field *field, double *out) {
  const cs_numbers_name name = {
      .noun = form->noun->name, .field = field->name, .shape = field->shape};
  cs_numbers_read(form->L, -1, &name, field->count, field->count, out);
}

static void read_pixels(const cs_form *form, const cs_field *field, int32_t *out) {
  lua_State *L = form->L;
  double numbers[4];
  read_numbers(form, field, numbers);
  for (int i = 0; i < field->count; i++) {
    bool is_good = is_whole(numbers[i]) && (!has_range(field) || is_in_range(field, numbers[i]));
    if (!is_good && has_range(field))
      cs_form_fail(form, "%s[%d] must be a whole number from %s to %s, got %s%s", field->name,
                   i + 1, cs_form_digits(L, field->least), cs_form_digits(L, field->most),
                   cs_form_digits(L, numbers[i]), rounding_hint(numbers[i]));
    else if (!is_good)
      cs_form_fail(form, "field '%s' must hold whole numbers of pixels, got %s%s", field->name,
                   cs_form_digits(L, numbers[i]), rounding_hint(numbers[i]));
    out[i] = (int32_t)numbers[i];
  }
}

/* ---------------------------------------------------------------- words */

static bool flag_of(const cs_form *form, const cs_field *field) {
  if (lua_type(form->L, -1) != LUA_TBOOLEAN)
    fail_type(form, field, "true or false");
  return lua_toboolean(form->L, -1);
}

const char *cs_fields_push_words(lua_State *L, const char *const *words) {
  lua_pushliteral(L, "");
  for (size_t i = 0; words[i]; i++) {
    lua_pushfstring(L, "%s\"%s\"", i == 0 ? "" : words[i + 1] ? ", " : " or ", words[i]);
    lua_concat(L, 2);
  }
  return lua_tostring(L, -1);
}

static _Noreturn void fail_word(const cs_form *form, const char *name, const char *const *words) {
  const char *word = lua_type(form->L, -1) == LUA_TSTRING ? lua_tostring(form->L, -1) : NULL;
  const char *given = cs_userdata_shown(form->L, -1), *hint = "";
  size_t count = 0;
  const char *list = cs_fields_push_words(form->L, words);
  while (words[count])
    count++;
  const char *nearest = word ? cs_suggest_name(word, words, count) : NULL;
  if (nearest)
    hint = lua_pushfstring(form->L, "; did you mean \"%s\"?", nearest);
  cs_form_fail(form, "field '%s' must be %s, got %s%s", name, list, given, hint);
}

int cs_fields_word(const cs_form *form, const char *name, const char *const *words) {
  const char *word = lua_type(form->L, -1) == LUA_TSTRING ? lua_tostring(form->L, -1) : "";
  char out[CS_SUGGEST_SIZE];
  for (const char *own = word; own; own = own == word ? cs_suggest_own(word, false, out) : NULL)
    for (int place = 0; words[place]; place++)
      if (strcmp(words[place], own) == 0)
        return place;
  fail_word(form, name, words);
}

static const char *text_of(const cs_form *form, const cs_field *field) {
  if (lua_type(form->L, -1) != LUA_TSTRING)
    fail_type(form, field, "a string");
  const char *text = lua_tostring(form->L, -1);
  if (strlen(text) != lua_rawlen(form->L, -1))
    cs_form_fail(form, "field '%s' must not hold a zero byte", field->name);
  return text;
}

/* ---------------------------------------------------------------- fields */

/* Reads one field into `out`. Returns whether its value can be popped. */
static bool read_field(const cs_form *form, const cs_field *field, void *out) {
  switch (field->type) {
  case CS_TYPE_NUMBER:
    *(double *)out = number_of(form, field);
    return true;
  case CS_TYPE_WHOLE:
    *(int *)out = whole_of(form, field);
    return true;
  case CS_TYPE_FLAG:
    *(bool *)out = flag_of(form, field);
    return true;
  case CS_TYPE_CHOICE:
    *(int *)out = cs_fields_word(form, field->name, field->choices);
    return true;
  case CS_TYPE_NUMBERS:
    read_numbers(form, field, out);
    return true;
  case CS_TYPE_PIXELS:
    read_pixels(form, field, out);
    return true;
  case CS_TYPE_TEXT: /* the stack keeps it alive: a finaliser may remove it from the table */
    *(const char **)out = text_of(form, field);
    return false;
  default:
    *(celspan_texture **)out = cs_form_texture(form, field->name);
    return false;
  }
}

void cs_fields_read(const cs_form *form, void *desc) {
  lua_State *L = form->L;
  for (const cs_field *field = form->noun->fields; field->name; field = cs_field_next(field)) {
    if (field->type == CS_TYPE_OWN)
      continue;
    bool is_given = cs_form_get(form, field->name) != LUA_TNIL;
    if (field->has)
      *(bool *)((char *)desc + field->has) = is_given;
    if ((!is_given && !field->is_required) || read_field(form, field, (char *)desc + field->at))
      lua_pop(L, 1);
  }
}
