/* celspan convert IN OUT: any picture to any other. */
#include "cli/still.h"
#include "cli/target.h"
#include "cli/verbs.h"

cs_exit cs_verb_convert(celspan_context *context, const cs_request *request) {
  const char *path = request->operands[1];
  cs_exit outcome = cs_target_refuse(context, path, request);
  cs_still still = {.exposure.rostrum = NULL};
  if (outcome == CS_EXIT_OK)
    outcome = cs_still_open(context, request->operands[0], &still);
  celspan_frame_desc frame;
  if (outcome == CS_EXIT_OK)
    outcome = cs_still_frame(&still, request, &frame);
  if (outcome == CS_EXIT_OK) {
    celspan_file_desc file = cs_target_file(request);
    celspan_status status = cs_still_write(context, &still, &frame, path, &file);
    outcome = cs_report_failure(context, status, NULL);
  }
  cs_still_close(&still);
  return outcome;
}
