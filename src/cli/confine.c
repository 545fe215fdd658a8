#include "cli/confine.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/decoder/keeping.h"
#include "cli/decoder/pictures.h"
#include "cli/interrupt.h"
#include "cli/lines.h"
#include "sandbox/strict.h"

#define PICTURE_MEMORY ((uint64_t)1 << 30)
#define PICTURE_SECONDS 20

enum { PATH_SIZE = 4096 };

/* ---------------------------------------------------------------- limits */

static cs_limits limits_of(const cs_request *request) {
  const cs_given_limits *given = &request->limits;
  cs_limits limits = request->trusts ? (cs_limits){0} : CS_LIMITS_DEFAULT;
  limits.memory = given->has_memory ? given->values.memory : limits.memory;
  limits.steps = given->has_steps ? given->values.steps : limits.steps;
  limits.seconds = given->has_time ? given->values.seconds : limits.seconds;
  limits.print = given->has_print ? given->values.print : limits.print;
  return limits;
}

cs_exit cs_confine_pictures(celspan_context *context, const cs_request *request) {
  const cs_given_limits *given = &request->limits;
  const cs_decoder_limits limits = {
      .memory = given->has_picture_memory ? given->picture_memory : PICTURE_MEMORY,
      .seconds = given->has_picture_time ? given->picture_seconds : PICTURE_SECONDS};
  if (!request->trusts) {
    cs_pictures_begin(context, &limits);
    return CS_EXIT_OK;
  }
  if (!given->has_picture_memory && !given->has_picture_time)
    return CS_EXIT_OK;
  return cs_report_usage(
      "--trust decodes pictures in this process, which has no limits for them: leave "
      "--limit %s out",
      given->has_picture_memory ? "picture-memory" : "picture-time");
}

cs_exit cs_confine_refuse(const cs_request *request) {
  const cs_given_limits *limits = &request->limits;
  bool has_limits =
      limits->has_memory || limits->has_steps || limits->has_time || limits->has_print;
  if (!request->is_strict && !request->allowed.count && !has_limits)
    return CS_EXIT_OK;
  return cs_report_usage(
      "--strict, --allow and all of --limit but that of pictures are for scripts, and "
      "%s is none",
      request->operands[0]);
}

static cs_exit refuse_both(const cs_request *request) {
  if (request->trusts && (request->is_strict || request->allowed.count))
    return cs_report_usage("--trust lets the script do all: leave %s out",
                           request->is_strict ? "--strict" : "--allow");
  return CS_EXIT_OK;
}

bool cs_confine_is_needed(const cs_request *request) {
  cs_limits limits = limits_of(request);
  return !request->trusts || request->is_strict || request->allowed.count || limits.memory ||
         limits.steps || limits.seconds > 0;
}

static bool is_interrupted(void) { return cs_interrupt_signal() != 0; }

/* The watchdog's last word. What the main thread does meanwhile is not known, so nothing of it is
 * touched: the locks of its streams may be held for ever. */
static void kill_script(const char *sentence) {
  char line[512];
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

/* Folders that could not be added. */
static cs_exit refuse_roots(void) {
  if (errno != ENOMEM)
    return cs_report_usage("--allow and CELSPAN_PATH name too many folders");
  cs_report_error("out of memory");
  return CS_EXIT_MEMORY;
}

static cs_exit open_roots(const cs_request *request, cs_sandbox *out) {
  char folder[PATH_SIZE];
  const char *search = getenv("CELSPAN_PATH");
  folder_of(request->operands[0], folder);
  errno = 0;
  bool is_good = cs_roots_add(&out->roots, folder);
  for (size_t i = 0; i < request->allowed.count && is_good; i++) {
    cs_exit outcome = refuse_folder(request->allowed.items[i]);
    if (outcome != CS_EXIT_OK)
      return outcome;
    is_good = cs_sandbox_allow(out, request->allowed.items[i]);
  }
  if (search && is_good)
    is_good = cs_sandbox_allow_search(out, search);
  return is_good ? CS_EXIT_OK : refuse_roots();
}

/* ---------------------------------------------------------------- strict */

/* The folder that what is made goes to, made if it is missing; "": nothing is made. */
static void output_folder(const cs_request *request, char out[PATH_SIZE]) {
  out[0] = '\0';
  if (!request->output || strcmp(request->output, "-") == 0)
    return;
  snprintf(out, PATH_SIZE, "%s/.", request->output); /* of tiles it is a folder itself */
  if (!request->makes_folder)
    folder_of(request->output, out);
  char within[PATH_SIZE + 4];
  snprintf(within, sizeof within, "%s/x", out[0] ? out : ".");
  cs_lines_make_folders(within);
  if (!out[0])
    strcpy(out, ".");
}

/* What the program reads beside the script's folders: its modules, the settings of colours, and what
 * else the command line names. */
static bool add_own_folders(const cs_request *request, cs_roots *read) {
  static const char *const variables[] = {"OCIO", "CELSPAN_PICTURE_MODULE", "CELSPAN_ART_MODULE"};
  char folder[PATH_SIZE];
  ssize_t size = readlink("/proc/self/exe", folder, sizeof folder - 1);
  folder[size > 0 ? size : 0] = '\0';
  char *slash = strrchr(folder, '/');
  if (slash)
    *slash = '\0';
  bool is_good = size <= 0 || cs_roots_add(read, folder);
  for (size_t i = 0; i < sizeof variables / sizeof *variables && is_good; i++) {
    const char *path = getenv(variables[i]);
    folder_of(path ? path : "", folder);
    is_good = !path || cs_roots_add(read, folder);
  }
  if (request->viewer)
    is_good = is_good && cs_roots_add(read, request->viewer);
  if (request->places)
    is_good = is_good && cs_roots_add(read, request->places);
  return is_good;
}

static bool copy_roots(const cs_roots *from, cs_roots *to) {
  for (size_t i = 0; i < from->count; i++)
    if (!cs_roots_add(to, from->paths[i]))
      return false;
  return true;
}

static cs_exit enter_strict(const cs_request *request, const cs_sandbox *sandbox) {
  char folder[PATH_SIZE];
  cs_roots read = {.count = 0}, write = {.count = 0};
  output_folder(request, folder);
  bool is_good = copy_roots(&sandbox->roots, &read) && add_own_folders(request, &read) &&
                 (!folder[0] || (cs_roots_add(&write, folder) && cs_roots_add(&read, folder)));
  const char *refusal = is_good ? NULL : "there are too many folders to read";
  if (!refusal && !cs_keeping_confine(&read))
    refusal = "the decoder of pictures cannot be started";
  if (!refusal)
    refusal = cs_strict_enter(&read, &write);
  cs_roots_finish(&read);
  cs_roots_finish(&write);
  if (!refusal)
    return CS_EXIT_OK;
  cs_report_error("--strict: %s; without --strict the sandbox of the language alone is left",
                  refusal);
  return CS_EXIT_LIMIT;
}

cs_exit cs_confine_open(const cs_request *request, cs_sandbox *out) {
  static bool is_strict; /* it is entered once, for the whole process */
  cs_limits limits = limits_of(request);
  cs_sandbox_init(out, &limits);
  out->guard.is_interrupted = is_interrupted;
  out->guard.kill = kill_script;
  if (request->trusts)
    return refuse_both(request);
  cs_exit outcome = open_roots(request, out);
  if (outcome != CS_EXIT_OK || !request->is_strict || is_strict)
    return outcome;
  is_strict = true;
  return enter_strict(request, out);
}
