/* program.web(): a web server for this machine only, for verbs in Lua; and a function that waits
 * for news from several sources. The server is in a separate module (plugins/web/module.h), which
 * is loaded here. */
#include <errno.h>
#include <string.h>

#include "inside/module.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "plugins/web/module.h"
#include "process/interrupt.h"
#include "program/film/service.h"

enum { HEADERS_MOST = 32, SOURCES_MOST = 64 };

typedef struct server {
  const cs_web_module *module;
  cs_web *web; /* owned */
} server;

static int close_server(lua_State *L) {
  server *s = lua_touserdata(L, 1);
  if (s->web)
    s->module->close(s->web);
  s->web = NULL;
  return 0;
}

/* The server that is argument 1. */
static server *self(lua_State *L) { return cs_service_opened(L); }

/* ---------------------------------------------------------------- requests */

static int run(lua_State *L) {
  const server *s = self(L);
  lua_pushinteger(L, s->module->run(s->web));
  return 1;
}

static int descriptor(lua_State *L) {
  const server *s = self(L);
  lua_pushinteger(L, s->module->descriptor(s->web));
  return 1;
}

/* web:take() -> { id =, method =, target =, host =, origin =, token =, site =, body = } | nil */
static int take(lua_State *L) {
  const server *s = self(L);
  const cs_web_request *request = s->module->take(s->web);
  if (!request)
    return 0;
  lua_createtable(L, 0, 8);
  cs_put_integer(L, "id", (lua_Integer)request->id);
  cs_put_text(L, "method", request->method);
  cs_put_text(L, "target", request->target);
  cs_put_text(L, "host", request->host);
  cs_put_text(L, "origin", request->origin);
  cs_put_text(L, "token", request->token);
  cs_put_text(L, "site", request->site);
  lua_pushlstring(L, request->body, request->body_size);
  lua_setfield(L, -2, "body");
  return 1;
}

/* The list of names and values at index 4, whose texts remain valid there. */
static size_t read_headers(lua_State *L, cs_web_header out[HEADERS_MOST]) {
  size_t count = lua_rawlen(L, 4) / 2;
  luaL_argcheck(L, count <= HEADERS_MOST, 4, "too many headers");
  for (size_t i = 0; i < 2 * count; i++, lua_pop(L, 1)) {
    luaL_argcheck(L, lua_rawgeti(L, 4, (lua_Integer)i + 1) == LUA_TSTRING, 4, "not texts");
    *(i % 2 ? &out[i / 2].value : &out[i / 2].name) = lua_tostring(L, -1);
  }
  return count;
}

/* web:answer(id, status, { name, value, ... }, bytes): nothing is sent if the client has gone. */
static int answer(lua_State *L) {
  const server *s = self(L);
  cs_web_header headers[HEADERS_MOST];
  luaL_checktype(L, 4, LUA_TTABLE);
  cs_web_answer one = {.status = (unsigned)luaL_checkinteger(L, 3), .headers = headers};
  one.header_count = read_headers(L, headers);
  one.bytes = luaL_checklstring(L, 5, &one.size);
  if (!s->module->answer(s->web, (uint64_t)luaL_checkinteger(L, 2), &one))
    return luaL_error(L, "not enough memory");
  return 0;
}

/* web:counts() -> { requests =, displaced =, refused =, late =, oversized = } */
static int counts(lua_State *L) {
  const server *s = self(L);
  const cs_web_counts all = s->module->counts(s->web);
  lua_createtable(L, 0, 5);
  cs_put_integer(L, "requests", (lua_Integer)all.requests);
  cs_put_integer(L, "displaced", (lua_Integer)all.displaced);
  cs_put_integer(L, "refused", (lua_Integer)all.refused);
  cs_put_integer(L, "late", (lua_Integer)all.late);
  cs_put_integer(L, "oversized", (lua_Integer)all.oversized);
  return 1;
}

/* ---------------------------------------------------------------- the server */

static celspan_status load(celspan_context *context, const cs_web_module **out) {
  const void *table;
  CS_TRY(cs_module_load(context, &cs_modules_web, CS_WEB_MODULE_VERSION, CELSPAN_INPUT, &table));
  *out = table;
  return CELSPAN_OK;
}

static int refuse_port(lua_State *L, int port, int error) {
  if (error == EADDRINUSE)
    return cs_service_end(L, cs_report_usage("--port %d: another program uses this port; leave "
                                             "--port out, and a free one is chosen",
                                             port));
  return cs_service_end(
      L, cs_report_usage("--port %d: no server can be opened there: %s", port, strerror(error)));
}

/* web(port) -> the server, with its `port`; port 0: any free port */
static int open_server(lua_State *L) {
  static const luaL_Reg methods[] = {CS_SERVICE(run),    CS_SERVICE(descriptor), CS_SERVICE(take),
                                     CS_SERVICE(answer), CS_SERVICE(counts),     {NULL, NULL}};
  int port = (int)luaL_checkinteger(L, 1);
  lua_createtable(L, 0, 8);
  server *s = cs_userdata_push_holder(L, "celspan.program.web", sizeof *s, close_server);
  cs_service_try(L, load(cs_service_session(L)->context, &s->module));
  int error = s->module->open((uint16_t)port, &s->web);
  if (error)
    return refuse_port(L, port, error);
  lua_setfield(L, -2, "open");
  cs_put_integer(L, "port", s->module->port(s->web));
  cs_service_add(L, methods);
  return 1;
}

/* poll(milliseconds, { descriptor, ... }): waits until one of them has data to read, the time is
 * over, or a signal asks to stop. */
static int poll_sources(lua_State *L) {
  struct pollfd sources[SOURCES_MOST];
  luaL_checktype(L, 2, LUA_TTABLE);
  size_t count = lua_rawlen(L, 2);
  luaL_argcheck(L, count <= SOURCES_MOST, 2, "too many sources");
  for (size_t i = 0; i < count; i++, lua_pop(L, 1)) {
    lua_rawgeti(L, 2, (lua_Integer)i + 1);
    sources[i] = (struct pollfd){.fd = (int)lua_tointeger(L, -1), .events = POLLIN};
  }
  cs_interrupt_wait(sources, count, (int)luaL_checkinteger(L, 1));
  return 0;
}

const luaL_Reg cs_services_web[] = {{"web", open_server}, {"poll", poll_sources}, {NULL, NULL}};
