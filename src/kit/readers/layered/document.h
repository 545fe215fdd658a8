/* The XML documents that describe the contents of an archive of a painting: elements whose
 * attributes are numbers and words, foremost layer first.
 *
 *   OpenRaster  stack.xml     <image> <stack> <layer/> <stack> <layer/> ... </stack> </stack> ...
 *   Krita       maindoc.xml   <IMAGE> <layers> <layer/> <layer> <layers> ... </layers> </layer> ...
 *
 * A format has a function for each element that begins and one for each that ends. Open groups are
 * kept here.
 *
 * INVARIANT: while a document is read, the painting's layers are foremost first, groups before
 * their layers; then their order is reversed (readers/layered/contents.h).
 */
#pragma once

#include "celspan/layers.h"
#include "readers/layered/contents.h"
#include "readers/layered/profile.h"
#include "readers/layered/zip.h"

#define CS_DOCUMENT_BYTES ((size_t)16 << 20) /* the most bytes of its XML */
/* Bytes that all members together may unpack to while the painting is read: the first number, plus
 * the second number for each byte of the file. Many layers may name one member that unpacks to a
 * lot. */
#define CS_DOCUMENT_SCANNED ((int64_t)64 << 20)
#define CS_DOCUMENT_SCANNED_EACH 64

typedef struct cs_document cs_document;

typedef struct cs_document_format {
  const char *member;  /* a name in the archive */
  const char *purpose; /* for the message if the type module is missing */
  /* name: without its namespace. Any error stops the reading. end: NULL: does nothing */
  celspan_status (*start)(cs_document *document, const char *name);
  celspan_status (*end)(cs_document *document, const char *name);
  uint32_t depth; /* the most elements inside one another, enough for the deepest groups */
} cs_document_format;

/* Krita: the first key, from 1, that shows a member of the archive in the layer whose drawings were
 * added last, and the place of its drawing. An earlier layer may have left a key that is less. */
typedef struct cs_document_shown {
  size_t key, drawing;
} cs_document_shown;

struct cs_document {
  celspan_context *context;
  const cs_input *input;
  const cs_zip *zip;
  celspan_painting *painting;
  const cs_document_format *format;
  const char *const *attributes; /* the attributes of the element that begins */
  uint64_t line;
  celspan_status status;
  size_t group;             /* the innermost open one; CS_CONTENTS_NONE: none */
  bool has_size;            /* an element has given the size of the painting */
  char folder[256];         /* Krita: the folder in the archive that contains the layers */
  size_t unnamed;           /* OpenRaster: open stacks; the outermost one is the painting itself */
  char channel;             /* Krita: of the keys: 'c'ontent, 'o'pacity, 0 for others */
  double opaque;            /* Krita: what an opacity of 1 is in keys: 100 or 255 */
  cs_document_shown *shown; /* Krita: by member; NULL until a layer has drawings */
  int64_t scanned;          /* bytes of members that were unpacked */
  cs_profile profile;       /* Krita: of the image */
};

/* Reads the format's document and all that it names. Errors: INPUT, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_document_read(celspan_context *context, const cs_input *input,
                                                const cs_zip *zip, const cs_document_format *format,
                                                celspan_painting *painting);
/* Reads another member of the archive with the functions of `format`, while the document is read:
 * its layers lie in the open group. purpose and depth are those of the document. Errors: INPUT,
 * LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_document_read_member(cs_document *document,
                                                       const cs_zip_member *member,
                                                       const cs_document_format *format);
/* The value of an attribute; NULL: it is not given. */
const char *cs_document_text(const cs_document *document, const char *name);
/* A number; the second function rounds it. *out does not change if the attribute is missing.
 * Errors: INPUT for a value that is not a number from least to most. */
CELSPAN_CHECKED celspan_status cs_document_number(const cs_document *document, const char *name,
                                                  double least, double most, double *out);
CELSPAN_CHECKED celspan_status cs_document_whole(const cs_document *document, const char *name,
                                                 int32_t *out);
/* The size of the painting. Errors: INPUT, LIMIT. */
CELSPAN_CHECKED celspan_status cs_document_size(cs_document *document, const char *width,
                                                const char *height);
/* Adds a layer, named by `name`, to the open group, or adds a group that is open until it is
 * closed. */
CELSPAN_CHECKED celspan_status cs_document_add(cs_document *document, bool is_group,
                                               cs_contents_layer **out);
void cs_document_close_group(cs_document *document);
/* A note on the layer that was added last. Errors: NO_MEMORY. */
#define CS_DOCUMENT_NOTE(document, ...)                                                            \
  cs_contents_note((document)->context, (document)->painting,                                      \
                   cs_contents_last((document)->painting), __VA_ARGS__)
/* Counts bytes that were unpacked. Errors: LIMIT. */
CELSPAN_CHECKED celspan_status cs_document_scan(cs_document *document, int64_t count);
/* Records "path: member:line: sentence". */
celspan_status cs_document_fail(const cs_document *document, celspan_status status,
                                const char *format, ...) __attribute__((format(printf, 3, 4)));
/* Whether a name is allowed in an archive: relative, and without "..". */
bool cs_document_is_inside(const char *name);

extern const cs_document_format cs_openraster_format, cs_krita_format;
