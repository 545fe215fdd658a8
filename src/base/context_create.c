/* The door of contexts: the only one where there is no context yet that could keep a message. */
#include "base/description.h"

celspan_status celspan_context_create(const celspan_context_desc *desc, celspan_context **out) {
  if (!desc)
    desc = cs_celspan_context_desc_description.defaults;
  CS_READ(NULL, "context", celspan_context_desc, desc);
  return cs_context_make(desc, out);
}
