/* All nouns, and the functions that the files of this folder share.
 *
 * INVARIANT: every noun that scripts make values of, and every table that scripts fill in, is in
 * one of the two lists. So all of them are in the annotations and in `celspan help lua`.
 */
#pragma once

#include "inside/scene.h"
#include "lua/bind/userdata.h"

extern const cs_noun cs_noun_gradient, cs_noun_linear, cs_noun_radial, cs_noun_conic, cs_noun_noise,
    cs_noun_picture, cs_noun_pattern, cs_noun_rect, cs_noun_triangle, cs_noun_circle,
    cs_noun_ellipse, cs_noun_polygon, cs_noun_nurbs, cs_noun_path, cs_noun_image, cs_noun_stroke,
    cs_noun_stroke_style, cs_noun_text, cs_noun_glyph, cs_noun_scanline, cs_noun_union,
    cs_noun_intersection, cs_noun_difference, cs_noun_xor, cs_noun_group, cs_noun_key,
    cs_noun_matte, cs_noun_blur, cs_noun_displace, cs_noun_sharpen, cs_noun_shadow, cs_noun_glow,
    cs_noun_outline, cs_noun_light, cs_noun_defocus, cs_noun_grain, cs_noun_grade, cs_noun_cel,
    cs_noun_camera, cs_noun_frame, cs_noun_sound;

/* The first list has the nouns with a constructor, such as celspan.circle. The other has tables: of
 * values without a constructor, of options, and in fields of other nouns. Both are ended by
 * NULL. */
extern const cs_noun *const cs_nouns_made[], *const cs_nouns_tables[];
/* Pushes all nouns by name, with the rows of their fields, for the Lua module celspan.manual. */
int cs_nouns_push(lua_State *L);

/* The methods of cels and rostrums; the methods of objects. */
extern const luaL_Reg cs_placed_methods[], cs_placed_object_methods[];
extern const luaL_Reg cs_boolean_operators[];

/* primitive:stroke{ ... }: celspan.stroke{ outline = primitive, ... } with the transform and fade
 * of the primitive. */
int cs_stroke_method(lua_State *L);

/* text:metrics(): a table of measures. */
int cs_text_metrics(lua_State *L);

/* object:paint(texture): the object's shape filled with the texture, with the fade and the name of
 * the object. */
int cs_derived_paint(lua_State *L);
/* The function behind object:warp{...}: (object, function of x and y, tolerance, most pieces) ->
 * object. A tolerance or a number of 0 is the default. */
int cs_derived_warp(lua_State *L);
/* (object, seed across, seed down, step, amount, grain, within, pieces) */
int cs_derived_boil(lua_State *L);
int cs_operators_trim(lua_State *L);
int cs_operators_round_corners(lua_State *L);
int cs_operators_zigzag(lua_State *L);
int cs_operators_pucker(lua_State *L);
int cs_operators_offset(lua_State *L);
int cs_operators_twist(lua_State *L);

/* The functions behind celspan.morph (anatomy.c): (object, whether strokes are shapes) -> its tree
 * as tables; (object, { operands }) -> a boolean like it; (texture, { 9 numbers }) -> the texture,
 * moved. */
int cs_anatomy_of(lua_State *L);
int cs_anatomy_rebuild(lua_State *L);
int cs_anatomy_move(lua_State *L);
/* Puts the fields `rule` and `contours` of an outline or of what a stroke covers, in its own units,
 * into the table on top of the stack. within: how far cubics may lie from curves, as a share of the
 * diagonal of the bounds. Errors: NO_MEMORY; LIMIT for too many curves, without `contours`. */
CELSPAN_CHECKED celspan_status cs_anatomy_put_filled(lua_State *L, const cs_primitive_data *data,
                                                     double within);
/* The functions behind lines that are measured (ruler.c). */
int cs_ruler_make(lua_State *L);
int cs_ruler_at(lua_State *L);
/* (rostrum, width, height, space, shared) -> the frame's structure as tables (scenery.c). */
int cs_scenery_of(lua_State *L);
int cs_scenery_key(lua_State *L);
int cs_scenery_rear(lua_State *L);

/* object:blur(radius, options), object:displace{ ... } and object:sharpen(options); shadow, glow
 * and outline with options, also of cels. */
int cs_nouns_blur(lua_State *L);
int cs_nouns_displace(lua_State *L);
int cs_nouns_sharpen(lua_State *L);
int cs_nouns_shadow(lua_State *L);
int cs_nouns_glow(lua_State *L);
int cs_nouns_outline(lua_State *L);
extern const char *const cs_nouns_kernels[]; /* kernels of a blur, ended by NULL */
extern const char *const cs_nouns_edges[];
extern const char *const cs_nouns_caps[];  /* caps of a stroke, likewise */
extern const char *const cs_nouns_joins[]; /* and those at its corners */

/* Functions of the module celspan. */
int cs_nouns_rgb(lua_State *L);
int cs_nouns_gel(lua_State *L);
int cs_nouns_mix(lua_State *L);
int cs_nouns_clip(lua_State *L);
int cs_nouns_matte(lua_State *L);
int cs_nouns_glyphs(lua_State *L);
/* native.as_letter(table): the table as a letter, which says where its methods are. */
int cs_nouns_as_letter(lua_State *L);
/* (object) -> a cel with the object or rostrum, with its name and line. */
int cs_nouns_cel_of(lua_State *L);
/* Pushes celspan.clear. */
void cs_nouns_push_clear(lua_State *L);
