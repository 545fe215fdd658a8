#include "readers/type/type_module.h"

#include "inside/module.h"

/* The part of a context that belongs to the module: its table, NULL until it is loaded. Two threads
 * that load it at once get the same table. */
typedef struct loaded_module {
  cs_service service;
  cs_memory *memory;
  _Atomic(const cs_type_module *) table;
} loaded_module;

static celspan_status create(celspan_context *context, cs_service **out) {
  loaded_module *loaded;
  CS_TRY(CS_MAKE(context, loaded, 1));
  loaded->memory = context->memory;
  *out = &loaded->service;
  return CELSPAN_OK;
}

static void destroy(cs_service *service) {
  loaded_module *loaded = (loaded_module *)service;
  cs_mem_free(loaded->memory, loaded, sizeof *loaded);
}

static const cs_service_kind loaded_kind = {create, destroy, NULL};

static celspan_status load(celspan_context *context, const char *purpose,
                           const cs_type_module **out) {
  cs_module_desc desc = cs_modules_type;
  const void *table;
  desc.purpose = purpose;
  CS_TRY(cs_module_load(context, &desc, CS_TYPE_MODULE_VERSION, CELSPAN_INPUT, &table));
  *out = table;
  return CELSPAN_OK;
}

celspan_status cs_type_module_load(celspan_context *context, const char *purpose,
                                   const cs_type_module **out) {
  cs_service *service;
  CS_TRY(cs_context_service(context, &loaded_kind, &service));
  loaded_module *loaded = (loaded_module *)service;
  const cs_type_module *module = atomic_load_explicit(&loaded->table, memory_order_acquire);
  if (!module) {
    CS_TRY(load(context, purpose, &module));
    atomic_store_explicit(&loaded->table, module, memory_order_release);
  }
  *out = module;
  return CELSPAN_OK;
}
