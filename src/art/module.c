/* The table of functions that the core finds in this module. */
#include "artwork/module.h"

#include "art/type.h"
#include "art/xml.h"

const void *celspan_art_module(void) {
  static const cs_art_module table = {
      .version = CS_ART_MODULE_VERSION,
      .parse_xml = cs_art_parse_xml,
      .type = &cs_art_type,
  };
  return &table;
}
