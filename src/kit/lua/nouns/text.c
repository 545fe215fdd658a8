/* Text: celspan.text, one object; celspan.glyphs, an object a letter. */
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "celspan/text.h"
#include "inside/files.h"
#include "lua/bind/anchor.h"
#include "lua/bind/caller.h"
#include "lua/bind/construct.h"
#include "lua/bind/fields.h"
#include "lua/bind/files.h"
#include "lua/bind/host.h"
#include "lua/bind/list.h"
#include "lua/bind/named.h"
#include "lua/bind/put.h"
#include "lua/bind/suggest.h"
#include "lua/nouns/nouns.h"

#define HOLDER "celspan.letters"
#define MOST_SETTINGS 65 /* one more than the core allows, so that the core can report the limit */
#define MOST_FONTS 17

typedef struct text_form {
  celspan_text_desc desc;
  int face, index; /* counted from 1 in Lua */
} text_form;

/* ---------------------------------------------------------------- reading */

static void read_string(const cs_form *form, celspan_text_desc *desc) {
  lua_State *L = form->L;
  int length = cs_form_length(form);
  if (length != 1)
    cs_form_fail(form, "takes one string, the text, got %d values", length);
  if (lua_rawgeti(L, form->table, 1) != LUA_TSTRING && lua_type(L, -1) != LUA_TNUMBER)
    cs_form_fail(form, "value 1 must be a string, the text, got %s", cs_userdata_type(L, -1));
  desc->text = lua_tolstring(L, -1, &desc->text_size); /* for a number, this makes a new string */
}

/* The font whose name is nearest to a wanted one. */
typedef struct near_font {
  const char *name;
  int least; /* distance */
  char path[3 * (NAME_MAX + 1)];
} near_font;

/* Searches a folder, and `depth` levels of folders in it. before: their names, each with "/". */
static void search(near_font *near, const char *folder, const char *before, int depth) {
  char inner[PATH_MAX], names[2 * (NAME_MAX + 1)];
  DIR *open = opendir(folder);
  for (const struct dirent *entry; open && (entry = cs_open_entry(open));) {
    const char *name = entry->d_name;
    const int distance = cs_suggest_distance(near->name, name);
    if (distance < near->least && cs_files_is_font(name)) {
      near->least = distance;
      snprintf(near->path, sizeof near->path, "%s%s", before, name);
    } else if (depth > 0 && entry->d_type == DT_DIR && name[0] != '.') {
      snprintf(inner, sizeof inner, "%s/%s", folder, name);
      snprintf(names, sizeof names, "%s%s/", before, name);
      search(near, inner, names, depth - 1);
    }
  }
  if (open)
    closedir(open);
}

/* Raises the error that a font is missing, if a font with a similar name lies in the folder where
 * it was looked for, or in folders there. */
static void refuse_missing(const cs_form *form, const char *path) {
  const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
  near_font near = {.name = name, .least = (int)strlen(name) / 3 + 1};
  lua_pushlstring(form->L, path, (size_t)(name - path));
  search(&near, slash ? lua_tostring(form->L, -1) : ".", "", 2);
  lua_pop(form->L, 1);
  if (near.path[0])
    cs_form_try(form, celspan_context_fail(
                          cs_host_context(form->L), CELSPAN_INPUT,
                          "%.500s: No such file or directory; did you mean \"%s\"? 'celspan fonts' "
                          "lists the fonts there are",
                          path, near.path));
}

/* The font on top of the stack; values pushed by the search are left above it. */
static const char *read_font(const cs_form *form) {
  lua_State *L = form->L;
  if (lua_type(L, -1) != LUA_TSTRING)
    cs_form_fail(form, "field 'font' must be the name of a file, or a list of them, got %s",
                 cs_userdata_type(L, -1));
  const char *name = lua_tostring(L, -1);
  if (strlen(name) != lua_rawlen(L, -1))
    cs_form_fail(form, "field 'font' must not hold a zero byte");
  const char *tried, *path = cs_files_find(L, name, &tried);
  if (access(path, F_OK) == 0 || errno != ENOENT)
    return path;
  refuse_missing(form, path);
  if (tried)
    refuse_missing(form, tried);
  return path;
}

