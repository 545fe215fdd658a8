#include "base/module.h"

#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error_text.h"
#include "base/program.h"

#ifndef CELSPAN_MODULE_FOLDER
#define CELSPAN_MODULE_FOLDER "/usr/local/lib/celspan"
#endif

#define PATH_SIZE 4096
/* Bytes that must be free before libraries are loaded: some libraries end the process when they
 * lack memory. It must be a large block: when a smaller one is freed, glibc keeps blocks of its
 * size for later. */
#define ROOM ((size_t)32 << 20)
#define OPENED (RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)

/* Where a module may lie, relative to the folder of the object that contains this function: an
 * installed library or Lua module, a Lua module in the build tree, a test program; and
 * cs_program_libraries. A folder that ends with a slash is followed by the folder of the module's
 * sources. */
static const char *const folders[] = {
    "./", "../", "src/", "../src/", "celspan", "../../celspan", "../../src/", ".",
};

/* Where a module was searched for, and the first error of the system other than a missing file,
 * with the path: a module that may not be read is not a missing module. */
typedef struct module_search {
  char path[PATH_SIZE];
  int error;
  char unreadable[PATH_SIZE];
} module_search;

static bool note_error(module_search *search, const char *path) {
  if (search->error || errno == ENOENT || errno == ENOTDIR)
    return false;
  search->error = errno;
  snprintf(search->unreadable, PATH_SIZE, "%s", path);
  return false;
}

static bool is_readable(module_search *search) {
  return access(search->path, R_OK) == 0 || note_error(search, search->path);
}

/* The folder of the running object, without the final slash; false when it is not known. */
static bool own_folder(module_search *search, char path[PATH_SIZE]) {
  Dl_info info;
  static const char mark = 0;
  if (!dladdr(&mark, &info) || !info.dli_fname)
    return false;
  /* The main program is known by argv[0], which may be a bare name. */
  const char *name = strchr(info.dli_fname, '/') ? info.dli_fname : cs_program_path();
  char *whole = realpath(name, NULL);
  if (!whole)
    return note_error(search, name);
  int size = snprintf(path, PATH_SIZE, "%s", whole);
  free(whole);
  char *slash = size < PATH_SIZE ? strrchr(path, '/') : NULL;
  if (slash)
    *slash = 0;
  return slash;
}

static bool exists(module_search *search, const char *folder, const char *inner,
                   const cs_module_desc *desc) {
  size_t length = strlen(inner);
  const char *last = length > 0 && inner[length - 1] == '/' ? desc->folder : "";
  int size = snprintf(search->path, PATH_SIZE, "%s/%s%s/%s", folder, inner, last, desc->file);
  return size < PATH_SIZE && is_readable(search);
}

static const char *named_file(const cs_module_desc *desc) {
  const char *named = getenv(desc->override);
  return named && *named ? named : NULL;
}

static bool find(const cs_module_desc *desc, module_search *search) {
  const char *named = named_file(desc);
  if (named) {
    int size = snprintf(search->path, PATH_SIZE, "%s", named);
    return size < PATH_SIZE && is_readable(search);
  }
  char own[PATH_SIZE];
  if (own_folder(search, own)) {
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++)
      if (exists(search, own, folders[i], desc))
        return true;
    for (const char *const *library = cs_program_libraries; *library; library++)
      if (exists(search, own, *library, desc))
        return true;
  }
  return exists(search, CELSPAN_MODULE_FOLDER, "", desc);
}

/* An error of the system may pass, and another module would write other bytes in its place: after
 * one, the module is searched for a second time. */
static bool find_again(const cs_module_desc *desc, module_search *search) {
  if (!search->error || search->error == ENOMEM)
    return false;
  *search = (module_search){.error = 0};
  return find(desc, search);
}

static celspan_status fail_search(celspan_context *context, const cs_module_desc *desc,
                                  celspan_status failure, const module_search *search) {
  if (search->error == ENOMEM)
    return cs_fail_memory(context);
  char text[CS_ERROR_TEXT_SIZE];
  if (search->error)
    return cs_fail(
        context, failure,
        "%s needs the module %s, but %s cannot be read: %s; make it readable, or name another "
        "file in %s",
        desc->purpose, desc->file, search->unreadable, cs_error_text(search->error, text),
        desc->override);
  const char *named = named_file(desc);
  return cs_fail(context, failure,
                 "%s needs the module %s, which was not found%s%s: %s, or name the file in %s",
                 desc->purpose, desc->file, named ? " at " : "", named ? named : "", desc->advice,
                 desc->override);
}

