/* The command line: chooses the verb, runs it, and turns its outcome into the exit code.
 *
 *   main -> request (the options) -> a verb -> report (exit code, one line of error)
 *
 * Nothing is loaded that the verb does not need: a service is made when the verb asks for it;
 * OpenImageIO is loaded for the first picture, in another process (plugins/isolate/zygote.h).
 */
#include <errno.h>
#include <fcntl.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "inside/context.h"
#include "lua/bind/suggest.h"
#include "plugins/isolate/isolate.h"
#include "plugins/isolate/zygote.h"
#include "process/interrupt.h"
#include "program/commit.h"
#include "program/film/confine.h"
#include "program/film/spaces.h"
#include "program/options/progress.h"
#include "program/options/verbs.h"
#include "program/outputs/outputs.h"
#include "program/report/log.h"
#include "program/report/text_file.h"
#include "program/services/lua_verb.h"

enum { VERBS_MOST = 32 };

/* Reports that a file was given instead of a verb. */
static cs_exit refuse_file(const char *name) {
  const char *dot = strrchr(name, '.');
  if (dot && strcmp(dot, ".lua") == 0)
    return cs_report_usage("'%s' is a script, and a verb is missing before it: 'celspan play %s' "
                           "shows it, 'celspan render %s -o film.mp4' makes a video",
                           name, name, name);
  return cs_report_usage("'%s' is a file, and a verb is missing before it: 'celspan info %s' "
                         "describes it, 'celspan help' lists the verbs",
                         name, name);
}

static cs_exit refuse_verb(const char *name) {
  const char *names[VERBS_MOST];
  size_t count = 0;
  for (const cs_verb *verb = cs_verbs; verb->name && count < VERBS_MOST; verb++)
    names[count++] = verb->name;
  const char *nearest = cs_suggest_name(name, names, count);
  if (nearest)
    return cs_report_usage("unknown verb '%s': did you mean '%s'?", name, nearest);
  return cs_report_usage("unknown verb '%s' ('celspan help' lists them)", name);
}

/* Standard input can be read only once, and some verbs run a script several times. */
static cs_exit read_script(celspan_context *context, cs_request *request, cs_text_file *out) {
  const bool runs_again = request->verb->runs_again || cs_request_has(request, "--table");
  bool is_input = false;
  for (size_t i = 0; i < (runs_again ? request->operand_count : 1) && i < request->operand_count;
       i++)
    is_input |= strcmp(request->operands[i], "-") == 0;
  if (!request->verb->has_script || !is_input)
    return CS_EXIT_OK;
  if (runs_again)
    return cs_report_usage("-: several processes run the script, and standard input is read only "
                           "once: give the name of a file");
  cs_exit outcome = cs_text_file_read(context, stdin, "", "standard input", out);
  request->script = out->bytes;
  request->script_size = out->size;
  return outcome;
}

static cs_exit run(cs_request *request) {
  celspan_context *context = NULL;
  cs_text_file script = {NULL, 0, 0};
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  CS_TRY_EXIT(cs_confine_memory(request, &desc));
  if (celspan_context_create(&desc, &context) != CELSPAN_OK) {
    cs_report_error("not enough memory to start");
    return CS_EXIT_MEMORY;
  }
  context->maker = "celspan " CELSPAN_RELEASE " (" CS_COMMIT ")";
  cs_confine_rendering(context, request);
  cs_spaces spaces;
  cs_exit outcome = cs_spaces_open(context, request, &spaces);
  if (outcome == CS_EXIT_OK)
    outcome = cs_confine_pictures(context, request);
  if (outcome == CS_EXIT_OK)
    outcome = read_script(context, request, &script);
  if (outcome == CS_EXIT_OK)
    outcome = cs_lua_verb_run(context, request);
  cs_text_file_close(context, &script);
  cs_spaces_close(&spaces);
  celspan_context_destroy(context);
  cs_isolate_finish();
  return outcome;
}

static cs_exit begin_log(const cs_request *request) {
  const char *path = request->verb->plans_rows ? NULL : cs_request_text(request, "--log");
  if (path && cs_request_has(request, "--table") && strchr(path, '{'))
    return CS_EXIT_OK; /* each row has its own */
  if (path && !cs_log_open(path)) {
    cs_report_error("%s: the log cannot be written: %s", path, strerror(errno));
    return CS_EXIT_OUTPUT;
  }
  if (path)
    cs_report_log("celspan %s (%s): %s %s", celspan_version(), CS_COMMIT, request->verb->name,
                  request->operand_count ? request->operands[0] : "");
  return CS_EXIT_OK;
}

