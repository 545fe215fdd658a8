const char *celspan_version(void);
typedef enum celspan_status { CELSPAN_OK = 0, CELSPAN_NO_MEMORY, CELSPAN_BAD_ARGUMENT,
  CELSPAN_LIMIT, CELSPAN_INPUT, CELSPAN_OUTPUT, CELSPAN_CALLBACK, CELSPAN_CANCELLED,
  CELSPAN_INTERNAL } celspan_status;
const char *celspan_status_name(celspan_status status);
typedef struct celspan_context celspan_context;
typedef void *(*celspan_resize)(void *user, void *block, size_t old_size, size_t new_size);
typedef struct celspan_context_desc { size_t struct_size; celspan_resize resize; void *resize_user;
  size_t picture_bytes; size_t defocus_bytes; } celspan_context_desc;
void celspan_context_desc_default(celspan_context_desc *out, size_t struct_size);
celspan_status celspan_context_create(const celspan_context_desc *desc, celspan_context **out);
void celspan_context_destroy(celspan_context *context);
const char *celspan_context_error(const celspan_context *context);
celspan_status celspan_context_fail(celspan_context *context, celspan_status status, const char
  *format, ...) ;
void celspan_context_set_origin(celspan_context *context, const char *source, int32_t line);
void celspan_context_memory(const celspan_context *context, size_t *bytes, size_t *peak_bytes,
  uint64_t *allocations);
typedef struct celspan_origin { const char *source; int32_t line; } celspan_origin;
typedef struct celspan_point { double x, y; } celspan_point;
typedef struct celspan_box { double x, y, width, height; } celspan_box;
typedef struct celspan_matrix { double m[9]; } celspan_matrix;
celspan_matrix celspan_matrix_identity(void);
celspan_matrix celspan_matrix_translation(double dx, double dy);
celspan_matrix celspan_matrix_scaling(double sx, double sy);
celspan_matrix celspan_matrix_rotation(double radians, celspan_point centre);
celspan_matrix celspan_matrix_skewing(double radians_x, double radians_y);
celspan_matrix celspan_matrix_scaling_about(double sx, double sy, celspan_point centre);
celspan_matrix celspan_matrix_skewing_about(double radians_x, double radians_y, celspan_point
  centre);
celspan_matrix celspan_matrix_then(celspan_matrix first, celspan_matrix second);
bool celspan_matrix_inverse(celspan_matrix matrix, celspan_matrix *out);
bool celspan_matrix_quad(const celspan_point from[4], const celspan_point to[4], celspan_matrix
  *out);
typedef struct celspan_paint { float pigment[3]; float medium[3]; float beta; } celspan_paint;
celspan_paint celspan_paint_rgb(float r, float g, float b, float alpha);
celspan_paint celspan_paint_gel(float r, float g, float b);
celspan_paint celspan_paint_clear(void);
celspan_paint celspan_paint_mix(celspan_paint p, celspan_paint q, float u);
bool celspan_paint_parse(const char *text, celspan_paint *out);
typedef enum celspan_alpha { CELSPAN_ALPHA_DEFAULT = 0, CELSPAN_ALPHA_STRAIGHT,
  CELSPAN_ALPHA_PREMULTIPLIED } celspan_alpha;
typedef enum celspan_space { CELSPAN_SPACE_AROUND = 0, CELSPAN_SPACE_LINEAR, CELSPAN_SPACE_SRGB }
  celspan_space;
typedef struct celspan_light { float r, g, b, a; } celspan_light;
typedef enum celspan_light_place { CELSPAN_LIGHT_ON_FRAME = 0, CELSPAN_LIGHT_ON_CEL }
  celspan_light_place;
typedef struct celspan_light_texture { struct celspan_texture *texture; double gain;
  celspan_light_place on; double matte; } celspan_light_texture;
typedef struct celspan_texture celspan_texture;
typedef struct celspan_stop { double at; celspan_paint paint; } celspan_stop;
typedef enum celspan_sampling { CELSPAN_SAMPLING_AUTO = 0, CELSPAN_SAMPLING_NEAREST,
  CELSPAN_SAMPLING_BILINEAR, CELSPAN_SAMPLING_BICUBIC } celspan_sampling;
typedef enum celspan_wrap { CELSPAN_WRAP_CLEAR = 0, CELSPAN_WRAP_CLAMP, CELSPAN_WRAP_REPEAT }
  celspan_wrap;
typedef enum celspan_picture_use { CELSPAN_PICTURE_PAINT = 0, CELSPAN_PICTURE_GEL }
  celspan_picture_use;
typedef struct celspan_surface celspan_surface;
typedef struct celspan_picture_tiles { int32_t width, height; int32_t size, overlap; char
  ending[8]; } celspan_picture_tiles;
typedef struct celspan_picture_desc { size_t struct_size; const char *file; const char *colour;
  const char *layer; int subimage; celspan_sampling sampling; celspan_picture_use use; celspan_wrap
  wrap; bool has_box; celspan_box box; celspan_surface *surface; bool has_source; celspan_box
  source; bool smooth; const celspan_picture_tiles *tiles; } celspan_picture_desc;
void celspan_picture_desc_default(celspan_picture_desc *out, size_t struct_size);
celspan_status celspan_texture_create_paint(celspan_context *context, const celspan_paint *paint,
  celspan_texture **out);
celspan_status celspan_texture_create_gradient(celspan_context *context, const celspan_point
  points[3], const celspan_paint paints[3], celspan_texture **out);
celspan_status celspan_texture_create_linear(celspan_context *context, celspan_point from,
  celspan_point to, const celspan_stop *stops, size_t stop_count, celspan_texture **out);
celspan_status celspan_texture_create_radial(celspan_context *context, celspan_point centre, double
  radius, const celspan_stop *stops, size_t stop_count, celspan_texture **out);
celspan_status celspan_texture_create_focal( celspan_context *context, celspan_point centre, double
  radius, celspan_point focus, const celspan_stop *stops, size_t stop_count, celspan_texture
  **out);
celspan_status celspan_texture_create_conic(celspan_context *context, celspan_point centre, double
  radians, const celspan_stop *stops, size_t stop_count, celspan_texture **out);
typedef enum celspan_gradient_fit { CELSPAN_GRADIENT_SIDE = 0, CELSPAN_GRADIENT_ANGLE,
  CELSPAN_GRADIENT_ELLIPSE } celspan_gradient_fit;
typedef struct celspan_fitted_desc { size_t struct_size; celspan_gradient_fit fit; int to_x, to_y;
  double degrees; const celspan_stop *stops; size_t stop_count; } celspan_fitted_desc;
void celspan_fitted_desc_default(celspan_fitted_desc *out, size_t struct_size);
celspan_status celspan_texture_create_fitted( celspan_context *context, const celspan_fitted_desc
  *desc, celspan_texture **out);
