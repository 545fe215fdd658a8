/* luaopen_celspan: the module table. */
#include <lauxlib.h>
#include <string.h>

#include "celspan/lua.h"
#include "inside/colour.h"
#include "lua/bind/caller.h"
#include "lua/bind/construct.h"
#include "lua/bind/files.h"
#include "lua/bind/form.h"
#include "lua/bind/globals.h"
#include "lua/bind/host.h"
#include "lua/bind/names.h"
#include "lua/bind/require.h"
#include "lua/bind/suggest.h"
#include "lua/bind/warnings.h"
#include "lua/module/native.h"
#include "lua/module/parameters.h"
#include "lua/nouns/lua_film.h"
#include "lua/nouns/nouns.h"
#include "lua/nouns/placed.h"
#include "lua/nouns/random.h"
#include "lua/nouns/shown.h"

/* native.find(name): the path of a file; and if the file does not exist there, the other place that
 * was searched. */
static int find(lua_State *L) {
  const char *tried;
  cs_files_find(L, cs_files_name(L, 1), &tried);
  return 2;
}

/* native.nearest(word, names): the name that was probably meant, or nil. */
static int nearest(lua_State *L) {
  const char *word = luaL_checkstring(L, 1);
  luaL_checktype(L, 2, LUA_TTABLE);
  size_t count = lua_rawlen(L, 2);
  const char **names = lua_newuserdatauv(L, (count + 1) * sizeof *names, 0);
  for (size_t i = 0; i < count; i++) {
    if (lua_rawgeti(L, 2, (lua_Integer)i + 1) != LUA_TSTRING)
      return luaL_error(L, "nearest: name %d is not a string", (int)i + 1);
    names[i] = lua_tostring(L, -1); /* the table keeps it alive */
    lua_pop(L, 1);
  }
  lua_pushstring(L, cs_suggest_name(word, names, count));
  return 1;
}

/* native.synonym(word, is_field): celspan's spelling of a word that has another one, or nil. */
static int synonym(lua_State *L) {
  char out[CS_SUGGEST_SIZE];
  lua_pushstring(L, cs_suggest_own(luaL_checkstring(L, 1), lua_toboolean(L, 2), out));
  return 1;
}

/* native.hex(text): "#rrggbb" for the name of a colour, a text like that as it is, or nil. */
static int hex(lua_State *L) {
  char out[CS_FORM_HEX];
  lua_pushstring(L, cs_form_hex(luaL_checkstring(L, 1), out));
  return 1;
}

/* native.code(light) and native.light(code): the curve of sRGB, for numbers of at least 0. */
static int code_of(lua_State *L) {
  lua_pushnumber(L, cs_transfer_code(luaL_checknumber(L, 1)));
  return 1;
}

static int light_of(lua_State *L) {
  lua_pushnumber(L, cs_transfer_light(luaL_checknumber(L, 1)));
  return 1;
}

/* native.luma(): the weights of the channels in luma. */
static int luma(lua_State *L) {
  lua_pushnumber(L, CS_LUMA_RED);
  lua_pushnumber(L, CS_LUMA_GREEN);
  lua_pushnumber(L, CS_LUMA_BLUE);
  return 3;
}

/* native.refuse(message): raises it at the line of the nearest caller that does not belong to
 * celspan. */
static int refuse(lua_State *L) { return cs_caller_error(L, "%s", luaL_checkstring(L, 1)); }

/* native.miss(noun, sentence): the same for an input that is not there, which is no fault of the
 * script: the exit code is the core's for such a file. */
static int miss(lua_State *L) {
  const char *noun = luaL_checkstring(L, 1), *sentence = luaL_checkstring(L, 2);
  cs_host_try(L, noun, cs_fail(cs_host_context(L), CELSPAN_INPUT, "%s", sentence));
  return 0;
}

/* native.excess(message) -> nil, message: a file is too large or too deep for its reader. */
static int excess(lua_State *L) {
  return cs_host_fail(L, cs_fail(cs_host_context(L), CELSPAN_INPUT, "%s", luaL_checkstring(L, 1)));
}

/* Pushes a C function. Its upvalue is the only argument, a function. */
static int push_around(lua_State *L, lua_CFunction around) {
  luaL_checktype(L, 1, LUA_TFUNCTION);
  lua_settop(L, 1);
  lua_pushcclosure(L, around, 1);
  return 1;
}

/* native.entry(function): the same function, but it keeps the line of a caller that ends with a
 * call of it. */
static int entry(lua_State *L) { return push_around(L, cs_caller_enter); }

static int call_outside(lua_State *L) {
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  return lua_pcall(L, lua_gettop(L) - 1, LUA_MULTRET, 0) == LUA_OK ? lua_gettop(L) : lua_error(L);
}

