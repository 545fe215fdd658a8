/* celspan spans SCRIPT|FILE: the spans of one frame as text, or with --stats their counts. */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "inside/clock.h"
#include "inside/frames.h"
#include "program/film/script.h"
#include "program/film/shown.h"
#include "program/options/verbs.h"

static void print_colour(const celspan_span *span, int32_t x) {
  float rgba[4];
  celspan_span_colour(span, x, rgba);
  printf(" %.9g %.9g %.9g %.9g", (double)rgba[0], (double)rgba[1], (double)rgba[2],
         (double)rgba[3]);
}

static void print_span(int32_t y, const celspan_span *span) {
  printf("%d %d %d ", y, span->x0, span->x1);
  switch (span->kind) {
  case CELSPAN_SPAN_SINGLE:
    fputs("single", stdout);
    print_colour(span, span->x0);
    break;
  case CELSPAN_SPAN_GRADIENT:
    fputs("gradient", stdout);
    print_colour(span, span->x0);
    print_colour(span, span->x1 - 1);
    break;
  case CELSPAN_SPAN_ARRAY:
    printf("array %d", span->x1 - span->x0);
    break;
  }
  putchar('\n');
}

static celspan_status print_row(void *user, celspan_context *context, int32_t y,
                                const celspan_span *spans, size_t span_count) {
  const int32_t *first_row = user;
  for (size_t i = 0; i < span_count; i++)
    print_span(*first_row + y, &spans[i]);
  (void)context;
  /* reported in the same way as for every text */
  return ferror(stdout) ? CELSPAN_OUTPUT : CELSPAN_OK;
}

/* On one line: "name value" for each, or an object. */
static void print_statistics(const celspan_statistics *s, cs_cache_counts kept, double seconds,
                             bool is_json) {
  const struct {
    const char *name;
    uint64_t count;
  } all[] = {{"rows", s->rows},
             {"spans", s->spans},
             {"single", s->single},
             {"gradient", s->gradient},
             {"array", s->array},
             {"pixels_in_arrays", s->pixels_in_arrays},
             {"maps", s->maps},
             {"maps_made", s->maps_made},
             {"swept", s->swept},
             {"rows_held", s->rows_held},
             {"colour_evaluations", s->colour_evaluations},
             {"allocations", s->allocations},
             {"peak_bytes", s->peak_bytes},
             {"bands_made", kept.made},
             {"bands_found", kept.found},
             {"bands_bytes", kept.bytes}};
  fputs(is_json ? "{" : "", stdout);
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    printf(is_json ? "\"%s\": %" PRIu64 ", " : "%s %" PRIu64 " ", all[i].name, all[i].count);
  printf(is_json ? "\"seconds\": %.6f}\n" : "seconds %.6f\n", seconds);
}

/* A line that says in words what was kept and what was made. */
static void print_work(const celspan_statistics *s, cs_cache_counts kept) {
  printf("cels: %" PRIu64 " drawn from kept maps, %" PRIu64 " from new maps, %" PRIu64
         " swept; rows: %" PRIu64 " made, %" PRIu64
         " taken from held bands; rows of blurs: %" PRIu64 " made, %" PRIu64
         " found again, %.1f MiB kept\n",
         s->maps - s->maps_made, s->maps_made, s->swept, s->rows - s->rows_held, s->rows_held,
         kept.made, kept.found, (double)kept.bytes / 1048576);
}

static celspan_status measure(celspan_context *context, const cs_request *request,
                              const celspan_frame_desc *frame) {
  celspan_coding coding = {.struct_size = sizeof coding};
  const celspan_sink nowhere = {.struct_size = sizeof nowhere, .row = NULL};
  celspan_statistics statistics = CELSPAN_STATISTICS;
  double started = cs_clock_seconds();
  celspan_status status = cs_request_read(request, "--pixels", &coding.depth)
                              ? celspan_frame_pixels(context, frame, &coding, NULL, 0, &statistics)
                              : celspan_frame_render(context, frame, &nowhere, &statistics);
  if (status != CELSPAN_OK)
    return status;
  cs_cache_counts kept = cs_defocus_bands_count(context);
  bool is_json = cs_request_has(request, "--json");
  print_statistics(&statistics, kept, cs_clock_seconds() - started, is_json);
  if (!is_json)
    print_work(&statistics, kept);
  return CELSPAN_OK;
}

static celspan_status print_spans(celspan_context *context, const celspan_frame_desc *frame) {
  int32_t first_row = frame->crop_y;
  celspan_sink sink = {.struct_size = sizeof sink, .user = &first_row, .row = print_row};
  return celspan_frame_render(context, frame, &sink, NULL);
}

/* The rows are a crop of full width, so that columns keep their numbers. */
static cs_exit set_rows(const cs_request *request, celspan_frame_desc *frame) {
  int32_t rows[2];
  if (!cs_request_read(request, "--rows", rows))
    return CS_EXIT_OK;
  if (rows[1] >= frame->height)
    return cs_report_usage("--rows %d-%d: the frame has rows 0 to %d", rows[0], rows[1],
                           frame->height - 1);
  frame->crop_y = rows[0];
  frame->crop_width = frame->width;
  frame->crop_height = rows[1] - rows[0] + 1;
  return CS_EXIT_OK;
}

static cs_exit run(cs_script *script, const cs_request *request) {
  celspan_frame_desc frame;
  CS_TRY_EXIT(cs_script_frame(script, request, &frame));
  CS_TRY_EXIT(set_rows(request, &frame));
  celspan_status status = cs_request_has(request, "--stats")
                              ? measure(script->context, request, &frame)
                              : print_spans(script->context, &frame);
  return ferror(stdout) ? cs_report_flush_output(CS_EXIT_OK) : cs_script_failure(script, status);
}

static cs_exit print_still(celspan_context *context, const cs_request *request,
                           const cs_still *still) {
  celspan_frame_desc frame;
  CS_TRY_EXIT(cs_shown_frame(request, still, &frame));
  CS_TRY_EXIT(set_rows(request, &frame));
  celspan_sink sink = {.struct_size = sizeof sink, .user = &frame.crop_y, .row = print_row};
  celspan_status status = cs_still_render(context, still, &frame, &sink);
  return ferror(stdout) ? cs_report_flush_output(CS_EXIT_OK)
                        : cs_report_failure(context, status, NULL);
}

static cs_exit run_plane(celspan_context *context, const cs_request *request, const char *path) {
  cs_still still = {0};
  if (cs_request_has(request, "--stats"))
    return cs_report_usage("--stats: %s is a plane, of which 'celspan info' gives figures", path);
  cs_exit outcome = cs_shown_open(context, request, path, true, &still);
  if (outcome == CS_EXIT_OK)
    outcome = print_still(context, request, &still);
  cs_still_close(&still);
  return outcome;
}

cs_exit cs_verb_spans(celspan_context *context, const cs_request *request) {
  if (cs_request_has(request, "--pixels") && !cs_request_has(request, "--stats"))
    return cs_report_usage("--pixels needs --stats");
  if (cs_request_has(request, "--json") && !cs_request_has(request, "--stats"))
    return cs_report_usage("--json needs --stats");
  if (!request->script && cs_plane_accepts(request->operands[0]))
    return run_plane(context, request, request->operands[0]);
  return cs_script_run(context, request, run);
}
