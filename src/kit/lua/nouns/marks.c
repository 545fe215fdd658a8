/* The marks of a film: names for frames, in one piece of memory that Lua owns. */
#include <stdlib.h>
#include <string.h>

#include "lua/bind/userdata.h"
#include "lua/nouns/sounds.h"

enum { MOST_NAME = 255, MOST_MARKS = 100000 };

/* `--frames` must not mistake the name for a number or a time, and must be able to find the end of
 * the name. */
static bool is_name(const char *name, size_t length) {
  if (length == 0 || length > MOST_NAME || strlen(name) != length || strpbrk(name, ",:"))
    return false;
  for (size_t i = 0; i < length; i++)
    if ((unsigned char)name[i] < ' ' || name[i] == 127)
      return false;
  return !strchr("-0123456789 ", name[0]) && name[length - 1] != ' ';
}

/* Whether the value on top of the stack is a frame of the film. */
static bool read_frame(lua_State *L, int64_t first, int64_t count, int64_t *out) {
  int is_whole;
  *out = lua_tointegerx(L, -1, &is_whole);
  return is_whole && lua_type(L, -1) == LUA_TNUMBER && *out >= first && *out <= first + count - 1;
}

/* Reads the frame, or the first and the last one, on top of the stack. */
static bool read_frames(lua_State *L, int64_t first, int64_t count, cs_film_mark *out) {
  out->has_last = lua_istable(L, -1);
  if (!out->has_last)
    return read_frame(L, first, count, &out->frame);
  lua_rawgeti(L, -1, 1);
  bool is_good = read_frame(L, first, count, &out->frame);
  lua_pop(L, 1);
  lua_rawgeti(L, -1, 2);
  is_good = is_good && read_frame(L, first, count, &out->last) && out->last >= out->frame;
  lua_pop(L, 1);
  return is_good;
}

/* Raises an error unless the key on top of the stack is a name and the value is a frame, or two
 * frames. */
static void check_mark(const cs_form *film, int64_t first, int64_t count) {
  lua_State *L = film->L;
  size_t length = 0;
  cs_film_mark mark;
  const char *name = lua_type(L, -2) == LUA_TSTRING ? lua_tolstring(L, -2, &length) : NULL;
  if (!name)
    cs_form_fail(film, "marks must be { title = 1, chase = 49 }, got %s as a name",
                 cs_userdata_type(L, -2));
  if (!is_name(name, length))
    cs_form_fail(film,
                 "mark %s: a name has 1 to 255 bytes, begins with a letter, and has no "
                 "comma and no colon",
                 cs_userdata_shown(L, -2));
  if (read_frames(L, first, count, &mark))
    return;
  if (lua_istable(L, -1))
    cs_form_fail(film, "mark \"%s\" must be {first, last}, frames of the film, %I to %I", name,
                 (LUAI_UACINT)first, (LUAI_UACINT)(first + count - 1));
  cs_form_fail(film, "mark \"%s\" must be a frame of the film, %I to %I, got %s", name,
               (LUAI_UACINT)first, (LUAI_UACINT)(first + count - 1),
               lua_type(L, -1) == LUA_TNUMBER ? cs_form_digits(L, lua_tonumber(L, -1))
                                              : cs_userdata_type(L, -1));
}

static int compare(const void *a, const void *b) {
  const cs_film_mark *x = a, *y = b;
  if (x->frame != y->frame)
    return x->frame < y->frame ? -1 : 1;
  return strcmp(x->name, y->name);
}

/* One piece of memory: a count, the marks, their names. */
typedef struct store {
  size_t count;
  cs_film_mark marks[];
} store;

/* Fills the store on top of the stack from the table below it. */
static void fill(lua_State *L, int64_t first, int64_t count, store *out) {
  int table = lua_gettop(L) - 1;
  char *names = (char *)(out->marks + out->count);
  cs_film_mark *mark = out->marks;
  for (lua_pushnil(L); lua_next(L, table); lua_pop(L, 1)) {
    size_t length;
    const char *name = lua_tolstring(L, -2, &length);
    memcpy(names, name, length + 1);
    mark->name = names;
    (void)read_frames(L, first, count, mark++);
    names += length + 1;
  }
  qsort(out->marks, out->count, sizeof *out->marks, compare);
}

void cs_marks_push(const cs_form *film, int64_t first, int64_t count) {
  lua_State *L = film->L;
  size_t marks = 0, bytes = 0;
  int type = cs_form_get(film, "marks");
  if (type == LUA_TNIL)
    return;
  if (type != LUA_TTABLE)
    cs_form_fail(film, "field 'marks' must be a table { title = 1, chase = 49 }, got %s",
                 cs_userdata_type(L, -1));
  for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1), marks++) {
    check_mark(film, first, count);
    bytes += lua_rawlen(L, -2) + 1;
  }
  if (marks > MOST_MARKS)
    cs_form_fail(film, "field 'marks' has more than %d marks", MOST_MARKS);
  store *out = lua_newuserdatauv(L, sizeof *out + marks * sizeof *out->marks + bytes, 0);
  out->count = marks;
  fill(L, first, count, out);
  lua_remove(L, -2);
}

const cs_film_mark *cs_marks_read(lua_State *L, int index, size_t *count) {
  const store *marks = lua_touserdata(L, index);
  *count = marks ? marks->count : 0;
  return marks ? marks->marks : NULL;
}
