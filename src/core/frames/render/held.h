/* Held bands: rows of a frame that are the same as in a frame made before are not made again.
 *
 *   row 16 k      +----------------+   a band: whole rows, of which the first is a multiple of 16
 *   ...           |   o   |\  |    |   its key: a hash of all that can decide its pixels, which is
 *   row 16 k + 15 +----------------+   the frame, and each cel that reaches the band
 *
 * A band whose key was met in an earlier frame is copied when it is made, and the copy is kept in a
 * cache of the context; a later band of that key is given out from there. So a film in which
 * everything moves copies nothing: of a key that was met, eight bytes are noted.
 *
 * Where the sink codes whole rows and does nothing else (output/sinks/coder.h), a copy has their
 * codes instead of their spans, so that no pixel of a held band is coded again.
 *
 * The parts of a key, of which those of a cel are only in the bands that it reaches
 *   frame     sizes, rows, columns, spaces, errors, filter; files of pictures, and when they were
 *             changed; of codes, all of the coder
 *   band      its number
 *   exposure  its weight, and all of its rostrum but the cels: camera, lights, grade, space,
 *             antialiasing
 *   stack     what decides the last bits in all rows: how high the tiles of the cull are, whether
 *             crowds are painted by themselves, and whether any cel has a mode
 *   cel       its hash, in the order of the cels, with the margin of the filter; where light is
 *             folded by a table, the number of its first layer
 *   light     the flat back light of a cel, before the cel, in all bands
 *   map       all that it is made of, its place and its light; the light behind it, in all bands
 *
 * What the cull hides in a row of tiles is decided by layers that are inside its tiles from the top
 * to the foot, and these reach all bands of the row.
 *
 * Invariants
 *   - what is given out is the spans that would be made, bit by bit, or the codes of these;
 *   - copies are put into the cache only after the whole frame has been made.
 * Frames with procedures, crowded frames, and frames in which a map lacks a zone, hold nothing.
 */
#pragma once

#include "base/cache.h"
#include "engine/span/row_queue.h"
#include "frames/render/frame.h"

/* The rows of a band that one worker is making. */
typedef struct cs_held_copy {
  cs_row_queue rows;
  int32_t next; /* the row of the frame that comes next */
  cs_row given; /* borrows the spans of a band that is kept or copied */
} cs_held_copy;

/* Finds the bands of a frame, before its rows are made: frame->held, which stays NULL where nothing
 * may be held. desc: of the frame. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_held_begin(celspan_context *context,
                                             const celspan_frame_desc *desc, cs_frame *frame);
/* is_made: all rows of the frame were made, so that their copies may be kept. */
void cs_held_end(celspan_context *context, cs_frame *frame, bool is_made);
/* How many rows of the frame are kept. */
uint64_t cs_held_rows(const cs_frame *frame);

/* Row y of the frame, if it is kept; else NULL. */
const cs_row *cs_held_find(const cs_frame *frame, cs_held_copy *copy, int32_t y);
/* Copies a row that was made, where its band shall be kept and there is room for the copy. Returns
 * what shall be given out instead of the row: the copy, or the row itself. */
const cs_row *cs_held_add(celspan_context *context, const cs_frame *frame, cs_held_copy *copy,
                          int32_t y, const cs_row *row);
void cs_held_copy_finish(cs_held_copy *copy, cs_memory *memory);
/* Bytes of all kept bands, and how many were kept and found. */
cs_cache_counts cs_held_count(celspan_context *context);
