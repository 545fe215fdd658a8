/* What a film says of itself: its parameters, marks and sounds, and how other values change it.
 *
 *   cc facts.c $(pkg-config --cflags --libs celspan-lua) -o facts
 *   ./facts film.lua speed=2 title=Hello
 */
#include <celspan/lua.h>
#include <lauxlib.h>
#include <lualib.h>
#include <stdio.h>
#include <string.h>

#define TRY(call)                                                                                  \
  do {                                                                                             \
    celspan_status status_ = (call);                                                               \
    if (status_ != CELSPAN_OK)                                                                     \
      return status_;                                                                              \
  } while (0)

/* "speed=2" for the film that is run next. */
static celspan_status set(lua_State *L, const char *word) {
  char name[64];
  const char *value = strchr(word, '=');
  if (!value || (size_t)(value - word) >= sizeof name)
    return celspan_context_fail(celspan_lua_context(L), CELSPAN_BAD_ARGUMENT,
                                "'%s' is not NAME=VALUE", word);
  memcpy(name, word, (size_t)(value - word));
  name[value - word] = '\0';
  return celspan_lua_set(L, name, value + 1);
}

static celspan_status list_parameters(lua_State *L) {
  celspan_parameter parameter = CELSPAN_PARAMETER;
  for (size_t i = 0; i < celspan_lua_parameter_count(L); i++) {
    TRY(celspan_lua_parameter(L, i, &parameter));
    printf("parameter %s %s", parameter.name, parameter.text);
    if (parameter.kind == CELSPAN_PARAMETER_NUMBER)
      printf(" (%g to %g)", parameter.least, parameter.most);
    for (size_t k = 0; k < parameter.choice_count; k++)
      printf("%s%s", k ? ", " : " of ", parameter.choices[k]);
    printf("\n");
  }
  return CELSPAN_OK;
}

/* The film is on top of the stack. */
static celspan_status list_marks(lua_State *L) {
  celspan_film film = CELSPAN_FILM;
  celspan_mark mark = CELSPAN_MARK;
  TRY(celspan_lua_film(L, -1, &film));
  for (size_t i = 0; i < film.mark_count; i++) {
    TRY(celspan_lua_mark(L, -1, i, &mark));
    printf("mark %s %d-%d\n", mark.name, (int)mark.first, (int)mark.last);
  }
  return CELSPAN_OK;
}

static celspan_status list_sounds(lua_State *L) {
  size_t count;
  celspan_sound sound = CELSPAN_SOUND;
  TRY(celspan_lua_sounds(L, -1, &count)); /* now on top of the stack */
  for (size_t i = 0; i < count; i++) {
    TRY(celspan_lua_sound(L, -1, i, &sound));
    printf("sound %s from %g s on, %g times as loud\n", sound.path, sound.passages[0].begin,
           sound.gain[0]);
  }
  lua_pop(L, 1);
  return CELSPAN_OK;
}

static celspan_status list(lua_State *L, int count, char **arguments) {
  for (int i = 2; i < count; i++)
    TRY(set(L, arguments[i]));
  TRY(celspan_lua_run(L, arguments[1], 0, NULL));
  TRY(list_parameters(L));
  TRY(list_marks(L));
  return list_sounds(L);
}

int main(int count, char **arguments) {
  celspan_context *context = NULL;
  celspan_status status = CELSPAN_BAD_ARGUMENT;
  if (count < 2) {
    fprintf(stderr, "usage: facts SCRIPT [NAME=VALUE ...]\n");
    return 2;
  }
  lua_State *L = luaL_newstate();
  if (L && celspan_context_create(NULL, &context) == CELSPAN_OK) {
    luaL_openlibs(L);
    status = celspan_lua_open(L, context);
    if (status == CELSPAN_OK)
      status = list(L, count, arguments);
    if (status != CELSPAN_OK)
      fprintf(stderr, "facts: %s\n", celspan_context_error(context));
  }
  if (L)
    lua_close(L); /* before its context */
  celspan_context_destroy(context);
  return status != CELSPAN_OK;
}
