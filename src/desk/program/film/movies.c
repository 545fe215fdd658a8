#include "program/film/movies.h"

#include <lauxlib.h>
#include <string.h>
#include <unistd.h>

#include "lua/bind/host.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"
#include "lua/nouns/pixel_string.h"
#include "plugins/footage/movie.h"

CS_HOLDER_RELEASE(release_movie, cs_movie, cs_movie_unref)
CS_HOLDER_RELEASE(release_surface, celspan_surface, celspan_surface_unref)

/* movie.picture(place from 1, is_premultiplied) -> a value that celspan.picture accepts as
 * `pixels` */
static int picture(lua_State *L) {
  cs_movie *movie = *(cs_movie **)lua_touserdata(L, lua_upvalueindex(1));
  lua_Integer place = luaL_checkinteger(L, 1);
  luaL_argcheck(L, place >= 1 && (size_t)place <= movie->listing.count, 1, "no such picture");
  celspan_surface **surface = cs_userdata_push_holder(L, "celspan.program.surface",
                                                      sizeof(celspan_surface *), release_surface);
  cs_host_try(
      L, "footage",
      cs_movie_surface(cs_host_context(L), movie, (size_t)place - 1,
                       lua_toboolean(L, 2) ? CELSPAN_ALPHA_PREMULTIPLIED : CELSPAN_ALPHA_STRAIGHT,
                       surface));
  cs_pixel_string_push_surface(L, *surface);
  return 1;
}

static void put_pair(lua_State *L, const char *name, const int32_t pair[2]) {
  if (pair[0] != 0)
    cs_put_pair(L, name, pair[0], pair[1]);
}

/* The times in ticks, 8 bytes each. */
static void put_times(lua_State *L, const cs_listing *listing) {
  luaL_Buffer bytes;
  char *at = luaL_buffinitsize(L, &bytes, listing->count * sizeof(int64_t));
  for (size_t i = 0; i < listing->count; i++)
    memcpy(at + i * sizeof(int64_t), &listing->pictures[i].time, sizeof(int64_t));
  luaL_pushresultsize(&bytes, listing->count * sizeof(int64_t));
  lua_setfield(L, -2, "times");
}

static void push_facts(lua_State *L, const cs_movie *movie) {
  const cs_listing *listing = &movie->listing;
  const cs_raw *planes = &movie->decode.planes;
  lua_createtable(L, 0, 25);
  cs_put_integer(L, "width", listing->width);
  cs_put_integer(L, "height", listing->height);
  cs_put_integer(L, "turns", listing->turns);
  cs_put_integer(L, "count", (lua_Integer)listing->count);
  cs_put_integer(L, "last", listing->last);
  cs_put_integer(L, "bits", planes->bits);
  cs_put_flag(L, "alpha", planes->has_alpha);
  cs_put_flag(L, "sound", listing->has_sound);
  cs_put_text(L, "container", movie->decode.file.kind);
  cs_put_text(L, "codec", listing->codec);
  cs_put_text(L, "pixels", listing->pixels);
  cs_put_text(L, "primaries", listing->primaries);
  cs_put_text(L, "transfer", listing->transfer);
  cs_put_text(L, "matrix", listing->matrix);
  cs_put_text(L, "range", listing->range);
  cs_put_text(L, "matrix_taken", cs_raw_matrix_taken(planes, listing->matrix, listing->height));
  cs_put_text(L, "range_taken", planes->is_full ? "full" : "limited");
  cs_put_integer(L, "bytes", movie->decode.file.size);
  put_pair(L, "aspect", listing->aspect);
  put_pair(L, "tick", listing->tick);
  put_pair(L, "rate", listing->rate);
  put_times(L, listing);
}

/* (path, tried | nil) -> facts | nil, message */
static int open_movie(lua_State *L) {
  const char *path = luaL_checkstring(L, 1), *tried = luaL_optstring(L, 2, NULL);
  cs_movie **movie =
      cs_userdata_push_holder(L, "celspan.program.movie", sizeof(cs_movie *), release_movie);
  CS_HOST_TRY(L, cs_movie_open(cs_host_context(L), path, tried, movie));
  push_facts(L, *movie);
  lua_pushvalue(L, -2);
  lua_pushcclosure(L, picture, 1);
  lua_setfield(L, -2, "picture");
  return 1;
}

void cs_movies_give(lua_State *L) {
  lua_pushcfunction(L, open_movie);
  lua_setfield(L, LUA_REGISTRYINDEX, CS_NATIVE_MOVIE);
  lua_pushcfunction(L, cs_movies_is);
  lua_setfield(L, LUA_REGISTRYINDEX, CS_NATIVE_IS_MOVIE);
}

int cs_movies_is(lua_State *L) {
  cs_kind_file file;
  celspan_status status = cs_kind_open(cs_host_context(L), luaL_checkstring(L, 1), NULL, &file);
  if (status == CELSPAN_OK)
    close(file.descriptor);
  lua_pushboolean(L, status == CELSPAN_OK);
  return 1;
}
