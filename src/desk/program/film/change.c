#include "program/film/change.h"

#include <lauxlib.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "inside/context.h"
#include "inside/scene.h"
#include "lua/bind/host.h"
#include "lua/bind/lua_error.h"
#include "lua/bind/userdata.h"
#include "program/report/verb_text.h"

#define SAME_WEIGHT 1e-6

cs_frame_change cs_change_read(const cs_request *request) {
  cs_frame_change change = {.cel = cs_request_text(request, "--cel")};
  change.has_background = cs_request_read(request, "--background", change.background);
  return change;
}

/* ---------------------------------------------------------------- the frame */

static bool is_wanted(const celspan_cel *cel, const char *name) {
  return !name || strcmp(cs_mark_name(cel->mark), name) == 0;
}

/* A light in front of the background. */
static celspan_light over(celspan_light light, celspan_light ground) {
  float through = 1 - light.a;
  return (celspan_light){light.r + through * ground.r, light.g + through * ground.g,
                         light.b + through * ground.b, 1};
}

/* The back light of the rostrum, unless it has a shape, in front of the background; also of films
 * that mix codes. */
static cs_light back_of(const cs_frame_change *change, const celspan_rostrum *rostrum) {
  const float *ground = change->background;
  const celspan_light light = {ground[0], ground[1], ground[2], 1};
  cs_light own = {0};
  if (!change->cel)
    own = (cs_light){.flat = rostrum->back.flat, .coded = rostrum->back.coded};
  if (!change->has_background)
    return own;
  own.flat = over(own.flat, light);
  own.coded = over(own.coded, cs_space_light(CELSPAN_SPACE_SRGB, light));
  return own;
}

/* A back light with a shape, as the back light of an empty cel. */
static celspan_status make_lamp(celspan_context *context, const cs_light *light,
                                celspan_cel **out) {
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.back_texture = (celspan_light_texture){
      .texture = light->texture, .gain = light->gain, .on = light->on, .matte = light->matte};
  return celspan_cel_create(context, &desc, out);
}

static celspan_status change_into(celspan_context *context, const cs_frame_change *change,
                                  const celspan_rostrum *from, celspan_cel **cels,
                                  celspan_rostrum **out) {
  size_t count = 0;
  celspan_cel *lamp = NULL;
  if (from->back.texture && !change->cel) {
    CS_TRY(make_lamp(context, &from->back, &lamp));
    cels[count++] = lamp;
  }
  for (size_t i = 0; i < from->cel_count; i++)
    if (is_wanted(from->cels[i], change->cel))
      cels[count++] = from->cels[i];
  celspan_status status = cs_rostrum_change(context, from, cels, count, back_of(change, from), out);
  celspan_cel_unref(lamp);
  return status;
}

static celspan_status change_one(celspan_context *context, const cs_frame_change *change,
                                 celspan_exposure *exposure) {
  celspan_rostrum *from = exposure->rostrum, *changed;
  size_t most = from->cel_count + 1;
  celspan_cel **cels;
  CS_TRY(CS_MAKE(context, cels, most));
  celspan_status status = change_into(context, change, from, cels, &changed);
  cs_mem_free(context->memory, cels, most * sizeof *cels);
  CS_TRY(status);
  celspan_rostrum_unref(from);
  exposure->rostrum = changed;
  return CELSPAN_OK;
}

/* Adds an exposure of the background alone, of this weight. */
static celspan_status add_ground(celspan_context *context, const cs_frame_change *change,
                                 double weight, cs_film_frame *frame) {
  const float *ground = change->background;
  size_t count = frame->count + 1;
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  celspan_exposure *exposures;
  celspan_rostrum *rostrum;
  cs_film_frame changed;
  desc.back = (celspan_light){ground[0], ground[1], ground[2], 1};
  CS_TRY(celspan_rostrum_create(context, &desc, &rostrum));
  celspan_status status = CS_MAKE(context, exposures, count);
  if (status == CELSPAN_OK) {
    for (size_t i = 0; i < frame->count; i++)
      exposures[i] = frame->exposures[i];
    exposures[frame->count] = (celspan_exposure){rostrum, weight};
    status = cs_film_frame_init(&changed, context, exposures, count);
    cs_mem_free(context->memory, exposures, count * sizeof *exposures);
  }
  celspan_rostrum_unref(rostrum);
  CS_TRY(status);
  changed.repeats = frame->repeats;
  cs_film_frame_finish(frame);
  *frame = changed;
  return CELSPAN_OK;
}

