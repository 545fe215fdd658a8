/* The bytes of a string are copied and hashed once, however many pictures show them:
 *
 *   surfaces (weak values)      address of the string --> box --> surface of the core
 *                                                          |
 *                                                          +----> the string
 *   holders (weak keys)         value made of it -------> box
 *
 * A box keeps its string, so that no other string can have its address; the values keep the box.
 */
#include "lua/nouns/pixel_string.h"

#include "lua/bind/host.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"

typedef struct box {
  celspan_surface *surface; /* a reference; NULL: not made yet */
  celspan_surface_desc desc;
} box;

/* the addresses of these are keys in the registry */
static const char surfaces_key = 0, holders_key = 0;
const char *const cs_pixel_string_formats[] = {"rgba8", "rgb8", "grey8", "rgba16", "rgbaf", NULL};
const char *const cs_pixel_string_alphas[] = {"straight", "premultiplied", NULL};

static int release(lua_State *L) {
  box *b = lua_touserdata(L, 1);
  celspan_surface_unref(b->surface);
  b->surface = NULL;
  return 0;
}

/* Pushes a table of the registry, which is created on first use. */
static void push_table(lua_State *L, const char *key, const char *mode) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, key) == LUA_TTABLE)
    return;
  lua_pop(L, 1);
  lua_newtable(L);
  lua_createtable(L, 0, 1);
  cs_put_text(L, "__mode", mode);
  lua_setmetatable(L, -2);
  lua_pushvalue(L, -1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, key);
}

/* ---------------------------------------------------------------- reading */

/* Reads the fields; leaves the string on the stack. */
static celspan_surface_desc read(const cs_form *form, const cs_pixel_string *given) {
  lua_State *L = form->L;
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  if (!given->has_size)
    cs_form_fail(form, "field 'size' must be {width, height} of the pixels, got nil");
  desc.width = given->size[0];
  desc.height = given->size[1];
  desc.format = (celspan_surface_format)given->format;
  if (given->has_alpha)
    desc.alpha = given->alpha == 0 ? CELSPAN_ALPHA_STRAIGHT : CELSPAN_ALPHA_PREMULTIPLIED;
  if (cs_form_get(form, "pixels") != LUA_TSTRING)
    cs_form_fail(form, "field 'pixels' must be a string, got %s", cs_userdata_type(L, -1));
  uint64_t needed =
      (uint64_t)desc.width * (uint64_t)desc.height * celspan_surface_pixel_size(desc.format);
  if (lua_rawlen(L, -1) != needed)
    cs_form_fail(form, "pixels holds %I bytes, %d x %d %s needs %I", (LUAI_UACINT)lua_rawlen(L, -1),
                 (int)desc.width, (int)desc.height, cs_pixel_string_formats[given->format],
                 (LUAI_UACINT)needed);
  desc.pixels = lua_tostring(L, -1);
  return desc;
}

/* ---------------------------------------------------------------- one surface for a string */

static bool is_same(const celspan_surface_desc *a, const celspan_surface_desc *b) {
  return a->pixels == b->pixels && a->width == b->width && a->height == b->height &&
         a->format == b->format && a->alpha == b->alpha;
}

static box *push_empty_box(lua_State *L, const celspan_surface_desc *desc) {
  box *b = cs_userdata_push_holder(L, "celspan.surface", sizeof *b, release);
  b->desc = *desc;
  return b;
}

void cs_pixel_string_push_surface(lua_State *L, celspan_surface *surface) {
  const celspan_surface_desc none = CELSPAN_SURFACE_DESC;
  push_empty_box(L, &none)->surface = celspan_surface_ref(surface);
}

/* Makes and pushes the box of the string at index `string`. */
static box *push_box(const cs_form *form, const celspan_surface_desc *desc, int string) {
  lua_State *L = form->L;
  box *b = push_empty_box(L, desc);
  lua_pushvalue(L, string);
  lua_setiuservalue(L, -2, 1);
  cs_form_try(form, celspan_surface_create(cs_host_context(L), desc, &b->surface));
  return b;
}

/* The surface in the field `pixels`, which the value's fields keep alive; NULL if the field is a
 * string. */
static celspan_surface *find_surface(const cs_form *form) {
  cs_form_get(form, "pixels");
  const box *b = luaL_testudata(form->L, -1, "celspan.surface");
  lua_pop(form->L, 1);
  return b ? b->surface : NULL;
}

celspan_surface *cs_pixel_string_surface(const cs_form *form, const cs_pixel_string *given,
                                         int holder) {
  lua_State *L = form->L;
  celspan_surface *surface = find_surface(form);
  if (surface)
    return surface;
  celspan_surface_desc desc = read(form, given);
  int string = lua_gettop(L);
  push_table(L, &surfaces_key, "v");
  box *b = lua_rawgetp(L, -1, desc.pixels) == LUA_TUSERDATA ? lua_touserdata(L, -1) : NULL;
  if (!b || !is_same(&b->desc, &desc)) {
    lua_pop(L, 1);
    b = push_box(form, &desc, string);
    lua_pushvalue(L, -1);
    lua_rawsetp(L, -3, desc.pixels);
  }
  push_table(L, &holders_key, "k");
  lua_pushvalue(L, holder);
  lua_pushvalue(L, -3);
  lua_rawset(L, -3);
  return b->surface;
}

void cs_pixel_string_complete(lua_State *L, int fields) {
  lua_pushliteral(L, "pixels");
  bool has_pixels = lua_rawget(L, fields) == LUA_TSTRING;
  lua_pushliteral(L, "format");
  bool has_format = lua_rawget(L, fields) != LUA_TNIL;
  lua_pop(L, 2);
  if (!has_pixels || has_format)
    return;
  lua_pushliteral(L, "format");
  lua_pushstring(L, cs_pixel_string_formats[0]);
  lua_rawset(L, fields);
}
