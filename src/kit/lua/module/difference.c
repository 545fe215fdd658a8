/* Comparing two pictures as codes. */
#include <lauxlib.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "common/difference.h"
#include "lua/module/native.h"

typedef struct tally {
  lua_Integer count;
  size_t at; /* the pixel of the largest difference */
  int largest, channel;
} tally;

/* The largest difference of two pixels in codes, and its channel. */
static int distance_of(const uint8_t *a, const uint8_t *b, int *channel) {
  int most = abs(a[3] - b[3]);
  *channel = 3;
  for (int c = 0; c < 3 && a[3] > 0 && b[3] > 0; c++) {
    int distance = abs(a[c] - b[c]);
    if (distance > most) {
      most = distance;
      *channel = c;
    }
  }
  return most;
}

/* out: contains the codes of the first picture, and gets the codes of the difference. */
static tally compare(uint8_t *out, const uint8_t *other, size_t pixels, double tolerance) {
  tally t = {0, 0, 0, 0};
  for (size_t i = 0; i < pixels; i++) {
    int channel, distance = distance_of(out + 4 * i, other + 4 * i, &channel);
    if (distance > t.largest)
      t = (tally){t.count, i, distance, channel};
    bool differs = distance / 255.0 > tolerance;
    t.count += differs;
    if (differs)
      cs_difference_mark(distance / 255.0, out + 4 * i, 1);
    else
      cs_difference_pale(out + 4 * i, 1);
  }
  return t;
}

int cs_difference_of(lua_State *L) {
  static const char *const channels[] = {"r", "g", "b", "a"};
  size_t size, other_size;
  const char *first = luaL_checklstring(L, 1, &size);
  const char *second = luaL_checklstring(L, 2, &other_size);
  lua_Integer width = luaL_checkinteger(L, 3);
  double tolerance = luaL_checknumber(L, 4);
  luaL_argcheck(L, size == other_size && size % 4 == 0, 2, "pictures of one size are needed");
  luaL_argcheck(L, width > 0, 3, "a width above 0 is needed");
  lua_pushinteger(L, 0);
  if (memcmp(first, second, size) == 0)
    return 1;
  luaL_Buffer buffer;
  char *out = luaL_buffinitsize(L, &buffer, size);
  memcpy(out, first, size);
  tally t = compare((uint8_t *)out, (const uint8_t *)second, size / 4, tolerance);
  luaL_pushresultsize(&buffer, size);
  lua_pushinteger(L, t.count);
  lua_replace(L, 5);
  lua_pushnumber(L, t.largest / 255.0);
  lua_pushinteger(L, (lua_Integer)t.at % width);
  lua_pushinteger(L, (lua_Integer)t.at / width);
  lua_pushstring(L, channels[t.channel]);
  lua_rotate(L, 6, -1); /* moves the picture to the end */
  return 6;
}