/* The background is light behind each exposure, so the weights must add up to one. */
static celspan_status fill_ground(celspan_context *context, const cs_frame_change *change,
                                  cs_film_frame *frame) {
  double total = 0;
  for (size_t i = 0; i < frame->count; i++)
    total += frame->exposures[i].weight;
  if (total > 1 + SAME_WEIGHT)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "--background: the weights of the frame's exposures add up to %g; a background "
                   "can lie behind 1 at most",
                   total);
  return total < 1 - SAME_WEIGHT ? add_ground(context, change, 1 - total, frame) : CELSPAN_OK;
}

celspan_status cs_change_frame(celspan_context *context, const cs_frame_change *change,
                               cs_film_frame *frame) {
  if (!change->cel && !change->has_background)
    return CELSPAN_OK;
  for (size_t i = 0; i < frame->count; i++)
    CS_TRY(change_one(context, change, &frame->exposures[i]));
  return change->has_background ? fill_ground(context, change, frame) : CELSPAN_OK;
}

enum { PIXEL = 4, CODE_MOST = 255 };

/* The difference in codes from which on a channel counts as different: smaller differences are the
 * noise of soft edges that lie between other pixels. */
#define LEAST 4
#define SAME_SCALE 1e-9

/* ---------------------------------------------------------------- onion skin: values */

/* The hash of a cel or an object; NULL: the value at index is neither. */
static const cs_hash *hash_at(lua_State *L, int index) {
  const cs_userdata *cel = cs_userdata_test(L, index, &cs_kind_cel);
  if (cel)
    return &((const celspan_cel *)cel->handle)->hash;
  const cs_userdata *object = cs_userdata_test(L, index, &cs_kind_object);
  return object ? &((const celspan_object *)object->handle)->hash : NULL;
}

static bool is_equal(const cs_hash *one, const cs_hash *other) {
  return one && other && one->a == other->a && one->b == other->b;
}

/* same(value, value): whether two cels, or two objects, look the same. */
static int same(lua_State *L) {
  lua_pushboolean(L, is_equal(hash_at(L, 1), hash_at(L, 2)));
  return 1;
}

/* Whether the matrices differ only by a shift and a scale. */
static bool is_shifted(const celspan_matrix *one, const celspan_matrix *other) {
  static const int linear[] = {0, 1, 3, 4};
  const double *a = one->m, *b = other->m;
  double scale =
      hypot(hypot(b[0], b[1]), hypot(b[3], b[4])) / hypot(hypot(a[0], a[1]), hypot(a[3], a[4]));
  bool is_it = a[6] == b[6] && a[7] == b[7];
  for (int i = 0; i < 4; i++)
    is_it &= fabs(b[linear[i]] - scale * a[linear[i]]) <= SAME_SCALE * scale;
  return is_it;
}

static bool has_same_art(const celspan_cel *one, const celspan_cel *other) {
  if (one->object_count != other->object_count || !is_shifted(&one->matrix, &other->matrix))
    return false;
  for (size_t i = 0; i < one->object_count; i++)
    if (!is_equal(&one->objects[i]->hash, &other->objects[i]->hash))
      return false;
  return true;
}

