/* Members of zip archives, for readers that are written in Lua. */
#include <lauxlib.h>

#include "lua/bind/host.h"
#include "lua/bind/userdata.h"
#include "lua/module/core.h"
#include "readers/layered/zip.h"

/* A member while it is read. Its memory is released in any case. */
typedef struct archive {
  celspan_context *context;
  cs_input input;
  cs_zip zip;
  bool is_open, has_zip;
  unsigned char *bytes;
  size_t size;
} archive;

static int release(lua_State *L) {
  archive *a = lua_touserdata(L, 1);
  if (a->bytes)
    cs_mem_free(a->context->memory, a->bytes, a->size + 1);
  if (a->has_zip)
    cs_zip_finish(&a->zip);
  if (a->is_open)
    cs_input_close(&a->input);
  a->bytes = NULL;
  a->is_open = a->has_zip = false;
  return 0;
}

static celspan_status load(archive *a, const char *name, size_t most) {
  CS_TRY(cs_input_open(a->context, &a->input));
  a->is_open = true;
  CS_TRY(cs_zip_read(a->context, &a->input, &a->zip));
  a->has_zip = true;
  const cs_zip_member *member = cs_zip_find(&a->zip, name);
  if (!member)
    return cs_input_fail(a->context, &a->input, -1, CELSPAN_INPUT, "the archive has no '%s'", name);
  return cs_zip_load(a->context, &a->input, member, most, &a->bytes, &a->size);
}

int cs_archive_member(lua_State *L) {
  const char *path = luaL_checkstring(L, 1), *name = luaL_checkstring(L, 2);
  lua_Integer most = luaL_checkinteger(L, 3);
  cs_host_admit(L, path);
  archive *a = cs_userdata_push_holder(L, "celspan.archive", sizeof *a, release);
  *a = (archive){.context = cs_host_context(L), .input = {.path = path}};
  celspan_status status = load(a, name, (size_t)most);
  if (status != CELSPAN_OK)
    return cs_host_fail(L, status);
  lua_pushlstring(L, (const char *)a->bytes, a->size);
  lua_pushcfunction(L, release);
  lua_pushvalue(L, -3);
  lua_call(L, 1, 0);
  return 1;
}
