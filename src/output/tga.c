#include "output/tga.h"

#include <string.h>

celspan_status cs_tga_put_end(cs_file *file, celspan_context *context,
                              const unsigned char extension[CS_TGA_EXTENSION]) {
  uint64_t offset = cs_file_size(file);
  bool is_near = offset <= UINT32_MAX; /* else nothing can point to the extension */
  unsigned char footer[CS_TGA_FOOTER] = {0};
  cs_tga_store_32(footer, is_near ? (uint32_t)offset : 0);
  memcpy(footer + 8, CS_TGA_SIGNATURE, sizeof CS_TGA_SIGNATURE);
  if (is_near)
    CS_TRY(cs_file_write(file, context, extension, CS_TGA_EXTENSION));
  return cs_file_write(file, context, footer, sizeof footer);
}
