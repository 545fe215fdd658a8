/* The functions of the module celspan, and those of celspan.native, which celspan's own Lua modules
 * use and which scripts do not see. A function that can fail returns nil and a message.
 */
#pragma once

#include <lua.h>
#include <stdbool.h>

/* ---------------------------------------------------------------- celspan */

int cs_render_make(lua_State *L); /* (film or rostrum, pattern [, options]) */
int cs_pixels_make(lua_State *L); /* (what [, options]) */
int cs_spans_make(lua_State *L);  /* (what [, options]) */
int cs_spans_probe(lua_State *L); /* (what, x, y [, options]) */
/* Makes the metatable of the images of celspan.pixels. */
void cs_plane_open(lua_State *L);
void cs_pixels_open(lua_State *L);

/* ---------------------------------------------------------------- built-in Lua modules */

/* Puts the modules for scripts into package.preload, where private modules would refuse to load.
 * Gives the private modules to celspan's own modules (lua/bind/require.h). */
void cs_embedded_open(lua_State *L);
/* The same, and also celspan.native. */
void cs_native_open(lua_State *L);
/* Whether there is a module celspan.NAME for scripts. */
bool cs_embedded_has(const char *name);
/* (name) -> the source of a module, for celspan.manual */
int cs_embedded_source(lua_State *L);

/* Lets `require` of a host also find modules beside the file that requires them, after the usual
 * places. Does nothing without the library package, or when it is called again. */
void cs_beside_open(lua_State *L);

/* ---------------------------------------------------------------- files */

/* (text, null) -> the value of a JSON text, in which `null` stands for null | nil, message */
int cs_json_text_read(lua_State *L);
/* (path) -> the names of the files of a folder | nil, message */
int cs_folders_names(lua_State *L);
/* (folder, name) -> path | nil: the file does not exist, or is outside the folder */
int cs_folders_within(lua_State *L);
/* (pattern [, list]) -> the numbers of the existing files of a pattern such as walk.####.png, or of
 * the files in a list that fit the pattern | nil, message */
int cs_folders_frames(lua_State *L);
/* (pattern, number) -> the name of a file | nil, message */
int cs_folders_frame_name(lua_State *L);

/* ---------------------------------------------------------------- sounds */

/* A function that a host may provide to decode sounds: (path, tried | nil) -> seconds, sums | nil,
 * message. sums: 8-byte floats, as plugins/sound/loudness.h describes them. Scripts of a state
 * without one cannot read sounds. */
#define CS_NATIVE_HEAR "celspan.hear" /* the name of the function in the registry */
/* Another one: (path, tried | nil) -> levels | nil, message. levels: a byte for each band of each
 * step, as plugins/sound/spectrum.h describes them. */
#define CS_NATIVE_SPECTRUM "celspan.spectrum"

/* ---------------------------------------------------------------- movies */

/* A function that a host may provide to open movies: (path, tried | nil) -> facts | nil, message.
 * facts: as program/film/movies.c puts them, with `picture`, a function. */
#define CS_NATIVE_MOVIE "celspan.movie" /* the name of the function in the registry */
/* Another one: (path) -> whether the file has the first bytes of a movie. */
#define CS_NATIVE_IS_MOVIE "celspan.is_movie"

/* ---------------------------------------------------------------- layered documents */

/* (path) -> { width =, height =, layers = {...}, notes = {...} } | nil, message
 *
 *   layers[i]: name, blend, parent (its place, or nil), group, visible, opacity, x, y, width,
 *              height, and pixels: a value that celspan.image accepts as `pixels`
 *   notes[i]:  layer (its place), what */
int cs_painting_read(lua_State *L);
/* (path, name, most) -> the bytes of a member of a zip archive, at most that many | nil, message */
int cs_archive_member(lua_State *L);
/* (path, name) -> the bytes that a member says to have | nil, message */
int cs_archive_size(lua_State *L);
/* (text) -> whether it is an address that contains a file, data:... */
int cs_addresses_is_data(lua_State *L);
/* (bytes) -> an address that contains them */
int cs_addresses_make(lua_State *L);

/* ---------------------------------------------------------------- SVG */

/* Adds read_svg and parse_svg to the table on top of the stack, for lua/celspan/read/svg.lua. */
void cs_drawing_open(lua_State *L);

/* ---------------------------------------------------------------- planes */

#define CS_NATIVE_PLANE "celspan.plane" /* the name of its metatable */
/* (plane) -> what can be seen of it, as outlines (parcels.c) | nil, why not */
int cs_parcels_list(lua_State *L);
/* celspan.plane(film or rostrum [, options]) -> plane | nil, message */
int cs_plane_make(lua_State *L);
/* celspan.plane_read(path) -> plane | nil, message */
int cs_plane_open_file(lua_State *L);

/* ---------------------------------------------------------------- tracing */

/* (path, { colours = n | { "#rrggbb", ... }, smooth =, speckle =, lines = })
 *   -> { width =, height =, shapes = {...} } | nil, message
 *
 *   shapes[i]: colour ("#rrggbb"), x, y, area, and d, or points ({ x, y, width }) and closed */
int cs_tracing_make(lua_State *L);
/* (path, options as for cs_tracing_make, output) -> true | nil, message. Writes SVG, or a script
 * where the name of the output ends in .lua. */
int cs_tracing_write(lua_State *L);

/* ---------------------------------------------------------------- scans */

/* (file) -> a scanned page, its width and height, the dpi that the file says, or 0 | nil,
 * message */
int cs_scanning_open(lua_State *L);
/* (page): frees its memory, of which Lua's collector sees nothing */
int cs_scanning_close(lua_State *L);
/* (page, dpi, {{x, y, width, height}, ...}) -> how many holes were found, and if all: their scale,
 * turn in radians, x and y of their origin in pixels, the greatest error in millimetres */
