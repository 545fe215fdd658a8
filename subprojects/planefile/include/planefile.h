/* planefile - pictures without a resolution, in a file.
 *
 * A plane file holds what can be seen of a drawing: the visible pieces of its boundaries, kept as
 * curves, each with a colour or gradients on its left and on its right. It is drawn at any size,
 * whole or any crop of it, without being composed again. docs/planefile.md specifies it byte by
 * byte.
 *
 * A plane file is cut into bands: heights one above the other, each with all that is in it. So any
 * part of a large plane is found by its heights, and bands are read one at a time. A file may hold
 * the frames of a film, each of which is a plane; what several of them have is in it once.
 *
 * A nest is a plane with windows that show other planes: what reads a file takes its outer one.
 *
 * Depends on the C library alone. No globals, no printing; every failure is a status. A plane does
 * not change once it is read, and threads share it; a drawer belongs to one thread.
 *
 * Ownership: borrowed - used during the call and forgotten; new - the caller destroys it.
 */
#ifndef PLANEFILE_H
#define PLANEFILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum planefile_status {
  PLANEFILE_OK = 0,
  PLANEFILE_NO_MEMORY,
  PLANEFILE_BAD_ARGUMENT, /* the caller's mistake */
  PLANEFILE_BAD_FILE,     /* truncated, altered, or not a plane file */
  PLANEFILE_READ_FAILED,  /* a function that reads failed */
  PLANEFILE_WRITE_FAILED  /* the write function returned false */
} planefile_status;

/* One hook for all memory: block NULL allocates, new_size 0 frees and returns NULL, else resizes.
 */
typedef void *(*planefile_resize)(void *user, void *block, size_t old_size, size_t new_size);

/* ---------------------------------------------------------------- planes */

#define PLANEFILE_SIDE (1 << 26)   /* of the frame, in units, across and down */
#define PLANEFILE_FAR (1 << 28)    /* no coordinate is larger, in either direction */
#define PLANEFILE_STEPS 100        /* of a grid, in a column or a row of it */
#define PLANEFILE_WEIGHT (1 << 28) /* of a point of a plain piece */
#define PLANEFILE_WHITE 65535      /* of a colour, and what is opaque */
#define PLANEFILE_SHADE 17         /* colours of programs, beside cells that are codes */
#define PLANEFILE_BRIGHT (1 << 24) /* no channel is larger, in either direction */

/* From the upper left corner of the frame, downwards. */
typedef struct planefile_point {
  int32_t x, y;
  uint32_t w; /* at least PLANEFILE_WEIGHT / 16 */
} planefile_point;

/* A Bezier curve over degree + 1 points of its own. It ends no higher than it begins, and comes to
 * each height between them once. */
typedef struct planefile_piece {
  uint32_t point; /* its first one */
  uint8_t degree; /* 1 to 3; of a rational piece 2 or 3 */
  bool is_rational;
} planefile_piece;

/* Pieces that follow each other downwards, each beginning with the last point of the one before. */
typedef struct planefile_chain {
  uint32_t piece, piece_count;
} planefile_chain;

/* A visible part of a chain: the heights [top, foot) of it. Those of one chain do not overlap. */
typedef struct planefile_border {
  uint32_t chain;
  int32_t top, foot;
  uint32_t left, right; /* cells, which differ */
} planefile_border;

/* All coordinates lie on a grid that divides the frame into columns and rows, and each of these
 * into STEPS. 0: every unit is a step. */
typedef struct planefile_grid {
  uint16_t columns, rows;
} planefile_grid;

/* The steps across a frame of some columns, or down one of some rows. */
static inline int64_t planefile_steps(uint16_t count) {
  return count > 0 ? (int64_t)PLANEFILE_STEPS * count : PLANEFILE_SIDE;
}
/* The step that is next to a coordinate, and the coordinate of a step, which is below 2^34 in size:
 * each is the other's inverse. */
