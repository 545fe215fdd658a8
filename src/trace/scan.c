#include "trace/scan.h"

#include <string.h>

#include "pictures/load.h"

static size_t bytes_of(const cs_scan *scan) {
  return (size_t)scan->width * (size_t)scan->height * 4;
}

/* One row of a block: its codes where they are exact, else its texels coded. */
static void copy_row(const cs_picture_block *block, int32_t row, int32_t count, cs_srgb8 code,
                     unsigned char *out) {
  if (block->is_coded && block->codes)
    memcpy(out, block->codes[row], (size_t)count * 4);
  else
    code(block->texels + 4 * (size_t)row * CS_PICTURE_BLOCK, (size_t)count, out);
}

static celspan_status read_block(celspan_context *context, const cs_picture *picture, cs_scan *scan,
                                 int32_t x, int32_t y) {
  int32_t columns = scan->width - x < CS_PICTURE_BLOCK ? scan->width - x : CS_PICTURE_BLOCK;
  int32_t rows = scan->height - y < CS_PICTURE_BLOCK ? scan->height - y : CS_PICTURE_BLOCK;
  cs_srgb8 code = cs_srgb8_choose(cs_isa_best());
  cs_picture_block *block;
  CS_TRY(cs_load_block(context, picture, 0, x / CS_PICTURE_BLOCK, y / CS_PICTURE_BLOCK, &block));
  for (int32_t row = 0; row < rows; row++)
    copy_row(block, row, columns, code,
             scan->codes + 4 * ((size_t)(y + row) * (size_t)scan->width + (size_t)x));
  scan->has_clear = scan->has_clear || block->opacity != CS_PICTURE_OPAQUE;
  cs_store_release(block);
  return CELSPAN_OK;
}

static celspan_status read_blocks(celspan_context *context, const cs_picture *picture,
                                  cs_scan *scan) {
  for (int32_t y = 0; y < scan->height; y += CS_PICTURE_BLOCK)
    for (int32_t x = 0; x < scan->width; x += CS_PICTURE_BLOCK)
      CS_TRY(read_block(context, picture, scan, x, y));
  return CELSPAN_OK;
}

celspan_status cs_scan_read(celspan_context *context, const cs_picture *picture, cs_scan *out) {
  celspan_picture_info info;
  CS_TRY(cs_store_info(context, picture, &info));
  if ((int64_t)info.width * info.height > CS_SCAN_MOST)
    return cs_fail(context, CELSPAN_LIMIT,
                   "%s: %d x %d pixels are more than can be traced, %d in all; shrink the picture "
                   "or trace parts of it",
                   cs_picture_name(picture), info.width, info.height, CS_SCAN_MOST);
  *out = (cs_scan){.width = info.width, .height = info.height};
  cs_srgb8_make_curve(&out->curve);
  out->codes = cs_mem_resize(context->memory, NULL, 0, bytes_of(out));
  if (!out->codes)
    return cs_fail_memory(context);
  celspan_status status = read_blocks(context, picture, out);
  if (status != CELSPAN_OK)
    cs_scan_finish(out, context);
  return status;
}

void cs_scan_finish(cs_scan *scan, celspan_context *context) {
  cs_mem_free(context->memory, scan->codes, bytes_of(scan));
  scan->codes = NULL;
}
