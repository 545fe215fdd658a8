/* Where contexts are created: the only function that checks a description without a context for its
 * message. */
#include "base/description.h"

celspan_status celspan_context_create(const celspan_context_desc *desc, celspan_context **out) {
  if (!desc)
    desc = cs_celspan_context_desc_description.defaults;
  CS_READ(NULL, "context", celspan_context_desc, desc);
  return cs_context_make(desc, out);
}
