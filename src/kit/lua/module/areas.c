/* The areas between lines, for celspan.ink. */
#include <lauxlib.h>
#include <stdio.h>

#include "inside/colour.h"
#include "lua/bind/host.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"
#include "tools/areas/areas.h"

#define AREAS "celspan.areas"

CS_HOLDER_RELEASE(release, cs_ink_areas, cs_ink_areas_destroy)

static const cs_ink_areas *areas_at(lua_State *L) {
  cs_ink_areas **holder = luaL_checkudata(L, 1, AREAS);
  luaL_argcheck(L, *holder, 1, "is closed");
  return *holder;
}

/* The place of the pixel of arguments `index` and the next one; beyond the picture, of its corner,
 * which is outside, too. */
static uint32_t place_at(lua_State *L, const cs_ink_areas *areas, int index) {
  const double x = luaL_checknumber(L, index), y = luaL_checknumber(L, index + 1);
  if (!(x >= 0 && y >= 0 && x < areas->width && y < areas->height))
    return 0;
  return (uint32_t)y * (uint32_t)areas->width + (uint32_t)x;
}

int cs_ink_areas_make(lua_State *L) {
  size_t size;
  const char *pixels = luaL_checklstring(L, 1, &size);
  const lua_Integer width = luaL_checkinteger(L, 2), height = luaL_checkinteger(L, 3);
  const double gap = luaL_checknumber(L, 4);
  luaL_argcheck(L, width > 0 && width <= CS_AREAS_SIDE, 2, "is no width of a drawing");
  luaL_argcheck(L, height > 0 && height <= CS_AREAS_SIDE, 3, "is no height of a drawing");
  luaL_argcheck(L, size == (size_t)(4 * width * height), 1, "has another size");
  unsigned char *coverage = lua_newuserdatauv(L, (size_t)(width * height), 0);
  for (size_t i = 0; i < size / 4; i++)
    coverage[i] = (unsigned char)pixels[4 * i + 3];
  cs_ink_areas **holder = cs_userdata_push_holder(L, AREAS, sizeof *holder, release);
  CS_HOST_TRY(L, cs_ink_areas_create(cs_host_context(L), coverage, (int32_t)width, (int32_t)height,
                                     gap, holder));
  lua_pushnumber(L, (*holder)->thin);
  return 2;
}

int cs_ink_areas_release(lua_State *L) {
  areas_at(L);
  return release(L);
}

int cs_ink_areas_at(lua_State *L) {
  const cs_ink_areas *areas = areas_at(L);
  const uint32_t place = place_at(L, areas, 2);
  lua_pushinteger(L, areas->labels[place]);
  lua_pushboolean(L, areas->walls[place] == CS_WALL_INK);
  return 2;
}

int cs_ink_areas_way(lua_State *L) {
  const cs_ink_areas *areas = areas_at(L);
  const uint32_t from = place_at(L, areas, 2);
  const uint32_t to = lua_isnoneornil(L, 4) ? from : place_at(L, areas, 4);
  cs_ink_leak leak = {0};
  CS_HOST_TRY(L, cs_ink_areas_leak(areas, from, to, &leak));
  lua_pushnumber(L, leak.x + 0.5);
  lua_pushnumber(L, leak.y + 0.5);
  lua_pushnumber(L, leak.width);
  return 3;
}

/* ---------------------------------------------------------------- what areas are like */

/* Counts a side between two pixels for the first of their areas, in the list at the top. */
static void add_border(lua_State *L, uint32_t one, uint32_t other) {
  lua_rawgeti(L, -1, one);
  lua_getfield(L, -1, "borders");
  lua_rawgeti(L, -1, other);
  const lua_Integer before = lua_tointeger(L, -1);
  lua_pushinteger(L, before + 1);
  lua_rawseti(L, -3, other);
  lua_pop(L, 3);
}

static void add_borders(lua_State *L, const cs_ink_areas *areas) {
  const size_t width = (size_t)areas->width, size = cs_ink_areas_size(areas);
  for (size_t i = 0; i < size; i++) {
    const size_t others[] = {(i + 1) % width ? i + 1 : i, i + width < size ? i + width : i};
    for (int side = 0; side < 2; side++) {
      const uint32_t one = areas->labels[i], other = areas->labels[others[side]];
      if (one != other) {
        add_border(L, one, other);
        add_border(L, other, one);
      }
    }
  }
}

int cs_ink_areas_measures(lua_State *L) {
  const cs_ink_areas *areas = areas_at(L);
  double(*numbers)[CS_AREA_NUMBERS] = lua_newuserdatauv(L, areas->count * sizeof *numbers, 0);
  cs_ink_areas_measure(areas, numbers);
  lua_newtable(L);
  for (size_t i = 0; i < areas->count; i++) {
    if (numbers[i][0] == 0)
      continue;
    lua_newtable(L);
    for (int k = 0; k < CS_AREA_NUMBERS; k++) {
      lua_pushnumber(L, numbers[i][k]);
      lua_rawseti(L, -2, k + 1);
    }
    lua_newtable(L);
    lua_setfield(L, -2, "borders");
    lua_rawseti(L, -2, (lua_Integer)i);
  }
  add_borders(L, areas);
  return 1;
}

/* ---------------------------------------------------------------- pictures of areas */

/* Colours of the picture of areas. None is a mixture of others, for which the tracer would take it:
 * in linear light they lie on a paraboloid, blue above red and green. */
#define COLOURS 16
#define FAR 3     /* pixels: areas that are as near to each other have different colours */
#define PLAIN 255 /* the area is not in the picture */

