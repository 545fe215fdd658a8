/* The writers of files of one frame that celspan_frame_write does not write: with layers, drawings,
 * planes. Each fails with the errors of its format.
 */
#pragma once

#include "program/film/output.h"
#include "writers/parcels/plot.h"

/* ---- with layers, or mattes: of --layers and --cryptomatte */

CELSPAN_CHECKED celspan_status cs_write_layers(celspan_context *context, const cs_request *request,
                                               const cs_output *output, const cs_page *page);

/* ---- drawings: of --flat, --precision and --scale; what becomes a picture is reported */

CELSPAN_CHECKED celspan_status cs_write_svg(celspan_context *context, const cs_request *request,
                                            const cs_output *output, const cs_page *page);
CELSPAN_CHECKED celspan_status cs_write_pdf(celspan_context *context, const cs_request *request,
                                            const cs_output *output, const cs_page *page);
cs_plot_desc cs_write_describe(const cs_request *request, bool is_pdf);
/* Says what has become a picture. path: of the file. */
void cs_write_report(const celspan_context *context, const char *path, const cs_plot_desc *desc,
                     const cs_plot_facts *facts);

/* ---- planes */

CELSPAN_CHECKED celspan_status cs_write_plane(celspan_context *context, const cs_request *request,
                                              const cs_output *output, const cs_page *page);