/* native.outside(function): the same function, but its errors are raised after it has left the
 * stack, so that error handlers do not find it there. */
static int outside(lua_State *L) { return push_around(L, call_outside); }

/* Calls a function that the program provides, with the arguments. */
static int call_program(lua_State *L, const char *name, const char *what) {
  if (lua_getfield(L, LUA_REGISTRYINDEX, name) != LUA_TFUNCTION) {
    lua_pushnil(L);
    lua_pushfstring(L, "%s are read by the program celspan alone: run the script with it", what);
    return 2;
  }
  lua_insert(L, 1);
  lua_call(L, lua_gettop(L) - 1, 2);
  return 2;
}

/* native.hear(path, tried), native.spectrum(path, tried), native.movie(path, tried),
 * native.is_movie(path): see native.h. */
static int hear(lua_State *L) { return call_program(L, CS_NATIVE_HEAR, "sounds"); }

static int spectrum(lua_State *L) { return call_program(L, CS_NATIVE_SPECTRUM, "sounds"); }

static int movie(lua_State *L) { return call_program(L, CS_NATIVE_MOVIE, "movies"); }

static int is_movie(lua_State *L) { return call_program(L, CS_NATIVE_IS_MOVIE, "movies"); }

/* native.open_names(): gives the globals celspan's names, as in a script. */
static int open_names(lua_State *L) {
  cs_globals_open(L);
  return 0;
}

static const luaL_Reg native_functions[] = {{"find", find},
                                            {"nearest", nearest},
                                            {"synonym", synonym},
                                            {"hex", hex},
                                            {"names", cs_names_all},
                                            {"assigned", cs_globals_assigned},
                                            {"open_names", open_names},
                                            {"exposures", cs_shown_exposures},
                                            {"cels", cs_shown_cels},
                                            {"as_letter", cs_nouns_as_letter},
                                            {"nouns", cs_nouns_push},
                                            {"source", cs_embedded_source},
                                            {"refuse", refuse},
                                            {"code", code_of},
                                            {"light", light_of},
                                            {"luma", luma},
                                            {"miss", miss},
                                            {"excess", excess},
                                            {"warns", cs_warnings_kept},
                                            {"warn", cs_warnings_add},
                                            {"entry", entry},
                                            {"outside", outside},
                                            {"settings", cs_parameters_settings},
                                            {"sounds", cs_lua_film_sounds},
                                            {"captions", cs_lua_film_captions},
                                            {"hear", hear},
                                            {"spectrum", spectrum},
                                            {"movie", movie},
                                            {"is_movie", is_movie},
                                            {"difference", cs_difference_of},
                                            {"painting", cs_painting_read},
                                            {"archive", cs_archive_member},
                                            {"archive_size", cs_archive_size},
                                            {"is_data", cs_addresses_is_data},
                                            {"data", cs_addresses_make},
                                            {"blend_within", cs_placed_blend_within},
                                            {"warp", cs_derived_warp},
                                            {"boil", cs_derived_boil},
                                            {"trim", cs_operators_trim},
                                            {"round_corners", cs_operators_round_corners},
                                            {"zigzag", cs_operators_zigzag},
                                            {"pucker", cs_operators_pucker},
                                            {"offset", cs_operators_offset},
                                            {"twist", cs_operators_twist},
                                            {"anatomy", cs_anatomy_of},
                                            {"rebuild", cs_anatomy_rebuild},
                                            {"move_texture", cs_anatomy_move},
                                            {"ruler", cs_ruler_make},
                                            {"ruler_at", cs_ruler_at},
                                            {"parcels", cs_parcels_list},
                                            {"scenery", cs_scenery_of},
                                            {"scene_key", cs_scenery_key},
                                            {"scene_rear", cs_scenery_rear},
                                            {"parts", cs_parts_list},
                                            {"folder", cs_folders_names},
                                            {"within", cs_folders_within},
                                            {"file_text", cs_file_text},
                                            {"json", cs_json_text_read},
                                            {"trace", cs_tracing_make},
                                            {"trace_write", cs_tracing_write},
                                            {"tracker", cs_track_tracker},
                                            {"follow", cs_track_follow},
                                            {"rewind", cs_track_rewind},
                                            {"inverse", cs_track_inverse},
                                            {"recolouring", cs_recolour_make},
                                            {"recolour", cs_recolour_value},
                                            {"recolour_see", cs_recolour_see},
                                            {"strange", cs_recolour_strange},
                                            {"scan_open", cs_scanning_open},
                                            {"scan_close", cs_scanning_close},
                                            {"scan_pegs", cs_scanning_pegs},
                                            {"scan_corners", cs_scanning_corners},
                                            {"scan_shift", cs_scanning_shift},
                                            {"scan_lines", cs_scanning_lines},
                                            {"areas", cs_ink_areas_make},
                                            {"areas_close", cs_ink_areas_release},
                                            {"areas_at", cs_ink_areas_at},
                                            {"areas_way", cs_ink_areas_way},
                                            {"areas_measures", cs_ink_areas_measures},
                                            {"areas_picture", cs_ink_areas_picture},
                                            {"frames", cs_folders_frames},
                                            {"frame_name", cs_folders_frame_name},
                                            {"picture_size", cs_relight_size},
                                            {"light_estimate", cs_relight_estimate},
                                            {"light_shape", cs_relight_shape},
                                            {"relight_picture", cs_relight_picture},
                                            {"relight_exposures", cs_relight_exposures},
                                            {"relight_grounds", cs_relight_grounds},
                                            {"stack", cs_stack_make},
                                            {"stack_lights", cs_stack_lights},
                                            {"stack_light", cs_stack_light},
                                            {"relight_write", cs_relight_write},
                                            {"relight_read", cs_relight_read},
                                            {NULL, NULL}};

