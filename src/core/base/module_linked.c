/* A program that is linked statically with its modules: that of drawings and type, and perhaps that
 * of pictures. */
#include <string.h>

#include "base/module.h"

/* Of src/kit/plugins, which comes after this folder: the linker knows them. Weak: NULL, if it does
 * not. */
const void *celspan_type_module(void);
__attribute__((weak)) const void *celspan_picture_module(void);

celspan_status cs_module_load(celspan_context *context, const cs_module_desc *desc,
                              uint32_t version, celspan_status failure, const void **table) {
  (void)version; /* all were built together */
  bool is_type = strcmp(desc->file, cs_modules_type.file) == 0;
  bool is_picture = strcmp(desc->file, cs_modules_picture.file) == 0;
  if (!is_type && !(is_picture && celspan_picture_module))
    return cs_fail(context, failure, "this celspan has no %s: it is that of web pages",
                   desc->purpose);
  *table = is_type ? celspan_type_module() : celspan_picture_module();
  return CELSPAN_OK;
}
