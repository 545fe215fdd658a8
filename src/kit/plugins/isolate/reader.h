/* Reading through workers: the reading functions of cs_picture_module.
 *
 *   open    file --descriptor--> worker --header--> checked
 *   read    rectangle --> worker --pixels in shared memory--> copied
 *
 * INVARIANT: a failure of a worker is reported as a failure of the picture. A picture that ended
 * its worker is refused from then on; the other pictures of that worker are opened again when they
 * are read next.
 */
#pragma once

#include "inside/pictures.h"

celspan_status cs_reader_open(const cs_picture_request *request, cs_picture_reader **out,
                              cs_picture_header *header, cs_picture_failure *failure);
celspan_status cs_reader_read(cs_picture_reader *reader, int32_t x, int32_t y, int32_t width,
                              int32_t height, float *rgba, cs_picture_failure *failure);
celspan_status cs_reader_list(cs_picture_reader *reader,
                              bool (*put)(void *user, const cs_picture_part *part), void *user,
                              cs_picture_failure *failure);
void cs_reader_close(cs_picture_reader *reader);
