/* The bytes of images in files. */
#include "readers/svg/draw/image.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/address.h"
#include "common/resolve.h"
#include "inside/context.h"
#include "inside/files.h"

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
    int escaped = cs_address_unescape(href);
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
