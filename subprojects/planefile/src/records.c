/* The records of a file that is being written, without the code of its bands. */
#include "writer.h"

/* ---------------------------------------------------------------- bytes */

static planefile_status put(planefile_writer *w, const void *bytes, size_t size) {
  w->offset += size;
  return w->desc.write(w->desc.user, bytes, size) ? PLANEFILE_OK : PLANEFILE_WRITE_FAILED;
}

static planefile_status put_record(planefile_writer *w, unsigned char kind,
                                   const unsigned char *payload, size_t size) {
  unsigned char head[PF_HEAD_BYTES] = {kind}, check[PF_CHECK_BYTES], offset[8];
  if (size > UINT32_MAX)
    return PLANEFILE_BAD_ARGUMENT;
  pf_store_64(offset, w->offset);
  pf_store_32(head + 1, (uint32_t)size);
  uint32_t sum = pf_crc32c(pf_crc32c(0, offset, sizeof offset), head, sizeof head);
  pf_store_32(check, pf_crc32c(sum, payload, size));
  planefile_status status = put(w, head, sizeof head);
  if (status == PLANEFILE_OK)
    status = put(w, payload, size);
  return status == PLANEFILE_OK ? put(w, check, sizeof check) : status;
}

/* Records that are read in different ways differ. */
static pf_print print_of(const planefile_writer *w, unsigned char kind,
                         const unsigned char *payload, size_t size) {
  uint64_t flags = (w->flags & PF_VARIES) << 8, base = kind == PF_CHANGED ? w->key_index : 0;
  return pf_print_of(payload, size, kind | flags | base << 16);
}

bool pf_writer_has(const planefile_writer *w, unsigned char kind, const pf_encoder *code) {
  return pf_written_has(w->known, print_of(w, kind, code->bytes, code->count));
}

planefile_status pf_writer_put_once(planefile_writer *w, unsigned char kind,
                                    const unsigned char *payload, size_t size, uint64_t *offset) {
  pf_print print = print_of(w, kind, payload, size);
  *offset = w->offset;
  if (!w->known)
    return put_record(w, kind, payload, size);
  uint64_t *known = pf_written_find(w->known, print);
  if (!known)
    return PLANEFILE_NO_MEMORY;
  if (*known == 0) {
    *known = w->offset;
    return put_record(w, kind, payload, size);
  }
  *offset = *known;
  return PLANEFILE_OK;
}

planefile_status pf_writer_put_header(planefile_writer *w) {
  unsigned char header[PF_HEADER_BYTES] = {0};
  memcpy(header, pf_magic, sizeof pf_magic);
  pf_store_32(header + 8, PF_VERSION);
  pf_store_32(header + 12, pf_is_film(w) ? PF_FILM : w->flags);
  pf_store_double(header + 16, w->desc.width);
  pf_store_double(header + 24, w->desc.height);
  pf_store_32(header + 32, w->desc.grid.columns | (uint32_t)w->desc.grid.rows << 16);
  pf_store_32(header + 36, pf_crc32c(0, header, 36));
  return put(w, header, sizeof header);
}

/* The list of pictures in an index. */
static size_t list_bytes(const planefile_writer *w) {
  return w->flags & PF_PICTURED ? PF_LIST_BYTES + PF_OFFSET_BYTES * w->picture_count : 0;
}

static size_t put_list(const planefile_writer *w, unsigned char *at) {
  if (list_bytes(w) > 0)
    pf_store_32(at, (uint32_t)w->picture_count);
  for (size_t i = 0; list_bytes(w) > 0 && i < w->picture_count; i++)
    pf_store_64(at + PF_LIST_BYTES + PF_OFFSET_BYTES * i, w->pictures[i]);
  return list_bytes(w);
}

planefile_status pf_writer_put_index(planefile_writer *w) {
  size_t flags = pf_is_film(w) ? PF_FLAG_BYTES : 0;
  size_t size = flags + list_bytes(w) + w->entry_count * PF_ENTRY_BYTES;
  unsigned char *payload = pf_make(&w->memory, 1, size);
  if (!payload)
    return PLANEFILE_NO_MEMORY;
  unsigned char *at = payload + flags;
  at += put_list(w, at);
  if (flags) {
    pf_store_32(payload, w->flags);
    pf_store_64(payload + 4, w->has_base ? w->key_index : 0);
  }
  for (size_t i = 0; i < w->entry_count; i++, at += PF_ENTRY_BYTES) {
    pf_store_32(at, (uint32_t)w->entries[i].top);
    pf_store_64(at + 4, w->entries[i].offset);
  }
  planefile_status status = pf_writer_put_once(w, PF_INDEX, payload, size, &w->index);
  pf_free(&w->memory, payload, 1, size);
  return status;
}

