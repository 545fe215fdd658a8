#include "lua/nouns/grade.h"

#include "inside/colour.h"
#include "lua/bind/fields.h"
#include "lua/bind/files.h"
#include "lua/bind/host.h"
#include "lua/bind/list.h"
#include "lua/bind/numbers.h"
#include "lua/nouns/nouns.h"
#include "lua/nouns/placed.h"

typedef struct grade_form {
  celspan_grade_desc desc;
  const char *lut;
  int lut_space; /* an index of cs_space_words */
} grade_form;

#define FORM grade_form
static const cs_field fields[] = {
    {"exposure", CS_NUMBER(FORM, desc.exposure), .least = -CELSPAN_GRADE_STOPS,
     .most = CELSPAN_GRADE_STOPS, .preset = "0", .about = "Stops: times 2 to the power of this"},
    {"slope", CS_NUMBERS(FORM, desc.slope), .shape = "three numbers {r, g, b}",
     .about = "Of the ASC CDL: (c slope + offset)^power, held above 0", .fallback = "{1, 1, 1}"},
    {"offset", CS_NUMBERS(FORM, desc.offset), .shape = "three numbers {r, g, b}",
     .fallback = "{0, 0, 0}"},
    {"power", CS_NUMBERS(FORM, desc.power), .shape = "three numbers {r, g, b}",
     .about = "0.0009765625 to 1024", .fallback = "{1, 1, 1}"},
    {"contrast", CS_NUMBER(FORM, desc.contrast), CS_FROM(0), .preset = "1"},
    {"pivot", CS_NUMBER(FORM, desc.pivot), CS_HAS(FORM, desc.has_pivot),
     .about = "What contrast leaves as it is", .fallback = "0.18, and 0.46 in \"srgb\""},
    {"saturation", CS_NUMBER(FORM, desc.saturation), CS_FROM(0), .preset = "1"},
    {"hue", CS_NUMBER(FORM, desc.hue_radians), .preset = "0", .about = "Degrees"},
    {"temperature", CS_NUMBER(FORM, desc.temperature), .least = -1, .most = 1, .preset = "0",
     .about = "From blue to orange"},
    {"tint", CS_NUMBER(FORM, desc.tint), .least = -1, .most = 1, .preset = "0",
     .about = "From green to magenta"},
    {"gamma", CS_NUMBER(FORM, desc.gamma), .least = 1.0 / CELSPAN_GRADE_GAMMA,
     .most = CELSPAN_GRADE_GAMMA, .preset = "1"},
    {"matrix", CS_OWN("number[][]"), .about = "3 rows of 4: red, green, blue by those, and 1"},
    {"curve", CS_OWN("celspan.point[]|celspan.point[][]"),
     .about = "{in, out}, ..., for all channels or three times: a monotone cubic"},
    {"steps", CS_WHOLE(FORM, desc.steps), .least = 2, .most = CS_GRADE_STEPS,
     .about = "Levels of each channel's sRGB code", .fallback = "none"},
    {"lut", CS_TEXT(FORM, lut), .about = "The name of a .cube file"},
    {"lut_space", CS_CHOICE(FORM, lut_space, cs_space_words),
     .about = "What the numbers of the table are: sRGB codes, or light", .preset = "srgb"},
    {0}};
const cs_noun cs_noun_grade = {.name = "grade",
                               .about = "Steps that change colours, in this order.",
                               .table = "celspan.grade",
                               .fields = fields};

/* Pushes item i of the list at `list`, which must be a table. */
static void push_item(const cs_form *form, int list, int i, const char *field, const char *shape) {
  lua_rawgeti(form->L, list, i);
  if (!lua_istable(form->L, -1))
    cs_form_fail(form, "field '%s' must be %s, got %s as item %d", field, shape,
                 cs_userdata_type(form->L, -1), i);
}

/* Pushes the field; false if it is missing. */
static bool get_list(const cs_form *form, const char *field, const char *shape) {
  int type = cs_form_get(form, field);
  if (type != LUA_TNIL && type != LUA_TTABLE)
    cs_form_fail(form, "field '%s' must be %s, got %s", field, shape,
                 cs_userdata_type(form->L, -1));
  return type == LUA_TTABLE;
}

