/* The order of characters and the ends of lines, against the tests of the Unicode Consortium if the
 * package unicode-data is installed. The libraries implement another version of Unicode than the
 * tests: differences are counted, and must not become more.
 */
#include <stdio.h>
#include <stdlib.h>

#include "celspan/text.h"
#include "readers/text/runs.h"
#include "readers/type/type_module.h"
#include "tests/support/check.h"

#define FOLDER "/usr/share/unicode/"
#define LONGEST 256
/* Breaks that libunibreak 1.1, which knows Unicode 6.0, puts elsewhere than Unicode 15: at marks
 * after spaces and dashes, at brackets of East Asia, before small kana (it lets a line begin
 * with one), at numbers after commas and signs, and in emoji, flags and Hebrew, whose rules are
 * newer. */
#define BREAKS 657

static const cs_type_functions *type;

/* The numbers in base `base` at *text, up to a ';' or the end of the line; *text is then behind it.
 * An "x" is UINT32_MAX. Signs of the break tests are skipped. */
static size_t read_numbers(char **text, int base, uint32_t numbers[LONGEST]) {
  size_t count = 0;
  char *at = *text;
  while (*at && *at != ';' && *at != '\n' && *at != '#') {
    char *end = at;
    unsigned long number = strtoul(at, &end, base);
    if (*at == 'x')
      end = at + 1, number = UINT32_MAX;
    if (end > at && count < LONGEST)
      numbers[count++] = (uint32_t)number;
    at = end > at ? end : at + 1;
  }
  *text = *at == ';' ? at + 1 : at;
  return count;
}

/* One line of BidiCharacterTest.txt: characters; direction (0 left to right, 1 right to left, 2 by
 * the first letter); the paragraph's level; levels; order. */
static bool agrees_in_order(char *line) {
  uint32_t characters[LONGEST], direction[LONGEST], base[LONGEST], levels[LONGEST], order[LONGEST];
  size_t count = read_numbers(&line, 16, characters);
  read_numbers(&line, 10, direction);
  read_numbers(&line, 10, base);
  read_numbers(&line, 10, levels);
  size_t seen = read_numbers(&line, 10, order), visible = 0;
  uint8_t embeddings[LONGEST], found;
  const celspan_direction directions[] = {CELSPAN_DIRECTION_LTR, CELSPAN_DIRECTION_RTL,
                                          CELSPAN_DIRECTION_AUTO};
  if (type->embeddings(characters, count, directions[direction[0]], embeddings, &found) ||
      type->end_line(characters, 0, count, found, embeddings) || found != base[0])
    return false;
  cs_text_run runs[LONGEST];
  for (size_t i = 0; i < count; i++) {
    if (levels[i] == UINT32_MAX)
      continue; /* an invisible character: it has no place in the order */
    if (levels[i] != embeddings[i])
      return false;
    runs[visible++] = (cs_text_run){i, i + 1, embeddings[i]};
  }
  cs_runs_reorder(runs, visible);
  for (size_t i = 0; i < visible; i++)
    if (i >= seen || runs[i].begin != order[i])
      return false;
  return visible == seen;
}

/* One line of LineBreakTest.txt: signs of division and of multiplication between characters. */
static bool agrees_in_breaks(char *line) {
  uint32_t characters[LONGEST];
  uint8_t breaks[LONGEST], expected[LONGEST];
  char *at = line;
  size_t count = read_numbers(&at, 16, characters), place = 0;
  for (const char *sign = line; *sign && *sign != '#' && place <= count; sign++)
    if (strncmp(sign, "\xc3\xb7", 2) == 0 || strncmp(sign, "\xc3\x97", 2) == 0) {
      if (place > 0)
        expected[place - 1] = strncmp(sign, "\xc3\xb7", 2) == 0;
      place++;
    }
  if (type->breaks(characters, count, NULL, breaks) != CELSPAN_OK)
    return false;
  for (size_t i = 0; i + 1 < count; i++)
    if ((breaks[i] != CS_TYPE_NO_BREAK) != expected[i])
      return false;
  return true;
}

/* most: how many cases may differ. */
static void run_file(const char *name, bool (*agrees)(char *line), unsigned most) {
  char path[200], line[4000];
  snprintf(path, sizeof path, FOLDER "%s", name);
  FILE *file = fopen(path, "r");
  if (!file) {
    check_skip(path);
    return;
  }
  unsigned cases = 0, differing = 0;
  while (fgets(line, sizeof line, file)) {
    if (line[0] == '#' || line[0] == '\n' || line[0] == '\r')
      continue;
    cases++;
    differing += !agrees(line);
  }
  fclose(file);
  printf("%s: %u cases, %u differ\n", name, cases, differing);
  CHECK(cases > 7000);
  CHECK(differing <= most);
}

static void check_nothing(void) {
  uint8_t embeddings[1], base;
  CHECK(type->embeddings(NULL, 0, CELSPAN_DIRECTION_RTL, embeddings, &base) == CELSPAN_OK);
  CHECK(base == 1);
  CHECK(type->end_line(NULL, 0, 0, 0, embeddings) == CELSPAN_OK);
  CHECK(type->breaks(NULL, 0, NULL, embeddings) == CELSPAN_OK);
}

int main(void) {
  celspan_context *context;
  const cs_type_module *module;
  if (!CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK) ||
      !CHECK(cs_type_module_load(context, "a test", &module) == CELSPAN_OK))
    return check_done();
  type = module->type;
  check_nothing();
  run_file("BidiCharacterTest.txt", agrees_in_order, 0);
  run_file("auxiliary/LineBreakTest.txt", agrees_in_breaks, BREAKS);
  celspan_context_destroy(context);
  return check_done();
}
