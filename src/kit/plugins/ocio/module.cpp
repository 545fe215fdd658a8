/* The table of functions that the program finds in this module. */
#include "plugins/ocio/module.h"

#include <cstdio>
#include <memory>
#include <new>

#include "plugins/ocio/conversion.h"

struct cs_space_conversion {
  Conversion made;
  std::string digest;
};

namespace {

celspan_status fail(cs_picture_failure *failure, celspan_status status, const char *text) {
  failure->status = status;
  snprintf(failure->text, sizeof failure->text, "%s", text);
  return status;
}

std::string text_of(const char *text) { return text ? text : ""; }

celspan_status open(const cs_space_request *request, cs_space_conversion **out,
                    cs_picture_failure *failure) {
  try {
    auto conversion = std::make_unique<cs_space_conversion>();
    conversion->made = make_conversion({request->file, text_of(request->space),
                                        text_of(request->display), text_of(request->view), false});
    conversion->digest = conversion->made.processor->getCacheID();
    *out = conversion.release();
    return CELSPAN_OK;
  } catch (const std::bad_alloc &) {
    return fail(failure, CELSPAN_NO_MEMORY, "out of memory");
  } catch (const std::exception &e) {
    return fail(failure, CELSPAN_BAD_ARGUMENT, e.what());
  } catch (...) {
    return fail(failure, CELSPAN_BAD_ARGUMENT, "the colour library failed");
  }
}

const char *name(const cs_space_conversion *conversion) { return conversion->made.name.c_str(); }

const char *digest(const cs_space_conversion *conversion) { return conversion->digest.c_str(); }

void convert(void *conversion, float *rgba, size_t count) {
  apply_conversion(static_cast<const cs_space_conversion *>(conversion)->made, rgba, count);
}

void close(cs_space_conversion *conversion) { delete conversion; }

} // namespace

const void *celspan_space_module(void) {
  static const cs_space_module table = {
      CS_SPACE_MODULE_VERSION, open, name, digest, convert, close};
  return &table;
}
