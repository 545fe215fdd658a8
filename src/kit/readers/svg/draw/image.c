#include "readers/svg/draw/image.h"

#include <string.h>

#include "celspan/svg.h"
#include "common/address.h"
#include "readers/svg/document/shapes.h"

/* The contents of an image, before it is put in its place. */
typedef struct image {
  cs_svg_reading *reading;
  const cs_svg_node *node;
  celspan_object *object; /* from (0, 0) to its size; NULL: nothing is shown, and this is noted */
  double width, height;
} image;

/* ---------------------------------------------------------------- notes */

static celspan_status note(const image *of, const char *reason) {
  return cs_svg_skip(of->reading, of->node, "image: %s", reason);
}

/* A failure caused by the image is noted; other failures are returned. */
static celspan_status note_failure(const image *of, celspan_status status) {
  if ((status != CELSPAN_INPUT && status != CELSPAN_LIMIT) || of->reading->has_failed)
    return status;
  return note(of, of->reading->context->error);
}

/* ---------------------------------------------------------------- pictures */

/* Makes the object of a picture, and sets the size. */
static celspan_status show_picture(image *of, celspan_picture_desc *picture) {
  celspan_context *context = of->reading->context;
  celspan_picture_info info = CELSPAN_PICTURE_INFO;
  picture->colour = of->reading->is_coded ? "linear" : NULL;
  CS_TRY(celspan_picture_inspect(context, picture, &info));
  of->width = info.width;
  of->height = info.height;
  const celspan_image_desc desc = {.struct_size = sizeof desc,
                                   .picture = picture,
                                   .width = of->width,
                                   .height = of->height,
                                   .fit = CELSPAN_FIT_FILL};
  return celspan_object_create_image(context, &desc, &of->object);
}

/* A picture that is contained in the drawing. */
static celspan_status show_bytes(image *of, const cs_address_data *data) {
  celspan_picture_desc picture = {.struct_size = sizeof picture, .file = NULL};
  CS_TRY(cs_svg_image_picture(of->reading, of->node, data->bytes, data->size, &picture.surface));
  if (!picture.surface)
    return CELSPAN_OK;
  celspan_status status = show_picture(of, &picture);
  celspan_surface_unref(picture.surface);
  return status;
}

/* ---------------------------------------------------------------- drawings */

static celspan_status copy_notes(const image *of, const celspan_svg *art) {
  for (size_t i = 0; i < art->skipped_count; i++)
    CS_TRY(cs_svg_skip(of->reading, of->node, "image, line %d: %.120s", art->skipped[i].line,
                       art->skipped[i].what));
  return CELSPAN_OK;
}

static celspan_status copy_names(const image *of, const celspan_svg *art) {
  for (const cs_svg_named *one = art->named; one; one = one->next)
    CS_TRY(cs_svg_name_file(of->reading->context, of->reading->art, one->path));
  return CELSPAN_OK;
}

/* The part of the drawing that lies inside its size. */
static celspan_status show_art(image *of, const celspan_svg *art) {
  const celspan_matrix identity = celspan_matrix_identity();
  celspan_point size = celspan_svg_size(art);
  const celspan_box box = {0, 0, size.x, size.y};
  celspan_object *both[2] = {celspan_svg_object(art), NULL};
  of->width = size.x;
  of->height = size.y;
  CS_TRY(copy_notes(of, art));
  CS_TRY(copy_names(of, art));
  if (!(size.x > 0) || !(size.y > 0))
    return CELSPAN_OK;
  CS_TRY(cs_svg_rectangle(of->reading->context, &box, &identity, &both[1]));
  celspan_status status = celspan_object_create_boolean(of->reading->context, CELSPAN_OPERATOR_CLIP,
                                                        both, 2, &of->object);
  celspan_object_unref(both[1]);
  return status;
}

static bool shows_itself(const cs_svg_source *source, const cs_svg_source *inner) {
  for (; source; source = source->outer)
    if (inner->file && source->file && source->device == inner->device &&
        source->number == inner->number)
      return true;
  return false;
}

static int depth_of(const cs_svg_source *source) {
  int depth = 0;
  for (; source; source = source->outer)
    depth++;
  return depth;
}

