/* The bytes of images: in an href itself, or in a file. */
#include "readers/svg/image.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error_text.h"
#include "base/hex.h"
#include "base/open.h"
#include "base/resolve.h"

/* ---------------------------------------------------------------- codes */

int cs_svg_image_unescape(const char *text) {
  int high = text[0] == '%' ? cs_hex_digit(text[1]) : -1;
  int low = high >= 0 ? cs_hex_digit(text[2]) : -1;
  return low >= 0 ? 16 * high + low : -1;
}

/* Reads the next byte of a URI; an escape such as %41 is one byte. */
static unsigned char take_byte(const char **text) {
  int escaped = cs_svg_image_unescape(*text);
  unsigned char byte = escaped >= 0 ? (unsigned char)escaped : (unsigned char)**text;
  *text += escaped >= 0 ? 3 : 1;
  return byte;
}

/* -1 for a character that is not a digit of base64. */
static int base64_digit(unsigned char c) {
  if (c >= 'A' && c <= 'Z')
    return c - 'A';
  if (c >= 'a' && c <= 'z')
    return c - 'a' + 26;
  if (c >= '0' && c <= '9')
    return c - '0' + 52;
  return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : -1;
}

/* Source: RFC 4648, 4. Space is skipped, and "=" ends the data. out has room for three quarters of
 * the text. */
static bool decode_base64(const char *text, cs_svg_image_data *out) {
  uint32_t bits = 0;
  int count = 0;
  while (*text) {
    unsigned char c = take_byte(&text);
    int digit = base64_digit(c);
    if (c == '=')
      return true;
    if (digit < 0 && !strchr(" \t\n\r\f", c))
      return false;
    if (digit < 0)
      continue;
    bits = bits << 6 | (uint32_t)digit;
    count += 6;
    if (count >= 8) {
      count -= 8;
      out->bytes[out->size++] = (unsigned char)(bits >> count);
    }
  }
  return true;
}

/* ---------------------------------------------------------------- URIs */

bool cs_svg_image_is_data(const char *href) { return strncasecmp(href, "data:", 5) == 0; }

celspan_status cs_svg_image_data_read(celspan_context *context, const char *href,
                                      cs_svg_image_data *out, bool *is_broken) {
  static const char mark[] = ";base64";
  const size_t mark_size = sizeof mark - 1;
  *out = (cs_svg_image_data){NULL, 0, 0};
  const char *comma = strchr(href, ',');
  *is_broken = !comma;
  if (!comma)
    return CELSPAN_OK;
  const char *text = comma + 1;
  while (comma > href && comma[-1] == ' ')
    comma--;
  bool is_coded =
      (size_t)(comma - href) >= mark_size && strncasecmp(comma - mark_size, mark, mark_size) == 0;
  out->capacity = strlen(text) + 1;
  out->bytes = cs_mem_resize(context->memory, NULL, 0, out->capacity);
  if (!out->bytes)
    return cs_fail_memory(context);
  if (is_coded)
    *is_broken = !decode_base64(text, out);
  while (!is_coded && *text)
    out->bytes[out->size++] = take_byte(&text);
  return CELSPAN_OK;
}

void cs_svg_image_data_finish(cs_svg_image_data *data, celspan_context *context) {
  cs_mem_free(context->memory, data->bytes, data->capacity);
  *data = (cs_svg_image_data){NULL, 0, 0};
}

/* ---------------------------------------------------------------- kinds */

bool cs_svg_image_is_drawing(const unsigned char *bytes, size_t size) {
  size_t at = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
  while (at < size && bytes[at] != 0 && strchr(" \t\n\r", bytes[at]))
    at++;
  return at < size && bytes[at] == '<';
}

/* ---------------------------------------------------------------- files */

/* Whether a name begins with a scheme, such as "http:". */
static bool has_scheme(const char *href) {
  size_t size = strcspn(href, ":/?#");
  return href[size] == ':';
}

static bool has_parent_folder(const char *name) {
  for (const char *at = name; *at;) {
    size_t size = strcspn(at, "/");
    if (size == 2 && at[0] == '.' && at[1] == '.')
      return true;
    at += size + (at[size] == '/');
  }
  return false;
}

/* The href without escapes such as %41; false if it is too long or contains a zero. */
static bool unescape(const char *href, char out[CS_SVG_PATH]) {
  size_t size = 0;
  while (*href && size + 1 < CS_SVG_PATH) {
    int escaped = cs_svg_image_unescape(href);
    if (escaped == 0)
      return false;
    out[size++] = escaped > 0 ? (char)escaped : *href;
    href += escaped > 0 ? 3 : 1;
  }
  out[size] = 0;
  return !*href && size > 0;
}