static void read_fonts(const cs_form *form, celspan_text_desc *desc) {
  lua_State *L = form->L;
  const char **fonts = cs_form_scratch(L, MOST_FONTS, sizeof *fonts);
  desc->fonts = fonts;
  luaL_checkstack(L, 3 * MOST_FONTS, "fonts");
  if (cs_form_get(form, "font") == LUA_TNIL)
    cs_form_fail(form, "field 'font' is missing: give the file of a font, or a list of files");
  int list = lua_gettop(L);
  if (lua_type(L, list) != LUA_TTABLE) {
    fonts[desc->font_count++] = read_font(form);
    return;
  }
  lua_Integer count = cs_list_length(L, list);
  for (lua_Integer i = 1; i <= count && i <= MOST_FONTS; i++) {
    lua_rawgeti(L, list, i);
    fonts[desc->font_count++] = read_font(form);
  }
}

/* Pushes the field; false if it is missing. Raises an error unless it is a table by name. */
static bool get_settings(const cs_form *form, const char *field) {
  int type = cs_form_get(form, field);
  if (type != LUA_TTABLE && type != LUA_TNIL)
    cs_form_fail(form, "field '%s' must be a table by name, got %s", field,
                 cs_userdata_type(form->L, -1));
  return type == LUA_TTABLE;
}

static const char *setting_name(const cs_form *form, const char *field) {
  lua_State *L = form->L;
  if (lua_type(L, -2) != LUA_TSTRING)
    cs_form_fail(form, "field '%s' is a table by name, such as { %s }, but has the key %s", field,
                 field[0] == 'f' ? "liga = false" : "wght = 700", luaL_tolstring(L, -2, NULL));
  return lua_tostring(L, -2);
}

/* true, false, or a whole number. */
static uint32_t feature_value(const cs_form *form, const char *name) {
  lua_State *L = form->L;
  if (lua_isboolean(L, -1))
    return (uint32_t)lua_toboolean(L, -1);
  double number = lua_type(L, -1) == LUA_TNUMBER ? lua_tonumber(L, -1) : -1;
  if (!(number >= 0 && number <= 65535) || number != floor(number))
    cs_form_fail(form, "features: %s must be true, false or a whole number from 0 to 65535, got %s",
                 name, luaL_tolstring(L, -1, NULL));
  return (uint32_t)number;
}

static int compare_features(const void *a, const void *b) {
  return strcmp(((const celspan_feature *)a)->tag, ((const celspan_feature *)b)->tag);
}

static int compare_variations(const void *a, const void *b) {
  return strcmp(((const celspan_variation *)a)->tag, ((const celspan_variation *)b)->tag);
}

static void read_features(const cs_form *form, celspan_text_desc *desc) {
  lua_State *L = form->L;
  celspan_feature *features = cs_form_scratch(L, MOST_SETTINGS, sizeof *features);
  if (!get_settings(form, "features"))
    return;
  int table = lua_gettop(L);
  for (lua_pushnil(L); desc->feature_count < MOST_SETTINGS && lua_next(L, table); lua_pop(L, 1)) {
    const char *name = setting_name(form, "features");
    features[desc->feature_count++] = (celspan_feature){name, feature_value(form, name)};
  }
  lua_settop(L, table);
  qsort(features, desc->feature_count, sizeof *features, compare_features);
  desc->features = features;
}

static void read_variations(const cs_form *form, celspan_text_desc *desc) {
  lua_State *L = form->L;
  celspan_variation *variations = cs_form_scratch(L, MOST_SETTINGS, sizeof *variations);
  if (!get_settings(form, "variations"))
    return;
  int table = lua_gettop(L);
  for (lua_pushnil(L); desc->variation_count < MOST_SETTINGS && lua_next(L, table); lua_pop(L, 1)) {
    const char *name = setting_name(form, "variations");
    if (lua_type(L, -1) != LUA_TNUMBER)
      cs_form_fail(form, "variations: %s must be a number, got %s", name, cs_userdata_type(L, -1));
    variations[desc->variation_count++] = (celspan_variation){name, lua_tonumber(L, -1)};
  }
  lua_settop(L, table);
  qsort(variations, desc->variation_count, sizeof *variations, compare_variations);
  desc->variations = variations;
}

/* Borrows from values that are left on the stack. has_letters: the values that are made are letters
 * of the text. */
static text_form read_text(const cs_form *form, bool has_letters) {
  text_form read = {.desc = CELSPAN_TEXT_DESC, .face = 1};
  read_string(form, &read.desc);
  cs_fields_read(form, &read);
  read_fonts(form, &read.desc);
  read.desc.face = (uint32_t)read.face - 1;
  read_features(form, &read.desc);
  read_variations(form, &read.desc);
  const cs_named_words words = {read.desc.text, read.desc.text_size, read.desc.size, has_letters};
  cs_named_add_words(form->L, cs_host_context(form->L), &words);
  return read;
}

/* ---------------------------------------------------------------- text */

