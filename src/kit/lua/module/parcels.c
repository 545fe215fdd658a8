/* native.parcels(plane): what can be seen of a plane as outlines, in the form of native.scenery.
 *
 *   parcels   outlines { kind, rule, contours, fill }, which do not overlap, the rearmost first;
 *             lines: what lies under them, so that players show no seams: open contours and fills
 *   fill      as in native.scenery, but its stops { at, r, g, b, alpha } are codes, and a radial
 *             one has a map from its units
 */
#include <math.h>

#include "celspan/plane.h"
#include "lua/bind/host.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"
#include "writers/parcels/under.h"

/* The cosine of the angle between the axes of a radial gradient that counts as a right angle. */
#define SQUARE 1e-4
/* The part of the frame that may be clear beside what is opaque. */
#define CLEAR 1e-7
/* Units: what is thinner does not continue under its neighbour: half the width of the lines. */
#define THIN 1.6

/* What is released in any case. */
typedef struct held {
  celspan_context *context;
  cs_parcels parcels;
  cs_under under;
} held;

static int release(lua_State *L) {
  held *h = lua_touserdata(L, 1);
  if (h->context) {
    cs_under_finish(&h->under, h->context->memory);
    cs_parcels_finish(&h->parcels, h->context->memory);
  }
  h->context = NULL;
  return 0;
}

/* ---------------------------------------------------------------- contours */

/* The contour that is on top of the stack. */
typedef struct contour {
  lua_State *L;
  lua_Integer count;
  celspan_point first, at;
} contour;

static void add_point(contour *c, celspan_point point) {
  lua_pushnumber(c->L, point.x);
  lua_rawseti(c->L, -2, ++c->count);
  lua_pushnumber(c->L, point.y);
  lua_rawseti(c->L, -2, ++c->count);
  c->at = point;
}

static void move(void *user, celspan_point to) {
  contour *c = user;
  *c = (contour){.L = c->L, .first = to};
  lua_newtable(c->L);
  add_point(c, to);
}

static void curve(void *user, const celspan_point points[3]) {
  for (int k = 0; k < 3; k++)
    add_point(user, points[k]);
}

static void line(void *user, celspan_point to) {
  const celspan_point from = ((contour *)user)->at;
  if (from.x != to.x || from.y != to.y)
    curve(user, (const celspan_point[3]){from, to, to});
}

static void close_path(void *user) { line(user, ((contour *)user)->first); }

/* Pushes a contour for each path. */
#define STYLUS(L) ((const cs_parcel_stylus){&(contour){.L = L}, move, line, curve, close_path})

/* ---------------------------------------------------------------- fills */

static void add_stop(lua_State *L, size_t i, double at, const unsigned char code[4]) {
  cs_push_numbers(
      L, (const double[]){at, code[0] / 255.0, code[1] / 255.0, code[2] / 255.0, code[3] / 255.0},
      5);
  lua_rawseti(L, -2, (lua_Integer)i + 1);
}

/* A gradient that is not round has a map of its own, from its units. */
static void put_radial(lua_State *L, const cs_fill *fill) {
  cs_put_numbers(L, "points", (const double[]){fill->centre, 0, 0, 0}, 4);
  cs_put_numbers(L, "map", fill->matrix, 6);
  cs_put_number(L, "radius", fill->radius);
}

static void put_fill(lua_State *L, const cs_parcels *parcels, const cs_fill *fill) {
  const bool is_flat = fill->kind == CS_FILL_FLAT, is_linear = fill->kind == CS_FILL_LINEAR;
  lua_createtable(L, 0, 5);
  cs_put_text(L, "kind", is_flat ? "flat" : is_linear ? "linear" : "radial");
  cs_put_flag(L, "coded", true);
  lua_newtable(L);
  if (is_flat)
    add_stop(L, 0, 0, fill->code);
  for (size_t i = 0; !is_flat && i < fill->stop_count; i++)
    add_stop(L, i, parcels->stops[fill->stop + i].at, parcels->stops[fill->stop + i].code);
  lua_setfield(L, -2, "stops");
  if (is_linear)
    cs_put_numbers(L, "points",
                   (const double[]){fill->from.x, fill->from.y, fill->to.x, fill->to.y}, 4);
  else if (!is_flat)
    put_radial(L, fill);
  lua_setfield(L, -2, "fill");
}

