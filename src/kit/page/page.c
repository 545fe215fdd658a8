/* What engine.mjs calls: one film at a time, from a text.
 *
 *   open -> set ... -> run -> frame -> keep -> pixels, png, digest, at -> close
 *
 * Functions return a celspan_status, and after a failure `error` has the sentence.
 */
#include <lauxlib.h>
#include <lualib.h>
#include <stdlib.h>
#include <string.h>

#include "celspan/lua.h"
#include "common/hits.h"
#include "common/made.h"
#include "lua/bind/named.h"
#include "page/page.h"
#include "page/picture.h"

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
  free(p->png);
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

static int keep_callers(lua_State *L) {
  cs_named_keep_callers(L, true);
  return 0;
}

/* steps, memory: as in celspan_lua_limits, of a run and of a frame; 0: the default. cached: bytes
 * of pictures that are kept, and of what is defocused and mapped. NULL: memory is short. */
TO_PAGE(open) page *cs_page_open(double steps, double memory, double cached) {
  page *p = calloc(1, sizeof *p);
  if (!p)
    return NULL;
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  desc.picture_bytes = desc.defocus_bytes = (size_t)cached;
  bool is_open =
      celspan_context_create(&desc, &p->context) == CELSPAN_OK && (p->L = luaL_newstate());
  if (is_open)
    luaL_openlibs(p->L);
  is_open = is_open && celspan_lua_open(p->L, p->context) == CELSPAN_OK;
  if (is_open)
    lua_pushcfunction(p->L, keep_callers);
  if (is_open && lua_pcall(p->L, 0, 0, 0) == LUA_OK && confine(p, steps, memory) == CELSPAN_OK)
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

/* One of the parameters that the script has declared, from 0. */
TO_PAGE(parameter) celspan_status cs_page_parameter(page *p, int place) {
  p->parameter = CELSPAN_PARAMETER;
  return celspan_lua_parameter(p->L, (size_t)place, &p->parameter);
}

/* The sounds of the film, and one of them, from 0. */
TO_PAGE(sounds) celspan_status cs_page_sounds(page *p) {
  lua_settop(p->L, 1);
  p->sound_count = 0;
  return celspan_lua_sounds(p->L, 1, &p->sound_count);
}

TO_PAGE(sound) celspan_status cs_page_sound(page *p, int place) {
  p->sound = CELSPAN_SOUND;
  return celspan_lua_sound(p->L, 2, (size_t)place, &p->sound);
}

/* Of the film: its width and height, its first frame, how many it has, and how many a second. Then
 * the bytes that celspan holds, and the most that it held; and
 * whether the line of `keep` made anything. */
TO_PAGE(number) double cs_page_number(page *p, int which) {
  size_t bytes = 0, peak = 0;
  uint64_t blocks = 0;
  celspan_context_memory(p->context, &bytes, &peak, &blocks);
  const double all[] = {p->film.width,         p->film.height,        (double)p->film.first,
                        (double)p->film.count, p->film.frames_second, (double)bytes,
                        (double)peak,          (double)p->has_line};
  return which >= 0 && (size_t)which < sizeof all / sizeof *all ? all[which] : 0;
}

/* How many parameters there are, and of the one asked for its kind, its range and how many choices;
 * how many sounds, and of the one asked for its start, speed, gains, passages and duckers. */
TO_PAGE(fact) double cs_page_fact(page *p, int which) {
  const celspan_parameter *one = &p->parameter;
  const celspan_sound *sound = &p->sound;
  const double all[] = {(double)celspan_lua_parameter_count(p->L),
                        one->kind,
                        one->least,
                        one->most,
                        (double)one->choice_count,
                        (double)p->sound_count,
                        sound->start,
                        sound->speed,
                        sound->gain[0],
                        sound->gain[1],
                        (double)sound->passage_count,
                        (double)sound->ducker_count};
  return which >= 0 && (size_t)which < sizeof all / sizeof *all ? all[which] : 0;
}

/* Four numbers: of a passage of the sound asked for, or of one of its duckers. */
TO_PAGE(passage) const celspan_sound_passage *cs_page_passage(page *p, int place) {
  return &p->sound.passages[place];
}

TO_PAGE(ducker) const celspan_sound_ducker *cs_page_ducker(page *p, int place) {
  return &p->sound.duckers[place];
}

/* Of the parameter asked for its name, its default and what it is about; the path of the sound; the
 * version of celspan; the choices. */
TO_PAGE(text) const char *cs_page_text(page *p, int which) {
  const celspan_parameter *one = &p->parameter;
  const char *const all[] = {one->name, one->text, one->about, p->sound.path, celspan_version()};
  const int count = sizeof all / sizeof *all;
  const char *text = which < count ? all[which] : one->choices[which - count];
  return text ? text : "";
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

/* How pixels are coded: with straight alpha, or over black and dithered, as the program gives
 * frames to encoders. */
TO_PAGE(coding) void cs_page_coding(page *p, int is_video) {
  p->coding = CELSPAN_CODING;
  p->coding.depth = is_video ? CELSPAN_DEPTH_8_DITHER : CELSPAN_DEPTH_8;
  p->coding.alpha = is_video ? CELSPAN_ALPHA_PREMULTIPLIED : CELSPAN_ALPHA_STRAIGHT;
}

/* Of a part of the frame. rgba: four bytes a pixel, sRGB, as `coding` says. */
TO_PAGE(pixels)
celspan_status cs_page_pixels(page *p, int width, int height, int x, int y, int w, int h,
                              void *rgba) {
  celspan_frame_desc frame = sized(p, width, height);
  frame.crop_x = x;
  frame.crop_y = y;
  frame.crop_width = w;
  frame.crop_height = h;
  return celspan_frame_pixels(p->context, &frame, &p->coding, rgba, (size_t)w * 4, NULL);
}

/* out: the address and the size of a PNG, which lives until the next one is made or the page is
 * closed. */
TO_PAGE(png) celspan_status cs_page_png(page *p, int width, int height, size_t out[2]) {
  celspan_frame_desc frame = sized(p, width, height);
  celspan_status status = cs_picture_png(p->context, &frame, p->film.title, &p->png, &out[1]);
  out[0] = (size_t)p->png;
  return status;
}

/* out: the digest that `celspan render --hash` prints. */
TO_PAGE(digest)
celspan_status cs_page_digest(page *p, int width, int height, uint64_t out[2]) {
  celspan_frame_desc frame = sized(p, width, height);
  return celspan_frame_digest(p->context, &frame, NULL, out);
}

/* ---------------------------------------------------------------- lines of the script */

typedef struct lines {
  page *page;
  celspan_point point;
  const char *place; /* "film.lua:7" */
  cs_mark mark;      /* of the value that is looked at */
  bool is_found, lacks_memory;
  celspan_status status;
  luaL_Buffer list;
} lines;

/* Pushes "film.lua:7 in walk, from film.lua:12": where a value was made, and its callers. */
static void push_place(lua_State *L, cs_mark mark) {
  celspan_origin origin = cs_mark_origin(mark);
  luaL_checkstack(L, 4, "too many lines");
  cs_named_push_callers(L, mark.callers);
  lua_pushfstring(L, "%s:%d %s", origin.source, (int)origin.line, lua_tostring(L, -1));
  lua_remove(L, -2);
}

/* light userdata: lines. Runs protected: whether the mark is of the place. */
static int find_place(lua_State *L) {
  lines *all = lua_touserdata(L, 1);
  push_place(L, all->mark);
  const char *text = lua_tostring(L, -1);
  for (const char *at = strstr(text, all->place); at; at = strstr(at + 1, all->place)) {
    const char after = at[strlen(all->place)];
    all->is_found |= (at == text || at[-1] == ' ') && !(after >= '0' && after <= '9');
  }
  return 0;
}

/* Raises no error, which would pass over those who own what was found so far. */
static bool is_of_line(void *user, cs_mark mark) {
  lines *all = user;
  lua_State *L = all->page->L;
  all->mark = mark;
  all->is_found = false;
  lua_pushcfunction(L, find_place);
  lua_pushlightuserdata(L, all);
  if (lua_pcall(L, 1, 0, 0) != LUA_OK) {
    all->lacks_memory = true;
    lua_pop(L, 1);
  }
  return all->is_found;
}

/* light userdata: lines. Runs protected, as find_lines. */
static int keep_line(lua_State *L) {
  lines *all = lua_touserdata(L, 1);
  page *p = all->page;
  cs_made made = {.context = p->context, .is_made = is_of_line, .user = all};
  all->status =
      cs_made_keep(&made, (celspan_exposure *)p->frame.exposures, p->frame.exposure_count);
  p->has_line = made.is_any;
  return all->lacks_memory ? luaL_error(L, "out of memory") : 0;
}

static void add_line(void *user, const cs_hit *hit) {
  lines *all = user;
  push_place(all->page->L, hit->mark);
  luaL_addvalue(&all->list);
  luaL_addchar(&all->list, '\n');
}

static int find_lines(lua_State *L) {
  lines *all = lua_touserdata(L, 1);
  const cs_hits_wanted wanted = {.context = all->page->context,
                                 .frame = &all->page->frame,
                                 .point = all->point,
                                 .found = add_line,
                                 .user = all};
  luaL_buffinit(L, &all->list);
  all->status = cs_hits_find(&wanted);
  luaL_pushresult(&all->list);
  return 1;
}

/* Leaves the film and one more value on the stack. */
static celspan_status call(lines *all, lua_CFunction function) {
  lua_State *L = all->page->L;
  lua_settop(L, 1);
  lua_pushcfunction(L, function);
  lua_pushlightuserdata(L, all);
  if (lua_pcall(L, 1, 1, 0) == LUA_OK)
    return all->status;
  return celspan_context_fail(all->page->context, CELSPAN_NO_MEMORY,
                              "there is no memory for lines");
}

/* Leaves in the frame only what a line made, itself or by what it called. place: "film.lua:7" */
TO_PAGE(keep) celspan_status cs_page_keep(page *p, const char *place) {
  return call(&(lines){.page = p, .place = place}, keep_line);
}

/* The places of the objects at a point, from the front, each on a line of its own; NULL: it failed.
 * x, y: film units. */
TO_PAGE(at) const char *cs_page_at(page *p, double x, double y) {
  lines all = {.page = p, .point = {x, y}};
  return call(&all, find_lines) == CELSPAN_OK ? lua_tostring(p->L, -1) : NULL;
}

TO_PAGE(error) const char *cs_page_error(page *p) { return celspan_context_error(p->context); }
TO_PAGE(printed) const char *cs_page_printed(page *p) { return p->printed ? p->printed : ""; }