typedef enum celspan_noise_kind { CELSPAN_NOISE_PERLIN = 0, CELSPAN_NOISE_VALUE,
  CELSPAN_NOISE_FRACTAL, CELSPAN_NOISE_TURBULENCE, CELSPAN_NOISE_CELLS, CELSPAN_NOISE_WHITE }
  celspan_noise_kind;
typedef struct celspan_noise_desc { size_t struct_size; celspan_noise_kind kind; int octaves;
  double size; double gain; double at; const celspan_stop *stops; size_t stop_count; int seed; bool
  fades; } celspan_noise_desc;
void celspan_noise_desc_default(celspan_noise_desc *out, size_t struct_size);
celspan_status celspan_texture_create_noise( celspan_context *context, const celspan_noise_desc
  *desc, celspan_texture **out);
typedef enum celspan_spread { CELSPAN_SPREAD_HOLD = 0, CELSPAN_SPREAD_REPEAT,
  CELSPAN_SPREAD_REFLECT } celspan_spread;
celspan_status celspan_texture_with_spread(celspan_context *context, celspan_texture *texture,
  celspan_spread spread, celspan_texture **out);
celspan_status celspan_texture_with_matrix(celspan_context *context, celspan_texture *texture,
  const celspan_matrix *matrix, celspan_texture **out);
celspan_status celspan_texture_create_picture( celspan_context *context, const celspan_picture_desc
  *desc, celspan_texture **out);
celspan_status celspan_texture_with_medium(celspan_context *context, celspan_texture *texture,
  const celspan_picture_desc *medium, celspan_texture **out);
typedef struct celspan_pattern_desc { size_t struct_size; struct celspan_object *art; celspan_box
  box; bool has_matrix; celspan_matrix matrix; } celspan_pattern_desc;
void celspan_pattern_desc_default(celspan_pattern_desc *out, size_t struct_size);
celspan_status celspan_texture_create_pattern( celspan_context *context, const celspan_pattern_desc
  *desc, celspan_texture **out);
celspan_texture *celspan_texture_ref(celspan_texture *texture);
void celspan_texture_unref(celspan_texture *texture);
celspan_status celspan_texture_named(celspan_context *context, celspan_texture *texture, const char
  *name, celspan_texture **out);
const char *celspan_texture_name(const celspan_texture *texture);
celspan_origin celspan_texture_origin(const celspan_texture *texture);
typedef struct celspan_picture_info { size_t struct_size; int32_t width, height; int channels; bool
  has_alpha; bool is_float; char format[16]; char colour[16]; } celspan_picture_info;
celspan_status celspan_picture_inspect(celspan_context *context, const celspan_picture_desc *desc,
  celspan_picture_info *out);
typedef enum celspan_surface_format { CELSPAN_SURFACE_RGBA8 = 0, CELSPAN_SURFACE_RGB8,
  CELSPAN_SURFACE_GREY8, CELSPAN_SURFACE_RGBA16, CELSPAN_SURFACE_RGBAF } celspan_surface_format;
typedef struct celspan_rectangle { int32_t x, y, width, height; } celspan_rectangle;
typedef celspan_status (*celspan_surface_fill)(void *user, celspan_context *context, const
  celspan_rectangle *rectangle, void *destination, size_t stride, int32_t *rows);
typedef struct celspan_surface_desc { size_t struct_size; int32_t width, height;
  celspan_surface_format format; celspan_alpha alpha; const void *pixels; size_t stride;
  celspan_surface_fill fill; void *user; void (*release)(void *user); bool any_thread; bool
  has_key; uint64_t key[2]; } celspan_surface_desc;
void celspan_surface_desc_default(celspan_surface_desc *out, size_t struct_size);
celspan_status celspan_surface_create(celspan_context *context, const celspan_surface_desc *desc,
  celspan_surface **out);
celspan_surface *celspan_surface_ref(celspan_surface *surface);
void celspan_surface_unref(celspan_surface *surface);
size_t celspan_surface_pixel_size(celspan_surface_format format);
typedef struct celspan_object celspan_object;
typedef enum celspan_rule { CELSPAN_RULE_NONZERO = 0, CELSPAN_RULE_EVENODD } celspan_rule;
typedef struct celspan_rect_desc { size_t struct_size; double x, y, width, height; double radius;
  celspan_texture *texture; } celspan_rect_desc;
void celspan_rect_desc_default(celspan_rect_desc *out, size_t struct_size);
typedef struct celspan_triangle_desc { size_t struct_size; celspan_point points[3]; celspan_texture
  *texture; } celspan_triangle_desc;
void celspan_triangle_desc_default(celspan_triangle_desc *out, size_t struct_size);
typedef struct celspan_ellipse_desc { size_t struct_size; celspan_point centre; double radius_x,
  radius_y; celspan_texture *texture; } celspan_ellipse_desc;
void celspan_ellipse_desc_default(celspan_ellipse_desc *out, size_t struct_size);
typedef struct celspan_polygon_desc { size_t struct_size; const celspan_point *points; size_t
  point_count; celspan_rule rule; celspan_texture *texture; } celspan_polygon_desc;
void celspan_polygon_desc_default(celspan_polygon_desc *out, size_t struct_size);
typedef enum celspan_nurbs_closure { CELSPAN_NURBS_PERIODIC = 0, CELSPAN_NURBS_CLAMPED }
  celspan_nurbs_closure;
typedef struct celspan_nurbs_desc { size_t struct_size; const celspan_point *points; const double
  *weights; size_t point_count; int degree; const double *knots; size_t knot_count;
  celspan_nurbs_closure closure; celspan_rule rule; celspan_texture *texture; } celspan_nurbs_desc;
void celspan_nurbs_desc_default(celspan_nurbs_desc *out, size_t struct_size);
typedef struct celspan_contour { const celspan_point *points; size_t point_count; bool closed; }
  celspan_contour;
typedef struct celspan_contours celspan_contours;
celspan_status celspan_contours_create(celspan_context *context, celspan_contours **out);
void celspan_contours_move_to(celspan_contours *contours, double x, double y);
void celspan_contours_line_to(celspan_contours *contours, double x, double y);
void celspan_contours_cubic_to(celspan_contours *contours, double x1, double y1, double x2, double
  y2, double x, double y);
void celspan_contours_close(celspan_contours *contours);
celspan_status celspan_contours_get(celspan_contours *contours, const celspan_contour **out, size_t
  *count);
void celspan_contours_destroy(celspan_contours *contours);
typedef struct celspan_path_desc { size_t struct_size; const char *data; celspan_rule rule;
  celspan_texture *texture; const celspan_contour *contours; size_t contour_count; }
  celspan_path_desc;
void celspan_path_desc_default(celspan_path_desc *out, size_t struct_size);
typedef enum celspan_stroke_cap { CELSPAN_STROKE_CAP_BUTT = 0, CELSPAN_STROKE_CAP_ROUND,
  CELSPAN_STROKE_CAP_SQUARE } celspan_stroke_cap;
