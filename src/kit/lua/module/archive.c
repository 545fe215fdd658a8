/* Members of zip archives, for readers that are written in Lua. */
#include <lauxlib.h>
#include <string.h>

#include "lua/bind/host.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"
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

static celspan_status find(archive *a, const char *name, const cs_zip_member **member) {
  CS_TRY(cs_input_open(a->context, &a->input));
  a->is_open = true;
  CS_TRY(cs_zip_read(a->context, &a->input, &a->zip));
  a->has_zip = true;
  *member = cs_zip_find(&a->zip, name);
  if (*member)
    return CELSPAN_OK;
  return cs_input_fail(a->context, &a->input, -1, CELSPAN_INPUT, "the archive has no '%s'", name);
}

/* path, name -> archive: finds the member. */
static celspan_status open(lua_State *L, archive **a, const cs_zip_member **member) {
  size_t size;
  const char *path = luaL_checkstring(L, 1), *name = luaL_checklstring(L, 2, &size);
  cs_host_admit(L, path);
  *a = cs_userdata_push_holder(L, "celspan.archive", sizeof **a, release);
  **a = (archive){.context = cs_host_context(L), .input = {.path = path}};
  return find(*a, strlen(name) == size ? name : "", member); /* no name has a zero byte */
}

/* archive, result -> archive, result: the memory does not wait for the collector. */
static int finish(lua_State *L) {
  lua_pushcfunction(L, release);
  lua_pushvalue(L, -3);
  lua_call(L, 1, 0);
  return 1;
}

int cs_archive_member(lua_State *L) {
  archive *a;
  const cs_zip_member *member;
  lua_Integer most = luaL_checkinteger(L, 3);
  celspan_status status = open(L, &a, &member);
  if (status == CELSPAN_OK)
    status = cs_zip_load(a->context, &a->input, member, (size_t)most, &a->bytes, &a->size);
  if (status != CELSPAN_OK)
    return cs_host_fail_input(L, status);
  lua_pushlstring(L, (const char *)a->bytes, a->size);
  return finish(L);
}

int cs_archive_size(lua_State *L) {
  archive *a;
  const cs_zip_member *member;
  celspan_status status = open(L, &a, &member);
  if (status != CELSPAN_OK)
    return cs_host_fail_input(L, status);
  lua_pushinteger(L, (lua_Integer)member->unpacked);
  return finish(L);
}
