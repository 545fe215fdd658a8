/* Paints: the Beta colour model in Lua. */
#include <math.h>

#include "lua/bind/caller.h"
#include "lua/bind/fields.h"
#include "lua/bind/host.h"
#include "lua/bind/named.h"
#include "lua/bind/numbers.h"
#include "lua/bind/put.h"
#include "lua/nouns/nouns.h"

/* Each paint gets its own texture at once, so that the core checks the paint here, and objects can
 * share the texture. */
static void fill(lua_State *L, celspan_context *context, const char *noun, cs_userdata *value,
                 celspan_paint paint) {
  celspan_texture *texture = NULL;
  cs_host_try(L, noun, celspan_texture_create_paint(context, &paint, &texture));
  value->handle = texture;
  *(celspan_paint *)cs_userdata_own(value) = paint;
}

static celspan_paint from_doubles(const double pigment[3], const double medium[3], double beta) {
  celspan_paint paint = {.beta = (float)beta};
  for (int i = 0; i < 3; i++) {
    paint.pigment[i] = (float)pigment[i];
    paint.medium[i] = (float)medium[i];
  }
  return paint;
}

/* The field `name`: three numbers, or a string that names a colour without alpha. */
static void read_triple(const cs_form *form, const char *name, double triple[3]) {
  lua_State *L = form->L;
  int type = cs_form_get(form, name);
  if (type != LUA_TSTRING) {
    const cs_numbers_name list = {form->noun->name, .field = name, .shape = "a colour {r, g, b}"};
    if (type != LUA_TNIL)
      cs_numbers_read(L, -1, &list, 3, 3, triple);
    lua_pop(L, 1);
    return;
  }
  celspan_paint colour;
  const char *text = lua_tostring(L, -1);
  if (!cs_form_colour(text, &colour) || colour.beta != 1)
    cs_form_fail(form, "field '%s' must be {r, g, b} or a colour like \"#rrggbb\", got %s", name,
                 cs_form_shown_colour(L, -1));
  for (int i = 0; i < 3; i++)
    triple[i] = colour.pigment[i];
  lua_pop(L, 1);
}

typedef struct paint_form {
  double pigment[3], medium[3], beta;
} paint_form;

static void create_paint(const cs_form *form, cs_userdata *value) {
  paint_form read = {{0, 0, 0}, {1, 1, 1}, 1};
  read_triple(form, "pigment", read.pigment);
  read_triple(form, "medium", read.medium);
  cs_fields_read(form, &read);
  fill(form->L, cs_host_context(form->L), form->noun->name, value,
       from_doubles(read.pigment, read.medium, read.beta));
}

/* Adds a missing triple, and replaces a colour by its numbers, so that scripts can read it. */
static void complete_triple(lua_State *L, int fields, const char *name, double fallback) {
  int type = lua_getfield(L, fields, name);
  celspan_paint colour;
  if (type == LUA_TSTRING && cs_form_colour(lua_tostring(L, -1), &colour)) {
    double numbers[3] = {colour.pigment[0], colour.pigment[1], colour.pigment[2]};
    lua_settop(L, fields);
    cs_put_numbers(L, name, numbers, 3);
  } else if (type == LUA_TNIL) {
    lua_settop(L, fields);
    cs_put_numbers(L, name, (const double[]){fallback, fallback, fallback}, 3);
  }
  lua_settop(L, fields);
}

static void complete_paint(lua_State *L, int fields) {
  complete_triple(L, fields, "pigment", 0);
  complete_triple(L, fields, "medium", 1);
}

#define TRIPLE CS_OWN("number[]|string"), .read = "number[]", .shape = "a colour {r, g, b}"
static const cs_field paint_fields[] = {
    {"pigment", TRIPLE, .about = "{r, g, b} or \"#rrggbb\"", .fallback = "black"},
    {"medium", TRIPLE, .about = "{r, g, b} or \"#rrggbb\"", .fallback = "white, which is clear"},
    {"beta", CS_NUMBER(paint_form, beta), .least = 0, .most = 1, .preset = "1",
     .about = "The share of the pigment"},
    {0}};
const cs_noun cs_noun_paint = {
    .name = "paint",
    .about =
        "A paint of the Beta colour model: `pigment` scatters the front light, `medium` filters "
        "the light from behind, `beta` is the share of the pigment. All values are straight, 0..1.",
    .kind = &cs_kind_paint,
    .fields = paint_fields,
    .create = create_paint,
    .complete = complete_paint};