static cs_exit parse_and_run(const cs_verb *verb, size_t count, char *const *words) {
  cs_request request;
  cs_progress_style style = CS_PROGRESS_AUTO;
  CS_TRY_EXIT(cs_request_parse(verb, count, words, &request));
  cs_request_read(&request, "--progress", &style);
  cs_progress_choose(style);
  CS_TRY_EXIT(begin_log(&request));
  request.output = cs_output_own(&request);
  return run(&request);
}

/* words: a verb, a text to search for, or an option of the help. Without words, the verbs are
 * listed. */
static cs_exit help(size_t count, char *const *words) {
  bool is_list = count > 0 && strcmp(words[0], "help") == 0;
  return parse_and_run(cs_verb_named("help"), is_list ? 0 : count, words);
}

static cs_exit help_word(const char *word) { return help(1, (char *const *)&word); }

static cs_exit run_verb(const cs_verb *verb, size_t count, char *const *words) {
  for (size_t i = 0; i < count && strcmp(words[i], "--") != 0; i++)
    if (strcmp(words[i], "--help") == 0 || strcmp(words[i], "-h") == 0)
      return help_word(verb->name);
  return parse_and_run(verb, count, words);
}

static cs_exit dispatch(int count, char **arguments) {
  if (count < 2) {
    cs_exit outcome = help_word("--stderr");
    return outcome == CS_EXIT_OK ? CS_EXIT_USAGE : outcome;
  }
  const char *first = arguments[1];
  if (strcmp(first, "--version") == 0) {
    printf("celspan %s (%s)\n", celspan_version(), CS_COMMIT);
    return CS_EXIT_OK;
  }
  if (strcmp(first, "--man") == 0)
    return help_word(first);
  if (strcmp(first, "help") == 0 || strcmp(first, "--help") == 0 || strcmp(first, "-h") == 0)
    return help((size_t)count - 2, arguments + 2);
  const cs_verb *verb = cs_verb_named(first);
  if (verb)
    return run_verb(verb, (size_t)count - 2, arguments + 2);
  return strchr(first, '.') ? refuse_file(first) : refuse_verb(first);
}

/* Daemons and farms start programs with descriptors 0 to 2 closed. The next opened file would then
 * get such a number, and messages would be written into frames. So /dev/null gets these numbers. As
 * standard output it is opened only for reading, so that writing there still fails. */
static bool hold_descriptors(void) {
  static const int modes[] = {O_RDONLY, O_RDONLY, O_WRONLY};
  for (int number = 0; number <= 2; number++)
    if (fcntl(number, F_GETFD) < 0 && errno == EBADF && open("/dev/null", modes[number]) != number)
      return false;
  return true;
}

#define STACK_USUAL ((rlim_t)8 << 20)
#define STACK_LEAST ((rlim_t)1 << 20) /* scripts and drawings with deep nesting need some */

/* Lets the stack grow to the usual limit, as far as the process may raise its limit. If the limit
 * is too small after that, reports this and returns false: a larger stack would end the process
 * with a signal. */
static bool widen_stack(void) {
  struct rlimit limit;
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= STACK_USUAL)
    return true;
  limit.rlim_cur = limit.rlim_max < STACK_USUAL ? limit.rlim_max : STACK_USUAL;
  setrlimit(RLIMIT_STACK, &limit);
  if (limit.rlim_cur >= STACK_LEAST)
    return true;
  /* Without cs_report functions, because these may need more stack than is available. */
  fprintf(stderr, "celspan: error: the stack is limited to %llu KiB; ",
          (unsigned long long)limit.rlim_cur >> 10);
  fprintf(stderr, "at least %llu are needed ('ulimit -s' sets it)\n",
          (unsigned long long)STACK_LEAST >> 10);
  return false;
}

int main(int count, char **arguments) {
  if (!hold_descriptors())
    return CS_EXIT_INTERNAL;
  if (!widen_stack())
    return CS_EXIT_MEMORY;
  /* Numbers are read and printed in the C locale by this thread, whatever a script may set. */
  uselocale(newlocale(LC_ALL_MASK, "C", (locale_t)0));
  if (cs_zygote_is_meant(count, arguments))
    cs_zygote_run(count, arguments);
  cs_interrupt_install();
  cs_exit outcome = dispatch(count, arguments);
  outcome = cs_report_close_output(outcome);
  if (cs_interrupt_signal())
    cs_interrupt_die();
  return (int)outcome;
}
