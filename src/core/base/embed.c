/* Build tool: files as a table of their bytes, each ended by a zero.
 *
 *   embed OUT.c HEADER TABLE FILE ...   the names in the table are those of the files without
 *                                       folders; HEADER declares cs_built_in and the table
 */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void stop(const char *what, const char *path) {
  fprintf(stderr, "embed: %s %s\n", what, path);
  exit(1);
}

static bool is_text(const char *path) {
  static const char *const others[] = {".luac", ".ttf", ".wav"};
  const char *dot = strrchr(path, '.');
  for (size_t i = 0; dot && i < sizeof others / sizeof *others; i++)
    if (strcmp(dot, others[i]) == 0)
      return false;
  return true;
}

/* The bytes of a file and the final zero, as an initialiser. */
static void write_bytes(FILE *out, const char *path) {
  FILE *in = fopen(path, "rb");
  if (!in)
    stop("cannot open", path);
  long count = 0;
  fputs("{", out);
  for (int c; (c = getc(in)) != EOF; count++) {
    if (c == 0 && is_text(path))
      stop("not a text:", path);
    fprintf(out, "%s%d,", count % 24 ? "" : "\n  ", c);
  }
  if (ferror(in) || count == 0)
    stop("cannot read", path);
  fclose(in);
  fputs(" 0};\n", out);
}

static const char *name_of(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

static void write_table(FILE *out, const char *header, const char *table, int count, char **paths) {
  fprintf(out, "#include \"%s\"\n\n", header);
  for (int i = 0; i < count; i++) {
    fprintf(out, "static const unsigned char text_%d[] = ", i);
    write_bytes(out, paths[i]);
  }
  fprintf(out, "\nconst cs_built_in %s[] = {\n", table);
  for (int i = 0; i < count; i++)
    fprintf(out, "  {\"%s\", (const char *)text_%d, sizeof text_%d - 1},\n", name_of(paths[i]), i,
            i);
  fprintf(out, "  {0}};\n");
}

int main(int argument_count, char **arguments) {
  if (argument_count < 5)
    stop("usage:", "embed OUT.c HEADER TABLE FILE ...");
  FILE *out = fopen(arguments[1], "w");
  if (!out)
    stop("cannot open", arguments[1]);
  fprintf(out, "/* Made by embed.c; do not edit. */\n");
  write_table(out, arguments[2], arguments[3], argument_count - 4, arguments + 4);
  if (fclose(out) != 0)
    stop("cannot write", arguments[1]);
  return 0;
}
