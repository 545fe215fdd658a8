/* Build tool: a text as an array of bytes, ended by a zero.
 *
 *   embed_page OUT.c IN NAME
 */
#include <stdio.h>
#include <stdlib.h>

static FILE *open_or_stop(const char *path, const char *mode) {
  FILE *file = fopen(path, mode);
  if (!file) {
    fprintf(stderr, "embed_page: cannot open %s\n", path);
    exit(1);
  }
  return file;
}

int main(int argument_count, char **arguments) {
  if (argument_count != 4) {
    fputs("usage: embed_page OUT.c IN NAME\n", stderr);
    return 1;
  }
  FILE *in = open_or_stop(arguments[2], "rb"), *out = open_or_stop(arguments[1], "w");
  fprintf(out, "/* Made by embed_page.c; do not edit. */\n");
  fprintf(out, "extern const unsigned char %s[];\nconst unsigned char %s[] = {", arguments[3],
          arguments[3]);
  long count = 0;
  for (int c; (c = getc(in)) != EOF; count++)
    fprintf(out, "%s%d,", count % 24 ? "" : "\n  ", c);
  fprintf(out, " 0};\n");
  if (ferror(in) || count == 0 || fclose(out) != 0) {
    fprintf(stderr, "embed_page: %s could not be made\n", arguments[1]);
    return 1;
  }
  fclose(in);
  return 0;
}
