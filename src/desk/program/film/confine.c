#include "program/film/confine.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "inside/context.h"
#include "inside/module.h"
#include "plugins/isolate/client.h"
#include "plugins/isolate/isolate.h"
#include "plugins/isolate/strict.h"
#include "process/interrupt.h"
#include "process/journal.h"

#define PICTURE_MEMORY ((size_t)1 << 30)
#define CACHE_MEMORY ((size_t)768 << 20)
#define MEMORY_LEAST ((size_t)1 << 20)
#define PICTURE_SECONDS 20

enum { PATH_SIZE = 4096 };

/* ---------------------------------------------------------------- memory */

/* The most memory that this process may hold (base/ceiling.h), which its context borrows; and the
 * same value before options changed it. Of that value the caches get a quarter; a decoder of
 * pictures gets a third of it, as much as the quarter that the process leaves free. */
static cs_ceiling ceiling;
static cs_control_group group;
static size_t budget = SIZE_MAX;

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

/* A number of bytes that a user gave; there may be more than addresses of 32 bits can reach. */
static size_t size_of(double bytes) { return bytes < (double)SIZE_MAX ? (size_t)bytes : SIZE_MAX; }

cs_exit cs_confine_memory(const cs_request *request, celspan_context_desc *desc) {
  const char *text = getenv("CELSPAN_MEMORY");
  double given = 0;
  int32_t cached = 0; /* MiB */
  if (text && text[0] && !cs_argument_bytes.read(&cs_argument_bytes, text, &given))
    return cs_report_usage("CELSPAN_MEMORY: '%s' is not %s", text, cs_argument_bytes.allowed);
  cs_machine_group(&group);
  cs_ceiling_init(&ceiling, &group, cs_machine_memory(), (uint64_t)given);
  budget = ceiling.most;
  cs_request_read(request, "--memory", &cached);
  size_t caches = cached > 0 ? size_of(ldexp(cached, 20)) : least(CACHE_MEMORY, budget / 4);
  desc->defocus_bytes = caches / 3; /* divided in the same way as the defaults */
  desc->picture_bytes = 2 * desc->defocus_bytes;
  return CS_EXIT_OK;
}

/* ---------------------------------------------------------------- limits */

static bool is_trusted(const cs_request *request) { return cs_request_has(request, "--trust"); }

static cs_given_limits given_limits(const cs_request *request) {
  cs_given_limits given = {.has = {false}};
  cs_request_read(request, "--limit", &given);
  return given;
}

static celspan_lua_limits limits_of(const cs_request *request) {
  const cs_given_limits given = given_limits(request);
  const double *values = given.values;
  celspan_lua_limits limits =
      is_trusted(request) ? (celspan_lua_limits){.struct_size = sizeof limits} : CELSPAN_LUA_LIMITS;
  limits.printed = cs_report_printed;
  limits.memory = least(limits.memory, budget);
  if (given.has[CS_LIMIT_MEMORY])
    limits.memory = size_of(values[CS_LIMIT_MEMORY]);
  if (given.has[CS_LIMIT_STEPS])
    limits.steps = (uint64_t)values[CS_LIMIT_STEPS];
  if (given.has[CS_LIMIT_TIME])
    limits.seconds = values[CS_LIMIT_TIME];
  if (given.has[CS_LIMIT_PRINT])
    limits.print = size_of(values[CS_LIMIT_PRINT]);
  return limits;
}

cs_exit cs_confine_pictures(celspan_context *context, const cs_request *request) {
  const cs_given_limits given = given_limits(request);
  bool has_memory = given.has[CS_LIMIT_PICTURE_MEMORY], has_time = given.has[CS_LIMIT_PICTURE_TIME];
  const cs_worker_limits limits = {
      .memory = has_memory ? (uint64_t)given.values[CS_LIMIT_PICTURE_MEMORY]
                           : least(PICTURE_MEMORY, budget / 3),
      .seconds = has_time ? given.values[CS_LIMIT_PICTURE_TIME] : PICTURE_SECONDS};
  if (!is_trusted(request)) {
    cs_isolate_begin(context, &limits);
    return CS_EXIT_OK;
  }
  if (!has_memory && !has_time)
    return CS_EXIT_OK;
  return cs_report_usage(
      "--trust decodes pictures in this process, which has no limits for them: leave "
      "--limit %s out",
      has_memory ? "picture-memory" : "picture-time");
}

/* A limit of the user replaces the memory that may be held; the control group may still be full
 * earlier. */
void cs_confine_rendering(celspan_context *context, const cs_request *request) {
  const cs_given_limits given = given_limits(request);
  bool has_limit = given.has[CS_LIMIT_RENDER_MEMORY];
  context->memory->account = cs_guard_account;
  context->memory->ceiling = &ceiling;
  atomic_store(&context->processors, cs_machine_processors(&group));
  context->memory->spares.most = least(CS_SPARES_MOST, budget / 16);
  if (has_limit)
    context->memory->most_rendering = size_of(given.values[CS_LIMIT_RENDER_MEMORY]);
  if (has_limit && given.values[CS_LIMIT_RENDER_MEMORY] > 0)
    ceiling.most = SIZE_MAX;
  else if (has_limit || is_trusted(request))
    cs_ceiling_finish(&ceiling);
}

