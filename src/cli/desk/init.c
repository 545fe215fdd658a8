/* celspan init NAME: a folder with a film that renders and tests that pass.
 *
 *   project/ texts in the program --@NAME@, @ANNOTATIONS@ replaced--> NAME/...
 *
 * Nothing that is there is replaced: the folder must be new or empty. The picture that the spec
 * compares the film with is rendered from the film itself, so that the tests pass from the start.
 */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "base/open.h"
#include "cli/desk/project.h"
#include "cli/script.h"
#include "cli/verbs.h"
#include "cli/view.h"
#include "output/file.h"

enum { PATH_SIZE = 4096, NAME_MOST = 100 };

typedef struct project_file {
  const char *path; /* in the project */
  const unsigned char *text;
} project_file;

static const project_file FILES[] = {
    {"film.lua", cs_project_film},           {"walk.txt", cs_project_sheet},
    {"spec/film_spec.lua", cs_project_spec}, {"README.md", cs_project_readme},
    {".luarc.json", cs_project_luarc},       {".luacheckrc", cs_project_luacheckrc},
    {".busted", cs_project_busted},          {".gitignore", cs_project_gitignore},
};

enum { FILE_COUNT = sizeof FILES / sizeof FILES[0] };

/* The name of the film: the last part of the path. It goes into Lua and Markdown as it is. */
static const char *film_name(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

static cs_exit refuse_name(const char *path) {
  const char *name = film_name(path);
  size_t length = strlen(name);
  size_t plain = strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.");
  if (length == 0 || length > NAME_MOST || plain != length || name[0] == '.')
    return cs_report_usage(
        "'%s' is no name for a film: letters, digits, '_', '-' and '.', not first "
        "a '.'",
        path);
  return strlen(path) < PATH_SIZE / 2 ? CS_EXIT_OK
                                      : cs_report_usage("'%.60s...' is too long a path", path);
}

static cs_exit refuse_full(const char *path) {
  DIR *folder = opendir(path);
  if (!folder && errno == ENOENT)
    return CS_EXIT_OK;
  if (!folder) {
    cs_report_error("%s: cannot be a folder for the film: %s", path, strerror(errno));
    return CS_EXIT_OUTPUT;
  }
  bool is_empty = true;
  for (struct dirent *entry; is_empty && (entry = cs_open_entry(folder));)
    is_empty = strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0;
  int error = is_empty ? errno : 0;
  closedir(folder);
  if (error)
    cs_report_error("%s: cannot be read: %s", path, strerror(error));
  if (error || is_empty)
    return error ? CS_EXIT_OUTPUT : CS_EXIT_OK;
  cs_report_error("%s: there is something in it already; choose another name", path);
  return CS_EXIT_OUTPUT;
}

/* Writes a text with its marks replaced. */
static celspan_status write_text(cs_file *file, celspan_context *context, const char *text,
                                 const char *name) {
  static const char name_mark[] = "@NAME@", folder_mark[] = "@ANNOTATIONS@";
  while (*text) {
    bool is_name = strncmp(text, name_mark, strlen(name_mark)) == 0;
    bool is_folder = strncmp(text, folder_mark, strlen(folder_mark)) == 0;
    const char *next = text[0] == '@' ? strchr(text + 1, '@') : strchr(text, '@');
    size_t size = next ? (size_t)(next - text) : strlen(text);
    const char *with = is_name ? name : CS_ANNOTATIONS;
    if (is_name || is_folder) {
      CS_TRY(cs_file_write(file, context, with, strlen(with)));
      text += is_name ? strlen(name_mark) : strlen(folder_mark);
      continue;
    }
    CS_TRY(cs_file_write(file, context, text, size));
    text += size;
  }
  return CELSPAN_OK;
}

static celspan_status write_file(celspan_context *context, const char *folder,
                                 const project_file *source) {
  char path[PATH_SIZE];
  cs_file *file;
  snprintf(path, sizeof path, "%s/%s", folder, source->path);
  CS_TRY(cs_file_create(context, NULL, path, &file));
  celspan_status status = write_text(file, context, (const char *)source->text, film_name(folder));
  if (status == CELSPAN_OK)
    return cs_file_commit(file, context);
  cs_file_discard(file, context);
  return status;
}

/* The first frame as the spec's picture. */
static cs_exit write_picture(celspan_context *context, const char *folder) {
  char film[PATH_SIZE], picture[PATH_SIZE];
  snprintf(film, sizeof film, "%s/film.lua", folder);
  snprintf(picture, sizeof picture, "%s/spec/frame1.png", folder);
  const cs_request request = {.operands = {film}, .operand_count = 1};
  cs_script script;
  celspan_frame_desc frame;
  cs_exit outcome = cs_script_open(context, &request, &script);
  if (outcome == CS_EXIT_OK)
    outcome = cs_script_frame(&script, &request, &frame);
  if (outcome == CS_EXIT_OK) {
    celspan_file_desc file = CELSPAN_FILE_DESC;
    outcome =
        cs_script_failure(&script, celspan_frame_write(context, &frame, picture, &file, NULL));
  }
  cs_script_close(&script);
  return outcome;
}

cs_exit cs_verb_init(celspan_context *context, const cs_request *request) {
  const char *folder = request->operands[0];
  cs_exit outcome = refuse_name(folder);
  if (outcome == CS_EXIT_OK)
    outcome = refuse_full(folder);
  for (size_t i = 0; i < FILE_COUNT && outcome == CS_EXIT_OK; i++)
    outcome = cs_report_failure(context, write_file(context, folder, &FILES[i]), NULL);
  if (outcome == CS_EXIT_OK)
    outcome = write_picture(context, folder);
  if (outcome == CS_EXIT_OK)
    printf("%s: a film of two seconds, its sheet and its spec\n"
           "  cd %s\n  celspan test\n  celspan render film.lua -o out/film.mp4\n",
           folder, folder);
  return outcome;
}
