#include "program/outputs/writers.h"

#include "inside/films.h"
#include "writers/plane/plane.h"

celspan_status cs_write_layers(celspan_context *context, const cs_request *request,
                               const cs_output *output, const cs_page *page) {
  cs_apart_contents contents = {.has_layers = cs_request_has(request, "--layers"),
                                .place = cs_sequence_place(cs_request_text(request, "-o"))};
  cs_request_read(request, "--cryptomatte", &contents.mattes);
  return cs_apart_write(context, output->layers, contents, page->frame, page->path, page->file);
}

/* ---------------------------------------------------------------- drawings */

cs_plot_desc cs_write_describe(const cs_request *request, bool is_pdf) {
  cs_plot_desc desc = {.precision = CS_PLOT_PRECISION, .scale = CS_PLOT_SCALE, .is_pdf = is_pdf};
  int32_t size[2] = {0, 0};
  cs_request_read(request, "--flat", &desc.flat);
  cs_request_read(request, "--precision", &desc.precision);
  cs_request_read(request, "--scale", &desc.scale);
  cs_request_read(request, "--size", size);
  desc.width = size[0];
  desc.height = size[1];
  return desc;
}

void cs_write_report(const celspan_context *context, const char *path, const cs_plot_desc *desc,
                     const cs_plot_facts *facts) {
  char text[CS_PLOT_SAID];
  if (cs_plot_say(context, path, desc, facts, text))
    cs_report_note("%s", text);
}

/* Writes a file of one page. */
static celspan_status write_drawing(celspan_context *context, cs_plot_desc *desc,
                                    const cs_page *page) {
  cs_plot *plot;
  cs_plot_facts facts;
  desc->title = page->file->title;
  CS_TRY(cs_plot_begin(context, page->path, desc, &plot));
  celspan_status status = page->plane ? cs_plot_add_plane(plot, page->plane, &facts)
                                      : cs_plot_add_frame(plot, page->frame, &facts);
  CS_TRY(cs_plot_end(plot, status));
  cs_write_report(context, page->path, desc, &facts);
  return CELSPAN_OK;
}

celspan_status cs_write_svg(celspan_context *context, const cs_request *request,
                            const cs_output *output, const cs_page *page) {
  cs_plot_desc desc = cs_write_describe(request, false);
  (void)output;
  return write_drawing(context, &desc, page);
}

celspan_status cs_write_pdf(celspan_context *context, const cs_request *request,
                            const cs_output *output, const cs_page *page) {
  cs_plot_desc desc = cs_write_describe(request, true);
  (void)output;
  return write_drawing(context, &desc, page);
}

/* ---------------------------------------------------------------- planes */

celspan_status cs_write_plane(celspan_context *context, const cs_request *request,
                              const cs_output *output, const cs_page *page) {
  (void)request, (void)output;
  return cs_plane_write_frame(context, page->frame, page->path,
                              cs_plane_depth(page->file->coding->depth));
}