typedef enum celspan_stroke_join { CELSPAN_STROKE_JOIN_MITER = 0, CELSPAN_STROKE_JOIN_ROUND,
  CELSPAN_STROKE_JOIN_BEVEL } celspan_stroke_join;
typedef enum celspan_stroke_profile { CELSPAN_STROKE_PROFILE_STRAIGHT = 0,
  CELSPAN_STROKE_PROFILE_ROUND } celspan_stroke_profile;
typedef struct celspan_stroke_desc { size_t struct_size; const celspan_point *points; const double
  *widths; size_t point_count; int degree; bool closed; const char *data; celspan_object *outline;
  double width; celspan_stroke_cap cap; celspan_stroke_join join; double miter; const double
  *dashes; size_t dash_count; double dash_offset; double taper[2]; double from, to; celspan_texture
  *texture; celspan_stroke_profile profile; const celspan_contour *contours; size_t contour_count;
  } celspan_stroke_desc;
void celspan_stroke_desc_default(celspan_stroke_desc *out, size_t struct_size);
typedef enum celspan_fit { CELSPAN_FIT_FILL = 0, CELSPAN_FIT_CONTAIN, CELSPAN_FIT_COVER }
  celspan_fit;
typedef struct celspan_image_desc { size_t struct_size; const celspan_picture_desc *picture; double
  x, y, width, height; celspan_fit fit; } celspan_image_desc;
void celspan_image_desc_default(celspan_image_desc *out, size_t struct_size);
typedef struct celspan_scanline_row { double x0, x1; double pixel; } celspan_scanline_row;
typedef struct celspan_scanline_output celspan_scanline_output;
celspan_status celspan_scanline_emit(celspan_scanline_output *output, double x0, double x1, const
  celspan_paint *paints, size_t paint_count);
typedef celspan_status (*celspan_scanline_spans)(void *user, celspan_context *context, double y,
  const celspan_scanline_row *row, celspan_scanline_output *output);
typedef struct celspan_scanline_desc { size_t struct_size; celspan_box bounds;
  celspan_scanline_spans spans; void *user; void (*release)(void *user); bool any_thread; }
  celspan_scanline_desc;
void celspan_scanline_desc_default(celspan_scanline_desc *out, size_t struct_size);
celspan_status celspan_object_create_rect(celspan_context *context, const celspan_rect_desc *desc,
  celspan_object **out);
celspan_status celspan_object_create_rounded(celspan_context *context, const celspan_rect_desc
  *desc, const double radii[4], celspan_object **out);
celspan_status celspan_object_create_triangle( celspan_context *context, const
  celspan_triangle_desc *desc, celspan_object **out);
celspan_status celspan_object_create_ellipse( celspan_context *context, const celspan_ellipse_desc
  *desc, celspan_object **out);
celspan_status celspan_object_create_polygon( celspan_context *context, const celspan_polygon_desc
  *desc, celspan_object **out);
celspan_status celspan_object_create_nurbs( celspan_context *context, const celspan_nurbs_desc
  *desc, celspan_object **out);
celspan_status celspan_object_create_path(celspan_context *context, const celspan_path_desc *desc,
  celspan_object **out);
celspan_status celspan_object_create_stroke( celspan_context *context, const celspan_stroke_desc
  *desc, celspan_object **out);
celspan_status celspan_object_stroke(celspan_context *context, celspan_object *object, const
  celspan_stroke_desc *desc, celspan_object **out);
celspan_status celspan_object_create_image( celspan_context *context, const celspan_image_desc
  *desc, celspan_object **out);
celspan_status celspan_object_create_scanline( celspan_context *context, const
  celspan_scanline_desc *desc, celspan_object **out);
typedef enum celspan_operator { CELSPAN_OPERATOR_UNION = 0, CELSPAN_OPERATOR_INTERSECTION,
  CELSPAN_OPERATOR_DIFFERENCE, CELSPAN_OPERATOR_XOR, CELSPAN_OPERATOR_CLIP } celspan_operator;
celspan_status celspan_object_create_boolean( celspan_context *context, celspan_operator op,
  celspan_object *const *operands, size_t operand_count, celspan_object **out);
celspan_status celspan_object_extend_boolean( celspan_context *context, celspan_object *boolean,
  celspan_object *const *operands, size_t operand_count, celspan_object **out);
typedef enum celspan_blend { CELSPAN_BLEND_NORMAL = 0, CELSPAN_BLEND_MULTIPLY,
  CELSPAN_BLEND_SCREEN, CELSPAN_BLEND_OVERLAY, CELSPAN_BLEND_DARKEN, CELSPAN_BLEND_LIGHTEN,
  CELSPAN_BLEND_COLOR_DODGE, CELSPAN_BLEND_COLOR_BURN, CELSPAN_BLEND_HARD_LIGHT,
  CELSPAN_BLEND_SOFT_LIGHT, CELSPAN_BLEND_DIFFERENCE, CELSPAN_BLEND_EXCLUSION, CELSPAN_BLEND_HUE,
  CELSPAN_BLEND_SATURATION, CELSPAN_BLEND_COLOR, CELSPAN_BLEND_LUMINOSITY, CELSPAN_BLEND_ADD,
  CELSPAN_BLEND_LINEAR_DODGE, CELSPAN_BLEND_SOFT_LIGHT_PHOTOSHOP, CELSPAN_BLEND_LINEAR_BURN,
  CELSPAN_BLEND_VIVID_LIGHT, CELSPAN_BLEND_LINEAR_LIGHT, CELSPAN_BLEND_PIN_LIGHT,
  CELSPAN_BLEND_HARD_MIX, CELSPAN_BLEND_SUBTRACT, CELSPAN_BLEND_DIVIDE, CELSPAN_BLEND_DARKER_COLOR,
  CELSPAN_BLEND_LIGHTER_COLOR } celspan_blend;
typedef struct celspan_grade celspan_grade;
typedef struct celspan_grade_desc { size_t struct_size; double exposure; double contrast; bool
  has_pivot; double pivot; double saturation, hue_radians; double temperature, tint; double gamma;
  bool has_matrix; double matrix[3][4]; const celspan_point *curve[3]; size_t curve_count[3]; const
  char *lut; celspan_space lut_space; double slope[3], offset[3], power[3]; int steps; }
  celspan_grade_desc;
void celspan_grade_desc_default(celspan_grade_desc *out, size_t struct_size);
celspan_status celspan_grade_create(celspan_context *context, const celspan_grade_desc *desc,
  celspan_grade **out);
celspan_grade *celspan_grade_ref(celspan_grade *grade);
void celspan_grade_unref(celspan_grade *grade);
typedef enum celspan_isolation { CELSPAN_ISOLATION_AUTO = 0, CELSPAN_ISOLATION_ON,
  CELSPAN_ISOLATION_OFF } celspan_isolation;
