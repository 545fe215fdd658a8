#include "readers/type/xml.h"

#include <inttypes.h>
#include <string.h>

#include "readers/type/type_module.h"

const char *cs_xml_local_name(const char *name) {
  const char *blank = strrchr(name, ' ');
  return blank ? blank + 1 : name;
}

celspan_status cs_xml_parse(celspan_context *context, const char *name, const char *purpose,
                            const char *bytes, size_t size, const cs_xml_handler *handler,
                            const celspan_status *failure) {
  const cs_type_module *module;
  CS_TRY(cs_type_module_load(context, purpose, &module));
  cs_type_failure told = {.line = 0};
  celspan_status status = module->parse_xml(bytes, size, handler, &told);
  if (status == CELSPAN_OK || status == CELSPAN_CANCELLED)
    return status == CELSPAN_OK ? CELSPAN_OK : *failure;
  if (status == CELSPAN_NO_MEMORY)
    return cs_fail_memory(context);
  return cs_fail(context, status, "%s:%" PRIu64 ": %s", name, told.line, told.text);
}
