/* Descriptions from outside, read into full ones. A host may have been built with an earlier or a
 * later header: struct_size says how many bytes of the description there are.
 *
 *     host's      size | a | b | c |            the library is later: d has its default
 *     library's   size | a | b | c | d |
 *     host's      size | a | b | c | d | 0 |    the host is later: its further fields must be 0
 *
 * INVARIANT: behind the door every description is full, so nothing else looks at struct_size, and a
 * field is read only if the host has it. A size is a multiple of 8. Whether a field ends there is
 * not checked, because the macros of the public headers set the size.
 */
#pragma once

#include "base/context.h"

typedef struct cs_description {
  const char *type;
  const void *defaults;
  size_t size;   /* the size of the whole description */
  size_t needed; /* bytes up to the end of the last field that must be given */
} cs_description;

/* Those of the core; the kit defines its own where it reads them. */
#define CS_DESCRIPTIONS(EACH)                                                                      \
  EACH(celspan_context_desc)                                                                       \
  EACH(celspan_picture_desc)                                                                       \
  EACH(celspan_pattern_desc)                                                                       \
  EACH(celspan_fitted_desc)                                                                        \
  EACH(celspan_noise_desc)                                                                         \
  EACH(celspan_surface_desc)                                                                       \
  EACH(celspan_rect_desc)                                                                          \
  EACH(celspan_triangle_desc)                                                                      \
  EACH(celspan_ellipse_desc)                                                                       \
  EACH(celspan_polygon_desc)                                                                       \
  EACH(celspan_nurbs_desc)                                                                         \
  EACH(celspan_path_desc)                                                                          \
  EACH(celspan_stroke_desc)                                                                        \
  EACH(celspan_image_desc)                                                                         \
  EACH(celspan_scanline_desc)                                                                      \
  EACH(celspan_grade_desc)                                                                         \
  EACH(celspan_group_desc)                                                                         \
  EACH(celspan_matte_desc)                                                                         \
  EACH(celspan_key_desc)                                                                           \
  EACH(celspan_blur_desc)                                                                          \
  EACH(celspan_displace_desc)                                                                      \
  EACH(celspan_sharpen_desc)                                                                       \
  EACH(celspan_shadow_desc)                                                                        \
  EACH(celspan_glow_desc)                                                                          \
  EACH(celspan_outline_desc)                                                                       \
  EACH(celspan_warp_desc)                                                                          \
  EACH(celspan_cel_desc)                                                                           \
  EACH(celspan_filter_desc)                                                                        \
  EACH(celspan_rostrum_desc)                                                                       \
  EACH(celspan_inspect_desc)                                                                       \
  EACH(celspan_frame_desc)                                                                         \
  EACH(celspan_sink)                                                                               \
  EACH(celspan_coding)                                                                             \
  EACH(celspan_file_desc)

#define CS_DECLARE_DESCRIPTION(type) extern const cs_description cs_##type##_description;
CS_DESCRIPTIONS(CS_DECLARE_DESCRIPTION)
#undef CS_DECLARE_DESCRIPTION

/* Defines the description of a type and what sets its defaults: the last field that must be given,
 * then the defaults that are not 0. */
#define CS_DESCRIBE(type_, last, ...)                                                              \
  extern const cs_description cs_##type_##_description;                                            \
  static const type_ type_##_defaults = {.struct_size = sizeof(type_), __VA_ARGS__};               \
  const cs_description cs_##type_##_description = {.type = #type_,                                 \
                                                   .defaults = &type_##_defaults,                  \
                                                   .size = sizeof(type_),                          \
                                                   .needed = offsetof(type_, last) +               \
                                                             sizeof(((type_ *)0)->last)};          \
  void type_##_default(type_ *out, size_t struct_size) {                                           \
    cs_description_write(&cs_##type_##_description, &type_##_defaults, out, struct_size);          \
  }

/* Makes *out the full form of the given description. noun: for messages. context: NULL if there is
 * none yet. Errors: BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_description_read(celspan_context *context, const char *noun,
                                                   const cs_description *description,
                                                   const void *given, void *out);
/* Writes the first `size` bytes of a full description into one of the host, which has this size;
 * the remaining bytes are 0. */
void cs_description_write(const cs_description *description, const void *full, void *out,
                          size_t size);

/* Writes a result, `size` bytes from `full`, into a structure of the host that begins with its own
 * struct_size. An older structure gets the fields that it has; in a newer one the additional fields
 * are 0. noun, type: for messages. context: NULL if there is none. Errors: BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_result_write(celspan_context *context, const char *noun,
                                               const char *type, const void *full, size_t size,
                                               void *out);
#define CS_RESULT(context, noun, type, full, out)                                                  \
  cs_result_write(context, noun, #type, full, sizeof(type), out)

/* Checks a description from outside: `desc`, a parameter, is made to point to a full copy of the
 * description. */
#define CS_READ(context, noun, type, desc)                                                         \
  type desc##_whole;                                                                               \
  CS_TRY(cs_description_read(context, noun, &cs_##type##_description, desc, &desc##_whole));       \
  (desc) = &desc##_whole