static inline int64_t planefile_step_at(int32_t coordinate, uint16_t count) {
  int64_t at = coordinate * planefile_steps(count) + PLANEFILE_SIDE / 2;
  return at >= 0 ? at / PLANEFILE_SIDE : -((PLANEFILE_SIDE - 1 - at) / PLANEFILE_SIDE);
}
static inline int64_t planefile_place_of(int64_t step, uint16_t count) {
  int64_t steps = planefile_steps(count), at = step * PLANEFILE_SIDE + steps / 2;
  return at >= 0 ? at / steps : -((steps - 1 - at) / steps);
}

/* Linear light, premultiplied; the last channel is alpha. */
typedef struct planefile_cell {
  int32_t colour[4];
} planefile_cell;

/* ---- cells that vary
 *
 * Such a cell has a program: layers from the front to the rear, some of them in groups, which are
 * composed for each pixel. A ramp is a layer whose colour depends on where the pixel lies along an
 * axis, or on a picture. */

#define PLANEFILE_DEPTH 16 /* of groups in each other, at most */

typedef enum planefile_axis_kind {
  PLANEFILE_LINEAR,   /* p */
  PLANEFILE_RADIAL,   /* sqrt(p p + q q) - focus p */
  PLANEFILE_TRIANGLE, /* the shares p and q of two corners of three */
  PLANEFILE_PICTURE   /* the place p, q on a picture, in its pixels */
} planefile_axis_kind;

/* What lies beyond a picture's edges. */
typedef enum planefile_wrap {
  PLANEFILE_WRAP_CLEAR, /* nothing */
  PLANEFILE_WRAP_CLAMP, /* the pixel of the edge */
  PLANEFILE_WRAP_REPEAT /* the picture again */
} planefile_wrap;

/* How a picture is read at a place: docs/planefile.md. */
typedef enum planefile_filter {
  PLANEFILE_FILTER_AUTO, /* linear where it is enlarged, and the mean of a pixel's area elsewhere */
  PLANEFILE_FILTER_NEAREST,
  PLANEFILE_FILTER_LINEAR,
  PLANEFILE_FILTER_CUBIC /* cubic where it is enlarged, and the mean elsewhere */
} planefile_filter;

typedef enum planefile_picture_kind {
  PLANEFILE_CODES, /* 4 bytes a pixel: sRGB codes, and alpha, by which they are not multiplied */
  PLANEFILE_LIGHT, /* a planefile_cell a pixel */
  PLANEFILE_NAMED  /* codes that are not in the file: who reads it is asked for them by name */
} planefile_picture_kind;

#define PLANEFILE_PICTURE_SIDE (1 << 20) /* pixels, at most */
#define PLANEFILE_NAME 255               /* bytes of a name, at most */

typedef struct planefile_picture {
  uint32_t width, height;
  uint8_t kind;    /* a planefile_picture_kind */
  uint64_t key[2]; /* of its pixels; those of one key are in a file once. NAMED: the first one is
                      in the file */
  /* To write: row y, asked for once, from the top; false: failed. */
  bool (*row)(void *user, uint32_t y, void *out);
  void *user;
  const char *name; /* NAMED: 1 to NAME bytes, and a zero */
} planefile_picture;

/* p, q and w at (x, y), which are 0 to 1 in the frame, are a x + b y + c; p and q are divided by w.
 * Where w is not above 0, there is nothing. */
typedef struct planefile_axis {
  double p[3], q[3], w[3], focus; /* finite */
  uint8_t kind;                   /* a planefile_axis_kind */
  uint8_t wrap, filter;           /* PICTURE: a planefile_wrap, a planefile_filter */
  uint32_t picture;               /* PICTURE: of the plane's */
} planefile_axis;

/* Before the first stop and after the last one there are their colours. Those of a triangle are its
 * three corners, wherever they are; between 0 and alpha, and alpha between 0 and 1. A picture has
 * one stop: the factors of its channels, none below 0. */
