/* Drawings as PDF. */
#include "inside/module.h"
#include "writers/parcels/plot_text.h"

static bool put(void *user, const void *bytes, size_t size) {
  cs_plot_text *text = user;
  cs_plot_put_bytes(text, bytes, size);
  return text->status == CELSPAN_OK;
}

celspan_status cs_plot_pdf_open(cs_plot_text *text, cs_plotter *out) {
  const cs_pdf_output output = {
      .maker = cs_context_maker(text->context), .title = text->title, .put = put, .user = text};
  const void *table;
  CS_TRY(cs_module_load(text->context, &cs_modules_pdf, CS_PDF_MODULE_VERSION, CELSPAN_OUTPUT,
                        &table));
  const cs_pdf_module *module = table;
  return module->open(&output, out) == CELSPAN_OK ? CELSPAN_OK : cs_fail_memory(text->context);
}