planefile_status pf_writer_put_frames(planefile_writer *w) {
  size_t size = PF_RATE_BYTES + w->frame_count * PF_FRAME_BYTES;
  unsigned char *payload = pf_make(&w->memory, 1, size);
  if (!payload)
    return PLANEFILE_NO_MEMORY;
  pf_store_double(payload, w->desc.frames_second);
  for (size_t i = 0; i < w->frame_count; i++)
    pf_store_64(payload + PF_RATE_BYTES + i * PF_FRAME_BYTES, w->frames[i]);
  planefile_status status = put_record(w, PF_FRAMES, payload, size);
  pf_free(&w->memory, payload, 1, size);
  return status;
}

planefile_status pf_writer_put_trailer(planefile_writer *w, uint64_t last) {
  unsigned char trailer[PF_TRAILER_BYTES] = {0};
  memcpy(trailer, pf_end_magic, sizeof pf_end_magic);
  pf_store_64(trailer + 8, last);
  pf_store_64(trailer + 16, w->offset + PF_TRAILER_BYTES);
  pf_store_32(trailer + 28, pf_crc32c(0, trailer, 28));
  return put(w, trailer, sizeof trailer);
}

/* ---------------------------------------------------------------- pictures */

static planefile_status put_picture(planefile_writer *w, const planefile_picture *picture) {
  uint64_t *pictures = pf_grow(&w->memory, w->pictures, sizeof *pictures, &w->picture_capacity,
                               w->picture_count + 1);
  if (!pictures)
    return PLANEFILE_NO_MEMORY;
  w->pictures = pictures;
  w->pictures[w->picture_count++] = w->offset;
  pf_encoder code;
  planefile_status status = pf_picture_encode(&w->memory, picture, &code);
  if (status == PLANEFILE_OK)
    status = put_record(w, PF_PICTURE, code.bytes, code.count);
  pf_encoder_finish(&code);
  return status;
}

/* *number: of a picture in the file, which is written if it is new. */
static planefile_status find_picture(planefile_writer *w, const planefile_picture *picture,
                                     uint32_t *number) {
  const pf_print print = {{picture->key[0], picture->key[1]},
                          (uint64_t)picture->width << 32 | picture->height << 2 | picture->kind};
  if (!w->shown_pictures && !(w->shown_pictures = pf_written_create(&w->memory)))
    return PLANEFILE_NO_MEMORY;
  uint64_t *known = pf_written_find(w->shown_pictures, print);
  if (!known)
    return PLANEFILE_NO_MEMORY;
  if (*known == 0) {
    *known = w->picture_count + 1;
    *number = (uint32_t)w->picture_count;
    return put_picture(w, picture);
  }
  *number = (uint32_t)*known - 1;
  return PLANEFILE_OK;
}

/* Marks the pictures of the programs of cells that are seen. seen: of each cell, false. */
static void mark_pictures(const planefile_band *plane, bool *seen, uint32_t *numbers) {
  for (uint32_t i = 0; i < 2 * plane->border_count; i++) {
    uint32_t cell = i % 2 ? plane->borders[i / 2].right : plane->borders[i / 2].left;
    const planefile_program *program = &plane->programs[cell];
    for (uint32_t k = 0; !seen[cell] && k < program->step_count; k++) {
      const planefile_step *step = &plane->steps[program->step + k];
      const planefile_axis *axis = &plane->axes[step->axis];
      if (step->kind == PLANEFILE_RAMP && axis->kind == PLANEFILE_PICTURE)
        numbers[axis->picture] = 1;
    }
    seen[cell] = true;
  }
}

/* Writes the pictures that are seen and gives axes the numbers that these have in the file. */
static planefile_status number_pictures(planefile_writer *w, const planefile_band *plane,
                                        uint32_t *numbers, planefile_axis *axes) {
  planefile_status status = PLANEFILE_OK;
  for (uint32_t i = 0; i < plane->picture_count && status == PLANEFILE_OK; i++)
    if (numbers[i] > 0)
      status = find_picture(w, &plane->pictures[i], &numbers[i]);
  for (uint32_t i = 0; i < plane->axis_count; i++) {
    axes[i] = plane->axes[i];
    if (axes[i].kind == PLANEFILE_PICTURE && axes[i].picture < plane->picture_count)
      axes[i].picture = numbers[axes[i].picture];
  }
  return status;
}

planefile_status pf_writer_put_pictures(planefile_writer *w, const planefile_band *plane,
                                        planefile_axis *axes) {
  bool *seen = pf_make(&w->memory, sizeof *seen, plane->cell_count);
  uint32_t *numbers = pf_make(&w->memory, sizeof *numbers, plane->picture_count);
  planefile_status status = PLANEFILE_NO_MEMORY;
  if (seen && numbers) {
    if (plane->programs)
      mark_pictures(plane, seen, numbers);
    status = number_pictures(w, plane, numbers, axes);
  }
  pf_free(&w->memory, numbers, sizeof *numbers, plane->picture_count);
  pf_free(&w->memory, seen, sizeof *seen, plane->cell_count);
  return status;
}
