#include "svg/image_file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "svg/image_data.h"

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

/* The href without its per cents; false when it is too long or holds a zero. */
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

/* Puts the name behind the folder of `file`. */
static bool join(const char *file, const char *name, char out[CS_SVG_PATH]) {
  const char *slash = strrchr(file, '/');
  size_t folder = slash ? (size_t)(slash - file) + 1 : 0;
  if (folder + strlen(name) + 1 > CS_SVG_PATH)
    return false;
  memcpy(out, file, folder);
  strcpy(out + folder, name);
  return true;
}

/* Whether a file lies below the folder of another, links followed. Both are there. */
static bool is_below(const char *file, const char *path) {
  char folder[CS_SVG_PATH];
  bool is_inside = false;
  if (!join(file, ".", folder))
    return false;
  char *above = realpath(folder, NULL), *whole = realpath(path, NULL);
  if (above && whole) {
    size_t size = strlen(above);
    is_inside = strncmp(whole, above, size) == 0 && (whole[size] == '/' || size == 1);
  }
  free(above);
  free(whole);
  return is_inside;
}

static const char *read_facts(int descriptor, cs_svg_image_file *out) {
  struct stat about;
  if (fstat(descriptor, &about) != 0 || !S_ISREG(about.st_mode))
    return "it is no file";
  out->size = (uint64_t)about.st_size;
  out->device = (uint64_t)about.st_dev;
  out->number = (uint64_t)about.st_ino;
  ssize_t got = pread(descriptor, out->head, sizeof out->head, 0);
  out->head_size = got > 0 ? (size_t)got : 0;
  return got < 0 ? strerror(errno) : NULL;
}

static const char *find_named(const char *file, const char *name, cs_svg_image_file *out) {
  if (name[0] == '/')
    return "its name is absolute; only files below the drawing's folder are read";
  if (has_parent_folder(name))
    return "its name has ..; only files below the drawing's folder are read";
  if (!file)
    return "the drawing has no folder";
  if (!join(file, name, out->path))
    return "its name is too long";
  /* NONBLOCK: opening a pipe that nobody writes to must not wait. */
  int descriptor = open(out->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0)
    return strerror(errno);
  const char *reason = is_below(file, out->path) ? read_facts(descriptor, out)
                                                 : "it lies outside of the drawing's folder";
  close(descriptor);
  return reason;
}

const char *cs_svg_image_file_find(const char *file, const char *href, cs_svg_image_file *out) {
  char name[CS_SVG_PATH];
  *out = (cs_svg_image_file){.path = ""};
  if (has_scheme(href))
    return "it is an address; only files below the drawing's folder are read";
  if (!unescape(href, name))
    return "its name is none of a file";
  return find_named(file, name, out);
}

celspan_status cs_svg_image_file_load(celspan_context *context, const cs_svg_image_file *file,
                                      char **out) {
  *out = NULL;
  int descriptor = open(file->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0)
    return CELSPAN_OK;
  size_t size = (size_t)file->size, done = 0;
  char *bytes = cs_mem_resize(context->memory, NULL, 0, size + 1);
  ssize_t got = bytes ? 1 : -1;
  while (done < size && got > 0) {
    got = pread(descriptor, bytes + done, size - done, (off_t)done);
    done += got > 0 ? (size_t)got : 0;
  }
  close(descriptor);
  if (!bytes)
    return cs_fail_memory(context);
  if (done == size)
    *out = bytes;
  else
    cs_mem_free(context->memory, bytes, size + 1);
  return CELSPAN_OK;
}
