/* Relighting: removes light from pictures, and makes frames whose lights can be changed. The
 * conventions of celspan/celspan.h hold. */
#ifndef CELSPAN_RELIGHT_H
#define CELSPAN_RELIGHT_H

#include "celspan/celspan.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The light in which a picture was taken: one colour, or a field that changes slowly over the
 * picture. At x and y, from -1 at the left and the top edge of the picture to 1 at the right and
 * the bottom one, channel c is
 *
 *   colour[c] * exp(sum over k of terms[c][k] * b[k]),  b = x, y, xx, xy, yy, xxx, xxy, xyy, yyy
 *
 * A plain value, checked where it is used: colours are above 0, and so is the field everywhere. */
#define CELSPAN_LIGHT_FIELD_TERMS 9
typedef struct celspan_light_field {
  double colour[3];
  double terms[3][CELSPAN_LIGHT_FIELD_TERMS];
} celspan_light_field;

/* The same light everywhere. Any thread. */
CELSPAN_API celspan_light_field celspan_light_field_flat(double r, double g, double b);
/* The light at a place, from 0, 0 at the picture's top left corner to 1, 1. Any thread. */
CELSPAN_API void celspan_light_field_at(const celspan_light_field *field, double u, double v,
                                        double rgb[3]);
/* The field as a light with a shape, or as the paint that shows it: an opaque picture of that many
 * pixels. out: new      Errors: NO_MEMORY; BAD_ARGUMENT for the field or the size. */
CELSPAN_API CELSPAN_CHECKED celspan_status
celspan_light_field_texture(celspan_context *context, const celspan_light_field *field,
                            int32_t width, int32_t height, celspan_texture **out);

/* The known fact about a picture whose light celspan must find. */
typedef enum celspan_light_clue {
  CELSPAN_LIGHT_CLUE_GREY = 0, /* the mean pigment of the picture is `colour` */
  CELSPAN_LIGHT_CLUE_PATCH,    /* the pigment of a patch is `colour` */
  CELSPAN_LIGHT_CLUE_LIGHT     /* the mean of the light is `colour` */
} celspan_light_clue;

typedef struct celspan_light_estimate_desc {
  size_t struct_size;
  const celspan_texture *picture; /* borrowed; a picture; only its pixels count */
  celspan_light_clue clue;
  double colour[3];  /* above 0; 0.18 each, which light meters treat as grey */
  celspan_box patch; /* pixels of the picture */
  /* Whether the light is uneven, so that a field is fitted. Without `blank`, the field is fitted to
   * the picture, and its pigments are assumed to be alike in all its parts. With `blank`, the field
   * is fitted to that picture, which shows something white or grey in the same light. */
  bool is_uneven;
  const celspan_texture *blank; /* borrowed; NULL: the picture itself */
} celspan_light_estimate_desc;

CELSPAN_DESCRIPTION(celspan_light_estimate_desc)
#define CELSPAN_LIGHT_ESTIMATE_DESC (celspan_light_estimate_desc_initial())

/* Finds the light of a picture. desc: borrowed Errors: those of pictures; BAD_ARGUMENT for the
 * description, and where the picture has too little information: a patch or a channel without
 * light, too few places that are lit for a field. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_light_estimate(
    celspan_context *context, const celspan_light_estimate_desc *desc, celspan_light_field *out);

/* Light taken off pictures, R = S F + T I at every pixel: textures of their own S, T and beta,
 * which take any light. Values of S above 1, such as highlights, are kept; up to 65504. The
 * textures are pictures in memory, of 16 bytes a pixel, or of 32 with a medium; at most 268,435,456
 * pixels. All that are given are textures that are pictures, borrowed, and so are fields; the
 * sampling, the wrap and the box of the first one are those of the texture that is made. out: new
 * Errors: those of pictures; BAD_ARGUMENT for a field, for pictures of different sizes, and where
 * the pictures cannot have been taken in that light, with what was found; LIMIT; NO_MEMORY.
 *
 * _picture: one picture, its alpha the share of it that is paint, and the rest clear.
 * _exposures: lit from the front alone, and from behind alone.
 * _grounds: twice in the same light, before two different grounds. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_relight_picture(celspan_context *context,
                                                                   const celspan_texture *picture,
                                                                   const celspan_light_field *light,
                                                                   celspan_texture **out);
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_relight_exposures(
    celspan_context *context, const celspan_texture *front, const celspan_light_field *front_light,
    const celspan_texture *back, const celspan_light_field *back_light, celspan_texture **out);

typedef struct celspan_relight_ground {
  const celspan_texture *picture; /* what is relit, before the ground */
  const celspan_texture *ground;  /* the ground alone, in the same light */
  double colour[3];               /* the light that it gives, if `ground` is NULL */
} celspan_relight_ground;

