/* Prints a word as characters, and the positions of its letters.
 *
 *   cc letters.c $(pkg-config --cflags --libs celspan) -o letters && ./letters FONT.ttf WORD
 */
#include <celspan/celspan.h>
#include <celspan/text.h>
#include <stdio.h>
#include <string.h>

static void print_letter(const celspan_glyph *letter) {
  printf("%.*s: x %.2f, advance %.2f\n", (int)letter->text_size, letter->text, letter->x,
         letter->advance);
}

/* Tests one point of the film for each character: a letter is a shape like any other. */
static void print_picture(const celspan_object *word) {
  celspan_box box;
  if (!celspan_object_bounds(word, &box))
    return; /* nothing but spaces */
  for (double y = box.y + 1; y < box.y + box.height; y += 2) {
    for (double x = box.x + 0.5; x < box.x + box.width; x += 1)
      putchar(celspan_object_contains(word, (celspan_point){x, y}) ? '#' : ' ');
    putchar('\n');
  }
}

static celspan_status print_word(celspan_context *context, const char *file, const char *word) {
  const char *const fonts[] = {file};
  celspan_text_desc desc = CELSPAN_TEXT_DESC;
  desc.text = word;
  desc.text_size = strlen(word);
  desc.fonts = fonts;
  desc.font_count = 1;
  desc.size = 28;
  celspan_object *object;
  celspan_status status = celspan_object_create_text(context, &desc, &object);
  if (status != CELSPAN_OK)
    return status;
  print_picture(object);
  celspan_object_unref(object);
  celspan_glyphs *letters;
  status = celspan_glyphs_create(context, &desc, &letters);
  if (status != CELSPAN_OK)
    return status;
  for (size_t i = 0; i < celspan_glyphs_count(letters); i++)
    print_letter(celspan_glyphs_get(letters, i));
  celspan_glyphs_destroy(letters);
  return CELSPAN_OK;
}

int main(int count, char **arguments) {
  celspan_context *context;
  if (count != 3 || celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 2;
  celspan_status status = print_word(context, arguments[1], arguments[2]);
  if (status != CELSPAN_OK)
    fprintf(stderr, "%s\n", celspan_context_error(context));
  celspan_context_destroy(context);
  return status != CELSPAN_OK;
}