static void create_text(const cs_form *form, cs_userdata *value) {
  text_form read = read_text(form, false);
  celspan_object *object = NULL;
  cs_form_try(form, celspan_object_create_text(cs_host_context(form->L), &read.desc, &object));
  value->handle = object;
}

static const char *const aligns[] = {"left", "centre", "right", NULL};
static const char *const valigns[] = {"baseline", "top", "cap", "middle", "bottom", NULL};
static const char *const directions[] = {"auto", "ltr", "rtl", NULL};

static const cs_field text_fields[] = {
    {"font", CS_OWN("string|string[]"), .is_required = true,
     .about = "Files; each letter is taken from the first font that has it"},
    {"size", CS_NUMBER(text_form, desc.size), CS_FROM(0), .preset = "48", .about = "The em"},
    {"at", CS_POINT(text_form, desc.at), .about = "The baseline of the first line",
     .fallback = "{0, 0}"},
    {"align", CS_CHOICE(text_form, desc.align, aligns), .preset = "left",
     .about = "The same in every script"},
    {"valign", CS_CHOICE(text_form, desc.valign, valigns), .preset = "baseline",
     .about = "What of the text lies at at[2]"},
    {"width", CS_NUMBER(text_form, desc.width), CS_HAS(text_form, desc.has_width), CS_FROM(0),
     .about = "Lines wrap, and align within at[1] .. at[1] + width"},
    {"leading", CS_NUMBER(text_form, desc.leading), .preset = "1.2",
     .about = "From baseline to baseline, times size"},
    {"tracking", CS_NUMBER(text_form, desc.tracking), .preset = "0",
     .about = "Thousandths of an em after each letter"},
    {"features", CS_OWN("table<string, boolean|integer>"),
     .about = "OpenType features: { liga = false, ss01 = true, salt = 2 }"},
    {"variations", CS_OWN("table<string, number>"),
     .about = "Axes of variable fonts: { wght = 700 }"},
    {"language", CS_TEXT(text_form, desc.language), .about = "\"en\", \"tr\", \"zh-Hant\""},
    {"direction", CS_CHOICE(text_form, desc.direction, directions),
     .fallback = "by the first letter of each line of the text"},
    {"face", CS_WHOLE(text_form, face), CS_FROM(1), .preset = "1",
     .about = "The number of the font in a collection (.ttc, .otc)"},
    {CS_TEXTURE(text_form, desc.texture)},
    {0}};
static const cs_field glyph_fields[] = {
    {"index", CS_WHOLE(text_form, index), .is_required = true, .about = "From 1"},
    {.more = text_fields}};

static const cs_place places[] = {{"at", 2}, {0}};
#define STRING                                                                                     \
  .list = CS_LIST_TUPLE, .item = "string|number", .item_written = "string|number",                 \
  .item_about = "The text, x, y; \\n breaks lines", .places = "{text, x, y}", .by_place = places
const cs_noun cs_noun_text = {.name = "text",
                              .about = "The letters of a text as one primitive.",
                              .kind = &cs_kind_object,
                              .fields = text_fields,
                              .create = create_text,
                              STRING};
static const cs_noun noun_glyphs = {.name = "glyphs", .fields = text_fields, STRING};

/* ---------------------------------------------------------------- glyphs */

CS_HOLDER_RELEASE(release, celspan_glyphs, celspan_glyphs_destroy)

/* Pushes a holder of the letters, which keeps them until they are values. */
static celspan_glyphs **push_letters(const cs_form *form, const celspan_text_desc *desc) {
  lua_State *L = form->L;
  celspan_glyphs **holder = cs_userdata_push_holder(L, HOLDER, sizeof *holder, release);
  cs_form_try(form, celspan_glyphs_create(cs_host_context(L), desc, holder));
  return holder;
}

/* Gives the value the letter as its object. */
static void hold(cs_userdata *value, const celspan_glyph *glyph) {
  cs_anchor *anchor = cs_userdata_own(value);
  anchor->baseline = (celspan_point){glyph->x + glyph->advance / 2, glyph->y};
  anchor->has_baseline = true;
  value->handle = celspan_object_ref(glyph->object);
}

/* Makes one of the letters again, for :with. */
static void create_glyph(const cs_form *form, cs_userdata *value) {
  text_form read = read_text(form, true);
  int index = read.index;
  const celspan_glyphs *letters = *push_letters(form, &read.desc);
  size_t count = celspan_glyphs_count(letters);
  if (index < 1 || (size_t)index > count)
    cs_form_fail(form, "field 'index' must be from 1 to %d, the letters of the text, got %d",
                 (int)count, index);
  hold(value, celspan_glyphs_get(letters, (size_t)index - 1));
}

