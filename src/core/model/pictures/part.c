#include "model/pictures/part.h"

#include <string.h>

#include "model/pictures/smooth.h"

/* Where the texels of a rectangle are copied to: to pixels, or only their alphas to the alphas. */
typedef struct copying {
  celspan_rectangle area;
  size_t stride; /* texels from one row of the pixels to the next */
  float *rgba;   /* NULL: the copy goes to the alphas */
  const cs_smooth_alphas *alphas;
} copying;

static int32_t least(int64_t a, int64_t b) { return (int32_t)(a < b ? a : b); }

/* Copies the part of the rectangle that lies in a block. */
static void copy_from_block(const copying *to, const cs_picture_block *block) {
  int32_t x0 = to->area.x, y0 = to->area.y;
  int32_t left = block->column * CS_PICTURE_BLOCK, top = block->row * CS_PICTURE_BLOCK;
  int32_t from = left > x0 ? left : x0, first = top > y0 ? top : y0;
  int32_t end = least(left + CS_PICTURE_BLOCK, (int64_t)x0 + to->area.width);
  int32_t last = least(top + CS_PICTURE_BLOCK, (int64_t)y0 + to->area.height);
  for (int32_t row = first; row < last; row++) {
    const float *texels =
        block->texels + 4 * ((size_t)(row - top) * CS_PICTURE_BLOCK + (size_t)(from - left));
    if (to->rgba)
      memcpy(to->rgba + 4 * ((size_t)(row - y0) * to->stride + (size_t)(from - x0)), texels,
             4 * sizeof(float) * (size_t)(end - from));
    else
      cs_smooth_set(to->alphas, from, row, texels, end - from);
  }
}

static celspan_status copy(const cs_part_reader *reader, const cs_picture *picture, int level,
                           const copying *to) {
  const celspan_rectangle *area = &to->area;
  int32_t right = area->x + area->width, bottom = area->y + area->height;
  for (int32_t row = area->y / CS_PICTURE_BLOCK; row * CS_PICTURE_BLOCK < bottom; row++)
    for (int32_t column = area->x / CS_PICTURE_BLOCK; column * CS_PICTURE_BLOCK < right; column++) {
      cs_picture_block *block;
      CS_TRY(reader->load(reader->context, picture, level, column, row, &block));
      copy_from_block(to, block);
      cs_store_release(block);
    }
  return CELSPAN_OK;
}

celspan_status cs_part_copy(const cs_part_reader *reader, const cs_picture *picture, int level,
                            const celspan_rectangle *area, float *rgba, size_t stride) {
  return copy(reader, picture, level, &(copying){.area = *area, .rgba = rgba, .stride = stride});
}

static celspan_status make_smooth(const cs_part_reader *reader, const cs_picture *part,
                                  const celspan_picture_info *info,
                                  const celspan_rectangle *rectangle, float *rgba) {
  cs_memory *memory = reader->context->memory;
  cs_smooth_alphas alphas = cs_smooth_around(rectangle, info->width, info->height);
  size_t rows = (size_t)alphas.area.height + 1, row = (size_t)alphas.area.width * sizeof(uint32_t);
  alphas.sums = cs_mem_array(memory, rows, row);
  if (!alphas.sums)
    return cs_fail_memory(reader->context);
  alphas.steps = alphas.sums + alphas.area.width;
  celspan_status status =
      copy(reader, part->whole, 0, &(copying){.area = alphas.area, .alphas = &alphas});
  if (status == CELSPAN_OK)
    cs_smooth_rectangle(&alphas, rectangle, rgba);
  cs_mem_free(memory, alphas.sums, rows * row);
  return status;
}

celspan_status cs_part_read(const cs_part_reader *reader, const cs_picture *part,
                            const celspan_picture_info *info, const celspan_rectangle *rectangle,
                            float *rgba) {
  celspan_rectangle area = *rectangle;
  area.x += part->x;
  area.y += part->y;
  CS_TRY(cs_part_copy(reader, part->whole, 0, &area, rgba, (size_t)area.width));
  return part->is_smooth ? make_smooth(reader, part, info, &area, rgba) : CELSPAN_OK;
}
