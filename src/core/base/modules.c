/* The modules that celspan has. */
#include "base/module.h"

/* with: whether this celspan was built with the module; if not, it lacks `libraries`, and the
 * option that adds them is `option`. package: what to install if only the module is missing. */
#define MODULE(name, capitals, place, with, libraries, option, package)                            \
  .file = "celspan-" name ".so", .folder = "kit/plugins/" place,                                   \
  .override = "CELSPAN_" capitals "_MODULE", .symbol = "celspan_" name "_module",                  \
  .advice = (with) ? "install " package                                                            \
                   : "this celspan was built without " libraries "; build it with -D" option       \
                     "=enabled"

static const cs_module_desc raster = {
    .file = "celspan-raster.so",
    .folder = "kit/plugins/raster",
    .override = "CELSPAN_PICTURE_MODULE",
    .symbol = "celspan_picture_module",
    .purpose = "reading and writing pictures",
    .advice = "install celspan again",
};

const cs_module_desc cs_modules_picture = {
    MODULE("picture", "PICTURE", "oiio", CELSPAN_WITH_PICTURES,
           "OpenImageIO, so it writes PNG, Targa and span files and reads no pictures", "pictures",
           "OpenImageIO and the celspan package with pictures"),
    .purpose = "reading and writing pictures",
    .other = &raster,
};

const cs_module_desc cs_modules_type = {
    MODULE("type", "TYPE", "type", CELSPAN_WITH_TYPE, "expat, HarfBuzz, FriBidi and libunibreak",
           "type", "the celspan package with drawings and type"),
};

const cs_module_desc cs_modules_colour = {
    MODULE("colour", "COLOUR", "icc", CELSPAN_WITH_COLOUR, "Little CMS", "colour",
           "Little CMS and the celspan package with colour profiles"),
    .purpose = "reading colour profiles",
};

const cs_module_desc cs_modules_space = {
    MODULE("space", "SPACE", "ocio", CELSPAN_WITH_SPACES, "OpenColorIO", "spaces",
           "OpenColorIO and the celspan package with colour spaces"),
    .purpose = "writing in spaces of OpenColorIO",
};

const cs_module_desc cs_modules_pdf = {
    MODULE("pdf", "PDF", "cairo", CELSPAN_WITH_PDF, "Cairo", "pdf",
           "Cairo and the celspan package with the PDF module"),
    .purpose = "writing PDF",
};

const cs_module_desc cs_modules_web = {
    MODULE("web", "WEB", "web", CELSPAN_WITH_WEB, "libmicrohttpd", "web",
           "libmicrohttpd and the celspan package with the web module"),
    .purpose = "showing a film in a browser",
};