static celspan_status show_drawing(image *of, cs_svg_source inner, const char *bytes, size_t size) {
  cs_svg_reading *reading = of->reading;
  celspan_svg *art;
  inner.fonts = reading->source->fonts;
  inner.font_count = reading->source->font_count;
  inner.outer = reading->source;
  if (shows_itself(reading->source, &inner))
    return note(of, "the drawing contains itself");
  if (depth_of(reading->source) > CS_SVG_IMAGE_DEPTH)
    return note(of, "drawings contain one another too deep");
  if (++reading->drawings > CS_SVG_DRAWINGS)
    return cs_fail(reading->context, CELSPAN_LIMIT,
                   "line %u: more than %d drawings are read as images", of->node->line,
                   CS_SVG_DRAWINGS);
  celspan_status status = reading->read_inner(reading, &inner, bytes, size, &art);
  if (status != CELSPAN_OK)
    return note_failure(of, status);
  status = show_art(of, art);
  celspan_svg_unref(art);
  return status;
}

/* ---------------------------------------------------------------- where they are */

static celspan_status show_data(image *of, const cs_address_data *data) {
  const cs_svg_source inner = {.name = "the drawing in it"};
  return cs_svg_image_is_drawing(data->bytes, data->size)
             ? show_drawing(of, inner, (const char *)data->bytes, data->size)
             : show_bytes(of, data);
}

static celspan_status show_embedded(image *of, const char *href) {
  celspan_context *context = of->reading->context;
  cs_address_data data;
  bool is_broken;
  CS_TRY(cs_svg_image_count(of->reading, of->node, strlen(href)));
  celspan_status status = cs_address_read(context, href, &data, &is_broken);
  if (status == CELSPAN_OK)
    status = is_broken ? note(of, "its data: address is damaged") : show_data(of, &data);
  cs_address_finish(&data, context);
  return status;
}

static celspan_status show_drawing_file(image *of, const cs_svg_image_file *file) {
  celspan_context *context = of->reading->context;
  const cs_svg_source inner = {
      .name = file->path, .file = file->path, .device = file->device, .number = file->number};
  char *bytes;
  of->reading->has_other_files = true;
  CS_TRY(cs_svg_image_count(of->reading, of->node, file->size));
  celspan_status status = cs_svg_image_file_load(context, file, &bytes);
  of->reading->has_failed = status == CELSPAN_INPUT;
  CS_TRY(status);
  if (!bytes)
    return note(of, "the file changed while it was read");
  status = show_drawing(of, inner, bytes, (size_t)file->size);
  cs_mem_free(context->memory, bytes, (size_t)file->size + 1);
  return status;
}

static celspan_status show_linked(image *of, const char *href) {
  cs_svg_reading *reading = of->reading;
  cs_svg_image_file file;
  const char *reason;
  celspan_status status =
      cs_svg_image_file_find(reading->context, reading->source->file, href, &file, &reason);
  reading->has_failed = status == CELSPAN_INPUT;
  CS_TRY(status);
  if (!reason)
    CS_TRY(cs_svg_name_file(reading->context, reading->art, file.path));
  if (!reason && cs_svg_image_is_drawing(file.head, file.head_size))
    return show_drawing_file(of, &file);
  celspan_picture_desc picture = {.struct_size = sizeof picture, .file = file.path};
  status = reason ? cs_svg_skip(reading, of->node, "image %.40s: %s", href, reason)
                  : show_picture(of, &picture);
  reading->has_other_files = reading->has_other_files || reason || status != CELSPAN_OK;
  return reason ? status : note_failure(of, status);
}

/* ---------------------------------------------------------------- its place */

/* The box of the element; if it has none, the box of the picture or drawing that it shows. */
static celspan_status read_box(const image *of, const cs_svg_measure *measure, celspan_box *out) {
  const cs_svg_length none = {-1, CS_SVG_UNIT_NUMBER};
  celspan_context *context = of->reading->context;
  const cs_svg_node *node = of->node;
  CS_TRY(cs_svg_number_of(context, node, CS_SVG_X, CS_SVG_AXIS_X, measure, &out->x));
  CS_TRY(cs_svg_number_of(context, node, CS_SVG_Y, CS_SVG_AXIS_Y, measure, &out->y));
  CS_TRY(cs_svg_length_of(context, node, CS_SVG_WIDTH, CS_SVG_AXIS_X, measure, none, &out->width));
  CS_TRY(
      cs_svg_length_of(context, node, CS_SVG_HEIGHT, CS_SVG_AXIS_Y, measure, none, &out->height));
  if (out->width < 0 && out->height < 0)
    out->width = of->width;
  if (out->width < 0)
    out->width = out->height * of->width / of->height;
  if (out->height < 0)
    out->height = out->width * of->height / of->width;
  return CELSPAN_OK;
}

