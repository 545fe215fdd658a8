#include "program/report/report.h"

#include <errno.h>
#include <poll.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "process/interrupt.h"
#include "program/report/log.h"

enum {
  SENTENCE = 8192,        /* bytes; paths may be 4096 long */
  VISIBLE = 5 * SENTENCE, /* the greatest size of a sentence after make_visible */
  PIECE = 1024,           /* bytes of a printed line; it fits into an event in any form */
  SHOWN = 5               /* bytes of the longest text for one character, with a zero */
};

static void (*clear_line)(void);
static cs_report_form chosen;
static char last[SENTENCE];
static int64_t row_line;
static char row_output[SENTENCE];

const char *cs_report_last(void) { return last[0] ? last : NULL; }

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

/* Text of scripts and of files as a terminal may show it: it does not move the cursor, colour or
 * clear anything, or change the clipboard. Controls are written as numbers, such as \x1b, except
 * new lines and tabs. The controls of the set C1 are C2 80 to C2 9F in UTF-8.
 *
 * Writes the visible form of the first character of a text that is not "", and a zero. size: of the
 * text. Returns how many bytes the character has in the text. */
static size_t visible_first(const char *text, size_t size, char out[SHOWN]) {
  const unsigned char *at = (const unsigned char *)text;
  bool is_long = *at == 0xc2 && (size == 1 || (at[1] & 0xe0) == 0x80);
  bool is_shown = (*at >= ' ' || *at == '\n' || *at == '\t') && *at != 0x7f && !is_long;
  bool is_pair = is_long && size > 1;
  out[0] = *text;
  out[1] = 0;
  if (!is_shown)
    snprintf(out, SHOWN, "\\x%02x", at[is_pair]);
  return is_pair ? 2 : 1;
}

/* Texts from scripts and names of files must not look like separate messages: after a new line they
 * are indented. */
static void make_visible(const char *text, char out[VISIBLE]) {
  size_t size = strlen(text);
  for (size_t used; size > 0; text += used, size -= used) {
    char shown[SHOWN];
    used = visible_first(text, size, shown);
    out = stpcpy(out, *shown == '\n' ? "\n    " : shown);
  }
  *out = 0;
}

void cs_report_row(int64_t line, const char *output) {
  row_line = line;
  snprintf(row_output, sizeof row_output, "%s", output);
}

/* The members of an event that has a message. */
static void put_message(cs_json *event, const char *name, const int64_t *number, const char *text) {
  cs_json_begin(event);
  cs_json_text(event, "event", name);
  if (row_output[0]) {
    cs_json_integer(event, "line", row_line);
    cs_json_text(event, "output", row_output);
  }
  if (number)
    cs_json_integer(event, "number", *number);
  cs_json_text(event, "message", text);
  cs_report_event(event);
}

/* The bytes of a printed text up to its first new line, at most PIECE, and no part of a character
 * at the end. */
static size_t size_of_piece(const char *text, size_t size) {
  size_t most = size < PIECE ? size : PIECE, end = 0;
  while (most < size && most > PIECE - 3 && (text[most] & 0xc0) == 0x80)
    most--;
  while (end < most && text[end] != '\n')
    end++;
  return end;
}

/* A text that a script printed, as events. */
static void print_pieces(const char *text, size_t size) {
  for (size_t used; size > 0; text += used, size -= used) {
    cs_json event;
    char piece[PIECE + 1];
    used = size_of_piece(text, size);
    for (size_t i = 0; i < used; i++)
      piece[i] = text[i] ? text[i] : '?';
    piece[used] = 0;
    put_message(&event, "print", NULL, piece);
    used += used < size && text[used] == '\n';
  }
}

void cs_report_printed(void *user, const char *text, size_t size) {
  (void)user;
  if (chosen == CS_REPORT_JSON) {
    print_pieces(text, size);
    return;
  }
  bool is_shown = isatty(STDERR_FILENO);
  for (size_t used; is_shown && size > 0; text += used, size -= used) {
    char shown[SHOWN];
    used = visible_first(text, size, shown);
    fputs(shown, stderr);
  }
  fwrite(text, 1, size, stderr);
}