CELSPAN_API CELSPAN_CHECKED celspan_status
celspan_relight_grounds(celspan_context *context, const celspan_relight_ground grounds[2],
                        const celspan_light_field *light, celspan_texture **out);

/* Writes a picture texture as an EXR of 32-bit floats with seven channels, whole or not at all: R,
 * G, B are S and A is beta, so that other programs show it in white light; medium.R, medium.G and
 * medium.B are T. Errors: those of pictures; OUTPUT; BAD_ARGUMENT for a texture that is no picture
 * used as paint, and for another ending than .exr. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_relight_write(celspan_context *context,
                                                                 const celspan_texture *texture,
                                                                 const char *path);
/* Such a file as a texture. Its header is read at once.
 * out: new      Errors: those of pictures; INPUT for a file without these channels. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_relight_read(celspan_context *context,
                                                                const char *path,
                                                                celspan_texture **out);

/* A rendered frame of which every light can be changed without rendering it again. For each cel it
 * keeps the light that a unit of the front light, and a unit of the back light, adds to each pixel.
 * This light is composed first, then antialiased, and kept as rows of spans. A frame is the sum of
 * the rows, weighted with the lights. All lights are flat. The sum agrees with a frame of the same
 * tolerance within 1/65535 of the brightest light. Filters with negative lobes limit colours to
 * the range under them, frame by frame, so that edges differ there. Immutable; shared read. */
typedef struct celspan_stack celspan_stack;

/* The lights of one cel. */
typedef struct celspan_stack_light {
  celspan_light front, back;
} celspan_stack_light;

/* desc: borrowed; one exposure, whose weight is not used. A tolerance of 0 means 2^-18.
 * out: new      Errors: those of rendering; BAD_ARGUMENT for a light that is a texture, and the
 * sentence names the cel; BAD_ARGUMENT unless there is one exposure; LIMIT for more than 4,096
 * cels. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_stack_create(celspan_context *context,
                                                                const celspan_frame_desc *desc,
                                                                celspan_stack **out);
CELSPAN_API celspan_stack *celspan_stack_ref(celspan_stack *stack);
CELSPAN_API void celspan_stack_unref(celspan_stack *stack);
/* The size of the crop, in pixels. */
CELSPAN_API void celspan_stack_size(const celspan_stack *stack, int32_t *width, int32_t *height);
/* The number of its lights: one for the back light of the rostrum itself, whose front does not
 * count, then one for each cel from the rear. */
CELSPAN_API size_t celspan_stack_light_count(const celspan_stack *stack);
/* The lights of the rostrum, brightness included. lights: room for celspan_stack_light_count
 * lights */
CELSPAN_API void celspan_stack_lights(const celspan_stack *stack, celspan_stack_light *lights);
/* The bytes of its rows of spans. */
CELSPAN_API size_t celspan_stack_bytes(const celspan_stack *stack);
/* The frame in these lights, as many as it takes, into width x height RGBA floats, linear and
 * premultiplied, rows from top to bottom. workers: threads at most; 0: one per processor
 * rgba: best where 16 divides its address: pixels then go past the caches
 * Errors: BAD_ARGUMENT for a light that is negative or not finite; NO_MEMORY. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_stack_pixels(celspan_context *context,
                                                                const celspan_stack *stack,
                                                                const celspan_stack_light *lights,
                                                                int workers, float *rgba);

#ifdef __cplusplus
}
#endif
#endif
