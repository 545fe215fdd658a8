#include "program/outputs/target.h"

#include "program/film/spaces.h"

celspan_coding cs_target_coding(const cs_request *request) {
  celspan_coding coding = {.struct_size = sizeof coding};
  cs_request_read(request, "--depth", &coding.depth);
  cs_spaces_set(request, &coding);
  cs_request_read(request, "--alpha", &coding.alpha);
  if (cs_request_has(request, "--dither"))
    coding.depth = CELSPAN_DEPTH_8_DITHER;
  return coding;
}

celspan_file_desc cs_target_file(const cs_request *request, celspan_coding *coding) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  file.format = cs_request_text(request, "--format");
  *coding = cs_target_coding(request);
  file.coding = coding;
  int32_t strip[2];
  if (cs_request_strip(request, strip))
    /* a strip has at least this many rows; the view gives the exact number */
    file.strip_height = strip[1];
  return file;
}
