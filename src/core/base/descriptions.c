/* The defaults of all descriptions of the core, and the last field of each that must be given. */
#include "base/description.h"

#define LIGHT                                                                                      \
  { .gain = 1, .matte = 1 }

CS_DESCRIBE(celspan_context_desc, struct_size, .picture_bytes = (size_t)512 << 20,
            .defocus_bytes = (size_t)256 << 20)
CS_DESCRIBE(celspan_picture_desc, struct_size, )
CS_DESCRIBE(celspan_pattern_desc, box, )
CS_DESCRIBE(celspan_fitted_desc, stop_count, .to_y = 1)
CS_DESCRIBE(celspan_noise_desc, kind, .octaves = 4, .size = 100, .gain = 0.5, .fades = true)
CS_DESCRIBE(celspan_surface_desc, format, )
CS_DESCRIBE(celspan_rect_desc, height, )
CS_DESCRIBE(celspan_triangle_desc, points, )
CS_DESCRIBE(celspan_ellipse_desc, radius_y, )
CS_DESCRIBE(celspan_polygon_desc, point_count, )
CS_DESCRIBE(celspan_nurbs_desc, point_count, .degree = 3)
CS_DESCRIBE(celspan_path_desc, data, )
CS_DESCRIBE(celspan_stroke_desc, struct_size, .degree = 1, .width = 1, .to = 1, .miter = 4)
CS_DESCRIBE(celspan_image_desc, picture, )
CS_DESCRIBE(celspan_scanline_desc, spans, )
CS_DESCRIBE(celspan_grade_desc, struct_size, .contrast = 1, .saturation = 1, .gamma = 1,
            .lut_space = CELSPAN_SPACE_SRGB, .slope = {1, 1, 1}, .power = {1, 1, 1})
CS_DESCRIBE(celspan_group_desc, object_count, .opacity = 1)
CS_DESCRIBE(celspan_matte_desc, struct_size, )
CS_DESCRIBE(celspan_key_desc, struct_size, .tolerance = 0.2, .softness = 0.1, .spill = 1, .to = 1)
CS_DESCRIBE(celspan_blur_desc, radius, )
CS_DESCRIBE(celspan_displace_desc, struct_size, .y = CELSPAN_CHANNEL_GREEN, .scale = 20,
            .space = CELSPAN_SPACE_SRGB)
CS_DESCRIBE(celspan_sharpen_desc, struct_size, .radius = 2, .amount = 1)
CS_DESCRIBE(celspan_shadow_desc, struct_size, .opacity = 1)
CS_DESCRIBE(celspan_glow_desc, struct_size, .gain = 1)
CS_DESCRIBE(celspan_outline_desc, width, .join = CELSPAN_STROKE_JOIN_ROUND, .opacity = 1)
CS_DESCRIBE(celspan_warp_desc, map, .pieces = 400)
CS_DESCRIBE(celspan_cel_desc, object_count, .opacity = 1, .front_texture = LIGHT,
            .back_texture = LIGHT)
CS_DESCRIBE(celspan_filter_desc, kernel, .rows = 16)
CS_DESCRIBE(celspan_rostrum_desc, cel_count, .brightness = 1, .front_texture = LIGHT,
            .back_texture = LIGHT)
CS_DESCRIBE(celspan_inspect_desc, struct_size, )
CS_DESCRIBE(celspan_frame_desc, exposure_count, )
CS_DESCRIBE(celspan_sink, struct_size, )
CS_DESCRIBE(celspan_coding, struct_size, )
CS_DESCRIBE(celspan_file_desc, struct_size, )
