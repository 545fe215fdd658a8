/* The files beside the tiles: the description that viewers read, and the page that shows the tiles.
 */
#pragma once

#include "writers/tiles/log.h"
#include "writers/tiles/plan.h"

typedef struct cs_tile_page {
  const cs_pyramid *pyramid;
  const cs_tile_log *log;
  const cs_tile_plan *plan;
  const celspan_frame_desc *frame;
  const char *title;
  char background[8]; /* "#rrggbb" */
} cs_tile_page;

/* Writes NAME.dzi or NAME/info.json, and index.html. */
CELSPAN_CHECKED celspan_status cs_tile_page_write(celspan_context *context,
                                                  const cs_tile_page *page);
/* Checks that there is a viewer to copy. Errors: INPUT. */
CELSPAN_CHECKED celspan_status cs_tile_page_find_viewer(celspan_context *context, const char *from);
/* Copies OpenSeadragon to FOLDER/openseadragon/. from: its folder or its script. Errors: INPUT,
 * OUTPUT. */
CELSPAN_CHECKED celspan_status cs_tile_page_copy_viewer(celspan_context *context,
                                                        const cs_pyramid *pyramid,
                                                        const char *from);
