/* Writing AVIF: a picture, or the pictures of a film one after another.
 *
 *   rows of RGBA --a whole picture--> Y'CbCr 4:4:4 --libavif--> kept --close--> put
 *                  waits until it is known whether another one follows
 *
 * INVARIANT: bytes are put when the file is closed, after libavif has read its head back: nothing
 * is put of a file that failed. A file is ended once, by close or by abandon.
 */
#pragma once

#include "model/pictures/module.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cs_avif cs_avif;

/* The output is copied, without its names and its title. Errors: BAD_ARGUMENT, OUTPUT, NO_MEMORY;
 * each sentence begins with the file's name. */
celspan_status cs_avif_open(const cs_picture_output *output, cs_avif **out,
                            cs_picture_failure *failure);
/* Rows from the top; the row after the last one begins the next picture. Errors: as above. */
celspan_status cs_avif_rows(cs_avif *avif, int32_t count, const void *rows,
                            cs_picture_failure *failure);
/* Ends the file, whatever it returns. Errors: as above. */
celspan_status cs_avif_close(cs_avif *avif, cs_picture_failure *failure);
void cs_avif_abandon(cs_avif *avif);

#ifdef __cplusplus
}
#endif
