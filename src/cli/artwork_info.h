/* celspan info of artwork: layered paintings and drawings, by what is in them. */
#ifndef CS_CLI_ARTWORK_INFO_H
#define CS_CLI_ARTWORK_INFO_H

#include "cli/report.h"

typedef enum cs_artwork {
  CS_ARTWORK_NONE = 0, /* or nothing that can be read: other readers say so */
  CS_ARTWORK_ARCHIVE,  /* OpenRaster, Krita */
  CS_ARTWORK_PSD,      /* a picture too */
  CS_ARTWORK_FOLDER,   /* OCA, or pictures */
  CS_ARTWORK_SVG
} cs_artwork;

/* What a file can be, by its first bytes. */
cs_artwork cs_artwork_info_kind(const char *path);
/* Prints what is in it, or reports why it cannot be read. */
cs_exit cs_artwork_info_print(celspan_context *context, const char *path, cs_artwork kind);

#endif
