#include "base/module.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifndef CELSPAN_MODULE_FOLDER
#define CELSPAN_MODULE_FOLDER "/usr/local/lib/celspan"
#endif

#define PATH_SIZE 4096

/* Where a module may lie, relative to the folder of the object that contains this function: an
 * installed library or program, a Lua module in the build tree, a test program. A folder that ends
 * with a slash is followed by that of the module's sources. */
static const char *const folders[] = {
    "./",
    "../",
    "src/",
    "../src/",
    "celspan",
    "../../src/",
    "../lib/celspan",
    "../lib/x86_64-linux-gnu/celspan",
    "../lib64/celspan",
    ".",
};

/* The folder of the running object, without the final slash; false when it is not known. */
static bool own_folder(char path[PATH_SIZE]) {
  Dl_info info;
  static const char mark = 0;
  if (!dladdr(&mark, &info) || !info.dli_fname)
    return false;
  /* The main program is known by argv[0], which may be a bare name. */
  char resolved[PATH_SIZE];
  const char *name = info.dli_fname;
  if (!strchr(name, '/')) {
    ssize_t size = readlink("/proc/self/exe", resolved, sizeof resolved - 1);
    if (size < 0)
      return false;
    resolved[size] = 0;
    name = resolved;
  }
  char *whole = realpath(name, NULL);
  if (!whole)
    return false;
  int size = snprintf(path, PATH_SIZE, "%s", whole);
  free(whole);
  char *slash = size < PATH_SIZE ? strrchr(path, '/') : NULL;
  if (slash)
    *slash = 0;
  return slash;
}

static bool exists(char path[PATH_SIZE], const char *folder, const char *inner,
                   const cs_module_desc *desc) {
  size_t length = strlen(inner);
  const char *last = length > 0 && inner[length - 1] == '/' ? desc->folder : "";
  int size = snprintf(path, PATH_SIZE, "%s/%s%s/%s", folder, inner, last, desc->file);
  return size < PATH_SIZE && access(path, R_OK) == 0;
}

static bool find(const cs_module_desc *desc, char path[PATH_SIZE]) {
  const char *named = getenv(desc->override);
  if (named && *named) {
    snprintf(path, PATH_SIZE, "%s", named);
    return access(path, R_OK) == 0;
  }
  char own[PATH_SIZE];
  if (own_folder(own))
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++)
      if (exists(path, own, folders[i], desc))
        return true;
  return exists(path, CELSPAN_MODULE_FOLDER, "", desc);
}

celspan_status cs_module_load(celspan_context *context, const cs_module_desc *desc,
                              celspan_status failure, const void **table) {
  char path[PATH_SIZE];
  if (!find(desc, path)) {
    const char *named = getenv(desc->override);
    return cs_fail(context, failure,
                   "%s needs the module %s, which was not found%s%s: %s, or name the file in %s",
                   desc->purpose, desc->file, named && *named ? " at " : "",
                   named && *named ? named : "", desc->advice, desc->override);
  }
  void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (!handle)
    return cs_fail(context, failure, "%s needs a module that cannot be loaded: %s", desc->purpose,
                   dlerror());
  const void *(*entry)(void);
  void *symbol = dlsym(handle, desc->symbol);
  memcpy(&entry, &symbol, sizeof entry);
  const void *found = symbol ? entry() : NULL;
  dlclose(handle);
  if (!found)
    return cs_fail(context, failure, "%s is not a module of this celspan (it lacks %s)", path,
                   desc->symbol);
  *table = found;
  return CELSPAN_OK;
}
