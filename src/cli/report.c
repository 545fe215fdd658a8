#include "cli/report.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "cli/interrupt.h"

enum { SENTENCE = 8192 }; /* paths may be 4096 bytes long */

static void (*clear_line)(void);
static cs_report_form chosen;

void cs_report_choose(cs_report_form form) { chosen = form; }

cs_exit cs_report_exit(celspan_status status) {
  switch (status) {
  case CELSPAN_OK:
    return CS_EXIT_OK;
  case CELSPAN_CANCELLED:
    return CS_EXIT_SIGNAL;
  case CELSPAN_NO_MEMORY:
    return CS_EXIT_MEMORY;
  case CELSPAN_BAD_ARGUMENT:
  case CELSPAN_CALLBACK:
    return CS_EXIT_SCRIPT;
  case CELSPAN_LIMIT:
    return CS_EXIT_LIMIT;
  case CELSPAN_INPUT:
    return CS_EXIT_INPUT;
  case CELSPAN_OUTPUT:
    return CS_EXIT_OUTPUT;
  case CELSPAN_INTERNAL:
    break;
  }
  return CS_EXIT_INTERNAL;
}

void cs_report_event(cs_json *event) { fputs(cs_json_end(event), stderr); }

static void print_openjd(const char *name, char *text) {
  for (char *at = text; *at; at++)
    if ((unsigned char)*at < ' ')
      *at = ' ';
  printf("openjd_%s: %s\n", name, text);
  fflush(stdout);
}

void cs_report_openjd(const char *name, const char *format, ...) {
  char text[SENTENCE];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  print_openjd(name, text);
}

static void print_words(bool is_error, const char *text) {
  if (clear_line)
    clear_line();
  fprintf(stderr, "celspan: %s%s\n", is_error ? "error: " : "", text);
}

static void print_event(bool is_error, const char *text) {
  cs_json event;
  cs_json_begin(&event);
  cs_json_text(&event, "event", is_error ? "error" : "note");
  cs_json_text(&event, "message", text);
  cs_report_event(&event);
}

__attribute__((format(printf, 2, 0))) static void print_line(bool is_error, const char *format,
                                                             va_list arguments) {
  char text[SENTENCE];
  vsnprintf(text, sizeof text, format, arguments);
  if (chosen == CS_REPORT_JSON)
    print_event(is_error, text);
  else
    print_words(is_error, text);
  if (chosen == CS_REPORT_OPENJD && is_error)
    print_openjd("fail", text);
}

void cs_report_error(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  print_line(true, format, arguments);
  va_end(arguments);
}

void cs_report_note(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  print_line(false, format, arguments);
  va_end(arguments);
}

cs_exit cs_report_usage(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  print_line(true, format, arguments);
  va_end(arguments);
  return CS_EXIT_USAGE;
}

cs_exit cs_report_failure(const celspan_context *context, celspan_status status,
                          const char *where) {
  if (status == CELSPAN_OK)
    return CS_EXIT_OK;
  if (status == CELSPAN_CANCELLED || cs_interrupt_signal())
    return CS_EXIT_SIGNAL;
  const char *sentence = celspan_context_error(context);
  if (!sentence[0])
    sentence = celspan_status_name(status);
  bool has_where = where && where[0];
  cs_report_error("%s%s%s%s", has_where ? where : "", has_where ? ": " : "", sentence,
                  status == CELSPAN_INTERNAL ? " (a fault of celspan itself: please report it)"
                                             : "");
  return cs_report_exit(status);
}

void cs_report_before_line(void (*clear)(void)) { clear_line = clear; }

cs_exit cs_report_close_output(cs_exit outcome) {
  errno = 0;
  bool had_error = ferror(stdout) != 0;
  if ((fclose(stdout) == 0 && !had_error) || outcome != CS_EXIT_OK)
    return outcome; /* a run that failed has reported why */
  cs_report_error("standard output: %s", errno ? strerror(errno) : "not everything was written");
  return CS_EXIT_OUTPUT;
}