/* Why a fill is not one of a shape; NULL: it is. */
static const char *refuse(const cs_fill *fill) {
  const double *m = fill->matrix;
  if (fill->loop_count == 0)
    return NULL;
  if (fill->kind == CS_FILL_RADIAL &&
      fabs(m[0] * m[1] + m[3] * m[4]) >
          SQUARE * sqrt((m[0] * m[0] + m[3] * m[3]) * (m[1] * m[1] + m[4] * m[4])))
    return "a radial gradient with skewed axes";
  return fill->kind == CS_FILL_PICTURE ? "what has no outline" : NULL;
}

/* ---------------------------------------------------------------- the whole */

static void push_parcel(lua_State *L, const cs_parcels *parcels, const cs_fill *fill) {
  lua_createtable(L, 0, 4);
  cs_put_text(L, "kind", "outline");
  cs_put_text(L, "rule", "evenodd");
  put_fill(L, parcels, fill);
  lua_createtable(L, (int)fill->loop_count, 0);
  for (size_t i = 0; i < fill->loop_count; i++) {
    cs_parcel_draw_loop(parcels, &parcels->loops[fill->loop + i], &STYLUS(L));
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  lua_setfield(L, -2, "contours");
}

/* The lines under one fill; *at: of the first of them, and then of the next fill. */
static void push_lines(lua_State *L, const held *h, size_t *at) {
  const cs_under_line *lines = h->under.lines;
  const uint32_t rank = lines[*at].rank;
  lua_Integer count = 0;
  lua_createtable(L, 0, 2);
  put_fill(L, &h->parcels, &h->parcels.fills[h->under.order[rank]]);
  lua_newtable(L);
  for (; *at < h->under.line_count && lines[*at].rank == rank; ++*at) {
    cs_under_draw(&h->parcels, &lines[*at], &STYLUS(L));
    lua_rawseti(L, -2, ++count);
  }
  lua_setfield(L, -2, "contours");
}

/* Strokes would be seen beside what is opaque, where anything is clear. */
static void put_lines(lua_State *L, const held *h) {
  const double area = h->parcels.width * h->parcels.height;
  lua_Integer count = 0;
  lua_newtable(L);
  for (size_t at = 0; h->under.opaque >= area * (1 - CLEAR) && at < h->under.line_count;) {
    push_lines(L, h, &at);
    lua_rawseti(L, -2, ++count);
  }
  lua_setfield(L, -2, "lines");
}

static celspan_status make(held *h, const celspan_plane *plane) {
  CS_TRY(cs_parcels_make(h->context, plane, &h->parcels));
  return cs_under_make(h->context, &h->parcels, THIN, &h->under);
}

/* (plane) -> its parcels | nil, why they cannot be shapes */
int cs_parcels_list(lua_State *L) {
  celspan_plane **plane = luaL_checkudata(L, 1, CS_NATIVE_PLANE);
  held *h = cs_userdata_push_holder(L, "celspan.parcels", sizeof *h, release);
  h->context = cs_host_context(L);
  CS_HOST_TRY(L, make(h, *plane));
  lua_Integer count = 0;
  lua_newtable(L);
  for (size_t i = h->parcels.fill_count; i-- > 0;) {
    const cs_fill *fill = &h->parcels.fills[h->under.order[i]];
    const char *why = refuse(fill);
    if (why) {
      lua_pushnil(L);
      lua_pushstring(L, why);
      return 2;
    }
    if (fill->kind == CS_FILL_CLEAR || fill->loop_count == 0)
      continue;
    push_parcel(L, &h->parcels, fill);
    lua_rawseti(L, -2, ++count);
  }
  put_lines(L, h);
  return 1;
}
