/* Build tool: the headings of Markdown pages, for the search of `celspan help`.
 *
 *   headings OUT.txt PAGE.md ...
 *
 * Each line of OUT.txt is the name of a page, a heading, and the first paragraph below it, which
 * may be empty, separated by tabs. Code, lists, tables, pictures and quotations are no paragraphs.
 */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_MOST = 65536 };

typedef struct page {
  FILE *in, *out;
  const char *name;
  bool is_code;   /* the line is between two fences */
  bool is_wanted; /* the paragraph below the heading has not ended */
  bool is_begun;  /* the paragraph has a line */
} page;

static void stop(const char *what, const char *path) {
  fprintf(stderr, "headings: %s %s\n", what, path);
  exit(1);
}

/* The text of a heading; NULL: the line is not a heading. */
static const char *heading_of(const char *line) {
  size_t level = strspn(line, "#");
  return level > 0 && line[level] == ' ' ? line + level + 1 : NULL;
}

static void begin(page *p, const char *heading) {
  fprintf(p->out, "%s\t%s\t", p->name, heading);
  p->is_wanted = true;
  p->is_begun = false;
}

/* Adds a line to the paragraph, or ends the paragraph. */
static void add(page *p, const char *line) {
  bool is_prose = line[0] && !strchr(" -|>!*", line[0]) && !(line[0] >= '0' && line[0] <= '9');
  if (p->is_begun && !line[0])
    p->is_wanted = false;
  else if (p->is_begun || is_prose)
    p->is_begun = fprintf(p->out, "%s%s", p->is_begun ? " " : "", line) > 0;
}

static void take_line(page *p, const char *line) {
  bool is_fence = strncmp(line, "```", 3) == 0;
  const char *heading = p->is_code ? NULL : heading_of(line);
  if (is_fence)
    p->is_code = !p->is_code;
  if (heading) {
    fputc('\n', p->out);
    begin(p, heading);
  } else if (!is_fence && !p->is_code && p->is_wanted) {
    add(p, line);
  }
}

static void take_page(FILE *out, const char *path) {
  static char line[LINE_MOST];
  const char *slash = strrchr(path, '/');
  page p = {.in = fopen(path, "r"), .out = out, .name = slash ? slash + 1 : path};
  if (!p.in)
    stop("cannot open", path);
  while (fgets(line, sizeof line, p.in)) {
    if (strlen(line) == sizeof line - 1)
      stop("a line is too long:", path);
    line[strcspn(line, "\n")] = '\0';
    for (char *tab = line; (tab = strchr(tab, '\t'));)
      *tab = ' ';
    take_line(&p, line);
  }
  if (ferror(p.in))
    stop("cannot read", path);
  fclose(p.in);
}

int main(int count, char **arguments) {
  if (count < 3)
    stop("usage:", "headings OUT.txt PAGE.md ...");
  FILE *out = fopen(arguments[1], "w");
  if (!out)
    stop("cannot open", arguments[1]);
  for (int i = 2; i < count; i++)
    take_page(out, arguments[i]);
  fputc('\n', out);
  if (fclose(out) != 0)
    stop("cannot write", arguments[1]);
  return 0;
}