typedef struct celspan_group_desc { size_t struct_size; celspan_object *const *objects; size_t
  object_count; double opacity; celspan_blend blend; celspan_isolation isolate; celspan_space
  space; celspan_grade *grade; } celspan_group_desc;
void celspan_group_desc_default(celspan_group_desc *out, size_t struct_size);
celspan_status celspan_object_create_group( celspan_context *context, const celspan_group_desc
  *desc, celspan_object **out);
celspan_status celspan_object_blend(celspan_context *context, celspan_object *object, celspan_blend
  mode, celspan_object **out);
celspan_blend celspan_object_mode(const celspan_object *object);
typedef enum celspan_matte_from { CELSPAN_MATTE_ALPHA = 0, CELSPAN_MATTE_LUMA,
  CELSPAN_MATTE_DISSOLVE } celspan_matte_from;
celspan_status celspan_object_create_matte(celspan_context *context, celspan_object *art,
  celspan_object *by, celspan_matte_from from, bool invert, celspan_object **out);
typedef struct celspan_matte_desc { size_t struct_size; celspan_matte_from from; bool invert;
  double grow; double feather; } celspan_matte_desc;
void celspan_matte_desc_default(celspan_matte_desc *out, size_t struct_size);
celspan_status celspan_object_matte(celspan_context *context, celspan_object *art, celspan_object
  *by, const celspan_matte_desc *desc, celspan_object **out);
typedef enum celspan_key_by { CELSPAN_KEY_CHROMA = 0, CELSPAN_KEY_LUMA } celspan_key_by;
typedef struct celspan_key_desc { size_t struct_size; celspan_key_by by; celspan_texture *colour;
  double tolerance, softness; double spill; double from, to; } celspan_key_desc;
void celspan_key_desc_default(celspan_key_desc *out, size_t struct_size);
celspan_status celspan_object_key(celspan_context *context, celspan_object *art, const
  celspan_key_desc *desc, celspan_object **out);
typedef enum celspan_defocus_kernel { CELSPAN_DEFOCUS_GAUSSIAN = 0, CELSPAN_DEFOCUS_BOX,
  CELSPAN_DEFOCUS_DISC, CELSPAN_DEFOCUS_PIXEL } celspan_defocus_kernel;
typedef enum celspan_blur_edge { CELSPAN_BLUR_CLEAR = 0, CELSPAN_BLUR_EXTEND } celspan_blur_edge;
typedef enum celspan_blur_along { CELSPAN_BLUR_AROUND = 0, CELSPAN_BLUR_LINE, CELSPAN_BLUR_ZOOM,
  CELSPAN_BLUR_SPIN } celspan_blur_along;
typedef struct celspan_blur_desc { size_t struct_size; double radius; celspan_defocus_kernel
  kernel; celspan_blur_edge edge; celspan_blur_along along; double degrees; celspan_point centre; }
  celspan_blur_desc;
void celspan_blur_desc_default(celspan_blur_desc *out, size_t struct_size);
celspan_status celspan_object_blur(celspan_context *context, celspan_object *object, const
  celspan_blur_desc *desc, celspan_object **out);
typedef enum celspan_channel { CELSPAN_CHANNEL_RED = 0, CELSPAN_CHANNEL_GREEN,
  CELSPAN_CHANNEL_BLUE, CELSPAN_CHANNEL_ALPHA } celspan_channel;
typedef struct celspan_displace_desc { size_t struct_size; celspan_object *by; celspan_channel x,
  y; double scale; celspan_space space; } celspan_displace_desc;
void celspan_displace_desc_default(celspan_displace_desc *out, size_t struct_size);
celspan_status celspan_object_displace(celspan_context *context, celspan_object *object, const
  celspan_displace_desc *desc, celspan_object **out);
typedef struct celspan_sharpen_desc { size_t struct_size; double radius; double amount; }
  celspan_sharpen_desc;
void celspan_sharpen_desc_default(celspan_sharpen_desc *out, size_t struct_size);
celspan_status celspan_object_sharpen(celspan_context *context, celspan_object *object, const
  celspan_sharpen_desc *desc, celspan_object **out);
typedef struct celspan_shadow_desc { size_t struct_size; celspan_point offset; double blur;
  celspan_texture *colour; double opacity; bool is_inside; bool is_alone; } celspan_shadow_desc;
void celspan_shadow_desc_default(celspan_shadow_desc *out, size_t struct_size);
celspan_status celspan_object_shadow(celspan_context *context, celspan_object *object, const
  celspan_shadow_desc *desc, celspan_object **out);
typedef struct celspan_glow_desc { size_t struct_size; double radius; celspan_texture *colour;
  double gain; } celspan_glow_desc;
void celspan_glow_desc_default(celspan_glow_desc *out, size_t struct_size);
celspan_status celspan_object_glow(celspan_context *context, celspan_object *object, const
  celspan_glow_desc *desc, celspan_object **out);
typedef struct celspan_outline_desc { size_t struct_size; double width; celspan_texture *texture;
  celspan_stroke_join join; double blur; double opacity; bool is_alone; } celspan_outline_desc;
void celspan_outline_desc_default(celspan_outline_desc *out, size_t struct_size);
celspan_status celspan_object_outline(celspan_context *context, celspan_object *object, const
  celspan_outline_desc *desc, celspan_object **out);
typedef celspan_status (*celspan_warp_map)(void *user, celspan_context *context, celspan_point
  from, celspan_point *to);
typedef struct celspan_warp_desc { size_t struct_size; celspan_warp_map map; void *user; double
  within; size_t pieces; } celspan_warp_desc;
void celspan_warp_desc_default(celspan_warp_desc *out, size_t struct_size);
celspan_status celspan_object_warp(celspan_context *context, celspan_object *object, const
  celspan_warp_desc *desc, celspan_object **out);
celspan_status celspan_object_transform(celspan_context *context, celspan_object *object, const
  celspan_matrix *matrix, celspan_object **out);
celspan_status celspan_object_fade(celspan_context *context, celspan_object *object, double k,
  celspan_object **out);
celspan_status celspan_object_named(celspan_context *context, celspan_object *object, const char
  *name, celspan_object **out);
const char *celspan_object_name(const celspan_object *object);
celspan_origin celspan_object_origin(const celspan_object *object);
celspan_object *celspan_object_ref(celspan_object *object);
void celspan_object_unref(celspan_object *object);
bool celspan_object_bounds(const celspan_object *object, celspan_box *out);
bool celspan_object_contains(const celspan_object *object, celspan_point point);
bool celspan_object_hash(const celspan_object *object, uint64_t drawing[2], uint64_t placement[2]);
typedef struct celspan_cel celspan_cel;
typedef struct celspan_rostrum celspan_rostrum;
typedef struct celspan_cel_desc { size_t struct_size; celspan_object *const *objects; size_t
  object_count; bool has_front; celspan_light front; celspan_light back; bool has_viewport;
  celspan_box viewport; double defocus_radius; celspan_defocus_kernel defocus_kernel; double
  opacity; celspan_light_texture front_texture, back_texture; celspan_blend blend; bool
  front_is_colour, back_is_colour; celspan_grade *grade; celspan_blur_edge defocus_edge; }
  celspan_cel_desc;
