/* Drawings as output, x.svg and x.pdf; the options --flat, --precision and --scale of a request. */
#pragma once

#include "frames/parcels/plot.h"
#include "program/report.h"
#include "program/request.h"

/* Whether the verb makes a drawing for this name. output: NULL: there is none. */
bool cs_drawing_target_is_wanted(const char *output, const cs_request *request);
/* The same for the output that the request names. */
bool cs_drawing_target_is_output(const cs_request *request);
/* Whether it is one PDF, with a page for each frame. */
bool cs_drawing_target_is_film(const cs_request *request);
cs_plot_desc cs_drawing_target_read(const cs_request *request);
/* OK if the output can have what is asked for; otherwise the reason is reported. */
cs_exit cs_drawing_target_refuse(const char *output, const cs_request *request);
/* The same for the options of drawings alone, where the output is no drawing; output: for the
 * message. */
cs_exit cs_drawing_target_refuse_own(const char *output, const cs_request *request);
/* Says what has become a picture. path: of the file. */
void cs_drawing_target_report(const celspan_context *context, const char *path,
                              const cs_plot_desc *desc, const cs_plot_facts *facts);
/* Write a file of one page, with frames/parcels/plot.h, and report it. */
CELSPAN_CHECKED celspan_status cs_drawing_target_write_frame(celspan_context *context,
                                                             const celspan_frame_desc *frame,
                                                             const char *title, const char *path,
                                                             const cs_request *request);
CELSPAN_CHECKED celspan_status cs_drawing_target_write_plane(celspan_context *context,
                                                             const celspan_plane *plane,
                                                             const char *path,
                                                             const cs_request *request);
