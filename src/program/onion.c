#include "program/onion.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "lua/bind/userdata.h"
#include "model/scene/scene.h"
#include "program/verb_text.h"

enum { PIXEL = 4, CODE_MOST = 255 };

/* Codes by which a channel must differ, so that it shows: less is the noise of soft edges that lie
 * between other pixels. */
#define LEAST 4
#define SAME_SCALE 1e-9

/* ---------------------------------------------------------------- values */

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

/* same(value, value): whether two cels, or two objects, show the same. */
static int same(lua_State *L) {
  lua_pushboolean(L, is_equal(hash_at(L, 1), hash_at(L, 2)));
  return 1;
}

/* Whether one matrix is the other with a shift and a scale. */
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

/* same_art(cel, cel): whether they have the same objects, at most shifted and scaled. */
static int same_art(lua_State *L) {
  const cs_userdata *one = cs_userdata_test(L, 1, &cs_kind_cel);
  const cs_userdata *other = cs_userdata_test(L, 2, &cs_kind_cel);
  lua_pushboolean(L, one && other && has_same_art(one->handle, other->handle));
  return 1;
}

/* ---------------------------------------------------------------- pixels */

static bool differs(const unsigned char *one, const unsigned char *other) {
  int alpha = one[3], alpha_other = other[3];
  bool is_far = abs(alpha - alpha_other) >= LEAST;
  for (int i = 0; i < 3; i++)
    is_far |= abs(one[i] * alpha - other[i] * alpha_other) >= LEAST * CODE_MOST;
  return is_far;
}

/* differing(bytes, others) -> the pixels of the first, clear where they equal the pixels of the
 * others. Both have RGBA of 8 bits, straight alpha, and the same size. */
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

/* ---------------------------------------------------------------- the film */

int cs_onion_film(lua_State *L) {
  static const luaL_Reg functions[] = {
      {"same", same}, {"same_art", same_art}, {"differing", differing}, {NULL, NULL}};
  lua_settop(L, 6);
  luaL_newlib(L, functions);
  lua_insert(L, 1);
  cs_verb_text_load(L, "onion.lua");
  lua_insert(L, 1);
  lua_call(L, 7, 1);
  return 1;
}
