/* Pictures as scenes. */
#include "cli/still.h"

#include <string.h>

#include "cli/view.h"

static celspan_status make_cel(celspan_context *context, celspan_object *object,
                               celspan_cel **out) {
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.objects = &object;
  desc.object_count = 1;
  return celspan_cel_create(context, &desc, out);
}

static celspan_status make_rostrum(celspan_context *context, celspan_cel *cel,
                                   celspan_rostrum **out) {
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.cels = &cel;
  desc.cel_count = 1;
  desc.antialias = CELSPAN_ANTIALIAS_NONE;
  return celspan_rostrum_create(context, &desc, out);
}

static celspan_status make_scene(celspan_context *context, const celspan_picture_desc *picture,
                                 const celspan_picture_info *info, celspan_rostrum **out) {
  celspan_image_desc desc = {.picture = *picture, .width = info->width, .height = info->height};
  celspan_object *object = NULL;
  celspan_cel *cel = NULL;
  celspan_status status = celspan_object_create_image(context, &desc, &object);
  if (status == CELSPAN_OK)
    status = make_cel(context, object, &cel);
  if (status == CELSPAN_OK)
    status = make_rostrum(context, cel, out);
  celspan_cel_unref(cel);
  celspan_object_unref(object);
  return status;
}

cs_exit cs_still_open(celspan_context *context, const char *path, cs_still *out) {
  celspan_picture_desc picture;
  memset(&picture, 0, sizeof picture);
  picture.file = path;
  cs_still still = {.exposure.weight = 1};
  celspan_status status = celspan_picture_inspect(context, &picture, &still.info);
  if (status == CELSPAN_OK)
    status = make_scene(context, &picture, &still.info, &still.exposure.rostrum);
  if (status != CELSPAN_OK)
    return cs_report_failure(context, status, NULL);
  *out = still;
  return CS_EXIT_OK;
}

void cs_still_close(cs_still *still) {
  celspan_rostrum_unref(still->exposure.rostrum);
  still->exposure.rostrum = NULL;
}

cs_exit cs_still_frame(const cs_still *still, const cs_request *request, celspan_frame_desc *out) {
  cs_exit outcome = cs_view_frame(request, still->info.width, still->info.height, out);
  out->exposures = &still->exposure;
  out->exposure_count = 1;
  return outcome;
}
