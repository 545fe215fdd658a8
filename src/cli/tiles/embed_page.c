/* Build tool: a text as an array of bytes, ended by a zero.
 *
 *   embed_page OUT.c IN NAME [MARK FILE]
 *
 * The mark, which must stand in IN once, is replaced by what FILE holds.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void stop(const char *what, const char *path) {
  fprintf(stderr, "embed_page: %s %s\n", what, path);
  exit(1);
}

/* The whole file as a text. */
static char *read_text(const char *path) {
  FILE *in = fopen(path, "rb");
  size_t size = 0, room = 1 << 16, got;
  char *text = malloc(room);
  if (!in || !text)
    stop("cannot open", path);
  while ((got = fread(text + size, 1, room - size - 1, in)) > 0) {
    size += got;
    if (room - size == 1 && !(text = realloc(text, room *= 2)))
      stop("no memory for", path);
  }
  if (ferror(in) || size == 0 || memchr(text, 0, size))
    stop("cannot read as a text", path);
  text[size] = 0;
  fclose(in);
  return text;
}

static long written;

static void write_bytes(FILE *out, const char *text, size_t size) {
  for (size_t i = 0; i < size; i++, written++)
    fprintf(out, "%s%d,", written % 24 ? "" : "\n  ", (unsigned char)text[i]);
}

static void write_with(FILE *out, const char *text, const char *mark, const char *path) {
  const char *at = strstr(text, mark);
  if (!at || strstr(at + 1, mark))
    stop("not there once:", mark);
  char *inner = read_text(path);
  write_bytes(out, text, (size_t)(at - text));
  write_bytes(out, inner, strlen(inner));
  write_bytes(out, at + strlen(mark), strlen(at + strlen(mark)));
  free(inner);
}

int main(int argument_count, char **arguments) {
  if (argument_count != 4 && argument_count != 6)
    stop("usage:", "embed_page OUT.c IN NAME [MARK FILE]");
  char *text = read_text(arguments[2]);
  FILE *out = fopen(arguments[1], "w");
  if (!out)
    stop("cannot open", arguments[1]);
  fprintf(out, "/* Made by embed_page.c; do not edit. */\n");
  fprintf(out, "extern const unsigned char %s[];\nconst unsigned char %s[] = {", arguments[3],
          arguments[3]);
  if (argument_count == 6)
    write_with(out, text, arguments[4], arguments[5]);
  else
    write_bytes(out, text, strlen(text));
  fprintf(out, " 0};\n");
  free(text);
  if (fclose(out) != 0)
    stop("cannot write", arguments[1]);
  return 0;
}
