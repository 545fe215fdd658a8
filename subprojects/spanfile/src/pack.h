/* Pixels to spans: runs, gradients, and the rest raw.
 *
 * INVARIANT: a gradient is used only where it decodes to exactly the given pixels.
 */
#pragma once

#include "store.h"

/* A shorter run becomes raw pixels: its packet and the head of the next one would cost more. */
enum { SF_RUN_LEAST = 3 };

/* These append to the row; false: no memory. */
bool sf_pack_runs(const sf_memory *memory, sf_row *row, size_t pixel_size, const spanfile_run *runs,
                  size_t run_count);
bool sf_pack_raw(const sf_memory *memory, sf_row *row, size_t pixel_size, const void *pixels,
                 uint32_t count);
bool sf_pack_pixels(const sf_memory *memory, sf_row *row, spanfile_format format,
                    const void *pixels, uint32_t count);
