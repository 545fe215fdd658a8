/* Where the fields of descriptions begin and end. Printed by `lua5.4 tests/face/main.lua fields`
 * from the public headers; a test compares. */
#pragma once

#define FIELD(type, name)                                                                          \
  { offsetof(type, name), offsetof(type, name) + sizeof(((type *)0)->name) }

static const cs_description_field celspan_context_desc_fields[] = {
    FIELD(celspan_context_desc, struct_size),   FIELD(celspan_context_desc, resize),
    FIELD(celspan_context_desc, resize_user),   FIELD(celspan_context_desc, picture_bytes),
    FIELD(celspan_context_desc, defocus_bytes),
};
static const cs_description_field celspan_picture_desc_fields[] = {
    FIELD(celspan_picture_desc, struct_size), FIELD(celspan_picture_desc, file),
    FIELD(celspan_picture_desc, colour),      FIELD(celspan_picture_desc, layer),
    FIELD(celspan_picture_desc, subimage),    FIELD(celspan_picture_desc, sampling),
    FIELD(celspan_picture_desc, use),         FIELD(celspan_picture_desc, wrap),
    FIELD(celspan_picture_desc, has_box),     FIELD(celspan_picture_desc, box),
    FIELD(celspan_picture_desc, surface),     FIELD(celspan_picture_desc, has_source),
    FIELD(celspan_picture_desc, source),      FIELD(celspan_picture_desc, smooth),
};
static const cs_description_field celspan_noise_desc_fields[] = {
    FIELD(celspan_noise_desc, struct_size), FIELD(celspan_noise_desc, kind),
    FIELD(celspan_noise_desc, octaves),     FIELD(celspan_noise_desc, size),
    FIELD(celspan_noise_desc, gain),        FIELD(celspan_noise_desc, at),
    FIELD(celspan_noise_desc, stops),       FIELD(celspan_noise_desc, stop_count),
    FIELD(celspan_noise_desc, seed),        FIELD(celspan_noise_desc, fades),
};
static const cs_description_field celspan_pattern_desc_fields[] = {
    FIELD(celspan_pattern_desc, struct_size), FIELD(celspan_pattern_desc, art),
    FIELD(celspan_pattern_desc, box),         FIELD(celspan_pattern_desc, has_matrix),
    FIELD(celspan_pattern_desc, matrix),
};
static const cs_description_field celspan_surface_desc_fields[] = {
    FIELD(celspan_surface_desc, struct_size), FIELD(celspan_surface_desc, width),
    FIELD(celspan_surface_desc, height),      FIELD(celspan_surface_desc, format),
    FIELD(celspan_surface_desc, alpha),       FIELD(celspan_surface_desc, pixels),
    FIELD(celspan_surface_desc, stride),      FIELD(celspan_surface_desc, fill),
    FIELD(celspan_surface_desc, user),        FIELD(celspan_surface_desc, release),
    FIELD(celspan_surface_desc, any_thread),  FIELD(celspan_surface_desc, has_key),
    FIELD(celspan_surface_desc, key),
};
static const cs_description_field celspan_rect_desc_fields[] = {
    FIELD(celspan_rect_desc, struct_size), FIELD(celspan_rect_desc, x),
    FIELD(celspan_rect_desc, y),           FIELD(celspan_rect_desc, width),
    FIELD(celspan_rect_desc, height),      FIELD(celspan_rect_desc, radius),
    FIELD(celspan_rect_desc, texture),
};
static const cs_description_field celspan_triangle_desc_fields[] = {
    FIELD(celspan_triangle_desc, struct_size),
    FIELD(celspan_triangle_desc, points),
    FIELD(celspan_triangle_desc, texture),
};
static const cs_description_field celspan_ellipse_desc_fields[] = {
    FIELD(celspan_ellipse_desc, struct_size), FIELD(celspan_ellipse_desc, centre),
    FIELD(celspan_ellipse_desc, radius_x),    FIELD(celspan_ellipse_desc, radius_y),
    FIELD(celspan_ellipse_desc, texture),
};
static const cs_description_field celspan_polygon_desc_fields[] = {
    FIELD(celspan_polygon_desc, struct_size), FIELD(celspan_polygon_desc, points),
    FIELD(celspan_polygon_desc, point_count), FIELD(celspan_polygon_desc, rule),
    FIELD(celspan_polygon_desc, texture),
};
static const cs_description_field celspan_nurbs_desc_fields[] = {
    FIELD(celspan_nurbs_desc, struct_size), FIELD(celspan_nurbs_desc, points),
    FIELD(celspan_nurbs_desc, weights),     FIELD(celspan_nurbs_desc, point_count),
    FIELD(celspan_nurbs_desc, degree),      FIELD(celspan_nurbs_desc, knots),
    FIELD(celspan_nurbs_desc, knot_count),  FIELD(celspan_nurbs_desc, closure),
    FIELD(celspan_nurbs_desc, rule),        FIELD(celspan_nurbs_desc, texture),
};
static const cs_description_field celspan_path_desc_fields[] = {
    FIELD(celspan_path_desc, struct_size),
    FIELD(celspan_path_desc, data),
    FIELD(celspan_path_desc, rule),
    FIELD(celspan_path_desc, texture),
};
static const cs_description_field celspan_stroke_desc_fields[] = {
    FIELD(celspan_stroke_desc, struct_size), FIELD(celspan_stroke_desc, points),
    FIELD(celspan_stroke_desc, widths),      FIELD(celspan_stroke_desc, point_count),
    FIELD(celspan_stroke_desc, degree),      FIELD(celspan_stroke_desc, closed),
    FIELD(celspan_stroke_desc, data),        FIELD(celspan_stroke_desc, outline),
    FIELD(celspan_stroke_desc, width),       FIELD(celspan_stroke_desc, cap),
    FIELD(celspan_stroke_desc, join),        FIELD(celspan_stroke_desc, miter),
    FIELD(celspan_stroke_desc, dashes),      FIELD(celspan_stroke_desc, dash_count),
    FIELD(celspan_stroke_desc, dash_offset), FIELD(celspan_stroke_desc, taper),
    FIELD(celspan_stroke_desc, from),        FIELD(celspan_stroke_desc, to),
    FIELD(celspan_stroke_desc, texture),     FIELD(celspan_stroke_desc, profile),
};
static const cs_description_field celspan_image_desc_fields[] = {
    FIELD(celspan_image_desc, struct_size), FIELD(celspan_image_desc, picture),
    FIELD(celspan_image_desc, x),           FIELD(celspan_image_desc, y),
    FIELD(celspan_image_desc, width),       FIELD(celspan_image_desc, height),
    FIELD(celspan_image_desc, fit),
};
static const cs_description_field celspan_scanline_desc_fields[] = {
    FIELD(celspan_scanline_desc, struct_size), FIELD(celspan_scanline_desc, bounds),
    FIELD(celspan_scanline_desc, spans),       FIELD(celspan_scanline_desc, user),
    FIELD(celspan_scanline_desc, release),     FIELD(celspan_scanline_desc, any_thread),
};
static const cs_description_field celspan_grade_desc_fields[] = {
    FIELD(celspan_grade_desc, struct_size), FIELD(celspan_grade_desc, exposure),
    FIELD(celspan_grade_desc, contrast),    FIELD(celspan_grade_desc, has_pivot),
    FIELD(celspan_grade_desc, pivot),       FIELD(celspan_grade_desc, saturation),
    FIELD(celspan_grade_desc, hue),         FIELD(celspan_grade_desc, temperature),
    FIELD(celspan_grade_desc, tint),        FIELD(celspan_grade_desc, gamma),
    FIELD(celspan_grade_desc, has_matrix),  FIELD(celspan_grade_desc, matrix),
    FIELD(celspan_grade_desc, curve),       FIELD(celspan_grade_desc, curve_count),
    FIELD(celspan_grade_desc, lut),         FIELD(celspan_grade_desc, lut_space),
    FIELD(celspan_grade_desc, slope),       FIELD(celspan_grade_desc, offset),
    FIELD(celspan_grade_desc, power),       FIELD(celspan_grade_desc, steps),
};
static const cs_description_field celspan_group_desc_fields[] = {
    FIELD(celspan_group_desc, struct_size),  FIELD(celspan_group_desc, objects),
    FIELD(celspan_group_desc, object_count), FIELD(celspan_group_desc, opacity),
    FIELD(celspan_group_desc, blend),        FIELD(celspan_group_desc, isolate),
    FIELD(celspan_group_desc, space),        FIELD(celspan_group_desc, grade),
};
static const cs_description_field celspan_matte_desc_fields[] = {
    FIELD(celspan_matte_desc, struct_size), FIELD(celspan_matte_desc, from),
    FIELD(celspan_matte_desc, invert),      FIELD(celspan_matte_desc, grow),
    FIELD(celspan_matte_desc, feather),
};
static const cs_description_field celspan_key_desc_fields[] = {
    FIELD(celspan_key_desc, struct_size), FIELD(celspan_key_desc, by),
    FIELD(celspan_key_desc, colour),      FIELD(celspan_key_desc, tolerance),
    FIELD(celspan_key_desc, softness),    FIELD(celspan_key_desc, spill),
    FIELD(celspan_key_desc, from),        FIELD(celspan_key_desc, to),
};
static const cs_description_field celspan_blur_desc_fields[] = {
    FIELD(celspan_blur_desc, struct_size), FIELD(celspan_blur_desc, radius),
    FIELD(celspan_blur_desc, kernel),      FIELD(celspan_blur_desc, edge),
    FIELD(celspan_blur_desc, along),       FIELD(celspan_blur_desc, angle),
    FIELD(celspan_blur_desc, centre),
};
static const cs_description_field celspan_displace_desc_fields[] = {
    FIELD(celspan_displace_desc, struct_size), FIELD(celspan_displace_desc, by),
    FIELD(celspan_displace_desc, x),           FIELD(celspan_displace_desc, y),
    FIELD(celspan_displace_desc, scale),       FIELD(celspan_displace_desc, space),
};
static const cs_description_field celspan_sharpen_desc_fields[] = {
    FIELD(celspan_sharpen_desc, struct_size),
    FIELD(celspan_sharpen_desc, radius),
    FIELD(celspan_sharpen_desc, amount),
};
static const cs_description_field celspan_shadow_desc_fields[] = {
    FIELD(celspan_shadow_desc, struct_size), FIELD(celspan_shadow_desc, offset),
    FIELD(celspan_shadow_desc, blur),        FIELD(celspan_shadow_desc, colour),
    FIELD(celspan_shadow_desc, opacity),     FIELD(celspan_shadow_desc, is_inside),
    FIELD(celspan_shadow_desc, is_alone),
};
static const cs_description_field celspan_glow_desc_fields[] = {
    FIELD(celspan_glow_desc, struct_size),
    FIELD(celspan_glow_desc, radius),
    FIELD(celspan_glow_desc, colour),
    FIELD(celspan_glow_desc, gain),
};
static const cs_description_field celspan_outline_desc_fields[] = {
    FIELD(celspan_outline_desc, struct_size), FIELD(celspan_outline_desc, width),
    FIELD(celspan_outline_desc, texture),     FIELD(celspan_outline_desc, join),
    FIELD(celspan_outline_desc, blur),        FIELD(celspan_outline_desc, opacity),
    FIELD(celspan_outline_desc, is_alone),
};
static const cs_description_field celspan_warp_desc_fields[] = {
    FIELD(celspan_warp_desc, struct_size), FIELD(celspan_warp_desc, map),
    FIELD(celspan_warp_desc, user),        FIELD(celspan_warp_desc, within),
    FIELD(celspan_warp_desc, pieces),
};
static const cs_description_field celspan_cel_desc_fields[] = {
    FIELD(celspan_cel_desc, struct_size),     FIELD(celspan_cel_desc, objects),
    FIELD(celspan_cel_desc, object_count),    FIELD(celspan_cel_desc, has_front),
    FIELD(celspan_cel_desc, front),           FIELD(celspan_cel_desc, back),
    FIELD(celspan_cel_desc, has_viewport),    FIELD(celspan_cel_desc, viewport),
    FIELD(celspan_cel_desc, defocus_radius),  FIELD(celspan_cel_desc, defocus_kernel),
    FIELD(celspan_cel_desc, opacity),         FIELD(celspan_cel_desc, front_texture),
    FIELD(celspan_cel_desc, back_texture),    FIELD(celspan_cel_desc, blend),
    FIELD(celspan_cel_desc, front_is_colour), FIELD(celspan_cel_desc, back_is_colour),
    FIELD(celspan_cel_desc, grade),           FIELD(celspan_cel_desc, defocus_edge),
};
static const cs_description_field celspan_filter_desc_fields[] = {
    FIELD(celspan_filter_desc, struct_size),   FIELD(celspan_filter_desc, kernel),
    FIELD(celspan_filter_desc, has_radius),    FIELD(celspan_filter_desc, radius),
    FIELD(celspan_filter_desc, rows),          FIELD(celspan_filter_desc, function),
    FIELD(celspan_filter_desc, function_user),
};
static const cs_description_field celspan_rostrum_desc_fields[] = {
    FIELD(celspan_rostrum_desc, struct_size),
    FIELD(celspan_rostrum_desc, cels),
    FIELD(celspan_rostrum_desc, cel_count),
    FIELD(celspan_rostrum_desc, has_front),
    FIELD(celspan_rostrum_desc, front),
    FIELD(celspan_rostrum_desc, back),
    FIELD(celspan_rostrum_desc, brightness),
    FIELD(celspan_rostrum_desc, has_camera_centre),
    FIELD(celspan_rostrum_desc, has_camera_width),
    FIELD(celspan_rostrum_desc, camera_centre),
    FIELD(celspan_rostrum_desc, camera_width),
    FIELD(celspan_rostrum_desc, camera_rotation),
    FIELD(celspan_rostrum_desc, antialias),
    FIELD(celspan_rostrum_desc, filter),
    FIELD(celspan_rostrum_desc, front_texture),
    FIELD(celspan_rostrum_desc, back_texture),
    FIELD(celspan_rostrum_desc, has_size),
    FIELD(celspan_rostrum_desc, width),
    FIELD(celspan_rostrum_desc, height),
    FIELD(celspan_rostrum_desc, front_is_colour),
    FIELD(celspan_rostrum_desc, back_is_colour),
    FIELD(celspan_rostrum_desc, space),
    FIELD(celspan_rostrum_desc, grade),
    FIELD(celspan_rostrum_desc, grain),
};
static const cs_description_field celspan_inspect_desc_fields[] = {
    FIELD(celspan_inspect_desc, struct_size), FIELD(celspan_inspect_desc, is_deep),
    FIELD(celspan_inspect_desc, report),      FIELD(celspan_inspect_desc, progress),
    FIELD(celspan_inspect_desc, user),
};
static const cs_description_field celspan_frame_desc_fields[] = {
    FIELD(celspan_frame_desc, struct_size),    FIELD(celspan_frame_desc, exposures),
    FIELD(celspan_frame_desc, exposure_count), FIELD(celspan_frame_desc, film_width),
    FIELD(celspan_frame_desc, film_height),    FIELD(celspan_frame_desc, width),
    FIELD(celspan_frame_desc, height),         FIELD(celspan_frame_desc, crop_x),
    FIELD(celspan_frame_desc, crop_y),         FIELD(celspan_frame_desc, crop_width),
    FIELD(celspan_frame_desc, crop_height),    FIELD(celspan_frame_desc, has_antialias),
    FIELD(celspan_frame_desc, antialias),      FIELD(celspan_frame_desc, filter),
    FIELD(celspan_frame_desc, workers),        FIELD(celspan_frame_desc, strip_rows),
    FIELD(celspan_frame_desc, progress),       FIELD(celspan_frame_desc, progress_user),
    FIELD(celspan_frame_desc, has_tolerance),  FIELD(celspan_frame_desc, tolerance),
    FIELD(celspan_frame_desc, space),          FIELD(celspan_frame_desc, repeats),
};
static const cs_description_field celspan_sink_fields[] = {
    FIELD(celspan_sink, struct_size), FIELD(celspan_sink, user), FIELD(celspan_sink, begin),
    FIELD(celspan_sink, row),         FIELD(celspan_sink, end),  FIELD(celspan_sink, takes_codes),
};
static const cs_description_field celspan_coding_fields[] = {
    FIELD(celspan_coding, struct_size), FIELD(celspan_coding, depth),
    FIELD(celspan_coding, transfer),    FIELD(celspan_coding, alpha),
    FIELD(celspan_coding, space),       FIELD(celspan_coding, convert),
    FIELD(celspan_coding, user),        FIELD(celspan_coding, colour),
};
static const cs_description_field celspan_file_desc_fields[] = {
    FIELD(celspan_file_desc, struct_size),   FIELD(celspan_file_desc, format),
    FIELD(celspan_file_desc, coding),        FIELD(celspan_file_desc, title),
    FIELD(celspan_file_desc, frames_second), FIELD(celspan_file_desc, frame),
    FIELD(celspan_file_desc, is_opaque),     FIELD(celspan_file_desc, workers),
    FIELD(celspan_file_desc, place_x),       FIELD(celspan_file_desc, place_y),
    FIELD(celspan_file_desc, strip_row),     FIELD(celspan_file_desc, strip_height),
};
static const cs_description_field celspan_text_desc_fields[] = {
    FIELD(celspan_text_desc, struct_size), FIELD(celspan_text_desc, text),
    FIELD(celspan_text_desc, text_size),   FIELD(celspan_text_desc, fonts),
    FIELD(celspan_text_desc, font_count),  FIELD(celspan_text_desc, size),
    FIELD(celspan_text_desc, at),          FIELD(celspan_text_desc, align),
    FIELD(celspan_text_desc, has_width),   FIELD(celspan_text_desc, width),
    FIELD(celspan_text_desc, leading),     FIELD(celspan_text_desc, tracking),
    FIELD(celspan_text_desc, features),    FIELD(celspan_text_desc, feature_count),
    FIELD(celspan_text_desc, variations),  FIELD(celspan_text_desc, variation_count),
    FIELD(celspan_text_desc, language),    FIELD(celspan_text_desc, direction),
    FIELD(celspan_text_desc, texture),     FIELD(celspan_text_desc, face),
    FIELD(celspan_text_desc, valign),
};
static const cs_description_field celspan_svg_desc_fields[] = {
    FIELD(celspan_svg_desc, struct_size), FIELD(celspan_svg_desc, file),
    FIELD(celspan_svg_desc, bytes),       FIELD(celspan_svg_desc, size),
    FIELD(celspan_svg_desc, name),        FIELD(celspan_svg_desc, fonts),
    FIELD(celspan_svg_desc, font_count),  FIELD(celspan_svg_desc, space),
    FIELD(celspan_svg_desc, seconds),
};
static const cs_description_field celspan_trace_desc_fields[] = {
    FIELD(celspan_trace_desc, struct_size), FIELD(celspan_trace_desc, picture),
    FIELD(celspan_trace_desc, colours),     FIELD(celspan_trace_desc, codes),
    FIELD(celspan_trace_desc, smooth),      FIELD(celspan_trace_desc, speckle),
    FIELD(celspan_trace_desc, lines),
};
static const cs_description_field celspan_plane_desc_fields[] = {
    FIELD(celspan_plane_desc, struct_size), FIELD(celspan_plane_desc, width),
    FIELD(celspan_plane_desc, height),      FIELD(celspan_plane_desc, depth),
    FIELD(celspan_plane_desc, space),
};
static const cs_description_field celspan_plane_view_fields[] = {
    FIELD(celspan_plane_view, struct_size), FIELD(celspan_plane_view, width),
    FIELD(celspan_plane_view, height),      FIELD(celspan_plane_view, crop_x),
    FIELD(celspan_plane_view, crop_y),      FIELD(celspan_plane_view, crop_width),
    FIELD(celspan_plane_view, crop_height), FIELD(celspan_plane_view, antialias),
};
static const cs_description_field celspan_light_estimate_desc_fields[] = {
    FIELD(celspan_light_estimate_desc, struct_size), FIELD(celspan_light_estimate_desc, picture),
    FIELD(celspan_light_estimate_desc, clue),        FIELD(celspan_light_estimate_desc, colour),
    FIELD(celspan_light_estimate_desc, patch),       FIELD(celspan_light_estimate_desc, is_uneven),
    FIELD(celspan_light_estimate_desc, blank),
};
static const cs_description_field celspan_tracker_desc_fields[] = {
    FIELD(celspan_tracker_desc, struct_size),
    FIELD(celspan_tracker_desc, model),
    FIELD(celspan_tracker_desc, region),
    FIELD(celspan_tracker_desc, mask),
};