void celspan_cel_desc_default(celspan_cel_desc *out, size_t struct_size);
celspan_status celspan_cel_create(celspan_context *context, const celspan_cel_desc *desc,
  celspan_cel **out);
celspan_status celspan_cel_transform(celspan_context *context, celspan_cel *cel, const
  celspan_matrix *matrix, celspan_cel **out);
celspan_blend celspan_cel_mode(const celspan_cel *cel);
celspan_status celspan_cel_fade(celspan_context *context, celspan_cel *cel, double k, celspan_cel
  **out);
celspan_status celspan_cel_named(celspan_context *context, celspan_cel *cel, const char *name,
  celspan_cel **out);
const char *celspan_cel_name(const celspan_cel *cel);
celspan_origin celspan_cel_origin(const celspan_cel *cel);
celspan_cel *celspan_cel_ref(celspan_cel *cel);
void celspan_cel_unref(celspan_cel *cel);
bool celspan_cel_bounds(const celspan_cel *cel, celspan_box *out);
bool celspan_cel_contains(const celspan_cel *cel, celspan_point point);
bool celspan_cel_hash(const celspan_cel *cel, uint64_t drawing[2], uint64_t placement[2]);
typedef enum celspan_antialias_mode { CELSPAN_ANTIALIAS_AREA = 0, CELSPAN_ANTIALIAS_NONE,
  CELSPAN_ANTIALIAS_FILTER } celspan_antialias_mode;
typedef enum celspan_kernel { CELSPAN_KERNEL_BOX = 0, CELSPAN_KERNEL_GAUSSIAN,
  CELSPAN_KERNEL_MITCHELL, CELSPAN_KERNEL_LANCZOS, CELSPAN_KERNEL_FUNCTION } celspan_kernel;
typedef celspan_status (*celspan_kernel_function)(void *user, celspan_context *context, double x,
  double *out);
typedef struct celspan_filter_desc { size_t struct_size; celspan_kernel kernel; bool has_radius;
  double radius; int rows; celspan_kernel_function function; void *function_user; }
  celspan_filter_desc;
void celspan_filter_desc_default(celspan_filter_desc *out, size_t struct_size);
typedef struct celspan_rostrum_desc { size_t struct_size; celspan_cel *const *cels; size_t
  cel_count; bool has_front; celspan_light front; celspan_light back; double brightness; bool
  has_camera_centre, has_camera_width; celspan_point camera_centre; double camera_width; double
  camera_radians; celspan_antialias_mode antialias; const celspan_filter_desc *filter;
  celspan_light_texture front_texture, back_texture; bool has_size; double width, height; bool
  front_is_colour, back_is_colour; celspan_space space; celspan_grade *grade; celspan_texture
  *grain; } celspan_rostrum_desc;
void celspan_rostrum_desc_default(celspan_rostrum_desc *out, size_t struct_size);
celspan_status celspan_rostrum_create(celspan_context *context, const celspan_rostrum_desc *desc,
  celspan_rostrum **out);
celspan_status celspan_rostrum_named(celspan_context *context, celspan_rostrum *rostrum, const char
  *name, celspan_rostrum **out);
const char *celspan_rostrum_name(const celspan_rostrum *rostrum);
celspan_origin celspan_rostrum_origin(const celspan_rostrum *rostrum);
celspan_rostrum *celspan_rostrum_ref(celspan_rostrum *rostrum);
void celspan_rostrum_unref(celspan_rostrum *rostrum);
celspan_status celspan_object_create_rostrum(celspan_context *context, celspan_rostrum *rostrum,
  celspan_object **out);
void celspan_rostrum_hash(const celspan_rostrum *rostrum, uint64_t out[2]);
typedef struct celspan_rostrum_counts { size_t cels, primitives, pictures; }
  celspan_rostrum_counts;
void celspan_rostrum_count(const celspan_rostrum *rostrum, celspan_rostrum_counts *out);
celspan_status celspan_rostrum_check(celspan_context *context, const celspan_rostrum *rostrum);
typedef struct celspan_fault { celspan_status status; const char *message; size_t cel, primitive;
  const char *cel_name, *name; celspan_origin cel_origin, origin; } celspan_fault;
typedef struct celspan_inspect_desc { size_t struct_size; bool is_deep; bool (*report)(void *user,
  const celspan_fault *fault); bool (*progress)(void *user, int32_t rows_done, int32_t rows_total);
  void *user; } celspan_inspect_desc;
void celspan_inspect_desc_default(celspan_inspect_desc *out, size_t struct_size);
celspan_status celspan_rostrum_inspect( celspan_context *context, const celspan_rostrum *rostrum,
  const celspan_inspect_desc *desc);
typedef struct celspan_exposure { celspan_rostrum *rostrum; double weight; } celspan_exposure;
typedef enum celspan_span_kind { CELSPAN_SPAN_SINGLE = 0, CELSPAN_SPAN_GRADIENT, CELSPAN_SPAN_ARRAY
  } celspan_span_kind;
typedef struct celspan_span { int32_t x0, x1; celspan_span_kind kind; int32_t origin; float
  colour[4]; float slope[4]; const float *array; const unsigned char *codes; } celspan_span;
typedef struct celspan_frame_desc { size_t struct_size; const celspan_exposure *exposures; size_t
  exposure_count; double film_width, film_height; int32_t width, height; int32_t crop_x, crop_y;
  int32_t crop_width, crop_height; bool has_antialias; celspan_antialias_mode antialias; const
  celspan_filter_desc *filter; int workers; int strip_rows; bool (*progress)(void *user, int32_t
  rows_done, int32_t rows_total); void *progress_user; bool has_tolerance; double tolerance;
  celspan_space space; bool repeats; } celspan_frame_desc;
void celspan_frame_desc_default(celspan_frame_desc *out, size_t struct_size);
celspan_status celspan_probe(celspan_context *context, const celspan_frame_desc *desc,
  celspan_point point, double rgba[4]);
typedef struct celspan_statistics { size_t struct_size; uint64_t rows, spans, single, gradient,
  array; uint64_t pixels_in_arrays; uint64_t colour_evaluations; uint64_t allocations; uint64_t
  peak_bytes; uint64_t maps; uint64_t maps_made; uint64_t swept; uint64_t rows_held; }
  celspan_statistics;
