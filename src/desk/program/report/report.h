/* Diagnostics: exit codes, and lines on standard error.
 *
 * INVARIANT  Every exit code of the program is named here and nowhere else, and every diagnostic
 * leaves through this file, so that a progress bar can be cleared first and standard output
 * carries nothing but data.
 */
#pragma once

#include "celspan/celspan.h"
#include "program/report/json.h"

typedef enum cs_exit {
  CS_EXIT_OK = 0,
  CS_EXIT_DIFFERENT = 1, /* compare: not the same */
  CS_EXIT_PARTIAL = 1,   /* some frames failed under --keep-going */
  CS_EXIT_USAGE = 2,
  CS_EXIT_SCRIPT = 3, /* the script failed, or its scene was refused */
  CS_EXIT_INPUT = 4,
  CS_EXIT_OUTPUT = 5,
  CS_EXIT_LIMIT = 6,
  CS_EXIT_MEMORY = 33, /* render farms read this number as "more memory, then again" */
  CS_EXIT_INTERNAL = 70,
  CS_EXIT_SIGNAL = 128 /* main() ends by the signal; its number is added */
} cs_exit;

/* Returns the exit code of a call from the function, unless it is OK. */
#define CS_TRY_EXIT(call)                                                                          \
  do {                                                                                             \
    cs_exit try_exit_ = (call);                                                                    \
    if (try_exit_ != CS_EXIT_OK)                                                                   \
      return try_exit_;                                                                            \
  } while (0)

/* The exit code of a call. */
cs_exit cs_report_exit(celspan_status status);

/* "celspan: error: ..." */
void cs_report_error(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* "celspan: ..." */
void cs_report_note(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* A line of progress: like a note, but not in the log of --log, which has frames of its own. */
void cs_report_progress(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* A line that only the log has. */
void cs_report_log(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* The last error that was reported, cut if it was long; NULL: there was none. */
const char *cs_report_last(void);
/* Reports an error and returns CS_EXIT_USAGE. */
cs_exit cs_report_usage(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* Reports the context's sentence, after "where: " if where is not NULL or empty, and returns the
 * exit code. Reports nothing for CANCELLED, or after a signal to stop. */
cs_exit cs_report_failure(const celspan_context *context, celspan_status status, const char *where);

/* The same for a frame. Its number is added for programs that read the diagnostics; the context's
 * sentence contains it already. */
cs_exit cs_report_frame_failure(const celspan_context *context, celspan_status status,
                                int64_t number);

/* From now on events are about this row of a table: its line, and the file that it makes;
 * output "": about no row. */
void cs_report_row(int64_t line, const char *output);

/* Writes a script's output to standard error: as events "print", a line each or a part of a long
 * one, if diagnostics are JSON; on a terminal, only characters that it may show. user: not used. */
void cs_report_printed(void *user, const char *text, size_t size);

/* The form of diagnostics. */
typedef enum cs_report_form {
  CS_REPORT_WORDS = 0, /* "celspan: error: ..." */
  /* {"event":"error","number":3,"message":"..."}; the number only for a frame, and before it "line"
   * and "output" for a row */
  CS_REPORT_JSON,
  CS_REPORT_OPENJD /* in words, with errors on standard output, too: "openjd_fail: ..." */
} cs_report_form;

void cs_report_choose(cs_report_form form);
/* Writes an event as a line on standard error. */
void cs_report_event(cs_json *event);
/* "openjd_NAME: ..." on standard output, at once. */
void cs_report_openjd(const char *name, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Sets a function that is called before each line on standard error, to clear the progress bar
 * there; NULL: there is none. */
void cs_report_before_line(void (*clear)(void));

/* Writes the remaining bytes of standard output. Returns the outcome; if this is OK but not
 * everything could be written, CS_EXIT_OUTPUT, which is reported unless the output is a pipe that
 * nobody reads any more: in this case the reader has seen enough. */
cs_exit cs_report_flush_output(cs_exit outcome);
/* Closes standard output. Returns the same as the function above. */
cs_exit cs_report_close_output(cs_exit outcome);
