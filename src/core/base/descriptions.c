/* The defaults of all descriptions, and the last field of each that must be given. */
#include "base/description.h"
#include "celspan/plane.h"
#include "celspan/relight.h"
#include "celspan/svg.h"
#include "celspan/text.h"
#include "celspan/trace.h"
#include "celspan/track.h"

#define LIGHT                                                                                      \
  { .gain = 1, .matte = 1 }

/* The last field that must be given, then the defaults that are not 0. */
#define DESCRIBE(type_, last, ...)                                                                 \
  static const type_ type_##_defaults = {.struct_size = sizeof(type_), __VA_ARGS__};               \
  const cs_description cs_##type_##_description = {.type = #type_,                                 \
                                                   .defaults = &type_##_defaults,                  \
                                                   .size = sizeof(type_),                          \
                                                   .needed = offsetof(type_, last) +               \
                                                             sizeof(((type_ *)0)->last)};          \
  void type_##_default(type_ *out, size_t struct_size) {                                           \
    cs_description_write(&cs_##type_##_description, &type_##_defaults, out, struct_size);          \
  }

DESCRIBE(celspan_context_desc, struct_size, .picture_bytes = (size_t)512 << 20,
         .defocus_bytes = (size_t)256 << 20)
DESCRIBE(celspan_picture_desc, struct_size, )
DESCRIBE(celspan_pattern_desc, box, )
DESCRIBE(celspan_noise_desc, kind, .octaves = 4, .size = 100, .gain = 0.5, .fades = true)
DESCRIBE(celspan_surface_desc, format, )
DESCRIBE(celspan_rect_desc, height, )
DESCRIBE(celspan_triangle_desc, points, )
DESCRIBE(celspan_ellipse_desc, radius_y, )
DESCRIBE(celspan_polygon_desc, point_count, )
DESCRIBE(celspan_nurbs_desc, point_count, .degree = 3)
DESCRIBE(celspan_path_desc, data, )
DESCRIBE(celspan_stroke_desc, struct_size, .degree = 1, .width = 1, .to = 1, .miter = 4)
DESCRIBE(celspan_image_desc, picture, )
DESCRIBE(celspan_scanline_desc, spans, )
DESCRIBE(celspan_grade_desc, struct_size, .contrast = 1, .saturation = 1, .gamma = 1,
         .lut_space = CELSPAN_SPACE_SRGB, .slope = {1, 1, 1}, .power = {1, 1, 1})
DESCRIBE(celspan_group_desc, object_count, .opacity = 1)
DESCRIBE(celspan_matte_desc, struct_size, )
DESCRIBE(celspan_key_desc, struct_size, .tolerance = 0.2, .softness = 0.1, .spill = 1, .to = 1)
DESCRIBE(celspan_blur_desc, radius, )
DESCRIBE(celspan_displace_desc, struct_size, .y = CELSPAN_CHANNEL_GREEN, .scale = 20,
         .space = CELSPAN_SPACE_SRGB)
DESCRIBE(celspan_sharpen_desc, struct_size, .radius = 2, .amount = 1)
DESCRIBE(celspan_shadow_desc, struct_size, .opacity = 1)
DESCRIBE(celspan_glow_desc, struct_size, .gain = 1)
DESCRIBE(celspan_outline_desc, width, .join = CELSPAN_STROKE_JOIN_ROUND, .opacity = 1)
DESCRIBE(celspan_warp_desc, map, .pieces = 400)
DESCRIBE(celspan_cel_desc, object_count, .opacity = 1, .front_texture = LIGHT,
         .back_texture = LIGHT)
DESCRIBE(celspan_filter_desc, kernel, .rows = 16)
DESCRIBE(celspan_rostrum_desc, cel_count, .brightness = 1, .front_texture = LIGHT,
         .back_texture = LIGHT)
DESCRIBE(celspan_inspect_desc, struct_size, )
DESCRIBE(celspan_frame_desc, exposure_count, )
DESCRIBE(celspan_sink, struct_size, )
DESCRIBE(celspan_coding, struct_size, )
DESCRIBE(celspan_file_desc, struct_size, )
DESCRIBE(celspan_text_desc, font_count, .size = 48, .leading = 1.2)
DESCRIBE(celspan_svg_desc, struct_size, .space = CELSPAN_SPACE_SRGB, .seconds = -1)
DESCRIBE(celspan_trace_desc, picture, .colours = 2, .speckle = 2, .smooth = 1)
DESCRIBE(celspan_plane_desc, height, .depth = 16)
DESCRIBE(celspan_plane_view, height, )
DESCRIBE(celspan_light_estimate_desc, picture, .colour = {0.18, 0.18, 0.18})
DESCRIBE(celspan_tracker_desc, region, )