/* Cuts off the parts outside the element's box. */
static celspan_status cut(const image *of, const celspan_box *box, const celspan_matrix *user,
                          celspan_object **object) {
  celspan_object *both[2] = {*object, NULL};
  CS_TRY(cs_svg_rectangle(of->reading->context, box, user, &both[1]));
  *object = NULL;
  celspan_status status =
      celspan_object_create_boolean(of->reading->context, CELSPAN_OPERATOR_CLIP, both, 2, object);
  celspan_object_unref(both[0]);
  celspan_object_unref(both[1]);
  return status;
}

/* Fits the visible part into a box. user: from its units to the units of *out. */
static celspan_status put(const image *of, const celspan_box *box, const celspan_matrix *user,
                          celspan_object **out) {
  const char *aspect = cs_svg_node_value(of->node, CS_SVG_PRESERVE_ASPECT_RATIO);
  celspan_matrix inverse;
  if (!(box->width > 0) || !(box->height > 0))
    return CELSPAN_OK;
  const cs_svg_view_box whole = {true, 0, 0, of->width, of->height};
  celspan_matrix matrix = cs_svg_fit(&whole, box->width, box->height, aspect);
  matrix = celspan_matrix_then(matrix, celspan_matrix_translation(box->x, box->y));
  matrix = celspan_matrix_then(matrix, *user);
  if (!celspan_matrix_inverse(matrix, &inverse))
    return CELSPAN_OK;
  CS_TRY(celspan_object_transform(of->reading->context, of->object, &matrix, out));
  return aspect && strstr(aspect, "slice") ? cut(of, box, user, out) : CELSPAN_OK;
}

/* The contents of the element, read when they are first needed. The object is borrowed. */
static celspan_status show(image *of) {
  cs_svg_kept_image found = {NULL, 0, 0};
  const char *href = cs_svg_node_value(of->node, CS_SVG_HREF);
  if (!href || !*cs_svg_skip_space(href))
    return CELSPAN_OK;
  if (!cs_svg_kept_image_find(of->reading, of->node, &found)) {
    href = cs_svg_skip_space(href);
    CS_TRY(cs_address_is_data(href) ? show_embedded(of, href) : show_linked(of, href));
    found = (cs_svg_kept_image){of->object, of->width, of->height};
    CS_TRY(cs_svg_kept_image_add(of->reading, of->node, found));
  }
  of->object = found.object;
  of->width = found.width;
  of->height = found.height;
  return CELSPAN_OK;
}

celspan_status cs_svg_image_add(cs_svg_reading *reading, const cs_svg_node *node,
                                const cs_svg_place *place, cs_svg_item *item) {
  image of = {.reading = reading, .node = node};
  celspan_box box;
  if (!place->style.is_visible)
    return CELSPAN_OK;
  CS_TRY(show(&of));
  if (!of.object)
    return CELSPAN_OK;
  CS_TRY(read_box(&of, &place->measure, &box));
  return put(&of, &box, &place->matrix, &item->own);
}

celspan_status cs_svg_image_in_box(cs_svg_reading *reading, const cs_svg_node *node,
                                   const celspan_box *box, celspan_object **out) {
  const celspan_matrix identity = celspan_matrix_identity();
  image of = {.reading = reading, .node = node};
  *out = NULL;
  CS_TRY(show(&of));
  return of.object ? put(&of, box, &identity, out) : CELSPAN_OK;
}

celspan_status cs_svg_image_box(cs_svg_reading *reading, const cs_svg_node *node,
                                const cs_svg_measure *measure, celspan_box *out, bool *is_there) {
  image of = {.reading = reading, .node = node};
  CS_TRY(show(&of));
  CS_TRY(read_box(&of, measure, out));
  *is_there = out->width > 0 && out->height > 0;
  return CELSPAN_OK;
}
