/* celspan probe SCRIPT X Y: the colour of one point, by direct evaluation of the scene. */
#include <stdio.h>

#include "cli/script.h"
#include "cli/verbs.h"

static cs_exit read_point(const cs_request *request, celspan_point *out) {
  if (cs_argument_number(request->operands[1], &out->x) != CS_ARGUMENT_READ)
    return cs_report_usage("X: '%s' is not a number of film units", request->operands[1]);
  if (cs_argument_number(request->operands[2], &out->y) != CS_ARGUMENT_READ)
    return cs_report_usage("Y: '%s' is not a number of film units", request->operands[2]);
  return CS_EXIT_OK;
}

static cs_exit run(cs_script *script, const cs_request *request, celspan_point point) {
  celspan_frame_desc frame;
  cs_exit outcome = cs_script_frame(script, request, &frame);
  if (outcome != CS_EXIT_OK)
    return outcome;
  double rgba[4];
  celspan_status status = celspan_probe(script->context, frame.exposures, frame.exposure_count,
                                        frame.film_width, frame.film_height, point, rgba);
  if (status == CELSPAN_OK)
    printf("%.9g %.9g %.9g %.9g\n", rgba[0], rgba[1], rgba[2], rgba[3]);
  return cs_script_failure(script, status);
}

cs_exit cs_verb_probe(celspan_context *context, const cs_request *request) {
  celspan_point point;
  cs_exit outcome = read_point(request, &point);
  if (outcome != CS_EXIT_OK)
    return outcome;
  cs_script script;
  outcome = cs_script_open(context, request, &script);
  if (outcome == CS_EXIT_OK)
    outcome = run(&script, request, point);
  cs_script_close(&script);
  return outcome;
}
