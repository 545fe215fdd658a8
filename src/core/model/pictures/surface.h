/* Surfaces: pictures in memory: a buffer of the host, or pixels that a function of the host fills
 * in on demand.
 *
 *   buffer --widen--> RGBA floats of a rectangle, coded as the surface is
 *   fill --codes--> the end of the same memory --widen--> RGBA floats
 *
 *      memory of the rectangle, 16 bytes a pixel
 *      |                        c c c c c c c c|   codes, as fill leaves them
 *      |f f f f f . . . . . . . . . . c c c c c|   floats, from the front: never past the next code
 *
 * INVARIANT: a surface has pixels or a fill function, and a stride of its rows; its values never
 * change, or its key promises that they do not. Its hash is made of its content, or of its key.
 *
 * A reader is a surface whose fill function reads a file of a format of ours: it is asked for its
 * rows from top to bottom as far as that can be, and its failures keep their status and sentence.
 *
 * Threads: only the count of references changes. A buffer is read by all. A fill function is called
 * while the entry of its picture is locked for reading (model/pictures/store.h): by one thread at a
 * time for equal pictures, by several where its surface is shown in different ways. A frame that
 * shows one which stays on its thread is made with one worker (frames/render/frame.c).
 */
#pragma once

#include "base/context.h"
#include "base/hash.h"
#include "model/pictures/module.h"

struct celspan_surface {
  atomic_size_t references;
  cs_memory *memory;
  cs_hash hash;
  celspan_surface_desc desc; /* pixels: the copy, unless there is a release function */
  size_t copied;             /* bytes of the copy */
  /* a reader, so that its hash differs from the hash of a host's surface with the same key */
  bool is_reader;
};

/* As celspan_surface_create, with a fill function that any thread may call: a reader. */
CELSPAN_CHECKED celspan_status cs_surface_create_reader(celspan_context *context,
                                                        const celspan_surface_desc *desc,
                                                        celspan_surface **out);

/* The header that a picture module would report for such a file. */
void cs_surface_describe(const celspan_surface *surface, cs_picture_header *out);
/* RGBA floats of a rectangle inside the surface, row-major, coded. Errors: CALLBACK, with the
 * rectangle. */
CELSPAN_CHECKED celspan_status cs_surface_read(celspan_context *context,
                                               const celspan_surface *surface,
                                               const celspan_rectangle *rectangle, float *rgba);
/* Whether only the rendering thread may ask for the surface's pixels. */
bool cs_surface_stays_on_thread(const celspan_surface *surface);
