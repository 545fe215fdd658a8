/* The layers of a painting as cels. Prints the tree of layers, and one frame as characters.
 *
 *   cc painting.c $(pkg-config --cflags --libs celspan) -o painting && ./painting forest.kra
 */
#include <celspan/celspan.h>
#include <celspan/layers.h>
#include <stdio.h>

enum { WIDTH = 72, HEIGHT = 24 };

#define TRY(call)                                                                                  \
  do {                                                                                             \
    celspan_status status_ = (call);                                                               \
    if (status_ != CELSPAN_OK)                                                                     \
      return status_;                                                                              \
  } while (0)

/* Adds a cel for a layer to a rostrum: its picture on a rectangle of its size and position. */
static celspan_status add_cel(celspan_context *context, const celspan_painting_layer *layer,
                              celspan_cel **out) {
  celspan_picture_desc picture = {
      .struct_size = sizeof picture, .surface = layer->surface, .colour = layer->colour};
  celspan_cel_desc cel = CELSPAN_CEL_DESC;
  celspan_texture *texture = NULL;
  celspan_object *object = NULL;
  celspan_status status = celspan_texture_create_picture(context, &picture, &texture);
  if (status == CELSPAN_OK)
    status = celspan_object_create_rect(context,
                                        &CELSPAN_DESC(celspan_rect_desc, layer->x, layer->y,
                                                      layer->width, layer->height, 0, texture),
                                        &object);
  cel.objects = &object;
  cel.object_count = 1;
  cel.opacity = layer->opacity;
  if (status == CELSPAN_OK)
    status = celspan_cel_create(context, &cel, out);
  celspan_object_unref(object);
  celspan_texture_unref(texture);
  return status;
}

/* All visible layers with pixels, rearmost first. */
static celspan_status add_cels(celspan_context *context, const celspan_painting *painting,
                               celspan_cel **cels, size_t most, size_t *count) {
  celspan_painting_layer layer = CELSPAN_PAINTING_LAYER;
  for (size_t i = 0; celspan_painting_layer_at(painting, i, &layer) && *count < most; i++) {
    printf("%s %s, %s, opacity %.2f\n", layer.is_group ? "group" : "layer", layer.name, layer.blend,
           layer.opacity);
    if (layer.surface && layer.is_visible) {
      TRY(add_cel(context, &layer, &cels[*count]));
      ++*count;
    }
  }
  return CELSPAN_OK;
}

static celspan_status render(celspan_context *context, const celspan_painting *painting,
                             celspan_cel **cels, size_t count) {
  static unsigned char pixels[HEIGHT][WIDTH][4];
  celspan_rostrum *rostrum;
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  int32_t width, height;
  celspan_painting_size(painting, &width, &height);
  desc.cels = cels;
  desc.cel_count = count;
  TRY(celspan_rostrum_create(context, &desc, &rostrum));
  const celspan_exposure exposure = {rostrum, 1};
  const celspan_coding coding = {.struct_size = sizeof coding,
                                 .depth = CELSPAN_DEPTH_8,
                                 .transfer = CELSPAN_TRANSFER_SRGB,
                                 .alpha = CELSPAN_ALPHA_STRAIGHT};
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  frame.exposures = &exposure;
  frame.exposure_count = 1;
  frame.film_width = width;
  frame.film_height = height;
  frame.width = WIDTH;
  frame.height = HEIGHT;
  celspan_status status =
      celspan_frame_pixels(context, &frame, &coding, pixels, sizeof pixels[0], NULL);
  celspan_rostrum_unref(rostrum);
  for (int y = 0; y < HEIGHT && status == CELSPAN_OK; y++) {
    for (int x = 0; x < WIDTH; x++)
      putchar(" .:-=+*#%@"[pixels[y][x][1] * 10 / 256]);
    putchar('\n');
  }
  return status;
}

static celspan_status show(celspan_context *context, const char *file) {
  celspan_painting *painting;
  celspan_cel *cels[64];
  size_t count = 0, layer;
  TRY(celspan_painting_read(context, file, &painting));
  celspan_status status = add_cels(context, painting, cels, 64, &count);
  for (size_t i = 0; i < celspan_painting_note_count(painting); i++)
    printf("not shown: %s\n", celspan_painting_note_at(painting, i, &layer));
  if (status == CELSPAN_OK)
    status = render(context, painting, cels, count);
  while (count > 0)
    celspan_cel_unref(cels[--count]);
  celspan_painting_unref(painting);
  return status;
}

int main(int count, char **arguments) {
  celspan_context *context;
  if (count != 2 || celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  celspan_status status = show(context, arguments[1]);
  if (status != CELSPAN_OK)
    fprintf(stderr, "%s\n", celspan_context_error(context));
  celspan_context_destroy(context);
  return status != CELSPAN_OK;
}
