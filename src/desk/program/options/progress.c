#include "program/options/progress.h"

#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "inside/clock.h"
#include "process/interrupt.h"
#include "program/report/report.h"

enum { BAR_WIDTH = 30, TERMINAL_WIDTH_DEFAULT = 80 };

static void clear_bar(void) { fputs("\r\033[K", stderr); }

void cs_progress_choose(cs_progress_style style) {
  cs_report_choose(style == CS_PROGRESS_JSON     ? CS_REPORT_JSON
                   : style == CS_PROGRESS_OPENJD ? CS_REPORT_OPENJD
                                                 : CS_REPORT_WORDS);
}

static void start_json(size_t frame_count) {
  cs_json event;
  cs_json_begin(&event);
  cs_json_text(&event, "event", "start");
  cs_json_integer(&event, "count", (int64_t)frame_count);
  cs_report_event(&event);
}

/* A log may belong to many runs: a line of their beginning and their end says which. */
static void log_run(const cs_progress *progress, const char *what, const char *how) {
  bool has_output = progress->output != NULL;
  cs_report_log("%s: %s%s%s", what, has_output ? progress->output : "", has_output ? ": " : "",
                how);
}

static void log_start(const cs_progress *progress) {
  char how[48];
  snprintf(how, sizeof how, "%zu frame%s", progress->frame_count,
           progress->frame_count == 1 ? "" : "s");
  log_run(progress, "begins", how);
}

void cs_progress_start(cs_progress *progress, const cs_request *request, cs_progress_style style,
                       size_t frame_count) {
  cs_request_read(request, "--progress", &style);
  *progress = (cs_progress){.frame_count = frame_count,
                            .noun = "frame",
                            .output = cs_request_text(request, "-o"),
                            .started = cs_clock_seconds()};
  /* A log gets at most one line a second by default; with the style for lines, one for every
   * frame. */
  progress->pause = style == CS_PROGRESS_LINES ? 0 : 1;
  if (style == CS_PROGRESS_AUTO)
    style = isatty(STDERR_FILENO) ? CS_PROGRESS_BAR : CS_PROGRESS_LINES;
  if (style == CS_PROGRESS_BAR) {
    progress->pause = 0.1;
    cs_report_before_line(clear_bar);
  }
  progress->style = style;
  progress->shown = progress->started;
  log_start(progress);
  if (style == CS_PROGRESS_JSON)
    start_json(frame_count);
  if (style == CS_PROGRESS_OPENJD)
    cs_report_openjd("progress", "0");
}

static size_t format_seconds(char *out, size_t size, double seconds) {
  long whole = seconds < 1e7 ? (long)(seconds + 0.5) : 10000000L;
  int length = whole < 3600 ? snprintf(out, size, "%ld:%02ld", whole / 60, whole % 60)
                            : snprintf(out, size, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60,
                                       whole % 60);
  return length > 0 ? (size_t)length : 0;
}

/* "0:34 left", or "" while too little is done for an estimate. */
static void format_left(char *out, size_t size, const cs_progress *progress, double fraction,
                        double now) {
  out[0] = '\0';
  double elapsed = now - progress->started;
  if (fraction <= 0 || fraction >= 1 || elapsed < 1)
    return;
  size_t length = format_seconds(out, size, elapsed * (1 - fraction) / fraction);
  snprintf(out + length, size - length, " left");
}

static double fraction_done(const cs_progress *progress) {
  return (double)progress->frames_done / (double)progress->frame_count;
}

static int percent(double fraction) { return fraction >= 1 ? 100 : (int)(100 * fraction); }

static int terminal_width(void) {
  struct winsize window;
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0)
    return window.ws_col;
  return TERMINAL_WIDTH_DEFAULT;
}

static void draw_bar(const cs_progress *progress, double fraction, double now) {
  char bar[BAR_WIDTH + 1], left[48], line[160];
  int full = (int)(fraction * BAR_WIDTH);
  for (int i = 0; i < BAR_WIDTH; i++)
    bar[i] = i < full ? '#' : '.';
  bar[BAR_WIDTH] = '\0';
  format_left(left, sizeof left, progress, fraction, now);
  size_t current = progress->frames_done + (progress->frames_done < progress->frame_count);
  snprintf(line, sizeof line, "[%s] %3d %%  %s %zu of %zu  %s", bar, percent(fraction),
           progress->noun, current, progress->frame_count, left);
  clear_bar();
  fprintf(stderr, "%.*s", terminal_width() - 1, line);
  fflush(stderr);
}

bool cs_progress_tick(cs_progress *progress, double share) {
  double now = cs_clock_seconds();
  if (progress->style == CS_PROGRESS_BAR && now - progress->shown >= progress->pause) {
    draw_bar(progress, ((double)progress->frames_done + share) / (double)progress->frame_count,
             now);
    progress->shown = now;
  }
  return cs_interrupt_signal() == 0;
}