typedef struct planefile_stop {
  double at; /* finite; not before the stop before it */
  planefile_cell colour;
} planefile_stop;

typedef enum planefile_step_kind {
  PLANEFILE_FLAT,  /* a layer of one colour */
  PLANEFILE_RAMP,  /* a layer of some stops along an axis */
  PLANEFILE_ENTER, /* a group begins */
  PLANEFILE_LEAVE  /* it ends; its channels are multiplied, and it is what `how` says */
} planefile_step_kind;

/* What a group becomes: a layer of the group around it, or a veil, by which all layers behind it in
 * that group are multiplied. */
typedef enum planefile_how {
  PLANEFILE_LAYER,
  PLANEFILE_DECODED,        /* a layer; its numbers are sRGB codes, which become light first */
  PLANEFILE_GLASS,          /* each colour by 1 - alpha + its channel; alpha as by their mean */
  PLANEFILE_LIT,            /* each colour by its channel */
  PLANEFILE_SCREEN,         /* each colour by 1 - its channel */
  PLANEFILE_MATTE,          /* all channels by alpha, 0 to 1 */
  PLANEFILE_INVERTED_MATTE, /* by 1 - that */
  PLANEFILE_LUMA_MATTE,     /* by 0.2126 red + 0.7152 green + 0.0722 blue, 0 to 1 */
  PLANEFILE_INVERTED_LUMA   /* by 1 - that */
} planefile_how;

typedef struct planefile_step {
  uint8_t kind;                    /* a planefile_step_kind */
  uint8_t how;                     /* LEAVE: a planefile_how */
  planefile_cell colour;           /* FLAT; LEAVE: the factors; PLANEFILE_WHITE is 1 */
  uint32_t axis, stop, stop_count; /* RAMP: at least one stop; a triangle's has three, a picture's
                                      one */
} planefile_step;

typedef struct planefile_program {
  uint32_t step, step_count; /* 0: the cell is flat */
} planefile_program;

/* At every height the borders lead from cell 0 to cell 0, which lies around the whole frame and is
 * flat. The colour of a cell that varies is 0. Borders do not change a channel by 2^36 or more, all
 * together: a million of them may, each by 1. */
typedef struct planefile_band {
  int32_t top, foot; /* 0 and PLANEFILE_SIDE of a whole plane */
  const planefile_point *points;
  const planefile_piece *pieces;
  const planefile_chain *chains;
  const planefile_border *borders; /* of one that was read: by their chains, and by their tops */
  const planefile_cell *cells;
  const planefile_program *programs; /* the programs of the cells; NULL: all are flat */
  const planefile_step *steps;
  const planefile_axis *axes;
  const planefile_stop *stops;
  const planefile_picture *pictures; /* NULL of one that was read */
  uint32_t point_count, piece_count, chain_count, border_count, cell_count;
  uint32_t step_count, axis_count, stop_count, picture_count;
} planefile_band;

/* ---------------------------------------------------------------- writing */

typedef struct planefile_writer_desc {
  double width, height; /* the width and height of the frame, finite, above 0 */
  bool (*write)(void *user, const void *bytes, size_t size); /* the next bytes; false: failed */
  void *user;
  planefile_resize resize; /* NULL: the C library's */
  void *resize_user;
  double frames_second; /* of a film; 0: a single plane */
  bool is_coded;        /* flat cells are rounded to 8-bit codes (planefile_round), and
                           the colours of programs to multiples of SHADE */
  planefile_grid grid;  /* the grid of all coordinates */
} planefile_writer_desc;

/* Writes a plane; desc and plane: borrowed. The bytes are a function of the plane alone. Curves of
 * which nothing can be seen are left out. BAD_ARGUMENT: the plane is not as described above; that
 * borders lead from cell 0 to cell 0 is not examined. */
planefile_status planefile_write(const planefile_writer_desc *desc, const planefile_band *plane);

/* ---- 8-bit colours */