typedef struct picture {
  const cs_ink_areas *areas;
  unsigned char *colours; /* by label */
  cs_area_box box;        /* in pixels of the areas */
  bool under;
} picture;

/* Which colours the neighbours of a pixel have, as bits. */
static unsigned colours_about(const picture *p, int32_t x, int32_t y) {
  const cs_ink_areas *a = p->areas;
  unsigned bits = 0;
  for (int32_t v = y > FAR ? y - FAR : 0; v <= y + FAR && v < a->height; v++)
    for (int32_t u = x > FAR ? x - FAR : 0; u <= x + FAR && u < a->width; u++) {
      const unsigned char colour = p->colours[a->labels[(size_t)v * (size_t)a->width + (size_t)u]];
      bits |= colour < COLOURS ? 1u << colour : 0;
    }
  return bits;
}

/* Gives an area the first colour that no area beside it has; false: there is none. */
static bool choose(picture *p, uint32_t label) {
  const cs_area_box *box = &p->areas->boxes[label];
  const size_t width = (size_t)p->areas->width;
  unsigned taken = 0;
  for (int32_t y = box->y0; y < box->y1; y++)
    for (int32_t x = box->x0; x < box->x1; x++)
      if (p->areas->labels[(size_t)y * width + (size_t)x] == label)
        taken |= colours_about(p, x, y);
  unsigned char colour = 0;
  while (colour < COLOURS && taken >> colour & 1)
    colour++;
  p->colours[label] = colour;
  return colour < COLOURS;
}

/* Takes the box of an area and a rim of one pixel in. */
static void widen(picture *p, const cs_area_box *box) {
  cs_area_box *all = &p->box;
  all->x0 = box->x0 <= all->x0 && box->x0 > 0 ? box->x0 - 1 : all->x0;
  all->y0 = box->y0 <= all->y0 && box->y0 > 0 ? box->y0 - 1 : all->y0;
  all->x1 = box->x1 >= all->x1 && box->x1 < p->areas->width ? box->x1 + 1 : all->x1;
  all->y1 = box->y1 >= all->y1 && box->y1 < p->areas->height ? box->y1 + 1 : all->y1;
}

/* Reads the labels of argument 2. */
static void read_labels(lua_State *L, picture *p) {
  const cs_ink_areas *a = p->areas;
  p->box = (cs_area_box){a->width, a->height, 0, 0};
  p->colours = lua_newuserdatauv(L, a->count, 0);
  for (size_t i = 0; i < a->count; i++)
    p->colours[i] = PLAIN;
  luaL_checktype(L, 2, LUA_TTABLE);
  const lua_Integer count = (lua_Integer)lua_rawlen(L, 2);
  for (lua_Integer i = 1; i <= count; i++) {
    lua_rawgeti(L, 2, i);
    const lua_Integer label = lua_tointeger(L, -1);
    lua_pop(L, 1);
    luaL_argcheck(L, label > 0 && (size_t)label < a->count, 2, "has a number of no area");
    luaL_argcheck(L, choose(p, (uint32_t)label), 2, "has an area beside those of 16 colours");
    widen(p, &a->boxes[label]);
  }
}

static void put_code(unsigned char colour, unsigned char code[3]) {
  const int red = colour & 3, green = colour >> 2;
  code[0] = cs_transfer_srgb8((float)red / 3);
  code[1] = cs_transfer_srgb8((float)green / 3);
  code[2] = cs_transfer_srgb8((float)(red * red + green * green) / 18);
}

static void put_pixel(const picture *p, size_t place, unsigned char pixel[4]) {
  const unsigned char colour = p->colours[p->areas->labels[place]];
  put_code(colour < COLOURS ? colour : 0, pixel);
  pixel[3] = colour == PLAIN ? 0
             : p->under      ? 255
                             : (unsigned char)(255 - p->areas->coverage[place]);
}

static void push_pixels(lua_State *L, const picture *p) {
  luaL_Buffer buffer;
  const cs_area_box *box = &p->box;
  const size_t size = 4 * (size_t)(box->x1 - box->x0) * (size_t)(box->y1 - box->y0);
  unsigned char *pixel = (unsigned char *)luaL_buffinitsize(L, &buffer, size);
  for (int32_t y = box->y0; y < box->y1; y++)
    for (int32_t x = box->x0; x < box->x1; x++, pixel += 4)
      put_pixel(p, (size_t)y * (size_t)p->areas->width + (size_t)x, pixel);
  luaL_pushresultsize(&buffer, size);
}

/* The colours as texts, by label. */
static void push_colours(lua_State *L, const picture *p) {
  lua_newtable(L);
  for (size_t i = 0; i < p->areas->count; i++) {
    char text[8];
    unsigned char code[3];
    if (p->colours[i] == PLAIN)
      continue;
    put_code(p->colours[i], code);
    snprintf(text, sizeof text, "#%02x%02x%02x", code[0], code[1], code[2]);
    lua_pushstring(L, text);
    lua_rawseti(L, -2, (lua_Integer)i);
  }
}

int cs_ink_areas_picture(lua_State *L) {
  picture p = {.areas = areas_at(L), .under = lua_toboolean(L, 3)};
  read_labels(L, &p);
  luaL_argcheck(L, p.box.x0 < p.box.x1, 2, "is empty");
  push_pixels(L, &p);
  push_colours(L, &p);
  const int32_t numbers[] = {p.box.x0, p.box.y0, p.box.x1 - p.box.x0, p.box.y1 - p.box.y0};
  for (size_t i = 0; i < 4; i++)
    lua_pushinteger(L, numbers[i]);
  return 6;
}