static void print_line(const cs_progress *progress, int64_t frame, const char *what, double now) {
  char left[48];
  double fraction = fraction_done(progress);
  format_left(left, sizeof left, progress, fraction, now);
  cs_report_progress("%s %lld: %s (%zu of %zu, %d %%%s%s)", progress->noun, (long long)frame, what,
                     progress->frames_done, progress->frame_count, percent(fraction),
                     left[0] ? ", " : "", left);
}

static void count_json(const cs_progress *progress, cs_json *event) {
  cs_json_integer(event, "done", (int64_t)progress->frames_done);
  cs_json_integer(event, "count", (int64_t)progress->frame_count);
}

static void print_json(const cs_progress *progress, int64_t frame, const char *what,
                       const char *how, double now) {
  cs_json event;
  double fraction = fraction_done(progress), elapsed = now - progress->started;
  cs_json_begin(&event);
  cs_json_text(&event, "event", progress->noun);
  cs_json_integer(&event, "number", frame);
  cs_json_text(&event, "output", what);
  cs_json_text(&event, "how", how);
  count_json(progress, &event);
  cs_json_number(&event, "percent", 100 * fraction);
  cs_json_number(&event, "seconds", elapsed);
  cs_json_number(&event, "left", elapsed * (1 - fraction) / fraction);
  cs_report_event(&event);
}

static void print_openjd(const cs_progress *progress, int64_t frame, const char *what) {
  cs_report_openjd("progress", "%.2f", 100 * fraction_done(progress));
  cs_report_openjd("status", "%s %lld: %s (%zu of %zu)", progress->noun, (long long)frame, what,
                   progress->frames_done, progress->frame_count);
}

void cs_progress_frame(cs_progress *progress, int64_t frame, const char *what, const char *how) {
  double now = cs_clock_seconds();
  progress->frames_done++;
  cs_report_log("%s %lld: %s: %s (%zu of %zu)", progress->noun, (long long)frame, what, how,
                progress->frames_done, progress->frame_count);
  progress->copied += strcmp(how, "copied") == 0;
  progress->kept += strcmp(how, "kept") == 0;
  if (progress->style == CS_PROGRESS_JSON)
    print_json(progress, frame, what, how, now);
  if (progress->style == CS_PROGRESS_OPENJD)
    print_openjd(progress, frame, what);
  if (progress->style != CS_PROGRESS_LINES || now - progress->shown < progress->pause)
    return;
  print_line(progress, frame, what, now);
  progress->shown = now;
}

/* The exit code of the program, which is 128 plus its number after a signal. */
static int exit_of(int outcome) {
  int stopped_by = cs_interrupt_signal();
  return stopped_by ? CS_EXIT_SIGNAL + stopped_by : outcome;
}

static void end_json(const cs_progress *progress, cs_progress_failures failed, int outcome) {
  cs_json event;
  cs_json_begin(&event);
  cs_json_text(&event, "event", "end");
  count_json(progress, &event);
  cs_json_integer(&event, "copied", (int64_t)progress->copied);
  cs_json_integer(&event, "kept", (int64_t)progress->kept);
  cs_json_number(&event, "seconds", cs_clock_seconds() - progress->started);
  cs_json_integer(&event, "exit", exit_of(outcome));
  cs_json_integer(&event, "failures", (int64_t)failed.count);
  cs_json_integers(&event, "failed", failed.frames, failed.count);
  cs_report_event(&event);
}

/* ", 96 copied"; "" for none. */
static const char *format_count(char *out, size_t size, size_t count, const char *how) {
  if (count > 0)
    snprintf(out, size, ", %zu %s", count, how);
  else
    out[0] = '\0';
  return out;
}

static void end_words(const cs_progress *progress) {
  char taken[48], copied[64], kept[64];
  format_seconds(taken, sizeof taken, cs_clock_seconds() - progress->started);
  cs_report_progress(
      "%zu %s%s in %s (100 %%)%s%s", progress->frame_count, progress->noun,
      progress->frame_count == 1 ? "" : "s", taken,
      format_count(copied, sizeof copied, progress->copied, "copied from equal ones"),
      format_count(kept, sizeof kept, progress->kept, "kept"));
}

static void log_end(const cs_progress *progress, size_t failures, int outcome) {
  char how[192];
  snprintf(how, sizeof how, "%zu of %zu finished, %zu failed, in %.3f seconds, exit code %d",
           progress->frames_done, progress->frame_count, failures,
           cs_clock_seconds() - progress->started, exit_of(outcome));
  log_run(progress, "ends", how);
}

void cs_progress_end(cs_progress *progress, cs_progress_failures failed, int outcome) {
  if (progress->style == CS_PROGRESS_BAR) {
    clear_bar();
    cs_report_before_line(NULL);
  }
  log_end(progress, failed.count, outcome);
  if (progress->style == CS_PROGRESS_JSON)
    end_json(progress, failed, outcome);
  else if (progress->style != CS_PROGRESS_NONE && progress->frames_done == progress->frame_count)
    end_words(progress);
}
