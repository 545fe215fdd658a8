/* Scanned drawings, for celspan.ink. */
#include <lauxlib.h>
#include <string.h>

#include "inside/colour.h"
#include "inside/context.h"
#include "inside/pictures.h"
#include "inside/scene.h"
#include "lua/bind/form.h"
#include "lua/bind/host.h"
#include "lua/bind/list.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"
#include "lua/nouns/pixel_string.h"
#include "tools/scan/holes.h"
#include "tools/scan/inks.h"
#include "tools/scan/paper.h"
#include "tools/scan/shift.h"
#include "tools/scan/turn.h"

#define PAGE "celspan.page"

CS_HOLDER_RELEASE(release_page, cs_rough, cs_rough_destroy)

static cs_rough *page_at(lua_State *L, int index) {
  cs_rough **holder = luaL_checkudata(L, index, PAGE);
  luaL_argcheck(L, *holder, index, "is closed");
  return *holder;
}

static double number_in(lua_State *L, int index, int i) {
  lua_rawgeti(L, index, i);
  double value = luaL_checknumber(L, -1);
  lua_pop(L, 1);
  return value;
}

/* ---------------------------------------------------------------- a page, and where it lies */

int cs_scanning_open(lua_State *L) {
  celspan_context *context = cs_host_context(L);
  celspan_picture_desc desc = CELSPAN_PICTURE_DESC;
  cs_picture *picture;
  double dpi = 0;
  desc.file = luaL_checkstring(L, 1);
  cs_rough **page = cs_userdata_push_holder(L, PAGE, sizeof *page, release_page);
  CS_HOST_TRY(L, cs_picture_create(context, &desc, &picture));
  celspan_status status = cs_store_dpi(context, picture, &dpi);
  if (status == CELSPAN_OK)
    status = cs_rough_create(context, picture, page);
  cs_picture_unref(picture);
  CS_HOST_TRY(L, status);
  lua_pushinteger(L, (*page)->scan.width);
  lua_pushinteger(L, (*page)->scan.height);
  lua_pushnumber(L, dpi);
  return 4;
}

int cs_scanning_pegs(lua_State *L) {
  cs_rough *page = page_at(L, 1);
  double dpi = luaL_checknumber(L, 2);
  cs_hole holes[CS_ROUGH_HOLES];
  cs_pegs pegs;
  luaL_checktype(L, 3, LUA_TTABLE);
  size_t count = lua_rawlen(L, 3);
  luaL_argcheck(L, count >= 2 && count <= CS_ROUGH_HOLES, 3, "has too few or too many holes");
  for (size_t i = 0; i < count; i++) {
    lua_rawgeti(L, 3, (lua_Integer)i + 1);
    int at = lua_gettop(L);
    holes[i] = (cs_hole){number_in(L, at, 1), number_in(L, at, 2), number_in(L, at, 3),
                         number_in(L, at, 4)};
    lua_pop(L, 1);
  }
  CS_HOST_TRY(L, cs_holes_find(page, dpi, holes, count, &pegs));
  const double numbers[] = {pegs.scale, pegs.turn, pegs.x, pegs.y, pegs.error};
  lua_pushinteger(L, pegs.found);
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
    lua_pushnumber(L, numbers[i]);
  return 6;
}

int cs_scanning_corners(lua_State *L) {
  cs_paper_found found;
  if (!cs_paper_find(page_at(L, 1), &found)) {
    luaL_pushfail(L);
    return 1;
  }
  lua_pushnumber(L, found.turn);
  lua_pushnumber(L, found.x);
  lua_pushnumber(L, found.y);
  lua_pushnumber(L, found.error);
  return 4;
}

int cs_scanning_shift(lua_State *L) {
  cs_rough_shift shift;
  CS_HOST_TRY(L, cs_shift_find(page_at(L, 1), page_at(L, 2), &shift));
  lua_pushnumber(L, shift.x);
  lua_pushnumber(L, shift.y);
  lua_pushnumber(L, shift.likeness);
  return 3;
}

/* ---------------------------------------------------------------- a layer of lines */

/* Alpha, and the one colour that its pixels have. */
typedef struct layer {
  cs_memory *memory; /* counted */
  size_t width, bytes;
  unsigned char code[3];
  uint8_t alpha[];
} layer;

static void release_layer(void *user) {
  layer *lines = user;
  cs_memory *memory = lines->memory;
  cs_mem_free(memory, lines, lines->bytes);
  cs_memory_unref(memory);
}

static celspan_status fill_layer(void *user, celspan_context *context,
                                 const celspan_rectangle *rectangle, void *destination,
                                 size_t stride, int32_t *rows) {
  const layer *lines = user;
  (void)context;
  for (int32_t y = 0; y < rectangle->height; y++) {
    unsigned char *out = (unsigned char *)destination + (size_t)y * stride;
    const uint8_t *alpha = lines->alpha + (size_t)(rectangle->y + y) * lines->width;
    for (int32_t x = rectangle->x; x < rectangle->x + rectangle->width; x++, out += 4) {
      out[0] = lines->code[0];
      out[1] = lines->code[1];
      out[2] = lines->code[2];
      out[3] = alpha[x];
    }
  }
  *rows = rectangle->height;
  return CELSPAN_OK;
}

