/* Photoshop documents (PSD), in RGB with 8 or 16 bits a channel.
 * Source: Adobe Photoshop File Formats Specification, 2019.
 *
 *   header | resources | records of the layers, rearmost first | their channels | merged picture
 *
 * A row has all channels, and the file has one channel after the other. So the packed rows of a
 * picture wait in temporary files beside the document, one for each channel:
 *
 *   row: R G B A ... --PackBits--> A | R | G | B  --channel by channel--> document
 *
 * The colours of a merged picture that is not opaque lie over white, as readers expect.
 *
 * MEMORY: two rows of pixels, sixteen bytes for each row, and at most 1,200 bytes for each layer.
 * On the disk, what the merged picture and the largest layer take once more.
 *
 * INVARIANT: documents have less than 2 GiB, which is the limit of the format.
 */
#pragma once

#include "inside/sinks.h"
#include "writers/apart/apart.h"

enum { CS_PHOTOSHOP_CHANNELS = 4 }; /* channels of a layer */

/* The packed rows of a picture, which wait. */
typedef struct cs_photoshop_rows {
  int channels;
  unsigned char *table; /* the sizes of the rows, channel after channel, as in the document */
  size_t table_size;
  cs_file *waiting[CS_PHOTOSHOP_CHANNELS];
} cs_photoshop_rows;

typedef struct cs_photoshop {
  cs_apart_writing base;
  bool is_opaque;                           /* the merged picture is */
  uint32_t (*sizes)[CS_PHOTOSHOP_CHANNELS]; /* the sizes of the packed channels of each layer */
  cs_file *file;
  cs_photoshop_rows merged;
  uint64_t start, end; /* the start and end of the list of layers, from their number on */
} cs_photoshop;

/* Takes the rows of a layer, or at index 0 of the merged picture. document: borrowed until the sink
 * ends. Errors of the sink: OUTPUT, NO_MEMORY; LIMIT for a document that is too large. */
CELSPAN_CHECKED celspan_status cs_photoshop_sink(cs_photoshop *document, size_t index,
                                                 celspan_sink *out);
/* The merged picture's rows behind the layers, where `outcome` is OK, and in any case their end. */
CELSPAN_CHECKED celspan_status cs_photoshop_end_merged(cs_photoshop *document,
                                                       celspan_status outcome);

/* ---- srgb_profile.c */

/* A colour profile of sRGB, for files that say by one what their codes mean.
 * Source: ICC.1:2010 (profile version 4.3); IEC 61966-2-1. */
enum { CS_SRGB_PROFILE = 496 }; /* bytes */

void cs_srgb_profile(unsigned char out[CS_SRGB_PROFILE]);
