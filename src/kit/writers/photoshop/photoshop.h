/* Photoshop documents (PSD), in RGB with 8 or 16 bits a channel.
 * Source: Adobe Photoshop File Formats Specification, 2019.
 *
 *   header | resources | records of the layers, rearmost first | their channels | merged picture
 *
 * A row has all channels, and the file has one channel after the other. So the packed rows of a
 * picture wait in a temporary file beside the document:
 *
 *   row: R G B A ... --PackBits--> A R G B | A R G B | ... --channel by channel--> document
 *
 * The colours of a merged picture that is not opaque lie over white, as readers expect.
 *
 * MEMORY: two rows of pixels, sixteen bytes for each row, and at most 1,200 bytes for each layer.
 * On the disk, what the merged picture and the largest layer take once more.
 *
 * INVARIANT: the merged picture is put first, so that a picture that cannot be read is reported
 * with its place in the frame; then all layers, from the rearmost one. Documents have less than
 * 2 GiB, which is the limit of the format.
 */
#pragma once

#include "celspan/celspan.h"
#include "inside/sinks.h"

/* The most pixels a side, the most layers, the channels of one, and the steps of opacities. */
enum {
  CS_PHOTOSHOP_SIDE = 30000,
  CS_PHOTOSHOP_LAYERS = INT16_MAX,
  CS_PHOTOSHOP_CHANNELS = 4,
  CS_PHOTOSHOP_OPACITY = 255
};

typedef struct cs_photoshop_layer {
  const char *name; /* UTF-8 of at most 255 bytes; borrowed */
  celspan_blend blend;
  double opacity;                        /* rounded to steps of 1 / CS_PHOTOSHOP_OPACITY */
  uint32_t sizes[CS_PHOTOSHOP_CHANNELS]; /* the sizes of its packed channels */
} cs_photoshop_layer;

/* The packed rows of a picture, which wait. */
typedef struct cs_photoshop_rows {
  int channels;
  uint16_t *sizes; /* the sizes of the rows, channel after channel */
  size_t size_count;
  cs_file *waiting; /* of each row all channels */
} cs_photoshop_rows;

typedef struct cs_photoshop {
  celspan_context *context;
  const char *path;           /* borrowed */
  celspan_coding coding;      /* resolved: 8 or 16 bits, straight */
  int32_t width, height;      /* the width and height of all pictures; at most CS_PHOTOSHOP_SIDE */
  bool is_opaque;             /* the merged picture */
  cs_photoshop_layer *layers; /* borrowed; their sizes are filled in */
  size_t count;
  cs_file *file;
  cs_photoshop_rows merged;
  uint64_t start, end; /* the start and end of the list of layers, from their number on */
} cs_photoshop;

/* Creates the file. All fields down to `count` are set, the others are 0. The file must be ended,
 * also after an error. Errors: OUTPUT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_photoshop_begin(cs_photoshop *document);
/* Takes the rows of a layer, or with NULL of the merged picture. document: borrowed until the sink
 * ends. Errors of the sink: OUTPUT, NO_MEMORY; LIMIT for a document that is too large. */
CELSPAN_CHECKED celspan_status cs_photoshop_sink(cs_photoshop *document, cs_photoshop_layer *layer,
                                                 celspan_sink *out);
/* Completes the file where `outcome` is OK, and removes it otherwise; as cs_file_end. */
CELSPAN_CHECKED celspan_status cs_photoshop_end(cs_photoshop *document, celspan_status outcome);
/* For cs_photoshop_end: the merged picture's rows behind the layers, and in any case their end. */
CELSPAN_CHECKED celspan_status cs_photoshop_end_merged(cs_photoshop *document,
                                                       celspan_status outcome);
