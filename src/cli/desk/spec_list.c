#include "cli/desk/spec_list.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/open.h"

#define ENDING "_spec.lua"

enum { FOLDERS_DEEP = 32, PATH_SIZE = 4096 };

static celspan_status add_file(cs_spec_list *list, celspan_context *context, const char *path) {
  size_t size = strlen(path) + 1;
  CS_TRY(cs_mem_reserve(context, (void **)&list->paths, &list->capacity, list->count + 1,
                        sizeof *list->paths));
  char *copy = cs_mem_resize(context->memory, NULL, 0, size);
  if (!copy)
    return cs_fail_memory(context);
  memcpy(copy, path, size);
  list->paths[list->count++] = copy;
  return CELSPAN_OK;
}

static bool is_spec(const char *name) {
  size_t length = strlen(name), ending = strlen(ENDING);
  return length > ending && strcmp(name + length - ending, ENDING) == 0;
}

static bool is_folder(const char *path) {
  struct stat facts;
  return stat(path, &facts) == 0 && S_ISDIR(facts.st_mode);
}

static celspan_status fail_folder(celspan_context *context, const char *folder) {
  return cs_fail(context, CELSPAN_INPUT, "%s: cannot be read: %s", folder, strerror(errno));
}

/* Recursion ends: at most FOLDERS_DEEP. */
static celspan_status add_folder(cs_spec_list *list, celspan_context *context, const char *folder,
                                 int depth) {
  DIR *open = depth < FOLDERS_DEEP ? opendir(folder) : NULL;
  if (!open && depth < FOLDERS_DEEP)
    return fail_folder(context, folder);
  celspan_status status = CELSPAN_OK;
  for (struct dirent *entry; open && status == CELSPAN_OK && (entry = cs_open_entry(open));) {
    char path[PATH_SIZE];
    int length = snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
    if (entry->d_name[0] == '.' || length >= (int)sizeof path)
      continue;
    if (is_folder(path))
      status = add_folder(list, context, path, depth + 1);
    else if (is_spec(entry->d_name))
      status = add_file(list, context, path);
  }
  if (open && status == CELSPAN_OK && errno)
    status = fail_folder(context, folder);
  if (open)
    closedir(open);
  return status;
}

static int compare(const void *a, const void *b) {
  return strcmp(*(char *const *)a, *(char *const *)b);
}

celspan_status cs_spec_list_add(cs_spec_list *list, celspan_context *context, const char *path) {
  size_t before = list->count;
  struct stat facts;
  if (stat(path, &facts) != 0)
    return cs_fail(context, CELSPAN_INPUT, "%s: cannot be opened: %s", path, strerror(errno));
  if (!S_ISDIR(facts.st_mode))
    return add_file(list, context, path);
  CS_TRY(add_folder(list, context, path, 0));
  if (list->count == before)
    return cs_fail(context, CELSPAN_INPUT, "%s: no file in it ends in " ENDING, path);
  qsort(list->paths + before, list->count - before, sizeof *list->paths, compare);
  return CELSPAN_OK;
}

void cs_spec_list_finish(cs_spec_list *list, celspan_context *context) {
  for (size_t i = 0; i < list->count; i++)
    cs_mem_free(context->memory, list->paths[i], strlen(list->paths[i]) + 1);
  cs_mem_free(context->memory, list->paths, list->capacity * sizeof *list->paths);
  *list = (cs_spec_list){0};
}
