/* What is written beside the tiles: the description that viewers read, and the page that shows
 * them.
 */
#ifndef CS_CLI_TILEPAGE_H
#define CS_CLI_TILEPAGE_H

#include "cli/tilelog.h"
#include "cli/tileplan.h"

typedef struct cs_tilepage {
  const cs_pyramid *pyramid;
  const cs_tilelog *log;
  const cs_tileplan *plan;
  const celspan_frame_desc *frame;
  const char *title;
  char background[8]; /* "#rrggbb" */
} cs_tilepage;

/* NAME.dzi or NAME/info.json, and index.html. */
CELSPAN_CHECKED celspan_status cs_tilepage_write(celspan_context *context, const cs_tilepage *page);
/* Copies OpenSeadragon to FOLDER/openseadragon/. from: its folder or its script. Errors: INPUT,
 * OUTPUT. */
CELSPAN_CHECKED celspan_status cs_tilepage_copy_viewer(celspan_context *context,
                                                       const cs_pyramid *pyramid, const char *from);

#endif