/* Rounds colours to 8-bit sRGB codes with straight alpha, between 0 and 1. Borders between cells
 * that have become equal can be left out before a plane is written. */
typedef struct planefile_rounding planefile_rounding;
/* resize: NULL: the C library's. Returns a new one, or NULL: no memory. */
planefile_rounding *planefile_rounding_create(planefile_resize resize, void *user);
void planefile_rounding_destroy(planefile_rounding *rounding); /* NULL is ignored */
planefile_cell planefile_round(const planefile_rounding *rounding, planefile_cell cell);

/* ---- films */

typedef struct planefile_writer planefile_writer;

/* desc: borrowed until the end. out: new. BAD_ARGUMENT: a size or a rate is not allowed. */
planefile_status planefile_writer_create(const planefile_writer_desc *desc, planefile_writer **out);
/* The next frame, from 0; plane: borrowed, as of planefile_write. BAD_ARGUMENT also for a second
 * frame of a single plane. After a failure the writer can only be destroyed. */
planefile_status planefile_writer_frame(planefile_writer *writer, const planefile_band *plane);
/* The next frame is the latest one again. BAD_ARGUMENT: there is none, or it is a single plane. */
planefile_status planefile_writer_repeat(planefile_writer *writer);
/* The end of the file. BAD_ARGUMENT: it has no frame. */
planefile_status planefile_writer_end(planefile_writer *writer);
/* NULL is ignored. */
void planefile_writer_destroy(planefile_writer *writer);

/* ---------------------------------------------------------------- reading */

typedef struct planefile_plane planefile_plane;

/* Where and why a file is refused. */
typedef struct planefile_fault {
  uint64_t offset;  /* the offset of the record of the file where it was found */
  char reason[120]; /* "band 7: the checksum is wrong" */
} planefile_fault;

typedef struct planefile_source {
  /* All bytes of [offset, offset + size), which lies within the file; false: failed. */
  bool (*read)(void *user, uint64_t offset, void *bytes, size_t size);
  void *user;
  uint64_t size;           /* the size of the file */
  planefile_resize resize; /* NULL: the C library's */
  void *resize_user;
  /* The codes of a picture of a name, a size and a first key, all rows, which are copied; NULL:
   * there is no such picture. The function may be NULL. */
  const unsigned char *(*picture)(void *user, const planefile_picture *wanted);
} planefile_source;

typedef struct planefile_info {
  double width, height;
  double frames_second; /* 0: a single plane */
  uint32_t frame_count; /* the frame count of the file */
  uint32_t band_count;
  uint32_t picture_count; /* of the file up to this frame */
  bool is_opaque;         /* alpha is PLANEFILE_WHITE everywhere */
  bool varies;            /* there may be cells with programs */
  bool is_coded;          /* flat cells are 8-bit codes */
  planefile_grid grid;
  uint32_t inner_count;  /* the planes that are in the same file, to be shown in this one */
  uint32_t window_count; /* the places in this one where they are shown */
} planefile_info;

/* The bytes from the start that planefile_is needs. */
enum { PLANEFILE_MAGIC_BYTES = 8 };
/* Whether a file that begins with these bytes claims to be a plane file. */
bool planefile_is(const void *bytes, size_t size);

/* Of frame 0: reads header and index, and the bands that have a part of the heights [top, foot), in
 * units: 0 and PLANEFILE_SIDE for all. Every byte that is read is verified. source: borrowed. out:
 * new. fault: set when the status is not OK; may be NULL. Time is linear in the bytes that are
 * read; memory is less than 600 times as much, and less than 128 KiB more. */
planefile_status planefile_read(const planefile_source *source, int32_t top, int32_t foot,
                                planefile_plane **out, planefile_fault *fault);
/* Reads one frame of a film. The first frame is 0, and a single plane has only this one.
 * BAD_ARGUMENT: the file has fewer frames. The list of frames is also read, 8 bytes for each. */
planefile_status planefile_read_frame(const planefile_source *source, uint32_t frame, int32_t top,
                                      int32_t foot, planefile_plane **out, planefile_fault *fault);
