/* A program that is linked statically, with the module of drawings and type: it has no others. */
#include <string.h>

#include "base/module.h"

/* Of src/kit/plugins/type, which comes after this folder: the linker knows it. */
const void *celspan_type_module(void);

celspan_status cs_module_load(celspan_context *context, const cs_module_desc *desc,
                              uint32_t version, celspan_status failure, const void **table) {
  (void)version; /* both were built together */
  if (strcmp(desc->file, cs_modules_type.file) != 0)
    return cs_fail(context, failure, "this celspan has no %s: it is that of web pages",
                   desc->purpose);
  *table = celspan_type_module();
  return CELSPAN_OK;
}
