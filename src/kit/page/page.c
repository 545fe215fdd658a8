/* What engine.mjs calls: one film at a time, from a text, by the public interface alone.
 *
 *   open -> set ... -> run -> frame -> pixels, digest -> close
 *
 * Functions return a celspan_status, and after a failure `error` has the sentence.
 */
#include <lauxlib.h>
#include <lualib.h>
#include <stdlib.h>
#include <string.h>

#include "celspan/lua.h"

/* JavaScript calls them: no header declares them. */
#pragma GCC diagnostic ignored "-Wmissing-prototypes"
#define TO_PAGE(name) __attribute__((export_name(#name)))

/* A tab has less memory than a machine. */
enum { CACHED_BYTES = 64 << 20 };

typedef struct page {
  celspan_context *context;
  lua_State *L; /* with the film at 1, when a script has run */
  celspan_film film;
  celspan_frame_desc frame;
  char *printed; /* NULL: nothing */
  size_t printed_size;
} page;

/* What there is no memory for is not shown. */
static void show(void *user, const char *text, size_t size) {
  page *p = user;
  char *all = realloc(p->printed, p->printed_size + size + 1);
  if (!all)
    return;
  memcpy(all + p->printed_size, text, size);
  p->printed = all;
  p->printed_size += size;
  all[p->printed_size] = '\0';
}

TO_PAGE(close) void cs_page_close(page *p) {
  celspan_lua_frame_drop(&p->frame);
  if (p->L)
    lua_close(p->L);
  celspan_context_destroy(p->context);
  free(p->printed);
  free(p);
}

/* The sandbox, in which scripts may read all files of the page. No thread can watch the clock. */
static celspan_status confine(page *p, double steps, double memory) {
  celspan_lua_limits limits = CELSPAN_LUA_LIMITS;
  limits.folders = (const char *const[]){"/"};
  limits.folder_count = 1;
  limits.printed = show;
  limits.user = p;
  limits.seconds = 0;
  limits.steps = steps > 0 ? (uint64_t)steps : limits.steps;
  limits.memory = memory > 0 ? (size_t)memory : limits.memory;
  return celspan_lua_sandbox(p->L, &limits);
}

/* steps, memory: as in celspan_lua_limits, of a run and of a frame; 0: the default. NULL: memory
 * is short. */
TO_PAGE(open) page *cs_page_open(double steps, double memory) {
  page *p = calloc(1, sizeof *p);
  if (!p)
    return NULL;
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  desc.picture_bytes = desc.defocus_bytes = CACHED_BYTES;
  bool is_open =
      celspan_context_create(&desc, &p->context) == CELSPAN_OK && (p->L = luaL_newstate());
  if (is_open)
    luaL_openlibs(p->L);
  if (is_open && celspan_lua_open(p->L, p->context) == CELSPAN_OK &&
      confine(p, steps, memory) == CELSPAN_OK)
    return p;
  cs_page_close(p);
  return NULL;
}

/* The value of a parameter, for the script that is run next. */
TO_PAGE(set) celspan_status cs_page_set(page *p, const char *name, const char *value) {
  return celspan_lua_set(p->L, name, value);
}

/* text: NULL: that of the file of this name. */
TO_PAGE(run)
celspan_status cs_page_run(page *p, const char *name, const char *text, size_t size) {
  lua_settop(p->L, 0);
  celspan_status status = text ? celspan_lua_run_text(p->L, name, text, size, 0, NULL)
                               : celspan_lua_run(p->L, name, 0, NULL);
  p->film = CELSPAN_FILM;
  return status == CELSPAN_OK ? celspan_lua_film(p->L, 1, &p->film) : status;
}

/* Of the film: its width and height, its first frame, how many it has, and how many a second. Then
 * the bytes that celspan holds, and the most that it held. */
TO_PAGE(number) double cs_page_number(page *p, int which) {
  size_t bytes = 0, peak = 0;
  uint64_t blocks = 0;
  celspan_context_memory(p->context, &bytes, &peak, &blocks);
  const double all[] = {p->film.width,         p->film.height,        (double)p->film.first,
                        (double)p->film.count, p->film.frames_second, (double)bytes,
                        (double)peak};
  return which >= 0 && (size_t)which < sizeof all / sizeof *all ? all[which] : 0;
}

TO_PAGE(frame) celspan_status cs_page_frame(page *p, double number) {
  celspan_lua_frame_drop(&p->frame);
  p->frame = CELSPAN_FRAME_DESC;
  return celspan_lua_frame(p->L, 1, (int64_t)number, &p->frame);
}

static celspan_frame_desc sized(const page *p, int width, int height) {
  celspan_frame_desc frame = p->frame;
  frame.width = width;
  frame.height = height;
  frame.workers = 1;
  return frame;
}

/* rgba: four bytes a pixel, sRGB, with straight alpha. */
TO_PAGE(pixels)
celspan_status cs_page_pixels(page *p, int width, int height, void *rgba) {
  celspan_frame_desc frame = sized(p, width, height);
  return celspan_frame_pixels(p->context, &frame, NULL, rgba, (size_t)width * 4, NULL);
}

/* out: the digest that `celspan render --hash` prints. */
TO_PAGE(digest)
celspan_status cs_page_digest(page *p, int width, int height, uint64_t out[2]) {
  celspan_frame_desc frame = sized(p, width, height);
  return celspan_frame_digest(p->context, &frame, NULL, out);
}

TO_PAGE(error) const char *cs_page_error(page *p) { return celspan_context_error(p->context); }
TO_PAGE(printed) const char *cs_page_printed(page *p) { return p->printed ? p->printed : ""; }
