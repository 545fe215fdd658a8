/* celspan probe SCRIPT X Y: one point by direct evaluation of the tree. */
#include <stdio.h>

#include "cli/shot.h"
#include "cli/verbs.h"

static cs_exit read_point(const cs_request *request, celspan_point *out) {
  if (cs_value_number(request->operands[1], &out->x) != CS_VALUE_READ)
    return cs_report_usage("X: '%s' is not a number of film units", request->operands[1]);
  if (cs_value_number(request->operands[2], &out->y) != CS_VALUE_READ)
    return cs_report_usage("Y: '%s' is not a number of film units", request->operands[2]);
  return CS_EXIT_OK;
}

static cs_exit run(cs_shot *shot, const cs_request *request, celspan_point point) {
  celspan_frame_desc frame;
  cs_exit outcome = cs_shot_frame(shot, request, &frame);
  if (outcome != CS_EXIT_OK)
    return outcome;
  double rgba[4];
  celspan_status status = celspan_probe(shot->context, frame.exposures, frame.exposure_count,
                                        frame.film_width, frame.film_height, point, rgba);
  if (status == CELSPAN_OK)
    printf("%.9g %.9g %.9g %.9g\n", rgba[0], rgba[1], rgba[2], rgba[3]);
  return cs_shot_failure(shot, status);
}

cs_exit cs_probe_run(celspan_context *context, const cs_request *request) {
  celspan_point point;
  cs_exit outcome = read_point(request, &point);
  if (outcome != CS_EXIT_OK)
    return outcome;
  cs_shot shot;
  outcome = cs_shot_open(context, request, &shot);
  if (outcome == CS_EXIT_OK)
    outcome = run(&shot, request, point);
  cs_shot_close(&shot);
  return outcome;
}
