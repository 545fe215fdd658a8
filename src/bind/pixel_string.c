/* The bytes of a string are copied and hashed once, however many pictures show them:
 *
 *   surfaces (weak values)      address of the string --> box --> surface of the core
 *                                                          |
 *                                                          +----> the string
 *   holders (weak keys)         value made of it -------> box
 *
 * A box keeps its string, so that no other string can have its address; the values keep the box.
 */
#include "bind/pixel_string.h"

#include "bind/holder.h"
#include "bind/host.h"
#include "bind/userdata.h"

#define SIDE 1048576

typedef struct box {
  celspan_surface *surface; /* a reference; NULL: not made yet */
  celspan_surface_desc desc;
} box;

static const char surfaces_key = 0, holders_key = 0; /* addresses in the registry */
static const char *const formats[] = {"rgba8", "rgb8", "grey8", "rgba16", "rgbaf", NULL};
static const char *const alphas[] = {"straight", "premultiplied", NULL};

static int release(lua_State *L) {
  box *b = lua_touserdata(L, 1);
  celspan_surface_unref(b->surface);
  b->surface = NULL;
  return 0;
}

/* Pushes a table of the registry, which is made on first use. */
static void push_table(lua_State *L, const char *key, const char *mode) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, key) == LUA_TTABLE)
    return;
  lua_pop(L, 1);
  lua_newtable(L);
  lua_createtable(L, 0, 1);
  lua_pushstring(L, mode);
  lua_setfield(L, -2, "__mode");
  lua_setmetatable(L, -2);
  lua_pushvalue(L, -1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, key);
}

/* ---------------------------------------------------------------- reading */

static void read_size(const cs_form *form, celspan_surface_desc *desc) {
  double size[2];
  if (!cs_form_numbers(form, "size", 2, size))
    cs_form_fail(form, "field 'size' must be {width, height} of the pixels, got nil");
  for (int i = 0; i < 2; i++)
    if (!(size[i] >= 1 && size[i] <= SIDE) || size[i] != (int32_t)size[i])
      cs_form_fail(form, "size[%d] must be a whole number from 1 to %d, got %s", i + 1, SIDE,
                   cs_form_digits(form->L, size[i]));
  desc->width = (int32_t)size[0];
  desc->height = (int32_t)size[1];
}

/* Leaves the string on the stack. */
static celspan_surface_desc read(const cs_form *form) {
  lua_State *L = form->L;
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  read_size(form, &desc);
  int format = cs_form_choice(form, "format", formats);
  desc.format = (celspan_surface_format)format;
  if (cs_form_has(form, "alpha"))
    desc.alpha = cs_form_choice(form, "alpha", alphas) == 0 ? CELSPAN_ALPHA_STRAIGHT
                                                            : CELSPAN_ALPHA_PREMULTIPLIED;
  lua_pushliteral(L, "pixels");
  if (lua_rawget(L, form->table) != LUA_TSTRING)
    cs_form_fail(form, "field 'pixels' must be a string, got %s", cs_userdata_type(L, -1));
  uint64_t needed =
      (uint64_t)desc.width * (uint64_t)desc.height * celspan_surface_pixel_size(desc.format);
  if (lua_rawlen(L, -1) != needed)
    cs_form_fail(form, "pixels holds %I bytes, %d x %d %s needs %I", (LUAI_UACINT)lua_rawlen(L, -1),
                 (int)desc.width, (int)desc.height, formats[format], (LUAI_UACINT)needed);
  desc.pixels = lua_tostring(L, -1);
  return desc;
}

/* ---------------------------------------------------------------- one surface for a string */

static bool is_same(const celspan_surface_desc *a, const celspan_surface_desc *b) {
  return a->pixels == b->pixels && a->width == b->width && a->height == b->height &&
         a->format == b->format && a->alpha == b->alpha;
}

static box *push_empty_box(lua_State *L, const celspan_surface_desc *desc) {
  box *b = cs_holder_push(L, "celspan.surface", sizeof *b, release);
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

/* The surface that stands in the field `pixels`, kept by the fields of the value; NULL: a string
 * stands there. */
static celspan_surface *find_surface(const cs_form *form) {
  lua_pushliteral(form->L, "pixels");
  lua_rawget(form->L, form->table);
  const box *b = luaL_testudata(form->L, -1, "celspan.surface");
  lua_pop(form->L, 1);
  return b ? b->surface : NULL;
}

celspan_surface *cs_pixel_string_surface(const cs_form *form, int holder) {
  lua_State *L = form->L;
  celspan_surface *given = find_surface(form);
  if (given)
    return given;
  celspan_surface_desc desc = read(form);
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
  lua_pushstring(L, formats[0]);
  lua_rawset(L, fields);
}
