/* Lines measured by their length, for celspan.motion and everything that goes along a path. */
#include <math.h>

#include "inside/geometry.h"
#include "inside/scene.h"
#include "lua/bind/host.h"
#include "lua/bind/userdata.h"
#include "lua/nouns/contours.h"
#include "lua/nouns/nouns.h"

#define METATABLE "celspan.ruler"
/* How far away from a place without speed the direction of its piece is taken, by the parameter. */
#define ASIDE 1e-4

typedef struct ruler {
  cs_memory *memory; /* NULL: released */
  cs_outline line;
  cs_outline_closed closed;
  double *ends; /* for each piece: the length of the line up to its end */
} ruler;

static int release(lua_State *L) {
  ruler *r = lua_touserdata(L, 1);
  if (r->memory) {
    cs_mem_free(r->memory, r->ends, r->line.piece_count * sizeof *r->ends);
    cs_outline_closed_finish(&r->closed, r->memory);
    cs_outline_finish(&r->line, r->memory);
  }
  r->memory = NULL;
  return 0;
}

static celspan_status measure(celspan_context *context, ruler *r) {
  double sum = 0;
  cs_bezier piece;
  if (r->line.piece_count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, r->ends, r->line.piece_count));
  for (size_t i = 0; i < r->line.piece_count; i++) {
    cs_curve_load_line(&r->line, i, 0, 1, &piece);
    r->ends[i] = sum += cs_curve_length(&piece, 0, 1);
  }
  return CELSPAN_OK;
}

static celspan_status read_line(lua_State *L, const char *noun, ruler *r) {
  celspan_context *context = cs_host_context(L);
  if (lua_type(L, 2) == LUA_TSTRING)
    return cs_outline_path_open(context, &r->line, &r->closed, lua_tostring(L, 2));
  lua_pushvalue(L, 2);
  const cs_contour_list contours = cs_contours_read(L, noun);
  CS_TRY(cs_check_contours(context, noun, contours.items, contours.count));
  return cs_outline_contours(context, &r->line, &r->closed, contours.items, contours.count);
}

static bool is_closed(const ruler *r) {
  return r->closed.count > 0 &&
         r->closed.contours[r->closed.count - 1] + 1 == r->line.contour_count;
}

/* (noun, path data or contours) -> ruler, its length, whether its end is its beginning, and unless
 * it has no pieces, x, y of its first point | nil, message */
int cs_ruler_make(lua_State *L) {
  const char *noun = luaL_checkstring(L, 1);
  lua_settop(L, 2);
  ruler *r = cs_userdata_push_holder(L, METATABLE, sizeof *r, release);
  cs_outline_init(&r->line);
  r->memory = cs_host_context(L)->memory;
  CS_HOST_TRY(L, read_line(L, noun, r));
  CS_HOST_TRY(L, measure(cs_host_context(L), r));
  lua_settop(L, 3);
  size_t count = r->line.piece_count;
  lua_pushnumber(L, count > 0 ? r->ends[count - 1] : 0);
  lua_pushboolean(L, is_closed(r));
  if (count > 0) {
    lua_pushnumber(L, r->line.points[0].x);
    lua_pushnumber(L, r->line.points[0].y);
  }
  return lua_gettop(L) - 2;
}

/* The first piece that ends behind a length, or at the greatest length. It is no point. */
static size_t piece_at(const ruler *r, double length) {
  size_t low = 0, high = r->line.piece_count - 1;
  bool is_last = !(length < r->ends[high]);
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (is_last ? r->ends[middle] >= r->ends[high] : r->ends[middle] > length)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

/* The point at a length of the line, and the direction there, of length 1. */
static void find_place(const ruler *r, double length, celspan_point *point, celspan_point *way) {
  size_t i = piece_at(r, length);
  double start = i > 0 ? r->ends[i - 1] : 0, whole = r->ends[i] - start;
  cs_bezier piece;
  cs_curve_load_line(&r->line, i, 0, 1, &piece);
  double t = cs_curve_parameter(&piece, whole, length - start);
  celspan_point aside;
  cs_curve_line_at(&piece, t, point, way);
  if (way->x == 0 && way->y == 0)
    cs_curve_line_at(&piece, t < 0.5 ? t + ASIDE : t - ASIDE, &aside, way);
  double speed = cs_number_length(way->x, way->y);
  *way = speed > 0 ? (celspan_point){way->x / speed, way->y / speed} : (celspan_point){1, 0};
}

/* (ruler with a length, a length) -> x, y, and the direction as x, y. Before its beginning and
 * behind its end a line is straight. */
int cs_ruler_at(lua_State *L) {
  const ruler *r = luaL_checkudata(L, 1, METATABLE);
  double length = luaL_checknumber(L, 2);
  luaL_argcheck(L, r->ends, 1, "a line with a length is needed");
  double held = fmin(fmax(length, 0), r->ends[r->line.piece_count - 1]);
  celspan_point point, way;
  find_place(r, held, &point, &way);
  lua_pushnumber(L, point.x + (length - held) * way.x);
  lua_pushnumber(L, point.y + (length - held) * way.y);
  lua_pushnumber(L, way.x);
  lua_pushnumber(L, way.y);
  return 4;
}
