/* celspan test [SPEC ...]: busted in this program's own interpreter, several spec files at a time.
 *
 *   spec_list (which) -> spec_run (a process each, as many as there are workers) -> one summary
 *
 * The order of what is printed is that of the list, whichever process ends first.
 */
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "cli/desk/spec_list.h"
#include "cli/desk/spec_run.h"
#include "cli/interrupt.h"
#include "cli/verbs.h"

typedef struct suite {
  celspan_context *context;
  const char *only;
  cs_spec_run *runs;
  int *statuses; /* of waitpid(2), of those that ended */
  bool *has_ended;
  size_t count, started, running, told;
} suite;

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static size_t workers_of(const cs_request *request) {
  long processors = sysconf(_SC_NPROCESSORS_ONLN);
  if (request->workers > 0)
    return (size_t)request->workers;
  return processors > 0 ? (size_t)processors : 1;
}

static void tell_ended(suite *s) {
  for (; s->told < s->started && s->has_ended[s->told]; s->told++)
    cs_spec_run_collect(&s->runs[s->told], s->statuses[s->told]);
}

/* Waits for any child; another program's children, inherited by exec, are not in the list. */
static void wait_for_one(suite *s) {
  int status;
  pid_t ended = waitpid(-1, &status, 0);
  for (size_t i = 0; i < s->started; i++) {
    if (ended <= 0 || s->runs[i].process != ended || s->has_ended[i])
      continue;
    s->statuses[i] = status;
    s->has_ended[i] = true;
    s->running--;
  }
  if (ended < 0 && errno != EINTR)
    s->running = 0;
}

static const suite *running; /* the one that a signal ends */

/* Runs in the signal handler: kill(2) is safe there. */
static void stop_all(void) {
  for (size_t i = 0; i < running->started; i++)
    if (!running->has_ended[i] && running->runs[i].process > 0)
      kill(running->runs[i].process, SIGTERM);
}

/* false: a process could not be started, which is reported. */
static bool run_all(suite *s, size_t workers) {
  bool is_well = true;
  running = s;
  cs_interrupt_call(stop_all);
  while (s->running > 0 || (s->started < s->count && is_well && !cs_interrupt_signal())) {
    if (s->started < s->count && s->running < workers && is_well && !cs_interrupt_signal()) {
      is_well = cs_spec_run_start(&s->runs[s->started], s->context, s->only);
      s->started += is_well;
      s->running += is_well;
      continue;
    }
    wait_for_one(s);
    tell_ended(s);
  }
  cs_interrupt_call(NULL);
  return is_well;
}

static cs_exit sum_up(const suite *s, double begun, bool is_well) {
  size_t passed = 0, failed = 0, skipped = 0;
  for (size_t i = 0; i < s->told; i++) {
    passed += s->runs[i].passed;
    failed += s->runs[i].failed;
    skipped += s->runs[i].skipped;
  }
  printf("%zu passed, %zu failed, %zu skipped in %zu spec file%s, %.1f seconds\n", passed, failed,
         skipped, s->told, s->told == 1 ? "" : "s", seconds() - begun);
  if (!is_well)
    return CS_EXIT_MEMORY;
  if (passed + failed + skipped == 0 && !cs_interrupt_signal()) {
    cs_report_error("%s",
                    s->only ? "no test has a name that --only asks for" : "no spec holds a test");
    return CS_EXIT_DIFFERENT;
  }
  return failed ? CS_EXIT_DIFFERENT : CS_EXIT_OK;
}

static cs_exit run_list(celspan_context *context, const cs_request *request,
                        const cs_spec_list *list) {
  size_t count = list->count;
  suite s = {.context = context, .only = request->only, .count = count};
  s.runs = cs_mem_array(context->memory, count, sizeof *s.runs);
  s.statuses = cs_mem_array(context->memory, count, sizeof *s.statuses);
  s.has_ended = cs_mem_array(context->memory, count, sizeof *s.has_ended);
  cs_exit outcome = CS_EXIT_MEMORY;
  if (s.runs && s.statuses && s.has_ended) {
    double begun = seconds();
    for (size_t i = 0; i < count; i++) {
      s.runs[i] = (cs_spec_run){.path = list->paths[i]};
      s.has_ended[i] = false;
    }
    outcome = sum_up(&s, begun, run_all(&s, workers_of(request)));
  } else {
    cs_report_error("no memory for %zu spec files", count);
  }
  cs_mem_free(context->memory, s.runs, count * sizeof *s.runs);
  cs_mem_free(context->memory, s.statuses, count * sizeof *s.statuses);
  cs_mem_free(context->memory, s.has_ended, count * sizeof *s.has_ended);
  return outcome;
}

static celspan_status list_specs(celspan_context *context, const cs_request *request,
                                 cs_spec_list *list) {
  celspan_status status = CELSPAN_OK;
  if (request->operand_count == 0)
    status = cs_spec_list_add(list, context, "spec");
  for (size_t i = 0; i < request->operand_count && status == CELSPAN_OK; i++)
    status = cs_spec_list_add(list, context, request->operands[i]);
  return status;
}

cs_exit cs_verb_test(celspan_context *context, const cs_request *request) {
  if (!cs_spec_run_has_busted()) {
    cs_report_error("busted is not installed: it runs the specs. Install the Debian package "
                    "lua-busted, or `luarocks install busted` for Lua 5.4");
    return CS_EXIT_OUTPUT;
  }
  cs_spec_list list = {0};
  celspan_status status = list_specs(context, request, &list);
  cs_exit outcome = status == CELSPAN_OK ? run_list(context, request, &list)
                                         : cs_report_failure(context, status, NULL);
  cs_spec_list_finish(&list, context);
  return outcome;
}