static int push_native(lua_State *L) {
  cs_host_open(L, NULL);
  luaL_newlib(L, native_functions);
  cs_drawing_open(L);
  return 1;
}

void cs_native_open(lua_State *L) {
  static const luaL_Reg native[] = {{"celspan.native", push_native}, {NULL, NULL}};
  cs_embedded_open(L);
  cs_require_give(L, native);
}

/* Pushes what is written here for a node of other compositors, or nil. */
static const char *push_theirs(lua_State *L, const char *name) {
  cs_require_module(L, "celspan.composite");
  lua_getfield(L, -1, "instead");
  lua_pushstring(L, name);
  lua_call(L, 1, 1);
  return lua_tostring(L, -1);
}

/* celspan.circl: a script has read a name that is not in the module's table. */
static int read_missing(lua_State *L) {
  if (lua_type(L, 2) != LUA_TSTRING)
    return 0;
  const char *names[CS_NAMES_MOST], *name = lua_tostring(L, 2);
  if (cs_names_push_written(L, 1, name))
    return 1;
  if (cs_embedded_has(name))
    return cs_caller_error(L, "celspan has no '%s'; it is a module: require \"celspan.%s\"", name,
                           name);
  const char *instead = push_theirs(L, name);
  if (instead)
    return cs_caller_error(L, "celspan has no '%s'; write %s", name, instead);
  size_t count = cs_names_list(L, 1, names);
  const char *nearest = cs_suggest_name(name, names, count);
  if (nearest)
    return cs_caller_error(L, "celspan has no '%s'; did you mean '%s'?", name, nearest);
  return cs_caller_error(L, "celspan has no '%s'", name);
}

static void set_reading(lua_State *L) {
  lua_createtable(L, 0, 1);
  lua_pushcfunction(L, read_missing);
  lua_setfield(L, -2, "__index");
  lua_setmetatable(L, -2);
}

int luaopen_celspan(lua_State *L) {
  static const luaL_Reg functions[] = {{"rgb", cs_nouns_rgb},
                                       {"gel", cs_nouns_gel},
                                       {"mix", cs_nouns_mix},
                                       {"clip", cs_nouns_clip},
                                       {"matte", cs_nouns_matte},
                                       {"glyphs", cs_nouns_glyphs},
                                       {"random", cs_random_make},
                                       {"render", cs_render_make},
                                       {"pixels", cs_pixels_make},
                                       {"spans", cs_spans_make},
                                       {"probe", cs_spans_probe},
                                       {"plane", cs_plane_make},
                                       {"plane_read", cs_plane_open_file},
                                       {"names", cs_globals_beside},
                                       {NULL, NULL}};
  luaL_checkversion(L);
  cs_host_open(L, NULL);
  lua_createtable(L, 0, 40);
  lua_pushfstring(L, "celspan %s", celspan_version());
  lua_setfield(L, -2, "_VERSION");
  for (const cs_kind *const *kind = cs_kinds; *kind; kind++)
    cs_userdata_register(L, *kind);
  for (const cs_noun *const *noun = cs_nouns_made; *noun; noun++) {
    cs_construct_push(L, *noun);
    lua_setfield(L, -2, (*noun)->name);
  }
  luaL_setfuncs(L, functions, 0);
  cs_nouns_push_clear(L);
  lua_setfield(L, -2, "clear");
  cs_pixels_open(L);
  cs_plane_open(L);
  cs_native_open(L);
  set_reading(L);
  return 1;
}