void cs_confine_divide(unsigned parts) {
  char bytes[32];
  if (budget == SIZE_MAX || parts == 0)
    return;
  /* As a part of the memory that the process may use: see ceiling.h. */
  uint64_t part = (uint64_t)budget / 3 * 4 / parts;
  snprintf(bytes, sizeof bytes, "%llu",
           (unsigned long long)(part > MEMORY_LEAST ? part : MEMORY_LEAST));
  setenv("CELSPAN_MEMORY", bytes, 1);
}

/* The option that gives or removes a right of the sandbox; NULL: none was given. */
static const char *right_of(const cs_request *request) {
  static const char *const rights[] = {"--strict", "--allow", "--allow-system-fonts"};
  for (size_t i = 0; i < sizeof rights / sizeof *rights; i++)
    if (cs_request_has(request, rights[i]))
      return rights[i];
  return NULL;
}

cs_exit cs_confine_refuse(const cs_request *request) {
  const cs_given_limits given = given_limits(request);
  bool has_limit = false;
  for (size_t i = CS_LIMIT_MEMORY; i < CS_LIMIT_COUNT; i++)
    has_limit |= given.has[i];
  if (!has_limit && !right_of(request))
    return CS_EXIT_OK;
  return cs_report_usage("--strict, --allow, --allow-system-fonts and every --limit except those "
                         "of pictures are for scripts, and "
                         "%s is not a script: leave them out",
                         request->operands[0]);
}

static cs_exit refuse_both(const cs_request *request) {
  const char *right = right_of(request);
  return right ? cs_report_usage("--trust already allows everything: leave %s out", right)
               : CS_EXIT_OK;
}

bool cs_confine_is_needed(const cs_request *request) {
  celspan_lua_limits limits = limits_of(request);
  return !is_trusted(request) || right_of(request) || limits.memory || limits.steps ||
         limits.seconds > 0;
}

static bool is_interrupted(void *user) {
  (void)user;
  return cs_interrupt_signal() != 0;
}

/* The watchdog's last message. The state of the main thread is not known, and the locks of its
 * streams may be held for ever, so nothing of it is used. */
static void kill_script(void *user, const char *sentence) {
  char line[512];
  (void)user;
  int length = snprintf(line, sizeof line, "celspan: error: %s\n", sentence);
  ssize_t written = write(STDERR_FILENO, line, (size_t)length);
  (void)written;
  _exit(CS_EXIT_LIMIT);
}

/* ---------------------------------------------------------------- folders */

static void folder_of(const char *path, char out[PATH_SIZE]) {
  const char *slash = strrchr(path, '/');
  int length = !slash ? 0 : slash == path ? 1 : (int)(slash - path);
  snprintf(out, PATH_SIZE, "%.*s", length, path);
}

static cs_exit refuse_folder(const char *folder) {
  if (access(folder, X_OK) == 0)
    return CS_EXIT_OK;
  return cs_report_usage("--allow %s: there is no such folder", folder);
}

/* Reports that folders could not be added. */
static cs_exit refuse_roots(void) {
  if (errno != ENOMEM)
    return cs_report_usage("--allow and CELSPAN_PATH name too many folders");
  cs_report_error("out of memory");
  return CS_EXIT_MEMORY;
}

/* Adds the folders of fonts; missing ones are ignored. */
static void add_fonts(cs_confined *out) {
  static const char *const own[CS_FONT_FOLDERS] = {"/.local/share/fonts", "/.fonts"};
  const char *home = getenv("HOME");
  out->folders[out->limits.folder_count++] = "/usr/share/fonts";
  out->folders[out->limits.folder_count++] = "/usr/local/share/fonts";
  for (size_t i = 0; home && home[0] && i < CS_FONT_FOLDERS; i++) {
    snprintf(out->fonts[i], sizeof out->fonts[i], "%s%s", home, own[i]);
    out->folders[out->limits.folder_count++] = out->fonts[i];
  }
}

/* Adds the folders that the script may read, in the form of the library and as roots. */
static cs_exit open_roots(const cs_request *request, const char *script, cs_confined *out,
                          cs_roots *roots) {
  char folder[PATH_SIZE];
  cs_given_texts allowed = {.count = 0};
  cs_request_read(request, "--allow", &allowed);
  for (size_t i = 0; i < allowed.count; i++) {
    CS_TRY_EXIT(refuse_folder(allowed.items[i]));
    out->folders[out->limits.folder_count++] = allowed.items[i];
  }
  if (cs_request_has(request, "--allow-system-fonts"))
    add_fonts(out);
  out->limits.folders = out->folders;
  out->limits.search = getenv("CELSPAN_PATH");
  folder_of(script, folder);
  return cs_roots_add(roots, folder) && cs_sandbox_add_roots(&out->limits, roots) ? CS_EXIT_OK
                                                                                  : refuse_roots();
}