/* same_art(cel, cel): whether they have the same objects, except for a shift and a scale. */
static int same_art(lua_State *L) {
  const cs_userdata *one = cs_userdata_test(L, 1, &cs_kind_cel);
  const cs_userdata *other = cs_userdata_test(L, 2, &cs_kind_cel);
  lua_pushboolean(L, one && other && has_same_art(one->handle, other->handle));
  return 1;
}

/* ---------------------------------------------------------------- onion skin: pixels */

static bool differs(const unsigned char *one, const unsigned char *other) {
  int alpha = one[3], alpha_other = other[3];
  bool is_far = abs(alpha - alpha_other) >= LEAST;
  for (int i = 0; i < 3; i++)
    is_far |= abs(one[i] * alpha - other[i] * alpha_other) >= LEAST * CODE_MOST;
  return is_far;
}

/* differing(bytes, others) -> the pixels of the first picture, clear where they equal those of the
 * second. Both have RGBA of 8 bits, straight alpha, and the same size. */
static int differing(lua_State *L) {
  size_t size, size_other;
  const unsigned char *one = (const unsigned char *)luaL_checklstring(L, 1, &size);
  const unsigned char *other = (const unsigned char *)luaL_checklstring(L, 2, &size_other);
  luaL_Buffer buffer;
  luaL_argcheck(L, size == size_other && size % PIXEL == 0, 2, "another size");
  char *out = luaL_buffinitsize(L, &buffer, size);
  for (size_t at = 0; at < size; at += PIXEL) {
    bool is_kept = differs(one + at, other + at);
    for (size_t i = at; i < at + PIXEL; i++)
      out[i] = is_kept ? (char)one[i] : 0;
  }
  luaL_pushresultsize(&buffer, size);
  return 1;
}

/* ---------------------------------------------------------------- onion skin: the film */

/* film, light userdata: a cs_onion -> film. Runs protected. */
static int lay(lua_State *L) {
  static const luaL_Reg functions[] = {
      {"same", same}, {"same_art", same_art}, {"differing", differing}, {NULL, NULL}};
  const cs_onion *o = lua_touserdata(L, 2);
  cs_built_in_load(L, cs_verb_texts, "", "onion.lua");
  luaL_newlib(L, functions);
  lua_pushvalue(L, 1);
  lua_pushinteger(L, o->counts[0]);
  lua_pushinteger(L, o->counts[1]);
  lua_pushinteger(L, o->width);
  lua_pushinteger(L, o->height);
  lua_pushstring(L, o->cel);
  lua_pushstring(L, o->labels);
  lua_call(L, 8, 1);
  return 1;
}

static cs_exit lay_onion(cs_script *script, const cs_onion *onion) {
  lua_State *L = script->L;
  lua_pushcfunction(L, lay);
  lua_pushvalue(L, CS_SCRIPT_FILM);
  lua_pushlightuserdata(L, (void *)(uintptr_t)onion);
  cs_host_begin(L, CS_HOST_VERB, 0);
  int outcome = lua_pcall(L, 2, 1, 0);
  cs_host_end(L);
  if (outcome != LUA_OK)
    return cs_report_failure(script->context, cs_lua_error_report(L, outcome), NULL);
  lua_replace(L, CS_SCRIPT_FILM);
  return CS_EXIT_OK;
}

cs_exit cs_change_lay_onion(cs_script *script, const cs_request *request,
                            const celspan_frame_desc *frame) {
  cs_onion onion = {
      .width = frame->width, .height = frame->height, .cel = cs_request_text(request, "--cel")};
  if (!cs_request_read(request, "--onion", onion.counts))
    return CS_EXIT_OK;
  return lay_onion(script, &onion);
}

celspan_status cs_change_try_onion(cs_script *script, const cs_onion *onion, int64_t number) {
  lua_State *L = script->L;
  lua_pushvalue(L, CS_SCRIPT_FILM);
  celspan_status status =
      lay_onion(script, onion) == CS_EXIT_OK ? cs_script_try(script, number) : CELSPAN_CALLBACK;
  lua_replace(L, CS_SCRIPT_FILM);
  return status;
}
