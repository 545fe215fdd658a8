/* program.watcher(): which files of some folders change, by inotify. */
#include <errno.h>
#include <string.h>
#include <sys/inotify.h>
#include <unistd.h>

#include "lua/bind/userdata.h"
#include "program/film/service.h"

/* A file was written, moved there, removed or created; and events of the folder itself. */
#define EVENTS                                                                                     \
  (IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE | IN_DELETE_SELF | IN_ONLYDIR)

enum { BUFFER = 16384 };

static int close_watcher(lua_State *L) {
  int *queue = lua_touserdata(L, 1);
  if (*queue > 0)
    close(*queue);
  *queue = 0;
  return 0;
}

/* The queue of the watcher that is argument 1. */
static int self(lua_State *L) { return *(int *)cs_service_opened(L); }

/* watcher:add(folder) -> its number, which is the same for the same folder | nil, message */
static int add(lua_State *L) {
  int number = inotify_add_watch(self(L), luaL_checkstring(L, 2), EVENTS);
  if (number < 0)
    return luaL_fileresult(L, 0, NULL);
  lua_pushinteger(L, number);
  return 1;
}

/* watcher:take() -> { number, name, number, name, ... }: all events since the last call. A name is
 * "" if the folder itself is gone; a number is -1 if events were lost. */
static int take(lua_State *L) {
  _Alignas(struct inotify_event) char buffer[BUFFER];
  ssize_t size = read(self(L), buffer, sizeof buffer);
  lua_newtable(L);
  lua_Integer count = 0;
  for (ssize_t at = 0; at < size;) {
    const struct inotify_event *event = (const struct inotify_event *)(const void *)(buffer + at);
    lua_pushinteger(L, event->wd);
    lua_rawseti(L, -2, ++count);
    lua_pushstring(L, event->len ? event->name : "");
    lua_rawseti(L, -2, ++count);
    at += (ssize_t)(sizeof *event + event->len);
  }
  return 1;
}

static int descriptor(lua_State *L) {
  lua_pushinteger(L, self(L));
  return 1;
}

/* watcher() -> a watcher; the verb ends if there is none. */
static int open_watcher(lua_State *L) {
  static const luaL_Reg methods[] = {
      CS_SERVICE(add), CS_SERVICE(take), CS_SERVICE(descriptor), {NULL, NULL}};
  lua_createtable(L, 0, 4);
  int *queue = cs_userdata_push_holder(L, "celspan.program.watcher", sizeof *queue, close_watcher);
  *queue = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  if (*queue < 0) {
    cs_report_error("files cannot be watched: %s", strerror(errno));
    return cs_service_end(L, CS_EXIT_LIMIT);
  }
  lua_setfield(L, -2, "open");
  cs_service_add(L, methods);
  return 1;
}

const luaL_Reg cs_services_watchers[] = {{"watcher", open_watcher}, {NULL, NULL}};
