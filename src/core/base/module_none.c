/* A program that is linked statically has no loader, and so no modules. */
#include "base/module.h"

celspan_status cs_module_load(celspan_context *context, const cs_module_desc *desc,
                              uint32_t version, celspan_status failure, const void **table) {
  (void)version, (void)table;
  return cs_fail(context, failure,
                 "%s needs the module %s, which this program cannot load: it was built with "
                 "-Dmodules=false",
                 desc->purpose, desc->file);
}
