/* Addresses that contain a file, for readers that are written in Lua. */
#include <lauxlib.h>

#include "common/address.h"
#include "lua/module/native.h"

int cs_addresses_is_data(lua_State *L) {
  lua_pushboolean(L, cs_address_is_data(luaL_checkstring(L, 1)));
  return 1;
}

int cs_addresses_make(lua_State *L) {
  size_t size;
  const char *bytes = luaL_checklstring(L, 1, &size);
  size_t made = cs_address_encoded_size(size);
  luaL_Buffer buffer;
  cs_address_encode((const unsigned char *)bytes, size, luaL_buffinitsize(L, &buffer, made));
  luaL_pushresultsize(&buffer, made);
  return 1;
}
