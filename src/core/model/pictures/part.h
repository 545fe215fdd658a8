/* Texels of one picture copied from the blocks of another: a part of it, or its smooth form.
 *
 *      +-------+-------+
 *      |    ...|...    |      the dotted rectangle of a level, from the blocks that it touches;
 *      +----:--+--:----+      they are light already
 *      |    ...|...    |
 *      +-------+-------+
 */
#pragma once

#include "model/pictures/store.h"

/* What gives a block: cs_load_block, which itself needs what is here. */
typedef struct cs_part_reader {
  celspan_context *context;
  celspan_status (*load)(celspan_context *context, const cs_picture *picture, int level,
                         int32_t column, int32_t row, cs_picture_block **out);
} cs_part_reader;

/* A rectangle inside a level of the picture: premultiplied linear RGBA, in rows that begin `stride`
 * texels apart. Errors: as cs_load_block. */
CELSPAN_CHECKED celspan_status cs_part_copy(const cs_part_reader *reader, const cs_picture *picture,
                                            int level, const celspan_rectangle *area, float *rgba,
                                            size_t stride);
/* Of a part, in its own pixels, without gaps. info: of the part. Errors: as cs_load_block. */
CELSPAN_CHECKED celspan_status cs_part_read(const cs_part_reader *reader, const cs_picture *part,
                                            const celspan_picture_info *info,
                                            const celspan_rectangle *rectangle, float *rgba);