/* Makes the surface of a layer, which it then owns. */
static celspan_status make_surface(celspan_context *context, layer *lines, int32_t height,
                                   celspan_surface **out) {
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  cs_hash hash = cs_hash_begin(sizeof lines->code);
  cs_hash_bytes(&hash, lines->code, sizeof lines->code);
  cs_hash_bytes(&hash, lines->alpha, lines->width * (size_t)height);
  hash = cs_hash_end(hash);
  desc.width = (int32_t)lines->width;
  desc.height = height;
  desc.format = CELSPAN_SURFACE_RGBA8;
  desc.fill = fill_layer;
  desc.user = lines;
  desc.release = release_layer;
  desc.any_thread = true;
  desc.has_key = true;
  desc.key[0] = hash.a;
  desc.key[1] = hash.b;
  return celspan_surface_create(context, &desc, out);
}

/* Where the page is laid, and how large the layer is. */
typedef struct placing {
  cs_turn turn;
  int32_t width, height;
} placing;

static celspan_status make_layer(celspan_context *context, const uint8_t *plane,
                                 const unsigned char *code, const placing *to,
                                 celspan_surface **out) {
  size_t pixels = (size_t)to->width * (size_t)to->height, bytes = sizeof(layer) + pixels;
  layer *lines = cs_mem_array(context->memory, 1, bytes);
  if (!lines)
    return cs_fail_memory(context);
  *lines = (layer){.memory = cs_memory_ref(context->memory),
                   .width = (size_t)to->width,
                   .bytes = bytes,
                   .code = {code[0], code[1], code[2]}};
  for (int32_t y = 0; y < to->height; y++)
    cs_turn_row(&to->turn, plane, y, to->width, lines->alpha + (size_t)y * lines->width);
  celspan_status status = make_surface(context, lines, to->height, out);
  if (status != CELSPAN_OK)
    release_layer(lines);
  return status;
}

/* ---------------------------------------------------------------- lines */

/* Arguments 3 to 6: the colours, the least area, and black and white, if given. */
static cs_inks_desc read_desc(lua_State *L) {
  cs_inks_desc desc = {.dust = (uint32_t)luaL_checkinteger(L, 4)};
  luaL_checktype(L, 3, LUA_TTABLE);
  for (int i = 1; i <= (int)cs_list_length(L, 3) && i <= CS_INKS_MOST; i++) {
    celspan_paint paint;
    lua_rawgeti(L, 3, i);
    luaL_argcheck(L, cs_form_colour(luaL_checkstring(L, -1), &paint), 3, "is no colour");
    for (int c = 0; c < 3; c++)
      desc.codes[desc.count][c] = cs_transfer_srgb8(paint.pigment[c]);
    desc.count++;
    lua_pop(L, 1);
  }
  desc.has_tones = !lua_isnoneornil(L, 5);
  desc.black = desc.has_tones ? luaL_checknumber(L, 5) : 0;
  desc.white = desc.has_tones ? luaL_checknumber(L, 6) : 0;
  return desc;
}

/* Argument 2: turn, x, y, to_x, to_y, and the size of the result. */
static placing read_placing(lua_State *L, const cs_rough *page) {
  luaL_checktype(L, 2, LUA_TTABLE);
  return (placing){{number_in(L, 2, 1), number_in(L, 2, 2), number_in(L, 2, 3), number_in(L, 2, 4),
                    number_in(L, 2, 5), page->scan.width, page->scan.height},
                   (int32_t)number_in(L, 2, 6),
                   (int32_t)number_in(L, 2, 7)};
}

/* What must be released, also if Lua has no memory for the result. */
typedef struct held {
  cs_inks inks;
  celspan_surface *layers[CS_INKS_MOST];
} held;

static int release_held(lua_State *L) {
  held *h = lua_touserdata(L, 1);
  for (int i = 0; i < CS_INKS_MOST; i++)
    celspan_surface_unref(h->layers[i]);
  cs_inks_finish(&h->inks);
  memset(h->layers, 0, sizeof h->layers);
  return 0;
}

int cs_scanning_lines(lua_State *L) {
  lua_settop(L, 6);
  const cs_rough *page = page_at(L, 1);
  placing to = read_placing(L, page);
  cs_inks_desc desc = read_desc(L);
  held *h = cs_userdata_push_holder(L, "celspan.inks", sizeof *h, release_held);
  CS_HOST_TRY(L, cs_inks_make(page, &desc, &h->inks));
  lua_createtable(L, (int)desc.count, 0);
  for (size_t i = 0; i < desc.count; i++) {
    CS_HOST_TRY(
        L, make_layer(cs_host_context(L), h->inks.planes[i], desc.codes[i], &to, &h->layers[i]));
    cs_pixel_string_push_surface(L, h->layers[i]);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  lua_pushnumber(L, h->inks.black);
  lua_pushnumber(L, h->inks.white);
  lua_pushinteger(L, (lua_Integer)h->inks.covered);
  lua_pushcfunction(L, release_held); /* the planes are large: they do not wait for a collection */
  lua_pushvalue(L, 7);
  lua_call(L, 1, 0);
  return 4;
}
