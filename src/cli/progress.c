/* Progress on standard error. */
#include "cli/progress.h"

#include <stdio.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include "cli/interrupt.h"
#include "cli/report.h"

enum { BAR_WIDTH = 30, TERMINAL_WIDTH_DEFAULT = 80 };

double cs_progress_clock(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void clear_bar(void) { fputs("\r\033[K", stderr); }

void cs_progress_start(cs_progress *progress, cs_progress_style style, size_t frame_count) {
  *progress = (cs_progress){
      .frame_count = frame_count, .noun = "frame", .started = cs_progress_clock()};
  /* Unasked, a log gets a line a second at most; asked for, a line for every frame. */
  progress->pause = style == CS_PROGRESS_LINES ? 0 : 1;
  if (style == CS_PROGRESS_AUTO)
    style = isatty(STDERR_FILENO) ? CS_PROGRESS_BAR : CS_PROGRESS_LINES;
  if (style == CS_PROGRESS_BAR) {
    progress->pause = 0.1;
    cs_report_before_line(clear_bar);
  }
  progress->style = style;
  progress->shown = progress->started;
}

static size_t format_seconds(char *out, size_t size, double seconds) {
  long whole = seconds < 1e7 ? (long)(seconds + 0.5) : 10000000L;
  int length = whole < 3600 ? snprintf(out, size, "%ld:%02ld", whole / 60, whole % 60)
                            : snprintf(out, size, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60,
                                       whole % 60);
  return length > 0 ? (size_t)length : 0;
}

/* "0:34 left", or "" while too little is done to tell. */
static void format_left(char *out, size_t size, const cs_progress *progress, double fraction,
                        double now) {
  out[0] = '\0';
  double elapsed = now - progress->started;
  if (fraction <= 0 || fraction >= 1 || elapsed < 1)
    return;
  size_t length = format_seconds(out, size, elapsed * (1 - fraction) / fraction);
  snprintf(out + length, size - length, " left");
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

bool cs_progress_rows(void *user, int32_t rows_done, int32_t rows_total) {
  cs_progress *progress = user;
  double now = cs_progress_clock();
  if (progress->style == CS_PROGRESS_BAR && now - progress->shown >= progress->pause) {
    double part = rows_total > 0 ? (double)rows_done / rows_total : 0;
    draw_bar(progress, ((double)progress->frames_done + part) / (double)progress->frame_count, now);
    progress->shown = now;
  }
  return cs_interrupt_signal() == 0;
}

void cs_progress_frame(cs_progress *progress, int64_t frame, const char *what) {
  progress->frames_done++;
  double now = cs_progress_clock();
  if (progress->style != CS_PROGRESS_LINES || now - progress->shown < progress->pause)
    return;
  char left[48];
  double fraction = (double)progress->frames_done / (double)progress->frame_count;
  format_left(left, sizeof left, progress, fraction, now);
  cs_report_note("%s %lld: %s (%zu of %zu, %d %%%s%s)", progress->noun, (long long)frame, what,
                 progress->frames_done, progress->frame_count, percent(fraction),
                 left[0] ? ", " : "", left);
  progress->shown = now;
}

void cs_progress_end(cs_progress *progress) {
  if (progress->style == CS_PROGRESS_BAR) {
    clear_bar();
    cs_report_before_line(NULL);
  }
  if (progress->style == CS_PROGRESS_NONE || progress->frames_done < progress->frame_count)
    return;
  char taken[48];
  format_seconds(taken, sizeof taken, cs_progress_clock() - progress->started);
  cs_report_note("%zu %s%s in %s (100 %%)", progress->frame_count, progress->noun,
                 progress->frame_count == 1 ? "" : "s", taken);
}