/* Appends the name to the folder of `file`. */
static bool join(const char *file, const char *name, char out[CS_SVG_PATH]) {
  const char *slash = strrchr(file, '/');
  size_t folder = slash ? (size_t)(slash - file) + 1 : 0;
  if (folder + strlen(name) + 1 > CS_SVG_PATH)
    return false;
  memcpy(out, file, folder);
  strcpy(out + folder, name);
  return true;
}

/* Records the error in errno about the file: the reason why nothing is drawn, or a failure of the
 * system. */
static celspan_status fail(celspan_context *context, const cs_svg_image_file *file,
                           const char **reason) {
  char text[CS_ERROR_TEXT_SIZE];
  *reason = strerror(errno);
  if (cs_open_is_about_file(errno))
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_INPUT, "%s: %s", file->path, cs_error_text(errno, text));
}

/* Whether an image lies below the folder of the drawing; links are followed. */
static celspan_status check_below(celspan_context *context, const char *file,
                                  const cs_svg_image_file *image, const char **reason) {
  char folder[CS_SVG_PATH];
  celspan_status status = CELSPAN_OK;
  *reason = "its name is too long";
  if (!join(file, ".", folder))
    return CELSPAN_OK;
  char *above = realpath(folder, NULL), *whole = above ? cs_resolve_path(image->path) : NULL;
  if (whole)
    *reason = cs_resolve_is_below(above, whole) ? NULL : "it lies outside of the drawing's folder";
  else
    status = fail(context, image, reason);
  free(above);
  free(whole);
  return status;
}

static celspan_status read_facts(celspan_context *context, int descriptor, cs_svg_image_file *out,
                                 const char **reason) {
  struct stat about;
  if (fstat(descriptor, &about) != 0)
    return fail(context, out, reason);
  if (!S_ISREG(about.st_mode)) {
    *reason = "it is not a file";
    return CELSPAN_OK;
  }
  out->size = (uint64_t)about.st_size;
  out->device = (uint64_t)about.st_dev;
  out->number = (uint64_t)about.st_ino;
  ssize_t got = cs_open_read_at(descriptor, out->head, sizeof out->head, 0);
  out->head_size = got > 0 ? (size_t)got : 0;
  return got < 0 ? fail(context, out, reason) : CELSPAN_OK;
}

static const char *refuse_name(const char *file, const char *name, char path[CS_SVG_PATH]) {
  if (name[0] == '/')
    return "its name is absolute; only files below the drawing's folder are read";
  if (has_parent_folder(name))
    return "its name has ..; only files below the drawing's folder are read";
  if (!file)
    return "the drawing has no folder";
  return join(file, name, path) ? NULL : "its name is too long";
}

static const char *refuse(const char *file, const char *href, char path[CS_SVG_PATH]) {
  char name[CS_SVG_PATH];
  if (has_scheme(href))
    return "it is an address; only files below the drawing's folder are read";
  if (!unescape(href, name))
    return "it is not a file name";
  return refuse_name(file, name, path);
}

celspan_status cs_svg_image_file_find(celspan_context *context, const char *file, const char *href,
                                      cs_svg_image_file *out, const char **reason) {
  *out = (cs_svg_image_file){.path = ""};
  *reason = refuse(file, href, out->path);
  if (*reason)
    return CELSPAN_OK;
  CS_TRY(check_below(context, file, out, reason));
  if (*reason)
    return CELSPAN_OK;
  int descriptor = cs_open_to_read(out->path);
  if (descriptor < 0)
    return fail(context, out, reason);
  celspan_status status = read_facts(context, descriptor, out, reason);
  close(descriptor);
  return status;
}

celspan_status cs_svg_image_file_load(celspan_context *context, const cs_svg_image_file *file,
                                      char **out) {
  *out = NULL;
  const char *reason;
  int descriptor = cs_open_to_read(file->path);
  if (descriptor < 0)
    return fail(context, file, &reason);
  size_t size = (size_t)file->size;
  char *bytes = cs_mem_resize(context->memory, NULL, 0, size + 1);
  ssize_t got = bytes ? cs_open_read_at(descriptor, bytes, size, 0) : -1;
  celspan_status status = !bytes    ? cs_fail_memory(context)
                          : got < 0 ? fail(context, file, &reason)
                                    : CELSPAN_OK;
  close(descriptor);
  if (got == (ssize_t)size)
    *out = bytes;
  else
    cs_mem_free(context->memory, bytes, size + 1);
  return status;
}