static void read_matrix(const cs_form *form, celspan_grade_desc *desc) {
  static const char shape[] = "3 rows of 4 numbers";
  lua_State *L = form->L;
  desc->has_matrix = get_list(form, "matrix", shape);
  if (!desc->has_matrix)
    return;
  int list = lua_gettop(L);
  const cs_numbers_name row = {
      .noun = form->noun->name, .field = "matrix", .shape = "rows {r, g, b, 1}"};
  if (cs_list_length(L, list) != 3)
    cs_form_fail(form, "field 'matrix' must be %s, got %d rows", shape,
                 (int)cs_list_length(L, list));
  for (int i = 0; i < 3; i++) {
    push_item(form, list, i + 1, "matrix", shape);
    cs_numbers_read(L, -1, &row, 4, 4, desc->matrix[i]);
  }
}

static const char curve_shape[] = "points {in, out}, or three lists of them";

/* The points of the list at an index, which is kept on the stack. */
static void read_curve(const cs_form *form, int list, celspan_grade_desc *desc, int channel) {
  lua_Integer count = cs_list_length(form->L, list);
  if (count < 2 || count > CS_GRADE_POINTS)
    cs_form_fail(form, "field 'curve' must have 2 to %d points, got %d", CS_GRADE_POINTS,
                 (int)count);
  desc->curve[channel] = cs_form_points(form, list, (size_t)count, NULL);
  desc->curve_count[channel] = (size_t)count;
}

/* Whether the list at an index begins with a list of points, not with a point. */
static bool has_channels(lua_State *L, int list) {
  lua_rawgeti(L, list, 1);
  bool has = lua_istable(L, -1) && lua_rawgeti(L, -1, 1) == LUA_TTABLE;
  lua_settop(L, list);
  return has;
}

static void read_curves(const cs_form *form, celspan_grade_desc *desc) {
  lua_State *L = form->L;
  if (!get_list(form, "curve", curve_shape))
    return;
  int list = lua_gettop(L);
  if (!has_channels(L, list)) {
    read_curve(form, list, desc, 0);
    desc->curve[1] = desc->curve[2] = desc->curve[0];
    desc->curve_count[1] = desc->curve_count[2] = desc->curve_count[0];
    return;
  }
  if (cs_list_length(L, list) != 3)
    cs_form_fail(form, "field 'curve' must be %s, got %d lists", curve_shape,
                 (int)cs_list_length(L, list));
  for (int c = 0; c < 3; c++) {
    push_item(form, list, c + 1, "curve", curve_shape);
    read_curve(form, lua_gettop(L), desc, c);
  }
}

celspan_grade *cs_grade_of(const cs_form *outer) {
  lua_State *L = outer->L;
  grade_form read = {.desc = CELSPAN_GRADE_DESC, .lut_space = 1};
  celspan_grade *grade = NULL;
  int type = cs_form_get(outer, "grade");
  if (type == LUA_TNIL)
    return NULL;
  if (type != LUA_TTABLE)
    cs_form_fail(outer, "field 'grade' must be a table such as { exposure = 1 }, got %s",
                 cs_userdata_type(L, -1));
  luaL_checkstack(L, 32, "a grade");
  cs_noun named = cs_noun_grade;
  named.name = lua_pushfstring(L, "%s: grade", outer->noun->name);
  cs_form form = cs_form_open(L, &named, -2);
  cs_fields_read(&form, &read);
  read.desc.lut_space = (celspan_space)(CELSPAN_SPACE_LINEAR + read.lut_space);
  read.desc.hue_radians = cs_placed_radians(read.desc.hue_radians);
  read_matrix(&form, &read.desc);
  read_curves(&form, &read.desc);
  if (read.lut)
    read.desc.lut = cs_files_find(L, read.lut, NULL);
  cs_form_try(&form, celspan_grade_create(cs_host_context(L), &read.desc, &grade));
  return grade;
}