int cs_scanning_pegs(lua_State *L);
/* (page) -> turn, x and y of the paper's middle, the greatest error in radians | nil */
int cs_scanning_corners(lua_State *L);
/* (page, another) -> x, y by which the lines of the page must move onto the other's, likeness */
int cs_scanning_shift(lua_State *L);
/* (page, {turn, x, y, to_x, to_y, width, height}, colours, dust [, black, white]) -> pixels for
 * each colour, as celspan.image accepts them, black, white, how many pixels have ink | nil,
 * message */
int cs_scanning_lines(lua_State *L);

/* ---------------------------------------------------------------- areas between lines */

/* (RGBA whose alpha is the coverage, width, height, gap in pixels) -> areas, the share of the lines
 * that is thin | nil, message */
int cs_ink_areas_make(lua_State *L);
/* (areas): frees their memory, of which Lua's collector sees nothing */
int cs_ink_areas_release(lua_State *L);
/* (areas, x, y) -> the label of the nearest area, 0 for the outside; whether a line is there */
int cs_ink_areas_at(lua_State *L);
/* (areas, x, y [, x, y]) -> x, y, width of the narrowest place on the widest way to the other
 * point, or to the rim | nil, message */
int cs_ink_areas_way(lua_State *L);
/* (areas) -> { [label] = { size, sums of x, y, x * x, x * y, y * y over the pixels, x, y of a point
 * inside; borders = { [label] = sides of pixels } } } */
int cs_ink_areas_measures(lua_State *L);
/* (areas, labels, whether with their halves of the lines) -> RGBA in which areas that touch differ,
 * { [label] = "#rrggbb" }, x, y, width, height */
int cs_ink_areas_picture(lua_State *L);

/* ---------------------------------------------------------------- tracking */

/* (bytes, width, height, model, {x, y, w, h} [, mask]) -> tracker | nil, message. bytes: RGBA in
 * 16-bit codes; mask: the same; its alpha covers the region; model: from 0. */
int cs_track_tracker(lua_State *L);
/* (tracker, bytes, width, height) -> {matrix}, corners, agreeing, error | nil, message; nil alone:
 * lost */
int cs_track_follow(lua_State *L);
/* (tracker): moves back to the first frame */
int cs_track_rewind(lua_State *L);
/* (matrix) -> the inverse of nine numbers | nil */
int cs_track_inverse(lua_State *L);

/* ---------------------------------------------------------------- recolouring */

/* ({ r, g, b, r, ... }, { r, g, b, ... } of the new colours, is_linear, is_strict) -> recolouring;
 * the numbers are light */
int cs_recolour_make(lua_State *L);
/* (recolouring, object or texture) -> the value in the new colours; nil for another value */
int cs_recolour_value(lua_State *L);
/* (recolouring, rostrum): forgets the strange colours that it met before, and looks for those of a
 * frame; pictures that have mostly such colours do not count */
int cs_recolour_see(lua_State *L);
/* (recolouring) -> the colours that it met and did not know: { { colour = "#rrggbb", count =,
 * place = " 'hat' (shot.lua:4)" or "", and of a pixel x, y }, ... } */
int cs_recolour_strange(lua_State *L);

/* ---------------------------------------------------------------- relighting */

/* A light field in Lua is {r, g, b}, and if it is uneven `terms`, three lists of nine numbers. */

/* (texture) -> its width and height in pixels */
int cs_relight_size(lua_State *L);
/* (texture, clue, {r, g, b}, {x, y, w, h} | nil, is_uneven, blank | nil) -> field */
int cs_relight_estimate(lua_State *L);
/* (texture, field) -> texture */
int cs_relight_picture(lua_State *L);
/* (front, field, back, field) -> texture */
int cs_relight_exposures(lua_State *L);
/* (picture, ground, picture, ground, field) -> texture; a ground is a texture or {r, g, b} */
int cs_relight_grounds(lua_State *L);
/* (field, width, height) -> texture */
int cs_relight_shape(lua_State *L);
/* (texture, path) -> true */
int cs_relight_write(lua_State *L);
/* (path) -> texture; the file is searched for in the same places as pictures */
int cs_relight_read(lua_State *L);

/* ---------------------------------------------------------------- frames by their lights */

/* The lights of a stack are a list with eight numbers for each light: r, g, b, a of its front and
 * of its back. The first light belongs to the rostrum itself. */

/* (rostrum or film, options) -> stack, { cels = {{ name =, has_front = }, ...}, brightness =,
 * width =, height =, bytes = } */
int cs_stack_make(lua_State *L);
/* (stack) -> the lights of the rostrum */
int cs_stack_lights(lua_State *L);
/* (stack, lights) -> image */
int cs_stack_light(lua_State *L);

/* ---------------------------------------------------------------- comparing */

/* (first, second, width, tolerance): two strings of RGBA codes, 8 bits, sRGB, straight alpha, rows
 * of `width` pixels -> count, largest, x, y, channel, picture
 *
 * count: the pixels in which a code differs by more than the tolerance, 0..1; largest: the largest
 * difference, at x, y; picture: the codes of common/difference.h. For equal strings only 0 is
 * returned. The colour under an alpha of 0 does not count. */
int cs_difference_of(lua_State *L);

/* ---------------------------------------------------------------- parts of frames */

/* (rostrum or {{rostrum, weight}, ...}) -> { { kind =, name =, drawing =, placement =,
 * procedure = }, ... }: every named cel and object as often as it occurs, rearmost first, and the
 * cels without a name, which are named by their places. drawing, placement: hashes, as strings of
 * 16 bytes; procedure: true if they cannot be compared. */
int cs_parts_list(lua_State *L);
