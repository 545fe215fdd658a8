/* The interface of the picture module: a table of C functions. There are two of them, one over
 * OpenImageIO (src/kit/plugins/oiio, C++), and one for fewer formats where that is missing
 * (src/kit/plugins/raster).
 *
 *   file --module: read--> coded pixels, upright, in the display window --core: decode--> light
 *   file <--module: write-- coded rows <--core: code-- spans
 *
 * The module knows files; the core knows light: decoding and premultiplying happen in the core.
 *
 * INVARIANT: no exception crosses the interface, no memory changes its owner, and every failure
 * comes with a sentence.
 */
#pragma once

#include "celspan/celspan.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CS_PICTURE_MODULE_VERSION 9u
#define CS_PICTURE_SIDE 1048576
#define CS_PICTURE_CHANNELS 1024
#define CS_PICTURE_SPACE 256   /* bytes of the name of a space in a file */
#define CS_PICTURE_SOFTWARE 64 /* bytes of the name of the program, with its version */
#define CS_PICTURE_OTHER "other"
/* cs_picture_output.format of what modules write with libavif, and of films with libwebp. */
#define CS_PICTURE_AVIF "avif"
#define CS_PICTURE_WEBP "webp film"
/* Before the name of a space in the project of a DPX file, which has no place for it. */
#define CS_PICTURE_PROJECT "celspan:colour "

typedef struct cs_picture_failure {
  celspan_status status;
  char text[768];
} cs_picture_failure;

typedef enum cs_picture_alpha {
  CS_PICTURE_ALPHA_STRAIGHT, /* also for pictures without alpha: 1 inside the data window, else 0 */
  CS_PICTURE_ALPHA_CODED     /* coded colour multiplied by alpha */
} cs_picture_alpha;

typedef struct cs_picture_request {
  const char *file;
  const char *layer; /* NULL, or the name of a subimage or of a group of channels */
  int subimage;
  const char *space; /* NULL, or a colour space of the OpenColorIO configuration */
} cs_picture_request;

typedef struct cs_picture_header {
  celspan_picture_info info;
  cs_picture_alpha alpha;
  int bits;   /* the bits of the coded values when they are integers of at most 16 bits, else 0 */
  double dpi; /* pixels for an inch; 0: the file does not say */
  bool is_linear; /* they were in a space of OpenColorIO, and are linear light, premultiplied */
  /* What the file says: its primaries, if it has some (model/colour/primaries.h), and the name of
   * its space, if celspan does not have that; "": it does not say. info.colour is then
   * CS_PICTURE_OTHER where the codes cannot be read without that space. */
  bool names_colour; /* info.colour is what the file says, not what files of its kind have */
  bool has_primaries;
  float primaries[8];
  char space[CS_PICTURE_SPACE];
  char profile[CS_PICTURE_SPACE]; /* the name of its ICC profile, which is not applied; "": none */
  /* the orientation tag changes the order of rows: it is cheapest to read all at once */
  bool is_turned;
  bool is_whole;      /* the reader decodes everything at once and keeps it */
  bool is_sequential; /* to read a row, all rows above it have to be decoded */
  int64_t file_size;  /* this and the next two fields change when the file changes */
  int64_t file_time;  /* nanoseconds */
  uint64_t file_number;
} cs_picture_header;

/* The contents of a file apart from the picture that is read from it. */
typedef struct cs_picture_part {
  int subimage;          /* -1: a layer, of the first subimage */
  char name[256];        /* the name by which it can be requested as a layer; "": it has none */
  int32_t width, height; /* the width and height of a subimage: as stored, its data window */
  int channels;
  char depth[16]; /* "8", "10", "16", "half", "float", ... */
} cs_picture_part;

typedef struct cs_picture_reader cs_picture_reader;
typedef struct cs_picture_writer cs_picture_writer;

/* What only these two have. Their file may have several pictures: after the last row of one, the
 * first row of the next one follows. */
typedef struct cs_picture_moving {
  /* of AVIF: from 0, which loses nothing of a single picture, to 63; of WebP: from 0 to 100, and
   * above that nothing is lost */
  int32_t quality;
  int32_t plays;               /* how often several pictures are played; 0: for ever */
  int32_t threads;             /* the threads of the encoder; its bytes do not depend on them */
  int32_t is_opaque;           /* alpha is not kept */
  int32_t primaries, transfer; /* numbers of ITU-T H.273; 0: the usual ones of the colour */
} cs_picture_moving;

/* A file to be written. Rows are interleaved channels of `depth` in the machine's byte order. */
typedef struct cs_picture_output {
  /* Receives the bytes of the file, in any order; false: stop, writing has failed. */
  bool (*put)(void *user, uint64_t offset, const void *bytes, size_t size);
  void *user;
  const char *name;   /* for messages and for the format's own header */
  const char *format; /* "openexr", "tiff", ... */
  int32_t width, height;
  int channels;             /* 1 grey, 3, 4 with alpha, or as many as there are names */
  const char *const *names; /* of the channels, the fourth being alpha; NULL: the usual ones */
  celspan_depth depth;      /* never DEFAULT */
  int bits; /* how many bits of each value are used: 10 in a depth of 16 for film; 0: all */
  bool is_straight;
  const char *colour; /* "srgb", "linear", "rec709", "cineon", or another space's name */
  const char *title;  /* NULL: none */
  char software[CS_PICTURE_SOFTWARE];
  bool has_primaries; /* of light in this colour, for formats that say them */
  float primaries[8];
  double frames_second; /* 0: none */
  int32_t frame;
  cs_picture_moving moving;
} cs_picture_output;

typedef struct cs_picture_module {
  uint32_t version;
  /* Errors: INPUT, LIMIT, NO_MEMORY, BAD_ARGUMENT; *out and *header are untouched then. */
  celspan_status (*open)(const cs_picture_request *request, cs_picture_reader **out,
                         cs_picture_header *header, cs_picture_failure *failure);
  /* RGBA floats of a rectangle inside the display window, row-major. One thread at a time. */
  celspan_status (*read)(cs_picture_reader *reader, int32_t x, int32_t y, int32_t width,
                         int32_t height, float *rgba, cs_picture_failure *failure);
  void (*close)(cs_picture_reader *reader);
  /* Calls `put` for every subimage, and after each subimage for its layers, until `put` returns
   * false. */
  celspan_status (*list)(cs_picture_reader *reader,
                         bool (*put)(void *user, const cs_picture_part *part), void *user,
                         cs_picture_failure *failure);
  celspan_status (*write_open)(const cs_picture_output *output, cs_picture_writer **out,
                               cs_picture_failure *failure);
  celspan_status (*write_rows)(cs_picture_writer *writer, int32_t y, int32_t count,
                               const void *rows, cs_picture_failure *failure);
  /* Completes the file and frees the writer, whatever happens. */
  celspan_status (*write_close)(cs_picture_writer *writer, cs_picture_failure *failure);
  void (*write_abandon)(cs_picture_writer *writer);
  /* For a process that does nothing but this, with errno at 0 before each call: from now on a call
   * fails with NO_MEMORY when memory ran out in it, even if the library continued and lost data,
   * such as a part of the header or the last rows. */
  void (*watch_memory)(void);
} cs_picture_module;

/* The module's one symbol. */
CELSPAN_API const void *celspan_picture_module(void);

#ifdef __cplusplus
}
#endif