/* Reads one frame, all heights, after another one of the same source, which this replaces: what
 * both are made from is decoded once, and is kept for the next frame; all else of the frame before
 * is freed first. *plane: NULL at first; NULL again, if the status is not OK. */
planefile_status planefile_read_next(const planefile_source *source, uint32_t frame,
                                     planefile_plane **plane, planefile_fault *fault);
/* NULL is ignored. */
void planefile_plane_destroy(planefile_plane *plane);
planefile_info planefile_plane_info(const planefile_plane *plane);
/* The bytes of an inner plane, from 0, of the file: they are a plane file, and not examined yet. */
void planefile_plane_inner(const planefile_plane *plane, uint32_t index, uint64_t *offset,
                           uint64_t *size);
/* A band, from the top; where it has not been read it has heights and nothing else. */
const planefile_band *planefile_plane_band(const planefile_plane *plane, uint32_t index);

/* Whether all of a border is in front of the eye of the gradients of a cell beside it: w > 0. */
bool planefile_faces(const planefile_band *band, const planefile_border *border, uint32_t cell);
/* Whether it is certain that nothing shines through a cell that varies. is_faced: all of its
 * borders face its gradients, and so does what lies between them. */
bool planefile_hides(const planefile_band *band, uint32_t cell, bool is_faced);

/* ---- gradients
 *
 * A cell whose program has ramps along one axis alone is a gradient, whatever else is in it. */

/* That axis, linear or radial; NULL: the cell is flat, or varies in another way. */
const planefile_axis *planefile_only_axis(const planefile_band *band, uint32_t cell);
/* The colours of such a cell of the plane at places of the axis: in the middles of `count` equal
 * parts of from..to. False: no memory. */
bool planefile_along(const planefile_plane *plane, const planefile_band *band, uint32_t cell,
                     double from, double to, uint32_t count, planefile_cell *out);

/* ---------------------------------------------------------------- drawing */

#define PLANEFILE_PIXELS_MOST 2147483647 /* of a view's side */

typedef enum planefile_sampling {
  PLANEFILE_AREA, /* a pixel is the mean of its area */
  PLANEFILE_NONE  /* a pixel is the colour at its centre */
} planefile_sampling;

/* The frame, of width x height pixels, and the crop of it that is drawn. */
typedef struct planefile_view {
  uint32_t width, height; /* at least 1 */
  uint32_t x, y, columns, rows;
  planefile_sampling sampling;
} planefile_view;

/* Neighbouring pixels of one colour, from the end of the span before. */
typedef struct planefile_span {
  uint32_t end; /* a column of the crop */
  planefile_cell colour;
} planefile_span;

typedef struct planefile_drawer planefile_drawer;

/* plane: borrowed until the end; it must have been read at the heights of the crop. The pixels of a
 * crop are those of the whole, to the bit. out: new. Memory: about 1 MiB, or 96 bytes for each
 * column of a row, at most 512 bytes for each chain of the plane, and 12 for each of its cells. */
planefile_status planefile_drawer_create(const planefile_plane *plane, const planefile_view *view,
                                         planefile_drawer **out);
/* NULL is ignored. */
void planefile_drawer_destroy(planefile_drawer *drawer);
/* The next row, from the top of the crop; valid until the next call. BAD_ARGUMENT: there is none.
 * After a failure the drawer can only be destroyed. */
planefile_status planefile_drawer_row(planefile_drawer *drawer, const planefile_span **spans,
                                      size_t *count);

/* A colour as 8-bit sRGB codes with straight alpha, and spans as such pixels, 4 bytes each. */
void planefile_srgb8(const planefile_plane *plane, planefile_cell colour, unsigned char out[4]);
void planefile_span_pixels(const planefile_plane *plane, const planefile_span *spans, size_t count,
                           unsigned char *out);

#ifdef __cplusplus
}
#endif
#endif