/* ---------------------------------------------------------------- strict */

/* The folder of the output, which is created if it is missing; "": there is no output. */
static void output_folder(const cs_request *request, char out[PATH_SIZE]) {
  const char *output = cs_request_text(request, "-o");
  out[0] = '\0';
  if (!output || strcmp(output, "-") == 0)
    return;
  if (request->verb->makes_folder)
    snprintf(out, PATH_SIZE, "%s/.", output);
  else
    folder_of(output, out);
  char within[PATH_SIZE + 4];
  snprintf(within, sizeof within, "%s/x", out[0] ? out : ".");
  cs_journal_make_folders(within);
  if (!out[0])
    strcpy(out, ".");
}

/* Adds the files that the program itself reads: its modules, the settings of colours, and the files
 * that options name. */
static bool add_own_folders(const cs_request *request, cs_roots *read) {
  static const char *const variables[] = {"OCIO",
                                          "CELSPAN_PICTURE_MODULE",
                                          "CELSPAN_TYPE_MODULE",
                                          "CELSPAN_COLOUR_MODULE",
                                          "CELSPAN_SPACE_MODULE",
                                          "CELSPAN_PDF_MODULE"};
  char folder[PATH_SIZE], library[PATH_SIZE + 64];
  bool is_known = cs_program_folder(folder, PATH_SIZE);
  bool is_good = !is_known || cs_roots_add(read, folder);
  for (const char *const *one = cs_program_libraries; *one && is_known && is_good; one++) {
    snprintf(library, sizeof library, "%s/%s", folder, *one);
    is_good = cs_roots_add(read, library);
  }
  for (size_t i = 0; i < sizeof variables / sizeof *variables && is_good; i++) {
    const char *path = getenv(variables[i]);
    folder_of(path ? path : "", folder);
    is_good = !path || cs_roots_add(read, folder);
  }
  const char *const named[] = {cs_request_text(request, "--viewer"),
                               cs_request_text(request, "--places")};
  for (size_t i = 0; i < 2 && is_good; i++)
    is_good = !named[i] || cs_roots_add(read, named[i]);
  return is_good;
}

static bool copy_roots(const cs_roots *from, cs_roots *to) {
  for (size_t i = 0; i < from->count; i++)
    if (!cs_roots_add(to, from->paths[i]))
      return false;
  return true;
}

/* The folder of --report may be written, too. */
static bool add_report(const cs_request *request, cs_roots *write) {
  char folder[PATH_SIZE];
  const char *report = cs_request_text(request, "--report");
  folder_of(report ? report : "", folder);
  return !report || cs_roots_add(write, folder[0] ? folder : ".");
}

static cs_exit enter_strict(const cs_request *request, const cs_roots *roots) {
  char folder[PATH_SIZE];
  cs_roots read = {.count = 0}, write = {.count = 0};
  output_folder(request, folder);
  bool is_good = copy_roots(roots, &read) && add_own_folders(request, &read) &&
                 add_report(request, &write) &&
                 (!folder[0] || (cs_roots_add(&write, folder) && cs_roots_add(&read, folder)));
  bool lacks_memory = !is_good && errno == ENOMEM;
  const char *refusal = is_good        ? NULL
                        : lacks_memory ? "out of memory"
                                       : "there are too many folders to read";
  if (!refusal && !cs_client_confine(&read))
    refusal = "the picture decoder cannot be started";
  if (!refusal)
    refusal = cs_strict_enter(&(cs_strict_rights){.read = &read, .write = &write});
  cs_roots_finish(&read);
  cs_roots_finish(&write);
  if (!refusal)
    return CS_EXIT_OK;
  cs_report_error("--strict: %s; without --strict, only Lua's own sandbox confines the script",
                  refusal);
  return lacks_memory ? CS_EXIT_MEMORY : CS_EXIT_LIMIT;
}

cs_exit cs_confine_open(const cs_request *request, const char *script, cs_confined *out) {
  static bool is_strict; /* strict mode is entered once, for the whole process */
  *out = (cs_confined){.limits = limits_of(request), .is_trusted = is_trusted(request)};
  out->limits.is_interrupted = is_interrupted;
  out->limits.overdue = kill_script;
  if (out->is_trusted)
    return refuse_both(request);
  cs_roots roots = {.count = 0};
  cs_exit outcome = open_roots(request, script, out, &roots);
  if (outcome == CS_EXIT_OK && cs_request_has(request, "--strict") && !is_strict) {
    is_strict = true;
    outcome = enter_strict(request, &roots);
  }
  cs_roots_finish(&roots);
  return outcome;
}
