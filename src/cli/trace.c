/* celspan trace IN -o OUT: a drawing as shapes, in SVG or a script. */
#include <string.h>
#include <strings.h>

#include "cli/verbs.h"
#include "trace/result.h"

static bool ends_with(const char *path, const char *ending) {
  size_t length = strlen(path), tail = strlen(ending);
  return length > tail && strcasecmp(path + length - tail, ending) == 0;
}

static celspan_trace_desc desc_of(const cs_request *request) {
  celspan_trace_desc desc = CELSPAN_TRACE_DESC;
  desc.picture.file = request->operands[0];
  if (request->colours.count > 0)
    desc.colours = request->colours.count;
  if (request->colours.has_codes)
    desc.codes = request->colours.codes;
  if (request->smooth >= 0)
    desc.smooth = request->smooth;
  if (request->speckle.is_given)
    desc.speckle = request->speckle.value;
  desc.lines = request->lines;
  return desc;
}

cs_exit cs_verb_trace(celspan_context *context, const cs_request *request) {
  const char *out = request->output;
  if (!out)
    return cs_report_usage("-o is needed: a file that ends in .svg or .lua");
  if (!ends_with(out, ".svg") && !ends_with(out, ".lua"))
    return cs_report_usage("-o: '%s' must end in .svg or .lua", out);
  celspan_trace_desc desc = desc_of(request);
  celspan_trace *trace;
  celspan_status status = cs_result_make(context, &desc, &trace);
  if (status == CELSPAN_OK) {
    status = celspan_trace_write(context, trace, out);
    celspan_trace_unref(trace);
  }
  return cs_report_failure(context, status, NULL);
}