typedef struct celspan_sink { size_t struct_size; void *user; celspan_status (*begin)(void *user,
  celspan_context *context, int32_t width, int32_t height); celspan_status (*row)(void *user,
  celspan_context *context, int32_t y, const celspan_span *spans, size_t span_count);
  celspan_status (*end)(void *user, celspan_context *context, celspan_status outcome); bool
  takes_codes; } celspan_sink;
void celspan_sink_default(celspan_sink *out, size_t struct_size);
celspan_status celspan_frame_render(celspan_context *context, const celspan_frame_desc *desc, const
  celspan_sink *sink, celspan_statistics *statistics);
typedef struct celspan_rows celspan_rows;
celspan_status celspan_rows_create(celspan_context *context, const celspan_frame_desc *desc,
  celspan_rows **out);
celspan_status celspan_rows_get(celspan_rows *rows, int32_t y, const celspan_span **spans, size_t
  *span_count);
void celspan_rows_destroy(celspan_rows *rows);
typedef enum celspan_depth { CELSPAN_DEPTH_DEFAULT = 0, CELSPAN_DEPTH_8, CELSPAN_DEPTH_16,
  CELSPAN_DEPTH_HALF, CELSPAN_DEPTH_FLOAT, CELSPAN_DEPTH_8_DITHER } celspan_depth;
typedef enum celspan_transfer { CELSPAN_TRANSFER_DEFAULT = 0, CELSPAN_TRANSFER_LINEAR,
  CELSPAN_TRANSFER_SRGB, CELSPAN_TRANSFER_REC709, CELSPAN_TRANSFER_CINEON } celspan_transfer;
typedef struct celspan_coding { size_t struct_size; celspan_depth depth; celspan_transfer transfer;
  celspan_alpha alpha; celspan_space space; void (*convert)(void *user, float *rgba, size_t count);
  void *user; const char *colour; } celspan_coding;
void celspan_coding_default(celspan_coding *out, size_t struct_size);
size_t celspan_coding_pixel_size(const celspan_coding *coding);
void celspan_spans_code(const celspan_coding *coding, const celspan_span *spans, size_t span_count,
  void *pixels);
void celspan_spans_code_at(const celspan_coding *coding, int32_t x, int32_t y, const celspan_span
  *spans, size_t span_count, void *pixels);
celspan_status celspan_frame_pixels(celspan_context *context, const celspan_frame_desc *desc, const
  celspan_coding *coding, void *pixels, size_t stride, celspan_statistics *statistics);
typedef struct celspan_file_desc { size_t struct_size; const char *format; const celspan_coding
  *coding; const char *title; double frames_second; int32_t frame; bool is_opaque; int workers;
  int32_t place_x, place_y; int32_t strip_row, strip_height; } celspan_file_desc;
void celspan_file_desc_default(celspan_file_desc *out, size_t struct_size);
bool celspan_frame_is_opaque(const celspan_frame_desc *desc);
celspan_status celspan_frame_write(celspan_context *context, const celspan_frame_desc *desc, const
  char *path, const celspan_file_desc *file, celspan_statistics *statistics);
celspan_status celspan_file_sink_create(celspan_context *context, const char *path, const
  celspan_file_desc *file, celspan_sink *out);
celspan_status celspan_rostrum_write(celspan_context *context, celspan_rostrum *rostrum, int32_t
  width, int32_t height, const char *path);
celspan_status celspan_rostrum_pixels(celspan_context *context, celspan_rostrum *rostrum, int32_t
  width, int32_t height, unsigned char *pixels);
celspan_status celspan_frame_digest(celspan_context *context, const celspan_frame_desc *desc, const
  celspan_coding *coding, uint64_t digest[2]);
celspan_status celspan_object_trim(celspan_context *context, celspan_object *object, double from,
  double to, double offset, bool together, celspan_object **out);
celspan_status celspan_object_round_corners(celspan_context *context, celspan_object *object,
  double radius, celspan_object **out);
celspan_status celspan_object_zigzag(celspan_context *context, celspan_object *object, double size,
  size_t ridges, bool is_smooth, celspan_object **out);
celspan_status celspan_object_pucker(celspan_context *context, celspan_object *object, double
  amount, celspan_object **out);
celspan_status celspan_object_twist(celspan_context *context, celspan_object *object, double
  radians, const celspan_point *centre, celspan_object **out);
celspan_status celspan_object_offset(celspan_context *context, celspan_object *object, double
  distance, celspan_stroke_join join, double limit, celspan_object **out);
typedef struct celspan_feature { const char *tag; uint32_t value; } celspan_feature;
typedef struct celspan_variation { const char *tag; double value; } celspan_variation;
typedef enum celspan_align { CELSPAN_ALIGN_LEFT = 0, CELSPAN_ALIGN_CENTRE, CELSPAN_ALIGN_RIGHT }
  celspan_align;
typedef enum celspan_valign { CELSPAN_VALIGN_BASELINE = 0, CELSPAN_VALIGN_TOP, CELSPAN_VALIGN_CAP,
  CELSPAN_VALIGN_MIDDLE, CELSPAN_VALIGN_BOTTOM } celspan_valign;
typedef enum celspan_direction { CELSPAN_DIRECTION_AUTO = 0, CELSPAN_DIRECTION_LTR,
  CELSPAN_DIRECTION_RTL } celspan_direction;
typedef struct celspan_text_desc { size_t struct_size; const char *text; size_t text_size; const
  char *const *fonts; size_t font_count; double size; celspan_point at; celspan_align align; bool
  has_width; double width; double leading; double tracking; const celspan_feature *features; size_t
  feature_count; const celspan_variation *variations; size_t variation_count; const char *language;
  celspan_direction direction; celspan_texture *texture; uint32_t face; celspan_valign valign; }
  celspan_text_desc;
void celspan_text_desc_default(celspan_text_desc *out, size_t struct_size);
celspan_status celspan_object_create_text(celspan_context *context, const celspan_text_desc *desc,
  celspan_object **out);
typedef struct celspan_text_metrics { size_t struct_size; double ascent, descent; double
  cap_height, x_height; double width; double height; int32_t lines; } celspan_text_metrics;
celspan_status celspan_text_measure(celspan_context *context, const celspan_text_desc *desc,
  celspan_text_metrics *out);
typedef struct celspan_glyph { celspan_object *object; double x, y; double advance; const char
  *text; size_t text_size; int32_t line; } celspan_glyph;
typedef struct celspan_glyphs celspan_glyphs;
celspan_status celspan_glyphs_create(celspan_context *context, const celspan_text_desc *desc,
  celspan_glyphs **out);
size_t celspan_glyphs_count(const celspan_glyphs *glyphs);
const celspan_glyph *celspan_glyphs_get(const celspan_glyphs *glyphs, size_t index);
void celspan_glyphs_destroy(celspan_glyphs *glyphs);
typedef struct celspan_svg celspan_svg;
typedef struct celspan_svg_font { const char *family; const char *file; } celspan_svg_font;
typedef struct celspan_svg_desc { size_t struct_size; const char *file; const void *bytes; size_t
  size; const char *name; const celspan_svg_font *fonts; size_t font_count; celspan_space space; }
  celspan_svg_desc;
