/* Planes: frames without a resolution.
 * The conventions of celspan/celspan.h hold. */
#ifndef CELSPAN_PLANE_H
#define CELSPAN_PLANE_H

#include "celspan/celspan.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A plane is a frame without a resolution: what can be seen of it, as curves with a colour or
 * gradients or pictures on each side. It is made once, and drawn at any size, whole or any crop of
 * it, without its rostrum. It is kept in plane files (docs/planefile.md).
 *
 * It is as exact as a frame of 16,381 pixels a side: curves are the rostrum's own, but where two of
 * them cross may be off by 1/50 of such a pixel. Colours are multiples of 1/65,535, and pixels are
 * means of linear light. Immutable; shared read. */
typedef struct celspan_plane celspan_plane;

typedef struct celspan_plane_desc {
  size_t struct_size;
  double width, height; /* film units, above 0 */
  int32_t depth;        /* 8: colours are 8-bit sRGB codes, which makes a smaller file; 16 */
  celspan_space space;  /* of the film, for a rostrum that has none. Pixels are means of light */
} celspan_plane_desc;

CELSPAN_DESCRIPTION(celspan_plane_desc)
#define CELSPAN_PLANE_DESC (celspan_plane_desc_initial())

/* rostrum: borrowed; its antialiasing does not count      desc: borrowed      out: new
 * Errors: those of rendering; BAD_ARGUMENT for a depth that is not allowed, and for what a plane
 * cannot keep: scan-line procedures, objects that are displaced, or blurred in a direction, in
 * perspective or very little, pictures with a medium of their own or composited in sRGB, and, where
 * several gradients or pictures lie over each other, grades, modes other than multiply and screen,
 * and glass inside a group that is faded. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_plane_create(celspan_context *context,
                                                                const celspan_rostrum *rostrum,
                                                                const celspan_plane_desc *desc,
                                                                celspan_plane **out);
/* A plane file; of a film its first frame. out: new      Errors: NO_MEMORY; INPUT; LIMIT for more
 * than 1 GiB. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_plane_read(celspan_context *context,
                                                              const char *path,
                                                              celspan_plane **out);
CELSPAN_API celspan_plane *celspan_plane_ref(celspan_plane *plane);
CELSPAN_API void celspan_plane_unref(celspan_plane *plane);
/* The size in film units. */
CELSPAN_API void celspan_plane_size(const celspan_plane *plane, double *width, double *height);
/* Whether its alpha is certain to be 1 everywhere. */
CELSPAN_API bool celspan_plane_is_opaque(const celspan_plane *plane);
/* The number of frames of its file, 1 for a single plane; and their rate, 0 for a single plane. */
CELSPAN_API int32_t celspan_plane_frames(const celspan_plane *plane, double *frames_second);
/* Another frame of the file, from 0. out: new      Errors: NO_MEMORY; INPUT; BAD_ARGUMENT: there is
 * no such frame. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_plane_frame(celspan_context *context,
                                                               const celspan_plane *plane,
                                                               int32_t frame, celspan_plane **out);
/* The bytes of its file. */
CELSPAN_API size_t celspan_plane_bytes(const celspan_plane *plane);
/* The file appears under its name whole or not at all. A frame of a film is written with the whole
 * film. Errors: NO_MEMORY; OUTPUT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_plane_write(celspan_context *context,
                                                               const celspan_plane *plane,
                                                               const char *path);

typedef struct celspan_plane_view {
  size_t struct_size;
  int32_t width, height; /* pixels of the whole frame, 1..2,147,483,647 */
  int32_t crop_x, crop_y;
  int32_t crop_width, crop_height;  /* 0 0: the whole frame */
  celspan_antialias_mode antialias; /* AREA or NONE */
} celspan_plane_view;

CELSPAN_DESCRIPTION(celspan_plane_view)
#define CELSPAN_PLANE_VIEW (celspan_plane_view_initial())

/* Draws a view into a sink, as celspan_frame_render does. The pixels of a crop are the same as in
 * the whole frame, to the bit. Errors: NO_MEMORY; LIMIT, BAD_ARGUMENT for the view; those of the
 * sink. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_plane_render(celspan_context *context,
                                                                const celspan_plane *plane,
                                                                const celspan_plane_view *view,
                                                                const celspan_sink *sink);
/* Draws into memory, as celspan_frame_pixels does. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_plane_pixels(celspan_context *context,
                                                                const celspan_plane *plane,
                                                                const celspan_plane_view *view,
                                                                const celspan_coding *coding,
                                                                void *pixels, size_t stride);

#ifdef __cplusplus
}
#endif
#endif
