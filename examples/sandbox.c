/* A host that plays films of strangers: what they may do, and how much of it, is bounded as by the
 * program celspan.
 *
 *   cc sandbox.c $(pkg-config --cflags --libs celspan-lua) -o sandbox
 *   ./sandbox film.lua [SECONDS [STEPS [MEMORY [PRINT]]]]
 *
 * It draws every frame and writes how many there were. The film may call one function of the host,
 * player(), because that is registered. Exit codes are those of celspan: 3 for an error of the
 * script, 6 for a limit. */
#include <celspan/lua.h>
#include <lauxlib.h>
#include <lualib.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WIDTH = 64, HEIGHT = 36, ROW = WIDTH * 4, SCRIPT = 3, LIMIT = 6 };

static int player(lua_State *L) {
  lua_pushliteral(L, "Ada");
  return 1;
}

static void show(void *user, const char *text, size_t size) {
  (void)user;
  fwrite(text, 1, size, stderr);
}

/* A function of C does not return, so the game cannot continue. */
static void give_up(void *user, const char *message) {
  (void)user;
  ssize_t written = write(STDERR_FILENO, message, strlen(message));
  (void)written;
  _exit(LIMIT);
}

static celspan_status draw(lua_State *L, int64_t number) {
  static unsigned char pixels[ROW * HEIGHT];
  celspan_coding coding = CELSPAN_CODING;
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  celspan_status status = celspan_lua_frame(L, -1, number, &frame);
  if (status != CELSPAN_OK)
    return status;
  frame.width = WIDTH;
  frame.height = HEIGHT;
  status = celspan_frame_pixels(celspan_lua_context(L), &frame, &coding, pixels, ROW, NULL);
  celspan_lua_frame_drop(&frame);
  return status;
}

static celspan_status play(lua_State *L, const char *path, const celspan_lua_limits *limits) {
  celspan_status status = celspan_lua_sandbox(L, limits);
  if (status != CELSPAN_OK)
    return status;
  lua_register(L, "player", player); /* after the sandbox was entered */
  status = celspan_lua_run(L, path, 0, NULL);
  if (status != CELSPAN_OK)
    return status;
  celspan_film film = CELSPAN_FILM;
  status = celspan_lua_film(L, -1, &film);
  for (int64_t i = 0; i < film.count && status == CELSPAN_OK; i++)
    status = draw(L, film.first + i);
  if (status == CELSPAN_OK)
    printf("%d frames\n", (int)film.count);
  return status;
}

int main(int count, char **arguments) {
  celspan_lua_limits limits = CELSPAN_LUA_LIMITS;
  celspan_context *context = NULL;
  celspan_status status = CELSPAN_BAD_ARGUMENT;
  lua_State *L = luaL_newstate();
  limits.seconds = count > 2 ? atof(arguments[2]) : 1;
  limits.steps = count > 3 ? (uint64_t)atof(arguments[3]) : limits.steps;
  limits.memory = count > 4 ? (size_t)atof(arguments[4]) : (size_t)64 << 20;
  limits.print = count > 5 ? (size_t)atof(arguments[5]) : limits.print;
  limits.printed = show;
  limits.overdue = give_up;
  if (L && count > 1 && celspan_context_create(NULL, &context) == CELSPAN_OK) {
    luaL_openlibs(L); /* for the host itself: the film gets the sandbox */
    status = celspan_lua_open(L, context);
    if (status == CELSPAN_OK)
      status = play(L, arguments[1], &limits);
    if (status != CELSPAN_OK)
      fprintf(stderr, "sandbox: %s\n", celspan_context_error(context));
  }
  if (L)
    lua_close(L); /* before its context */
  celspan_context_destroy(context);
  return status == CELSPAN_OK ? 0 : status == CELSPAN_LIMIT ? LIMIT : SCRIPT;
}
