/* celspan relight IN -o OUT: the light taken off a picture, and the picture in another light.
 *
 *   IN --light--> texture of its own S, T, beta --> OUT.exr, of seven channels
 *   IN.exr, of seven channels --> texture --> in the light --to --> OUT, any picture
 */
#include <string.h>

#include "cli/target.h"
#include "cli/verbs.h"

/* ---------------------------------------------------------------- the texture */

/* Whether the file is a relit picture. */
static bool is_relit(celspan_context *context, const char *path) {
  celspan_texture *texture = NULL;
  bool is = celspan_relight_read(context, path, NULL, &texture) == CELSPAN_OK;
  celspan_texture_unref(texture);
  return is;
}

static celspan_status find_light(celspan_context *context, const cs_request *request,
                                 const celspan_texture *picture, celspan_light_field *out) {
  const cs_given_light *light = &request->light;
  celspan_light_estimate_desc desc = CELSPAN_LIGHT_ESTIMATE_DESC;
  desc.picture = picture;
  if (light->is_grey)
    return celspan_light_estimate(context, &desc, out);
  *out =
      celspan_light_field_flat((double)light->rgb[0], (double)light->rgb[1], (double)light->rgb[2]);
  return CELSPAN_OK;
}

static celspan_status take_light_off(celspan_context *context, const cs_request *request,
                                     celspan_texture **out) {
  celspan_picture_desc desc;
  celspan_texture *picture;
  celspan_light_field light;
  memset(&desc, 0, sizeof desc);
  desc.file = request->operands[0];
  celspan_status status = celspan_texture_create_picture(context, &desc, &picture);
  if (status != CELSPAN_OK)
    return status;
  status = find_light(context, request, picture, &light);
  if (status == CELSPAN_OK)
    status = celspan_relight_picture(context, picture, &light, out);
  celspan_texture_unref(picture);
  return status;
}

/* ---------------------------------------------------------------- the picture */

/* The texture in a light, as a scene of the picture's size. has_alpha: false: it covers what is
 * behind it, and is opaque. */
static celspan_status make_scene(celspan_context *context, celspan_texture *texture,
                                 const celspan_picture_info *info, const float light[3],
                                 celspan_rostrum **out) {
  celspan_rect_desc rect = {.width = info->width, .height = info->height, .texture = texture};
  celspan_cel_desc cel_desc = CELSPAN_CEL_DESC;
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  celspan_object *object = NULL;
  celspan_cel *cel = NULL;
  celspan_status status = celspan_object_create_rect(context, &rect, &object);
  cel_desc.objects = &object;
  cel_desc.object_count = 1;
  cel_desc.has_front = true;
  cel_desc.front = (celspan_light){light[0], light[1], light[2], 1};
  if (status == CELSPAN_OK)
    status = celspan_cel_create(context, &cel_desc, &cel);
  desc.cels = &cel;
  desc.cel_count = 1;
  desc.antialias = CELSPAN_ANTIALIAS_NONE;
  desc.back.a = info->has_alpha ? 0 : 1;
  if (status == CELSPAN_OK)
    status = celspan_rostrum_create(context, &desc, out);
  celspan_cel_unref(cel);
  celspan_object_unref(object);
  return status;
}

static celspan_status write_picture(celspan_context *context, const cs_request *request,
                                    celspan_texture *texture) {
  celspan_picture_desc picture;
  celspan_picture_info info;
  memset(&picture, 0, sizeof picture);
  picture.file = request->operands[0];
  celspan_exposure exposure = {NULL, 1};
  celspan_status status = celspan_picture_inspect(context, &picture, &info);
  if (status == CELSPAN_OK)
    status = make_scene(context, texture, &info, request->to.rgb, &exposure.rostrum);
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  celspan_file_desc file = cs_target_file(request);
  frame.exposures = &exposure;
  frame.exposure_count = 1;
  frame.width = info.width;
  frame.height = info.height;
  if (status == CELSPAN_OK)
    status = celspan_frame_write(context, &frame, request->output, &file, NULL);
  celspan_rostrum_unref(exposure.rostrum);
  return status;
}

/* ---------------------------------------------------------------- the verb */

static cs_exit check_request(celspan_context *context, const cs_request *request, bool has_none) {
  if (!request->output)
    return cs_report_usage("-o is needed: the file to make");
  if (!request->light.is_given && !has_none)
    return cs_report_usage("--light is needed: the light that '%s' was taken in, a colour like "
                           "#ffe0b0, r,g,b, or grey",
                           request->operands[0]);
  if (request->light.is_given && has_none)
    return cs_report_usage("--light: the light of '%s' has been taken off already",
                           request->operands[0]);
  if (request->to.is_given)
    return cs_target_refuse(context, request->output, request);
  if (has_none)
    return cs_report_usage("--to is needed: the light that '%s' is to be shown in",
                           request->operands[0]);
  return CS_EXIT_OK;
}

cs_exit cs_verb_relight(celspan_context *context, const cs_request *request) {
  bool has_none = is_relit(context, request->operands[0]);
  cs_exit outcome = check_request(context, request, has_none);
  celspan_texture *texture = NULL;
  if (outcome != CS_EXIT_OK)
    return outcome;
  celspan_status status = has_none
                              ? celspan_relight_read(context, request->operands[0], NULL, &texture)
                              : take_light_off(context, request, &texture);
  if (status == CELSPAN_OK)
    status = request->to.is_given ? write_picture(context, request, texture)
                                  : celspan_relight_write(context, texture, request->output);
  celspan_texture_unref(texture);
  return cs_report_failure(context, status, NULL);
}
