#include "bind/lua_text.h"

#include <ctype.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/open.h"

enum { HEAD = 4096, ESCAPE = 27 };

/* Control codes other than white space and escape are in no source text. */
static bool is_binary(const char *head, size_t size) {
  for (size_t i = 0; i < size; i++) {
    unsigned char c = (unsigned char)head[i];
    if (c == 127 || (c < 32 && c != ESCAPE && !(c >= '\t' && c <= '\r')))
      return true;
  }
  return false;
}

/* "P6 640 360 ...", with white space or a comment before the width: PNM, which "P1 = 3" is not. */
static bool is_pnm(const char *head) {
  if (head[0] != 'P' || !head[1] || !strchr("123456fF", head[1]) ||
      !isspace((unsigned char)head[2]))
    return false;
  const char *next = head + 2 + strspn(head + 2, " \t\r\n");
  return isdigit((unsigned char)*next) || *next == '#';
}

static bool is_text_picture(const char *head) {
  return is_pnm(head) || strncmp(head, "#?RADIANCE", 10) == 0 || strncmp(head, "#?RGBE", 6) == 0;
}

bool cs_lua_text_accepts(const char *path) {
  char head[HEAD + 1];
  struct stat status;
  int descriptor = cs_open_to_read(path);
  bool is_file = descriptor >= 0 && fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  ssize_t size = is_file ? read(descriptor, head, HEAD) : 0;
  if (descriptor >= 0)
    close(descriptor);
  if (size <= 0 || head[0] == ESCAPE)
    return true;
  head[size] = '\0';
  return !is_binary(head, (size_t)size) && !is_text_picture(head);
}