void celspan_svg_desc_default(celspan_svg_desc *out, size_t struct_size);
celspan_status celspan_svg_read(celspan_context *context, const celspan_svg_desc *desc, celspan_svg
  **out);
celspan_svg *celspan_svg_ref(celspan_svg *svg);
void celspan_svg_unref(celspan_svg *svg);
celspan_object *celspan_svg_object(const celspan_svg *svg);
celspan_point celspan_svg_size(const celspan_svg *svg);
size_t celspan_svg_part_count(const celspan_svg *svg);
celspan_object *celspan_svg_part(const celspan_svg *svg, size_t index, const char **name);
typedef struct celspan_svg_element { const char *name; const char *tag; const char *id, *label,
  *classes; const char *fill; int32_t line; int32_t depth; celspan_object *object; }
  celspan_svg_element;
typedef celspan_status (*celspan_svg_visit)(void *user, const celspan_svg_element *element);
celspan_status celspan_svg_elements(celspan_context *context, const celspan_svg *svg,
  celspan_svg_visit visit, void *user);
size_t celspan_svg_skipped_count(const celspan_svg *svg);
const char *celspan_svg_skipped(const celspan_svg *svg, size_t index, int32_t *line);
typedef celspan_status (*celspan_svg_change)(void *user, celspan_context *context, celspan_object
  *part, celspan_object **out);
typedef struct celspan_svg_changed { const char *name; celspan_svg_change change; void *user; }
  celspan_svg_changed;
celspan_status celspan_svg_with(celspan_context *context, const celspan_svg *svg, const
  celspan_svg_changed *changes, size_t change_count, celspan_svg **out);
typedef struct celspan_painting celspan_painting;
typedef struct celspan_painting_layer { size_t struct_size; const char *name; const char *blend;
  size_t parent; bool is_group, is_visible; double opacity; int32_t x, y, width, height;
  celspan_surface *surface; const char *colour; } celspan_painting_layer;
typedef struct celspan_painting_key { size_t struct_size; size_t layer; int32_t frame; int32_t
  colour; bool is_opacity; size_t drawing; double opacity; const char *between; double in[2],
  out[2]; } celspan_painting_key;
celspan_status celspan_painting_read(celspan_context *context, const char *file, celspan_painting
  **out);
celspan_painting *celspan_painting_ref(celspan_painting *painting);
void celspan_painting_unref(celspan_painting *painting);
void celspan_painting_size(const celspan_painting *painting, int32_t *width, int32_t *height);
size_t celspan_painting_layer_count(const celspan_painting *painting);
bool celspan_painting_layer_at(const celspan_painting *painting, size_t index,
  celspan_painting_layer *out);
size_t celspan_painting_note_count(const celspan_painting *painting);
const char *celspan_painting_note_at(const celspan_painting *painting, size_t index, size_t
  *layer);
bool celspan_painting_clip(const celspan_painting *painting, double *rate, int32_t *from, int32_t
  *to);
size_t celspan_painting_key_count(const celspan_painting *painting);
bool celspan_painting_key_at(const celspan_painting *painting, size_t index, celspan_painting_key
  *out);
typedef struct celspan_trace celspan_trace;
typedef struct celspan_trace_desc { size_t struct_size; const celspan_picture_desc *picture;
  int32_t colours; const unsigned char *codes; double smooth; int32_t speckle; bool lines; }
  celspan_trace_desc;
void celspan_trace_desc_default(celspan_trace_desc *out, size_t struct_size);
typedef struct celspan_trace_shape { size_t struct_size; celspan_object *object; unsigned char
  colour[3]; int32_t x, y; double area; const char *data; const celspan_point *points; const double
  *widths; size_t point_count; bool is_closed; } celspan_trace_shape;
celspan_status celspan_trace_create(celspan_context *context, const celspan_trace_desc *desc,
  celspan_trace **out);
celspan_trace *celspan_trace_ref(celspan_trace *trace);
void celspan_trace_unref(celspan_trace *trace);
void celspan_trace_size(const celspan_trace *trace, int32_t *width, int32_t *height);
celspan_object *celspan_trace_object(const celspan_trace *trace);
size_t celspan_trace_shape_count(const celspan_trace *trace);
bool celspan_trace_shape_at(const celspan_trace *trace, size_t index, celspan_trace_shape *out);
celspan_status celspan_trace_write(celspan_context *context, const celspan_trace *trace, const char
  *path);
typedef struct celspan_plane celspan_plane;
typedef struct celspan_plane_desc { size_t struct_size; double width, height; int32_t depth;
  celspan_space space; } celspan_plane_desc;
void celspan_plane_desc_default(celspan_plane_desc *out, size_t struct_size);
celspan_status celspan_plane_create(celspan_context *context, const celspan_rostrum *rostrum, const
  celspan_plane_desc *desc, celspan_plane **out);
celspan_status celspan_plane_read(celspan_context *context, const char *path, celspan_plane **out);
celspan_plane *celspan_plane_ref(celspan_plane *plane);
void celspan_plane_unref(celspan_plane *plane);
void celspan_plane_size(const celspan_plane *plane, double *width, double *height);
bool celspan_plane_is_opaque(const celspan_plane *plane);
int32_t celspan_plane_frames(const celspan_plane *plane, double *frames_second);
celspan_status celspan_plane_frame(celspan_context *context, const celspan_plane *plane, int32_t
  frame, celspan_plane **out);
size_t celspan_plane_bytes(const celspan_plane *plane);
celspan_status celspan_plane_write(celspan_context *context, const celspan_plane *plane, const char
  *path);
typedef struct celspan_plane_view { size_t struct_size; int32_t width, height; int32_t crop_x,
  crop_y; int32_t crop_width, crop_height; celspan_antialias_mode antialias; } celspan_plane_view;
void celspan_plane_view_default(celspan_plane_view *out, size_t struct_size);
celspan_status celspan_plane_render(celspan_context *context, const celspan_plane *plane, const
  celspan_plane_view *view, const celspan_sink *sink);
celspan_status celspan_plane_pixels(celspan_context *context, const celspan_plane *plane, const
  celspan_plane_view *view, const celspan_coding *coding, void *pixels, size_t stride);
typedef struct celspan_light_field { double colour[3]; double terms[3][9]; } celspan_light_field;
celspan_light_field celspan_light_field_flat(double r, double g, double b);
void celspan_light_field_at(const celspan_light_field *field, double u, double v, double rgb[3]);
celspan_status celspan_light_field_texture(celspan_context *context, const celspan_light_field
  *field, int32_t width, int32_t height, celspan_texture **out);
typedef enum celspan_light_clue { CELSPAN_LIGHT_CLUE_GREY = 0, CELSPAN_LIGHT_CLUE_PATCH,
  CELSPAN_LIGHT_CLUE_LIGHT } celspan_light_clue;