/* The table of the module, which must have the version of this release. */
static celspan_status get_table(celspan_context *context, const cs_module_desc *desc,
                                uint32_t version, celspan_status failure, const char *path,
                                const void *(*entry)(void), const void **table) {
  const uint32_t *own = entry ? entry() : NULL;
  if (!own)
    return cs_fail(
        context, failure,
        "%s is not a module of this celspan (it lacks %s): %s, or name another file in %s", path,
        desc->symbol, desc->advice, desc->override);
  if (*own != version)
    return cs_fail(
        context, failure,
        "%s is of another version of celspan (%u, not %u): %s, or name another file in %s", path,
        *own, version, desc->advice, desc->override);
  *table = own;
  return CELSPAN_OK;
}

/* Opens the libraries under a module one by one, in the order of the list beside it, if there is
 * one. A library that is opened with another one looks up its names in all libraries under that
 * one: among the 280 of OpenImageIO this takes most of the time of loading. A library that cannot
 * be opened, or needs names that its own libraries lack, is left to the module. Returns false for
 * lack of memory. */
static bool open_libraries(const char *path) {
  char name[PATH_SIZE];
  int size = snprintf(name, PATH_SIZE, "%s.list", path);
  FILE *list = size < PATH_SIZE ? fopen(name, "re") : NULL;
  bool has_memory = true;
  while (list && has_memory && fgets(name, PATH_SIZE, list)) {
    name[strcspn(name, "\n")] = 0;
    errno = 0;
    has_memory = dlopen(name, OPENED) || errno != ENOMEM;
  }
  if (list)
    fclose(list);
  return has_memory;
}

/* Volatile, because compilers recognize memory that is allocated and freed at once, and leave out
 * both calls. */
static bool has_room(void) {
  void *volatile room = malloc(ROOM);
  free(room);
  return room;
}

/* If the loader has no memory for a name, it says that the file does not exist: it is called
 * twice. */
static void *open_object(const char *path) {
  void *handle = dlopen(path, OPENED);
  return handle ? handle : dlopen(path, OPENED);
}

static celspan_status load(celspan_context *context, const cs_module_desc *desc, uint32_t version,
                           celspan_status failure, const void **table) {
  module_search search = {.error = 0};
  if (!find(desc, &search) && !find_again(desc, &search))
    return fail_search(context, desc, failure, &search);
  if (!open_libraries(search.path))
    return cs_fail_memory(context);
  void *handle = open_object(search.path);
  if (!handle && !has_room())
    return cs_fail_memory(context);
  if (!handle)
    return cs_fail(
        context, failure,
        "%s needs the module %s, which cannot be loaded: %s: %s, or name another file in %s",
        desc->purpose, desc->file, dlerror(), desc->advice, desc->override);
  const void *(*entry)(void);
  void *symbol = dlsym(handle, desc->symbol);
  memcpy(&entry, &symbol, sizeof entry);
  celspan_status status = get_table(context, desc, version, failure, search.path, entry, table);
  dlclose(handle);
  return status;
}

/* If the other module is missing too, the first one is loaded again, for its error message. */
static celspan_status load_either(celspan_context *context, const cs_module_desc *desc,
                                  uint32_t version, celspan_status failure, const void **table) {
  celspan_status status = load(context, desc, version, failure, table);
  if (status == CELSPAN_OK || !desc->other || named_file(desc) || errno == ENOMEM)
    return status;
  status = load(context, desc->other, version, failure, table);
  return status == CELSPAN_OK ? status : load(context, desc, version, failure, table);
}

/* A failed allocation can be seen in errno, even if the loader gives another reason. */
celspan_status cs_module_load(celspan_context *context, const cs_module_desc *desc,
                              uint32_t version, celspan_status failure, const void **table) {
  errno = 0;
  celspan_status status =
      has_room() ? load_either(context, desc, version, failure, table) : cs_fail_memory(context);
  if (status == CELSPAN_OK || errno != ENOMEM)
    return status;
  return cs_fail(context, CELSPAN_NO_MEMORY, "out of memory in loading the module %s", desc->file);
}