/* pigment NULL: black; medium NULL: clear. */
static int push_paint(lua_State *L, const char *noun, const double *pigment, const double *medium,
                      double beta) {
  static const double black[3] = {0, 0, 0}, clear[3] = {1, 1, 1};
  pigment = pigment ? pigment : black;
  medium = medium ? medium : clear;
  cs_packed packed; /* the fields of cs_noun_paint, in their order */
  cs_packed_begin(&packed);
  cs_packed_add_list(&packed, pigment, 3);
  cs_packed_add_list(&packed, medium, 3);
  cs_packed_add_number(&packed, beta);
  cs_userdata *value = cs_userdata_push_packed(L, &cs_noun_paint, false, &packed);
  celspan_context *context = cs_host_context(L);
  cs_named_begin(L, context);
  fill(L, context, noun, value, from_doubles(pigment, medium, beta));
  cs_named_end(context);
  return 1;
}

static void read_rgb(lua_State *L, const char *function, double rgb[3]) {
  static const char *const names[] = {"red", "green", "blue"};
  for (int i = 0; i < 3; i++)
    rgb[i] = cs_form_argument(L, i + 1, function, names[i]);
}

/* Reads argument 1 if it is a string: the colour of this name, and *alpha. */
static bool read_text(lua_State *L, const char *function, double rgb[3], double *alpha) {
  if (lua_type(L, 1) != LUA_TSTRING)
    return false;
  celspan_paint colour;
  if (!cs_form_colour(lua_tostring(L, 1), &colour))
    cs_caller_error(L, "%s: takes numbers or a colour like \"#rrggbb\", got %s", function,
                    cs_form_shown_colour(L, 1));
  for (int i = 0; i < 3; i++)
    rgb[i] = colour.pigment[i];
  *alpha = colour.beta;
  return true;
}

/* (r, g, b [, alpha]) or ("#rrggbb" [, alpha]): a given alpha replaces the alpha of the string. */
static void read_colour(lua_State *L, const char *function, double rgb[3], double *alpha) {
  bool is_text = read_text(L, function, rgb, alpha);
  int place = is_text ? 2 : 4;
  if (!is_text)
    read_rgb(L, function, rgb);
  if (!lua_isnoneornil(L, place))
    *alpha = cs_form_argument(L, place, function, "alpha");
  if (*alpha < 0 || *alpha > 1)
    cs_caller_error(L, "%s: alpha is %s; it must be between 0 and 1", function,
                    cs_form_digits(L, *alpha));
}

int cs_nouns_rgb(lua_State *L) {
  double pigment[3], alpha = 1;
  read_colour(L, "rgb", pigment, &alpha);
  return push_paint(L, "rgb", pigment, NULL, alpha);
}

/* gel(r, g, b) or gel("#rrggbb"), both with an optional alpha, which mixes the gel with clear as in
 * a picture of gels. */
int cs_nouns_gel(lua_State *L) {
  double medium[3], alpha = 1;
  read_colour(L, "gel", medium, &alpha);
  for (int i = 0; i < 3 && alpha < 1; i++)
    medium[i] = alpha * medium[i] + (1 - alpha);
  return push_paint(L, "gel", NULL, medium, 0);
}

static celspan_paint mix_argument(lua_State *L, int index) {
  celspan_paint paint;
  if (lua_type(L, index) == LUA_TSTRING && cs_form_colour(lua_tostring(L, index), &paint))
    return paint;
  const cs_userdata *value = cs_userdata_test(L, index, &cs_kind_paint);
  if (!value)
    cs_caller_error(L, "mix: argument %d must be a paint or a colour like \"#rrggbb\", got %s%s",
                    index, cs_form_shown_colour(L, index),
                    lua_isuserdata(L, index) ? ": mix the colours that it is made of" : "");
  return *(const celspan_paint *)cs_userdata_own(value);
}

int cs_nouns_mix(lua_State *L) {
  celspan_paint p = mix_argument(L, 1), q = mix_argument(L, 2);
  double u = cs_form_argument(L, 3, "mix", "the share of the second paint");
  celspan_paint paint = celspan_paint_mix(p, q, (float)fmin(fmax(u, 0), 1));
  double pigment[3], medium[3];
  for (int i = 0; i < 3; i++) {
    pigment[i] = paint.pigment[i];
    medium[i] = paint.medium[i];
  }
  return push_paint(L, "mix", pigment, medium, paint.beta);
}

void cs_nouns_push_clear(lua_State *L) { push_paint(L, "clear", NULL, NULL, 0); }
