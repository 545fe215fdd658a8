#include "plugins/footage/movie.h"

#include <unistd.h>

#include "inside/context.h"
#include "inside/description.h"
#include "inside/pictures.h"

/* ---------------------------------------------------------------- the surface of a picture */

typedef struct shown {
  cs_movie *movie; /* a reference */
  size_t place;
} shown;

static void release(void *user) {
  shown *s = user;
  cs_memory *memory = cs_memory_ref(s->movie->memory);
  cs_movie_unref(s->movie);
  cs_mem_free(memory, s, sizeof *s);
  cs_memory_unref(memory);
}

static celspan_status fill(void *user, celspan_context *context, const celspan_rectangle *rectangle,
                           void *destination, size_t stride, int32_t *rows) {
  const shown *s = user;
  cs_decode *decode = &s->movie->decode;
  cs_decode_picture *picture;
  *rows = 0;
  CS_TRY(cs_decode_get(decode, context, s->place, &picture));
  celspan_status status =
      cs_raw_convert(&decode->planes, context, picture->planes, rectangle, destination, stride);
  cs_decode_release(context, picture);
  *rows = status == CELSPAN_OK ? rectangle->height : 0;
  return status;
}

celspan_status cs_movie_surface(celspan_context *context, cs_movie *movie, size_t place,
                                celspan_alpha alpha, celspan_surface **out) {
  const cs_raw *planes = &movie->decode.planes;
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  cs_hash key = cs_hash_begin(0x6d6f7669u);
  cs_hash_hash(&key, movie->hash);
  cs_hash_word(&key, place);
  key = cs_hash_end(key);
  cs_raw_upright(planes, &desc.width, &desc.height);
  desc.format = cs_raw_pixel(planes) == 8 ? CELSPAN_SURFACE_RGBA16 : CELSPAN_SURFACE_RGBA8;
  desc.alpha = alpha;
  desc.fill = fill;
  desc.release = release;
  desc.any_thread = true;
  desc.has_key = true;
  desc.key[0] = key.a;
  desc.key[1] = key.b;
  shown *s = cs_mem_array(movie->memory, 1, sizeof *s);
  if (!s)
    return cs_fail_memory(context);
  *s = (shown){cs_movie_ref(movie), place};
  desc.user = s;
  celspan_status status = cs_surface_create_reader(context, &desc, out);
  if (status != CELSPAN_OK)
    release(s);
  return status;
}

/* ---------------------------------------------------------------- life */

static void destroy(cs_movie *movie) {
  cs_memory *memory = movie->memory;
  cs_decode_finish(&movie->decode, memory);
  cs_listing_finish(&movie->listing);
  cs_counted_free(memory, movie, sizeof *movie);
}

CS_COUNTED(cs_movie)

static cs_hash hash_of(const char *path, const cs_kind_file *file) {
  cs_hash hash = cs_hash_begin(0x666f6f74u);
  cs_hash_text(&hash, path);
  cs_hash_word(&hash, (uint64_t)file->size);
  cs_hash_word(&hash, (uint64_t)file->time);
  cs_hash_word(&hash, file->number);
  return cs_hash_end(hash);
}

static celspan_status read_file(celspan_context *context, const char *path,
                                const cs_kind_file *file, cs_movie *movie) {
  CS_TRY(cs_listing_read(context, path, file, &movie->listing));
  CS_TRY(cs_decode_init(&movie->decode, context, path, file));
  movie->hash = hash_of(path, file);
  movie->decode.key = (cs_cache_key){movie->hash.a, movie->hash.b, 0};
  return CELSPAN_OK;
}

celspan_status cs_movie_open(celspan_context *context, const char *path, const char *tried,
                             cs_movie **out) {
  cs_kind_file file;
  cs_movie *movie;
  CS_TRY(cs_kind_open(context, path, tried, &file));
  celspan_status status = CS_COUNTED_MAKE(context, movie);
  if (status == CELSPAN_OK) {
    cs_decode_begin(&movie->decode, &movie->listing);
    movie->listing.memory = context->memory;
    status = read_file(context, path, &file, movie);
    status = CS_GIVE(status, movie, cs_movie_unref, out);
  }
  close(file.descriptor);
  return status;
}
