/* Drawings that are read from SVG files.
 * The conventions of celspan/celspan.h hold. */
#ifndef CELSPAN_SVG_H
#define CELSPAN_SVG_H

#include "celspan/celspan.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A drawing that was read from an SVG file: one object, and its parts by name. Immutable and
 * counted like a scene value. _skipped lists the parts that are not drawn (see the reference,
 * "svg"), with their lines. Blending is in linear light, as everywhere; colours and gradients are
 * those a browser shows. A drawing is read without its animations, which the Lua face runs.
 *
 * Limits: a file of 256 MiB, 1,000,000 elements, nested 128 deep, 1,000,000 drawn when those of
 * `use` count each time, 65,536 rules of style; entities of plain text and elements, of 1,024 bytes
 * each, that make the file at most twice as large or a MiB. */
typedef struct celspan_svg celspan_svg;

/* A font for the texts of a drawing. */
typedef struct celspan_svg_font {
  /* As font-family names it, capital or small; "Family Bold", "Family Italic" and "Family Bold
   * Italic" are faces of it; "default": for every other family. */
  const char *family;
  const char *file;
} celspan_svg_font;

typedef struct celspan_svg_desc {
  size_t struct_size;
  const char *file;  /* read from the disc; NULL where there are bytes */
  const void *bytes; /* borrowed */
  size_t size;
  const char *name; /* for messages, of bytes; NULL: "the drawing" */
  /* only these are used: a text that needs another font is not drawn */
  const celspan_svg_font *fonts;
  size_t font_count;   /* at most 64 */
  celspan_space space; /* of the drawing, and of each of its parts, which are groups; LINEAR: the
                          colours of translucent shapes and of gradients are mixed as light */
} celspan_svg_desc;

CELSPAN_DESCRIPTION(celspan_svg_desc)
#define CELSPAN_SVG_DESC (celspan_svg_desc_initial())

/* A file that was read before and has not changed since is not read again.
 * desc: borrowed      out: new
 * Errors: INPUT with the file's line for what is missing, malformed or refused; LIMIT; NO_MEMORY;
 * BAD_ARGUMENT for the description. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_svg_read(celspan_context *context,
                                                            const celspan_svg_desc *desc,
                                                            celspan_svg **out);
CELSPAN_API celspan_svg *celspan_svg_ref(celspan_svg *svg);
CELSPAN_API void celspan_svg_unref(celspan_svg *svg);
/* The whole drawing, from (0, 0) to its size, in px of the file; parts beyond this area are drawn,
 * too. Borrowed from the drawing, like all results of the next four functions. Shared read. */
CELSPAN_API celspan_object *celspan_svg_object(const celspan_svg *svg);
CELSPAN_API celspan_point celspan_svg_size(const celspan_svg *svg);
/* Parts are the elements that have an id or, where it is the only one, a label of Inkscape's: in
 * the drawing's units, with the transforms of the elements around them, but without the clips and
 * opacity of these. An element that only `use` shows is a part at its place in the file. */
CELSPAN_API size_t celspan_svg_part_count(const celspan_svg *svg);
CELSPAN_API celspan_object *celspan_svg_part(const celspan_svg *svg, size_t index,
                                             const char **name);
/* An element that is drawn, with or without a name of its own. Its texts and its object live as
 * long as the call of the visitor. */
typedef struct celspan_svg_element {
  const char *name; /* "#7": its number among the elements of the file, for celspan_svg_with */
  const char *tag;
  const char *id, *label, *classes; /* NULL: none */
  const char *fill;                 /* "#rrggbb" of a shape or a text; NULL: no flat colour */
  int32_t line;
  int32_t depth;          /* how many of the elements visited before it contain it */
  celspan_object *object; /* like the object of a part */
} celspan_svg_element;
typedef celspan_status (*celspan_svg_visit)(void *user, const celspan_svg_element *element);
/* Visits the elements in the order in which they are drawn, each once; those that only `use` shows
 * come last. Errors: NO_MEMORY; those of the visitor. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_svg_elements(celspan_context *context,
                                                                const celspan_svg *svg,
                                                                celspan_svg_visit visit,
                                                                void *user);
/* The parts that were not drawn, in the order of the file. */
CELSPAN_API size_t celspan_svg_skipped_count(const celspan_svg *svg);
CELSPAN_API const char *celspan_svg_skipped(const celspan_svg *svg, size_t index, int32_t *line);

/* Makes another object from a part. *out is new, or the part with one more reference. Called for
 * every place where the part is drawn. */
typedef celspan_status (*celspan_svg_change)(void *user, celspan_context *context,
                                             celspan_object *part, celspan_object **out);
typedef struct celspan_svg_changed {
  const char *name; /* the name of a part or an element */
  celspan_svg_change change;
  void *user;
} celspan_svg_changed;

/* The drawing with parts changed, inner ones first; the clips, the opacity and the order of what
 * they are in stay, and so does the drawing itself.
 * out: new      Errors: NO_MEMORY, LIMIT; BAD_ARGUMENT for a name that is no part; those of the
 * functions. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_svg_with(celspan_context *context,
                                                            const celspan_svg *svg,
                                                            const celspan_svg_changed *changes,
                                                            size_t change_count, celspan_svg **out);

#ifdef __cplusplus
}
#endif
#endif
