/* celspan.so in an interpreter that is not Lua 5.4: functions that Lua 5.1, LuaJIT or 5.3 does not
 * have.
 *
 * The module is not linked with Lua: the interpreter that loads it has the functions. An older one
 * lacks some, and the loader would end with "undefined symbol". So the module has functions of
 * these names too, which raise a sentence. The loader prefers the functions of the interpreter, if
 * it has them. luaopen_celspan calls luaL_checkversion before everything else: Lua 5.1 comes here
 * by it, and a later one says itself that the version is wrong.
 *
 * lua.h is not included, because its declarations are of functions that return values. A static
 * library must not have this file: its functions would take the place of Lua's.
 */
typedef struct lua_State lua_State;
int luaL_error(lua_State *L, const char *format, ...);

#define OTHER_LUA(name)                                                                            \
  __attribute__((visibility("default"))) int name(lua_State *L);                                   \
  int name(lua_State *L) { return luaL_error(L, "this celspan.so is a module for Lua 5.4"); }

OTHER_LUA(luaL_buffinitsize)
OTHER_LUA(luaL_checkversion_)
OTHER_LUA(luaL_getsubtable)
OTHER_LUA(luaL_len)
OTHER_LUA(luaL_loadbufferx)
OTHER_LUA(luaL_loadfilex)
OTHER_LUA(luaL_prepbuffsize)
OTHER_LUA(luaL_pushresultsize)
OTHER_LUA(luaL_requiref)
OTHER_LUA(luaL_setfuncs)
OTHER_LUA(luaL_setmetatable)
OTHER_LUA(luaL_testudata)
OTHER_LUA(luaL_tolstring)
OTHER_LUA(luaL_typeerror)
OTHER_LUA(lua_absindex)
OTHER_LUA(lua_callk)
OTHER_LUA(lua_compare)
OTHER_LUA(lua_copy)
OTHER_LUA(lua_getglobal)
OTHER_LUA(lua_geti)
OTHER_LUA(lua_getiuservalue)
OTHER_LUA(lua_isinteger)
OTHER_LUA(lua_newuserdatauv)
OTHER_LUA(lua_pcallk)
OTHER_LUA(lua_rawgetp)
OTHER_LUA(lua_rawlen)
OTHER_LUA(lua_rawsetp)
OTHER_LUA(lua_rotate)
OTHER_LUA(lua_seti)
OTHER_LUA(lua_setiuservalue)
OTHER_LUA(lua_stringtonumber)
OTHER_LUA(lua_tointegerx)
OTHER_LUA(lua_tonumberx)
OTHER_LUA(luaopen_coroutine)
OTHER_LUA(luaopen_utf8)
