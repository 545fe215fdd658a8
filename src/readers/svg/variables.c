#include "readers/svg/variables.h"

#include <string.h>

#include "readers/svg/values.h"

#define LONGEST 4096 /* bytes of a value that is filled */
#define DEEPEST 16   /* variables in the values of variables */
#define MOST 1000    /* variables in one value and theirs */

typedef struct filling {
  const cs_svg_variable *list;
  char text[LONGEST];
  size_t size;
  int depth, count;
} filling;

static void *take(cs_svg_variables *made, size_t size) {
  made->used += size;
  return made->used <= CS_SVG_VARIABLE_BYTES ? cs_arena_take(made->context, made->arena, size)
                                             : NULL;
}

static celspan_status fail(const cs_svg_variables *made) {
  return made->used <= CS_SVG_VARIABLE_BYTES
             ? CELSPAN_NO_MEMORY
             : cs_fail(made->context, CELSPAN_LIMIT,
                       "the variables of the style sheets take more than %zu bytes",
                       CS_SVG_VARIABLE_BYTES);
}

celspan_status cs_svg_variable_add(cs_svg_variables *made, const char *name, const char *value,
                                   const cs_svg_variable **list) {
  cs_svg_variable *added = take(made, sizeof *added);
  if (!added)
    return fail(made);
  *added = (cs_svg_variable){name, value, *list};
  *list = added;
  return CELSPAN_OK;
}

static const char *find(const cs_svg_variable *list, const char *name, size_t size) {
  for (; list; list = list->next)
    if (strncmp(list->name, name, size) == 0 && list->name[size] == 0)
      return list->value;
  return NULL;
}

/* The ')' that closes the parenthesis around `text`, or the end. */
static const char *closing(const char *text, const char *end) {
  int depth = 0;
  for (; text < end && (depth > 0 || *text != ')'); text++)
    depth += (*text == '(') - (*text == ')');
  return text;
}

/* Appends [text, end) with its variables filled in. Recursion: DEEPEST. */
static bool append(filling *f, const char *text, const char *end);

/* The text between the parentheses of var(). */
static bool append_variable(filling *f, const char *text, const char *end) {
  while (text < end && cs_svg_is_space(*text))
    text++;
  const char *name_end = text;
  while (name_end < end && *name_end != ',' && !cs_svg_is_space(*name_end))
    name_end++;
  const char *comma = memchr(name_end, ',', (size_t)(end - name_end));
  const char *value = find(f->list, text, (size_t)(name_end - text));
  if (f->depth >= DEEPEST || f->count++ >= MOST || (!value && !comma))
    return false;
  f->depth++;
  bool is_filled = value ? append(f, value, value + strlen(value)) : append(f, comma + 1, end);
  f->depth--;
  return is_filled;
}

static bool append(filling *f, const char *text, const char *end) {
  while (text < end) {
    if (end - text > 4 && strncmp(text, "var(", 4) == 0) {
      const char *close = closing(text + 4, end);
      if (close == end || !append_variable(f, text + 4, close))
        return false;
      text = close + 1;
    } else if (f->size + 1 < sizeof f->text) {
      f->text[f->size++] = *text++;
    } else {
      return false;
    }
  }
  return true;
}

celspan_status cs_svg_variable_fill(cs_svg_variables *made, const cs_svg_variable *list,
                                    const char *value, const char **out) {
  filling f = {.list = list};
  *out = NULL;
  if (!append(&f, value, value + strlen(value)))
    return CELSPAN_OK;
  char *text = take(made, f.size + 1);
  if (!text)
    return fail(made);
  memcpy(text, f.text, f.size);
  text[f.size] = 0;
  *out = text;
  return CELSPAN_OK;
}
