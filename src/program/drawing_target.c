#include "program/drawing_target.h"

#include <string.h>

#include "frames/film/sequence.h"

static const int usual_precision = 3;
static const double usual_scale = 2;

static bool makes_drawings(const cs_verb *verb) {
  const cs_option *option = verb->options;
  while (option->name && strcmp(option->name, "--flat") != 0)
    option++;
  return option->name != NULL;
}

bool cs_drawing_target_is_wanted(const char *output, const cs_request *request) {
  return output && makes_drawings(request->verb) &&
         cs_plot_is_wanted(output, cs_request_text(request, "--format"));
}

static const char *output_of(const cs_request *request) {
  const char *output = cs_request_text(request, "-o");
  return output || request->operand_count < 2 ? output : request->operands[1];
}

bool cs_drawing_target_is_output(const cs_request *request) {
  return cs_drawing_target_is_wanted(output_of(request), request);
}

static bool is_pdf(const char *output, const cs_request *request) {
  return cs_plot_is_pdf(output, cs_request_text(request, "--format"));
}

bool cs_drawing_target_is_film(const cs_request *request) {
  const char *output = output_of(request);
  return cs_drawing_target_is_wanted(output, request) && is_pdf(output, request) &&
         !cs_sequence_has_number(output);
}

cs_plot_desc cs_drawing_target_read(const cs_request *request) {
  cs_plot_desc desc = {.precision = usual_precision, .scale = usual_scale};
  int32_t size[2] = {0, 0};
  cs_request_read(request, "--flat", &desc.flat);
  cs_request_read(request, "--precision", &desc.precision);
  cs_request_read(request, "--scale", &desc.scale);
  cs_request_read(request, "--size", size);
  desc.width = size[0];
  desc.height = size[1];
  desc.is_pdf = is_pdf(output_of(request), request);
  return desc;
}

cs_exit cs_drawing_target_refuse_own(const char *output, const cs_request *request) {
  static const char *const own[] = {"--flat", "--precision"};
  for (size_t i = 0; i < sizeof own / sizeof *own; i++)
    if (cs_request_has(request, own[i]))
      return cs_report_usage("%s: %s is for drawings: give -o shot.####.svg", output, own[i]);
  return CS_EXIT_OK;
}

cs_exit cs_drawing_target_refuse(const char *output, const cs_request *request) {
  static const char *const others[] = {
      "--crop",  "--strip",  "--colour",    "--depth",     "--alpha",   "--dither", "--hash",
      "--draft", "--resume", "--antialias", "--no-dither", "--display", "--view",   "--fit"};
  if (!cs_drawing_target_is_wanted(output, request))
    return cs_drawing_target_refuse_own(output, request);
  for (size_t i = 0; i < sizeof others / sizeof *others; i++)
    if (cs_request_has(request, others[i]))
      return cs_report_usage("%s: %s is for pictures, and a drawing has no pixels: leave it out",
                             output, others[i]);
  if (is_pdf(output, request) && cs_request_has(request, "--precision"))
    return cs_report_usage("%s: --precision is for SVG: PDF has 1/256 point, on a page that --size "
                           "makes larger",
                           output);
  return CS_EXIT_OK;
}

void cs_drawing_target_report(const celspan_context *context, const char *path,
                              const cs_plot_desc *desc, const cs_plot_facts *facts) {
  const char *format = desc->is_pdf ? "PDF" : "SVG";
  if (facts->is_picture)
    cs_report_note("%s: is a picture of %d x %d pixels, because it has no vectors for this: %s",
                   path, (int)facts->picture_width, (int)facts->picture_height,
                   celspan_context_error(context));
  else if (facts->pictures == 1)
    cs_report_note("%s: what %s has no vectors for is a picture of %d x %d pixels, beside %zu "
                   "areas",
                   path, format, (int)facts->picture_width, (int)facts->picture_height,
                   facts->areas);
  else if (facts->pictures > 1)
    cs_report_note("%s: what %s has no vectors for is %zu pictures, the largest of %d x %d "
                   "pixels, beside %zu areas",
                   path, format, facts->pictures, (int)facts->picture_width,
                   (int)facts->picture_height, facts->areas);
}

/* Writes a file of one page: a frame, or else a plane. */
static celspan_status write_page(celspan_context *context, const celspan_frame_desc *frame,
                                 const celspan_plane *plane, const char *title, const char *path,
                                 const cs_request *request) {
  cs_plot *plot;
  cs_plot_facts facts;
  cs_plot_desc desc = cs_drawing_target_read(request);
  desc.title = title;
  CS_TRY(cs_plot_begin(context, path, &desc, &plot));
  celspan_status status =
      frame ? cs_plot_add_frame(plot, frame, &facts) : cs_plot_add_plane(plot, plane, &facts);
  CS_TRY(cs_plot_end(plot, status));
  cs_drawing_target_report(context, path, &desc, &facts);
  return CELSPAN_OK;
}

celspan_status cs_drawing_target_write_frame(celspan_context *context,
                                             const celspan_frame_desc *frame, const char *title,
                                             const char *path, const cs_request *request) {
  return write_page(context, frame, NULL, title, path, request);
}

celspan_status cs_drawing_target_write_plane(celspan_context *context, const celspan_plane *plane,
                                             const char *path, const cs_request *request) {
  return write_page(context, NULL, plane, NULL, path, request);
}
