#include "lua/nouns/grain.h"

#include <limits.h>

#include "lua/bind/fields.h"
#include "lua/bind/require.h"
#include "lua/bind/userdata.h"
#include "lua/nouns/nouns.h"

/* The number of the frame, in the registry: a state has one at a time. */
#define FRAME "celspan.grain.frame"

typedef struct grain {
  double amount, size;
  int seed, frame;
} grain;

static const cs_field fields[] = {
    {"amount", CS_NUMBER(grain, amount), .most = 0.3, .preset = "0.05",
     .about = "The standard deviation of codes, which are 0 to 1"},
    {"size", CS_NUMBER(grain, size), CS_ABOVE_0, .preset = "1.5",
     .about = "Of the largest grains, in film units"},
    {"seed", CS_WHOLE(grain, seed), .least = -INT_MAX, .most = INT_MAX, .preset = "0",
     .about = "Another number is another grain"},
    {"frame", CS_WHOLE(grain, frame), .least = -INT_MAX, .most = INT_MAX,
     .about = "Another one has other grain", .fallback = "the one that is being built"},
    {0}};
const cs_noun cs_noun_grain = {.name = "grain",
                               .about = "Grain of a film, a rostrum or a cel.",
                               .table = "celspan.grain",
                               .fields = fields};

void cs_grain_check(const cs_form *form) {
  grain read;
  int type = cs_form_get(form, "grain");
  if (type == LUA_TTABLE) {
    cs_form inner = cs_form_open(form->L, &cs_noun_grain, -1);
    cs_fields_read(&inner, &read);
  } else if (type != LUA_TNIL) {
    cs_form_fail(form, "field 'grain' must be {amount =, size =, seed =, frame =}, got %s",
                 cs_userdata_type(form->L, -1));
  }
  lua_pop(form->L, 1);
}

/* Pushes the grain of a form, the function of the module, and as its arguments the grain and the
 * number of the frame; false: the form has no grain, and nothing is pushed. */
static bool push_call(const cs_form *form, const char *function) {
  lua_State *L = form->L;
  cs_grain_check(form);
  if (cs_form_get(form, "grain") == LUA_TNIL) {
    lua_pop(L, 1);
    return false;
  }
  cs_require_module(L, "celspan.grain");
  lua_getfield(L, -1, function);
  lua_remove(L, -2);
  lua_pushvalue(L, -2);
  lua_getfield(L, LUA_REGISTRYINDEX, FRAME);
  return true;
}

bool cs_grain_push_object(const cs_form *form) {
  lua_State *L = form->L;
  int given = lua_gettop(L) + 1, count = cs_form_length(form);
  if (!push_call(form, "of_objects"))
    return false;
  lua_createtable(L, count, 0);
  for (int i = 1; i <= count; i++) {
    lua_rawgeti(L, form->table, i);
    lua_rawseti(L, -2, i);
  }
  lua_call(L, 3, 1);
  lua_replace(L, given);
  return true;
}

celspan_texture *cs_grain_push_texture(const cs_form *form) {
  lua_State *L = form->L;
  if (!push_call(form, "texture"))
    return NULL;
  lua_call(L, 2, 1);
  return ((const cs_userdata *)lua_touserdata(L, -1))->handle;
}

int64_t cs_grain_begin(lua_State *L, int64_t number) {
  lua_getfield(L, LUA_REGISTRYINDEX, FRAME);
  int64_t before = lua_tointeger(L, -1);
  lua_pop(L, 1);
  lua_pushinteger(L, number);
  lua_setfield(L, LUA_REGISTRYINDEX, FRAME);
  return before;
}