typedef struct celspan_light_estimate_desc { size_t struct_size; const celspan_texture *picture;
  celspan_light_clue clue; double colour[3]; celspan_box patch; bool is_uneven; const
  celspan_texture *blank; } celspan_light_estimate_desc;
void celspan_light_estimate_desc_default(celspan_light_estimate_desc *out, size_t struct_size);
celspan_status celspan_light_estimate( celspan_context *context, const celspan_light_estimate_desc
  *desc, celspan_light_field *out);
celspan_status celspan_relight_picture(celspan_context *context, const celspan_texture *picture,
  const celspan_light_field *light, celspan_texture **out);
celspan_status celspan_relight_exposures( celspan_context *context, const celspan_texture *front,
  const celspan_light_field *front_light, const celspan_texture *back, const celspan_light_field
  *back_light, celspan_texture **out);
typedef struct celspan_relight_ground { const celspan_texture *picture; const celspan_texture
  *ground; double colour[3]; } celspan_relight_ground;
celspan_status celspan_relight_grounds(celspan_context *context, const celspan_relight_ground
  grounds[2], const celspan_light_field *light, celspan_texture **out);
celspan_status celspan_relight_write(celspan_context *context, const celspan_texture *texture,
  const char *path);
celspan_status celspan_relight_read(celspan_context *context, const char *path, celspan_texture
  **out);
typedef struct celspan_stack celspan_stack;
typedef struct celspan_stack_light { celspan_light front, back; } celspan_stack_light;
celspan_status celspan_stack_create(celspan_context *context, const celspan_frame_desc *desc,
  celspan_stack **out);
celspan_stack *celspan_stack_ref(celspan_stack *stack);
void celspan_stack_unref(celspan_stack *stack);
void celspan_stack_size(const celspan_stack *stack, int32_t *width, int32_t *height);
size_t celspan_stack_light_count(const celspan_stack *stack);
void celspan_stack_lights(const celspan_stack *stack, celspan_stack_light *lights);
size_t celspan_stack_bytes(const celspan_stack *stack);
celspan_status celspan_stack_pixels(celspan_context *context, const celspan_stack *stack, const
  celspan_stack_light *lights, int workers, float *rgba);
typedef struct celspan_tracker celspan_tracker;
typedef enum celspan_motion { CELSPAN_MOTION_TRANSLATION = 0, CELSPAN_MOTION_SIMILARITY,
  CELSPAN_MOTION_PERSPECTIVE } celspan_motion;
typedef struct celspan_luma { int32_t width, height; const float *values; } celspan_luma;
typedef struct celspan_tracker_desc { size_t struct_size; celspan_motion model; celspan_box region;
  const uint8_t *mask; } celspan_tracker_desc;
void celspan_tracker_desc_default(celspan_tracker_desc *out, size_t struct_size);
typedef struct celspan_sighting { size_t struct_size; bool is_found; celspan_matrix matrix;
  uint32_t corner_count; uint32_t agreeing_count; double error; } celspan_sighting;
celspan_status celspan_tracker_create(celspan_context *context, const celspan_luma *first, const
  celspan_tracker_desc *desc, celspan_tracker **out);
celspan_status celspan_tracker_follow(celspan_tracker *tracker, const celspan_luma *frame,
  celspan_sighting *out);
void celspan_tracker_rewind(celspan_tracker *tracker);
void celspan_tracker_destroy(celspan_tracker *tracker);
typedef struct celspan_film { size_t struct_size; int32_t width, height; double frames_second;
  int64_t first, count; const char *title; size_t mark_count; } celspan_film;
typedef enum celspan_parameter_kind { CELSPAN_PARAMETER_TEXT = 0, CELSPAN_PARAMETER_FILE,
  CELSPAN_PARAMETER_NUMBER, CELSPAN_PARAMETER_BOOLEAN, CELSPAN_PARAMETER_CHOICE,
  CELSPAN_PARAMETER_COLOUR, CELSPAN_PARAMETER_POINT, CELSPAN_PARAMETER_EASE }
  celspan_parameter_kind;
typedef struct celspan_parameter { size_t struct_size; const char *name; celspan_parameter_kind
  kind; const char *text; double number; double least, most; const char *const *choices; size_t
  choice_count; const char *about; } celspan_parameter;
typedef struct celspan_mark { size_t struct_size; const char *name; int64_t first, last; }
  celspan_mark;
typedef struct celspan_sound_passage { double begin, end; double fade_in, fade_out; }
  celspan_sound_passage;
typedef struct celspan_sound_ducker { size_t sound; double gain; double attack, release; }
  celspan_sound_ducker;
typedef struct celspan_sound { size_t struct_size; const char *path; double start; double speed;
  double gain[2]; const celspan_sound_passage *passages; size_t passage_count; const
  celspan_sound_ducker *duckers; size_t ducker_count; } celspan_sound;
typedef struct lua_State lua_State;
int luaopen_celspan(lua_State *L);
celspan_status celspan_lua_open(lua_State *L, celspan_context *context);
celspan_context *celspan_lua_context(lua_State *L);
typedef struct celspan_lua_limits { size_t struct_size; size_t memory; uint64_t steps; double
  seconds; size_t print; const char *const *folders; size_t folder_count; const char *search; void
  (*printed)(void *user, const char *text, size_t size); bool (*is_interrupted)(void *user); void
  (*overdue)(void *user, const char *message); void *user; } celspan_lua_limits;
void celspan_lua_limits_default(celspan_lua_limits *out, size_t struct_size);
celspan_status celspan_lua_sandbox(lua_State *L, const celspan_lua_limits *limits);
celspan_status celspan_lua_run(lua_State *L, const char *path, int argument_count, const char
  *const *arguments);
celspan_status celspan_lua_run_text(lua_State *L, const char *name, const char *text, size_t size,
  int argument_count, const char *const *arguments);
celspan_status celspan_lua_set(lua_State *L, const char *name, const char *value);
size_t celspan_lua_parameter_count(lua_State *L);
celspan_status celspan_lua_parameter(lua_State *L, size_t place, celspan_parameter *out);
celspan_status celspan_lua_call(lua_State *L, int argument_count, int result_count);
celspan_rostrum *celspan_lua_rostrum(lua_State *L, int index);
celspan_status celspan_lua_film(lua_State *L, int index, celspan_film *out);
celspan_status celspan_lua_mark(lua_State *L, int index, size_t place, celspan_mark *out);
celspan_status celspan_lua_sounds(lua_State *L, int index, size_t *count);
celspan_status celspan_lua_sound(lua_State *L, int index, size_t place, celspan_sound *out);
celspan_status celspan_lua_frame(lua_State *L, int index, int64_t number, celspan_frame_desc *out);
void celspan_lua_frame_drop(celspan_frame_desc *frame);
