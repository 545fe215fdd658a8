/* A host that plays a user's film, a Lua script, in its own window: here a plain array of pixels,
 * which is written to standard output as a picture (PPM) each time it is shown.
 *
 *   cc host.c $(pkg-config --cflags --libs celspan-lua) -o host
 *   ./host film.lua 320 180 >film.ppm
 *
 * The same file is a C++ program. */
#include <celspan/lua.h>
#ifdef __cplusplus
#include <lua.hpp>
#else
#include <lauxlib.h>
#include <lualib.h>
#endif
#include <stdio.h>
#include <stdlib.h>

typedef struct window {
  int width, height;
  unsigned char *pixels; /* RGBA, rows top to bottom */
} window;

static void show(const window *w) {
  printf("P6\n%d %d\n255\n", w->width, w->height);
  for (int i = 0; i < w->width * w->height; i++)
    fwrite(w->pixels + 4 * i, 1, 3, stdout);
}

/* Draws a frame into the window. Premultiplied pixels are the picture over black. */
static celspan_status draw(lua_State *L, int64_t number, const window *w) {
  celspan_coding coding = CELSPAN_CODING;
  coding.alpha = CELSPAN_ALPHA_PREMULTIPLIED;
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  celspan_status status = celspan_lua_frame(L, -1, number, &frame);
  if (status != CELSPAN_OK)
    return status;
  frame.width = w->width; /* the film's units do not change */
  frame.height = w->height;
  status = celspan_frame_pixels(celspan_lua_context(L), &frame, &coding, w->pixels,
                                (size_t)w->width * 4, NULL);
  celspan_lua_frame_drop(&frame);
  return status;
}

static celspan_status play(lua_State *L, const window *w) {
  celspan_film film = CELSPAN_FILM;
  celspan_status status = celspan_lua_film(L, -1, &film);
  for (int64_t i = 0; i < film.count && status == CELSPAN_OK; i++)
    if ((status = draw(L, film.first + i, w)) == CELSPAN_OK)
      show(w);
  if (status != CELSPAN_OK)
    fprintf(stderr, "host: %s\n", celspan_context_error(celspan_lua_context(L)));
  return status;
}

int main(int count, char **arguments) {
  window w = {count > 3 ? atoi(arguments[2]) : 320, count > 3 ? atoi(arguments[3]) : 180, NULL};
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  celspan_context *context = NULL;
  lua_State *L = luaL_newstate();
  celspan_status status = CELSPAN_BAD_ARGUMENT;
  desc.picture_bytes = (size_t)64 << 20; /* the cache of decoded pictures */
  if (count > 1 && w.width > 0 && w.height > 0 && w.width <= 8192 && w.height <= 8192)
    w.pixels = (unsigned char *)calloc((size_t)w.width * (size_t)w.height, 4);
  if (L && w.pixels && celspan_context_create(&desc, &context) == CELSPAN_OK) {
    luaL_openlibs(L);
    if (celspan_lua_open(L, context) != CELSPAN_OK ||
        celspan_lua_run(L, arguments[1], 0, NULL) != CELSPAN_OK)
      fprintf(stderr, "host: %s\n", celspan_context_error(context));
    else
      status = play(L, &w);
    lua_close(L); /* before its context */
    celspan_context_destroy(context);
  }
  free(w.pixels);
  return status != CELSPAN_OK;
}