const cs_noun cs_noun_glyph = {.name = "glyph",
                               .about = "A letter as an object; `with` returns the letter of "
                                        "the same index of the changed text.",
                               .kind = &cs_kind_object,
                               .fields = glyph_fields,
                               .create = create_glyph,
                               STRING};

/* Pushes the object of a letter. Its fields are the fields at index `fields`, and its place. */
static void push_object(lua_State *L, int fields, const celspan_glyph *glyph, lua_Integer index) {
  hold(cs_userdata_push(L, &cs_noun_glyph), glyph);
  lua_newtable(L);
  for (lua_pushnil(L); lua_next(L, fields);) {
    lua_pushvalue(L, -2);
    lua_insert(L, -2);
    lua_rawset(L, -4);
  }
  cs_put_integer(L, "index", index);
  lua_setiuservalue(L, -2, 1);
}

/* Reading what a letter does not have: the methods are those of its object. */
static int refuse_method(lua_State *L) {
  const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "";
  for (const luaL_Reg *method = cs_placed_methods; method->name; method++)
    if (strcmp(method->name, name) == 0)
      return cs_caller_error(L, "a letter has no '%s': write letter.object:%s(...)", name, name);
  lua_pushnil(L);
  return 1;
}

int cs_nouns_as_letter(lua_State *L) {
  static const luaL_Reg metamethods[] = {{"__index", refuse_method}, {NULL, NULL}};
  lua_settop(L, 1);
  cs_userdata_open_metatable(L, "celspan.letter", metamethods);
  luaL_setmetatable(L, "celspan.letter");
  return 1;
}

static void push_glyph(lua_State *L, int fields, const celspan_glyph *glyph, lua_Integer index) {
  lua_createtable(L, 0, 7);
  push_object(L, fields, glyph, index);
  lua_setfield(L, -2, "object");
  cs_put_number(L, "x", glyph->x);
  cs_put_number(L, "y", glyph->y);
  cs_put_number(L, "advance", glyph->advance);
  cs_put_number(L, "middle", glyph->x + glyph->advance / 2);
  lua_pushlstring(L, glyph->text, glyph->text_size);
  lua_setfield(L, -2, "text");
  cs_put_integer(L, "line", glyph->line);
  lua_pushcfunction(L, cs_nouns_as_letter);
  lua_insert(L, -2);
  lua_call(L, 1, 1);
}

int cs_nouns_glyphs(lua_State *L) {
  lua_settop(L, 1);
  cs_form form = cs_form_open(L, &noun_glyphs, 1);
  celspan_context *context = cs_host_context(L);
  cs_named_begin(L, context);
  text_form read = read_text(&form, true);
  celspan_glyphs **holder = push_letters(&form, &read.desc);
  cs_named_end(context);
  cs_construct_push_fields(L, &cs_noun_glyph, 1);
  int fields = lua_gettop(L);
  size_t count = celspan_glyphs_count(*holder);
  lua_createtable(L, (int)count, 0);
  for (size_t i = 0; i < count; i++) {
    push_glyph(L, fields, celspan_glyphs_get(*holder, i), (lua_Integer)i + 1);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  celspan_glyphs_destroy(*holder);
  *holder = NULL;
  return 1;
}

/* ---------------------------------------------------------------- metrics */

int cs_text_metrics(lua_State *L) {
  const cs_userdata *text = cs_userdata_self(L, &cs_kind_object, "metrics");
  if (text->noun != &cs_noun_text)
    return cs_caller_error(L, "metrics: only a text has them, not a %s", text->noun->name);
  cs_userdata_push_fields(L, 1);
  cs_form form = cs_form_open(L, &cs_noun_text, -1);
  celspan_context *context = cs_host_context(L);
  celspan_text_metrics metrics = CELSPAN_TEXT_METRICS;
  cs_named_begin(L, context);
  text_form read = read_text(&form, false);
  cs_form_try(&form, celspan_text_measure(context, &read.desc, &metrics));
  cs_named_end(context);
  lua_createtable(L, 0, 7);
  cs_put_number(L, "ascent", metrics.ascent);
  cs_put_number(L, "descent", metrics.descent);
  cs_put_number(L, "cap_height", metrics.cap_height);
  cs_put_number(L, "x_height", metrics.x_height);
  cs_put_number(L, "width", metrics.width);
  cs_put_number(L, "height", metrics.height);
  cs_put_integer(L, "lines", metrics.lines);
  return 1;
}