static void print_words(bool is_error, const char *visible) {
  if (clear_line)
    clear_line();
  fprintf(stderr, "celspan: %s%s\n", is_error ? "error: " : "", visible);
}

/* number: NULL, or the number of the frame that failed. */
static void print_event(bool is_error, const int64_t *number, const char *text) {
  cs_json event;
  put_message(&event, is_error ? "error" : "note", number, text);
}

/* A log that can no longer be written is said once, and not there. */
static void log_words(bool is_error, const char *visible) {
  if (!cs_log_add(is_error ? CS_LOG_ERROR : CS_LOG_NOTE, visible))
    print_words(true, "the log of --log ends here: it cannot be written");
}

static void print_text(bool is_error, const int64_t *number, char *text) {
  char visible[VISIBLE];
  make_visible(text, visible);
  if (is_error)
    snprintf(last, sizeof last, "%s", text);
  if (chosen == CS_REPORT_JSON)
    print_event(is_error, number, text);
  else
    print_words(is_error, visible);
  log_words(is_error, visible);
  if (chosen == CS_REPORT_OPENJD && is_error)
    print_openjd("fail", text);
}

__attribute__((format(printf, 2, 0))) static void print_line(bool is_error, const char *format,
                                                             va_list arguments) {
  char text[SENTENCE];
  vsnprintf(text, sizeof text, format, arguments);
  print_text(is_error, NULL, text);
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

void cs_report_progress(const char *format, ...) {
  char text[SENTENCE], visible[VISIBLE];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  make_visible(text, visible);
  print_words(false, visible);
}

void cs_report_log(const char *format, ...) {
  char text[SENTENCE], visible[VISIBLE];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  make_visible(text, visible);
  log_words(false, visible);
}

cs_exit cs_report_usage(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  print_line(true, format, arguments);
  va_end(arguments);
  return CS_EXIT_USAGE;
}

/* where: NULL, or the text before the message. number: as in print_event. */
static cs_exit fail(const celspan_context *context, celspan_status status, const char *where,
                    const int64_t *number) {
  char text[SENTENCE];
  if (status == CELSPAN_OK)
    return CS_EXIT_OK;
  if (status == CELSPAN_CANCELLED || cs_interrupt_signal())
    return CS_EXIT_SIGNAL;
  const char *sentence = celspan_context_error(context);
  if (!sentence[0])
    sentence = celspan_status_name(status);
  bool has_where = where && where[0];
  snprintf(text, sizeof text, "%s%s%s%s", has_where ? where : "", has_where ? ": " : "", sentence,
           status == CELSPAN_INTERNAL ? " (a fault of celspan itself: please report it)" : "");
  print_text(true, number, text);
  return cs_report_exit(status);
}

cs_exit cs_report_failure(const celspan_context *context, celspan_status status,
                          const char *where) {
  return fail(context, status, where, NULL);
}

cs_exit cs_report_frame_failure(const celspan_context *context, celspan_status status,
                                int64_t number) {
  return fail(context, status, NULL, &number);
}

void cs_report_before_line(void (*clear)(void)) { clear_line = clear; }

/* Whether standard output is a pipe that nobody reads any more, as after `| head -1`. */
static bool is_pipe_closed(void) {
  struct pollfd output = {.fd = STDOUT_FILENO};
  return poll(&output, 1, 0) == 1 && (output.revents & (POLLERR | POLLHUP)) != 0;
}

static cs_exit judge_output(cs_exit outcome, bool is_good) {
  const char *problem = errno ? strerror(errno) : "not everything was written";
  if (is_good || outcome != CS_EXIT_OK)
    return outcome; /* a run that failed has already reported the reason */
  if (!is_pipe_closed())
    cs_report_error("standard output: %s", problem);
  return CS_EXIT_OUTPUT;
}

cs_exit cs_report_flush_output(cs_exit outcome) {
  errno = 0;
  bool is_flushed = fflush(stdout) == 0;
  return judge_output(outcome, is_flushed && !ferror(stdout));
}

cs_exit cs_report_close_output(cs_exit outcome) {
  outcome = cs_report_flush_output(outcome);
  errno = 0;
  return judge_output(outcome, fclose(stdout) == 0);
}
